#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""ents-deck run on decks whose bodies move open beyond their patches and then close, against ccx's own contact in the same ccx.

usage: deck_run_test.py [--build DIR] [DECK ...]

Prints a line per deck: reaction force of ccx's own contact, that of ents-deck run, runs. Exit status: 0 all within 0.5 % (geared: 1 %); 1 not; 3 ccx is not here."""
import math
import pathlib
import shutil
import subprocess
import sys

import ccx_decks

HERE = pathlib.Path(__file__).resolve().parent
# Of the force: points in faces against ccx's cut faces. The face of `geared` ends its way with a kink of the master between two of its eight points.
TOLERANCE, WIDER = 5e-3, {"geared": 1e-2}
# deck: runs that it takes. The first slides of lever and geared are those of what is driven alone, the first moves open and the second in contact; the others are known before. The bodies of shared_tip have a common node.
RUNS = {"lever": 2, "geared": 3, "amplitude": 1, "transform": 1, "rotation": 1, "shared_tip": 1, "press": 1}


def force(dat):
    return math.hypot(*ccx_decks.total(dat))


def main():
    parser = ccx_decks.parser(__doc__)
    parser.add_argument("decks", nargs="*", default=list(RUNS))
    arguments = parser.parse_args()
    programs = ccx_decks.Programs(arguments.build)
    wrong = 0
    print("deck         ccx's own   ents-deck run   runs")
    for name in arguments.decks:
        folder = programs.folder("deck_run", name)
        paths = [HERE / "decks" / f"{name}.inp", HERE.parents[1] / "adapters/deck/example" / f"{name}.inp"]
        shutil.copy(next(path for path in paths if path.exists()), folder)
        subprocess.run([programs.ccx, name], cwd=folder, stdout=(folder / "own.log").open("w"), check=True)
        printed, message = programs.run(folder, f"{name}.inp")
        if message:
            print(f"{name:12} {message}")
            wrong += 1
            continue
        own, ours = force(folder / f"{name}.dat"), force(folder / f"{name}_ents/{name}.dat")
        runs = printed.count("\nrun ")
        right = own > 0 and abs(ours - own) <= WIDER.get(name, TOLERANCE) * own and runs == RUNS[name]
        print(f"{name:12} {own:9.4f}   {ours:13.4f}   {runs}{'' if right else '   WRONG'}")
        wrong += not right
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
