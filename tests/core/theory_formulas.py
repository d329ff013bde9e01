# SPDX-License-Identifier: BSD-3-Clause
"""The formulas of section 3 of abi/manual/theory.md as that page states them, for one element.

A form is an array [field, component], fields in the order delta X, delta a_k, delta a_kl (section 3.1)."""
import itertools

import numpy as np

from theory_numbers import Nil, moved

STEP = 1e-150  # of a complex step


def solve(matrix, vectors):
    return np.linalg.solve(matrix, vectors)


def turned(a):
    """The area vector of tangents [T, D]."""
    return np.array([-a[0][1], a[0][0]]) if len(a) == 1 else np.cross(a[0], a[1])


class Point:
    """The surface at xi, seen from the slave node: sections 1.2 and 1.4. xi may be complex."""

    def __init__(self, surface, x, xi):
        self.surface, self.x, self.xi, self.basis = surface, x, xi, surface.basis
        T, D = self.basis.T, self.basis.D
        self.T, self.D = T, D
        self.pairs = [(k, l) for k in range(T) for l in range(k, T)]
        self.fields = 1 + T + len(self.pairs)
        span = range(T)
        nodes = x[1:]
        N = {by: self.basis.shape(xi, by) for order in range(4) for by in itertools.combinations_with_replacement(span, order)}
        self.N = lambda *by: N[tuple(sorted(by))]
        self.X = x[0] - self.N() @ nodes
        self.a = np.array([self.N(k) @ nodes for k in span])
        self.a2 = np.array([[self.N(k, l) @ nodes for l in span] for k in span])
        self.a3 = np.array([[[self.N(k, l, c) @ nodes for c in span] for l in span] for k in span])
        self.set_height(xi)
        self.m = turned(self.a)
        self.area = np.sqrt(self.m @ self.m)
        self.n = self.m / self.area
        self.up = np.linalg.inv(self.a @ self.a.T)  # a^kl
        self.dual = self.up @ self.a
        self.n1 = np.array([-sum(self.dual[k] * (self.n @ self.a2[k, a]) for k in span) for a in span])
        self.n2 = np.array([[-self.n * (self.n1[a] @ self.n1[b]) - sum(self.dual[k] * (self.n1[a] @ self.a2[k, b] + self.n1[b] @ self.a2[k, a] +
                                                                                      self.n @ self.a3[k, a, b]) for k in span)
                             for b in span] for a in span])
        h, h1, h2, n, n1 = self.h, self.h1, self.h2, self.n, self.n1
        self.d = self.X - h * n
        self.e = np.array([self.a[a] + h1[a] * n + h * n1[a] for a in span])
        self.e2 = np.array([[self.a2[a, b] + h2[a, b] * n + h1[a] * n1[b] + h1[b] * n1[a] + h * self.n2[a, b] for b in span] for a in span])
        self.A = self.e @ self.e.T
        self.F2 = self.A - self.e2 @ self.d
        m_e = turned(self.e)
        self.m_e = m_e
        self.n_e = m_e / np.sqrt(m_e @ m_e)
        self.g = self.d @ self.n_e
        self.H = self.e2 @ self.n_e

    def set_height(self, xi):
        T, directions = self.T, np.eye(self.T)
        jets = {}
        for abc in itertools.combinations_with_replacement(range(T), 3):
            at = Nil(np.asarray(xi)[None])
            for unit, a in enumerate(abc, 1):
                at = moved(at, unit, directions[a], unit)
            jets[abc] = self.surface.h(at)
        jet = lambda *by: jets[tuple(sorted(by))]
        self.h = jet(0, 0, 0).part()
        self.h1 = np.array([jet(a, a, a).part(1) for a in range(T)])
        self.h2 = np.array([[jet(min(a, b), min(a, b), max(a, b)).part(1, 3) for b in range(T)] for a in range(T)])

    def area_derivatives(self):
        """m_,a and m_,ab (section 1.2)."""
        span, a, a2, a3 = range(self.T), self.a, self.a2, self.a3
        if self.T == 1:
            return np.array([turned(a2[0])]), np.array([[turned(a3[0, 0])]])
        m1 = np.array([np.cross(a2[0, c], a[1]) + np.cross(a[0], a2[1, c]) for c in span])
        m2 = np.array([[np.cross(a3[0, b, c], a[1]) + np.cross(a2[0, b], a2[1, c]) + np.cross(a2[0, c], a2[1, b]) + np.cross(a[0], a3[1, b, c])
                        for c in span] for b in span])
        return m1, m2

    # Section 3.1
    def zero(self):
        return np.zeros((self.fields, self.D), dtype=np.result_type(self.e, float))

    def field(self, k, l):
        return 1 + self.T + self.pairs.index((min(k, l), max(k, l)))

    def expand(self, form, weights=None):
        rows = [np.concatenate([[1.0], -self.N()])]
        rows += [np.concatenate([[0.0], self.N(k)]) for k in range(self.T)]
        rows += [np.concatenate([[0.0], self.N(k, l)]) for k, l in self.pairs]
        return np.einsum("fn,fd->nd", np.array(rows) if weights is None else weights, form).ravel()

    # Section 3.2
    def form_of_w(self, k):
        f = self.zero()
        f[1 + k] = self.n
        return f

    def form_of_p(self, c):
        f = self.zero()
        f[0] = c
        for k in range(self.T):
            f[1 + k] = self.h * (c @ self.dual[k]) * self.n
        return f

    def form_of_slope(self, a, c):
        f, span = self.zero(), range(self.T)
        up, along = [c @ self.dual[k] for k in span], c @ self.n
        f[1 + a] += c
        for k in span:
            factor = -self.h1[a] * up[k] + self.h * (along * (self.dual[k] @ self.n1[a]) +
                                                     sum(up[l] * (self.dual[k] @ self.a2[l, a]) for l in span))
            f[1 + k] += factor * self.n - self.h * up[k] * self.n1[a]
            f[self.field(k, a)] += -self.h * up[k] * self.n
        return f

    def form_of_z(self, k, c):
        f = self.zero()
        for l in range(self.T):
            f[1 + l] = 0.5 * self.h * (c @ self.n) * self.up[k, l] * self.n - self.h * (c @ self.dual[l]) * self.dual[k]
        return f

    def second_at_fixed_xi(self, c):
        """- c . delta Delta rho_e"""
        pairs = [(self.expand(self.form_of_w(k)), self.expand(self.form_of_z(k, c))) for k in range(self.T)]
        return sum(np.outer(w, z) + np.outer(z, w) for w, z in pairs)

    # Section 3.3
    def form_of_f(self, a):
        return self.form_of_p(self.e[a]) + self.form_of_slope(a, self.d)

    def form_of_zF(self, a):
        f = self.form_of_z(a, self.d)
        f[0] += self.h * self.dual[a]
        for k in range(self.T):
            f[1 + k] += 0.5 * self.h ** 2 * self.up[a, k] * self.n
        return f

    def weights_squared(self):
        s = np.concatenate([[1.0], -self.N()])
        return np.kron(np.outer(s, s), np.eye(self.D))

    def F_uu(self):
        pairs = [(self.expand(self.form_of_w(a)), self.expand(self.form_of_zF(a))) for a in range(self.T)]
        return self.weights_squared() + sum(np.outer(w, z) + np.outer(z, w) for w, z in pairs)


def symmetric(v, w):
    return np.outer(v, w) + np.outer(w, v)


class Normal:
    """Variations of a normal projection: sections 3.3 to 3.6 and 3.8."""

    def __init__(self, point):
        p = self.p = point
        span = range(p.T)
        self.M = np.linalg.inv(p.F2)
        self.f = np.array([p.expand(p.form_of_f(a)) for a in span])
        self.dxi = self.M @ self.f
        self.dg = p.expand(p.form_of_p(p.n_e))
        self.g, self.turn = p.g, 0.0

    def D2F(self):
        return self.p.F_uu() - self.f.T @ self.M @ self.f

    def D2g_by_p(self):
        p, M = self.p, self.M
        P = np.array([p.expand(p.form_of_p(p.e[a])) for a in range(p.T)])
        q = np.array([p.expand(p.form_of_slope(a, p.n_e)) for a in range(p.T)])
        return (p.second_at_fixed_xi(p.n_e) - P.T @ solve(p.A, p.H) @ M @ P - P.T @ M @ q - q.T @ M @ P - p.g * q.T @ M @ q)

    def D2g(self):
        """The sum of products."""
        p, span = self.p, range(self.p.T)
        q = np.array([p.expand(p.form_of_slope(a, p.n_e)) for a in span])
        P = p.g * solve(p.A, p.H) - np.eye(p.T)
        HP = p.H @ P
        total = p.second_at_fixed_xi(p.n_e)
        hat = [q[0] / np.sqrt(p.A[0, 0])]
        if p.T == 2:
            hat.append((p.A[0, 0] * q[1] - p.A[0, 1] * q[0]) / np.sqrt(p.A[0, 0] * np.linalg.det(p.A)))
        for a in span:
            Y = sum(P[b, a] * q[b] + 0.5 * HP[a, b] * self.dxi[b] for b in span)
            total = total + p.g * np.outer(hat[a], hat[a]) + symmetric(self.dxi[a], Y)
        return total

    def D2g_small(self):
        p = self.p
        lowered = np.array([p.expand(p.form_of_p(p.e[a])) for a in range(p.T)])
        q = np.array([p.expand(p.form_of_slope(a, p.n_e)) for a in range(p.T)])
        up = np.linalg.inv(p.A)
        return p.second_at_fixed_xi(p.n_e) - q.T @ up @ lowered - lowered.T @ up @ q - lowered.T @ up @ p.H @ up @ lowered

    def D2(self, b, t):
        """b D2g + t_a D2xi^a"""
        return b * self.D2g() + SecondXi(self, t).matrix(0.0)


class Shadow:
    """Sections 2.3 and 3.7; q: 1 / the distance of the emitter, or 0."""

    def __init__(self, point, e, q):
        p = self.p = point
        self.e, self.q, self.g = e, q, (p.m_e @ p.d) / (p.m_e @ e)
        self.c = p.m_e / (p.m_e @ e)
        if p.T == 1:
            self.onto = [np.array([e[1], -e[0]]) / (p.m_e @ e)]
        else:
            self.onto = [np.cross(p.e[1], e) / (p.m_e @ e), np.cross(e, p.e[0]) / (p.m_e @ e)]
        self.dg = self.first(self.c)
        self.dxi = np.array([self.first(onto) for onto in self.onto])

    def turn(self, C):
        """The vector r of C . delta e = r . delta x_s."""
        return -self.q * (C - (C @ self.e) * self.e)

    def at_slave(self, v):
        return np.concatenate([v, np.zeros(self.p.D * self.p.basis.nodes)])

    def first(self, c):
        return self.p.expand(self.p.form_of_p(c)) - self.g * self.at_slave(self.turn(c))

    def D2(self, b, t):
        p, q_ray, e, D = self.p, self.q, self.e, self.p.D
        C = b * self.c + sum(t[a] * self.onto[a] for a in range(p.T))
        q = np.array([p.expand(p.form_of_slope(a, C)) for a in range(p.T)])
        H, r = p.e2 @ C, self.turn(C)
        total = p.second_at_fixed_xi(C) - q.T @ self.dxi - self.dxi.T @ q - self.dxi.T @ H @ self.dxi
        total = total - symmetric(self.dg, self.at_slave(r))
        total[:D, :D] -= self.g * (q_ray * symmetric(r, e) - (C @ e) * q_ray ** 2 * (np.eye(D) - np.outer(e, e)))
        return total


class SecondXi:
    """Section 3.8: t_a D2xi^a of a normal projection, and the arrays of section 5.5."""

    def __init__(self, normal, t):
        p = self.p = normal.p
        self.normal, span = normal, range(p.T)
        self.y = -normal.M @ t
        self.at = Point(p.surface, p.x, p.xi + 1j * STEP * self.y)  # derivatives along y at fixed nodes

    def rate(self, quantity):
        return quantity.imag / STEP

    def form_rate(self, form, moving):
        """The expansion's derivative: of a form and of the same at xi + i STEP y."""
        p, y = self.p, self.y
        own, rate = form, self.rate(moving)
        f = p.zero()
        f[0] = rate[0]
        for k in range(p.T):
            f[1 + k] = rate[1 + k] - y[k] * own[0]
        for k, l in p.pairs:
            f[p.field(k, l)] = rate[p.field(k, l)] + y[l] * own[1 + k] + (y[k] * own[1 + l] if k != l else 0.0)
        third = np.zeros((p.fields, p.basis.nodes + 1))
        for k, l in p.pairs:
            third[p.field(k, l), 1:] = sum(y[c] * p.N(k, l, c) for c in range(p.T))
        return p.expand(f) + p.expand(own, third)

    def F2_rate(self):
        """F'_,ab by its formula."""
        p, y, span = self.p, self.y, range(self.p.T)
        m1, m2 = p.area_derivatives()
        m1_rate, m2_rate = (self.rate(v) for v in self.at.area_derivatives())
        h_rate, h1_rate, h2_rate = self.rate(self.at.h), self.rate(self.at.h1), self.rate(self.at.h2)
        d, n, n1, n2 = p.d, p.n, p.n1, p.n2
        n_rate, n1_rate = y @ n1, np.einsum("b,abi->ai", y, n2)
        m_rate, e_rate, d_rate = y @ m1, np.einsum("b,abi->ai", y, p.e2), -y @ p.e
        a2_rate = np.einsum("c,abci->abi", y, p.a3)
        out = np.zeros((p.T, p.T))
        for a in span:
            for b in span:
                tau = n1[a] @ m1[b] + n @ m2[a, b]
                tau_rate = n1_rate[a] @ m1[b] + n1[a] @ m1_rate[b] + n_rate @ m2[a, b] + n @ m2_rate[a, b]
                along = [n_rate @ m1[k] + n @ m1_rate[k] for k in span]
                d_n2_rate = (d @ m2_rate[a, b] - (d @ n1_rate[a]) * (n @ m1[b]) - (d @ n1[a]) * along[b] - (d @ n1_rate[b]) * (n @ m1[a]) -
                             (d @ n1[b]) * along[a] - (d @ n_rate) * tau - (d @ n) * tau_rate - (n @ m_rate) * (d @ n2[a, b])) / p.area
                bend = (d @ a2_rate[a, b] + h2_rate[a, b] * (d @ n) + p.h2[a, b] * (d @ n_rate) + h_rate * (d @ n2[a, b]) + p.h * d_n2_rate +
                        h1_rate[a] * (d @ n1[b]) + p.h1[a] * (d @ n1_rate[b]) + h1_rate[b] * (d @ n1[a]) + p.h1[b] * (d @ n1_rate[a]))
                out[a, b] = e_rate[a] @ p.e[b] + p.e[a] @ e_rate[b] - d_rate @ p.e2[a, b] - bend
        return out

    def matrix(self, k):
        """t_a D2xi^a + k D2F*, the sum of products of section 5.5 without dt_a."""
        p, span = self.p, range(self.p.T)
        s = np.concatenate([[1.0], -p.N()])
        change = np.concatenate([[0.0], -sum(self.y[b] * p.N(b) for b in span)])
        r = change + 0.5 * k * s
        total = np.kron(symmetric(s, r), np.eye(p.D))
        F2_rate = self.F2_rate()
        for a in span:
            x = self.normal.dxi
            Y = -self.form_rate(p.form_of_f(a), self.at.form_of_f(a))
            Y = Y + sum(0.5 * (F2_rate[a, b] - k * p.F2[a, b]) * x[b] for b in span)
            z = p.expand(p.form_of_zF(a))
            Z = self.form_rate(p.form_of_zF(a), self.at.form_of_zF(a)) + k * z
            turned_w = p.zero()  # w'_a = n' . delta a_a + y^b n . delta a_ab
            turned_w[1 + a] = self.y @ p.n1
            for b in span:
                turned_w[p.field(a, b)] += self.y[b] * p.n
            total = total + symmetric(x[a], Y) + symmetric(p.expand(p.form_of_w(a)), Z) + symmetric(p.expand(turned_w), z)
        return total
