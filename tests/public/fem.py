# SPDX-License-Identifier: BSD-3-Clause
"""Small linear elastic bodies, and Newton's iteration with an ents.Contact between them."""
import itertools

import ents
import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import spsolve

GAUSS = {2: ([-1 / 3**0.5, 1 / 3**0.5], [1.0, 1.0]), 3: ([-0.6**0.5, 0.0, 0.6**0.5], [5 / 9, 8 / 9, 5 / 9])}
QUAD = [[-1, -1], [1, -1], [1, 1], [-1, 1]]
QUAD_FACES = [(1, 0), (2, 1), (3, 2), (0, 3)]
QUAD_EDGES = [(0, 1), (1, 2), (2, 3), (3, 0)]
HEX = [[*corner, z] for z in (-1, 1) for corner in QUAD]
HEX_EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
HEX_FACES = [(3, 2, 1, 0), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
TET = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
TET_EDGES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
TET_FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]


def _middles(corners, edges):
    corners = np.array(corners, float)
    return np.vstack([corners, [(corners[a] + corners[b]) / 2 for a, b in edges]])


def _with_middles(faces, edges, first):
    """Faces of corners -> faces of corners and the nodes in the middle of their sides, as in ents.h."""
    place = {frozenset(edge): first + k for k, edge in enumerate(edges)}
    return [(*face, *(place[frozenset((face[k], face[(k + 1) % len(face)]))] for k in range(len(face)))) for face in faces]


class Element:
    """Shape functions from nodes and monomials; a quadrature; the faces, whose normals, as ents.h has them, point outwards."""

    def __init__(self, nodes, powers, points, weights, faces):
        nodes, self.powers = np.array(nodes, float), np.array(powers)
        self.coefficients = np.linalg.inv(np.prod(nodes[:, None, :] ** self.powers, axis=2))
        self.points, self.weights, self.faces = np.array(points, float), np.array(weights, float), [list(face) for face in faces]

    def values(self, at):
        """N_a [nodes] at one point."""
        return np.prod(at ** self.powers, axis=1) @ self.coefficients

    def gradients(self, at):
        """dN_a / dxi_i [d][nodes] at one point."""
        rows = []
        for i in range(len(at)):
            lower = self.powers.copy()
            lower[:, i] = np.maximum(lower[:, i] - 1, 0)
            rows.append((self.powers[:, i] * np.prod(at ** lower, axis=1)) @ self.coefficients)
        return np.array(rows)


def _box(d, order):
    points, weights = GAUSS[order]
    return list(itertools.product(points, repeat=d)), [np.prod(w) for w in itertools.product(weights, repeat=d)]


def _serendipity(d):
    """Monomials of quad8, hex20: superlinear degree at most 2."""
    return [p for p in itertools.product(range(3), repeat=d) if sum(q for q in p if q > 1) <= 2]


A, B = 0.58541019662496845, 0.13819660112501051  # four points, exact for degree 2
ELEMENTS = {
    "quad4": Element(QUAD, list(itertools.product(range(2), repeat=2)), *_box(2, 2), QUAD_FACES),
    "quad8": Element(_middles(QUAD, QUAD_EDGES), _serendipity(2), *_box(2, 3), [(*face, 4 + k) for k, face in enumerate(QUAD_FACES)]),
    "hex8": Element(HEX, list(itertools.product(range(2), repeat=3)), *_box(3, 2), HEX_FACES),
    "hex20": Element(_middles(HEX, HEX_EDGES), _serendipity(3), *_box(3, 3), _with_middles(HEX_FACES, HEX_EDGES, 8)),
    "tet10": Element(_middles(TET, TET_EDGES), [p for p in itertools.product(range(3), repeat=3) if sum(p) <= 2],
                     [[B, B, B], [A, B, B], [B, A, B], [B, B, A]], [1 / 24] * 4, _with_middles(TET_FACES, TET_EDGES, 4)),
}


class Body:
    """positions [nodes][d], cells [cells][nodes of a cell] of one element type."""

    def __init__(self, element, positions, cells):
        self.element, self.positions, self.cells = ELEMENTS[element], np.array(positions, float), np.array(cells)

    def where(self, axis, value):
        """Nodes in a plane."""
        return np.flatnonzero(np.abs(self.positions[:, axis] - value) < 1e-9)

    def faces(self, axis, value):
        """Faces of cells in a plane, a list for each; of a face with two nodes in one place only one of them is named."""
        inside = np.isin(self.cells, self.where(axis, value))
        found = []
        for cell, on in zip(self.cells, inside):
            for face in self.element.faces:
                nodes = list(dict.fromkeys(cell[face].tolist()))
                if on[face].all() and len(nodes) >= self.positions.shape[1]:
                    found.append(nodes)
        return found

    def stiffness(self, young, poisson, axisymmetric=False):
        """Plane strain in the plane, or axisymmetric: x is the radius, all of the circle counts."""
        d, (cells, n) = self.positions.shape[1], self.cells.shape
        lame, shear = young * poisson / (1 + poisson) / (1 - 2 * poisson), young / 2 / (1 + poisson)
        pairs = [(i, i) for i in range(d)] + [(0, 1), (1, 2), (2, 0)][:1 if d == 2 else 3]
        c = np.diag([2 * shear] * d + [shear] * (len(pairs) - d) + [2 * shear] * axisymmetric)
        stretches = [*range(d), *[len(pairs)] * axisymmetric]
        c[np.ix_(stretches, stretches)] += lame
        k = np.zeros((cells, n * d, n * d))
        for at, weight in zip(self.element.points, self.element.weights):
            dn = self.element.gradients(at)
            jacobian = dn @ self.positions[self.cells]
            g, b = np.linalg.solve(jacobian, np.broadcast_to(dn, (cells, *dn.shape))), np.zeros((cells, len(c), n * d))
            for row, (i, j) in enumerate(pairs):
                b[:, row, i::d] = g[:, j]
                b[:, row, j::d] = g[:, i]
            volume = weight * np.linalg.det(jacobian)
            if axisymmetric:
                radius = self.positions[self.cells, 0] @ self.element.values(at)
                b[:, -1, ::d] = self.element.values(at) / radius[:, None]
                volume = volume * 2 * np.pi * radius
            k += volume[:, None, None] * (b.transpose(0, 2, 1) @ c @ b)
        dofs = (d * self.cells[:, :, None] + np.arange(d)).reshape(cells, -1)
        i, j = np.broadcast_arrays(dofs[:, :, None], dofs[:, None, :])
        size = self.positions.size
        return sparse.coo_matrix((k.ravel(), (i.ravel(), j.ravel())), (size, size)).tocsr()

    def joined(self, other):
        """Both bodies in one numbering, the nodes of the other behind those of this one."""
        both = Body.__new__(Body)
        both.element, both.positions = self.element, np.vstack([self.positions, other.positions])
        both.cells = np.vstack([self.cells, other.cells + len(self.positions)])
        return both


def block(element, counts, low, high, moved=None):
    """A box of counts[i] cells along axis i. moved(positions) -> positions makes it another body; tet10: six in each box."""
    d = len(counts)
    axes = [np.linspace(a, b, n + 1) for a, b, n in zip(low, high, counts)]
    x = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, d)
    number = np.arange(len(x)).reshape([n + 1 for n in counts])
    corner = lambda shift: number[tuple(slice(s, s + n) for s, n in zip(shift, counts))].ravel()
    unit = QUAD if d == 2 else HEX
    cells = np.stack([corner([(s + 1) // 2 for s in node]) for node in unit], 1)
    if moved is not None:
        x = moved(x)
    if element in ("quad8", "hex20"):
        return Body(element, *_add_middles(x, cells, HEX_EDGES if d == 3 else QUAD_EDGES))
    if element == "tet10":  # Kuhn's six tetrahedra along the diagonal 0 - 6
        paths = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]
        return Body(element, *_add_middles(x, np.vstack([cells[:, path] for path in paths]), TET_EDGES))
    return Body(element, x, cells)


def _add_middles(x, cells, edges):
    ends = np.sort(np.stack([cells[:, edge] for edge in np.array(edges)], 1).reshape(-1, 2), axis=1)
    unique, place = np.unique(ends, axis=0, return_inverse=True)
    return np.vstack([x, x[unique].mean(axis=1)]), np.hstack([cells, len(x) + place.reshape(len(cells), len(edges))])


class Problem:
    """A stiffness, held dofs and the contact: one increment at a time."""

    def __init__(self, stiffness, held, contact):
        self.k, self.contact, self.u = stiffness, contact, np.zeros(stiffness.shape[0])
        self.magnitude = abs(stiffness)
        self.held, self.free = np.array(held, int), np.setdiff1d(np.arange(stiffness.shape[0]), held)
        self.iterations, self.norms = [], []

    def solve(self, load=0.0, values=0.0, tolerance=1e-12, most=40, commit=True):
        """Newton's iteration until the free residual is below tolerance times the largest force, or below the rounding of K u.
        load [dofs]; values: displacements of the held dofs. Returns the contact's residual."""
        self.u[self.held] = values
        r, norm, small = self._residual(load, tolerance)
        norms = [norm]
        for _ in range(most):
            step = spsolve((self.k + self.contact.tangent)[self.free][:, self.free].tocsc(), r, permc_spec="MMD_AT_PLUS_A")
            r, norm, small = self._along(step, norm, load, tolerance)
            norms.append(norm)
            if small:
                break
        else:
            raise ArithmeticError(f"Newton's iteration: no convergence in {most} iterations, residuals {norms[0]:.2e} .. {norms[-1]:.2e}")
        self.iterations.append(len(norms) - 1)
        self.norms.append(norms)
        if commit:
            self.contact.commit()
        return self.contact.residual

    def _along(self, step, norm, load, tolerance):
        """A whole step, or a half, quarter or eighth of it: the first that makes the residual smaller, else the last that could be taken."""
        before, kept = self.u[self.free], None
        for factor in (1, 0.5, 0.25, 0.125, 0.0625):
            self.u[self.free] = before - factor * step
            try:
                found = self._residual(load, tolerance)
            except ents.CutStep as cut:
                kept = cut
                continue
            if found[1] < norm or found[2] or factor <= 0.125:
                return found
        raise kept

    def _residual(self, load, tolerance):
        """(residual of the free dofs, its largest entry, is it small enough)"""
        residual, _ = self.contact.update(self.u)
        internal = self.k @ self.u
        r = (internal + residual - load)[self.free]
        norm, scale = np.abs(r).max(), max(np.abs(internal).max(), np.abs(residual).max(), np.abs(load).max())
        return r, norm, norm <= max(tolerance * scale, 2**-50 * (self.magnitude @ np.abs(self.u)).max())


def dofs(nodes, d, *axes):
    """Equations of some nodes along some axes (default: all)."""
    return (d * np.asarray(nodes)[:, None] + np.array(axes or range(d))).ravel()


def face_loads(positions, faces, traction):
    """Consistent nodal loads of a constant traction [d] on the faces of one plane: [dofs]."""
    load = np.zeros_like(positions)
    for face in faces:
        corners = positions[np.array(face)]
        n = len(face)
        if positions.shape[1] == 2:
            share, area = [0.5, 0.5], np.linalg.norm(corners[1] - corners[0])
        elif n in (3, 6):
            share, area = ([1 / 3] * 3 if n == 3 else [0] * 3 + [1 / 3] * 3), np.linalg.norm(np.cross(corners[1] - corners[0], corners[2] - corners[0])) / 2
        else:  # parallelograms
            share, area = ([0.25] * 4 if n == 4 else [-1 / 12] * 4 + [1 / 3] * 4), np.linalg.norm(np.cross(corners[1] - corners[0], corners[3] - corners[0]))
        load[np.array(face)] += area * np.outer(share, traction)
    return load.ravel()
