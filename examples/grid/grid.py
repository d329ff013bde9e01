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
    plots = []
    for i, step in enumerate(steps):
        nodes, total = step["nodes"], 2 * SPACING * step["value"]
        row = sorted((nodes["position"][3 * k], p) for k, p in enumerate(nodes["pressure"]) if nodes["position"][3 * k + 1] < 1e-3)
        (folder / f"step{i}.dat").write_text("".join(f"{x} {p}\n" for x, p in row))
        hertz = []
        for load, radius, places in zip(exact(total), radii(), ((0, 2, 4), (1, 3))):
            half = math.sqrt(4 * load * radius / (math.pi * MODULUS))
            hertz += [(x * SPACING, half, 2 * load / (math.pi * half)) for x in places]
        (folder / f"hertz{i}.dat").write_text("\n\n".join("".join(
            f"{x + a * math.sin(t * math.pi / 80)} {p * math.cos(t * math.pi / 80)}\n" for t in range(-40, 41)) for x, a, p in hertz))
        plots.append(f'"{folder}/hertz{i}.dat" with lines lw 4 lc rgb "#bbbbbb" ' + ('title "exact"' if i == 0 else "notitle"))
        plots.append(f'"{folder}/step{i}.dat" with lines lw 1.3 lc {i + 1} title "{step["value"]:g} MPa"')
    script = f"""set terminal pngcairo size 1000,480 font "sans,12" rounded
set output "{folder}/grid.png"
set xlabel "place across the wires [mm]"; set ylabel "pressure [MPa]"; set grid lc rgb "#dddddd"; set key above
set xrange [0.9:2.1]
plot {", ".join(plots)}
"""
    runs.draw(script, folder / "grid.png")


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
