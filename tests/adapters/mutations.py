#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Adapters broken on purpose, mostly by two indices swapped, one at a time: does a test fail?

    python3 tests/adapters/mutations.py BUILD        one to five minutes; nothing of BUILD is changed

Each mutant is a shared library in a temporary folder that is put before the real one (LD_PRELOAD). Exit status 1 if one survives.
"""
import argparse
import collections
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ADAPTERS = pathlib.Path(__file__).resolve().parents[2] / "adapters"
Mutant = collections.namedtuple("Mutant", "what file before after")
Library = collections.namedtuple("Library", "name sources flags program tests mutants")

HOSTS = "adapters_hosts_test"
HEAT = "adapters_heat_test"


def user_element(file, **texts):
    """Mutants that every user element has; texts: the line as it is and as it should not be."""
    names = {"tangent": "tangent transposed", "coordinates": "x, y, z of a node reversed", "nodes": "nodes reversed",
             "forces": "x, y, z of a force reversed", "displacements": "x, y, z of a displacement reversed",
             "history": "history in another stride"}
    return [Mutant(names[key], file, *pair) for key, pair in texts.items()]


LIBRARIES = [
    Library("ents_abaqus", ["abaqus/abaqus.cpp", "abaqus/uel/uel.cpp", "abaqus/uinter/uinter.cpp"], [], HOSTS, "*/abaqus_*:Uel.*-*abaqus_explicit*",
            user_element(
                "abaqus/uel/uel.cpp",
                tangent=("e.tangent = {amatrx, 1, dofs}", "e.tangent = {amatrx, dofs, 1}"),
                coordinates=("e.position = {coords, 1, *mcrd}", "e.position = {coords + *mcrd - 1, -1, *mcrd}"),
                nodes=("e.position = {coords, 1, *mcrd}", "e.position = {coords + *mcrd * (nodes - 1), 1, -*mcrd}"),
                forces=("e.residual = {rhs, 1, e.dofs}", "e.residual = {rhs + e.dofs - 1, -1, e.dofs}"),
                displacements=("e.displacement = {u, 1, e.dofs}", "e.displacement = {u + e.dofs - 1, -1, e.dofs}"))),
    Library("ents_abaqus", ["abaqus/abaqus.cpp", "abaqus/uel/uel.cpp", "abaqus/uinter/uinter.cpp"], [], HOSTS, "*Uinter*", [
        Mutant("columns and rows of ALOCALDIR swapped", "abaqus/uinter/uinter.cpp", "alocaldir[i + 3 * (1 + a)]", "alocaldir[1 + a + 3 * i]"),
        Mutant("tangents swapped in where a point starts", "abaqus/uinter/uinter.cpp", "start[a] = -rdisp[1 + a]", "start[a] = -rdisp[d - 1 - a]"),
        Mutant("DDSDDR transposed", "common/point.cpp", "p.stiffness[i + d * j]", "p.stiffness[j + d * i]"),
        Mutant("tangents swapped in STRESS", "common/point.cpp", "p.traction[j] = side", "p.traction[j == 0 ? 0 : d - j] = side")]),
    Library("ents_abaqus_explicit", ["abaqus/abaqus.cpp", "abaqus/vuel/vuel.cpp"], ["-DENTS_ABAQUS_EXPLICIT"], HOSTS, "*abaqus_explicit*",
            user_element(
                "abaqus/vuel/vuel.cpp",
                coordinates=("{coords + b, block * nodes, block}", "{coords + b, block, block * e.coordinates}"),
                nodes=("{coords + b, block * nodes, block}", "{coords + b + block * (nodes - 1), block * nodes, -block}"),
                forces=("{rhs + b, block, block * e.dofs}", "{rhs + b + block * (e.dofs - 1), -block, block * e.dofs}"),
                displacements=("{u + b, block, block * e.dofs}", "{u + b + block * (e.dofs - 1), -block, block * e.dofs}"),
                history=("e.history = {svars + b, block}", "e.history = {svars + b * *nsvars, 1}"))),
    Library("ents_calculix", ["calculix/stiffness_store.cpp", "calculix/ccx_element.cpp", "calculix/uel_loader.cpp"], ["-ldl"], HOSTS, "*calculix*",
            user_element(
                "calculix/ccx_element.cpp",
                tangent=("e.tangent = {tangent.data(), 1, rows}", "e.tangent = {tangent.data(), rows, 1}"),
                coordinates=("e.position = {local.reference, 1, 3}", "e.position = {local.reference + 2, -1, 3}"),
                nodes=("e.position = {local.reference, 1, 3}", "e.position = {local.reference + 3 * (e.nodes - 1), 1, -3}"),
                forces=("e.residual = {local.residual, 1, e.dofs}", "e.residual = {local.residual + 2, -1, 3}"),
                displacements=("e.displacement = {local.displacement, 1, e.dofs}", "e.displacement = {local.displacement + 2, -1, 3}"))),
    Library("entsContact", ["opensees/entsContact.cpp"], [], HOSTS, "*opensees*",
            user_element(
                "opensees/entsContact.cpp",
                tangent=("e.tangent = {tangent, 1, rows}", "e.tangent = {tangent, rows, 1}"),
                coordinates=("e.position = {position, 1, d}", "e.position = {position + d - 1, -1, d}"),
                nodes=("e.position = {position, 1, d}", "e.position = {position + d * (ele->nNode - 1), 1, -d}"),
                forces=("e.residual = {residual, 1, d}", "e.residual = {residual + d - 1, -1, d}"),
                displacements=("e.displacement = {displacement, 1, d}", "e.displacement = {displacement + d - 1, -1, d}"))),
    Library("ents_feap", ["feap/ents_feap.cpp"], [], HOSTS, "*feap*",
            user_element(
                "feap/ents_feap.cpp",
                tangent=("e.tangent = {s, 1, nst}", "e.tangent = {s, nst, 1}"),
                coordinates=("e.position = {xl, 1, ndm}", "e.position = {xl + ndm - 1, -1, ndm}"),
                nodes=("e.position = {xl, 1, ndm}", "e.position = {xl + ndm * (nodes - 1), 1, -ndm}"),
                forces=("e.residual = {p, 1, ndf}", "e.residual = {p + ndf - 1, -1, ndf}"),
                displacements=("e.displacement = {ul, 1, ndf}", "e.displacement = {ul + ndf - 1, -1, ndf}"))),
    Library("ents_ansys", ["ansys/userelem/userelem.cpp"], [], HOSTS, "*ansys*",
            user_element(
                "ansys/userelem/userelem.cpp",
                tangent=("e.tangent = {eStiff, 1, *nUsrDof}", "e.tangent = {eStiff, *nUsrDof, 1}"),
                coordinates=("e.position = {xRef, 1, *nDim}", "e.position = {xRef + *nDim - 1, -1, *nDim}"),
                nodes=("e.position = {xRef, 1, *nDim}", "e.position = {xRef + *nDim * (*nNodes - 1), 1, -*nDim}"),
                forces=("e.residual = {fInt, 1, e.dofs}", "e.residual = {fInt + e.dofs - 1, -1, e.dofs}"),
                displacements=("e.displacement = {TotValDofs, 1, e.dofs}", "e.displacement = {TotValDofs + e.dofs - 1, -1, e.dofs}"))),
    Library("ents_marc", ["marc/uselem/uselem.cpp"], [], HOSTS, "*marc*",
            user_element(
                "marc/uselem/uselem.cpp",
                tangent=("e.tangent = {xk, 1, rows}", "e.tangent = {xk, rows, 1}"),
                coordinates=("e.position = {coord, 1, *ncrd}", "e.position = {coord + *ncrd - 1, -1, *ncrd}"),
                nodes=("e.position = {coord, 1, *ncrd}", "e.position = {coord + *ncrd * (*nnode - 1), 1, -*ncrd}"),
                forces=("e.residual = {r, 1, *ndeg}", "e.residual = {r + *ndeg - 1, -1, *ndeg}"),
                displacements=("e.displacement = {dispt, 1, *ndeg}", "e.displacement = {dispt + *ndeg - 1, -1, *ndeg}"))),
    Library("ents_lsdyna", ["lsdyna/usld/usld.cpp"], [], HOSTS, "*lsdyna*",
            user_element(
                "lsdyna/usld/usld.cpp",
                tangent=("{stiff + b, nlq, nlq * rows}", "{stiff + b, nlq * rows, nlq}"),
                coordinates=("e.position = {position, 1, 3}", "e.position = {position + 2, -1, 3}"),
                nodes=("e.position = {position, 1, 3}", "e.position = {position + 21, 1, -3}"),
                forces=("{force + b, nlq, dofs * nlq}", "{force + b + 2 * nlq, -nlq, dofs * nlq}"),
                history=("e.history = {hsv + b, nlq}", "e.history = {hsv + b * *nhsv, 1}"))),
    # What all share, through one of them.
    Library("ents_ansys", ["ansys/userelem/userelem.cpp", "common/element.cpp", "common/description.cpp", "common/model_cache.cpp", "common/selfcheck.cpp"], [], HOSTS,
            "*ansys*", [
                Mutant("common: tangent transposed", "common/element.cpp", "tangent[row + layout.dofs * column]", "tangent[column + layout.dofs * row]"),
                Mutant("common: node and dof swapped", "common/element.cpp", "e.residual(dof(column), node(column, c))",
                       "e.residual(dof(column), node(layout.dofs - 1 - column, c))"),
                Mutant("common: multipliers in another order", "common/element.cpp", "return i >= of_nodes ? i - of_nodes", "return i >= of_nodes ? layout.dofs - 1 - i"),
                Mutant("common: master nodes in another order", "common/element.cpp", "*out = current(i, node);",
                       "*out = current(i, node > 0 ? layout.nodes + 1 - node : 0);"),
                Mutant("common: too little history passes", "common/description.cpp", "if (e.history_size < layout.state_size)", "if (false)"),
                Mutant("a mistake is not told", "ansys/userelem/userelem.cpp", "result.outcome == Outcome::failed ? 1 : 0", "0")]),
    Library("ents_abaqus", ["abaqus/abaqus.cpp", "abaqus/uel/uel.cpp", "abaqus/uinter/uinter.cpp", "common/element.cpp", "common/model_cache.cpp",
                            "common/selfcheck.cpp"], [], HOSTS, "Uel.Selfcheck*", [
                                Mutant("selfcheck of a wrong K", "common/element.cpp", "  hand_over(e, arguments, at, answer);",
                                       "  answer.tangent[1] *= 1.01;\n  hand_over(e, arguments, at, answer);"),
                                Mutant("selfcheck of a transposed K", "common/element.cpp", "  hand_over(e, arguments, at, answer);",
                                       "  for (int i = 0; i < layout.dofs; ++i)\n    for (int j = 0; j < i; ++j)\n"
                                       "      std::swap(answer.tangent[i + layout.dofs * j], answer.tangent[j + layout.dofs * i]);\n"
                                       "  hand_over(e, arguments, at, answer);")]),
    # Temperatures
    Library("ents_abaqus", ["abaqus/abaqus.cpp", "abaqus/uel/uel.cpp", "abaqus/uinter/uinter.cpp", "common/element.cpp"], [], HEAT, "*", [
        Mutant("heat: temperature of another node", "common/element.cpp", "e.moved(e.temperature, slave_nodes + node)",
               "e.moved(e.temperature, slave_nodes + layout.nodes - 1 - node)"),
        Mutant("heat: one weight for all nodes of a slave point", "common/element.cpp", "arguments.weights[k] * e.moved(e.temperature, k)",
               "e.moved(e.temperature, k) / slave_nodes"),
        Mutant("heat: sign of the power", "common/element.cpp", "node(column, c)) = e.sign * weight(column, c) * residual[column]",
               "node(column, c)) = (dof(column) == e.temperature ? 1 : e.sign) * weight(column, c) * residual[column]"),
        Mutant("heat: dissipation of the last increment alone", "abaqus/uel/uel.cpp", "energy[plastic_energy] += dissipation",
               "energy[plastic_energy] = dissipation"),
        Mutant("heat: DDFDDT with the sign of DDFDDR", "abaqus/uinter/uinter.cpp", "ddfddt[i] = -ddfddt[i]", "ddfddt[i] = ddfddt[i]"),
        Mutant("heat: temperatures of point and face swapped", "common/point.cpp", "p.temperature[node == 0 ? 0 : 1]",
               "p.temperature[node == 0 ? 1 : 0]"),
        Mutant("heat: sign of the closing in DDFDDR", "common/point.cpp", "p.flux_by_closing[i + 2 * j] -= side(j) *", "p.flux_by_closing[i + 2 * j] -=")]),
    Library("ents_calculix", ["calculix/stiffness_store.cpp", "calculix/ccx_element.cpp", "calculix/uel_loader.cpp", "common/element.cpp"], ["-ldl"], HEAT, "HeatThroughCcx.*", [
        Mutant("heat: temperature of another component", "calculix/ccx_element.cpp", "i == e.temperature ? at : at + 1 + i", "at + i"),
        Mutant("heat: power of another node", "calculix/ccx_element.cpp", "heat.power[j] = local.residual[dofs * j + 3]",
               "heat.power[j] = local.residual[dofs * (nodes - 1 - j) + 3]"),
        Mutant("heat: slopes of forces for those of powers", "calculix/ccx_element.cpp", "tangent(dofs * i + 3, dofs * j + 3)",
               "tangent(dofs * i, dofs * j)"),
        Mutant("heat: sign of the power", "calculix/ccx_element.cpp", "+= power[node];\n    if", "-= power[node];\n    if"),
        Mutant("heat: friction rubs where nothing moves", "calculix/ccx_element.cpp", "gather(e, local, nodes, co, v, v, mt)",
               "gather(e, local, nodes, co, v, co, mt)"),
        Mutant("heat: a linear begin with old temperatures", "calculix/stiffness_store.cpp", "* (v[at] - vold[at])", "* 0"),
        Mutant("heat: elements of the step before", "calculix/stiffness_store.cpp", "  heat_flows().clear();\n", ""),
        Mutant("heat: unsymmetric without friction", "common/element.cpp", "arguments.model->symmetric_forces &&", "result.symmetric &&")]),
    # A rigid body with a reference node.
    Library("ents_abaqus", ["abaqus/abaqus.cpp", "abaqus/uel/uel.cpp", "abaqus/uinter/uinter.cpp", "common/element.cpp", "common/body.cpp"], [], HOSTS,
            "RigidBodyElement.*", [
                Mutant("body: exponential map transposed", "common/body.cpp", "map[k][j] += first * s[i], map[j][k] -= first * s[i];",
                       "map[k][j] -= first * s[i], map[j][k] += first * s[i];"),
                Mutant("body: rotation kept transposed", "common/body.cpp", "= body.pose.turn[i];", "= body.pose.turn[3 * (i % 3) + i / 3];"),
                Mutant("body: turns before the displacements", "common/element.cpp", "return std::pair(slave_nodes, i - d);",
                       "return std::pair(slave_nodes, i < 2 * d ? i : i - 2 * d);"),
                Mutant("body: another increment of rotations", "abaqus/uel/uel.cpp", "e.spin = {du + dofs - turns}", "e.spin = {u + dofs - turns}")]),
]


def build(library, tree, build_folder, output, compiler):
    """@return the mutant's path

    The archive of what adapters share may be one object, with the file that a mutant has another of: the first definition counts.
    """
    symbols = build_folder / "adapters" / (library.name + ".map")
    own = [str(tree / source) for source in library.sources + (["common/point.cpp"] if library.name == "ents_abaqus" else [])]
    subprocess.run([compiler, "-std=c++20", "-O1", "-w", "-fPIC", "-shared", "-fvisibility=hidden", "-ffp-contract=off",
                    "-I", str(ADAPTERS.parent / "abi"), *own, "-o", str(output), f"-Wl,--version-script={symbols},--allow-multiple-definition", "-L",
                    str(build_folder / "lib"), "-lents_adapter_common", "-lents_deck_reader", "-lents", *library.flags], check=True)
    return output


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="build folder, with adapters_hosts_test built")
    parser.add_argument("--compiler", default=os.environ.get("CXX", "c++"))
    parser.add_argument("--only", default="", help="libraries whose name contains this")
    arguments = parser.parse_args()
    survivors = 0
    for library in LIBRARIES:
        if arguments.only not in library.name:
            continue
        for mutant in [None] + library.mutants:  # None: the method itself must not break the tests
            with tempfile.TemporaryDirectory() as folder:
                tree = pathlib.Path(folder) / "adapters"
                shutil.copytree(ADAPTERS, tree)
                if mutant:
                    file = tree / mutant.file
                    text = file.read_text()
                    if text.count(mutant.before) != 1:
                        sys.exit(f"{mutant.file}: \"{mutant.before}\" is there {text.count(mutant.before)} times, not once")
                    file.write_text(text.replace(mutant.before, mutant.after))
                path = build(library, tree, arguments.build.resolve(), pathlib.Path(folder) / "mutant.so", arguments.compiler)
                run = subprocess.run([str(arguments.build / "bin" / library.program), f"--gtest_filter={library.tests}"],
                                     env={**os.environ, "LD_PRELOAD": str(path)}, capture_output=True, text=True, timeout=300)
                failed = len({line.split()[3] for line in run.stdout.splitlines() if line.startswith("[  FAILED  ]") and "." in line})
                good = run.returncode == 0 if mutant is None else run.returncode != 0
                survivors += not good
                how = "passes" if run.returncode == 0 else f"{failed} tests fail" if failed else "the program ends"
                print(f"{library.name:22} {mutant.what if mutant else '(none)':42} {how}{'' if good else '   <-- WRONG'}", flush=True)
    print(f"{survivors} wrong")
    return 1 if survivors else 0


if __name__ == "__main__":
    sys.exit(main())
