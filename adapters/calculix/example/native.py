#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Contact of two blocks in ccx, with U1E and with ccx's own node-to-surface contact: the same penalty, a flat master.

usage: native.py write OUT
       native.py compare OUT

write    OUT/ents_N/job.inp, OUT/native_N/job.inp for every penalty; OUT/friction/job.inp: ccx's own contact with friction, no U1E
compare  the forces that ccx left beside them

exit status: 0 they agree, 1 they do not"""
import json
import pathlib
import sys

# [F/A/L]. Young's modulus over the size of a cell is 2e3: contact springs from as soft as the cells to 100 times stiffer.
PENALTIES = [2e3, 6e3, 2e4, 6e4, 2e5]
YOUNG, POISSON = 1000.0, 0.3
INCREMENTS, PUSH, GAP = 4, [0.02, 0.01, -0.09], 0.01
# ccx's law is p = K d (1/2 + arctan(d / e) / pi) with e = pi TENSION / K: at depths d >> e a linear one. Its largest deviation is TENSION, a share of 1e-9 of
# the pressures here, about 100.
TENSION = 1e-7
# A pressure of 60 on a body of 1000 makes slave faces grow by twice 0.3 * 0.06, and by more at the corners of the block.
GROWTH = 0.1
# ccx prints seven digits, with half a unit of the seventh as error in each of the two forces.
PRINTED = 1e-6


class Block:
    """Nodes and C3D8 of a block from `low` to `high` with `cells`; numbers start at `first`."""

    def __init__(self, first, low, high, cells):
        nx, ny, nz = (n + 1 for n in cells)
        number = lambda i, j, k: first + i + nx * (j + ny * k)
        at = lambda axis, i: low[axis] + (high[axis] - low[axis]) * i / cells[axis]
        self.nodes = [(number(i, j, k), at(0, i), at(1, j), at(2, k)) for k in range(nz) for j in range(ny) for i in range(nx)]
        self.cells = [(first + i + cells[0] * (j + cells[1] * k), [number(i + a, j + b, k + c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))])
                      for k in range(cells[2]) for j in range(cells[1]) for i in range(cells[0])]
        layer = cells[0] * cells[1]
        self.below, self.above = self.cells[:layer], self.cells[-layer:]
        self.floor, self.top = [n[0] for n in self.nodes[:nx * ny]], [n[0] for n in self.nodes[-nx * ny:]]
        self.shape = nx, ny


def deck(penalty, native, friction=()):
    """Deck, and U1E's model and areas. friction: lines of ccx's own contact."""
    lower = Block(1, [0, 0, 0], [1.5, 1.5, 1], [3, 3, 2])
    upper = Block(1001, [0.2, 0.25, 1 + GAP], [1.2, 1.3, 1.8 + GAP], [4, 3, 2])
    lines = ["*NODE, NSET=ALL", *(", ".join(map(repr, node)) for block in (lower, upper) for node in block.nodes), "*ELEMENT, TYPE=C3D8, ELSET=BLOCKS",
             *(", ".join(map(str, [e] + nodes)) for block in (lower, upper) for e, nodes in block.cells),
             "*NSET, NSET=FLOOR", *(f"{n}," for n in lower.floor), "*NSET, NSET=TOP", *(f"{n}," for n in upper.top),
             "*MATERIAL, NAME=RUBBER", "*ELASTIC", f"{YOUNG}, {POISSON}", "*SOLID SECTION, ELSET=BLOCKS, MATERIAL=RUBBER"]
    model = areas = None
    if native:
        lines += ["*SURFACE, NAME=SLAVE, TYPE=ELEMENT", *(f"{e}, S1" for e, _ in upper.below),
                  "*SURFACE, NAME=MASTER, TYPE=ELEMENT", *(f"{e}, S2" for e, _ in lower.above),
                  "*SURFACE INTERACTION, NAME=LAW", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{penalty!r}, {TENSION!r}, 1.", *friction,
                  "*CONTACT PAIR, INTERACTION=LAW, TYPE=NODE TO SURFACE", "SLAVE, MASTER"]
    else:
        # One element a slave node, over all 9 facets of the master: 1 + 16 nodes.
        lines += [f"*USER ELEMENT, TYPE=U1E, NODES={1 + len(lower.top)}, INTEGRATION POINTS=1, MAXDOF=3", "*ELEMENT, TYPE=U1E, ELSET=CONTACT"]
        nx, ny = upper.shape
        cell = 1.0 / (nx - 1) * 1.05 / (ny - 1)
        areas = []
        for e, slave in enumerate(upper.floor):
            words = list(map(str, [5001 + e, slave] + lower.top))
            lines += [", ".join(words[:10]) + ",", ", ".join(words[10:])]
            areas.append(f"{5001 + e} {cell * (1 if 0 < e % nx < nx - 1 else 0.5) * (1 if 0 < e // nx < ny - 1 else 0.5)!r}")
        lines += ["*MATERIAL, NAME=CONTACT", "*ELASTIC", "1., 0.", "*DEPVAR", "16", "*USER SECTION, ELSET=CONTACT, MATERIAL=CONTACT, CONSTANTS=3", "1., 0., 0."]
        row, column = lower.shape[0], lower.shape[0] - 1
        patch = [[i + row * j, i + 1 + row * j, i + 1 + row * (j + 1), i + row * (j + 1)] for j in range(lower.shape[1] - 1) for i in range(column)]
        model = {"segment": "quad4", "patch": patch, "border": 0.05, "contact": {"normal": {"type": "penalty", "stiffness": penalty}}}
    lines += ["*STEP, NLGEOM, INC=100", "*STATIC", f"{1 / INCREMENTS!r}, 1., 1e-5, {1 / INCREMENTS!r}", "*CONTROLS, PARAMETERS=FIELD", "1.e-9, 1.e-9",
              "*BOUNDARY", "FLOOR, 1, 3", *(f"TOP, {i}, {i}, {u!r}" for i, u in enumerate(PUSH, 1)),
              "*NODE PRINT, NSET=FLOOR, TOTALS=ONLY", "RF", "*END STEP"]
    return lines, model, areas


def forces(folder):
    """On the support, of each increment; and iterations."""
    lines = (folder / "job.dat").read_text().splitlines()
    found = [[float(word) for word in lines[i + 2].split()] for i, line in enumerate(lines) if "total force" in line]
    rows = [line.split() for line in (folder / "job.sta").read_text().splitlines()]
    return found, [int(words[3]) for words in rows if len(words) >= 4 and words[0] == "1"]


def compare(out):
    """The two take the penalty times different areas, U1E the undeformed one of its deck, ccx that of the present slave faces. That is as if
    the penalty were another one by the growth of these faces, and changes the force by this share of the penalty's own error."""
    runs = [(penalty, forces(out / f"ents_{k}"), forces(out / f"native_{k}")) for k, penalty in enumerate(PENALTIES)]
    for penalty, (mine, _), (theirs, _) in runs:
        if not len(mine) == len(theirs) == INCREMENTS:
            sys.exit(f"penalty {penalty:g}: {len(mine)} and {len(theirs)} increments instead of {INCREMENTS}")
    ok = True
    # The error of a penalty falls as its inverse: two stiff ones tell the limit.
    (p, (f, _), _), (q, (g, _), _) = runs[-2:]
    limit = (q * g[-1][2] - p * f[-1][2]) / (q - p)
    print("penalty    vertical force: U1E  ccx's own     difference   error of the penalty   iterations U1E : ccx's own")
    for penalty, (mine, iterations), (theirs, their_iterations) in runs:
        size = max(abs(x) for force in theirs for x in force)
        difference = max(abs(a - b) for one, other in zip(mine, theirs) for a, b in zip(one, other)) / size
        error = abs(mine[-1][2] - limit) / size
        print(f"{penalty:<9.0e}  {mine[-1][2]:<19.7g}  {theirs[-1][2]:<12.7g}  {difference:<11.1e}  {error:<21.1e}  "
              f"{' '.join(map(str, iterations))} : {' '.join(map(str, their_iterations))}")
        ok = ok and difference <= GROWTH * error + PRINTED
    return ok


def main():
    if len(sys.argv) != 3 or sys.argv[1] not in ("write", "compare"):
        sys.exit(__doc__)
    out = pathlib.Path(sys.argv[2])
    if sys.argv[1] == "compare":
        sys.exit(0 if compare(out) else "U1E and ccx's own contact differ by more than their areas")
    (out / "friction").mkdir(parents=True, exist_ok=True)
    (out / "friction" / "job.inp").write_text("\n".join(deck(6e3, True, ["*FRICTION", "0.3, 3e3"])[0]) + "\n")
    for k, penalty in enumerate(PENALTIES):
        for name, native in (("ents", False), ("native", True)):
            folder = out / f"{name}_{k}"
            folder.mkdir(parents=True, exist_ok=True)
            lines, model, areas = deck(penalty, native)
            (folder / "job.inp").write_text("\n".join(lines) + "\n")
            if model:
                (folder / "ents_1.json").write_text(json.dumps(model, indent=1) + "\n")
                (folder / "ents_1.txt").write_text("\n".join(areas) + "\n")


if __name__ == "__main__":
    main()
