#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""rough.py [ENTS-HOST] [--out FOLDER]: contact area and stiffness of a random rough surface against load, on three meshes of slave nodes, against
boundary elements.

The surface is self-affine (rms 2 um, Hurst exponent 0.8, waves from 31 to 250 um on 1 mm), a height on ONE rigid quad4. The stiffness is the
difference of the mean pressures of two steps over that of their approaches.
"""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs  # noqa: E402

MESHES = (64, 128, 256)  # cells along a side; the shortest wave has 2, 4, 8 of them


def quantities(result, cells):
    steps, before = [], None
    for step in result["steps"]:
        found = {q["name"]: q for q in step["exact"]}
        pressure, area = found["mean pressure"], found["contact fraction, estimated"]
        here = [runs.quantity(f"mean pressure, {cells} cells", pressure["value"], pressure["exact"]),
                runs.quantity(f"contact area, {cells} cells", area["value"], area["exact"])]
        if before:
            way = step["approach"] - before[0]
            here.append(runs.quantity(f"stiffness, {cells} cells", (pressure["value"] - before[1]["value"]) / way,
                                      (pressure["exact"] - before[1]["exact"]) / way))
        before = step["approach"], pressure
        steps.append(here)
    return steps


def draw(folder, results):
    plots = {"area": [], "stiffness": []}
    for cells, steps in results.items():
        for name, index in (("area", 1), ("stiffness", 2)):
            rows = [(s[0], s[index]) for s in steps if len(s) > index]
            (folder / f"{name}{cells}.dat").write_text("".join(f"{p['value']} {q['value']} {p['exact']} {q['exact']}\n" for p, q in rows))
            points = f'"{folder}/{name}{cells}.dat" using 1:2 with points pt {4 + 2 * MESHES.index(cells)} ps 1.4 lc {1 + MESHES.index(cells)} title "{cells} x {cells} cells"'
            plots[name].append(points)
    for name, what in plots.items():
        what.insert(0, f'"{folder}/{name}{MESHES[-1]}.dat" using 3:4 with lines lw 3 lc rgb "#999999" title "boundary elements"')
    script = f"""set terminal pngcairo size 1000,450 font "sans,12" rounded
set output "{folder}/rough.png"
set multiplot layout 1,2
set logscale xy; set xrange [0.06:4]; set grid lc rgb "#dddddd"; set key bottom right; set xlabel "mean pressure [MPa]"
set ylabel "contact area / area"; set key top left
plot {", ".join(plots["area"])}
set ylabel "stiffness [MPa/mm]"; set yrange [150:2000]; set ytics (200, 500, 1000, 2000)
plot {", ".join(plots["stiffness"])}
"""
    runs.draw(script, folder / "rough.png")


def main():
    arguments = runs.arguments(__doc__, "rough")
    results = {}
    for cells in MESHES:
        options = [] if cells == MESHES[-1] else ["--variant", f"cells_{cells}"]
        results[cells] = quantities(runs.solve(arguments.program, HERE / "scene.json", arguments.out / str(cells), *options), cells)
    runs.write_result(arguments.out, [step for steps in results.values() for step in steps])
    draw(arguments.out, results)
    print(f"{'mean pressure':>14}{'contact area [%]':>40}{'stiffness [MPa/mm]':>40}")
    for row in zip(*results.values()):
        cells = [f"{row[-1][0]['exact']:>14.4f}"]
        for index, factor in ((1, 100), (2, 1)):
            cells.append(("".join(f"{factor * s[index]['value']:>10.3f}" for s in row) + f"{factor * row[-1][index]['exact']:>10.3f}")
                         if len(row[0]) > index else 40 * " ")
        print("".join(cells))
    print("                      cells 64       128       256  boundary elements")
    return 0


if __name__ == "__main__":
    sys.exit(main())
