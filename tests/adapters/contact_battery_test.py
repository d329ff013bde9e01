"""contact_battery_test.py FOLDER-OF-ents: random pairs of elastic bodies in ents.Contact. ENTS_BATTERY: how many (default 40). Exit status 3: no
NumPy or SciPy here."""
import os
import sys
import unittest

sys.dont_write_bytecode = True
try:
    import numpy as np
    import scipy.sparse as sparse
    from bodies import block, stiffness
    from scipy.sparse.linalg import spsolve
except ModuleNotFoundError as error:
    print(f"contact_battery_test.py: {error} (Debian: python3-numpy, python3-scipy)")
    sys.exit(3)
sys.path.insert(0, sys.argv[1])
import ents  # noqa: E402


def box(low, high, cells):
    """Nodes, cells, and the facets of top and bottom (outwards) of a rectangle or a cuboid."""
    d = len(low)
    if d == 2:
        x, c, n = block(low, high, cells)
        return x, c, np.column_stack([n[-1, :-1], n[-1, 1:]]), np.column_stack([n[0, 1:], n[0, :-1]]), n[-1], n[0]
    x, y, z = (np.linspace(a, b, k + 1) for a, b, k in zip(low, high, cells))
    n = np.arange(len(x) * len(y) * len(z)).reshape(len(z), len(y), len(x))
    nodes = np.stack(np.meshgrid(x, y, z, indexing="ij"), -1).transpose(2, 1, 0, 3).reshape(-1, 3)
    around = lambda k: np.stack([k[:-1, :-1], k[:-1, 1:], k[1:, 1:], k[1:, :-1]], -1).reshape(-1, 4)
    cells = np.vstack([np.hstack([around(n[k]), around(n[k + 1])]) for k in range(len(z) - 1)])
    return nodes, cells, around(n[-1]), around(n[0])[:, ::-1], n[-1].ravel(), n[0].ravel()


class Pair:
    """Two bodies of random sizes and meshes, one above the other, and how they are pressed."""

    def __init__(self, seed):
        rng = np.random.default_rng(seed)
        self.d = d = 2 if rng.random() < 0.7 else 3
        most = 20 if d == 2 else 5
        counts = rng.integers(3, most + 1, (2, d))
        counts[:, -1] = rng.integers(2, 5, 2)
        self.flush = rng.random() < 0.4
        wide, narrow = 1.0, 1.0 if self.flush else rng.uniform(0.4, 0.95)
        shift = 0.0 if self.flush or rng.random() < 0.3 else rng.uniform(0, 1 - narrow)
        gap = 0.0 if rng.random() < 0.5 else rng.uniform(0, 0.005)
        low = lambda at, z: [at] * (d - 1) + [z]
        lower = box(low(0, -0.5), low(wide, 0), counts[0])
        upper = box(low(shift, gap), low(shift + narrow, gap + 0.5), counts[1])
        first = len(lower[0])
        self.x = np.vstack([lower[0], upper[0]])
        self.K = sparse.block_diag([stiffness(lower[0], lower[1]), stiffness(upper[0], upper[1], rng.uniform(0.3, 3))], "csr")
        self.slave, self.master = first + upper[3], lower[2]
        self.bottom, self.top, self.surface = lower[5], first + upper[4], lower[4]
        self.friction = rng.random() < 0.5
        self.load = rng.random() < 0.3
        segment = {2: ("line2", "bspline4", "catmull_rom4"), 3: ("quad4", "bspline16")}[d]
        segment = segment[0] if rng.random() < 0.7 else segment[rng.integers(1, len(segment))]
        edge = 1.0 / counts[0, 0]
        law = {"normal": {"type": "penalty", "stiffness": 30.0}}
        if self.friction:
            law["friction"] = {"type": "coulomb", "coefficient": 0.3, "stiffness": 1 / edge}
        border = {"border": 0.3} if self.flush else {}  # flush edges: the softer body bulges over the other one by more than the default
        self.contact = ents.Contact({"segment": segment, "contact": law, **border}, self.x, self.slave, self.master)
        self.name = f"seed {seed}: {d}D {segment}, counts {counts.tolist()}, width {narrow:.3g} at {shift:.3g}, gap {gap:.2g}, " + (
            "friction, " if self.friction else "") + ("load" if self.load else "displacement")
        fixed = np.zeros(self.x.shape, bool)
        fixed[self.bottom] = True
        fixed[self.top, :d - 1] = True
        fixed[self.top, d - 1] = not self.load
        self.free = np.flatnonzero(~fixed.ravel())
        self.force, self.moved = np.zeros(self.x.shape), np.zeros(self.x.shape)
        if self.load:  # weak springs hold it until it touches
            self.K = self.K + sparse.diags(np.where(np.isin(np.arange(len(self.x)), self.top)[:, None] & (np.arange(d) == d - 1), 1e-2 / len(self.top), 0.0).ravel())
            self.force[self.top, d - 1] = -0.015 * narrow ** (d - 1) / len(self.top)
        self.moved[self.top, d - 1] = 0 if self.load else -gap - 0.02
        if self.friction:
            self.moved[self.top, 0] = rng.uniform(-0.01, 0.01)

    def solve(self):
        """Iterations of the steps; RuntimeError if a step cannot be solved."""
        done, step, u, counts = 0.0, 0.5, np.zeros(self.x.size), []
        while done < 1 - 1e-12:
            step = min(step, 1 - done)
            try:
                u, count = self.increment(u + step * self.moved.ravel(), (done + step) * self.force.ravel())
            except ents.CutStep as cut:
                step *= cut.step_factor
                if step < 1e-3:
                    raise RuntimeError(f"{self.name}: {cut}") from None
                continue
            self.contact.commit()
            done, step = done + step, 1.5 * step
            counts.append(count)
        self.u = u.reshape(self.x.shape)
        return counts

    def increment(self, u, force):
        for count in range(30):
            residual, tangent = self.contact.update(u)
            r = (self.K @ u + residual - force)[self.free]
            if count and np.abs(r).max() < 1e-11:
                return u, count
            u = u.copy()
            u[self.free] -= spsolve((self.K + tangent)[self.free][:, self.free].tocsc(), r)
        raise ents.CutStep(ents.Status.NO_PROJECTION, f"no convergence: {np.abs(r).max():.1e}")

    def deepest(self):
        """Penetration of the slave nodes over the plain facets of the deformed master, by brute force over all of them (2D)."""
        now = self.x + self.u
        a, b = now[self.master[:, 0]], now[self.master[:, 1]]
        p = now[np.unique(self.slave)][:, None]
        t = ((p - a) * (b - a)).sum(-1) / ((b - a) ** 2).sum(-1)
        depth = -((p - a)[..., 1] * (b - a)[:, 0] - (p - a)[..., 0] * (b - a)[:, 1]) / np.linalg.norm(b - a, axis=1)
        return np.where((t >= 0) & (t <= 1), depth, -np.inf).max()


class Battery(unittest.TestCase):
    def test_all_converge_and_none_is_lost(self):
        iterations, cuts = [], 0
        count = int(os.environ.get("ENTS_BATTERY", 40))
        for seed in range(count):
            pair = Pair(seed)
            with self.subTest(pair.name):
                counts = pair.solve()
                iterations += counts
                cuts += len(counts) > 2
                contact = pair.contact
                forces = contact.residual.reshape(pair.x.shape)
                # Balance, and every node of the slave surface that is above the master carries.
                self.assertLess(np.abs(forces.sum(axis=0)).max(), 1e-12)
                self.assertGreater(-forces[contact.nodes, -1].sum(), 1e-3)
                if pair.d == 2 and contact.model.segment != "bspline4":  # which does not go through the nodes
                    self.assertLess(pair.deepest(), 3 * contact.pressure.max() / 30)
                if pair.load:
                    weak = 1e-2 / len(pair.top) * pair.u[pair.top, -1].sum()
                    self.assertAlmostEqual(-forces[contact.nodes, -1].sum(), -pair.force.sum() + weak, delta=1e-9)
        print(f"{count} pairs: {len(iterations)} increments, median {np.median(iterations):.0f} iterations, most {max(iterations)}, pairs with cuts {cuts}")
        self.assertLessEqual(np.median(iterations), 6)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
