#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""draw.py FOLDER: FOLDER/screw.png of a run with --nodes, by gnuplot: the 16 segments of the screw, the screw itself, and the pressure on the
flank of the nut after the last step that was solved."""
import json
import math
import pathlib
import subprocess
import sys

from make_nut import M20


def radius(thread, angle, z):
    """Of the screw without its rounded corners."""
    half = thread.pitch / 2
    place = (z - thread.pitch * angle / (2 * math.pi) + half) % thread.pitch - half
    low = thread.pitch_radius - (0.5 - thread.root) * thread.pitch / (2 * thread.tan)
    return max(low, thread.diameter / 2 - max(abs(place) - thread.crest * half, 0) / thread.tan)


def grid(rows, columns, low, high, at):
    lines = []
    for j in range(rows + 1):
        z = low + (high - low) * j / rows
        for i in range(columns + 1):
            a = 2 * math.pi * i / columns
            r = at(a, z)
            lines.append(f"{r * math.cos(a):.5f} {r * math.sin(a):.5f} {z:.5f} {r:.5f}")
        lines.append("")
    return "\n".join(lines) + "\n"


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        print(__doc__)
        return 0 if sys.argv[1:] in (["-h"], ["--help"]) else 2
    folder = pathlib.Path(sys.argv[1])
    step = json.loads((folder / "result.json").read_text())["steps"][-1]
    if "nodes" not in step:
        sys.exit(f"draw.py: {folder}/result.json has no nodes: run ents-host with --nodes")
    x, p = step["nodes"]["position"], step["nodes"]["pressure"]
    (folder / "screw.dat").write_text(grid(330, 90, -4, 14, lambda a, z: radius(M20, a, z)))
    (folder / "segments.dat").write_text(grid(1, 16, -4, 14, lambda a, z: M20.pitch_radius))
    # Points that the screw does not hide, seen from the front, a little away from it.
    shown = [k for k in range(len(p)) if p[k] > 0]
    (folder / "flank.dat").write_text("".join(f"{x[3 * k]} {x[3 * k + 1]} {x[3 * k + 2]} {p[k]}\n" for k in shown))
    script = f"""set terminal pngcairo size 1200,430 font "sans,12" rounded
set output "{folder}/screw.png"
set multiplot layout 1,3
set view 66,25,1.5,1; set view equal xyz; unset border; unset tics; unset key; set hidden3d
set xrange [-11:11]; set yrange [-11:11]; set zrange [-5:15]
set title "16 segments of the mesh"
splot "{folder}/segments.dat" using 1:2:3 with lines lc rgb "#555555" lw 1.5
unset hidden3d
set pm3d depthorder lighting primary 0.4 specular 0.3; set palette defined (0 "#6d7680", 1 "#c9ced4"); unset colorbox
set title "with the thread as a height"
splot "{folder}/screw.dat" using 1:2:3:4 with pm3d
unset pm3d
set palette defined (0 "#2c7bb6", 0.5 "#ffffbf", 1 "#d7191c"); set colorbox user origin 0.953,0.25 size 0.01,0.5; set cbtics offset -0.9,0; set cbrange [0:*]
set title "pressure on the flank of the nut [MPa]"
splot "{folder}/flank.dat" using 1:2:3:4 with points pt 7 ps 0.8 lc palette
"""
    subprocess.run(["gnuplot"], input=script, text=True, check=True)
    print(folder / "screw.png")
    return 0


if __name__ == "__main__":
    sys.exit(main())
