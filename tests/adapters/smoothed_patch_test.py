# SPDX-License-Identifier: BSD-3-Clause
"""The contact patch test with smoothed masters: two blocks with flush ends under a uniform traction of 1, pressure at the slave points.

usage: smoothed_patch_test.py PACKAGE_FOLDER [--table]     --table prints the table of core/README.md"""
import pathlib
import sys
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(sys.argv[1]).resolve()))
sys.dont_write_bytecode = True
import ents  # noqa: E402

YOUNG, POISSON, STIFFNESS, RAISED = 1000.0, 0.3, 1e5, 1e-6
STRAIGHT, CUBIC, PARABOLIC = ents.ENDS_STRAIGHT, ents.ENDS_QUASI_CUBIC, ents.ENDS_QUASI_PARABOLIC
ROWS = (("line2", None), ("catmull_rom4", STRAIGHT), ("bspline4", STRAIGHT), ("bspline4", PARABOLIC), ("bspline4", CUBIC),
        ("bspline4", "mirror"))


class Rows:
    """A full matrix in compressed rows."""

    def __init__(self, n):
        self.indptr, self.indices, self.data = np.arange(n + 1) * n, np.tile(np.arange(n), n), np.zeros(n * n)
        self.shape = (n, n)

    def dense(self):
        return self.data.reshape(self.shape)


def block(n, low, high, rows=4):
    """Nodes row by row from the bottom, and the stiffness of bilinear plane strain elements."""
    x, y = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(low, high, rows + 1))
    nodes = np.column_stack([x.ravel(), y.ravel()])
    a, b = 0.5 / n, 0.5 * (high - low) / rows
    c = YOUNG / ((1 + POISSON) * (1 - 2 * POISSON)) * np.array(
        [[1 - POISSON, POISSON, 0], [POISSON, 1 - POISSON, 0], [0, 0, 0.5 - POISSON]])
    element = np.zeros((8, 8))
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    for s, t in corners / np.sqrt(3):
        dx, dy = corners[:, 0] * (1 + corners[:, 1] * t) / 4 / a, corners[:, 1] * (1 + corners[:, 0] * s) / 4 / b
        strain = np.zeros((3, 8))
        strain[0, ::2], strain[1, 1::2], strain[2, ::2], strain[2, 1::2] = dx, dy, dy, dx
        element += a * b * strain.T @ c @ strain
    k = np.zeros((2 * len(nodes), 2 * len(nodes)))
    for j in range(rows):
        for i in range(n):
            corner = j * (n + 1) + i
            dofs = (2 * np.array([corner, corner + 1, corner + n + 2, corner + n + 1])[:, None] + [0, 1]).ravel()
            k[np.ix_(dofs, dofs)] += element
    return nodes, k


def pressures(segment, ends, masters, slaves, sampling=0):
    """Pressure at the slave nodes, or at the points inside their facets. ends "mirror": planes of symmetry at both ends, CUBIC."""
    model = ents.Model({"segment": segment, "border": 0.01, "contact": {"normal": {"type": "penalty", "stiffness": STIFFNESS}}})
    library = model.library
    (lower, k_lower), (upper, k_upper) = block(masters, -0.5, 0.0), block(slaves, 0.0, 0.5)
    upper[:, 1] -= RAISED  # closed from the start
    x = np.vstack([lower, upper])
    n, first = 2 * len(x), len(lower)
    k = np.zeros((n, n))
    k[:2 * first, :2 * first], k[2 * first:, 2 * first:] = k_lower, k_upper
    master = first - masters - 1 + np.arange(masters + 1)
    facets = np.column_stack([np.arange(masters), np.arange(1, masters + 1)])
    if segment == "line2":
        segments, control = facets, (np.arange(masters + 2), np.arange(masters + 1), np.ones(masters + 1))
    elif ends == "mirror":
        segments, control = library.smooth("line2", segment, facets, masters + 1, CUBIC, [("x", 0.0), ("x", 1.0)], x[master])
    else:
        segments, control = library.smooth("line2", segment, facets, masters + 1, ends)
    slave = first + np.arange(slaves + 1)
    slave_facets = np.column_stack([np.arange(slaves), np.arange(1, slaves + 1)])
    if sampling:
        inside, area = library.sampling_points("line2", sampling, slave_facets, x[slave])
    else:
        inside = (np.arange(slaves + 2), np.arange(slaves + 1), np.ones(slaves + 1))
        area = library.tributary_areas("line2", slave_facets, x[slave])
    load = np.zeros(n)
    top = first + len(upper) - slaves - 1 + np.arange(slaves + 1)
    load[2 * top + 1] = -np.where((top == top[0]) | (top == top[-1]), 0.5, 1.0) / slaves
    sides = np.flatnonzero((x[:, 0] == 0) | (x[:, 0] == 1))
    free = np.setdiff1d(np.arange(n), np.concatenate([2 * sides, 2 * np.arange(masters + 1) + 1]))
    equations = np.arange(n).reshape(-1, 2)
    u = np.zeros(n)
    tree = ents.Tree(model, segments, library.combine(control, x[master]))
    for _ in range(12):
        now = x + u.reshape(-1, 2)
        tree.move(library.combine(control, now[master]))
        points = library.combine(inside, now[slave])
        matrix = Rows(n)
        system = ents.System(equations[slave], equations[master], matrix, slave=inside, master=control)
        result = model.assemble(system, points, tree, tree.detect(points, reach=0.2)["segment"], "gap", area=area)
        residual = k @ u - load + system.residual
        if np.abs(residual[free]).max() < 1e-12:
            break
        u[free] -= np.linalg.solve((k + matrix.dense())[np.ix_(free, free)], residual[free])
    else:
        raise RuntimeError(f"no convergence: {np.abs(residual[free]).max()}")
    return -STIFFNESS * result["gap"], area


class SmoothedPatchTest(unittest.TestCase):
    def check(self, row, masters, slaves, sampling, low, high):
        p, area = pressures(*row, masters, slaves, sampling)
        self.assertAlmostEqual(p @ area, 1, delta=1e-6)  # the whole load; normals tilt by up to 1e-4
        worst = np.abs(p - 1).max()
        self.assertTrue(low <= worst <= high, f"{row} {masters}:{slaves} sampling {sampling}: {p}")

    def test_what_passes(self):
        """Newton stops at 1e-12 of forces of 1 / 8; the law is 100 times as stiff as the mesh."""
        for row in (ROWS[0], ROWS[1], ROWS[3], ROWS[5]):
            self.check(row, 8, 8, 0, 0, 1e-9)
        for sampling in (2, 8):
            self.check(ROWS[5], 8, 8, sampling, 0, 1e-9)  # Gauss and Legendre's 2 points are exact for cubics

    def test_what_does_not(self):
        """Recorded: the largest error of the pressure, from and to."""
        self.check(("bspline4", STRAIGHT), 8, 8, 0, 0.1, 0.2)
        self.check(("bspline4", CUBIC), 8, 8, 0, 0.01, 0.1)
        for row, low, high in zip(ROWS[1:5], (0.1, 0.1, 0.4, 1), (0.3, 0.3, 0.8, 2)):
            self.check(row, 8, 8, 8, low, high)

    def test_messages(self):
        library = ents.library()
        line = [[0, 1], [1, 2]]
        x = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]
        for text, mirror, positions in (('write planes as [("x", 0.0), ...]', [("z", 0.0)], x), ('write planes as [("x", 0.0), ...]', {"x": 0.0}, x),
                                        ("needs positions=", [("x", 0.0)], None),
                                        ("lie on both sides of plane 0 (x = 1)", [("x", 1.0)], x),
                                        ("positions: the shape is", [("x", 0.0)], x[:2])):
            with self.assertRaises(ents.Error) as caught:
                library.smooth("line2", "bspline4", line, 3, mirror=mirror, positions=positions)
            self.assertIn(text, str(caught.exception))
        _, control = library.smooth("line2", "bspline4", line, 3, mirror=[("x", 0.0)], positions=x)
        with self.assertRaisesRegex(ents.Error, "values: 1 numbers per node"):
            library.combine(control, np.zeros((3, 1)))


def table():
    columns = [(8, 8, 0), (8, 32, 0), (8, 11, 0), (8, 8, 8), (8, 11, 8)]
    print("| master, ends | " + " | ".join(f"{m}:{s}, " + (f"{q} points" if q else "nodes") for m, s, q in columns) + " |")
    for segment, ends in ROWS:
        cells = []
        for m, s, q in columns:
            p, _ = pressures(segment, ends, m, s, q)
            cells.append(f"{p.min():.3f} .. {p.max():.3f}")
        names = {None: "", STRAIGHT: ", straight", CUBIC: ", quasi cubic", PARABOLIC: ", quasi parabolic", "mirror": ", mirror planes"}
        print(f"| {segment}{names[ends]} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    if "--table" in sys.argv:
        table()
    else:
        unittest.main(argv=sys.argv[:1])
