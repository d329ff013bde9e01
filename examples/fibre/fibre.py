#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""fibre.py [ENTS-HOST] [--out FOLDER]: a fibre across a flat segment, against Hertz's line contact.

The fibre, of radius 2 mm, is a height on ONE rigid quad4; it lies at 60 degrees to the rows of slave nodes. The load per length of the fibre is
measured in the middle of the block, as the sum of the nodal forces on a piece of it.

Exact: a line contact of half-width a = sqrt(4 P R / (pi E*)) and peak pressure 2 P / (pi a), P the load per length.
"""
import json
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs  # noqa: E402

RADIUS, MODULUS, PIECE = 2.0, 1000 / (1 - 0.3**2), 2.0  # mm, MPa; length of the fibre that is looked at, mm
ACROSS, ALONG = (math.sqrt(0.75), -0.5), (0.5, math.sqrt(0.75))


def hertz(load):
    """(half-width, peak pressure)."""
    half = math.sqrt(4 * load * RADIUS / (math.pi * MODULUS))
    return half, 2 * load / (math.pi * half)


def middle(step):
    """[(place across the fibre, pressure, force)] of the nodes beside the piece."""
    nodes, rows = step["nodes"], []
    for k, pressure in enumerate(nodes["pressure"]):
        x, y = nodes["position"][3 * k:3 * k + 2]
        if abs(x * ALONG[0] + y * ALONG[1]) < PIECE / 2:
            rows.append((x * ACROSS[0] + y * ACROSS[1], pressure, nodes["force"][3 * k + 2]))
    return rows


def half_width(rows):
    """Where the pressure vanishes: its square is a straight line over the square of the place; least squares over the outer half."""
    widest = max(abs(d) for d, p, _ in rows if p > 0)
    points = [(d * d, p * p) for d, p, _ in rows if p > 0 and widest / 2 < abs(d) < 0.95 * widest]
    n, sx, sy = len(points), sum(x for x, _ in points), sum(y for _, y in points)
    slope = (n * sum(x * y for x, y in points) - sx * sy) / (n * sum(x * x for x, _ in points) - sx * sx)
    return math.sqrt((sx - sy / slope) / n)


def draw(folder, steps):
    plots, curves = [], []
    for i, rows in enumerate(steps):
        load = abs(sum(row[2] for row in rows)) / PIECE
        half, peak = hertz(load)
        (folder / f"step{i}.dat").write_text("".join(f"{d} {p}\n" for d, p, _ in rows if p > 0))
        plots.append(f'"{folder}/step{i}.dat" with points pt 7 ps 0.5 lc {i + 1} title "{load:.1f} N per mm"')
        curves.append(f'abs(x) < {half} ? {peak} * sqrt(1 - x**2 / {half}**2) : 0 with lines lw 1.5 lc rgb "#333333" '
                      + ("notitle" if curves else 'title "Hertz"'))
    script = f"""set terminal pngcairo size 1000,480 font "sans,12" rounded
set output "{folder}/fibre.png"
set xlabel "place across the fibre [mm]"; set ylabel "pressure [MPa]"; set grid lc rgb "#dddddd"; set samples 1000; set xrange [-0.4:0.4]
plot {", ".join(plots + curves)}
"""
    runs.draw(script, folder / "fibre.png")


def main():
    arguments = runs.arguments(__doc__, "fibre")
    result = runs.solve(arguments.program, HERE / "scene.json", arguments.out / "run", "--nodes")
    rows = [middle(step) for step in result["steps"]]
    steps = []
    print(f"{'load [N/mm]':>12}{'peak [MPa]':>12}{'Hertz':>10}{'half-width [mm]':>18}{'Hertz':>10}")
    for nodes in rows:
        load = abs(sum(row[2] for row in nodes)) / PIECE
        half, peak = hertz(load)
        found = (half_width(nodes), max(p for _, p, _ in nodes))
        print(f"{load:>12.3f}{found[1]:>12.3f}{peak:>10.3f}{found[0]:>18.4f}{half:>10.4f}")
        steps.append([runs.quantity("peak pressure", found[1], peak), runs.quantity("half-width", found[0], half)])
    runs.write_result(arguments.out, steps)
    draw(arguments.out, rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
