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
    def panel(axes):
        for rows in steps:
            load = abs(sum(row[2] for row in rows)) / PIECE
            half, peak = hertz(load)
            axes.plot([d for d, p, _ in rows if p > 0], [p for _, p, _ in rows if p > 0], ".", markersize=5, label=f"{load:.1f} N per mm")
            angles = [math.pi * k / 200 for k in range(201)]
            axes.plot([-half * math.cos(a) for a in angles], [peak * math.sin(a) for a in angles], color=runs.DARK, linewidth=1.5,
                      label="Hertz" if rows is steps[-1] else None)
        axes.set(xlabel="place across the fibre [mm]", ylabel="pressure [MPa]", xlim=(-0.4, 0.4))
        axes.set_ylim(bottom=0)
        axes.legend(loc="upper right")

    runs.draw(folder / "fibre.png", (1000, 480), panel)


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
