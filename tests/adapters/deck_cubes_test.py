#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Cubes on each other with faces that do not match, translated by ents-deck and solved by ccx with U1E: how far are the
stresses of all integration points from the uniform pressure on top? Right: 0.

  deck_cubes_test.py --build build                            # the pairs of the test, at most .5 % (C3D8) and 1 % (C3D20)
  deck_cubes_test.py --build build --faces 1:4 2:5 --points 3  # slave faces per side on master faces; any error is printed
"""
import re
import sys

import ccx_decks

GATES = {"C3D8": 5e-3, "C3D20": 1e-2}
# The last of each lie over much finer faces, which want more points than the others, or are refused to be right with a remark.
PAIRS = {"C3D8": ("2:3", "3:2", "4:5", "2:5", "1:4"), "C3D20": ("2:3", "3:2")}
CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
EDGES = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))
HEAD = """*MATERIAL, NAME=M
*ELASTIC
1000., 0.3
*SOLID SECTION, ELSET=LOW, MATERIAL=M
*SOLID SECTION, ELSET=HIGH, MATERIAL=M
*SURFACE INTERACTION, NAME=I
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
1e7
*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE
SLAVE, MASTER
*BOUNDARY
X, 1
Y, 2
Z, 3
*STEP, NLGEOM
*STATIC
1., 1.
*DLOAD
TOP, P2, 0.1
*EL PRINT, ELSET=LOW
S
*EL PRINT, ELSET=HIGH
S
*END STEP
"""


def cube(n, bottom, nodes, first, quadratic):
    """n x n x 2 elements of a unit cube. Nodes are appended to `nodes`. Returns (number, nodes, layer) of each element."""
    known = {}

    def node(place):
        if place not in known:
            nodes.append((place[0] / (2 * n), place[1] / (2 * n), bottom + place[2] / 4))
            known[place] = len(nodes)
        return known[place]

    out = []
    for k, j, i in ((k, j, i) for k in range(2) for j in range(n) for i in range(n)):
        corners = [tuple(2 * (a + b) for a, b in zip((i, j, k), corner)) for corner in CORNERS]
        middles = [tuple((a + b) // 2 for a, b in zip(corners[a], corners[b])) for a, b in EDGES] if quadratic else []
        out.append((first + len(out), [node(place) for place in corners + middles], k))
    return out


def deck(slave, master, kind):
    nodes = []
    low = cube(master, 0, nodes, 1, kind == "C3D20")
    high = cube(slave, 1, nodes, 1 + len(low), kind == "C3D20")
    lines = ["*NODE"] + [f"{i}, {x:.13g}, {y:.13g}, {z:.13g}" for i, (x, y, z) in enumerate(nodes, 1)]
    for name, elements in (("LOW", low), ("HIGH", high)):
        lines.append(f"*ELEMENT, TYPE={kind}, ELSET={name}")
        for number, of, _ in elements:
            words = [str(word) for word in (number, *of)]
            lines += [", ".join(words[:11]) + ("," if words[11:] else "")] + ([", ".join(words[11:])] if words[11:] else [])
    lines += ["*SURFACE, NAME=MASTER"] + [f"{e}, S2" for e, _, layer in low if layer == 1]
    lines += ["*SURFACE, NAME=SLAVE"] + [f"{e}, S1" for e, _, layer in high if layer == 0]
    for axis, name in enumerate("XYZ"):
        lines += [f"*NSET, NSET={name}"] + [f"{i}," for i, place in enumerate(nodes, 1) if place[axis] == 0]
    lines += ["*ELSET, ELSET=TOP"] + [f"{e}," for e, _, layer in high if layer == 1]
    return "\n".join(lines) + "\n" + HEAD


def error_of(programs, folder, text, points):
    """The largest |sigma_zz / pressure + 1|, and what ents-deck notes on finer faces."""
    (folder / "cubes.inp").write_text(text)
    printed, message = programs.run(folder, "cubes.inp", *(["--points", str(points)] if points is not None else []))
    if message:
        sys.exit(f"{folder.name}: {message}")
    rows = [line.split() for line in (folder / "cubes_ents/cubes.dat").read_text().splitlines()]
    stresses = [float(row[4]) for row in rows if len(row) == 8 and row[0].isdigit()]
    assert len(stresses) > 100, f"{folder}: {len(stresses)} stresses"
    return max(abs(stress / 0.1 + 1) for stress in stresses), re.search("much finer faces.*: (.*);", printed)


def main():
    parser = ccx_decks.parser(__doc__)
    parser.add_argument("--faces", nargs="+", metavar="N:M", help="slave faces per side : master faces [those of the test]")
    parser.add_argument("--points", type=int, help="per direction of a slave face [those that ents-deck chooses]")
    arguments = parser.parse_args()
    programs = ccx_decks.Programs(arguments.build)
    free = arguments.faces is not None or arguments.points is not None
    wrong = 0
    print("element  slave:master  largest error of a stress")
    for kind, gate in GATES.items():
        for pair in arguments.faces or PAIRS[kind]:
            slave, master = (int(word) for word in pair.split(":"))
            error, note = error_of(programs, programs.folder("deck_cubes", f"{kind}_{slave}_{master}"), deck(slave, master, kind), arguments.points)
            right = free or error <= gate
            print(f"{kind:8} {pair:13} {error:.2e}{'' if right else '   WRONG'}{'   ' + note[1] if note else ''}", flush=True)
            wrong += not right
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
