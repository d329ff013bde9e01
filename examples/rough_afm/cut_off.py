#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""cut_off.py [ENTS-HOST] [--out FOLDER]: the AFM scan without its short waves, whose law takes their place, on coarse meshes: contact area, mean
pressure and stiffness against boundary elements with all waves; the same meshes with all waves and no law beside them.
"""
import json
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs  # noqa: E402

# Cells along a side, cut-off [um] (none: all waves, hard contact)
CASES = ((64, None), (64, 0.125), (64, 0.15625))
STEPS = (0.03, 0.045, 0.06, 0.08, 0.1)


def scene(cells, cut_off):
    text = json.loads((HERE / "scene.json").read_text())
    for axis in "xy":
        text["parts"][0][axis]["pieces"][0]["divisions"] = cells
    del text["compare"], text["variants"]
    height = text["contact"]["model"]["height"]
    height["file"] = str(HERE / height["file"])
    if cut_off:
        text["contact"]["cut_off"] = cut_off
        del text["contact"]["law"]
    text["steps"]["values"] = STEPS
    text["exact"]["points"] = 512
    return text


def errors(result):
    """Of area, mean pressure and stiffness in every step [%]; the area itself [%]."""
    rows, before = [], None
    for step in result["steps"]:
        found = {q["name"]: q for q in step["exact"]}
        pressure, area = found["mean pressure"], found["contact fraction, estimated"]
        stiffness = None
        if before:
            stiffness = (pressure["value"] - before["value"]) / (pressure["exact"] - before["exact"]) - 1
        rows.append((area["exact"], area["value"] / area["exact"] - 1, pressure["value"] / pressure["exact"] - 1, stiffness))
        before = pressure
    return rows


def main():
    arguments = runs.arguments(__doc__, "rough_afm_cut_off")
    quantities = []
    for cells, cut_off in CASES:
        name = f"{cells}_{cut_off or 'all'}"
        rows = errors(runs.solve(arguments.program, scene(cells, cut_off), arguments.out / name))
        print(f"{cells} x {cells} cells, " + (f"waves shorter than {cut_off} um as a law" if cut_off else "all waves, no law"))
        for what, index in (("area", 1), ("mean pressure", 2), ("stiffness", 3)):
            print(f"  {what + ', error [%]':<28}" + "".join(f"{100 * row[index]:>9.1f}" if row[index] is not None else " " * 9 for row in rows))
        quantities.append([runs.quantity(f"{name}: contact area", row[0] * (1 + row[1]), row[0]) for row in rows])
    print("  contact area [%]            " + "".join(f"{100 * row[0]:>9.2f}" for row in rows))
    runs.write_result(arguments.out, quantities)
    return 0


if __name__ == "__main__":
    sys.exit(main())
