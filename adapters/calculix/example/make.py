#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Write one problem for CalculiX and for ents-lab: a block is pressed by a rigid surface that is nothing but a height on ONE quad4 segment.

usage: make.py sphere|texture|friction|turned U1E|U1A OUT

turned: a rigid body with a reference node and a node for its turns, one of which is free; friction.

OUT/block.inp   mesh, read by both
OUT/job.inp     ccx: elements U1E, or U1A that run an Abaqus user element; NLGEOM, several increments
OUT/ents_1.json, OUT/ents_1.txt   their model and areas
OUT/scene.json  the same for ents-lab"""
import json
import pathlib
import sys

CELLS, SIZE, LAYERS, HEIGHT = 6, 1.2, 3, 0.6
YOUNG, POISSON = 1000.0, 0.3
MASTER = [[-2, -2, 0], [-2, 2, 0], [2, 2, 0], [2, -2, 0]]  # this order: the normal looks down on the block
STEPS = 5

PENALTY = {"type": "penalty", "stiffness": 5e4}
WAVES = {"type": "product", "of": [{"type": "sine", "amplitude": 0.15, "wave_vector": [0.9, 0.2], "phase": 0.4},
                                   {"type": "sine", "amplitude": 0.15, "wave_vector": [-0.3, 0.8]}]}
CASES = {  # height, friction, travel of the rigid surface
    "sphere": ({"type": "polynomial", "coefficients": [[0, 0, -0.25], [0], [-0.25]]}, None, [0, 0, -0.1]),
    "texture": (WAVES, None, [0.05, 0.02, -0.06]),
    "friction": (WAVES, {"type": "coulomb", "coefficient": 0.3, "stiffness": 2e4}, [0.05, 0.02, -0.06]),
    "turned": (WAVES, {"type": "coulomb", "coefficient": 0.3, "stiffness": 2e4}, [0.05, 0.02, -0.06]),
}
REFERENCE, TURNS = [0.05, 0.05, 0.5], [0.02, None, 0.25]  # turns: of the body, None: it is free


def main():
    if len(sys.argv) != 4 or sys.argv[1] not in CASES or sys.argv[2] not in ("U1E", "U1A"):
        sys.exit(__doc__)
    height, friction, travel = CASES[sys.argv[1]]
    element, out = sys.argv[2], pathlib.Path(sys.argv[3])
    steps = 20 if sys.argv[1] == "turned" else STEPS
    out.mkdir(parents=True, exist_ok=True)

    n = CELLS + 1
    number = lambda i, j, k: 1 + i + n * (j + n * k)
    lines = ["*NODE, NSET=ALL"]
    for k in range(LAYERS + 1):
        for j in range(n):
            for i in range(n):
                x, y, z = SIZE * (i / CELLS - 0.5), SIZE * (j / CELLS - 0.5), HEIGHT * (k / LAYERS - 1)
                lines.append(f"{number(i, j, k)}, {x!r}, {y!r}, {z!r}")
    elements = [(i, j, k) for k in range(LAYERS) for j in range(CELLS) for i in range(CELLS)]
    lines.append("*ELEMENT, TYPE=C3D8, ELSET=BLOCK")
    for e, (i, j, k) in enumerate(elements, 1):
        nodes = [number(i + a, j + b, k + c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        lines.append(", ".join(map(str, [e] + nodes)))
    lines += ["*NSET, NSET=BOTTOM"] + [f"{number(i, j, 0)}," for j in range(n) for i in range(n)]
    lines += ["*SURFACE, NAME=TOP, TYPE=ELEMENT"]
    lines += [f"{e}, S2" for e, (i, j, k) in enumerate(elements, 1) if k == LAYERS - 1]
    (out / "block.inp").write_text("\n".join(lines) + "\n")

    turned = sys.argv[1] == "turned"
    body = [[x - c for x, c in zip(p, REFERENCE)] for p in MASTER]
    model = {"segment": "quad4", **({"master": "rigid"} if turned else {}), "surface_coordinates": [p[:2] for p in MASTER], "height": height,
             "contact": {"normal": PENALTY, **({"friction": friction} if friction else {})}}
    (out / "ents_1.json").write_text(json.dumps(model, indent=1) + "\n")

    first_node, first_element, cell = n * n * (LAYERS + 1), len(elements), (SIZE / CELLS) ** 2
    places = [REFERENCE, REFERENCE] if turned else MASTER  # the second one is the node for the turns
    master = [first_node + 1 + a for a in range(len(places))]
    deck = ["*INCLUDE, INPUT=block.inp", "*NODE, NSET=MASTER"]
    deck += [f"{m}, {p[0]!r}, {p[1]!r}, {p[2]!r}" for m, p in zip(master, places)]
    deck += [f"*USER ELEMENT, TYPE={element}, NODES={1 + len(places)}, INTEGRATION POINTS=1, MAXDOF=3", f"*ELEMENT, TYPE={element}, ELSET=CONTACT"]
    areas = [f"body {p[0]!r} {p[1]!r} {p[2]!r}" for p in body] if turned else []
    areas += ["# element, area of its slave node"]
    for j in range(n):
        for i in range(n):
            first_element += 1
            deck.append(", ".join(map(str, [first_element, number(i, j, LAYERS)] + master)))
            areas.append(f"{first_element} {cell * (1 if 0 < i < CELLS else 0.5) * (1 if 0 < j < CELLS else 0.5)!r}")
    (out / "ents_1.txt").write_text("\n".join(areas) + "\n")
    motion = [f"MASTER, {i}, {i}, {u!r}" for i, u in enumerate(travel, 1)]
    if turned:
        motion = [f"{m}, {i}, {i}, {u!r}" for m, us in zip(master, (travel, TURNS)) for i, u in enumerate(us, 1) if u is not None]
    deck += ["*MATERIAL, NAME=RUBBER", "*ELASTIC", f"{YOUNG}, {POISSON}", "*SOLID SECTION, ELSET=BLOCK, MATERIAL=RUBBER",
             "*MATERIAL, NAME=CONTACT", "*ELASTIC", "1., 0.", "*DEPVAR", "28" if turned else "16",
             *(["*USER SECTION, ELSET=CONTACT, MATERIAL=CONTACT, CONSTANTS=3", "1., 0., 0."] if element == "U1E" else
               ["*USER SECTION, ELSET=CONTACT, MATERIAL=CONTACT, CONSTANTS=5", f"3., {1 if friction else 0}., 1., 0., 0."]),
             f"*STEP, NLGEOM, INC=100", "*STATIC", f"{1 / steps!r}, 1., 1e-5, {1 / steps!r}",
             "*CONTROLS, PARAMETERS=FIELD", "1.e-9, 1.e-9",
             "*BOUNDARY", "BOTTOM, 1, 3", *motion,
             "*NODE PRINT, NSET=BOTTOM, TOTALS=ONLY", "RF", "*NODE PRINT, NSET=ALL", "U", "*END STEP"]
    (out / "job.inp").write_text("\n".join(deck) + "\n")

    scene = {"title": f"block under a rigid {sys.argv[1]}", "dimension": 3,
             "materials": {"rubber": {"law": "st_venant_kirchhoff", "young": YOUNG, "poisson": POISSON}},
             "parts": [{"name": "block", "material": "rubber", "deck": "block.inp", "element_set": "BLOCK"}],
             "supports": [{"nodes": "block.BOTTOM", "x": 0, "y": 0, "z": 0}],
             "contact": {"slave": "block.TOP", "master": {"nodes": MASTER, "direction": travel}, "model": model},
             "steps": {"control": "approach", "values": [sum(u * u for u in travel) ** 0.5 * (s + 1) / steps for s in range(steps)]},
             "solver": {"tolerance": 1e-12}}
    if turned:
        names = dict(zip(("x", "y", "z", "turn_x", "turn_y", "turn_z"), travel + TURNS))
        scene["contact"]["master"] = {"rigid_body": {
            "reference": REFERENCE, "nodes": [[x + c for x, c in zip(p, REFERENCE)] for p in body], "segments": [[0, 1, 2, 3]],
            "surface_coordinates": [p[:2] for p in MASTER], "prescribed": [{k: u for k, u in names.items() if u is not None}],
            "free": [k for k, u in names.items() if u is None]}}
        scene["steps"] = {"control": "load_factor", "values": [(s + 1) / steps for s in range(steps)]}
    (out / "scene.json").write_text(json.dumps(scene, indent=1) + "\n")


main()
