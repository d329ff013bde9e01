#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""segments.py [ENTS-HOST] [--out FOLDER]: the screw on cylinders of 16, 64 and 256 smoothed segments, over the borders of the segments.

An M20 screw under 20 kN in an elastic nut of one turn, whose nodes are 15 degrees apart: on the cylinder of 16 segments round (22.5 degrees each)
eight columns of nodes pass a border together when it has turned by 7.5 degrees, and eight others at 15. Steps of 0.1 degrees there. The exact
torque over force, of a rigid helix, does not change, so that every change from a step to the next is a jump.
"""
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE)]
import make_nut  # noqa: E402
import runs  # noqa: E402
import torque  # noqa: E402

CYLINDERS = {16: (16, 1), 64: (32, 2), 256: (64, 4)}  # segments: around, along
DEGREES = [1.5, 3, 6, 7, *(round(7.1 + 0.1 * i, 1) for i in range(9)), 10, 14, 14.6, *(round(14.7 + 0.1 * i, 1) for i in range(7))]


def scene(around, along):
    found = torque.scene(make_nut.M20, 0.1, 1)
    body = found["contact"]["master"]["rigid_body"]
    body["cylinder"].update(around=around, along=along)
    body["prescribed"] = [{"turn_z": math.radians(20), "path": [[1, 0], [21, 1]]}]  # a degree for each 1
    found["steps"]["values"] = [1, *(1 + degrees for degrees in DEGREES)]
    return found


def main():
    arguments = runs.arguments(__doc__, "screw_segments")
    ratios, quantities = {}, []
    for count, (around, along) in CYLINDERS.items():
        folder = arguments.out / f"segments_{count}"
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "nut.inp").write_text(make_nut.nut(make_nut.M20, turns=1))
        steps = runs.solve(arguments.program, scene(around, along), folder)["steps"][1:]
        found = [next((q for q in step["exact"] if q["name"] == "torque / force, tightened"), None) for step in steps]
        ratios[count] = [(degrees, q["value"] / q["exact"]) for degrees, q in zip(DEGREES, found) if q]
        jumps = [(abs(b - a), y) for (x, a), (y, b) in zip(ratios[count], ratios[count][1:]) if y - x < 0.15]
        jump, place = max(jumps)
        worst = max((abs(r - 1) for _, r in ratios[count]))
        orders = [step["increments"][-1]["residuals"][-3:] for step in steps]
        print(f"{count:>4} segments: torque / force {100 * worst:.4f} % off at most, jumps by {100 * jump:.5f} % at most (at {place} degrees); "
              f"{len(ratios[count])} steps, {max(len(step['increments']) for step in steps)} increment each, "
              f"{min(step['iterations'] for step in steps)} to {max(step['iterations'] for step in steps)} iterations, last residuals "
              + " ".join(f"{r:.0e}" for r in orders[-1]), flush=True)
        quantities.append([runs.quantity(f"torque / force, {count} segments", 1 + worst, 1.0),
                           runs.quantity(f"jump at a border, {count} segments", jump, 0.0)])
    runs.write_result(arguments.out, quantities)
    return 0


if __name__ == "__main__":
    sys.exit(main())
