#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""wires.py [ENTS-HOST] [--out FOLDER]: two wires of 1 mm radius that cross at 90 degrees, against Hertz.

One wire is elastic: a block around the contact, a quarter of it, whose outer boundary follows Boussinesq's half-space; its mesh has the round
surface (the part's "crown"). The other one is rigid, a height on ONE quad4 across the first.

Exact: crossed cylinders of equal radii touch like a sphere of that radius and a plane, F = 4/3 E* sqrt(R) d^(3/2).
"""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs  # noqa: E402

RADIUS = 1.0  # mm


def draw(folder, result):
    rows = [{q["name"]: q for q in step["exact"]} for step in result["steps"]]
    (folder / "force.dat").write_text("".join(f"{1e3 * step['approach']} {1e3 * row['force']['value']}\n" for step, row in zip(result["steps"], rows)))
    nodes, peak = result["steps"][-1]["nodes"], rows[-1]["peak pressure"]["exact"]
    points = [(*nodes["position"][3 * k:3 * k + 2], p) for k, p in enumerate(nodes["pressure"]) if p > 0]
    (folder / "pressure.dat").write_text("".join(f"{1e3 * x} {1e3 * y} {p}\n" for x, y, p in points))
    modulus = 1000 / (1 - 0.3**2)
    radius = 1e3 * rows[-1]["contact radius"]["exact"]
    script = f"""set terminal pngcairo size 1000,420 font "sans,12" rounded
set output "{folder}/wires.png"
set multiplot layout 1,2
set xlabel "approach [um]"; set ylabel "force [mN]"; set grid lc rgb "#dddddd"; set key right bottom; set xrange [0:*]; set samples 500
plot 1e3 * 4. / 3 * {modulus} * sqrt({RADIUS}) * (x / 1e3)**1.5 lw 1.5 lc rgb "#333333" title "Hertz", "{folder}/force.dat" pt 7 lc 1 title "computed"
set xlabel "place from the middle [um]"; set ylabel "pressure [MPa]"; set key right top; set xrange [0:1.15 * {radius}]
plot {peak} * sqrt(x < {radius} ? 1 - (x / {radius})**2 : 0) lw 1.5 lc rgb "#333333" title "Hertz", \\
  "{folder}/pressure.dat" using (sqrt($1**2 + $2**2)):3 pt 7 ps 0.5 lc 1 title "nodes, in all directions"
"""
    runs.draw(script, folder / "wires.png")


def main():
    arguments = runs.arguments(__doc__, "wires")
    result = runs.solve(arguments.program, HERE / "scene.json", arguments.out / "run", "--nodes")
    print(f"{'approach [um]':>14}{'force [mN]':>12}{'Hertz':>10}{'error':>9}{'peak [MPa]':>12}{'Hertz':>10}{'radius [um]':>13}{'Hertz':>10}{'iterations':>12}")
    for step in result["steps"]:
        found = {q["name"]: q for q in step["exact"]}
        force, peak, radius = found["force"], found["peak pressure"], found["contact radius, estimated"]
        print(f"{1e3 * step['approach']:>14.4f}{1e3 * force['value']:>12.4f}{1e3 * force['exact']:>10.4f}{100 * force['relative_error']:>8.2f} %"
              f"{peak['value']:>12.3f}{peak['exact']:>10.3f}{1e3 * radius['value']:>13.2f}{1e3 * radius['exact']:>10.2f}{step['iterations']:>12}")
    runs.write_result(arguments.out, [step["exact"] for step in result["steps"]])
    draw(arguments.out, result)
    return 0


if __name__ == "__main__":
    sys.exit(main())
