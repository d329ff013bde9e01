#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The block problem: what its hosts share. A module of getfem_block.py and dolfinx_block.py, and a program for hosts that read no scenes:

usage: block.py model SCENE [VARIANT] > ents.json
       block.py compare OUTPUT RESULT
       block.py row NAME OUTPUT RESULT [BOUND]

model    the contact model of a scene of ents-lab
row      the same as a row of a table; other hosts print fewer digits: BOUND, relative to the largest force
compare  OUTPUT is what a host printed: lines with "iterations N" and "force on the support FX FY", one a step; RESULT is result.json of
         ents-lab for the same scene

exit status: 0 done; 1 other forces; 2 wrong command line"""
import argparse
import json
import pathlib
import re
import sys

# Both programs stop when |r| <= 1e-12 |reactions|; what is left is a load on the 132 free dofs, which by statics the two supports share: it
# moves a force on a support by sqrt(132) * 1e-12 = 1.2e-11 at most, in each program.
SAME_FORCE = 2.4e-11


def arguments(description):
    """The command line of getfem_block.py and dolfinx_block.py."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", nargs="?", default=pathlib.Path(__file__).with_name("block.json"), type=pathlib.Path)
    parser.add_argument("--variant")
    parser.add_argument("--compare", type=pathlib.Path)
    parser.add_argument("--refine", type=int, default=1)
    given = parser.parse_args()
    if given.compare and given.refine != 1:
        parser.error("--compare is for the scene's own meshes: leave out --refine")
    return given


def merged(value, patch):
    """A JSON merge patch (RFC 7386), which is what a variant is."""
    if not isinstance(patch, dict):
        return patch
    changed = {key: merged(value.get(key) if isinstance(value, dict) else None, new) for key, new in patch.items() if new is not None}
    return {**{key: old for key, old in (value if isinstance(value, dict) else {}).items() if key not in patch}, **changed}


def variant_of(file, name):
    scene = json.loads(pathlib.Path(file).read_text())
    if name is None:
        return scene
    if name not in scene.get("variants", {}):
        sys.exit(f"{file}: no variant {name}; there are {', '.join(scene.get('variants', {})) or 'none'}")
    return merged(scene, scene["variants"][name])


def largest_difference(forces, steps):
    """Forces [step][2] on the support against the steps of ents-lab, relative to the largest force."""
    if len(forces) != len(steps) or not steps:
        sys.exit(f"{len(forces)} steps here, {len(steps)} in ents-lab")
    # ents-lab tells the force on the slave; by balance that on the support is its negative.
    difference = max(abs(a + b) for mine, step in zip(forces, steps) for a, b in zip(mine, step["contact_force"]))
    return difference / max(abs(b) for step in steps for b in step["contact_force"])


def compare(forces, iterations, result, report=print):
    """forces [step][2] on the support, iterations [step] against result.json of ents-lab; SystemExit if they differ."""
    steps = json.loads(pathlib.Path(result).read_text())["steps"]
    difference = largest_difference(forces, steps)
    report(f"largest difference from ents-lab: {difference:.1e} of the largest force, bound {SAME_FORCE:.1e}; iterations {sum(iterations)}, "
           f"there {sum(step['iterations'] for step in steps)}")
    if not difference <= SAME_FORCE:
        sys.exit("the forces differ")


def printed(file):
    """Forces [step][2] and iterations [step] in a host's output."""
    number = r"[-+]?[0-9.]+(?:[eE][-+]?[0-9]+)?"
    found = re.findall(rf"iterations +([0-9]+).*force on the support +({number}) +({number})", pathlib.Path(file).read_text())
    return [(float(x), float(y)) for _, x, y in found], [int(n) for n, _, _ in found]


def main():
    if sys.argv[1:] in (["-h"], ["--help"]):
        print(__doc__)
        return
    if len(sys.argv) in (3, 4) and sys.argv[1] == "model":
        print(json.dumps(variant_of(sys.argv[2], sys.argv[3] if len(sys.argv) == 4 else None)["contact"]["model"], indent=1))
        return
    if len(sys.argv) in (5, 6) and sys.argv[1] == "row":
        name, output, result = sys.argv[2:5]
        bound = float(sys.argv[5]) if len(sys.argv) == 6 else SAME_FORCE
        forces, iterations = printed(output)
        difference = largest_difference(forces, json.loads(pathlib.Path(result).read_text())["steps"])
        digits = 15 if bound == SAME_FORCE else 7
        print(f"| {name} | {' '.join(f'{x:.{digits}g}' for x in forces[-1])} | {difference:.1e} | {' '.join(map(str, iterations))} |", flush=True)
        if not difference <= bound:
            sys.exit(f"{name}: the forces differ by more than {bound:.1e}")
        return
    if len(sys.argv) != 4 or sys.argv[1] != "compare":
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    forces, iterations = printed(sys.argv[2])
    compare(forces, iterations, sys.argv[3])


if __name__ == "__main__":
    main()
