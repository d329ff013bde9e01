# SPDX-License-Identifier: BSD-3-Clause
"""The laws, friction and tangents of sections 4, 5, 6 and 7.1 of abi/manual/theory.md as that page states them, for one element."""
import numpy as np

from theory_formulas import SecondXi, solve, symmetric


def law_numbers(law, g, multiplier=0.0):
    """Section 4.1: W, W', W'' where there is contact."""
    kind = law["type"]
    if kind == "penalty":
        return 0.5 * law["eps"] * g ** 2, law["eps"] * g, law["eps"]
    if kind == "power":
        eps, m = law["eps"], law["m"]
        return eps * (-g) ** (m + 1) / (m + 1), -eps * (-g) ** m, eps * m * (-g) ** (m - 1)
    if kind == "exponential":
        u, scale, c0 = 1 - g / law["c0"], law["p0"] / (np.e - 1), law["c0"]
        E = np.exp(u) - 1
        return scale * c0 * ((u - 1) * E + u - 0.5 * u * u), -scale * u * E, scale * (E + u * np.exp(u)) / c0
    if kind in ("augmented", "augmented_multiplier"):
        p = multiplier - law["eps"] * g
        return (p ** 2 - multiplier ** 2) / (2 * law["eps"]), -p, law["eps"]
    if kind == "multiplier":
        return -multiplier * g, -multiplier, 0.0
    if kind == "table":
        W, W1, W2 = law["table"].at(g / law["r"])
        return law["r"] ** 2 * W, law["r"] * W1, W2
    if kind == "tied":
        return 0.5 * law["eps"] * g ** 2, law["eps"] * g, law["eps"]
    if kind == "cohesive":
        s0, d0, df = law["s0"], law["s0"] / law["eps"], 2 * law["G"] / law["s0"]
        kappa = max(law["kappa"], g)
        secant = law["eps"] if g <= 0 else s0 * (df - kappa) / ((df - d0) * kappa)
        taken = law["G"] * (kappa - law["kappa"]) / (df - d0)
        return 0.5 * secant * g * g + taken, secant * g, -s0 / (df - d0) if g > law["kappa"] else secant
    if kind == "dugdale":
        length, s0, eps = law["w"] / law["s0"], law["s0"], law["eps"]
        rise = min(2 * s0 / eps, 1.3125 * length)
        flat, end = 0.875 * length + rise / 3, 1.125 * length + rise / 3
        if g < 0:
            return -law["w"] + 0.5 * eps * g * g, eps * g, eps
        u, v = min(g / rise, 1.0), min(max((g - flat) / (end - flat), 0.0), 1.0)
        area = rise * (u ** 2 - u ** 3 / 3) + min(max(g - rise, 0.0), flat - rise) + (end - flat) * (v - v ** 3 + v ** 4 / 2)
        return (-law["w"] + s0 * area, s0 * (1 - (1 - u) ** 2 - v * v * (3 - 2 * v)),
                s0 * (2 * (1 - u) / rise - 6 * v * (1 - v) / (end - flat)))
    if kind == "separation":
        w, d, u = law["w"], law["d"], g / law["d"]
        return -w * (1 + u) * np.exp(-u), w * u * np.exp(-u) / d, w * (1 - u) * np.exp(-u) / d ** 2
    if kind == "lennard_jones":
        z0, s, end = law["d"], law["d"] / (law["d"] + g), law["d"] / (law["d"] + law["range"])
        c = end ** 3 * (1 + end ** 2 + end ** 4) / (1 - end ** 2)

        def psi(s):
            return s ** 8 / 8 - s ** 2 / 2 - c * (1 / s + 2 * s - s ** 3 / 3)
        C = law["w"] / (z0 * (psi(end) - psi(1.0)))
        return (C * z0 * (psi(s) - psi(end)), C * (s ** 3 - s ** 9 - c * (1 - s ** 2) ** 2),
                C / z0 * (9 * s ** 10 - 3 * s ** 4 - 4 * c * s ** 3 * (1 - s ** 2)))
    raise KeyError(kind)


class Friction:
    """Sections 5.1, 5.2 and 5.4, without the numbers of the law in dL."""

    def __init__(self, variations, law, w, area, pressure_force, multiplier, has_multiplier):
        p, self.v = variations.p, variations
        self.area, self.eps_t, span = area, law["eps_t"], range(p.T)
        scale = area * law["eps_t"]
        lowered = p.A @ w + multiplier / law["eps_t"]
        stretch = solve(p.A, lowered)
        length = np.sqrt(stretch @ lowered)
        self.norm = scale * length
        self.limit, self.by_pressure = law["mu"] * pressure_force, law["mu"]
        if law.get("shear_limit") is not None and law["shear_limit"] * area < self.limit:
            self.limit, self.by_pressure = law["shear_limit"] * area, 0.0
        self.slip = self.norm > self.limit and not law.get("rough")
        self.direction, self.raised = lowered / length, stretch / length
        self.t = self.limit * self.direction if self.slip else scale * lowered
        eta = scale * self.limit / self.norm if self.slip else scale
        slips = self.direction if self.slip else np.zeros(p.T)
        m = self.raised if self.slip else np.zeros(p.T)
        W, B = w @ p.e, np.einsum("b,bci->ci", w, p.e2)
        if has_multiplier:
            half = w - 0.5 * stretch
            V, U = half @ p.e, m @ p.e
            alpha = [slips[c] + sum(m[a] * (p.e2[a, c] @ V) + half[a] * (p.e2[a, c] @ U) for a in span) for c in span]
            beta = [m[b] * V + half[b] * U for b in span]
        else:
            alpha = [slips[c] + sum(m[a] * (p.e[a] @ B[c]) for a in span) for c in span]
            beta = [m[b] * W for b in span]
        self.slips, self.eta, self.w, self.stretch = slips, eta, w, stretch
        self.by_xi = np.array([[eta * (p.A[a, c] + p.e[a] @ B[c] + W @ p.e2[a, c] - slips[a] * alpha[c]) for c in span] for a in span])
        self.towards = [[eta * (w[b] * p.e[a] + (W if a == b else 0.0) - slips[a] * beta[b]) for b in span] for a in span]

    def dt(self, dL):
        """delta t_a, from delta L."""
        p, span = self.v.p, range(self.v.p.T)
        return np.array([self.by_xi[a] @ self.v.dxi + sum(p.expand(p.form_of_slope(b, self.towards[a][b])) for b in span) + self.slips[a] * dL
                         for a in span])

    def dt_by_metric(self, dL):
        """The same by the variations of l_a and A_ab."""
        v, span = self.v, range(self.v.p.T)
        p = v.p
        by_component = [[p.expand(p.form_of_slope(a, c)) for c in np.eye(p.D)] for a in span]
        De = [[by_component[a][i] + sum(p.e2[a, c][i] * v.dxi[c] for c in span) for i in range(p.D)] for a in span]
        DA = [[sum(De[a][i] * p.e[b][i] + p.e[a][i] * De[b][i] for i in range(p.D)) for b in span] for a in span]
        Dl = [sum(p.A[a, c] * v.dxi[c] + DA[a][c] * self.w[c] for c in span) for a in span]
        if not self.slip:
            return self.eta * np.array(Dl)
        Du = sum(self.raised[b] * (Dl[b] - 0.5 * sum(DA[b][c] * self.stretch[c] for c in span)) for b in span)
        return np.array([self.direction[a] * dL + self.eta * (Dl[a] - self.direction[a] * Du) for a in span])


def tangent(variations, law, area, g_law, multipliers, w, friction, has_multiplier):
    """K of (u, lambda, lambda_a): sections 4.2, 4.4, 5.4 and 5.6."""
    v, T, n = variations, variations.p.T, len(variations.dg)
    dofs = n + (0 if law["type"] not in ("augmented_multiplier", "multiplier") else 1 + (T if friction else 0))
    K = np.zeros((dofs, dofs))
    eps = law.get("eps", 1.0)
    if not law["contact"]:
        if dofs > n:
            K[n, n] = -area / eps
            for a in range(dofs - n - 1):
                K[n + 1 + a, n + 1 + a] = -area / law["eps_t"]
        return K
    _, W1, W2 = law_numbers(law, g_law, multipliers[0])
    K[:n, :n] = area * W2 * np.outer(v.dg, v.dg)
    f = Friction(v, law, w, area, -area * W1, multipliers[1:], has_multiplier) if friction else None
    K[:n, :n] += v.D2(area * W1, f.t if friction else np.zeros(T))
    if friction:
        dt = f.dt(-f.by_pressure * area * W2 * v.dg)
        K[:n, :n] += v.dxi.T @ dt
    if dofs == n:
        return K
    K[:n, n] = K[n, :n] = -area * v.dg
    if not friction:
        return K
    by_tangential = area * np.eye(T)
    by_normal = np.zeros(T)
    if f.slip:
        by_tangential = area * f.limit / f.norm * (np.eye(T) - np.outer(f.direction, f.raised))
        by_normal = f.by_pressure * area * f.direction
    K[:n, n + 1:] = v.dxi.T @ by_tangential
    K[n + 1:, :n] = dt / law["eps_t"]
    K[n + 1:, n + 1:] = (by_tangential - area * np.eye(T)) / law["eps_t"]
    K[:n, n] += v.dxi.T @ by_normal
    K[n + 1:, n] = by_normal / law["eps_t"]
    return K


def short_tangent(normal, law, area, w, friction):
    """K of penalty and power law: sections 4.2 and 5.5."""
    p, g = normal.p, normal.p.g
    _, W1, W2 = law_numbers(law, g)
    k, m = area * W1 / g, law.get("m", 1.0)
    gamma = np.sqrt(k * (m - 1)) * normal.dg
    if not friction:
        C = np.linalg.cholesky(p.F2)
        v = np.sqrt(k) * solve(C, normal.f)
        total = k * p.weights_squared() - v.T @ v + np.outer(gamma, gamma)
        for a in range(p.T):
            total = total + symmetric(k * p.expand(p.form_of_w(a)), p.expand(p.form_of_zF(a)))
        return total
    f = Friction(normal, law, w, area, -area * W1, np.zeros(p.T), False)
    return SecondXi(normal, f.t).matrix(k) + normal.dxi.T @ f.dt(-f.by_pressure * m * k * normal.dg) + np.outer(gamma, gamma)


def worn_tangent(variations, law, area, multiplier, wear, w):
    """Section 7.1, with friction where w is not None."""
    v, p, D = variations, variations.p, wear["moved"]
    way = D @ p.e
    slid = np.sqrt(way @ way + wear["sliding"] ** 2)
    m = way / slid
    dslid = sum((m @ (p.e[c] + sum(D[b] * p.e2[b, c] for b in range(p.T)))) * v.dxi[c] + D[c] * p.expand(p.form_of_slope(c, m)) for c in range(p.T))
    known = v.g + wear["depth"] + wear["chi"] * slid * (1 - wear["beta"]) * wear["pressure"]
    share, pressure = wear["beta"] * wear["chi"] * slid, 0.0
    for _ in range(60):
        _, W1, W2 = law_numbers(law, known + share * pressure, multiplier)
        pressure -= (pressure + W1) / (1 + share * W2)
    by_gap = area * W2 / (1 + share * W2)
    by_slid = by_gap * wear["chi"] * ((1 - wear["beta"]) * wear["pressure"] + wear["beta"] * pressure)
    change = by_gap * v.dg + by_slid * dslid
    if w is None:
        return np.outer(v.dg, change) + v.D2(-area * pressure, np.zeros(p.T))
    f = Friction(v, law, w, area, area * pressure, np.zeros(p.T), False)
    return np.outer(v.dg, change) + v.D2(-area * pressure, f.t) + v.dxi.T @ f.dt(-f.by_pressure * change)


def cross_matrix(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def rigid_tangent(Q, d, force, tangent):
    """Section 6; force and tangent: phi and its derivative in the frame of the body."""
    n = len(d)
    spins = [2] if n == 2 else [0, 1, 2]
    K, f = np.zeros((3, 3)), np.zeros(3)
    K[:n, :n], f[:n] = Q[:n, :n] @ tangent @ Q[:n, :n].T, Q[:n, :n] @ force
    D, F = cross_matrix(np.append(d, [0.0] * (3 - n))), cross_matrix(f)
    X, Y = K @ D - F, F - D @ K
    K, X_n, Y_n = K[:n, :n], X[:n, spins], Y[spins, :n]
    return np.block([[K, -K, X_n], [-K, K, -X_n], [Y_n, -Y_n, -(D @ X)[np.ix_(spins, spins)]]])
