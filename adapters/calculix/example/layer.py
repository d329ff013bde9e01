#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The block problem of all hosts (../../block.json: triangles, St. Venant-Kirchhoff, plain facets with a height each) for CalculiX: a layer of C3D6.

usage: layer.py write SCENE VARIANT OUT     deck OUT/job.inp, model and areas
       layer.py print OUT                   what ccx found there: iterations and force on the support, a line an increment

U1E works in space: a layer with all u_z = 0, in which nothing changes along z, is the plane problem. Every plane node is two nodes here, at z = 0
and 1; all facets of the master are one element's `patch`."""
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import block


def layer(part, first, lines):
    """Nodes and C3D6 of a block; numbers of both start at `first`. Returns rows of nodes [row][x] at z = 0, and what to add for those at z = 1."""
    (px,), (py,) = part["x"]["pieces"], part["y"]["pieces"]
    (nx, x0, x1), (ny, y0, y1) = ((p["divisions"], part[a]["from"], p["to"]) for a, p in (("x", px), ("y", py)))
    side = (nx + 1) * (ny + 1)
    lines.append("*NODE, NSET=ALL")
    for k in (0, 1):
        for j in range(ny + 1):
            for i in range(nx + 1):
                lines.append(f"{first + k * side + j * (nx + 1) + i}, {x0 + (x1 - x0) * i / nx!r}, {y0 + (y1 - y0) * j / ny!r}, {float(k)}")
    rows = [[first + j * (nx + 1) + i for i in range(nx + 1)] for j in range(ny + 1)]
    lines.append(f"*ELEMENT, TYPE=C3D6, ELSET={part['name'].upper()}")
    element = first
    for j in range(ny):
        for i in range(nx):
            a, b, c, d = rows[j][i], rows[j][i + 1], rows[j + 1][i + 1], rows[j + 1][i]
            for triangle in ((a, b, c), (a, c, d)):  # ents-lab cuts its cells along this diagonal
                lines.append(", ".join(map(str, [element, *triangle, *(n + side for n in triangle)])))
                element += 1
    return rows, side


def write(scene, out):
    out.mkdir(parents=True, exist_ok=True)
    lower, upper = scene["parts"]
    model = scene["contact"]["model"]
    steps, push = scene["steps"]["values"][0]["count"], scene["supports"][1]
    if (model["segment"], lower["element"], upper["element"]) != ("line2", "tri3", "tri3") or "surface_coordinates" in scene["contact"]["master"]:
        sys.exit("layer.py: wanted is a variant with tri3 and line2 and without surface coordinates")
    lines = []
    below, side = layer(lower, 1, lines)
    above, upper_side = layer(upper, 1001, lines)
    masters = [node + k * side for k in (0, 1) for node in below[-1]]
    n, m = len(below[-1]), len(above[0])
    # Natural coordinates of a quad4: x, then -z, so that the normal points up. The height depends on x alone.
    patch = [[e + n, e + 1 + n, e + 1, e] for e in range(n - 1)]
    height = model.get("height")
    if height:
        height = {"type": "polynomial", "coefficients": [[c] for c in height["coefficients"]]}
    (out / "ents_1.json").write_text(json.dumps({**model, "segment": "quad4", "patch": patch, "height": height}, indent=1) + "\n")
    cell = (upper["x"]["pieces"][0]["to"] - upper["x"]["from"]) / (m - 1)
    lines += [f"*USER ELEMENT, TYPE=U1E, NODES={1 + len(masters)}, INTEGRATION POINTS=1, MAXDOF=3", "*ELEMENT, TYPE=U1E, ELSET=CONTACT"]
    areas = []
    for e, slave in enumerate(node + k * upper_side for k in (0, 1) for node in above[0]):
        words = list(map(str, [5001 + e, slave] + masters))
        lines += [", ".join(words[:12]) + ",", ", ".join(words[12:])]
        areas.append(f"{5001 + e} {cell / 2 * (1 if 0 < e % m < m - 1 else 0.5)!r}")  # half of the plane node's
    (out / "ents_1.txt").write_text("\n".join(areas) + "\n")
    for part in (lower, upper):
        material, name = scene["materials"][part["material"]], part["name"].upper()
        lines += [f"*MATERIAL, NAME=OF_{name}", "*ELASTIC", f"{float(material['young'])!r}, {material['poisson']!r}",
                  f"*SOLID SECTION, ELSET={name}, MATERIAL=OF_{name}"]
    lines += ["*NSET, NSET=FLOOR", *(f"{node + k * side}," for k in (0, 1) for node in below[0]),
              "*NSET, NSET=TOP", *(f"{node + k * upper_side}," for k in (0, 1) for node in above[-1]),
              "*MATERIAL, NAME=CONTACT", "*ELASTIC", "1., 0.", "*DEPVAR", "16", "*USER SECTION, ELSET=CONTACT, MATERIAL=CONTACT, CONSTANTS=3", "1., 0., 0.",
              "*STEP, NLGEOM, INC=100", "*STATIC", f"{1 / steps!r}, 1., 1e-5, {1 / steps!r}", "*CONTROLS, PARAMETERS=FIELD", "1.e-9, 1.e-9",
              "*BOUNDARY", "ALL, 3, 3", "FLOOR, 1, 2", f"TOP, 1, 1, {float(push['x'])!r}", f"TOP, 2, 2, {push['y']!r}",
              "*NODE PRINT, NSET=FLOOR, TOTALS=ONLY", "RF", "*END STEP"]
    (out / "job.inp").write_text("\n".join(lines) + "\n")


def show(out):
    lines = (out / "job.dat").read_text().splitlines()
    forces = [lines[i + 2].split() for i, line in enumerate(lines) if "total force" in line]
    rows = [line.split() for line in (out / "job.sta").read_text().splitlines()]
    iterations = [int(words[3]) for words in rows if len(words) >= 4 and words[0] == "1"]
    for k, (force, count) in enumerate(zip(forces, iterations), 1):
        print(f"step {k}/{len(forces)}  iterations {count:2d}  force on the support {force[0]} {force[1]}")


def main():
    if len(sys.argv) == 5 and sys.argv[1] == "write":
        write(block.variant_of(sys.argv[2], sys.argv[3]), pathlib.Path(sys.argv[4]))
    elif len(sys.argv) == 3 and sys.argv[1] == "print":
        show(pathlib.Path(sys.argv[2]))
    else:
        sys.exit(__doc__)


main()
