#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""make_wire.py: print wire.inp, the deck of the elastic wire, a quarter of the block around the contact."""
import math

RADIUS = 1.0  # mm


def graded(pieces, start):
    """Places from `start` on: (to, cells, ratio of neighbouring cells)."""
    places = [start]
    for to, cells, ratio in pieces:
        begin, sizes = places[-1], [ratio**i for i in range(cells)]
        for i in range(cells):
            places.append(begin + (to - begin) * sum(sizes[: i + 1]) / sum(sizes))
    return places


def wire():
    """A deck: the quarter x, y >= 0 of a piece of the wire along y, whose crest is the origin."""
    side = graded([(0.012, 10, 1), (0.08, 8, 1.45)], 0)
    depth = graded([(-0.005, 8, 0.69), (0, 4, 1)], -0.08)
    n, m = len(side), len(depth)
    number = lambda i, j, k: 1 + i + n * (j + n * k)
    lines = ["*NODE"]
    for k, z in enumerate(depth):
        for j, y in enumerate(side):
            for i, x in enumerate(side):
                round_surface = (math.sqrt(RADIUS**2 - x**2) - RADIUS) * (1 - z / depth[0])
                lines.append(f"{number(i, j, k)}, {x:.9g}, {y:.9g}, {z + round_surface:.9g}")
    lines.append("*ELEMENT, TYPE=C3D8, ELSET=WIRE")
    top, element = [], 0
    for k in range(m - 1):
        for j in range(n - 1):
            for i in range(n - 1):
                element += 1
                nodes = [number(i + a, j + b, k + c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
                lines.append(",".join(map(str, [element, *nodes])))
                top += [f"{element}, S2"] if k == m - 2 else []
    sides = {"X0": lambda i, j, k: i == 0, "Y0": lambda i, j, k: j == 0, "FAR": lambda i, j, k: i == n - 1 or j == n - 1 or k == 0}
    for name, inside in sides.items():
        lines.append(f"*NSET, NSET={name}")
        lines += [f"{number(i, j, k)}," for k in range(m) for j in range(n) for i in range(n) if inside(i, j, k)]
    return "\n".join([*lines, "*SURFACE, NAME=TOP, TYPE=ELEMENT", *top]) + "\n"


if __name__ == "__main__":
    print(wire(), end="")
