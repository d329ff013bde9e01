#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""*GAP CONDUCTANCE and *GAP HEAT GENERATION of a deck for ccx, through ents-deck in ccx, against exact values.

usage: deck_heat_test.py [--build DIR]

The two cubes of deck_laws_test.py with temperatures: the lower one is cold, the upper one hot on top, or cold and dragged. Prints a line
per keyword: power in ccx, its exact value, and what ccx's own contact conducts on the same deck (of this friction it makes no heat). Exit
status: 0 all within 0.01 %; 1 not; 3 ccx is not here."""
import re
import subprocess
import sys

import ccx_decks
from deck_laws_test import AREA, BODIES, DECK, STIFFNESS, deck

HOT, CONDUCTIVITY = 100.0, 20.0
PUSHED, ALONG, TIME = -1e-4, 0.05, 0.5
SHARE, SLAVE, MU = 0.9, 0.3, 0.4
NORMAL = -PUSHED / (1 / BODIES + 1 / (STIFFNESS * AREA))


def heated(text, law, temperatures):
    """The deck with temperatures, prescribed at its sets, and what conducts."""
    changes = [("*NSET, NSET=HIGH", "*NSET, NSET=BOTTOM\n1, 2, 3, 4\n*NSET, NSET=HIGH"), ("*SOLID SECTION, ELSET=LOWER", f"*CONDUCTIVITY\n{CONDUCTIVITY}\n*SOLID SECTION, ELSET=LOWER"),
               ("*CONTACT PAIR", law + "*CONTACT PAIR"),
               ("*STEP", "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNALL, 0.\n*STEP"),
               ("*STATIC, DIRECT", "*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE, DIRECT"),
               ("TOP, 3, 3", "".join(f"{name}, 11, 11, {value}\n" for name, value in temperatures) + "TOP, 3, 3"),
               ("*END STEP", "*NODE PRINT, NSET=LOW, TOTALS=ONLY\nRFL\n*NODE PRINT, NSET=HIGH, TOTALS=ONLY\nRFL\n*END STEP")]
    assert all(text.count(old) == 1 for old, _ in changes) and "*STATIC, DIRECT" in DECK
    for old, new in changes:
        text = text.replace(old, new)
    return text


def conducted(conductance):
    return HOT * AREA / (1 / CONDUCTIVITY + 1 / conductance)


def cases():
    """Name: deck, exact power into the lower cube, into the upper one or None."""
    pressed = deck(PUSHED), [("LOW", 0.0), ("TOP", HOT)]
    pressure = NORMAL / AREA
    assert 0.05 < pressure < 0.2
    yield "constant", heated(pressed[0], "*GAP CONDUCTANCE\n7., , 293.\n", pressed[1]), conducted(7.0), None
    table = 3 + (pressure - 0.05) / 0.15 * 6
    yield "table", heated(pressed[0], "*GAP CONDUCTANCE\n3., 0.05\n9., 0.2\n", pressed[1]), conducted(table), None
    dragged = heated(deck(PUSHED, ALONG, TIME), f"*FRICTION\n{MU}, 1e5\n*GAP HEAT GENERATION\n{SHARE}, {SLAVE}, -1.\n",
                     [("BOTTOM", 0.0), ("TOP", 0.0)])
    power = SHARE * MU * NORMAL * ALONG / TIME
    yield "friction", dragged, (1 - SLAVE) * power, SLAVE * power


def power(dat, name):
    """That has left the model at a set at last: what entered the body there."""
    return -float(re.findall(rf"total heat generation for set {name} .*\n\s*\n\s*(\S+)", dat.read_text())[-1])


def main():
    programs = ccx_decks.Programs(ccx_decks.parser(__doc__).parse_args().build)
    wrong = 0
    print("heat      into       in ccx        exact  own contact")
    for name, text, lower, upper in cases():
        folder = programs.folder("deck_heat", name)
        (folder / "cubes.inp").write_text(text)
        _, message = programs.run(folder, "cubes.inp")
        if message:
            print(f"{name:10}{message}   WRONG")
            wrong += 1
            continue
        subprocess.run([programs.ccx, "cubes"], cwd=folder, capture_output=True, check=False)  # no contact elements
        for body, exact in (("LOW", lower), ("HIGH", upper)):
            if exact is None:
                continue
            ours = power(folder / "cubes_ents/cubes.dat", body)
            theirs = power(folder / "cubes.dat", body)
            right = abs(ours - exact) <= 1e-4 * exact and (name == "friction" or abs(theirs - exact) <= 1e-4 * exact)
            print(f"{name:10}{body:5}{ours:12.7g} {exact:12.7g} {theirs:12.7g}{'' if right else '   WRONG'}")
            wrong += not right
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
