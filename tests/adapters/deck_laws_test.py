#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Laws that ccx's own contact does not have, on a deck in ccx: two cubes, against exact values.

usage: deck_laws_test.py [--build DIR]

The lower cube is held, the upper one guided, without lateral strain: springs in series when it is pulled; when it slides, every node of it
has the same speed. Prints a line per law: force, or tangential over normal force, and its exact value. Exit status: 0 all within 0.01 %;
1 not; 3 ccx is not here."""
import json
import math
import sys

import ccx_decks

YOUNG, AREA, STIFFNESS = 1000.0, 0.64, 20000.0
BODIES = YOUNG * AREA  # stiffness of the upper cube [F/L]; the lower one is held
NORMAL = {"type": "penalty", "stiffness": STIFFNESS}
PRESSED = {"normal": NORMAL, "friction": {"type": "coulomb", "coefficient": 0.4, "stiffness": 1e5}}
DECK = """** two cubes
*NODE, NSET=NALL
{nodes}
*ELEMENT, TYPE=C3D8, ELSET=LOWER
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELEMENT, TYPE=C3D8, ELSET=UPPER
2, 11, 12, 13, 14, 15, 16, 17, 18
*NSET, NSET=LOW
1, 2, 3, 4, 5, 6, 7, 8
*NSET, NSET=HIGH
11, 12, 13, 14, 15, 16, 17, 18
*NSET, NSET=TOP
15, 16, 17, 18
*SURFACE, NAME=SLAVE, TYPE=ELEMENT
UPPER, S1
*SURFACE, NAME=MASTER, TYPE=ELEMENT
LOWER, S2
*MATERIAL, NAME=STEEL
*ELASTIC
{young}, 0.
*SOLID SECTION, ELSET=LOWER, MATERIAL=STEEL
*SOLID SECTION, ELSET=UPPER, MATERIAL=STEEL
*SURFACE INTERACTION, NAME=I1
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
{stiffness}
*CONTACT PAIR, INTERACTION=I1, TYPE=SURFACE TO SURFACE
SLAVE, MASTER
*BOUNDARY
LOW, 1, 3
HIGH, 2, 2
*STEP, INC=1000
*STATIC, DIRECT
{increment}, {time}
*BOUNDARY
TOP, 3, 3, {up}
HIGH, 1, 1, {along}
*NODE PRINT, NSET=LOW, TOTALS=ONLY
RF
*END STEP
"""


def deck(up, along=0.0, time=1.0):
    low = [(x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
    nodes = [f"{i + 1}, {x}., {y}., {z}." for i, (x, y, z) in enumerate(low)]
    nodes += [f"{i + 11}, {0.1 + 0.8 * x}, {0.1 + 0.8 * y}, {z + 1}." for i, (x, y, z) in enumerate(low)]
    return DECK.format(nodes="\n".join(nodes), young=YOUNG, stiffness=STIFFNESS, increment=time / 20, time=time, up=up, along=along)


def tied():
    pulled = 1e-3
    return {"normal": {"type": "tied", "stiffness": STIFFNESS, "range": 1e-6}}, deck(pulled), pulled / (1 / BODIES + 1 / (STIFFNESS * AREA))


def cohesive():
    """Behind its strength the traction falls in a line to 0 at the gap 2 energy / strength."""
    strength, energy, pulled = 0.5, 5e-4, 1.4e-3
    first, last = strength / STIFFNESS, 2 * energy / strength
    slope = strength / (last - first)  # pulled = gap + t A / BODIES, t = slope (last - gap)
    gap = (pulled - slope * last * AREA / BODIES) / (1 - slope * AREA / BODIES)
    assert first < gap < last
    return ({"normal": {"type": "cohesive", "stiffness": STIFFNESS, "strength": strength, "energy": energy, "range": 1e-6}}, deck(pulled),
            AREA * slope * (last - gap))


def sliding(friction, coefficient, speed):
    """Pressed and moved at a speed: mu, at the mean pressure."""
    pressed, along = -1e-4, 0.05
    law = {"normal": NORMAL, "friction": {**PRESSED["friction"], **friction}}
    return law, deck(pressed, along, along / speed), lambda normal: coefficient(normal / AREA, speed)


def decay(speed):
    return sliding({"kinetic": 0.2, "decay": 3.0}, lambda pressure, v: 0.2 + 0.2 * math.exp(-3 * v), speed)


def table():
    """Bilinear in pressure and slip rate"""
    values = {"pressures": [0, 0.1], "slip_rates": [0, 1], "coefficients": [[0.5, 0.3], [0.4, 0.1]]}

    def coefficient(p, v):
        return (1 - 10 * p) * (0.5 - 0.2 * v) + 10 * p * (0.4 - 0.3 * v)
    return sliding({"coefficient": values}, coefficient, 0.25)


LAWS = {"tied": tied, "cohesive": cohesive, "kinetic, slow": lambda: decay(0.1), "kinetic, fast": lambda: decay(0.5), "table": table}


def main():
    programs = ccx_decks.Programs(ccx_decks.parser(__doc__).parse_args().build)
    wrong = 0
    print("law               in ccx        exact")
    for name, of in LAWS.items():
        contact, text, exact = of()
        folder = programs.folder("deck_laws", name.replace(", ", "_"))
        (folder / "cubes.inp").write_text(text)
        (folder / "model.json").write_text(json.dumps({"contact": contact}))
        _, message = programs.run(folder, "cubes.inp", "--model", "model.json")
        if message:
            print(f"{name:14} {message}   WRONG")
            wrong += 1
            continue
        x, y, normal = ccx_decks.total(folder / "cubes_ents/cubes.dat")
        ours = math.hypot(x, y) / normal if callable(exact) else abs(normal)
        exact = exact(normal) if callable(exact) else exact
        right = abs(ours - exact) <= 1e-4 * exact
        print(f"{name:14} {ours:10.6f}   {exact:10.6f}{'' if right else '   WRONG'}")
        wrong += not right
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
