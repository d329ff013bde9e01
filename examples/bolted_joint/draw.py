#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""draw.py FOLDER: FOLDER/joint.png of a run of joint.py, by gnuplot: half sections of both meshes, and what each quarter turn of the thread carries."""
import json
import pathlib
import subprocess
import sys

from bodies import PARTS
from joint_parts import TURNS, Joint

GAP = 1.0  # between the halves of the picture


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        print(__doc__)
        return 0 if sys.argv[1:] in (["-h"], ["--help"]) else 2
    folder = pathlib.Path(sys.argv[1])
    result = json.loads((folder / "result.json").read_text())
    threads = [name for name in result if name in ("small", "coarse", "fine")][-1]
    own, other = result["enriched"], result[threads]
    (folder / "quarters.dat").write_text("".join(f"{(i + 0.5) / PARTS} {100 * PARTS * a} {100 * PARTS * b}\n" for i, (a, b) in enumerate(zip(own["parts"], other["parts"]))))
    (folder / "turns.dat").write_text("".join(f"{i + 0.5} {100 * own['shares'][i]} {100 * other['shares'][i]} {100 * result['yamamoto'][i]}\n" for i in range(TURNS)))
    joint, model = Joint(), json.loads((folder / "enriched/model.json").read_text())["height"]["of"][0]
    lines = []
    for k in range(2751):  # the thread on the plain bolt at the section
        z = joint.threaded[0] + 0.01 * k
        place = (z - model["offset"] + joint.pitch / 2) % joint.pitch - joint.pitch / 2
        lines.append(f"{GAP + min(joint.diameter / 2, max(joint.root_radius, joint.pitch_radius + (joint.pitch / 4 - abs(place)) / joint.tan)):.5g} {min(z, joint.threaded[1]):.5g} 0")
    (folder / "thread.dat").write_text("\n".join(lines) + "\n")
    script = f"""set terminal pngcairo size 1400,640 font "sans,12" rounded
set output "{folder}/joint.png"
set multiplot
set origin 0,0; set size 0.56,1
set lmargin at screen 0.01; set rmargin at screen 0.54; set tmargin at screen 0.88; set bmargin at screen 0.03
unset border; unset tics; set xrange [-21:21]; set yrange [-11.3:20.8]
set palette defined (0 "#2c5f8a", 0.25 "#8fbcd9", 0.5 "#f7f4dc", 0.75 "#e8923d", 1 "#b0201c"); set cbrange [0:500]
set colorbox user origin 0.555,0.1 size 0.01,0.7; set cbtics 200 nomirror; set label 4 "von Mises\\n[MPa]" at screen 0.552,0.87 left
set title "threads as a mesh: {other['nodes']} nodes, {other['seconds']:.0f} s      |      plain cylinders: {own['nodes']} nodes, {own['seconds']:.1f} s" offset 0,0.3
set label 1 "nut" at -13.5,15.5 center front; set label 2 "plate" at -17,-9 center front; set label 3 "bolt" at -3,19 center front
set view map; set pm3d corners2color mean
splot "{folder}/section_{threads}.dat" using 1:2:3 with pm3d notitle, "" using 1:2:(0) with lines lc rgb "#404040" lw 0.3 notitle, \\
      "{folder}/section_enriched.dat" using ($1 + {GAP}):2:3 with pm3d notitle, "" using ($1 + {GAP}):2:(0) with lines lc rgb "#404040" lw 0.6 notitle, \\
      "{folder}/thread.dat" using 1:2:(0) with lines lc rgb "#b0201c" lw 1.6 notitle
unset pm3d
unset label 1; unset label 2; unset label 3; unset label 4; unset colorbox
set lmargin at screen 0.665; set rmargin at screen 0.985; set tmargin at screen 0.88; set bmargin at screen 0.12
set border 3; set xtics nomirror 1; set ytics nomirror; set xrange [0:{TURNS}]; set yrange [0:32]; set grid y lc rgb "#dddddd"
set title "load along the nut's thread, from the plate on" offset 0,0.5
set xlabel "turn"; set ylabel "% of the preload per turn"
set key top right
plot "{folder}/turns.dat" using 1:3:(0.9) with boxes fs solid 0.25 noborder lc rgb "#2c5f8a" title "turns, threads as a mesh", \\
     "" using ($1-0.45):2:(0.9):(0) with vectors nohead lw 3 lc rgb "#b0201c" title "turns, plain cylinders", \\
     "{folder}/quarters.dat" using 1:3 with lines lw 1.5 lc rgb "#2c5f8a" title "quarter turns, threads as a mesh", \\
     "" using 1:2 with points pt 6 ps 0.9 lw 1.5 lc rgb "#b0201c" title "quarter turns, plain cylinders", \\
     "{folder}/turns.dat" using 1:4 with points pt 4 ps 1.1 lw 1.5 lc rgb "#555555" title "turns, Yamamoto's theory"
"""
    subprocess.run(["gnuplot"], input=script, text=True, check=True)
    print(folder / "joint.png")
    return 0


if __name__ == "__main__":
    sys.exit(main())
