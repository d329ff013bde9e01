#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""area_bounds.py [ENTS-HOST] [--quick] [--points N]: the estimated contact area and its bound, against known areas.

Every step of scenes whose contact area is known: closed forms (hertz3d, wires), or boundary elements with N points a side (default 512). For each step: |estimate - truth| <= bound, or ents-lab gave no bound because the mesh is too coarse for the surface.
Prints every step, then the table of examples/laboratory/README.md, "Contact area", as Markdown. --quick: the scenes of some seconds, 256 points.

Exit status: 0 every bound holds; 1 one does not, or a scene is not solved; 2 the command line is wrong."""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parents[2]
# Scene, variant, does it take more than some seconds?
SCENES = (("hertz3d", "", False), ("wires", "", False),
          ("rough", "cells_64", True), ("rough", "cells_128", True), ("rough", "", True),
          ("rough_afm", "", False), ("rough_afm", "fine", True), ("rough_afm", "block", True))


def solve(program, name, variant, points):
    """The steps, and what is known of the mesh."""
    folder = TOP / "examples" / name
    scene = json.loads((folder / "scene.json").read_text())
    for patch in [scene, *scene.get("variants", {}).values()]:
        exact = patch.get("exact", {})
        if "points" in exact and "error" not in exact:
            exact["points"] = points
    height = scene["contact"]["model"]["height"]
    if "file" in height:
        height["file"] = str(folder / height["file"])
    with tempfile.TemporaryDirectory() as scratch:
        file = pathlib.Path(scratch) / "scene.json"
        file.write_text(json.dumps(scene))
        done = subprocess.run([program, "run", file, "--json", *(["--variant", variant] if variant else [])], capture_output=True, text=True,
                              check=False)
    if done.returncode:
        sys.exit(f"{name} {variant}: {done.stderr.strip()}")
    result = json.loads(done.stdout)
    return result["steps"], result["resolution"]


def truth_of(step):
    """Share of the slave surface, and how well it is known."""
    found = {quantity["name"]: quantity for quantity in step["exact"]}
    if "contact radius, estimated" in found:
        radius = found["contact radius, estimated"]
        return step["contact_estimate"]["fraction"] * (radius["exact"] / radius["value"])**2, 0.0
    exact = found["contact fraction, estimated"]["exact"]
    return exact, abs(found["contact fraction, half the points"]["value"] - exact)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", type=pathlib.Path, default=TOP / "build/bin/ents-lab")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--points", type=int, metavar="N")
    options = parser.parse_args()
    points = options.points or (256 if options.quick else 512)
    wrong, summary = 0, []
    print("| scene | step | area [%] | known to | estimated | difference | bound | |\n|---|---:|---:|---:|---:|---:|---:|---|")
    for name, variant, long in SCENES:
        if options.quick and long:
            continue
        steps, resolution = solve(options.program, name, variant, points)
        areas, shares = [], []
        for step in steps:
            exact, known = truth_of(step)
            areas.append(100 * exact)
            estimate, bound = (step["contact_estimate"][key] for key in ("fraction", "error"))
            holds = bound is None or abs(estimate - exact) <= bound
            if bound is None and not resolution["too_coarse"]:
                holds = False
            wrong += not holds
            shares.append(0.0 if bound is None else abs(estimate - exact) / bound if bound > 0 else 1.0 if holds else float("inf"))
            text = ["none" if bound is None else f"{100 * bound:.3f}", "" if holds else "MISSED"]
            print(f"| {' '.join([name, variant]).strip()} | {step['step']} | {100 * exact:.3f} | {100 * known:.3f} | {100 * estimate:.3f} | "
                  f"{100 * (estimate - exact):+.3f} | {text[0]} | {text[1]} |", flush=True)
        share = "no bound is given" if resolution["too_coarse"] else f"{max(shares):.2f}"
        summary.append(f"| {' '.join([name, variant]).strip()} | {min(areas):.2g} .. {max(areas):.2g} | {share} |")
    print("\n| scene | area in contact [%] | largest difference / bound |\n|---|---:|---:|\n" + "\n".join(summary))
    if wrong:
        print(f"area_bounds.py: {wrong} bounds do not hold", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
