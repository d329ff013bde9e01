# SPDX-License-Identifier: BSD-3-Clause
"""Random elements, laws and comparisons of theory_test.py."""
import itertools
import unittest

import numpy as np

import theory_definitions as definitions
import theory_formulas as formulas
from theory_numbers import Nil

SEED = 20260
EXACT, DIFFERENCES = 1e-12, 1e-7
MOST_PAIRS = 40  # of unknowns, per case
worst = {}


class Case:
    """A random element at its projection."""

    def __init__(self, rng, basis, height="sine", ray=None, gap=None, coordinates=False):
        b = self.basis = definitions.BASES[basis]
        self.name = f"{basis}, {height}, {ray or 'normal'}"
        linear = [[1.0 if e == tuple(int(c == a) for c in range(b.T)) else 0.0 for e in b.exponents] for a in range(b.T)]
        flat = np.linalg.lstsq(b.coefficients.T, np.array(linear).T, rcond=None)[0]  # the nodes of rho = xi
        turn = np.linalg.qr(rng.normal(size=(b.D, b.D)))[0]
        turn[:, 0] *= np.linalg.det(turn)
        nodes = np.hstack([flat, np.zeros((b.nodes, 1))]) + 0.08 * rng.uniform(-1, 1, (b.nodes, b.D))
        s = flat + 0.1 * rng.uniform(-1, 1, flat.shape) if coordinates else None
        self.surface = definitions.Surface(b, definitions.HEIGHTS[height], s)
        xi = rng.uniform(0.15, 0.4, b.T) if b.simplex else rng.uniform(-0.6, 0.6, b.T)
        self.gap = gap if gap is not None else rng.uniform(-0.12, -0.05)
        x = np.vstack([np.zeros(b.D), nodes @ turn.T + rng.normal(size=b.D)])
        at = formulas.Point(self.surface, x, xi)
        foot = x[0] - at.d
        self.e, self.q, self.ray = None, 0.0, None
        along = at.n_e
        if ray:
            along = at.n_e + 0.4 * rng.uniform(-1, 1, b.D)
            along = self.e = along / np.linalg.norm(along)
        x[0] = foot + self.gap * along
        if ray == "direction":
            self.ray = ("direction", self.e)
        elif ray == "emitter":
            distance = rng.uniform(1.0, 2.0)
            self.q, self.ray = 1 / distance, ("emitter", x[0] + distance * self.e)
        self.projection = definitions.Projection(self.surface, self.ray)
        self.x = x
        self.xi = self.projection.solve(x, xi, iterations=2)
        self.point = formulas.Point(self.surface, x, self.xi)
        self.variations = formulas.Normal(self.point) if ray is None else formulas.Shadow(self.point, self.e, self.q)

    def dofs(self):
        return self.x.size

    def pairs(self, rng, others=0):
        """Pairs of unknowns; the second may be one of `others` that follow those of the nodes."""
        n = self.dofs()
        every = list(itertools.product(range(n), range(n + others)))
        chosen = rng.choice(len(every), min(MOST_PAIRS, len(every)), replace=False)
        pairs = [every[k] for k in chosen] + [(k % n, n + k) for k in range(others)]
        return np.array([p[0] for p in pairs]), np.array([p[1] for p in pairs])

    def varied(self, first, second, vary_xi=True):
        """x and xi with the units 1 and 2 along the unknowns `first` and `second`."""
        n, count = self.dofs(), len(first)
        c = np.zeros((4, count, n))
        c[0] = self.x.ravel()
        c[1, range(count), first] = 1.0
        inner = second < n
        c[2, np.flatnonzero(inner), second[inner]] = 1.0
        x = Nil(c.reshape(4, count, *self.x.shape))
        if vary_xi:
            return x, self.projection.solve(x, self.xi, 2)
        return x, Nil(np.array([self.xi + np.zeros((count, self.basis.T))] + [np.zeros((count, self.basis.T))] * 3))


def random_law(rng, kind, contact=True):
    law = {"type": kind, "contact": contact, "eps": rng.uniform(5, 20), "m": rng.choice([1.5, 2.0, 2.5, 3.0]), "p0": 2.0, "c0": 0.4, "r": 1.3,
           "mu": 0.3, "eps_t": 7.0, "w": 0.6, "s0": 1.5, "G": 0.5, "kappa": 0.4, "d": 0.7, "range": 5.0}
    if kind == "table":
        law["table"] = definitions.Table([-0.3, -0.2, 0.05, 0.1], [3.0, 1.7, 0.4, 0.0])
    return law


class Checked(unittest.TestCase):
    def near(self, section, name, got, wanted, scale=None, limit=EXACT):
        got, wanted = np.asarray(got), np.asarray(wanted)
        size = np.max(np.abs(wanted)) if scale is None else scale
        error = np.max(np.abs(got - wanted)) / (size or 1.0)
        key = (section, "exact" if limit == EXACT else "differences")
        count, largest = worst.get(key, (0, 0.0))
        worst[key] = count + 1, max(largest, error)
        self.assertLessEqual(error, limit, f"section {section}: {name}")

    def rng(self):
        return np.random.default_rng([SEED, sum(map(ord, self.id()))])
