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
    def panel(axes, index, label):
        rows = {cells: [(s[0], s[index]) for s in steps if len(s) > index] for cells, steps in results.items()}
        axes.plot([p["exact"] for p, _ in rows[MESHES[-1]]], [q["exact"] for _, q in rows[MESHES[-1]]], color="#999999", linewidth=3,
                  label="boundary elements")
        for cells, marker in zip(rows, "s^ovD"):
            axes.plot([p["value"] for p, _ in rows[cells]], [q["value"] for _, q in rows[cells]], marker, fillstyle="none", markersize=7,
                      label=f"{cells} x {cells} cells")
        axes.set(xscale="log", yscale="log", xlim=(0.06, 4), xlabel="mean pressure [MPa]", ylabel=label)
        ticks = (0.002, 0.005, 0.01, 0.02, 0.05) if index == 1 else (200, 500, 1000, 2000)
        axes.set(ylim=(0.001, 0.06) if index == 1 else (150, 2000), yticks=ticks, yticklabels=[f"{tick:g}" for tick in ticks])
        axes.tick_params(which="minor", labelleft=False)
        axes.legend(loc="upper left")

    runs.draw(folder / "rough.png", (1000, 450), lambda axes: panel(axes, 1, "contact area / area"),
              lambda axes: panel(axes, 2, "stiffness [MPa/mm]"))


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
