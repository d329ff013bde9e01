#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""theory_test.py ROOT [SEED]: the formulas of sections 3, 4 and 5 of abi/manual/theory.md (theory_formulas.py, theory_laws.py) and the
tangents of its sections 6 and 7.1 against derivatives of what the page defines (theory_definitions.py), without the library.

exact        derivatives by numbers whose units have the square zero (theory_numbers.py): 1e-12 of the largest entry
differences  nested differences of order six of the projection in floating-point numbers: 1e-7 of the sum of the products
             |v_i K_ij w_j|; their own error is below 1e-9
page         every law of the table of section 4.1 is among the cases, and every law of core/law/contact_law.hpp is in that table

exit status: 0 passed; 1 a formula or the page is wrong; 3 no NumPy here"""
import itertools
import pathlib
import re
import sys
import unittest

sys.dont_write_bytecode = True
try:
    import numpy as np
except ModuleNotFoundError as error:
    print(f"theory_test.py: {error} (Debian: python3-numpy)")
    sys.exit(3)
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import theory_cases as cases  # noqa: E402
import theory_definitions as definitions  # noqa: E402
import theory_formulas as formulas  # noqa: E402
import theory_laws as laws  # noqa: E402
from theory_cases import DIFFERENCES, Case, Checked, random_law  # noqa: E402
from theory_numbers import moved, value  # noqa: E402

ROOT = pathlib.Path(sys.argv.pop(1)) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2]
if len(sys.argv) > 1 and sys.argv[1].isdigit():
    cases.SEED = int(sys.argv.pop(1))
OFFSETS, FACTORS = np.array([-3, -2, -1, 1, 2, 3]), np.array([-1 / 60, 3 / 20, -3 / 4, 3 / 4, -3 / 20, 1 / 60])


class Variations(Checked):
    """Section 3."""

    def elements(self, ray=False):
        rng = self.rng()
        for k, basis in enumerate(definitions.BASES):
            heights = ("sine", "gaussian", "product") if ray is False else ("sine", "none")
            for height in dict.fromkeys(["none", heights[k % len(heights)]]):
                rays = (None,) if ray is False else (("direction", "emitter")[(k + len(height)) % 2],)
                for kind in rays:
                    yield rng, Case(rng, basis, height, kind, coordinates=k % 2 == 1)

    def test_at_fixed_natural_coordinates(self):
        for rng, case in self.elements():
            p, T = case.point, case.basis.T
            first, second = case.pairs(rng)
            x, xi = case.varied(first, second, vary_xi=False)
            c = rng.normal(size=case.basis.D)
            rho_e, tangents = case.surface.tangents(x, xi, 3)
            moves = np.zeros(case.dofs())
            moves[:case.basis.D] = c
            self.near("3.2", f"c . p of {case.name}", p.expand(p.form_of_p(c))[first], moves[first] - rho_e.part(1) @ c)
            for a in range(T):
                self.near("3.2", f"c . delta rho_e,{a} of {case.name}", p.expand(p.form_of_slope(a, c))[first], tangents[a].part(1) @ c)
            self.near("3.2", f"delta Delta rho_e of {case.name}", p.second_at_fixed_xi(c)[first, second], -(rho_e.part(1, 2) @ c),
                      scale=np.max(np.abs(p.second_at_fixed_xi(c))))
            d = x[..., 0, :] - rho_e
            F = 0.5 * (d * d).sum(-1)
            self.near("3.3", f"F_uu of {case.name}", p.F_uu()[first, second], F.part(1, 2), scale=np.max(np.abs(p.F_uu())))
            for a in range(T):
                f = p.expand(p.form_of_f(a))
                self.near("3.3", f"f_{a} of {case.name}", f[first], (d * tangents[a]).sum(-1).part(1), scale=np.max(np.abs(f)))
            for a, b in itertools.product(range(T), repeat=2):
                there = moved(moved(case.xi, 1, np.eye(T)[a], 1), 2, np.eye(T)[b], 2)
                off = case.x[0] - case.surface.rho_e(case.x, there)
                self.near("2.1", f"F_,{a}{b} of {case.name}", p.F2[a, b], 0.5 * (off * off).sum(-1).part(1, 2), scale=np.max(np.abs(p.F2)))
            m1, m2 = p.area_derivatives()
            along = m1 @ p.n
            for a, b in itertools.product(range(T), repeat=2):
                by_area = m2[a, b] - p.n1[a] * along[b] - p.n1[b] * along[a] - p.n * (p.n1[a] @ m1[b] + p.n @ m2[a, b])
                self.near("1.2", f"n_,{a}{b} of {case.name}", by_area, p.area * p.n2[a, b], scale=p.area)
                self.near("1.2", f"n_,{a} of {case.name}", m1[a] - p.n * along[a], p.area * p.n1[a], scale=p.area)

    def test_of_the_projection(self):
        for rng, case in [*self.elements(), *self.elements(ray=True)]:
            v, T = case.variations, case.basis.T
            first, second = case.pairs(rng)
            x, xi = case.varied(first, second)
            g, _ = case.projection.gap(x, xi, 3)
            section = "3.7" if case.ray else "3.5"
            self.near("3.4", f"delta g of {case.name}", v.dg[first], g.part(1), scale=np.max(np.abs(v.dg)))
            for a in range(T):
                self.near("3.3", f"delta xi^{a} of {case.name}", v.dxi[a][first], xi[..., a].part(1), scale=np.max(np.abs(v.dxi)))
                D2 = v.D2(0.0, np.eye(T)[a])
                self.near("3.7" if case.ray else "3.8", f"D2 xi^{a} of {case.name}", D2[first, second], xi[..., a].part(1, 2),
                          scale=np.max(np.abs(D2)))
            D2g = v.D2(1.0, np.zeros(T))
            scale = np.max(np.abs(D2g))
            self.near(section, f"D2 g of {case.name}", D2g[first, second], g.part(1, 2), scale=scale)
            if case.ray is None:
                self.near("3.5", f"D2 g by p_a of {case.name}", v.D2g_by_p(), D2g, scale=scale)
                self.near("3.3", f"D2 F* of {case.name}", v.D2F(), np.outer(v.dg, v.dg) + v.g * D2g)
                moving = formulas.SecondXi(v, rng.normal(size=T))
                self.near("3.8", f"F'_,ab of {case.name}", moving.F2_rate(), moving.rate(moving.at.F2))

    def test_of_small_gaps(self):
        rng = self.rng()
        for basis in definitions.BASES:
            v = Case(rng, basis, "product", gap=0.0).variations
            self.near("3.6", f"D2 g of {basis} at g = 0", v.D2g_small(), v.D2g())

    def test_of_the_reduced_space(self):
        rng = self.rng()
        for basis in ("tri3", "quad4"):
            p = Case(rng, basis).point
            form = rng.normal(size=(p.fields, 3))
            X, first, second, (xi_1, xi_2) = form[0], form[1], form[2], p.xi
            if basis == "tri3":
                form[3:] = 0.0
                nodes = [None, first - xi_1 * X, second - xi_2 * X]
                nodes[0] = -(nodes[1] + nodes[2] + X)
            else:
                form[3] = form[5] = 0.0
                nodes = [(-X + s * (first - xi_1 * X) + t * (second - xi_2 * X) + s * t * (form[4] + xi_1 * second + xi_2 * first - xi_1 * xi_2 * X)) / 4
                         for s, t in definitions.CORNERS]
            self.near("3.10", f"expansion of {basis}", p.expand(form), np.concatenate([X, *nodes]))


class Laws(Checked):
    """Section 4.1 and 4.5: numbers of the laws."""

    def test_derivatives_of_the_energies(self):
        rng = self.rng()
        for kind in definitions.ENERGIES:
            pulls = kind in ("tied", "cohesive", "dugdale", "separation", "lennard_jones")
            for g in np.concatenate([np.linspace(-0.34, -0.01, 12), np.linspace(0.01, 0.49, 24) if pulls else []]):
                law, multiplier = random_law(rng, kind), rng.uniform(0.5, 2.0)
                energy = definitions.ENERGIES[kind](law, moved(moved(np.array(g), 1, 1.0, 1), 2, 1.0, 2), multiplier)
                W, W1, W2 = laws.law_numbers(law, g, multiplier)
                if kind != "multiplier":
                    self.near("4.1", f"W'' of {kind}", W2, energy.part(1, 2))
                self.near("4.1", f"W of {kind}", W, energy.part())
                self.near("4.1", f"W' of {kind}", W1, energy.part(1))

    def test_table(self):
        rng = self.rng()
        for n in (2, 3, 5, 9):
            gaps = np.cumsum(rng.uniform(0.1, 1.0, n)) - 2.0
            table = definitions.Table(gaps, np.append(np.cumsum(rng.uniform(0.05, 2.0, n - 1))[::-1], 0.0))
            self.assertTrue(table.slopes[-1] == 0.0 and np.all(table.slopes >= 0.0))
            for i in range(n - 1):
                start, end = table.between(i, gaps[i]), table.between(i, gaps[i + 1])
                self.near("4.5", "W', W'' at a point", start[1:], [table.forces[i], table.slopes[i]])
                self.near("4.5", "W, W', W'' at the next", end, [table.energies[i + 1], table.forces[i + 1], table.slopes[i + 1]],
                          scale=np.max(np.abs(start)))
                inside = table.between(i, np.linspace(gaps[i], gaps[i + 1], 40))
                self.assertGreaterEqual(np.min(inside[2]), -1e-12, "the pressure falls")

    def test_page_has_them_all(self):
        section = re.search(r"^### 4\.1 .*?(?=^### )", (ROOT / "abi/manual/theory.md").read_text(), re.S | re.M)[0]
        listed = set(re.findall(r"^\| `(\w+)` \|", section, re.M))
        self.assertEqual(listed, set(definitions.ENERGIES), "laws of section 4.1, laws of this test")
        header = (ROOT / "core/law/normal_kinds.hpp").read_text()
        kinds = re.findall(r"^  X\((\w+), \w+\)", header, re.M)
        self.assertEqual(listed, set(kinds), "laws of section 4.1, laws of normal_kinds.hpp")


class Tangents(Checked):
    """Sections 4 and 5: the tangent of every law, with and without friction."""

    def elements(self):
        rng = self.rng()
        modes = [None, "stick", "slip", "shear_limit", "rough"]
        bases = itertools.cycle(definitions.BASES)
        heights = itertools.cycle(["sine", "none", "product", "gaussian", "product"])
        for kind, mode, ray in itertools.product(definitions.ENERGIES, modes, [None, "direction", "emitter"]):
            if mode == "shear_limit" and ray or mode == "rough" and ray == "emitter":
                continue
            case = Case(rng, next(bases), next(heights), ray, coordinates=rng.random() < 0.4)
            law = random_law(rng, kind)
            T = case.basis.T
            w = rng.choice([-1.0, 1.0], T) * rng.uniform(0.1, 0.2, T)
            along = law["eps_t"] * case.point.A @ w  # a multiplier in this direction leaves the trial far from zero
            multipliers = np.concatenate([[rng.uniform(0.5, 2.0)], along * rng.uniform(0.2, 1.0, T)])
            if kind not in ("augmented", "augmented_multiplier", "multiplier"):
                multipliers[:] = 0.0
            offset = 0.0 if kind in ("penalty", "power") else 0.01
            area = rng.uniform(0.5, 2.0)
            if mode:
                W1 = laws.law_numbers(law, case.variations.g + offset, multipliers[0])[1]
                trial = laws.Friction(case.variations, dict(law, rough=True), w, area, 1.0, multipliers[1:], True).norm
                if mode == "rough":
                    law["rough"], law["mu"] = True, 0.0
                else:
                    law["mu"] = trial / (-area * W1) * (2.5 if mode == "stick" else 0.45 if mode == "slip" else 1.2)
                if mode == "shear_limit":
                    law["shear_limit"] = 0.5 * trial / area
            if kind == "penalty":
                law["m"] = 1.0
            yield rng, case, law, mode, multipliers, offset, w, area

    def force_terms(self, case, law, mode, x, xi, multipliers, offset, w, area, unit):
        """g, A W', t_a and A W_,lambda from the definitions, at x and xi (numbers or arrays)."""
        g, metric = case.projection.gap(x, xi, unit)
        seen = g + offset
        push = area * definitions.derivative_of_energy(law, seen, multipliers[0] + 0.0 * seen, unit, "gap")
        equation = area * definitions.derivative_of_energy(law, seen, multipliers[0] + 0.0 * seen, unit, "multiplier")
        t, slips = [], None
        if mode:
            anchor = case.xi - w
            T = case.basis.T
            t, slips = definitions.friction_force(law, metric, [xi[..., a] - anchor[a] + 0.0 * g for a in range(T)], -push, area,
                                                  [m + 0.0 * g for m in multipliers[1:]])
        return g, push, t, equation, slips

    def test_of_every_law(self):
        for rng, *element in self.elements():
            case, law, mode, multipliers, offset, w, area = element
            self.name = f"{law['type']}, {mode}, {case.name}"
            self.section = "5" if mode else "4"
            K = laws.tangent(case.variations, law, area, case.variations.g + offset, multipliers, w, mode, np.any(multipliers[1:]))
            self.compare_exact(rng, K, *element)
            self.compare_differences(rng, K, *element)
            if mode:
                push = area * laws.law_numbers(law, case.variations.g + offset, multipliers[0])[1]
                friction, dL = laws.Friction(case.variations, law, w, area, -push, multipliers[1:], np.any(multipliers[1:])), rng.normal(size=K[0].size)
                dL = dL[:case.dofs()]
                self.near("5.4", f"delta t_a of {self.name}", friction.dt(dL), friction.dt_by_metric(dL))
            if law["type"] in ("penalty", "power") and not case.ray:
                short = laws.short_tangent(case.variations, law, area, w, mode)
                self.near("5.5" if mode else "4.2", f"short sum of {self.name}", short, K)

    def compare_exact(self, rng, K, *element):
        case, law, mode, multipliers, offset, w, area = element
        T, n = case.basis.T, case.dofs()
        others = len(K) - n
        first, second = case.pairs(rng, others)
        x, xi = case.varied(first, second)
        lambdas = [moved(np.full(len(first), multipliers[k]), 2, (second == n + k).astype(float), 2) for k in range(1 + T)]
        g, push, t, equation, slips = self.force_terms(case, law, mode, x, xi, lambdas, offset, w, area, 3)
        self.assertEqual(slips, None if mode is None else mode in ("slip", "shear_limit"), self.name)
        wanted = push.part(2) * g.part(1) + push.part() * g.part(1, 2)
        for a in range(T if mode else 0):
            wanted = wanted + t[a].part(2) * xi[..., a].part(1) + t[a].part() * xi[..., a].part(1, 2)
        self.near(self.section, f"K of {self.name}", K[first, second], wanted, scale=np.max(np.abs(K[:n, :n])))
        if not others:
            return
        scale = np.max(np.abs(K[n:]))
        self.near("4.4", f"row of lambda of {self.name}", K[n, second], equation.part(2), scale=scale)
        for a in range(T if mode else 0):
            row = (t[a] - area * lambdas[1 + a]) * (1 / law["eps_t"])
            self.near("5.6", f"row of lambda_{a} of {self.name}", K[n + 1 + a, second], row.part(2), scale=scale)

    def compare_differences(self, rng, K, *element):
        case, law, mode, multipliers, offset, w, area = element
        T, n, step = case.basis.T, case.dofs(), 4e-3
        K = K[:n, :n]
        v, u = rng.normal(size=n) / np.sqrt(n), rng.normal(size=n) / np.sqrt(n)
        inner = np.append(OFFSETS, 0)
        x = case.x + (step * OFFSETS[:, None, None, None] * u.reshape(case.x.shape) + step * inner[:, None, None] * v.reshape(case.x.shape))
        xi = case.projection.solve(x, case.xi)
        g, push, t, _, _ = self.force_terms(case, law, mode, x, xi, multipliers, offset, w, area, 1)
        work = value(push)[:, -1] * (value(g)[:, :-1] @ FACTORS) / step
        for a in range(T if mode else 0):
            work = work + value(t[a])[:, -1] * (xi[:, :-1, a] @ FACTORS) / step
        scale = np.abs(v) @ np.abs(K) @ np.abs(u)
        self.near(self.section, f"v . K u of {self.name}", v @ K @ u, work @ FACTORS / step, scale, DIFFERENCES)

    def test_open_multipliers(self):
        for kind, mode in itertools.product(("augmented_multiplier", "multiplier"), (None, "stick")):
            rng = self.rng()
            case, law = Case(rng, "quad4"), random_law(rng, kind, contact=False)
            K = laws.tangent(case.variations, law, 1.3, 0.1, np.ones(3), np.zeros(2), mode, True)
            n, one = case.dofs(), moved(np.array(0.4), 1, 1.0, 1)
            equation = 1.3 * definitions.derivative_of_energy(law, np.array(0.1), one, 2, "multiplier")
            self.near("4.4", f"open {kind}", K[n, n], equation.part(1))
            self.assertEqual(np.count_nonzero(K[:n]), 0)
            for a in range(len(K) - n - 1):
                self.near("5.6", "open lambda_a", K[n + 1 + a, n + 1 + a], -1.3 / law["eps_t"])

    def test_ratio_of_forces(self):
        rng = self.rng()
        for _ in range(20):
            case, law = Case(rng, "line3", "sine"), random_law(rng, "penalty")
            v, p = case.variations, case.point
            force = law["mu"] * -law["eps"] * v.g
            t = force * np.sqrt(p.A[0, 0])  # |t| = sqrt(t_a A^ab t_b)
            kappa = -p.H[0, 0] / p.A[0, 0]
            tangential = np.linalg.norm(t * v.M[0, 0] * p.e[0])
            self.near("5.9", "mu / (1 - kappa |g|)", tangential / (-law["eps"] * v.g), law["mu"] / (1 - kappa * abs(v.g)))


class OtherTangents(Checked):
    """Sections 6 and 7.1."""

    def test_wear(self):
        rng = self.rng()
        kinds = itertools.product(("penalty", "power", "exponential", "augmented"), (1.0, 0.5, 0.0), (0, 1))
        for k, (kind, scheme, mode) in enumerate(kinds):
            ray = (None, "emitter")[(k // 2 + mode) % 2]
            case, law = Case(rng, rng.choice(list(definitions.BASES)), "product", ray), random_law(rng, kind)
            T, n, area, multiplier = case.basis.T, case.dofs(), rng.uniform(0.5, 2.0), 0.3 if kind == "augmented" else 0.0
            wear = {"chi": 0.05, "beta": scheme, "depth": 0.01, "pressure": 0.6, "sliding": 0.1, "moved": rng.uniform(0.1, 0.2, T)}
            law["mu"] = 0.01
            w = rng.uniform(0.1, 0.2, T) if mode else None
            K = laws.worn_tangent(case.variations, law, area, multiplier, wear, w)
            first, second = case.pairs(rng)
            x, xi = case.varied(first, second)
            g, metric = case.projection.gap(x, xi, 3)
            p = definitions.worn_pressure(law, g, multiplier, wear, [xi[..., a] - case.xi[a] + wear["moved"][a] for a in range(T)], metric, 3)
            wanted = -area * (p.part(2) * g.part(1) + p.part() * g.part(1, 2))
            if mode:
                t, slips = definitions.friction_force(law, metric, [xi[..., a] - case.xi[a] + w[a] for a in range(T)], area * p, area, [0.0 * g] * T)
                self.assertTrue(slips)
                for a in range(T):
                    wanted = wanted + t[a].part(2) * xi[..., a].part(1) + t[a].part() * xi[..., a].part(1, 2)
            self.near("7.1", f"K of {kind}, {'slip' if mode else None}, wear {scheme}, {case.name}", K[first, second], wanted, scale=np.max(np.abs(K)))

    def test_rigid_master(self):
        rng = self.rng()
        for D in (2, 3):
            spins = [2] if D == 2 else [0, 1, 2]
            B, x_s, x_r, Q = rng.normal(size=(D, D)), rng.normal(size=D), rng.normal(size=D), np.eye(3)
            Q[:D, :D] = np.linalg.qr(rng.normal(size=(D, D)))[0]
            Q[:, 0] *= np.linalg.det(Q)

            def residual(x_s, x_r, spin):
                """Of a force phi(y) = sin(B y) in the frame of the body, turned on by a small spin."""
                turned = (np.eye(3) + laws.cross_matrix(spin)) @ Q
                f = turned[:D, :D] @ np.sin(B @ (turned[:D, :D].T @ (x_s - x_r)))
                return np.concatenate([f, -f, -np.cross(np.append(x_s - x_r, [0.0] * (3 - D)), np.append(f, [0.0] * (3 - D)))[spins]])

            y = Q[:D, :D].T @ (x_s - x_r)
            K = laws.rigid_tangent(Q, x_s - x_r, np.sin(B @ y), np.cos(B @ y)[:, None] * B)
            columns = []
            for k in range(2 * D + len(spins)):
                step = np.zeros(2 * D + 3, dtype=complex)
                step[k if k < 2 * D else 2 * D + spins[k - 2 * D]] = 1j * formulas.STEP
                columns.append(residual(x_s + step[:D], x_r + step[D:2 * D], step[2 * D:]).imag / formulas.STEP)
            self.near("6", f"K in {D}D", K, np.array(columns).T)


if __name__ == "__main__":
    result = unittest.main(exit=False, verbosity=1).result
    for (section, kind), (count, largest) in sorted(cases.worst.items(), key=lambda item: [int(k) for k in item[0][0].split(".")]):
        print(f"section {section:5} {kind:12} {count:6} comparisons, worst {largest:.1e}")
    sys.exit(not result.wasSuccessful())
