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
    plots = []
    for panel, step in enumerate((0, len(steps) // 2, len(steps))):
        points = runs.vtu_points(folder / "whole", max(step, 1), "bulk", displaced=step > 0)
        quads = runs.vtu_values(folder / "whole", max(step, 1), "bulk", "connectivity", "q")
        loops = [[points[n] for n in (*quads[i:i + 4], quads[i])] for i in range(0, len(quads), 4)]
        (folder / f"mesh{panel}.dat").write_text("\n".join("".join(f"{p[0]} {p[1]}\n" for p in loop) for loop in loops))
        plots.append(f'set title "{["as it is", "half way", "pressed"][panel]}"\nplot "{folder}/mesh{panel}.dat" with lines lc rgb "#0072b2" notitle')
    script = f"""set terminal pngcairo size 1200,240 font "sans,12" rounded
set output "{folder}/fold.png"
set multiplot layout 1,3
set size ratio -1; set xrange [-0.7:4.2]; set yrange [-0.65:0.65]; unset border; unset tics
""" + "\n".join(plots) + "\n"
    runs.draw(script, folder / "fold.png")


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
