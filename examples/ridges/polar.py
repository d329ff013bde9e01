#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""polar.py [ENTS-HOST] [--out FOLDER]: friction of a ridged surface in 24 directions, against the exact values, as a table and a polar plot.

A rigid plane of ONE quad4 segment carries ridges as a height: flanks that rise by 10 degrees along x, and fall steeply behind. An elastic block
lies on the flanks under a constant load; the plane is drawn away below it in each direction. What slides up a flank has to be lifted as well:
the resistance depends on the direction, and has a part across it, although the friction on the flank, 0.2, does not.
With "enrichment": "gap_only" the same height changes the gap alone: the normal is that of the plane, and so is the friction.

Exact: a point on a plane with the unit normal n, pressed by N, slides along the tangent w of its way on the flank: the force on it is N (n - mu w).
"""
import json
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve()
sys.path.insert(0, str(HERE.parents[1]))
import runs  # noqa: E402

ANGLE, MU = 10.0, 0.2


def exact(direction):
    """(along, side) force of the ridges over the normal load, on the slider that moves in this direction [degrees]."""
    a, d = math.radians(ANGLE), math.radians(direction)
    n = (-math.sin(a), 0.0, math.cos(a))  # the flank rises along x
    way = (math.cos(d), math.sin(d), math.tan(a) * math.cos(d))
    size = math.sqrt(sum(x * x for x in way))
    force = [n[i] - MU * way[i] / size for i in range(3)]
    along = -(force[0] * math.cos(d) + force[1] * math.sin(d)) / force[2]
    side = (-force[0] * math.sin(d) + force[1] * math.cos(d)) / force[2]
    return along, side


def scene(direction, enrichment):
    s = json.loads((HERE.parent / "scene.json").read_text())
    s["contact"]["enrichment"] = enrichment
    d = math.radians(direction)
    # the plane moves against the slider
    s["contact"]["master"]["rigid_body"]["prescribed"] = [
        {"x": -0.2 * math.cos(d), "y": -0.2 * math.sin(d), "path": [[1, 0], [2, 1]]}]
    return s


def solve(program, folder, direction, enrichment="full"):
    # force of the slider on the plane
    x, y, z = runs.solve(program, scene(direction, enrichment), folder)["steps"][-1]["contact_force"]
    d = math.radians(direction)
    return -(x * math.cos(d) + y * math.sin(d)) / z, -(-x * math.sin(d) + y * math.cos(d)) / -z


def draw(rows, folder):
    closed = rows + rows[:1]
    angles, degrees = [math.radians(row[0]) for row in closed], range(361)

    def panel(axes, component, color, title, largest):
        axes.plot([math.radians(k) for k in degrees], [abs(exact(k)[component]) for k in degrees], color=runs.DARK, linewidth=2, label="exact")
        axes.plot(angles, [abs(row[1 + component]) for row in closed], "o", color=color, markersize=7, label="ONE enriched quad4")
        axes.plot(angles, [abs(row[5 + component]) for row in closed], "o", color="#777777", fillstyle="none", markersize=6, label="gap only")
        axes.set(title=title, rlim=(0, largest), xticks=[math.radians(30 * k) for k in range(12)], xticklabels=[])
        axes.spines["polar"].set_visible(False)
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, 0), ncols=3)

    picture = folder / "polar.png"
    runs.draw(picture, (1100, 640), lambda axes: panel(axes, 0, runs.BLUE, "resistance / normal load, by direction of motion", 0.45),
              lambda axes: panel(axes, 1, runs.ORANGE, "size of the side force / normal load", 0.25), projection="polar")


def main():
    arguments = runs.arguments(__doc__, "ridges")
    rows, steps, worst = [], [], 0.0
    print(f"{'direction':>9}  {'along':>9}{'exact':>10}{'gap only':>10}  {'side':>9}{'exact':>10}{'gap only':>10}")
    for direction in range(0, 360, 15):
        along, side = solve(arguments.program, arguments.out / str(direction), direction)
        exact_along, exact_side = exact(direction)
        size = math.hypot(exact_along, exact_side)
        steps.append([runs.quantity("difference of the force", math.hypot(along - exact_along, side - exact_side) / size, 0.0)])
        worst = max(worst, steps[-1][0]["value"])
        plain, plain_side = solve(arguments.program, arguments.out / f"{direction}_gap_only", direction, "gap_only")
        rows.append((direction, along, side, exact_along, exact_side, plain, plain_side))
        print(f"{direction:>9}  {along:>9.6f}{exact_along:>10.6f}{plain:>10.6f}  {side:>9.6f}{exact_side:>10.6f}{plain_side:>10.6f}", flush=True)
    draw(rows, arguments.out)
    runs.write_result(arguments.out, steps)
    print(f"largest difference of a force {100 * worst:.3f} %")
    return 0


if __name__ == "__main__":
    sys.exit(main())
