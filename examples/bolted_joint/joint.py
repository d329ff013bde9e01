#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A bolted joint in CalculiX: the thread as a height on a plain cylinder (ents-deck), against the same joint with its threads as a mesh.

Two steps: the shank is shortened by 0.17 mm, which tightens the joint; then the plate becomes 8 um thinner, as rough faces that settle make it.
Compared: what each turn of the nut's thread carries, the preload, its loss by the second step, nodes and seconds.
"""
import argparse
import json
import math
import os
import resource
import shutil
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
try:
    import numpy as np
except ImportError:
    print("joint.py: NumPy is missing (apt-get install python3-numpy)", file=sys.stderr)
    sys.exit(3)

import bodies
import contact
import decks
import output
from cell import Cell
from joint_parts import TURNS, Joint, compliances, teeth_stiffness, yamamoto

MESHES = {"small": bodies.Fineness(16, 4, 1, 3, 2, 2.5), "coarse": bodies.Fineness(24, 4, 1, 3, 3, 2.5), "fine": bodies.Fineness(40, 5, 1, 4, 4, 1.25)}
JOINTS = {"M20x2.5": Joint(), "M20x1.5": Joint(pitch=1.5, nut_height=10.8, threaded=(-4.5, 12.0), clearance=0.03), "thin-nut": Joint(across=24.0, grip=60.0)}
PLAIN = {"enriched": (16, 2), "finer": (24, 3)}  # columns, rings
SHARE, NODES, SECONDS = 0.05, 20, 10  # bounds: difference of a turn's share; how many times fewer nodes, less time
CLOSED = 5e-5  # mm by which the thread of the enriched model overlaps at the start, so that all of it begins in contact


def clock(command, folder, log):
    """Seconds and CPU seconds of a command; an error if it fails."""
    before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    with open(folder / log, "w") as file:
        code = subprocess.run([str(word) for word in command], cwd=folder, stdout=file, stderr=subprocess.STDOUT, check=False).returncode
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if code:
        raise ValueError(f"{Path(command[0]).name} ends with exit status {code}, see {folder / log}")
    return time.perf_counter() - begin, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def solve(ccx, folder, job):
    """Seconds, CPU seconds and iterations of the steps; an error unless both were solved to their end."""
    for old in (f"{job}.sta", f"{job}.dat", f"{job}.frd"):
        (folder / old).unlink(missing_ok=True)
    seconds, cpu = clock([ccx, job], folder, "log")
    return {"seconds": seconds, "cpu": cpu, "iterations": output.iterations(folder, job, len(decks.STEPS))}


def judged(result, name, bearings, parts):
    """Adds preload and shares; an error where contact was lost or the forces are not in equilibrium."""
    thread = [sum(step) for step in parts]
    for step, (both, own) in enumerate(zip(bearings, thread)):
        if min(parts[step]) <= 0:
            raise ValueError(f"{name}: a part of the thread has lost its contact in step {step + 1}")
        for force in both:
            if not abs(abs(force) - own) < 2e-3 * own:
                raise ValueError(f"{name}: bearing face {abs(force):.0f} N, thread {own:.0f} N in step {step + 1}")
    result["preload"], result["loss"] = thread[0], thread[0] - thread[1]
    result["parts"] = [part / thread[0] for part in parts[0]]
    result["shares"] = [sum(result["parts"][i:i + bodies.PARTS]) for i in range(0, len(parts[0]), bodies.PARTS)]
    return result


def bearings_of(forces):
    return [[step[slave][2] for slave, _ in decks.BEARINGS] for step in forces]


def explicit(name, joint, options):
    folder = options.out / name
    folder.mkdir(parents=True, exist_ok=True)
    mesh = bodies.explicit(joint, MESHES[name])
    (folder / "job.inp").write_text(decks.explicit_deck(mesh, joint))
    print(f"{name}: threads meshed, {len(mesh.nodes)} nodes; ccx ...", flush=True)
    result = {"nodes": len(mesh.nodes), **solve(options.ccx, folder, "job")}
    forces = output.contact_forces(folder, "job")
    parts = [[-step[f"PART{i + 1}"][2] for i in range(TURNS * bodies.PARTS)] for step in forces]
    (options.out / f"section_{name}.json").write_text(json.dumps(output.section(mesh, output.mises(folder, "job", len(mesh.nodes)), -1)))
    return judged(result, name, bearings_of(forces), parts)


def plain_radii(joint, depths):
    """Of the bolt and of the nut's bore."""
    return joint.root_radius + depths[0], joint.diameter / 2 + joint.clearance - depths[1]


def model_of(joint, mesh, bore, stiffness):
    """The bolt's thread over its facets; it passes through the nodes of the nut's ridge."""
    p, r3 = joint.pitch, joint.root_radius
    thread = {"type": "thread", "pitch": p, "flank_angles": [joint.half_angle] * 2, "crest": p / 8, "root": p - 2 * joint.half_width(r3), "rounding": p / 128,
              "offset": joint.nut_ridge + joint.half_width(bore)}
    raised = {"type": "constant", "value": joint.pitch_radius - mesh.facets + CLOSED}
    return {"height": {"type": "sum", "of": [thread, raised]}, "contact": {"normal": {"type": "penalty", "stiffness": stiffness}}}


def enriched(name, joint, options, shaft, bore, stiffness):
    """`stiffness`: along the normal of the flank, per length of helix."""
    folder = options.out / name
    folder.mkdir(parents=True, exist_ok=True)
    columns, rings = PLAIN[name]
    mesh = bodies.enriched(joint, columns, rings, shaft, bore)
    (folder / "joint.inp").write_text(decks.enriched_deck(mesh, joint))
    (folder / "model.json").write_text(json.dumps(model_of(joint, mesh, bore, stiffness / joint.pitch), indent=1) + "\n")
    print(f"{name}: plain cylinders, {len(mesh.nodes)} nodes; ents-deck, ccx ...", flush=True)
    shutil.rmtree(folder / "job", ignore_errors=True)
    made, _ = clock([options.build / "bin/ents-deck", "joint.inp", "--pair", "RIDGE,SHAFT", "--model", "model.json", "--coordinates", "cylinder", "z", "--points", 0,
                     "--no-pictures", "--for", "calculix", "--out", "job"], folder, "ents-deck.log")
    if "NOT ADMISSIBLE" in (folder / "ents-deck.log").read_text():
        print("  ents-deck: NOT ADMISSIBLE, because the facets meet at an angle; that the nodes stay in the middle of theirs is checked", flush=True)
    job = folder / "job"
    piece = math.hypot(2 * math.pi * joint.pitch_radius, joint.pitch) / columns  # of the helix
    ends = (mesh.helix[0], mesh.helix[-1])
    contact.set_areas(job, "joint", {n: joint.pitch * piece * (0.5 if n in ends else 1) for n in mesh.helix})
    result = {"nodes": len(mesh.nodes), **solve(options.ccx, job, "joint"), "made": made}
    x, parts = np.array(mesh.nodes), []
    for u in output.displacements(job, "joint", len(mesh.nodes)):
        # The facets meet at an angle, and the height with them: nodes have to stay near the middle of theirs.
        along = np.abs(x[:, 0] * u[:, 1] - x[:, 1] * u[:, 0])[mesh.around] / np.hypot(*x[mesh.around, :2].T)
        if 2 * along.max() > 0.1 * mesh.facets * math.tan(math.pi / columns):
            raise ValueError(f"{name}: nodes of the thread move by up to {along.max():.3g} mm towards the edges of their facets")
        by_node = contact.forces(job, "joint", x + u, options.build / "lib/libents.so.1")
        axial = [by_node[n][0][2] for n in mesh.helix]
        # The node between two parts belongs to both; the ends of the helix have half the area already.
        axial = [axial[0]] + [f for f in axial[1:-1] for f in (f / 2, f / 2)] + [axial[-1]]
        size = 2 * columns // bodies.PARTS
        parts.append([sum(axial[i:i + size]) for i in range(0, len(axial), size)])
    (options.out / f"section_{name}.json").write_text(json.dumps(output.section(mesh, output.mises(job, "joint", len(mesh.nodes)), 1)))
    return judged(result, name, bearings_of(output.contact_forces(job, "joint")), parts)


def table(results, theory):
    names = list(results)
    rows = [("share of turn", "[%]", None)] + [(f"  {i + 1}", "", lambda r, i=i: f"{100 * r['shares'][i]:.2f}") for i in range(TURNS)]
    rows += [("preload", "[kN]", lambda r: f"{r['preload'] / 1e3:.2f}"), ("lost by 8 um", "[kN]", lambda r: f"{r['loss'] / 1e3:.3f}"),
             ("nodes", "", lambda r: f"{r['nodes']}"), ("ccx", "[s]", lambda r: f"{r['seconds']:.1f}"), ("  CPU", "[s]", lambda r: f"{r['cpu']:.1f}"),
             ("ents-deck", "[s]", lambda r: f"{r['made']:.1f}" if "made" in r else ""), ("iterations", "", lambda r: " ".join(map(str, r["iterations"])))]
    lines = [" " * 20 + "".join(f"{name:>12}" for name in names) + f"{'Yamamoto':>12}"]
    for title, unit, cell in rows:
        line = f"{title:<14}{unit:<6}" + "".join(f"{cell(results[name]) if cell else '':>12}" for name in names)
        lines.append(line + (f"{100 * theory[int(title) - 1]:>12.2f}" if title.strip().isdigit() else ""))
    return "\n".join(lines)


def compared(results, names, options):
    """Text, and whether all bounds are met."""
    reference = results[names[-1]]
    lines, good = [], True
    for name in PLAIN:
        if name not in results:
            continue
        own = results[name]
        differences = [a / b - 1 for a, b in zip(own["shares"], reference["shares"])]
        worst = max(differences, key=abs)
        fewer, faster = reference["nodes"] / own["nodes"], reference["seconds"] / own["seconds"]
        lines.append(f"{name} against {names[-1]}: shares " + " ".join(f"{100 * d:+.1f}" for d in differences) + f" % (bound {100 * SHARE:g} %), preload "
                     f"{100 * (own['preload'] / reference['preload'] - 1):+.2f} %, loss {100 * (own['loss'] / reference['loss'] - 1):+.2f} %; {fewer:.1f} times fewer "
                     f"nodes, {faster:.0f} times less time in ccx, {reference['seconds'] / (own['seconds'] + own['made']):.0f} with ents-deck")
        good = good and abs(worst) <= SHARE
        if name == "enriched" and names[-1] == "fine":
            good = good and fewer >= NODES and faster >= SECONDS
    return lines, good


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
                                     epilog="exit status: 0 all bounds are met; 1 one is missed, a job was not solved or has lost its contact; 3 ccx or the build are missing")
    parser.add_argument("--build", type=Path, default=ROOT / "build", metavar="DIR", help="with bin/ents-deck, lib/libents.so.1 and calculix/ccx_ents [build]")
    parser.add_argument("--out", type=Path, default=ROOT / "out/bolted_joint", metavar="DIR", help="decks, results and the picture go there [out/bolted_joint]")
    parser.add_argument("--explicit", choices=sorted(MESHES), nargs="*", default=["coarse", "fine"], help="meshes with threads, the finest last [coarse fine]")
    parser.add_argument("--joint", choices=list(JOINTS), default="M20x2.5", help="another pitch, or another nut and a thicker plate [M20x2.5]")
    parser.add_argument("--finer", action="store_true", help="the plain cylinders with a finer mesh, too")
    parser.add_argument("--law", choices=["cell", "teeth", "hard"], default="cell",
                        help="stiffness of the contact: of one pitch (cell.py), of Yamamoto's ridges, or that of the bearing faces [cell]")
    parser.add_argument("--quick", action="store_true", help="a small mesh with threads, no bounds on nodes and time, no picture")
    options = parser.parse_args()
    options.build, options.out = options.build.resolve(), options.out.resolve()
    options.ccx = options.build / "calculix/ccx_ents"
    for needed in (options.ccx, options.build / "bin/ents-deck", options.build / "lib/libents.so.1"):
        if not needed.is_file():
            print(f"joint.py: {needed} is missing (sh examples/setup.sh; sh adapters/calculix/run.sh --only-build)", file=sys.stderr)
            return 3
    os.environ.setdefault("OMP_NUM_THREADS", "2")
    options.out.mkdir(parents=True, exist_ok=True)
    joint, names = JOINTS[options.joint], ["small"] if options.quick else options.explicit
    cell = Cell(joint, 2)
    depths = cell.plain_depths()
    shaft, bore = plain_radii(joint, depths)
    laws = {"cell": lambda: cell.contact_stiffness(depths), "teeth": lambda: teeth_stiffness(joint), "hard": lambda: decks.BEARING_STIFFNESS * joint.pitch}
    stiffness = laws[options.law]()
    theory, _ = yamamoto(joint)
    teeth = [", ".join(f"{value:.2f}" for value in side) for side in compliances(joint)]
    print(f"plain cylinders as stiff as the threaded ones in tension: bolt {2 * shaft:.3f} mm, nut {2 * bore:.3f} mm\n"
          f"contact: {stiffness / joint.pitch:.0f} N/mm^3 ({options.law})\n"
          f"Yamamoto's ridges, bending, shear, inclination and shear of the root: bolt {teeth[0]}; nut {teeth[1]}", flush=True)
    try:
        results = {name: enriched(name, joint, options, shaft, bore, stiffness) for name in list(PLAIN)[:2 if options.finer else 1]}
        results |= {name: explicit(name, joint, options) for name in names}
    except ValueError as error:
        print(f"joint.py: {error}", file=sys.stderr)
        return 1
    (options.out / "result.json").write_text(json.dumps({"yamamoto": theory, **results}, indent=1) + "\n")
    print(table(results, theory))
    if not names:
        return 0
    lines, good = compared(results, names, options)
    print("\n".join(lines))
    if not options.quick:
        subprocess.run([sys.executable, str(Path(__file__).parent / "draw.py"), str(options.out)], check=True)
    if not good:
        print("joint.py: a bound is missed", file=sys.stderr)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
