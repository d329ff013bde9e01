#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""make_nut.py > nut.inp: a sleeve whose bore is the thread of an M20 nut, made of layers that wind with it.

The flank that the bolt is pulled against lies exactly on that of the bolt (ISO 68-1, pitch 2.5, flanks of 30 degrees); crest, root and the
other flank stay clear of it. Column j of nodes is at the angle 2 pi j / COLUMNS and lifted by the lead, so that column COLUMNS is column 0, one
pitch higher.
"""
import math

PITCH, TURNS, COLUMNS, LAYERS, OUTER = 2.5, 4, 24, 4, 15.0
CREST, TAN = PITCH / 8, math.tan(math.radians(30))  # of the bolt, whose major radius is 10


def profile():
    """(axial place, radius) over one pitch, the middle of the bolt's crest at 0; and the number of the loaded flank's first and last point."""
    def flank(radius):
        return -(CREST / 2 + (10 - radius) * TAN)
    points = [(-PITCH / 2, 8.95), (-1.0, 8.95)]
    first = len(points)
    points += [(flank(8.95 + 0.125 * k), 8.95 + 0.125 * k) for k in range(7)]
    last = len(points) - 1
    points += [(-0.2, 10.15), (0.05, 10.15), (0.3, 10.15), (0.50417, 9.75), (0.70833, 9.35), (0.9125, 8.95)]
    return points, first, last


def main():
    points, first, last = profile()
    per_pitch, rows = len(points), TURNS * len(points)
    number, nodes = {}, []

    def node(column, row, layer):
        if column == COLUMNS and row + per_pitch <= rows:
            column, row = 0, row + per_pitch
        key = column, row, layer
        if key not in number:
            place, radius = points[row % per_pitch]
            angle = 2 * math.pi * column / COLUMNS
            z = place + PITCH * (row // per_pitch) + PITCH * column / COLUMNS
            r = radius + (OUTER - radius) * (layer / LAYERS) ** 1.5
            number[key] = len(nodes) + 1
            nodes.append((r * math.cos(angle), r * math.sin(angle), z))
        return number[key]

    elements, bore, outer = [], [], set()
    for column in range(COLUMNS):
        for row in range(rows):
            for layer in range(LAYERS):
                corner = [node(column + a, row + b, layer + c) for b in (0, 1) for a, c in ((0, 0), (0, 1), (1, 1), (1, 0))]
                elements.append(corner)
                if layer == 0 and first <= row % per_pitch < last:
                    bore.append(len(elements))
            outer.update((node(column + a, row + b, LAYERS) for a in (0, 1) for b in (0, 1)))
    print("** Sleeve with the thread of an M20 nut, made by make_nut.py")
    print("*NODE")
    for i, x in enumerate(nodes, 1):
        print(f"{i}, " + ", ".join(f"{value:.10g}" for value in x))
    print("*ELEMENT, TYPE=C3D8, ELSET=NUT")
    for i, of in enumerate(elements, 1):
        print(f"{i}, " + ", ".join(map(str, of)))
    print("*NSET, NSET=OUTER")
    for n in sorted(outer):
        print(n)
    # face 6 of C3D8: nodes 4 1 5 8, the side of layer 0
    print("*SURFACE, NAME=FLANK, TYPE=ELEMENT")
    for e in bore:
        print(f"{e}, S6")


main()
