#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""wires.py [ENTS-HOST] [--out FOLDER]: two wires of 1 mm radius that cross at 90 degrees, against Hertz.

One wire is elastic: a block around the contact, a quarter of it, whose outer boundary follows Boussinesq's half-space; its mesh has the round
surface (the part's "crown"). The other one is rigid, a height on ONE quad4 across the first.

Exact: crossed cylinders of equal radii touch like a sphere of that radius and a plane, F = 4/3 E* sqrt(R) d^(3/2).
"""
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs  # noqa: E402

RADIUS = 1.0  # mm


def draw(folder, result):
    rows = [{q["name"]: q for q in step["exact"]} for step in result["steps"]]
    nodes, peak = result["steps"][-1]["nodes"], rows[-1]["peak pressure"]["exact"]
    points = [(math.hypot(*nodes["position"][3 * k:3 * k + 2]), p) for k, p in enumerate(nodes["pressure"]) if p > 0]
    modulus, radius = 1000 / (1 - 0.3**2), 1e3 * rows[-1]["contact radius"]["exact"]

    def forces(axes):
        approach = [1e3 * step["approach"] for step in result["steps"]]
        places = [1.05 * approach[-1] * k / 500 for k in range(501)]
        axes.plot(places, [4e3 / 3 * modulus * math.sqrt(RADIUS) * (x / 1e3)**1.5 for x in places], color=runs.DARK, linewidth=1.5, label="Hertz")
        axes.plot(approach, [1e3 * row["force"]["value"] for row in rows], "o", color=runs.BLUE, label="computed")
        axes.set(xlabel="approach [um]", ylabel="force [mN]")
        axes.set_xlim(left=0)
        axes.set_ylim(bottom=0)
        axes.legend(loc="lower right")

    def pressures(axes):
        angles = [math.pi / 2 * k / 200 for k in range(201)]
        axes.plot([radius * math.sin(a) for a in angles], [peak * math.cos(a) for a in angles], color=runs.DARK, linewidth=1.5, label="Hertz")
        axes.plot([1e3 * r for r, _ in points], [p for _, p in points], ".", color=runs.BLUE, markersize=5, label="nodes, in all directions")
        axes.set(xlabel="place from the middle [um]", ylabel="pressure [MPa]", xlim=(0, 1.15 * radius))
        axes.set_ylim(bottom=0)
        axes.legend(loc="upper right")

    runs.draw(folder / "wires.png", (1000, 420), forces, pressures)


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
