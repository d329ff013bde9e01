#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Two curved bodies of C3D10, meshed by Gmsh, the AFM scan of examples/rough_afm on the lower one: ents-deck and the real ccx, against an explicit mesh of the scan.

usage: curved.py [--build DIR] [--out DIR]

A polymer cap (sphere of 10 um) is pressed on the top of a stiff cylinder (20 um) that carries the scan. `enriched`: the cylinder has faces of 0.4 um, the scan is the model's
height, and one command makes the job: ents-deck job.inp --pair CAP,TOP --model model.json --coordinates xy --for calculix. `explicit`: faces of FINE um follow the scan, and
ccx's own contact between surfaces, with the same stiffness, solves it.

exit status: 0 forces agree within 1 %, 1 they do not, 3 gmsh, ccx or NumPy are missing"""
import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import time

try:
    import numpy as np
except ImportError:
    print("curved.py: NumPy is missing (apt-get install python3-numpy)", file=sys.stderr)
    sys.exit(3)

ROOT = pathlib.Path(__file__).resolve().parents[3]
SCAN = ROOT / "examples" / "rough_afm" / "afm_10um_256.txt"
CENTRE, HALF, CYLINDER, CAP = (5.25, 5.25), 1.25, 20.0, 10.0  # um; surface coordinates of the scan are x and y
COARSE, FINE, ZONE, SLAVE = 0.4, (0.07,), 0.85, 0.12  # sizes of faces; radius in which they are fine
GAP, APPROACH, INCREMENTS, DEPTH = 0.02, 0.04, 2, 1.1           # um
STIFF, SOFT, POISSON, PENALTY = 2e5, 2e3, 0.3, 2e5                # MPa, MPa/um

GEOMETRY = """SetFactory("OpenCASCADE");
{body}
Mesh.ElementOrder = 2; Mesh.SecondOrderLinear = 0; Mesh.SaveGroupsOfNodes = 1; Mesh.Algorithm3D = 1;
Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0;
{field}
Field[2] = MathEval; Field[2].F = "{coarse}";
Field[3] = Min; Field[3].FieldsList = {{1, 2}};
Background Field = 3;
"""
# Small faces alone: elements grow with their depth below the surface, and faces outside of the zone.
GRADED = """Field[1] = MathEval; Field[1].F = "{fine} + 0.4 * ({r} - Sqrt((x - {x})^2 + {along}(z {centre})^2)) + 0.25 * ({distance} - {zone} + Abs({distance} - {zone}))";
"""
LOWER = """Box(1) = {{{x0}, {y0}, -1.2, {w}, {w}, 1.3}};
Cylinder(2) = {{{x}, {y0} - 1, -{r}, 0, {w} + 2, 0, {r}}};
BooleanIntersection(3) = {{ Volume{{1}}; Delete; }}{{ Volume{{2}}; Delete; }};
Physical Volume("LOWER") = {{3}};
top() = Surface In BoundingBox{{{x0} - .5, {y0} - .5, -1.1, {x0} + {w} + .5, {y0} + {w} + .5, .9}}; Physical Surface("TOP") = {{top()}};
floor() = Surface In BoundingBox{{{x0} - .01, {y0} - .01, -1.21, {x0} + {w} + .01, {y0} + {w} + .01, -1.19}}; Physical Surface("FLOOR") = {{floor()}};
"""
UPPER = """Box(1) = {{{x} - 1, {y} - 1, -0.5, 2, 2, 1.5}};
Sphere(2) = {{{x}, {y}, {r}, {r}}};
BooleanIntersection(3) = {{ Volume{{1}}; Delete; }}{{ Volume{{2}}; Delete; }};
Physical Volume("UPPER") = {{3}};
cap() = Surface In BoundingBox{{{x} - 1.5, {y} - 1.5, -.9, {x} + 1.5, {y} + 1.5, .9}}; Physical Surface("CAP") = {{cap()}};
lid() = Surface In BoundingBox{{{x} - 1.01, {y} - 1.01, .99, {x} + 1.01, {y} + 1.01, 1.01}}; Physical Surface("LID") = {{lid()}};
"""


def mesh(folder, name, body, fine, coarse, zone, first):
    """Gmsh's deck, without the triangles and lines of the boundary, which ccx would take for shells and beams. Numbers begin at `first`."""
    x, y = CENTRE
    values = {"x": x, "y": y, "x0": x - HALF, "y0": y - HALF, "w": 2 * HALF, "r": CYLINDER if name == "lower" else CAP}
    field = GRADED.format(**values, fine=fine, zone=zone, centre=f"+ {CYLINDER}" if name == "lower" else f"- {CAP}", along="" if name == "lower" else f"(y - {y})^2 + ",
                          distance=f"Sqrt((x - {x})^2 + (y - {y})^2)")
    (folder / f"{name}.geo").write_text(GEOMETRY.format(body=body.format(**values), field=field, coarse=coarse))
    subprocess.run(["gmsh", "-3", "-v", "0", f"{name}.geo", "-format", "inp", "-o", f"{name}_gmsh.inp"], cwd=folder, check=True)
    nodes, elements, sets, target, kind = {}, [], {}, None, None
    for line in (folder / f"{name}_gmsh.inp").read_text().splitlines():
        if line.startswith("*"):
            words = [word.strip() for word in line.upper().split(",")]
            options = dict(word.split("=") for word in words[1:] if "=" in word)
            kind = words[0] if words[0] != "*ELEMENT" or options.get("TYPE", "").startswith("C3D10") else "other"
            target = options.get("NSET")
        elif kind == "*NODE":
            number, *x = line.split(",")
            nodes[int(number)] = [float(v) for v in x]
        elif kind == "*ELEMENT":
            words = [int(word) for word in line.split(",") if word.strip()]
            if elements and len(elements[-1]) < 11:
                elements[-1] += words
            else:
                elements.append(words)
        elif kind == "*NSET":
            sets.setdefault(target, []).extend(int(word) for word in line.split(",") if word.strip())
    used = sorted({node for element in elements for node in element[1:]})
    number = {node: first + i for i, node in enumerate(used)}
    positions = np.array([nodes[node] for node in used])
    cells = [[first + i] + [number[node] for node in element[1:]] for i, element in enumerate(elements)]
    return {"name": name.upper(), "first": first, "x": positions, "cells": cells,
            "sets": {key: sorted(number[node] for node in members if node in number) for key, members in sets.items() if key in ("TOP", "FLOOR", "CAP", "LID")}}


def faces(body, name):
    """*SURFACE of the faces with all nodes in the set."""
    wanted = set(body["sets"][name])
    local = ((1, 2, 3, 5, 6, 7), (1, 4, 2, 8, 9, 5), (2, 4, 3, 9, 10, 6), (3, 4, 1, 10, 8, 7))  # S1 .. S4 of C3D10
    found = [(cell[0], f + 1) for cell in body["cells"] for f, face in enumerate(local) if all(cell[i] in wanted for i in face)]
    return [f"*SURFACE, NAME=S{name}"] + [f"{element}, S{face}" for element, face in found]


def deck(bodies, native):
    lines = ["*HEADING", "two curved bodies"]
    for body in bodies:
        lines += ["*NODE, NSET=N" + body["name"]] + [f"{body['first'] + i}, {x[0]:.12g}, {x[1]:.12g}, {x[2]:.12g}" for i, x in enumerate(body["x"])]
        lines += [f"*ELEMENT, TYPE=C3D10, ELSET={body['name']}"] + [", ".join(map(str, cell)) for cell in body["cells"]]
        for name, members in body["sets"].items():
            lines += [f"*NSET, NSET={name}"] + [f"{node}," for node in members]
    lines += ["*MATERIAL, NAME=STIFF", "*ELASTIC", f"{STIFF}, {POISSON}", "*MATERIAL, NAME=SOFT", "*ELASTIC", f"{SOFT}, {POISSON}",
              "*SOLID SECTION, ELSET=LOWER, MATERIAL=STIFF", "*SOLID SECTION, ELSET=UPPER, MATERIAL=SOFT",
              *(faces(bodies[1], "CAP") + faces(bodies[0], "TOP") +
                ["*SURFACE INTERACTION, NAME=I", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{PENALTY}, {PENALTY * 1e-9}",
                 "*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE", "SCAP, STOP"] if native else []),
              "*STEP, NLGEOM", "*STATIC", f"{1 / INCREMENTS}, 1., 1e-4, {1 / INCREMENTS}", "*BOUNDARY", "FLOOR, 1, 3", "LID, 1, 2", f"LID, 3, 3, {-APPROACH}",
              "*NODE PRINT, NSET=FLOOR, TOTALS=ONLY", "RF", "*END STEP"]
    return "\n".join(lines) + "\n"


def heights(build, x, y):
    """Of the scan at points, from the library's own spline."""
    sys.path.insert(0, str(ROOT / "adapters" / "python"))
    os.environ.setdefault("ENTS_LIBRARY", str(build / "lib" / "libents.so.1"))
    import ents
    model = ents.Model({"segment": "quad4", "height": height()})
    square = [[0, 0, 0], [10, 0, 0], [10, 10, 0], [0, 10, 0]]
    answer = model.surface(square, np.stack([x / 5 - 1, y / 5 - 1], axis=1), surface_coordinates=[p[:2] for p in square])
    return np.asarray(answer["height"] if isinstance(answer, dict) else answer.height)


def height():
    return {"type": "map", "file": str(SCAN), "length_unit": 1e-6, "boundary": "clamped"}


def convert(folder, build):
    """@return the job's folder, elements, seconds"""
    shutil.rmtree(folder / "ents", ignore_errors=True)
    begin = time.perf_counter()
    made = subprocess.run([build / "bin/ents-deck", folder / "job.inp", "--pair", "CAP,TOP", "--model", folder / "model.json", "--coordinates", "xy", "--points", "2",
                           "--slide", "0", "--for", "calculix", "--out", folder / "ents"], capture_output=True, text=True)
    (folder / "ents-deck.log").write_text(made.stdout + made.stderr)
    if made.returncode:
        sys.exit(made.stderr)
    elements = next(line.split()[1] for line in made.stdout.split("\n") if line.startswith("  slave"))
    return folder / "ents", elements, time.perf_counter() - begin


def solve(job, build):
    """@return forces on the floor in all increments, iterations, seconds"""
    begin = time.perf_counter()
    with open(job / "log", "w") as log:
        code = subprocess.run([build / "calculix/ccx_ents", "job"], cwd=job, stdout=log, stderr=log, env={**os.environ, "OMP_NUM_THREADS": "2"}).returncode
    if code:
        sys.exit(f"ccx stopped, see {job / 'log'}")
    lines = (job / "job.dat").read_text().splitlines()
    force = [float(lines[i + 2].split()[2]) for i, line in enumerate(lines) if "total force" in line]
    rows = [line.split() for line in (job / "job.sta").read_text().splitlines()[2:]]
    return force, sum(int(row[3]) for row in rows if row[2].isdigit()), time.perf_counter() - begin


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path("build"))
    parser.add_argument("--out", type=pathlib.Path)
    parser.add_argument("--fine", type=float, nargs="+", default=list(FINE))
    options = parser.parse_args()
    build = options.build.resolve()
    out = (options.out or build / "curved").resolve()
    if not shutil.which("gmsh") or not (build / "calculix/ccx_ents").exists():
        print("curved.py: gmsh or ccx_ents is missing (apt-get install gmsh; sh adapters/calculix/run.sh --only-build)", file=sys.stderr)
        return 3
    out.mkdir(parents=True, exist_ok=True)
    upper = mesh(out, "upper", UPPER, SLAVE, 0.4, ZONE, 100001)
    upper["x"][:, 2] += GAP
    contact = {"normal": {"type": "penalty", "stiffness": PENALTY}}
    print("master               top nodes  nodes    contact elements  ccx       iterations  force [uN] of all increments     difference")
    results = []
    for label, size in [("enriched", COARSE)] + [(f"explicit {fine}", fine) for fine in options.fine]:
        folder = out / label.replace(" ", "_")
        folder.mkdir(exist_ok=True)
        lower = mesh(folder, "lower", LOWER, size, COARSE, ZONE, 1)
        native = label != "enriched"
        if native: # nodes go along the cylinder's normal by the height, those of the top onto the enriched surface, those below by less
            x = lower["x"]
            normal = np.stack([x[:, 0] - CENTRE[0], 0 * x[:, 0], x[:, 2] + CYLINDER], axis=1)
            radius = np.linalg.norm(normal, axis=1)[:, None]
            share = np.clip(1 - (CYLINDER - radius) / DEPTH, 0, 1)
            lower["x"] = x + share * heights(build, x[:, 0], x[:, 1])[:, None] * normal / radius
        (folder / "job.inp").write_text(deck([lower, upper], native))
        (folder / "model.json").write_text(json.dumps({"height": height(), "contact": contact}))
        job, elements, converted = (folder, "ccx's own", 0) if native else convert(folder, build)
        force, iterations, seconds = solve(job, build)
        results.append(force)
        print(f"{label:<20} {len(lower['sets']['TOP']):<10} {len(lower['x']) + len(upper['x']):<8} {elements:<17} {seconds:5.1f} s   {iterations:<11} "
              f"{' '.join(f'{f:.5g}' for f in force):<32} {abs(force[-1] / results[0][-1] - 1):.1e}{f'   ents-deck: {converted:.1f} s' if converted else ''}", flush=True)
    return 0 if abs(results[-1][-1] / results[0][-1] - 1) <= 0.01 else 1


sys.exit(main())
