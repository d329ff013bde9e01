# SPDX-License-Identifier: BSD-3-Clause
"""What abi/manual/theory.md defines in sections 1, 2, 4 and 5, and nothing that it derives: the enriched surface, the projection,
the energies of the laws and the force of friction, for arrays of floating-point numbers and for those of theory_numbers.

Positions are x[..., node, component] with the slave node first; natural coordinates xi[..., a]."""
import itertools
import math

import numpy as np

from theory_numbers import Nil, cross, dot, exp, moved, sin, sqrt, stack, value


class Basis:
    """Shape functions N_i = sum_k coefficients[i, k] xi^exponents[k]."""

    def __init__(self, exponents, coefficients, simplex=False):
        self.exponents, self.coefficients, self.simplex = exponents, coefficients, simplex
        self.nodes, self.T, self.degree = len(coefficients), len(exponents[0]), max(map(max, exponents))
        self.D = self.T + 1

    def shape(self, xi, by=()):
        """[..., nodes]: the shape functions, differentiated by the natural coordinates with the numbers `by`."""
        monomials = 1.0
        exponents, factor = np.array(self.exponents), np.ones(len(self.exponents))
        for a in by:
            factor, exponents = factor * exponents[:, a], exponents - np.eye(self.T, dtype=int)[a]
        for a in range(self.T):
            powers = [1.0 + 0.0 * xi[..., a], xi[..., a]]
            while len(powers) <= self.degree:
                powers.append(powers[-1] * powers[1])
            monomials = stack(powers)[..., np.maximum(exponents[:, a], 0)] * monomials
        weights = (factor * self.coefficients).T
        return Nil(monomials.c @ weights) if isinstance(monomials, Nil) else monomials @ weights


def through_points(exponents, points, simplex=False):
    values = np.array([[math.prod(p[a] ** e[a] for a in range(len(e))) for p in points] for e in exponents])
    return Basis(exponents, np.linalg.inv(values), simplex)


def cubic(rows, scale):
    """Cubics in t = (xi + 1) / 2, as powers of xi."""
    return scale * np.array([[sum(row[k] * math.comb(k, j) / 2.0 ** k for k in range(4)) for j in range(4)] for row in rows])


def line(coefficients):
    return Basis([(k,) for k in range(coefficients.shape[1])], coefficients)


def tensor(coefficients):
    count, powers = coefficients.shape
    return Basis(list(itertools.product(range(powers), repeat=2)),
                 np.array([np.outer(coefficients[i], coefficients[j]).ravel() for j in range(count) for i in range(count)]))


def bezier15():
    powers = [(4, 0, 0), (0, 4, 0), (0, 0, 4), (3, 1, 0), (2, 2, 0), (1, 3, 0), (0, 3, 1), (0, 2, 2), (0, 1, 3), (1, 0, 3), (2, 0, 2), (3, 0, 1),
              (2, 1, 1), (1, 2, 1), (1, 1, 2)]
    exponents = [(i, j) for i in range(5) for j in range(5 - i)]
    points = [(i / 4, j / 4) for i, j in exponents]
    there = np.array([[24 / math.prod(map(math.factorial, p)) * (1 - x - y) ** p[0] * x ** p[1] * y ** p[2] for x, y in points] for p in powers])
    return Basis(exponents, there @ np.linalg.inv([[x ** i * y ** j for x, y in points] for i, j in exponents]), True)


CORNERS = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
SIDES = [(0, -1), (1, 0), (0, 1), (-1, 0)]
CATMULL_ROM = cubic([(0, -1, 2, -1), (2, 0, -5, 3), (0, 1, 4, -3), (0, 0, -1, 1)], 1 / 2)
B_SPLINE = cubic([(1, -3, 3, -1), (4, 0, -6, 3), (1, 3, 3, -3), (0, 0, 0, 1)], 1 / 6)
BASES = {
    "line2": through_points([(0,), (1,)], [(-1,), (1,)]),
    "line3": through_points([(0,), (1,), (2,)], [(-1,), (1,), (0,)]),
    "catmull_rom4": line(CATMULL_ROM),
    "bspline4": line(B_SPLINE),
    "tri3": through_points([(0, 0), (1, 0), (0, 1)], [(0, 0), (1, 0), (0, 1)], True),
    "tri6": through_points([(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)], [(0, 0), (1, 0), (0, 1), (.5, 0), (.5, .5), (0, .5)], True),
    "quad4": through_points([(0, 0), (1, 0), (0, 1), (1, 1)], CORNERS),
    "quad8": through_points([(0, 0), (1, 0), (0, 1), (1, 1), (2, 0), (0, 2), (2, 1), (1, 2)], CORNERS + SIDES),
    "quad9": through_points(list(itertools.product(range(3), repeat=2)), CORNERS + SIDES + [(0, 0)]),
    "catmull_rom16": tensor(CATMULL_ROM),
    "bspline16": tensor(B_SPLINE),
    "bezier15": bezier15(),
}


def height_none(s):
    return 0.0 * s[..., 0]


def height_sine(s):
    return 0.06 * sin(2.1 * s[..., 0] + 1.3 * s[..., -1] + 0.4)


def height_gaussian(s):
    r = s - 0.2
    return 0.09 * exp(-0.9 * dot(r, r))


def height_product(s):
    return (1.0 + 0.3 * s[..., 0] - 0.2 * s[..., -1] * s[..., 0]) * height_sine(s) + 0.02 * s[..., -1] ** 3


HEIGHTS = {"none": height_none, "sine": height_sine, "gaussian": height_gaussian, "product": height_product}


def area_vector(tangents):
    return stack([-tangents[0][..., 1], tangents[0][..., 0]]) if len(tangents) == 1 else cross(*tangents)


class Surface:
    """Sections 1.1, 1.3 and 1.4: rho_e of a basis, a height and surface coordinates s_i of the nodes, or s = xi."""

    def __init__(self, basis, height, coordinates=None):
        self.basis, self.height, self.coordinates = basis, height, coordinates

    def h(self, xi):
        if self.coordinates is None:
            return self.height(xi)
        return self.height((self.basis.shape(xi)[..., None] * self.coordinates).sum(-2))

    def rho_e(self, x, xi):
        nodes = x[..., 1:, :]

        def sum_of(N):
            return (N[..., None] * nodes).sum(-2)

        m = area_vector([sum_of(self.basis.shape(xi, (a,))) for a in range(self.basis.T)])
        h = self.h(xi) / sqrt(dot(m, m))
        return sum_of(self.basis.shape(xi)) + h[..., None] * m

    def tangents(self, x, xi, unit):
        """rho_e and its tangents, by a unit that neither x nor xi has."""
        out = []
        for a in range(self.basis.T):
            at, tangent = self.rho_e(x, moved(xi, unit, np.eye(self.basis.T)[a], unit)).without(unit)
            out.append(tangent)
        return at, out


def emitter_ray(x, emitter):
    r = emitter - x[..., 0, :]
    return r / sqrt(dot(r, r))[..., None]


class Projection:
    """Section 2: xi and g of positions x, by Newton's method.

    ray: null (normal projection), ("direction", e) or ("emitter", place)"""

    def __init__(self, surface, ray=None):
        self.surface, self.ray = surface, ray

    def direction(self, x):
        return emitter_ray(x, self.ray[1]) if self.ray[0] == "emitter" else self.ray[1]

    def equations(self, x, xi, unit):
        """What vanishes at the projection: (x_s - rho_e) . rho_e,a, or what of x_s - rho_e is not along the ray."""
        at, tangents = self.surface.tangents(x, xi, unit)
        d = x[..., 0, :] - at
        if self.ray is None:
            return stack([dot(d, tangent) for tangent in tangents])
        e = self.direction(x)
        if self.surface.basis.T == 1:
            return stack([d[..., 0] * e[..., 1] - d[..., 1] * e[..., 0]])
        off = cross(d, e)
        across = np.argsort(np.abs(np.mean(value(e + np.zeros(3)).reshape(-1, 3), 0)))[:2]  # two of three that are independent
        return stack([off[..., int(k)] for k in across])

    def solve(self, x, start, units=0, iterations=5):
        """xi of positions x with so many units, whose values without units have the projection `start`; without units, that near
        `start`."""
        xi = start + 0.0 * value(x)[..., 0, :1]
        if not units:
            for _ in range(iterations):
                inverse = np.linalg.inv(self.jacobian(x, xi))
                xi = xi - np.einsum("...ab,...b->...a", inverse, self.equations(x, xi, 1).c[0])
            return xi
        first = tuple(0 for _ in xi.shape[:-1])
        inverse = np.linalg.inv(self.jacobian(value(x)[first], xi[first]))
        xi = Nil(np.concatenate([xi[None], np.zeros(((1 << units) - 1, *xi.shape))]))
        for _ in range(units + 1):  # each step is exact for one unit more
            xi = xi - Nil(np.einsum("ab,s...b->s...a", inverse, self.equations(x, xi, units + 1).c[:1 << units]))
        return xi

    def jacobian(self, x, xi):
        columns = [self.equations(x, moved(xi, 1, unit, 1), 2).part(1) for unit in np.eye(self.surface.basis.T)]
        return np.stack(columns, -1)

    def gap(self, x, xi, unit):
        """(g, metric A_ab as rows of numbers, rho_e,a)"""
        at, tangents = self.surface.tangents(x, xi, unit)
        d = x[..., 0, :] - at
        m = area_vector(tangents)
        g = dot(d, m) / sqrt(dot(m, m)) if self.ray is None else dot(d, self.direction(x) + 0.0 * d)
        return g, [[dot(u, v) for v in tangents] for u in tangents]


# Section 4.1: energies of laws in contact; of the multiplier laws also where they are open. `law` is a dict of their numbers.

def table_slopes(gaps, forces):
    """Section 4.5: W'' at the points."""
    length, n = np.diff(gaps), len(gaps)
    rise = np.diff(forces) / length
    if n == 2:
        return np.array([2.0 * rise[0], 0.0])
    slopes = np.zeros(n)
    for i in range(1, n - 1):
        parabola = (rise[i - 1] * length[i] + rise[i] * length[i - 1]) / (length[i - 1] + length[i])
        slopes[i] = min(2.0 * min(rise[i - 1], rise[i]), parabola)
    share = length[0] / (length[0] + length[1])
    slopes[0] = min(max(rise[0] * (1.0 + share) - rise[1] * share, rise[0]), 2.0 * rise[0])
    return slopes


class Table:
    """Section 4.5: W, W' and W'' at g, of points."""

    def __init__(self, gaps, pressures):
        self.gaps, self.forces = np.array(gaps), -np.array(pressures)
        self.slopes, n = table_slopes(self.gaps, self.forces), len(gaps)
        self.energies = np.zeros(n)
        for i in reversed(range(n - 1)):
            self.energies[i] = self.energies[i + 1] - self.between(i, self.gaps[i + 1])[0]

    def between(self, i, g):
        length = self.gaps[i + 1] - self.gaps[i]
        rise, t = (self.forces[i + 1] - self.forces[i]) / length, (g - self.gaps[i]) / length
        c2, c3 = 3 * rise - 2 * self.slopes[i] - self.slopes[i + 1], self.slopes[i] + self.slopes[i + 1] - 2 * rise
        W = self.energies[i] + length * t * (self.forces[i] + length * t * (self.slopes[i] / 2 + t * (c2 / 3 + t * c3 / 4)))
        return W, self.forces[i] + length * t * (self.slopes[i] + t * (c2 + t * c3)), self.slopes[i] + t * (2 * c2 + 3 * t * c3)

    def at(self, g):
        place = float(np.real(np.ravel(value(g))[0]))
        if place < self.gaps[0]:
            deep = g - self.gaps[0]
            return (self.energies[0] + deep * (self.forces[0] + deep * self.slopes[0] / 2), self.forces[0] + self.slopes[0] * deep,
                    self.slopes[0] + 0.0 * deep)
        return self.between(int(np.searchsorted(self.gaps, place, "right")) - 1, g)


def energy_penalty(law, g, multiplier):
    return law["eps"] / 2 * g * g


def energy_power(law, g, multiplier):
    return law["eps"] * (-g) ** (law["m"] + 1) / (law["m"] + 1)


def energy_exponential(law, g, multiplier):
    u = 1 - g / law["c0"]
    E = exp(u) - 1
    return law["p0"] / (math.e - 1) * law["c0"] * ((u - 1) * E + u - u * u / 2)


def energy_augmented(law, g, multiplier):
    p = multiplier - law["eps"] * g
    return (p * p - multiplier * multiplier) / (2 * law["eps"])


def energy_multiplier(law, g, multiplier):
    return -multiplier * g


def energy_table(law, g, multiplier):
    return law["r"] ** 2 * law["table"].at(g / law["r"])[0]


def energy_tied(law, g, multiplier):
    return law["eps"] / 2 * g * g


def energy_cohesive(law, g, multiplier):
    """Stored; while the bond opens farther than before with what damage has taken."""
    s0, d0, df = law["s0"], law["s0"] / law["eps"], 2 * law["G"] / law["s0"]
    place = one_value(g)
    if place < 0:
        return law["eps"] / 2 * g * g
    if place < law["kappa"]:
        return s0 * (df - law["kappa"]) / ((df - d0) * law["kappa"]) / 2 * g * g
    taken = law["G"] * (g - law["kappa"]) / (df - d0)
    return s0 * (df - g) / (df - d0) / 2 * g + taken


def dugdale_places(law):
    length = law["w"] / law["s0"]
    rise = min(2 * law["s0"] / law["eps"], 1.3125 * length)
    return rise, 0.875 * length + rise / 3, 1.125 * length + rise / 3


def energy_dugdale(law, g, multiplier):
    s0, (rise, flat, end), place = law["s0"], dugdale_places(law), one_value(g)
    if place < 0:
        return law["eps"] / 2 * g * g - law["w"]
    if place < rise:
        return s0 * (g * g / rise - g * g * g / (3 * rise * rise)) - law["w"]
    if place < flat:
        return s0 * (g - rise / 3) - law["w"]
    v = (g - flat) / (end - flat)
    return s0 * (flat - rise / 3 + (end - flat) * (v - v ** 3 + v ** 4 / 2)) - law["w"]


def energy_separation(law, g, multiplier):
    return -law["w"] * (1 + g / law["d"]) * exp(-1 * g / law["d"])


def lennard_jones_numbers(law):
    """s_e, c and C from what they are for: no tension at the range, and the work of adhesion."""
    se = law["d"] / (law["d"] + law["range"])
    c = (se ** 3 - se ** 9) / (1 - se ** 2) ** 2
    psi = [s ** 8 / 8 - s ** 2 / 2 - c * (1 / s + 2 * s - s ** 3 / 3) for s in (se, 1.0)]
    return se, c, law["w"] / (law["d"] * (psi[0] - psi[1]))


def energy_lennard_jones(law, g, multiplier):
    se, c, C = lennard_jones_numbers(law)
    z = 1 + g / law["d"]

    def psi(z):
        return z ** -8 / 8 - z ** -2 / 2 - c * (z + 2 * z ** -1 - z ** -3 / 3)
    return C * law["d"] * (psi(z) - psi(1 / se))


def one_value(g):
    return float(np.real(np.ravel(value(g))[0]))


def energy_open(law, g, multiplier):
    return -multiplier * multiplier / (2 * law["eps"])


ENERGIES = {"penalty": energy_penalty, "power": energy_power, "exponential": energy_exponential, "augmented": energy_augmented,
            "augmented_multiplier": energy_augmented, "multiplier": energy_multiplier, "table": energy_table,
            "tied": energy_tied, "cohesive": energy_cohesive, "dugdale": energy_dugdale, "separation": energy_separation,
            "lennard_jones": energy_lennard_jones}


def derivative_of_energy(law, g, multiplier, unit, by):
    """W_,g or W_,lambda as a number with the units below `unit`, from the energy alone."""
    energy = ENERGIES[law["type"]] if law["contact"] else energy_open
    one = moved(g if by == "gap" else multiplier, unit, 1.0, unit)
    return energy(law, one if by == "gap" else g, multiplier if by == "gap" else one).without(unit)[1]


def friction_force(law, metric, w, pressure_force, area, multiplier):
    """Sections 5.1 and 5.2: t_a, from A_ab (rows of numbers), w^a, p A and lambda_a."""
    T = len(metric)
    lowered = [sum(metric[a][b] * w[b] for b in range(T)) + multiplier[a] / law["eps_t"] for a in range(T)]
    if T == 1:
        raised = [lowered[0] / metric[0][0]]
    else:
        det = metric[0][0] * metric[1][1] - metric[0][1] * metric[0][1]
        raised = [(metric[1][1] * lowered[0] - metric[0][1] * lowered[1]) / det,
                  (metric[0][0] * lowered[1] - metric[0][1] * lowered[0]) / det]
    size = sqrt(sum(raised[a] * lowered[a] for a in range(T)))
    limit = law["mu"] * pressure_force
    if law.get("shear_limit") is not None and one_side(law["shear_limit"] * area < value(limit)):
        limit = law["shear_limit"] * area + 0.0 * limit
    slips = not law.get("rough") and one_side(area * law["eps_t"] * value(size) > value(limit))
    return [limit * t / size if slips else area * law["eps_t"] * t for t in lowered], slips


def one_side(truth):
    """The one truth of all elements: none may be on another side of a switch."""
    if np.all(truth) != np.any(truth):
        raise ValueError("some elements of a case are on either side of a switch")
    return bool(np.all(truth))


def worn_pressure(law, g, multiplier, wear, moved_by, metric, unit):
    """Section 7.1: p, from the gap, the motion D^a and A_ab."""
    T = len(metric)
    slid = sqrt(sum(metric[a][b] * moved_by[a] * moved_by[b] for a in range(T) for b in range(T)) + wear["sliding"] ** 2)
    known = g + wear["depth"] + wear["chi"] * slid * (1 - wear["beta"]) * wear["pressure"]
    share, p = wear["beta"] * wear["chi"] * slid, 0.0 * g

    def miss(p):
        return p + derivative_of_energy(law, known + share * p, multiplier + 0.0 * g, unit, "gap")

    step = 1e-7
    for _ in range(30):  # each is exact for one unit more, once the value is
        slope = (value(miss(p + step)) - value(miss(p - step))) / (2 * step)
        p = p - miss(p) * (1.0 / slope)
    return p
