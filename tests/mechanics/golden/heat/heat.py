#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Golden vectors of elements with heat, from the definitions alone (theory.md, sections 1, 2, 4.1, 5 and 7.5), right to more than 100 digits before the last difference.

usage: heat.py > heat.json

The projection is Newton's method on (x_s - rho_e) . rho_e,a = 0, with derivatives of rho_e by differences; the tangent is the central difference of
the residual at a step of 1e-40. No formula for a variation is used. Needs mpmath (Debian: python3-mpmath)."""
import itertools
import json
import random
import sys

import mpmath as mp

mp.mp.dps = 220  # differences of differences of differences lose 40 digits each
STEP = mp.mpf(10) ** -40
BASES = {
    "line2": (1, [(-1,), (1,)], lambda t: [(1 - t[0]) / 2, (1 + t[0]) / 2]),
    "line3": (1, [(-1,), (1,), (0,)], lambda t: [t[0] * (t[0] - 1) / 2, t[0] * (t[0] + 1) / 2, 1 - t[0] ** 2]),
    "tri3": (2, [(0, 0), (1, 0), (0, 1)], lambda t: [1 - t[0] - t[1], t[0], t[1]]),
    "quad4": (2, [(-1, -1), (1, -1), (1, 1), (-1, 1)],
              lambda t: [(1 + a * t[0]) * (1 + b * t[1]) / 4 for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]),
}


def difference(f, x, k):
    """Derivative of a vector f by x[k]."""
    high, low = list(x), list(x)
    high[k] += STEP
    low[k] -= STEP
    return [(a - b) / (2 * STEP) for a, b in zip(f(high), f(low))]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(v):
    return [x / mp.sqrt(dot(v, v)) for x in v]


def normal_of(tangents):
    if len(tangents) == 1:
        return unit([-tangents[0][1], tangents[0][0]])
    (a, b, c), (d, e, f) = tangents
    return unit([b * f - c * e, c * d - a * f, a * e - b * d])


class Element:
    def __init__(self, case, master):
        self.parameters, _, self.shape = BASES[case["segment"]]
        self.height, self.master = case["height"], master

    def rho(self, t):
        return [dot(self.shape(t), column) for column in zip(*self.master)]

    def tangents(self, f, t):
        return [difference(f, t, k) for k in range(self.parameters)]

    def rho_e(self, t):
        x = self.rho(t)
        if self.height is None:
            return x
        n = normal_of(self.tangents(self.rho, t))
        turns = dot([mp.mpf(w) for w in self.height["wave_vector"]], t)
        h = mp.mpf(self.height["amplitude"]) * mp.sin(2 * mp.pi * turns + mp.mpf(self.height["phase"]))
        return [a + h * b for a, b in zip(x, n)]

    def project(self, slave, start):
        def miss(*t):
            d = [a - b for a, b in zip(slave, self.rho_e(list(t)))]
            return [dot(d, e) for e in self.tangents(self.rho_e, list(t))]
        # differences of differences: the outer step may not be the inner one
        t = [mp.mpf(x) for x in start]
        wide = mp.mpf(10) ** -25
        for _ in range(12):
            r = miss(*t)
            jacobian = mp.matrix(self.parameters)
            for k in range(self.parameters):
                high, low = list(t), list(t)
                high[k] += wide
                low[k] -= wide
                for i, (a, b) in enumerate(zip(miss(*high), miss(*low))):
                    jacobian[i, k] = (a - b) / (2 * wide)
            step = mp.lu_solve(jacobian, -mp.matrix(r))
            t = [a + b for a, b in zip(t, step)]
            if max(abs(x) for x in step) < mp.mpf(10) ** -50:
                return t
        raise ArithmeticError("no projection")


def powers(case, dofs):
    """Residuals of the temperatures; dofs: displacements and temperature per node."""
    own = len(case["slave"]) + 1
    nodes = [dofs[own * i:own * (i + 1)] for i in range(len(dofs) // own)]
    element = Element(case, [x[:-1] for x in nodes[1:]])
    slave, theta = nodes[0][:-1], [x[-1] for x in nodes]
    t = element.project(slave, case["start"])
    n = normal_of(element.tangents(element.rho_e, t))
    d = [a - b for a, b in zip(slave, element.rho_e(t))]
    gap, area = dot(d, n), mp.mpf(case["area"])
    law = {key: mp.mpf(value) for key, value in case["law"].items()}
    contact = gap < 0
    p = -law["stiffness"] * gap if contact else mp.mpf(0)
    h = law["constant"] + law["coefficient"] * (p / law["pressure"]) ** law["exponent"] if contact else mp.mpf(0)
    h += law["conductivity"] / (law["jump"] + (0 if contact else gap))
    shape = element.shape(t)
    flow = area * h * (theta[0] - dot(shape, theta[1:]))
    heat = mp.mpf(0)
    if contact and case["anchor"]:
        e = element.tangents(element.rho_e, t)
        w = [a - mp.mpf(b) for a, b in zip(t, case["anchor"])]
        slip = [sum(w[k] * e[k][i] for k in range(len(w))) for i in range(len(slave))]
        trial, limit = law["tangential"] * area * mp.sqrt(dot(slip, slip)), law["mu"] * p * area
        if trial > limit:
            heat = law["share"] * limit * (trial - limit) / (law["tangential"] * area) / law["time"]
    return [flow - law["slave"] * heat] + [-x * (flow + (1 - law["slave"]) * heat) for x in shape]


def draw(rng, segment, height, anchored, is_open):
    parameters, places, shape = BASES[segment]
    def near(x, width):
        return round(x + rng.uniform(-width, width), 3)
    master = [[near(x, 0.1) for x in place] + [near(0, 0.08)] for place in places]
    inside = [near(0.25 if segment == "tri3" else 0.1, 0.1) for _ in range(parameters)]
    case = {"segment": segment, "master": master, "start": inside, "area": 0.7, "anchor": [near(x, 0.05) for x in inside] if anchored else None,
            "height": {"type": "sine", "amplitude": 0.02, "wave_vector": [0.5, 0.3][:parameters], "phase": 0.4} if height else None,
            "temperature": [near(1, 1) for _ in range(len(places) + 1)],
            "law": {"stiffness": 100, "constant": 0.3, "coefficient": 2, "pressure": 5, "exponent": 0.95, "conductivity": 0.1, "jump": 0.05, "mu": 0.2,
                    "tangential": 80, "share": 0.9, "slave": 0.3, "time": 0.1}}
    element = Element(case, [[mp.mpf(x) for x in node] for node in master])
    t = [mp.mpf(x) for x in inside]
    n = normal_of(element.tangents(element.rho_e, t))
    gap = 0.03 if is_open else -0.02
    case["slave"] = [round(float(a + gap * b), 4) for a, b in zip(element.rho_e(t), n)]
    return case


def main():
    if len(sys.argv) > 1:
        sys.exit(__doc__)
    rng, cases = random.Random(20), []
    for segment, height, anchored, is_open in itertools.product(BASES, (False, True), (False, True), (False, True)):
        if anchored and is_open:
            continue
        case = draw(rng, segment, height, anchored, is_open)
        dofs = [mp.mpf(x) for node, theta in zip([case["slave"], *case["master"]], case["temperature"]) for x in (*node, theta)]
        wide = mp.mpf(10) ** -12  # above the error of the projection's own differences; Richardson's extrapolation
        columns = []
        for k in range(len(dofs)):
            def at(factor):
                moved = list(dofs)
                moved[k] += factor * wide
                return powers(case, moved)
            first = [(a - b) / (2 * wide) for a, b in zip(at(1), at(-1))]
            second = [(a - b) / (4 * wide) for a, b in zip(at(2), at(-2))]
            columns.append([float((4 * a - b) / 3) for a, b in zip(first, second)])
        case["residual"], case["tangent"] = [float(x) for x in powers(case, dofs)], columns
        cases.append(case)
        print(f"{len(cases)}: {segment}", file=sys.stderr)
    print("[\n" + ",\n".join(json.dumps(case) for case in cases) + "\n]")


if __name__ == "__main__":
    main()
