#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""make_nut.py > nut.inp: a sleeve whose bore is the thread of a nut, made of layers that wind with it.

The flank that the bolt is pulled against lies exactly on that of the bolt; crest, root and the other flank stay clear of it. Column j of nodes
is at the angle 2 pi j / COLUMNS and lifted by the lead, so that column COLUMNS is column 0, one pitch higher.
"""
import math
import sys
from dataclasses import dataclass

COLUMNS, LAYERS = 24, 4


@dataclass
class Thread:
    """major diameter [mm], pitch, half of the flanks' angle [degrees], width of crest and root over the pitch."""
    name: str
    diameter: float
    pitch: float
    half_angle: float = 30.0
    crest: float = 1 / 8
    root: float = 1 / 4

    @property
    def tan(self):
        return math.tan(math.radians(self.half_angle))

    @property
    def pitch_radius(self):
        return self.diameter / 2 - (0.5 - self.crest) * self.pitch / (2 * self.tan)

    def height(self):
        """The bolt's thread as a height of ents, over a cylinder of the pitch radius."""
        return {"type": "thread", "pitch": self.pitch, "flank_angles": [self.half_angle] * 2, "crest": self.crest * self.pitch,
                "root": self.root * self.pitch, "rounding": self.pitch / 64}


M20 = Thread("M20 x 2.5", 20, 2.5)


def profile(thread):
    """(axial place, radius) over one pitch, the middle of the bolt's crest at 0; and the loaded flank's first and last point."""
    p, major, crest = thread.pitch, thread.diameter / 2, thread.crest * thread.pitch / 2
    flank, clear, corner = (1 - thread.crest - thread.root) * p / 2, 0.06 * p, 0.02 * p  # corners of the bolt are rounded over p / 64

    def radius(place):  # of the bolt's flank
        return major - (place - crest) / thread.tan
    loaded = [-(crest + corner + (flank - 2 * corner) * (1 - k / 6)) for k in range(7)]
    low, top = radius(-loaded[0]), major + clear
    points = [(-p / 2, low), (0.5 * (loaded[0] - p / 2), low)]
    first = len(points)
    points += [(place, radius(-place)) for place in loaded]
    last = len(points) - 1
    other = [top + (low - top) * k / 3 for k in range(4)]
    back = [crest + (major - r) * thread.tan + clear for r in other]
    rise = loaded[-1] + 0.05 * p
    points += [(rise, top), (0.5 * (rise + back[0]), top)] + list(zip(back, other))
    return points, first, last


def nut(thread, turns=4):
    """Text of the deck: element set NUT, node set OUTER, surface FLANK (the loaded one)."""
    points, first, last = profile(thread)
    outer_radius = 0.75 * thread.diameter
    per_pitch, rows = len(points), turns * len(points)
    number, nodes = {}, []

    def node(column, row, layer):
        if column == COLUMNS and row + per_pitch <= rows:
            column, row = 0, row + per_pitch
        key = column, row, layer
        if key not in number:
            place, radius = points[row % per_pitch]
            angle = 2 * math.pi * column / COLUMNS
            z = place + thread.pitch * (row // per_pitch + column / COLUMNS)
            r = radius + (outer_radius - radius) * (layer / LAYERS) ** 1.5
            number[key] = len(nodes) + 1
            nodes.append((r * math.cos(angle), r * math.sin(angle), z))
        return number[key]

    elements, bore, outer = [], [], set()
    for column in range(COLUMNS):
        for row in range(rows):
            for layer in range(LAYERS):
                elements.append([node(column + a, row + b, layer + c) for b in (0, 1) for a, c in ((0, 0), (0, 1), (1, 1), (1, 0))])
                if layer == 0 and first <= row % per_pitch < last:
                    bore.append(len(elements))
            outer.update(node(column + a, row + b, LAYERS) for a in (0, 1) for b in (0, 1))
    lines = [f"** Sleeve with the thread of a nut, {thread.name}, made by make_nut.py", "*NODE"]
    lines += [f"{i}, " + ", ".join(f"{value:.9g}" for value in x) for i, x in enumerate(nodes, 1)]
    lines += ["*ELEMENT, TYPE=C3D8, ELSET=NUT"] + [f"{i}, " + ", ".join(map(str, of)) for i, of in enumerate(elements, 1)]
    lines += ["*NSET, NSET=OUTER"] + [", ".join(map(str, sorted(outer)[i:i + 12])) for i in range(0, len(outer), 12)]
    # face 6 of C3D8: nodes 4 1 5 8, the side of layer 0
    lines += ["*SURFACE, NAME=FLANK, TYPE=ELEMENT"] + [f"{e}, S6" for e in bore]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    if len(sys.argv) > 1:
        sys.exit(__doc__)
    print(nut(M20), end="")
