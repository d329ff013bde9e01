#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""*GAP CONDUCTANCE and *GAP HEAT GENERATION of a deck for ccx, through ents-deck in ccx, against exact values.

usage: deck_heat_test.py [--build DIR]

The two cubes of deck_laws_test.py with temperatures: the lower one is cold, the upper one hot on top, or cold and dragged. Prints a line
per keyword: power in ccx, its exact value, and what ccx's own contact conducts on the same deck (of this friction it makes no heat). Then a
step in time, with inertia, against ccx's own contact. Exit status: 0 all within 0.002 %, in time 0.02 % of the largest; 1 not; 3 ccx is not
here."""
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


def swinging():
    """Without STEADY STATE: the upper cube is pushed on the lower one within a fifth of the time, and swings."""
    text = heated(deck(PUSHED), "*GAP CONDUCTANCE\n3., 0.05\n9., 0.2\n", [("LOW", 0.0), ("TOP", HOT)])
    for old, new in ((", STEADY STATE", ""), ("*CONDUCTIVITY", "*DENSITY\n100.\n*SPECIFIC HEAT\n0.01\n*EXPANSION\n1e-6\n*CONDUCTIVITY"),
                     ("*STEP", "*AMPLITUDE, NAME=RAMP\n0., 0., 0.2, 1., 2., 1.\n*STEP"), ("TOP, 3, 3", "*BOUNDARY, AMPLITUDE=RAMP\nTOP, 3, 3"),
                     ("*NODE PRINT, NSET=LOW, TOTALS=ONLY\nRF\n", "*CONTROLS, PARAMETERS=FIELD\n1e-7, 1e-7\n*NODE PRINT, NSET=LOW, TOTALS=ONLY\nRF\n")):
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return text


def powers(dat, name):
    """That have left the model at a set, increment by increment: what entered the body there."""
    return [-float(x) for x in re.findall(rf"total heat generation for set {name} .*\n\s*\n\s*(\S+)", dat.read_text())]


def pushes(dat):
    """Vertical forces on the lower cube, increment by increment."""
    return [float(x) for x in re.findall(r"total force.*\n\s*\n\s*\S+\s+\S+\s+(\S+)", dat.read_text())]


def solve(programs, name, text):
    """With contact elements and with ccx's own contact. Returns the two .dat files, or None."""
    folder = programs.folder("deck_heat", name)
    (folder / "cubes.inp").write_text(text)
    _, message = programs.run(folder, "cubes.inp")
    if message:
        print(f"{name:10}{message}   WRONG")
        return None
    subprocess.run([programs.ccx, "cubes"], cwd=folder, capture_output=True, check=False)
    return folder / "cubes_ents/cubes.dat", folder / "cubes.dat"


def main():
    programs = ccx_decks.Programs(ccx_decks.parser(__doc__).parse_args().build)
    wrong = 0
    print("heat      into       in ccx        exact  own contact")
    for name, text, lower, upper in cases():
        files = solve(programs, name, text)
        for body, exact in (("LOW", lower), ("HIGH", upper)) if files else ():
            if exact is None:
                continue
            ours, theirs = (powers(dat, body)[-1] for dat in files)
            right = abs(ours - exact) <= 2e-5 * exact and (name == "friction" or abs(theirs - exact) <= 2e-5 * exact)
            print(f"{name:10}{body:5}{ours:12.7g} {exact:12.7g} {theirs:12.7g}{'' if right else '   WRONG'}")
            wrong += not right
        wrong += files is None
    files = solve(programs, "swinging", swinging())
    for what, of in (("force", pushes), ("power", lambda dat: powers(dat, "LOW"))) if files else ():
        ours, theirs = map(of, files)
        difference = max(abs(a - b) for a, b in zip(ours, theirs)) / max(map(abs, theirs))
        swing = max(theirs[5:]) / min(theirs[5:])
        right = len(ours) == len(theirs) == 20 and difference <= 2e-4 and swing > 1.2
        print(f"in time   {what}: {difference:.1e} of the largest from ccx's own contact, largest / smallest {swing:.2f}{'' if right else '   WRONG'}")
        wrong += not right
    wrong += files is None
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
