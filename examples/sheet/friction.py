#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""friction.py [ENTS-HOST] [--out FOLDER]: the scene of sheet.py with Coulomb friction, 0.1, in 40 and 240 steps.

The height on the strip against the mesh of the corrugation. The mesh is given surface coordinates: a slave node slides over three of its segments
in a step, and without them the place that friction holds it at is found up to one segment and a half beyond a segment's border.
"""
import json
import math
import sys

import sheet
from sheet import HERE, runs

FRICTION = {"type": "coulomb", "coefficient": 0.1, "stiffness": 10}
STEPS = [{"to": 1, "count": 40}, {"to": 2, "count": 240}]


def main():
    arguments = runs.arguments(__doc__, "sheet_friction")
    found = []
    for name in ("strip", "explicit"):
        scene = json.loads((HERE / "scene.json").read_text())
        scene["parts"][1]["deck"] = str(HERE / "indenter.inp")
        scene["contact"]["model"]["contact"]["friction"] = FRICTION
        scene["steps"]["values"] = STEPS
        if name == "explicit":
            scene = sheet.explicit(scene, arguments.out)
            scene["contact"]["master"]["surface_coordinates"] = ["x"]
        result = runs.solve(arguments.program, scene, arguments.out / name)
        found.append([step["contact_force"] for step in result["steps"]])
        print(f"{name}: {result['sizes']['elements']} elements, {result['wall_time']['total']:.1f} s, "
              f"{sum(len(step['cuts']) for step in result['steps'])} cuts")
    largest = max(math.hypot(*g) for g in found[1])
    steps = [[runs.quantity("force", math.hypot(*f), math.hypot(*g)),
              runs.quantity("difference of the force / largest force", math.hypot(f[0] - g[0], f[1] - g[1]) / largest, 0.0)]
             for f, g in zip(*found)]
    runs.write_result(arguments.out, steps)
    print(f"largest difference, size of the force: {100 * max(abs(step[0]['relative_error']) for step in steps):.2f} %")
    print(f"largest difference of the force / largest force: {100 * max(step[1]['value'] for step in steps):.2f} %")
    return 0


if __name__ == "__main__":
    sys.exit(main())
