# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of round bodies: discs in layers, sleeves whose layers wind with a thread, and their parts of a deck."""
import math


class Mesh:
    """Nodes by key, elements by set; surfaces are lists of (element, face); nodes that stay on their radius, as a wrench holds them."""

    def __init__(self):
        self.number, self.nodes, self.elements, self.surfaces, self.sets, self.held = {}, [], {}, {}, {}, []
        self.count = 0

    def node(self, key, x):
        if key not in self.number:
            self.number[key] = len(self.nodes) + 1
            self.nodes.append(x)
        return self.number[key]

    def element(self, owner, nodes):
        """A hexahedron, or a wedge of six nodes."""
        self.count += 1
        self.elements.setdefault((owner, len(nodes)), []).append((self.count, nodes))
        return self.count

    def at(self, nodes):
        return [self.nodes[n - 1] for n in nodes]

    def by_number(self):
        return {number: nodes for group in self.elements.values() for number, nodes in group}

    def deck(self, kinds):
        """Text: nodes, elements, sets and surfaces. `kinds`: element type by number of nodes."""
        lines = ["*NODE, NSET=ALL"] + [f"{i}, " + ", ".join(f"{v:.10g}" for v in x) for i, x in enumerate(self.nodes, 1)]
        for (owner, size), group in self.elements.items():
            lines.append(f"*ELEMENT, TYPE={kinds[size]}, ELSET={owner}")
            for number, nodes in group:
                words = [str(number)] + [str(n) for n in nodes]
                lines += [", ".join(words[i:i + 10]) + ("," if i + 10 < len(words) else "") for i in range(0, len(words), 10)]
        for name, members in self.sets.items():
            members = sorted(members)
            lines += [f"*NSET, NSET={name}"] + [", ".join(map(str, members[i:i + 12])) for i in range(0, len(members), 12)]
        for name, faces in self.surfaces.items():
            lines += [f"*SURFACE, NAME={name}, TYPE=ELEMENT"] + [f"{element}, S{face}" for element, face in faces]
        return "\n".join(lines) + "\n"


def core_point(a, b, radius, turn):
    """Of a square -1 .. 1 bent to a disc: equal parts of its sides are equal angles, its corner (1, -1) lies at the angle `turn`."""
    m = max(abs(a), abs(b))
    if m < 1e-12:
        return 0.0, 0.0
    side, t = (0, b / m) if a >= abs(b) - 1e-12 else (1, -a / m) if b >= abs(a) - 1e-12 else (2, -b / m) if -a >= abs(b) - 1e-12 else (3, a / m)
    r = radius * m * (m + (1 - m) * 0.85 / math.cos(math.pi / 4 * t))
    angle = math.pi / 4 * (1 + t + 2 * side) + turn
    return r * math.cos(angle), r * math.sin(angle)


def direction(column, columns):
    """Exactly (1, 0), (0, 1) ... at the quarters."""
    quarter, rest = divmod(column % columns * 4, columns)
    c, s = math.cos(rest * math.pi / 2 / columns), math.sin(rest * math.pi / 2 / columns)
    return [(c, s), (-s, c), (-c, -s), (s, -c)][int(quarter)]


class Disc:
    """Cross-section of a solid body: a core of n x n quadrilaterals and rings of 4 n, turned by `turn` columns.

    `name` tells the nodes of several bodies apart."""

    def __init__(self, mesh, name, columns, core, turn=0):
        assert columns % 4 == 0
        self.mesh, self.name, self.columns, self.core, self.turn = mesh, name, columns, core, turn

    def ring_node(self, z, column, ring, radius):
        c, s = direction(column + self.turn, self.columns)
        return self.mesh.node((self.name, round(z, 6), column % self.columns, ring), (radius * c, radius * s, z))

    def core_node(self, z, i, j):
        n = self.columns // 4
        if i in (0, n) or j in (0, n):  # the columns of the first ring
            column = j if i == n else n + (n - i) if j == n else 2 * n + (n - j) if i == 0 else 3 * n + i
            return self.ring_node(z, column, 0, self.core)
        return self.mesh.node((self.name, round(z, 6), "core", i, j), (*core_point(2 * i / n - 1, 2 * j / n - 1, self.core, 2 * math.pi * self.turn / self.columns), z))

    def core_layer(self, owner, low, high):
        n = self.columns // 4
        for i in range(n):
            for j in range(n):
                self.mesh.element(owner, [self.core_node(z, i + a, j + b) for z in (low, high) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))])

    def ring_layer(self, owner, low, high, radii_low, radii_high, first=0):
        """Rings `first` .. between two heights; radii of all rings, 0 being the core's. Returns {ring: elements}."""
        out = {}
        for k in range(first, len(radii_low) - 1):
            for c in range(self.columns):
                out.setdefault(k, []).append(self.mesh.element(owner, [
                    self.ring_node(z, c + a, k + b, radii[k + b]) for z, radii in ((low, radii_low), (high, radii_high)) for a, b in ((0, 0), (0, 1), (1, 1), (1, 0))]))
        return out


class Wound:
    """Sleeve of layers that wind with a thread of `pitch`: row m of column j is at z = start + pitch (m div rows + column / columns) + places[m mod rows].

    Its ends are flat: the rows nearest to z = low and high are moved there, and where they change a wedge closes the layer.
    """

    def __init__(self, mesh, name, columns, pitch, start, places, low, high, keep=0.5):
        self.mesh, self.name, self.columns, self.pitch, self.start, self.places = mesh, name, columns, pitch, start, places
        self.low, self.high, self.below = low, high, None  # below(column, layer): nodes of what the lower end joins
        heights = [(places[(i + 1) % len(places)] - places[i]) % pitch or pitch for i in range(len(places))]
        self.first, self.last = [], []
        for j in range(columns + 1):  # rows moved to the ends
            m = len(places) * (math.floor((low - start) / pitch) - 3)
            while self.row_z(j, m + 1) < low + keep * heights[m % len(places)]:
                m += 1
            self.first.append(m)
            while self.row_z(j, m) < high - keep * heights[m % len(places)]:
                m += 1
            self.last.append(m)

    def row_z(self, column, m):
        turn, place = divmod(m, len(self.places))
        return self.start + self.pitch * (turn + column / self.columns) + self.places[place]

    def z(self, column, m):
        return self.low if m <= self.first[column] else self.high if m >= self.last[column] else self.row_z(column, m)

    def node(self, column, m, layer, radius, z=None):
        """`z` differs from the row's on the flanks of a ridge, and is not given elsewhere."""
        if self.below and m <= self.first[column]:
            return self.below(column, layer)
        z = self.z(column, m) if z is None else z
        c, s = direction(column, self.columns)
        if column == self.columns:
            column, m = 0, m + len(self.places)
        return self.mesh.node((self.name, column, m, layer), (radius * c, radius * s, z))

    def sleeve(self, owner, radii, layer_names=None):
        """Layers between radii[0] < radii[1] ...; returns {(column, row): elements by layer}."""
        layers, out = layer_names or list(range(len(radii))), {}
        for j in range(self.columns):
            bottom, top = (min(self.first[j:j + 2]), max(self.last[j:j + 2]))
            for m in range(bottom, top):
                corners = [(j, m), (j + 1, m), (j + 1, m + 1), (j, m + 1)]
                inside = [(c, i) for c, i in corners if self.first[c] <= i <= self.last[c]]
                if len(inside) < 3:
                    continue
                made = []
                for k in range(len(radii) - 1):
                    inner = [self.node(c, i, layers[k], radii[k]) for c, i in inside]
                    outer = [self.node(c, i, layers[k + 1], radii[k + 1]) for c, i in inside]
                    if len(inside) == 3:
                        made.append(self.mesh.element(owner, inner + outer))
                    else:
                        a, b, c, d = inner
                        e, f, g, h = outer
                        made.append(self.mesh.element(owner, [a, e, f, b, d, h, g, c]))
                out[j, m] = made
        return out
