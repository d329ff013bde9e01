#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""grid.py [ENTS-HOST] [--out FOLDER]: what each wire of a grid carries, against a sum of Hertzian contacts.

Wires along y, 1 mm apart, whose crests lie at two heights in turn, 1 um apart, are a height on ONE rigid quad4; an elastic layer, thick against
their distance, is pressed on them.

Exact for contacts that are narrow against the distance: wire i carries P_i per length on 2 a_i = 2 sqrt(4 P_i R_i / (pi E*)), R_i the radius of
its crest. With the wires of both kinds 2 s apart, each kind moves the surface of a half-plane at a distance x by
-2 P / (pi E*) ln |2 sin(pi x / (2 s))|, under a Hertzian pressure at its own place by -2 P / (pi E*) (ln(pi / s) + ln(a / 2) - 1 / 2). The
difference of both places is that of the heights, the sum of the loads is given.
"""
import json
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs  # noqa: E402

SPACING, AMPLITUDE, DIFFERENCE, MODULUS = 1.0, 0.05, 0.001, 1000 / (1 - 0.3**2)
WIDTH = 0.1  # of the block along the wires


def radii():
    """Of the crests of the higher and of the lower wires."""
    own, other = AMPLITUDE * (2 * math.pi / SPACING)**2, DIFFERENCE / 2 * (math.pi / SPACING)**2
    return 1 / (own + other), 1 / (own - other)


def exact(total):
    """Loads per length of a higher and of a lower wire, whose sum is `total`."""
    def moved(load, radius, other):
        half = math.sqrt(4 * load * radius / (math.pi * MODULUS))
        own = math.log(math.pi / SPACING) + math.log(half / 2) - 0.5
        return -2 / (math.pi * MODULUS) * (load * own + other * math.log(2))
    high, low = radii()
    below, above = total / 2, total * (1 - 1e-12)
    if moved(above, high, total - above) - moved(total - above, low, above) < DIFFERENCE:
        return total, 0.0  # the lower wires do not touch
    for _ in range(200):
        load = (below + above) / 2
        if moved(load, high, total - load) - moved(total - load, low, load) < DIFFERENCE:
            below = load
        else:
            above = load
    return load, total - load


def loads(step):
    """Per length of each wire from x = 0 on; the first and the last one are halves."""
    nodes, sums = step["nodes"], [0.0] * 5
    for k in range(len(nodes["pressure"])):
        sums[round(nodes["position"][3 * k] / SPACING)] += abs(nodes["force"][3 * k + 2]) / WIDTH
    return sums


def draw(folder, steps):
    angles = [t * math.pi / 80 for t in range(-40, 41)]

    def panel(axes):
        label = "exact"
        for step in steps:
            nodes, total = step["nodes"], 2 * SPACING * step["value"]
            for load, radius, places in zip(exact(total), radii(), ((0, 2, 4), (1, 3))):
                half = math.sqrt(4 * load * radius / (math.pi * MODULUS))
                peak = 2 * load / (math.pi * half)
                for x in places:
                    axes.plot([x * SPACING + half * math.sin(a) for a in angles], [peak * math.cos(a) for a in angles], color=runs.GREY, linewidth=4,
                              label=label)
                    label = None
        for step in steps:
            nodes = step["nodes"]
            row = sorted((nodes["position"][3 * k], p) for k, p in enumerate(nodes["pressure"]) if nodes["position"][3 * k + 1] < 1e-3)
            axes.plot(*zip(*row), linewidth=1.3, label=f"{step['value']:g} MPa")
        axes.set(xlabel="place across the wires [mm]", ylabel="pressure [MPa]", xlim=(0.9, 2.1))
        axes.set_ylim(bottom=0)
        runs.legend_above(axes)

    runs.draw(folder / "grid.png", (1000, 480), panel)


def main():
    arguments = runs.arguments(__doc__, "grid")
    result = runs.solve(arguments.program, HERE / "scene.json", arguments.out / "run", "--nodes")
    steps = []
    print(f"{'mean pressure [MPa]':>20}{'higher wire [N/mm]':>20}{'exact':>9}{'lower wire':>13}{'exact':>9}")
    for step in result["steps"]:
        wires = loads(step)
        high, low = exact(2 * SPACING * step["value"])
        print(f"{step['value']:>20.2f}{wires[2]:>20.4f}{high:>9.4f}{wires[1]:>13.4f}{low:>9.4f}")
        steps.append([runs.quantity("higher wire", x, high) for x in (2 * wires[0], wires[2], 2 * wires[4])]
                     + [runs.quantity("lower wire", x, low) for x in (wires[1], wires[3])])
    runs.write_result(arguments.out, steps)
    draw(arguments.out, result["steps"])
    return 0


if __name__ == "__main__":
    sys.exit(main())
