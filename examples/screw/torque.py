#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""torque.py [ENTS-HOST]: torque over preload of five threads at four coefficients of friction, tightened and loosened, and the coefficient below
which the load turns the screw, against the exact values of a rigid helix. Exit status 1: one differs by more than 1 %.

Each number is a run of ents-lab: the preload, then two small turns, until the whole flank slips. All in about five minutes.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import make_nut
from make_nut import Thread

THREADS = [Thread("M8 x 1.25", 8, 1.25), Thread("M10 x 1.5", 10, 1.5), Thread("M12 x 1.75", 12, 1.75), make_nut.M20,
           Thread("Tr20 x 4", 20, 4, 15, 0.366, 0.366)]
FRICTION = (0.0, 0.05, 0.10, 0.15)
BOUND = 0.01


def scene(thread, mu, sense):
    friction = {"type": "coulomb", "coefficient": mu, "stiffness": 3e5} if mu else None
    turns = {"turn_z": sense * 0.05, "path": [[1, 0], [2, 1]]}
    return {
        "dimension": 3, "materials": {"steel": {"law": "linear_elastic", "young": 210000, "poisson": 0.3}},
        "parts": [{"name": "nut", "material": "steel", "deck": "nut.inp"}],
        "supports": [{"nodes": "nut.OUTER", "x": 0, "y": 0, "z": 0}],
        "contact": {
            "slave": "nut.FLANK",
            "master": {"rigid_body": {
                "cylinder": {"radius": thread.pitch_radius, "from": -2 * thread.pitch, "to": 5 * thread.pitch, "around": 16, "along": 1},
                "prescribed": [turns], "loads": [{"z": -50 * thread.diameter ** 2, "path": [[0, 0], [1, 1]]}]}},
            "model": {"segment": "bspline16", "height": thread.height(),
                      "contact": {"normal": {"type": "penalty", "stiffness": 1e6}, "friction": friction}}},
        "steps": {"control": "load_factor", "values": [1, 1.1, 1.2]}, "solver": {"extrapolate": True},
        "exact": {"type": "screw", "lead": thread.pitch, "flank_angle": thread.half_angle, "coefficient": mu}}


def solve(program, folder, thread, mu, sense):
    """(torque / force, exact, mean radius) of the last step."""
    (folder / "scene.json").write_text(json.dumps(scene(thread, mu, sense)))
    out = folder / "out"
    done = subprocess.run([program, "run", folder / "scene.json", "--out", out], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"torque.py: {thread.name}, friction {mu}: {done.stderr}")
    step = json.loads((out / "result.json").read_text())["steps"][-1]
    found = {q["name"].split(",")[0]: q for q in step["exact"]}
    radius = found["mean radius of contact"]["value"]
    if "torque / force" in found:
        return found["torque / force"]["value"], found["torque / force"]["exact"], radius
    rise = thread.pitch / (2 * math.pi * radius)  # without friction nothing slips
    return (-1 if sense > 0 else 1) * step["moment"][2] / step["contact_force"][2], radius * rise * sense, radius


def main():
    if len(sys.argv) > 2 or sys.argv[1:] in (["-h"], ["--help"]):
        sys.exit(__doc__)
    program = sys.argv[1] if len(sys.argv) > 1 else str(pathlib.Path(__file__).resolve().parents[2] / "build/bin/ents-lab")
    worst = 0.0
    print(f"{'thread':<12}{'friction':>9}  {'tightened':>10}{'exact':>9}{'error':>9}  {'loosened':>10}{'exact':>9}{'error':>9}")
    for thread in THREADS:
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "nut.inp").write_text(make_nut.nut(thread, turns=2))
            loose = []
            for mu in FRICTION:
                cells = [f"{thread.name:<12}{mu:>9.2f}"]
                for sense in (1, -1):
                    value, exact, radius = solve(program, folder, thread, mu, sense)
                    error = (value - exact) / abs(exact)
                    worst = max(worst, abs(error))
                    cells.append(f"{value:>10.4f}{exact:>9.4f}{100 * error:>8.2f} %")
                    if sense < 0 and mu:
                        loose.append((mu, value, radius))
                print("  ".join(cells), flush=True)
            # Where loosening takes no torque: a straight line between the runs on both sides, at whose radius the exact one is.
            (a, low, radius), (b, high, _) = [run for run in loose if run[0] <= 0.1]
            found = a - low * (b - a) / (high - low)
            angle = math.atan(thread.pitch / (2 * math.pi * radius))
            locks = math.tan(angle) * math.cos(math.atan(thread.tan * math.cos(angle)))
            worst = max(worst, abs(found / locks - 1))
            print(f"{thread.name:<12} locks itself from a friction of {found:.5f} on, exact {locks:.5f} ({100 * (found / locks - 1):+.2f} %)")
    print(f"largest difference {100 * worst:.2f} % (bound {100 * BOUND:g} %)")
    return int(not worst <= BOUND)


if __name__ == "__main__":
    sys.exit(main())
