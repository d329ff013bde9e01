#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""fold.py [ENTS-HOST] [--out FOLDER]: a fold whose legs are pressed together, against its upper half on a rigid plane of symmetry.

The inner faces of the legs are slave and master. By symmetry the half presses on the plane with the same force, if its penalty is twice as stiff.
"""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs  # noqa: E402


def draw(folder, steps):
    def panel(axes, title, step):
        points = runs.vtu_points(folder / "whole", max(step, 1), "bulk", displaced=step > 0)
        quads = runs.vtu_values(folder / "whole", max(step, 1), "bulk", "connectivity", "q")
        for i in range(0, len(quads), 4):
            axes.plot(*list(zip(*(points[n] for n in (*quads[i:i + 4], quads[i]))))[:2], color=runs.BLUE, linewidth=1)
        axes.set(title=title, xlim=(-0.7, 4.2), ylim=(-0.65, 0.65), aspect="equal")
        axes.axis("off")

    runs.draw(folder / "fold.png", (1200, 240), lambda axes: panel(axes, "as it is", 0), lambda axes: panel(axes, "half way", len(steps) // 2),
              lambda axes: panel(axes, "pressed", len(steps)))


def main():
    arguments = runs.arguments(__doc__, "fold")
    whole = runs.solve(arguments.program, HERE / "scene.json", arguments.out / "whole")
    half = runs.solve(arguments.program, HERE / "scene.json", arguments.out / "half", "--variant", "half")
    steps = []
    print(f"{'load factor':>12}{'force [N]':>14}{'half on a plane':>18}")
    for a, b in zip(whole["steps"], half["steps"]):
        force, right = -a["contact_force"][1], -b["contact_force"][1]
        if right > 0:
            steps.append([runs.quantity("force", force, right), runs.quantity("peak pressure", a["peak_pressure"], b["peak_pressure"])])
            print(f"{a['value']:>12g}{force:>14.7f}{right:>18.7f}")
    if not steps:
        sys.exit("the legs do not touch")
    runs.write_result(arguments.out, steps)
    draw(arguments.out, whole["steps"])
    return 0


if __name__ == "__main__":
    sys.exit(main())
