#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""fold.py [ENTS-HOST] [--out FOLDER]: a fold whose legs are pressed together, against its upper half on a rigid plane of symmetry.

The inner faces of the legs are slave and master, or the whole boundary is both (variant whole). By symmetry the half presses on the plane with the
same force, if its penalty is twice as stiff.
"""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs  # noqa: E402


def draw(folder, steps):
    """The surface against itself: its mesh, and the pressure on the points in contact."""
    run = folder / "surface"

    def panel(axes, title, step):
        points = runs.vtu_points(run, max(step, 1), "bulk", displaced=step > 0)
        quads = runs.vtu_values(run, max(step, 1), "bulk", "connectivity", "q")
        for i in range(0, len(quads), 4):
            axes.plot(*list(zip(*(points[n] for n in (*quads[i:i + 4], quads[i]))))[:2], color=runs.BLUE, linewidth=1)
        if step == len(steps):
            pressed = [(x, p) for x, p in zip(runs.vtu_points(run, step, "slave"), runs.vtu_values(run, step, "slave", "pressure")) if p > 0]
            axes.scatter([x[0] for x, _ in pressed], [x[1] for x, _ in pressed], s=[150 * p for _, p in pressed], color=runs.ORANGE, zorder=3)
        axes.set(title=title, xlim=(-0.7, 4.2), ylim=(-0.65, 0.65), aspect="equal")
        axes.axis("off")

    runs.draw(folder / "fold.png", (1200, 240), lambda axes: panel(axes, "as it is", 0), lambda axes: panel(axes, "half way", len(steps) // 2),
              lambda axes: panel(axes, "pressed: all faces against all", len(steps)))


def carried(folder, step):
    """Force across the legs [N]: of a surface against itself the sum of the pressures, each with half of its area on both sides."""
    pressure, area, normal = (runs.vtu_values(folder, step, "slave", name) for name in ("pressure", "area", "normal"))
    return sum(p * a * abs(normal[3 * k + 1]) for k, (p, a) in enumerate(zip(pressure, area)) if p > 0)


def main():
    arguments = runs.arguments(__doc__, "fold")
    solve = lambda name, *options: runs.solve(arguments.program, HERE / "scene.json", arguments.out / name, *options)
    sets, half = solve("whole"), solve("half", "--variant", "half")
    surface, points = solve("surface", "--variant", "whole"), solve("points", "--variant", "half_points")
    steps = []
    print(f"{'load factor':>12}{'two sets [N]':>14}{'half, nodes':>14}{'one surface':>14}{'half, points':>14}")
    for k, (a, b, c, e) in enumerate(zip(sets["steps"], half["steps"], surface["steps"], points["steps"]), 1):
        force, right, exact = -a["contact_force"][1], -b["contact_force"][1], -e["contact_force"][1]
        if right > 0:
            own = carried(arguments.out / "surface", k)
            steps.append([runs.quantity("force", force, right), runs.quantity("peak pressure", a["peak_pressure"], b["peak_pressure"]),
                          runs.quantity("force, one surface", own, exact),
                          runs.quantity("peak pressure, one surface", c["peak_pressure"], e["peak_pressure"])])
            print(f"{a['value']:>12g}{force:>14.7f}{right:>14.7f}{own:>14.7f}{exact:>14.7f}")
    if not steps:
        sys.exit("the legs do not touch")
    runs.write_result(arguments.out, steps)
    draw(arguments.out, surface["steps"])
    return 0


if __name__ == "__main__":
    sys.exit(main())
