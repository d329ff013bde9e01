#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""below.py [ENTS-LAB] [--out FOLDER] [SURFACE ...] [coarse]: does a result depend on where the height is cut? Waves shorter than the cut are a
law (the key "below"). Mean pressure, stiffness and real contact area over a factor of 8 of the cut, against boundary elements with all waves, on
64 x 64 cells, or ("coarse") on meshes of four nodes in a wave as long as the cut; surfaces: afm, spectrum, two_scales,
and unseen, a spectrum that nothing was ever adjusted to.
"""
import json
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs  # noqa: E402

CELLS, NODES_IN_WAVE, POINTS = 64, 4, 256
ROUGH = {"type": "roughness", "seed": 33, "rms": 0.002, "hurst": 0.8, "wavelengths": [0.025, 0.5, 0.5], "size": [1, 1]}
WAVES = {"type": "sum", "of": [{"type": "sine", "amplitude": 0.002, "wave_vector": [2, 0]}, {"type": "sine", "amplitude": 0.002, "wave_vector": [0, 2]},
                               {"type": "roughness", "seed": 5, "rms": 0.0005, "hurst": 0.4, "wavelengths": [0.025, 0.3, 0.3], "size": [1, 1]}]}
UNSEEN = {"type": "roughness", "seed": 7041, "rms": 0.002, "hurst": 0.5, "wavelengths": [0.025, 0.5, 0.5], "size": [1, 1]}
SURFACES = {"afm": (None, 5, (0.15625, 0.3125, 0.625, 1.25), (0.03, 0.045, 0.06, 0.08, 0.1)),
            "spectrum": (ROUGH, 1, (0.03125, 0.0625, 0.125, 0.25), (0.004, 0.005, 0.007, 0.01, 0.014)),
            "two_scales": (WAVES, 1, (0.03125, 0.0625, 0.125, 0.25), (0.003, 0.004, 0.005, 0.007, 0.009)),
            "unseen": (UNSEEN, 1, (0.03125, 0.0625, 0.125, 0.25), (0.004, 0.005, 0.007, 0.01, 0.014))}


def scene(surface, cut, coarse, exact):
    height, side, _, approaches = SURFACES[surface]
    text = json.loads((HERE / "scene.json").read_text())
    del text["compare"], text["variants"], text["contact"]["law"]
    low = 0 if height else 3
    for axis in "xy":
        text["parts"][0][axis] = {"from": low, "pieces": [{"to": low + side, "divisions": round(NODES_IN_WAVE * side / cut) if coarse else CELLS}]}
    text["parts"][0]["z"]["from"] = -side / 2
    model = text["contact"]["model"]
    if height:
        corners = [[-1, -1], [-1, 2], [2, 2], [2, -1]]
        text["contact"]["master"]["nodes"] = [corner + [0.0066] for corner in corners]
        model.update(surface_coordinates=corners, height=height)
    else:
        model["height"]["file"] = str(HERE / model["height"]["file"])
    text["contact"]["below"] = {"cut": cut, "law": "boundary_elements", "points": POINTS}
    text["steps"]["values"] = approaches
    text["exact"]["points"] = POINTS
    if not exact:
        del text["exact"]
    return text


def table(surface, cut, steps, truth):
    """Errors in % over the steps, on the terminal; quantities of those with more than 3 % in contact."""
    errors = {"contact area [%]": [], "area": [], "mean pressure": [], "stiffness": []}
    before, quantities = None, []
    for step, (pressure, area) in zip(steps, truth):
        own = step["mean_pressure"]
        errors["contact area [%]"].append(100 * area)
        errors["area"].append(100 * step["contact_fraction"] / area - 100)
        errors["mean pressure"].append(100 * own / pressure - 100)
        errors["stiffness"].append(100 * (own - before[0]) / (pressure - before[1]) - 100 if before else float("nan"))
        before = own, pressure
        if area > 0.03:
            quantities.append([runs.quantity(f"{surface}: mean pressure", own, pressure),
                               runs.quantity(f"{surface}: contact area", step["contact_fraction"], area)])
    print(f"{surface}, waves below {cut} as a law: errors [%]; {sum(step['wall_time'] for step in steps):.1f} s")
    for name, values in errors.items():
        print(f"  {name:<18}" + "".join(f"{value:>8.2f}" for value in values), flush=True)
    return quantities


def main():
    names, coarse = [word for word in sys.argv[1:] if word in SURFACES], "coarse" in sys.argv
    sys.argv[1:] = [word for word in sys.argv[1:] if word not in SURFACES and word != "coarse"]
    arguments = runs.arguments(__doc__, "rough_afm_below")
    quantities = []
    for surface in names or SURFACES:
        truth = []
        for cut in reversed(SURFACES[surface][2]):  # the coarsest mesh first: the boundary elements with all waves are those of all
            text = scene(surface, cut, coarse, not truth)
            steps = runs.solve(arguments.program, text, arguments.out / f"{surface}_{cut}", "--no-pictures")["steps"]
            if not truth:
                found = [{q["name"]: q["exact"] for q in step["exact"]} for step in steps]
                truth = [(each["mean pressure"], each["contact fraction"]) for each in found]
            quantities += table(surface, cut, steps, truth)
    runs.write_result(arguments.out, quantities)
    return 0


if __name__ == "__main__":
    sys.exit(main())
