"""contact_restart_test.py FOLDER-OF-ents: what ents.Contact keeps: restarts, copies, arrays that are shared with nobody, iterates that fail. Exit
status 3: no NumPy or SciPy here."""
import copy
import multiprocessing
import pathlib
import pickle
import sys
import tempfile
import unittest
import warnings

sys.dont_write_bytecode = True
try:
    import numpy as np
    import scipy.sparse as sparse
    from bodies import block, chain, stiffness
    from scipy.sparse.linalg import spsolve
except ModuleNotFoundError as error:
    print(f"contact_restart_test.py: {error} (Debian: python3-numpy, python3-scipy)")
    sys.exit(3)
sys.path.insert(0, sys.argv[1])
import ents  # noqa: E402

PENALTY = {"normal": {"type": "penalty", "stiffness": 1e3}}
LAW = {**PENALTY, "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 1e3}}
MODEL = {"segment": "line2", "contact": LAW}
COUNT = 6
X = np.vstack([np.c_[np.linspace(1, 0.1, COUNT), np.full(COUNT, -0.01)], np.c_[np.linspace(-1, 2, 7), np.zeros(7)]])
SLAVE, MASTER = chain(np.arange(COUNT)), chain(np.arange(COUNT, COUNT + 7))


def new(model=MODEL):
    return ents.Contact(model, X, SLAVE, MASTER)


def moved(distance):
    u = np.zeros_like(X)
    u[:COUNT] = [distance, -0.002]
    return u


def friction(residual):
    return residual[:2 * COUNT:2].sum()


def press(depth):
    """The job of a process of a pool."""
    contact = ents.Contact({"segment": "line2", "penetration_limit": 0.05, "contact": PENALTY}, X, SLAVE, MASTER)
    u = np.zeros_like(X)
    u[:COUNT, 1] = -depth
    return contact.update(u)[0].sum()


class Restart(unittest.TestCase):
    def run_on(self, contact):
        out = []
        for distance in (0.0009, 0.4, 0.2):
            residual, tangent = contact.update(moved(distance))
            out.append((residual.tobytes(), tangent.toarray().tobytes(), contact.state.tobytes()))
            contact.commit()
        return out

    def test_every_way_has_the_same_bits(self):
        contact = new()
        for distance in (0, 0.0005, 0.0013):
            contact.update(moved(distance))
            contact.commit()
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "contact.restart"
            contact.save(file)
            loaded = new()
            loaded.load(file)
            other = ents.Contact(MODEL, X + [0.1, 0], SLAVE, MASTER)
            with self.assertRaisesRegex(ents.Error, "saved with other surfaces"):
                other.load(file)
        ways = {"load": loaded, "pickle": pickle.loads(pickle.dumps(contact)), "deepcopy": copy.deepcopy(contact), "copy": copy.copy(contact)}
        saved = contact.state.copy()
        np.testing.assert_array_equal(saved[:, -1], contact.segment + 1)  # what a state knows of its segment: augment() and .state rely on it
        contact.update(moved(0.01))  # an iterate that nobody commits leaves no trace
        ways["pickle, not committed"] = pickle.loads(pickle.dumps(contact))
        np.testing.assert_array_equal(ways["pickle, not committed"].gap, contact.gap)
        ways["pickle, not committed"].update(moved(0.001))
        wanted = self.run_on(contact)
        for name, way in ways.items():
            self.assertEqual(self.run_on(way), wanted, name)
        # As one would type it: states alone, then the displacements at which they were saved.
        typed = new()
        typed.state = saved
        typed.update(moved(0.0013))
        typed.commit()
        value = friction(typed.update(moved(0.0009))[0])
        self.assertEqual(value, friction(np.frombuffer(wanted[0][0])))
        self.assertAlmostEqual(value, 1e3 * 0.0009 * 0.9, 12)  # it sticks: stiffness, way and length
        with self.assertRaises(ValueError):
            typed.state[:] = saved
        with self.assertRaisesRegex(ents.Error, "state: the shape"):
            typed.state = saved[:2]

    def test_arrays_that_were_given_and_got(self):
        x, dofs = X.copy(), np.arange(X.size).reshape(-1, 2)
        contact = ents.Contact(MODEL, x, SLAVE, MASTER, dofs=dofs)
        first, tangent = contact.update(moved(0.01))
        kept, entries = first.copy(), tangent.copy()
        x += 5
        dofs[:] = 0
        contact.update(moved(0.2))
        np.testing.assert_array_equal(first, kept)
        self.assertEqual((tangent != entries).nnz, 0)
        tangent.data[::2] = 0
        tangent.eliminate_zeros()
        tangent.data[:] = 7
        again, matrix = contact.update(moved(0.01))
        np.testing.assert_allclose(matrix.toarray()[:2 * COUNT, :2 * COUNT], entries.toarray()[:2 * COUNT, :2 * COUNT], rtol=0, atol=1e-9)
        np.testing.assert_allclose(again[:2 * COUNT], kept[:2 * COUNT], rtol=0, atol=1e-13)  # the master's share may go to other facets
        for name in ("positions", "dofs", "areas", "nodes", "state", "gap", "pressure", "traction", "flags", "segment", "points"):
            with self.assertRaises(ValueError, msg=name):
                getattr(contact, name)[:] = 0
        for name in ("positions", "dofs", "rows", "nodes", "areas", "gap", "tangent"):
            with self.assertRaises(AttributeError, msg=name):
                setattr(contact, name, 0)
        with self.assertRaises(AttributeError):
            contact.tree.positions = X
        with self.assertRaises(ValueError):
            contact.tree.positions[:] = 0

    def test_exceptions_of_a_pool(self):
        with multiprocessing.get_context("fork").Pool(2) as pool:
            result = pool.map_async(press, [0.01, 0.1])
            with self.assertRaises(ents.CutStep) as caught:
                result.get(timeout=60)
        self.assertEqual(caught.exception.status, ents.Status.DEEP_PENETRATION)
        self.assertTrue(0 < caught.exception.step_factor < 1)
        for error in (ents.Error(ents.Status.FILE, "no file", 3), ents.CutStep(ents.Status.NO_PROJECTION, "far", 2, 0.25)):
            again = pickle.loads(pickle.dumps(error))
            self.assertEqual((type(again), str(again), vars(again)), (type(error), str(error), vars(error)))

    def test_an_iterate_that_is_not_finite(self):
        contact = new()
        contact.update(moved(0))
        contact.commit()
        before, _ = contact.update(moved(0.0004))
        nan = np.zeros(X.size)
        nan[2 * COUNT + 3] = np.nan
        collapsed = np.where(np.arange(len(X))[:, None] < COUNT, 0, -X)
        for u, words in ((np.full(X.size, np.nan), "u[0] is nan"), (nan, "u[15] is nan"), (1e200 * np.random.default_rng(0).normal(size=X.shape), ""),
                         (np.full(X.size, np.inf), "u[0] is inf"), (collapsed, "was in contact and lies beside all segments")):
            with self.assertRaises(ents.CutStep) as caught, warnings.catch_warnings():
                warnings.simplefilter("error")
                contact.update(u)
            self.assertIn(words, str(caught.exception))
            self.assertEqual(caught.exception.step_factor, 0.5)
            np.testing.assert_array_equal(contact.update(moved(0.0004))[0], before)
        contact.commit()


class Increments(unittest.TestCase):
    """What lies between the begin and the end of an increment."""

    def row(self, y, model=PENALTY, reach=0.2, **more):
        x = np.c_[np.linspace(0.8, 0.2, 4), np.full(4, y)]
        return x, ents.Contact({"segment": "line2", "master": "rigid", "contact": model}, x, chain(np.arange(4)), [[0, 1]], master_positions=[[-9, 0], [9, 0]],
                               reach=reach, **more)

    def test_friction_from_the_first_configuration_on(self):
        """Points that are in contact undeformed and slide in the first increment: mu times the pressure, in one increment or in four."""
        for count in (1, 4):
            x, contact = self.row(-0.01, LAW)
            for k in range(1, count + 1):
                residual, _ = contact.update(np.tile([0.3 * k / count, 0], 4))
                contact.commit()
            self.assertAlmostEqual(np.abs(residual[::2].sum() / residual[1::2].sum()), 0.3, 12)

    def test_friction_of_points_that_enter_contact(self):
        """A slider slides over a rigid wave, and points enter its spots (0.2 long) in every increment: mean T / N over whole periods does not depend on
        the step. It is mu times the mean over the penetrated points of the foot's way over the point's, 1 / (1 - curvature depth)."""
        mu, amplitude, length, height = 0.3, 0.02, 0.5, 0.013
        w, s, x = 2 * np.pi / length, np.linspace(0, 0.25, 4001), np.linspace(0, 0.25, 4001)
        x = x[amplitude * np.sin(w * x) > height]
        s = x.copy()
        for _ in range(30):  # Newton's method for the closest point
            f, f1, f2 = amplitude * np.sin(w * s), amplitude * w * np.cos(w * s), -amplitude * w ** 2 * np.sin(w * s)
            s -= (s - x + (f - height) * f1) / (1 + f1 ** 2 + (f - height) * f2)
        depth, cosine = np.hypot(s - x, f - height), 1 / np.sqrt(1 + f1 ** 2)
        wanted = mu * (depth * cosine / (1 + f2 * cosine ** 3 * depth)).sum() / (depth * cosine).sum()
        self.assertAlmostEqual(wanted, 0.305, 3)
        law = {"normal": {"type": "penalty", "stiffness": 1e4}, "friction": {"type": "coulomb", "coefficient": mu, "stiffness": 1e5}}
        slider = np.c_[np.linspace(2, 0, 201), np.zeros(201)]
        for step in (0.1, 0.05, 0.02, 0.01):  # 1 / 2 to 1 / 20 of a spot
            contact = ents.Contact({"segment": "line2", "master": "rigid", "contact": law, "height": {"type": "sine", "amplitude": amplitude,
                                    "wave_vector": [1 / length]}}, slider, chain(np.arange(201)), [[0, 1]], master_positions=[[-3, 0], [6, 0]],
                                   surface_coordinates="x")
            forces = np.zeros(2)
            for k in range(int(round(1.5 / step)) + 1):
                residual, _ = contact.update(np.tile([k * step, height], 201), tangent=False)
                contact.commit()
                forces += residual.reshape(-1, 2).sum(axis=0) if k * step > 0.5 - 1e-9 else 0
            self.assertAlmostEqual(forces[0] / -forces[1], wanted, delta=1e-3 * wanted)  # 40 points a spot

    def test_multipliers_go_along_to_other_segments(self):
        """Augmented friction on one segment and on four: the same forces, after Uzawa's steps on the next segment and back on the first one."""
        law = {"normal": {"type": "augmented", "stiffness": 300.0}, "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 200.0}}
        x, forces = np.array([[0.9, -0.01], [0.4, -0.01]]), []
        for cuts in (1, 4):
            line = np.c_[np.linspace(0, 4, cuts + 1), np.zeros(cuts + 1)]
            contact = ents.Contact({"segment": "line2", "master": "rigid", "contact": law}, x, [[0, 1]], chain(np.arange(cuts + 1)), master_positions=line, reach=0.5)
            forces.append([])
            contact.update(np.zeros(4))
            contact.commit()
            for way in (0.2, -0.03, 0.004, 1.2, 0.1):
                forces[-1].append(contact.update(np.tile([way, -0.002], 2))[0])
                contact.augment()
            contact.commit()
            forces[-1].append(contact.update(np.tile([0.1, -0.002], 2))[0])
        self.assertGreater(np.abs(forces[0]).max(), 1)
        np.testing.assert_allclose(forces[1], forces[0], rtol=0, atol=1e-12)

    def test_nothing_passes_unseen(self):
        """Load control: a gap of 0.01, weak springs and a unit load, the default reach. Cut and solved, the force is 1."""
        x, contact = self.row(0.01)
        weak, force, u, load, step = sparse.identity(8) * 0.025, np.tile([0, -0.25], 4), np.zeros(8), 0.0, 1.0
        cuts = 0
        while load < 1 - 1e-12:
            step = min(step, 1 - load)
            trial = u
            try:
                for _ in range(30):
                    residual, tangent = contact.update(trial)
                    r = weak @ trial + residual - (load + step) * force
                    if np.abs(r).max() < 1e-12:
                        break
                    trial = trial - spsolve((weak + tangent).tocsc(), r)
            except ents.CutStep as cut:
                self.assertTrue(0 < cut.step_factor < 1)
                cuts, step = cuts + 1, step * cut.step_factor
                continue
            contact.commit()
            u, load = trial, load + step
        self.assertGreater(cuts, 0)
        self.assertAlmostEqual(-contact.residual[1::2].sum(), 1, delta=0.025 * 4 * 0.02)

    def test_points_and_masters_that_jump(self):
        x, contact = self.row(0.01)
        for u in (-1.0, -50.0):
            with self.assertRaisesRegex(ents.CutStep, "passes through the master|times reach") as caught:
                contact.update(np.tile([0, u], 4))
            self.assertLess(caught.exception.step_factor, 0.51)
        contact.update(np.tile([0, 1.0], 4))  # away
        contact.commit()
        contact.move([[-9, 2.0], [9, 2.0]])
        with self.assertRaisesRegex(ents.CutStep, "passes through the master"):
            contact.update(np.tile([0, 1.0], 4))
        contact.move([[-9, 0.0], [9, 0.0]])
        for u in ([6, 1.0], [12, 1.0], [12, -1.0]):  # beside the end of the master, then below it
            contact.update(np.tile(u, 4))
            contact.commit()
        self.assertEqual(contact.pressure.max(), 0)

    def test_a_point_that_begins_too_deep(self):
        for y in (-0.5, -50.0):
            x, contact = self.row(y)
            with self.assertWarnsRegex(UserWarning, f"slave point 0 begins {-y:.6g} behind the master, more than reach = 0.2"):
                contact.update(np.zeros(8))

    def test_iterates_of_a_step_that_is_cut(self):
        """They leave no trace: the next step has the bits that it has without them."""
        contact, fresh = new(), new()
        for c in (contact, fresh):
            c.update(moved(0))
            c.commit()
        contact.update(moved(0.3))
        with self.assertRaises(ents.CutStep):
            contact.update(np.full(X.size, np.nan))
        np.testing.assert_array_equal(contact.update(moved(0.01))[0], fresh.update(moved(0.01))[0])


class LineSearch(unittest.TestCase):
    def test_energy_has_the_residual_as_its_derivative(self):
        contact = new({"segment": "line2", "height": {"type": "sine", "amplitude": 0.003, "wave_vector": [0.5]}, "contact": PENALTY})
        self.assertEqual(contact.energy, 0.0)
        u = 1e-3 * np.random.default_rng(1).normal(size=X.size)
        residual, _ = contact.update(u)
        self.assertGreater(contact.energy, 0.01)
        for k in range(0, X.size, 3):
            ends = []
            for sign in (1, -1):
                contact.update(u + sign * 1e-6 * np.eye(X.size)[k], tangent=False)
                ends.append(contact.energy)
            self.assertAlmostEqual(residual[k], (ends[0] - ends[1]) / 2e-6, delta=1e-7 * np.abs(residual).max())

    def test_residual_alone(self):
        contact = new()
        residual, tangent = contact.update(moved(0.001), tangent=False)
        self.assertIsNone(tangent)
        np.testing.assert_array_equal(residual, new().update(moved(0.001))[0])

    def iterate(self, search):
        """A block of E = 1 on a rigid line, friction stiffness 10 E / l, pressed by 4 % and moved by a fifth of an element in one step."""
        x, cells, n = block((0, 0), (1, 0.5), (4, 4))
        K, free = stiffness(x, cells), np.arange(2 * n[-1, 0])  # all but its top
        law = {"normal": {"type": "penalty", "stiffness": 400.0}, "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 40.0}}
        contact = ents.Contact({"segment": "line2", "master": "rigid", "contact": law}, x, chain(n[0, ::-1]), [[0, 1]], master_positions=[[-3, 0], [3, 0]], reach=0.3)
        contact.update(np.zeros(x.size))
        contact.commit()
        u, norms = np.zeros(x.size), []
        u.reshape(-1, 2)[n[-1]] = [0.05, -0.02]
        for iteration in range(40):
            residual, tangent = contact.update(u)
            r = (K @ u + residual)[free]
            norms.append(np.linalg.norm(r))
            if iteration and norms[-1] < 1e-12:
                break
            du, factor = np.zeros(x.size), 1.0
            du[free] = -spsolve((K + tangent)[free][:, free].tocsc(), r)
            while search and factor > 1e-3 and not np.linalg.norm(
                    (K @ (u + factor * du) + contact.update(u + factor * du, tangent=False)[0])[free]) < (1 - 1e-4 * factor) * norms[-1]:
                factor /= 2
            u = u + factor * du
        return contact, norms

    def test_backtracking_ends_where_plain_newton_alternates(self):
        _, norms = self.iterate(search=False)
        self.assertEqual(len(norms), 40)
        self.assertGreater(norms[-1], 1e-3)
        self.assertAlmostEqual(norms[-1], norms[-3], delta=1e-9)  # slip one way, slip the other way
        contact, norms = self.iterate(search=True)
        self.assertLess(len(norms), 8)
        force = contact.residual.reshape(-1, 2).sum(axis=0)
        self.assertAlmostEqual(force[0], -0.3 * force[1], 12)  # all of it slips


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
