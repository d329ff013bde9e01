# SPDX-License-Identifier: BSD-3-Clause
"""One pitch of bolt and nut in plane strain, repeated along the axis: which plain bodies are as stiff, and how soft the contact between them has to be."""
import math

import numpy as np

from joint_parts import POISSON, YOUNG

DEEP = 4.0  # of both bodies below their threads, in pitches
PLANE = YOUNG / (1 - POISSON ** 2)
POINTS = (-math.sqrt(0.6), 0.0, math.sqrt(0.6)), (5 / 9, 8 / 9, 5 / 9)
CORNERS = [(-1, -1), (1, -1), (1, 1), (-1, 1)]


def at(values, j):
    """Halves lie in the middle."""
    return (values[math.floor(j)] + values[math.ceil(j)]) / 2


def derivatives(r, s):
    """Of the 8 shape functions."""
    out = [(a * (1 + b * s) * (2 * a * r + b * s) / 4, b * (1 + a * r) * (a * r + 2 * b * s) / 4) for a, b in CORNERS]
    for a, b in ((0, -1), (1, 0), (0, 1), (-1, 0)):
        out.append((-r * (1 + b * s), (1 - r * r) * b / 2) if a == 0 else ((1 - s * s) * a / 2, -s * (1 + a * r)))
    return np.array(out)


class Cell:
    """Quadrilaterals of 8 nodes; x is radial, y along the axis. Nodes of the row `rows` are one pitch above those of row 0."""

    def __init__(self, joint, fine):
        self.joint, self.ridge, self.groove, self.deep, self.flank = joint, 3 * fine, fine, 4 * fine, 2 * fine
        self.rows, self.number, self.nodes, self.elements = self.ridge + self.groove, {}, [], []
        crest, w, p = joint.diameter / 2, joint.half_width, joint.pitch
        # root, far side, where the flanks begin to touch, tip, lower and upper flank
        self.sides = {"bolt": (joint.root_radius, joint.root_radius - DEEP * p, joint.bore_radius, crest, lambda r: (-w(r), w(r))),
                      "nut": (crest + joint.clearance, crest + joint.clearance + DEEP * p, crest, joint.bore_radius,
                              lambda r: (-p + w(r) + joint.clearance, -w(r)))}
        for owner in self.sides:
            self.body(owner)
        self.x = np.array(self.nodes)
        self.k = self.stiffness()

    def body(self, owner):
        root, far, start, tip, edges = self.sides[owner]
        low, high = edges(root)
        base = [low + (high - low) * i / self.ridge for i in range(self.ridge + 1)]
        base += [high + (low + self.joint.pitch - high) * i / self.groove for i in range(1, self.groove + 1)]
        layers = [root + (far - root) * (j / self.deep) ** 2 for j in range(self.deep + 1)]
        radii = [root] + [start + (tip - start) * k / self.flank for k in range(self.flank + 1)]

        def above(i, j):
            low, high = edges(at(radii, j))
            return at(radii, j), low + (high - low) * i / self.ridge
        self.block(owner, self.rows, self.deep, -1, lambda i, j: (at(layers, j), at(base, i)))
        self.block(owner, self.ridge, self.flank + 1, 1, above)

    def block(self, owner, rows, columns, sign, point):
        for i in range(rows):
            for j in range(columns):
                places = [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j), (i, j + .5), (i + .5, j + 1), (i + 1, j + .5), (i + .5, j)]
                nodes = []
                for place in places:
                    key = owner, place[0], sign * place[1]
                    if key not in self.number:
                        self.number[key] = len(self.nodes)
                        self.nodes.append(point(*place))
                    nodes.append(self.number[key])
                self.elements.append(nodes)

    def stiffness(self):
        factor = YOUNG / ((1 + POISSON) * (1 - 2 * POISSON))
        law = factor * np.array([[1 - POISSON, POISSON, 0], [POISSON, 1 - POISSON, 0], [0, 0, 0.5 - POISSON]])
        out = np.zeros((self.x.size,) * 2)
        for nodes in self.elements:
            local, signs = np.zeros((16, 16)), set()
            for r, wr in zip(*POINTS):
                for s, ws in zip(*POINTS):
                    d = derivatives(r, s)
                    jacobian = d.T @ self.x[nodes]
                    size = np.linalg.det(jacobian)
                    signs.add(size > 0)
                    g, b = d @ np.linalg.inv(jacobian).T, np.zeros((3, 16))
                    b[0, 0::2], b[1, 1::2], b[2, 0::2], b[2, 1::2] = g[:, 0], g[:, 1], g[:, 1], g[:, 0]
                    local += wr * ws * abs(size) * b.T @ law @ b
            if len(signs) > 1:
                raise ValueError("an element of the cell is folded")
            dofs = [2 * n + k for n in nodes for k in (0, 1)]
            out[np.ix_(dofs, dofs)] += local
        return out

    def solve(self, k, held, jump=0.0):
        """Displacements and forces; held: {degree of freedom: displacement}; row `rows` moves as row 0, and by `jump` more along the axis."""
        n = self.x.size
        repeat, u = np.eye(n), np.zeros(n)
        for (owner, i, j), node in self.number.items():
            if i == self.rows:
                for c in (0, 1):
                    repeat[2 * node + c] = 0
                    repeat[2 * node + c, 2 * self.number[owner, 0, j] + c] = 1
                u[2 * node + 1] += jump
        for dof, value in held.items():
            u += repeat[:, dof] * value
        tied = {2 * node + c for (_, i, _), node in self.number.items() if i == self.rows for c in (0, 1)}
        free = np.array([dof for dof in range(n) if dof not in held and dof not in tied])
        part = repeat[:, free]
        u += part @ np.linalg.solve(part.T @ k @ part, -part.T @ (k @ u))
        return u, repeat.T @ (k @ u)

    def far(self, owner):
        return [n for n in range(len(self.nodes)) if abs(self.nodes[n][0] - self.sides[owner][1]) < 1e-9]

    def plain_depths(self):
        """How far the plain bodies reach beyond the roots: as stiff as the threaded ones in tension along the axis, one strain for all."""
        strain, out = 1e-3, []
        held = {2 * n: 0.0 for owner in self.sides for n in self.far(owner)}
        held |= {2 * self.number[owner, 0, -self.deep] + 1: 0.0 for owner in self.sides}
        u, _ = self.solve(self.k, held, strain * self.joint.pitch)
        for owner in self.sides:
            mine = np.array([2 * n + c for (name, _, _), n in self.number.items() if name == owner for c in (0, 1)])
            energy = u[mine] @ self.k[np.ix_(mine, mine)] @ u[mine]
            out.append(energy / (PLANE * strain ** 2 * self.joint.pitch) - DEEP * self.joint.pitch)
        return out

    def contact_stiffness(self, depths):
        """Force along the flank's normal, per length of helix and approach of the plain bodies."""
        joint, p, k = self.joint, self.joint.pitch, self.k.copy()
        sine, cosine = math.sin(math.radians(joint.half_angle)), math.cos(math.radians(joint.half_angle))
        normal, hard = np.array([-sine, cosine]), 1e4 * YOUNG / p  # of the nut's flank, which lies below that of the bolt
        for j in range(self.flank):
            bolt = [self.number["bolt", 0, 1 + j + h] for h in (0, .5, 1)]
            nut = [self.number["nut", self.ridge, 1 + self.flank - j - h] for h in (0, .5, 1)]
            for r, weight in zip(*POINTS):
                n = np.array([r * (r - 1) / 2, 1 - r * r, r * (r + 1) / 2])
                row = np.concatenate([np.outer(n, normal).ravel(), -np.outer(n, normal).ravel()])
                dofs = [2 * node + c for node in bolt + nut for c in (0, 1)]
                k[np.ix_(dofs, dofs)] += hard * weight * math.dist(self.nodes[bolt[0]], self.nodes[bolt[2]]) / 2 * np.outer(row, row)
        held = {2 * n + c: 0.0 for owner in self.sides for n in self.far(owner) for c in (0, 1)}
        pulled = 1e-3
        held |= {2 * n + 1: -pulled for n in self.far("bolt")}
        _, force = self.solve(k, held)
        ends = [n for (_, i, _), n in self.number.items() if i != self.rows and n in set(self.far("bolt"))]
        axial, radial = -sum(force[2 * n + 1] for n in ends), sum(force[2 * n] for n in ends)  # the wedge pushes the bolt inwards
        if abs(radial / axial / joint.tan - 1) > 1e-6:
            raise ValueError("the forces of the cell are not normal to its flanks")
        # What the plain bodies deform by themselves is theirs.
        depth = 2 * DEEP * p + sum(depths)
        shear, tension = YOUNG / (2 * (1 + POISSON)), YOUNG * (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON))
        approach = (pulled - axial / p * depth / shear) * cosine - radial / p * depth / tension * sine
        return math.hypot(axial, radial) / approach
