"""contact_test.py FOLDER-OF-ents: ents.Contact. The library is the one of the environment's ENTS_LIBRARY. Exit status 3: no NumPy or SciPy here."""
import sys
import unittest

sys.dont_write_bytecode = True
try:
    import numpy as np
    import scipy.sparse as sparse
except ModuleNotFoundError as error:
    print(f"contact_test.py: {error} (Debian: python3-numpy, python3-scipy)")
    sys.exit(3)
sys.path.insert(0, sys.argv[1])
import ents  # noqa: E402

PENALTY = {"normal": {"type": "penalty", "stiffness": 800.0}}
FRICTION = {**PENALTY, "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 700.0}}
WAVE = {"type": "sine", "amplitude": 0.02, "wave_vector": [0.7]}
WAVES = {"type": "sine", "amplitude": 0.02, "wave_vector": [0.5, 0.3]}


def strips(rng, cells=5):
    """Two rows of nodes, the slave's above the master's, in no regular order: positions, slave facets, master facets."""
    order = rng.permutation(2 * cells + 1)
    x = np.zeros((2 * cells + 1, 2))
    master, slave = order[:cells + 1], order[cells + 1:]
    x[master] = np.column_stack([np.linspace(0, 5, cells + 1), 0.05 * rng.uniform(-1, 1, cells + 1)])
    x[slave] = np.column_stack([np.linspace(0.6, 4.4, cells), rng.uniform(-0.08, 0.0, cells)])
    return x, np.column_stack([slave[1:], slave[:-1]]), np.column_stack([master[:-1], master[1:]])


def sheets(rng):
    """The same in space: 3 x 3 master facets of four nodes, 2 x 2 slave facets."""
    def grid(n, low, high, z):
        a = np.linspace(low, high, n)
        x = np.stack([*np.meshgrid(a, a), np.zeros((n, n))], -1).reshape(-1, 3)
        x[:, 2] = rng.uniform(*z, n * n)
        k = np.arange(n * n).reshape(n, n)
        return x, np.stack([k[:-1, :-1], k[:-1, 1:], k[1:, 1:], k[1:, :-1]], -1).reshape(-1, 4)
    master, facets = grid(4, 0, 3, (-0.02, 0.02))
    slave, upper = grid(3, 0.4, 2.5, (-0.04, 0.0))
    return np.vstack([master, slave]), len(master) + upper[:, ::-1], facets


CASES = {  # name: mesh, model, options
    "plain": (strips, {"segment": "line2", "contact": PENALTY}, {}),
    "wave over the length": (strips, {"segment": "line2", "height": WAVE, "contact": PENALTY}, {"surface_coordinates": "x"}),
    "friction": (strips, {"segment": "line2", "height": WAVE, "contact": FRICTION}, {"surface_coordinates": "x"}),
    "offset": (strips, {"segment": "line2", "height": WAVE, "contact": {**FRICTION, "offset": 0}}, {"surface_coordinates": "x", "offset": -0.02}),
    "smoothed": (strips, {"segment": "bspline4", "height": WAVE, "contact": FRICTION}, {"surface_coordinates": "x", "ends": ents.ENDS_REPEATED}),
    "points inside facets": (strips, {"segment": "catmull_rom4", "contact": PENALTY}, {"sampling": 3}),
    "waves": (sheets, {"segment": "quad4", "height": WAVES, "contact": FRICTION}, {"surface_coordinates": "xy"}),
    "smoothed, points": (sheets, {"segment": "bspline16", "height": WAVES, "contact": PENALTY}, {"surface_coordinates": "xy", "sampling": 2}),
}


class Bonds(unittest.TestCase):
    def test_what_opens_in_the_first_increment_is_held(self):
        positions = np.array([[0.0, 0], [1, 0], [0.1, 0], [0.9, 0]])
        model = {"segment": "line2", "contact": {"normal": {"type": "tied", "stiffness": 100.0, "range": 1e-6}}}
        contact = ents.Contact(model, positions, [[3, 2]], [[0, 1]], reach=1.0)
        for gap in (0.1, 0.2):
            u = np.zeros((4, 2))
            u[2:, 1] = gap
            residual, _ = contact.update(u)
            np.testing.assert_allclose(residual.reshape(-1, 2)[:, 1], 100 * gap * 0.4 * np.array([-1, -1, 1, 1]), atol=1e-13)
            contact.commit()


class Offsets(unittest.TestCase):
    def test_a_coating_and_a_clearance(self):
        positions = np.array([[-1.0, 0], [2, 0], [0, 0.01], [0.5, 0.01], [1, -0.05]])
        model = {"segment": "line2", "contact": {**PENALTY, "offset": 0}}
        contact = ents.Contact(model, positions, [[3, 2], [4, 3]], [[0, 1]], offset=[-0.03, 0.0, 0.02], reach=0.2)
        contact.update(np.zeros(10))
        np.testing.assert_allclose(contact.pressure, [800 * 0.02, 0, 800 * 0.03], atol=1e-10)
        np.testing.assert_allclose(contact.gap, [0.01, 0.01, -0.05], atol=1e-14)
        with self.assertRaisesRegex(ents.Error, 'write "offset": 0'):
            ents.Contact({"segment": "line2", "contact": PENALTY}, positions, [[3, 2], [4, 3]], [[0, 1]], offset=0.1).update(np.zeros(10))


class RigidBodies(unittest.TestCase):
    def test_assembly_is_the_sum_of_the_elements_and_a_turn_ends_where_it_began(self):
        rng = np.random.default_rng(8)
        model = ents.Model({"segment": "quad4", "master": "rigid", "height": WAVES, "contact": PENALTY})
        master = np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
        tree = ents.Tree(model, [[0, 1, 2, 3]], master)
        pose = ents.Pose(3, point=[0.3, -0.2, 1.0])
        pose.move(translation=[0.1, 0, 0], spin=[0.4, -0.7, 1.1])
        body = np.column_stack([rng.uniform(-0.8, 0.8, (6, 2)), rng.uniform(-0.06, 0.0, 6)])
        space = pose.point + pose.to_space(body)
        np.testing.assert_allclose(pose.to_body(space), body, atol=1e-14)
        rows = 6 * 3 + 6
        system = ents.System(np.arange(18).reshape(6, 3), None, sparse.csr_matrix(np.ones((rows, rows))), pose=pose, body_equations=np.arange(18, 24))
        system.matrix.data[:] = 0
        found = tree.detect(body, 0.5)
        model.assemble(system, body, tree, found["segment"], start=found["xi"], area=1.0)
        single = model.evaluate(body, master, "residual tangent", start=found["xi"])
        residual, tangent = np.zeros(rows), np.zeros((rows, rows))
        for k in range(6):
            r, t = pose.element(body[k], single["residual"][k], single["tangent"][k])
            own = np.r_[3 * k:3 * k + 3, 18:24]
            residual[own] += r
            tangent[np.ix_(own, own)] += t
        self.assertGreater(np.abs(residual).max(), 1)
        np.testing.assert_allclose(system.residual, residual, atol=1e-11)
        np.testing.assert_allclose(system.matrix.toarray(), tangent, atol=1e-10)
        np.testing.assert_allclose(residual[18:21], -residual[:18].reshape(6, 3).sum(0), atol=1e-11)
        before = pose.turn
        for _ in range(64):
            pose.move(spin=[0, 0, 2 * np.pi / 64])
        np.testing.assert_allclose(pose.turn, before, atol=1e-13)
        with self.assertRaisesRegex(ents.Error, "body_equations: wanted are 6"):
            model.assemble(ents.System(np.arange(18).reshape(6, 3), None, rows=rows, pose=pose), body, tree, found["segment"], start=found["xi"], area=1.0)


class Derivatives(unittest.TestCase):
    def test_tangent_balance_and_history(self):
        """In random positions, after a committed step, and with some dofs that are no unknowns: the tangent is the derivative of the residual; forces
        and moments of all nodes balance."""
        for seed, (name, (mesh, model, options)) in enumerate(CASES.items()):
            with self.subTest(name):
                rng = np.random.default_rng(seed)
                x, slave, master = mesh(rng)
                d = x.shape[1]
                contact = ents.Contact({**model, "border": 0.2}, x, slave, master, reach=0.3, **options)
                u = 1e-3 * rng.uniform(-1, 1, x.size)
                contact.update(u)
                contact.commit()
                u += 2e-3 * rng.uniform(-1, 1, x.size)
                residual, tangent = contact.update(u)
                self.assertIsInstance(tangent, sparse.csr_matrix)
                self.assertGreater(np.count_nonzero(contact.pressure > 0), 1)
                size, h = np.abs(residual).max(), 1e-6
                forces, now = residual.reshape(-1, d), x + u.reshape(-1, d)
                self.assertLess(np.abs(forces.sum(axis=0)).max(), 1e-12 * size)
                moments = np.cross(now, forces).sum(axis=0)
                self.assertLess(np.abs(moments).max(), 1e-11 * size)
                dense = tangent.toarray()
                for k in rng.choice(x.size, min(x.size, 12), replace=False):
                    step = h * np.eye(x.size)[k]
                    ends = [contact.update(u + sign * step)[0] for sign in (1, -1)]
                    # h^2 and rounding over h are both below 1e-8 of K.
                    np.testing.assert_allclose(dense[:, k], (ends[0] - ends[1]) / (2 * h), rtol=0, atol=1e-6 * np.abs(dense).max())

                some = np.arange(x.size).reshape(-1, d)
                some[::3, 0] = -1
                some[some >= 0] = np.arange(np.count_nonzero(some >= 0))
                fewer = ents.Contact({**model, "border": 0.2}, x, slave, master, reach=0.3, dofs=some, **options)
                whole = ents.Contact({**model, "border": 0.2}, x, slave, master, reach=0.3, **options)
                r, k = fewer.update(u.reshape(-1, d))
                r_all, k_all = whole.update(u)
                kept = np.flatnonzero(some.ravel() >= 0)
                np.testing.assert_allclose(r, r_all[kept], rtol=0, atol=1e-13 * size)
                np.testing.assert_allclose(k.toarray(), k_all.toarray()[np.ix_(kept, kept)], rtol=0, atol=1e-13 * np.abs(dense).max())


class History(unittest.TestCase):
    def slide(self, segments, sampling=0):
        """Three nodes in a row, on springs, are drawn over a rigid wave of 6 lengths: forces of every step."""
        x = np.column_stack([[0.5, 0.8, 1.1], [0.1] * 3])
        line = np.column_stack([np.linspace(0, 6, segments + 1), np.zeros(segments + 1)])
        chain = np.column_stack([np.arange(segments), np.arange(1, segments + 1)])
        contact = ents.Contact({"segment": "line2", "master": "rigid", "height": WAVE, "contact": FRICTION, "penetration_limit": 1}, x, [[1, 0], [2, 1]],
                               chain, master_positions=line, surface_coordinates="x", sampling=sampling, reach=0.5)
        u, forces, seen = np.zeros(6), [], set()
        for step in range(1, 41):
            for iteration in range(30):
                residual, tangent = contact.update(u)
                r = residual + 50 * (u - np.tile([0.1 * step, -0.2], 3))
                if np.abs(r).max() < 1e-11:
                    break
                u = u - np.linalg.solve(tangent.toarray() + 50 * np.eye(6), r)
            self.assertLess(iteration, 29)
            contact.commit()
            seen.update(contact.segment.tolist())
            forces.append(residual.reshape(-1, 2).sum(axis=0))
            on = contact.pressure > 0
            sliding = np.abs(np.linalg.norm(contact.traction[on], axis=1) - 0.3 * contact.pressure[on])
            self.assertLess(sliding[contact.flags[on] & ents.Flag.SLIP > 0].max(initial=0), 1e-10 * contact.pressure.max())
        return np.array(forces), seen

    def test_segments_do_not_matter(self):
        for sampling in (0, 2):
            one, _ = self.slide(1, sampling)
            self.assertGreater(np.abs(one[:, 0]).max(), 0.1 * np.abs(one[:, 1]).max())
            many, seen = self.slide(37, sampling)
            self.assertGreater(len(seen), 20)
            np.testing.assert_allclose(many, one, rtol=0, atol=1e-9 * np.abs(one).max())

    def test_update_without_commit_leaves_no_trace(self):
        x, slave, master = strips(np.random.default_rng(3))
        fresh, used = (ents.Contact(CASES["friction"][1], x, slave, master, surface_coordinates="x", reach=0.3) for _ in range(2))
        u = np.zeros(x.size)
        for contact in (fresh, used):
            contact.update(u)
            contact.commit()
        rng = np.random.default_rng(4)
        for _ in range(5):
            used.update(u + 0.01 * rng.uniform(-1, 1, x.size))
        u = 0.001 * rng.uniform(-1, 1, x.size)
        used.update(u), fresh.update(u)
        # The projection starts elsewhere: roundings.
        np.testing.assert_allclose(used.residual, fresh.residual, rtol=0, atol=1e-11 * np.abs(fresh.residual).max())

    def test_an_open_point_is_searched_anew(self):
        """It has moved over other flanks of a deep wave on one segment: the gaps are those of a search that knows no place before."""
        text = {"segment": "line2", "master": "rigid", "contact": PENALTY, "height": {"type": "sine", "amplitude": 0.3, "wave_vector": [1.0]}}
        x = np.column_stack([np.linspace(1, 3, 9), np.full(9, 0.9)])
        chain = np.column_stack([np.arange(1, 9), np.arange(8)])
        used, fresh = (ents.Contact(text, x, chain, [[0, 1]], master_positions=[[0, 0], [6, 0]], surface_coordinates="x") for _ in range(2))
        used.update(np.zeros(x.size))
        u = np.tile([1.3, -0.2], 9)
        used.update(u), fresh.update(u)
        np.testing.assert_allclose(used.gap, fresh.gap, rtol=0, atol=1e-12)

    def test_uzawa_ends_without_penetration(self):
        text = {"segment": "line2", "master": "rigid", "contact": {"normal": {"type": "augmented", "stiffness": 300.0}}}
        x = np.array([[0.2, 0.0], [0.5, 0.0], [0.8, 0.0]])
        contact = ents.Contact(text, x, [[1, 0], [2, 1]], [[0, 1]], master_positions=[[0, 0], [1, 0]])
        u, load, gaps = np.zeros(6), np.tile([0, 5.0], 3), []
        for _ in range(12):
            for _ in range(10):
                residual, tangent = contact.update(u)
                r = residual + 100 * u + load
                if np.abs(r).max() < 1e-12:
                    break
                u = u - np.linalg.solve(tangent.toarray() + 100 * np.eye(6), r)
            gaps.append(-contact.gap.min())
            contact.augment()
        # The error of Uzawa's iteration falls by the factor k / (k + stiffness area) = 100 / (100 + 45) or faster: 0.69^11 = 0.017.
        self.assertGreater(gaps[0], 0)
        self.assertLess(gaps[-1], 0.02 * gaps[0])

    def test_commit_after_a_step_that_is_cut(self):
        x, slave, master = strips(np.random.default_rng(5))
        contact = ents.Contact({**CASES["friction"][1], "penetration_limit": 0.2}, x, slave, master, surface_coordinates="x", reach=2)
        u = np.zeros(x.size)
        before, _ = contact.update(u)
        contact.commit()
        deep = np.zeros((len(x), 2))
        deep[np.unique(slave), 1] = -0.5
        with self.assertRaises(ents.CutStep) as caught:
            contact.update(deep.ravel())
        self.assertEqual(caught.exception.status, ents.Status.DEEP_PENETRATION)
        self.assertTrue(0 < caught.exception.step_factor < 1)
        self.assertIn(caught.exception.element, range(5))
        np.testing.assert_array_equal(contact.update(u)[0], before)


    def test_deeper_than_reach_is_not_open(self):
        text = {"segment": "line2", "master": "rigid", "contact": PENALTY, "penetration_limit": 5}
        x = np.array([[0.2, -0.01], [0.8, -0.01]])
        contact = ents.Contact(text, x, [[1, 0]], [[0, 1]], master_positions=[[0, 0], [1, 0]], reach=0.1)
        contact.update(np.zeros(4))
        self.assertGreater(contact.pressure.min(), 0)
        with self.assertRaises(ents.CutStep) as caught:
            contact.update(np.array([0, -0.4, 0, -0.5]))
        self.assertEqual((caught.exception.status, caught.exception.element), (ents.Status.DEEP_PENETRATION, 1))
        self.assertIn("reach", str(caught.exception))
        self.assertAlmostEqual(caught.exception.step_factor, 0.1 / 0.51)
        contact.update(np.array([0, 0.4, 0, 0.5]))  # it may open
        self.assertEqual(contact.pressure.max(), 0)

    def test_a_point_that_leaves_the_master_is_not_open(self):
        text = {"segment": "line2", "master": "rigid", "contact": PENALTY}
        x = np.array([[0.2, -0.01], [0.8, -0.01]])
        contact = ents.Contact(text, x, [[1, 0]], [[0, 1]], master_positions=[[0, 0], [1, 0]], reach=0.1)
        before, _ = contact.update(np.zeros(4))
        contact.commit()
        for _ in range(2):  # it is said each time
            with self.assertRaises(ents.CutStep) as caught:
                contact.update(np.array([0.5, 0, 0.5, 0]))
            self.assertEqual((caught.exception.status, caught.exception.element), (ents.Status.NO_PROJECTION, 1))
            self.assertIn("beside all segments", str(caught.exception))
        np.testing.assert_array_equal(contact.update(np.zeros(4))[0], before)
        contact.update(np.array([0, 0, 0, 0.2]))
        with self.assertRaises(ents.CutStep):  # iterates that are open in between are no path
            contact.update(np.array([0, 0, 0.5, 0]))
        contact.update(np.array([0, 0, 0, 0.2]))
        contact.commit()
        contact.update(np.array([0, 0, 0.5, 0]))  # open at the begin of the increment: it may leave
        self.assertEqual(contact.pressure[1], 0)
        # The same without a Contact: an exception, unless the caller looks at the flags.
        tree, slave = contact.tree, x + [0.5, 0]
        arguments = {"segment": [0, 0], "xi": [[0.0], [0.9]]}
        with self.assertRaises(ents.CutStep) as caught:
            tree.detect(slave, 0.1, **arguments)
        self.assertEqual(caught.exception.element, 1)
        found = tree.detect(slave, 0.1, **arguments, permitted=ents.Flag.LEFT)
        self.assertEqual(found["segment"].tolist(), [0, -1])
        self.assertEqual(found["flags"][1] & ents.Flag.LEFT, ents.Flag.LEFT)


class Forces(unittest.TestCase):
    def test_pressure_times_area(self):
        """A flat surface, 0.01 deep in a flat master: force = stiffness x depth x length x thickness, on nodes and on points."""
        x = np.column_stack([[0.1, 0.3, 0.4, 0.9], [-0.01] * 4])
        for sampling in (0, 1, 4):
            contact = ents.Contact({"segment": "line2", "master": "rigid", "contact": PENALTY}, x, [[1, 0], [2, 1], [3, 2]], [[0, 1]],
                                   master_positions=[[0, 0], [1, 0]], thickness=2.5, sampling=sampling)
            residual, _ = contact.update(np.zeros(8))
            self.assertAlmostEqual(-residual[1::2].sum(), 800 * 0.01 * 0.8 * 2.5, delta=1e-13)
            self.assertAlmostEqual(contact.pressure @ contact.areas, 800 * 0.01 * 0.8 * 2.5, delta=1e-13)
            # A constant pressure: half of each facet's share to each of its nodes.
            np.testing.assert_allclose(-residual[1::2], 20 * np.array([0.1, 0.15, 0.3, 0.25]), rtol=0, atol=1e-13)

    def test_traction_is_that_on_the_master(self):
        """A row in contact slides to the right and drags the master along: traction to the right, and that much on the slave to the left."""
        law = {**PENALTY, "friction": {"type": "coulomb", "coefficient": 0.25, "stiffness": 1e3}}
        contact = ents.Contact({"segment": "line2", "master": "rigid", "contact": law}, [[0.8, -0.01], [0.2, -0.01]], [[0, 1]], [[0, 1]],
                               master_positions=[[-1, 0], [2, 0]])
        residual, _ = contact.update(np.tile([0.1, 0.0], 2))
        np.testing.assert_allclose(contact.pressure, 8, rtol=1e-12)
        np.testing.assert_allclose(contact.traction, [[2, 0]] * 2, rtol=1e-12, atol=1e-12)
        np.testing.assert_allclose(residual[::2], 2 * contact.areas, rtol=1e-12)  # internal force: the load that holds the slave points to the right

    def test_elements_of_two_processes_add_up(self):
        rng = np.random.default_rng(7)
        x, slave, master = strips(rng)
        mine = np.array([True, False, True, True, False])
        whole, one, other = (ents.Contact(CASES["friction"][1], x, slave, master, surface_coordinates="x", reach=0.3, elements=elements)
                             for elements in (None, mine, ~mine))
        for u in (np.zeros(x.size), 1e-3 * rng.uniform(-1, 1, x.size)):
            (r, k), (r1, k1), (r2, k2) = (contact.update(u) for contact in (whole, one, other))
            self.assertTrue(np.abs(r1).max() > 0 and np.abs(r2).max() > 0)
            np.testing.assert_allclose(r1 + r2, r, rtol=0, atol=1e-13 * np.abs(r).max())
            np.testing.assert_allclose((k1 + k2).toarray(), k.toarray(), rtol=0, atol=1e-13 * np.abs(k).max())
            for contact in (whole, one, other):
                contact.commit()


class Mistakes(unittest.TestCase):
    def test_messages(self):
        x, slave, master = strips(np.random.default_rng(0))
        text = {"segment": "line2", "contact": PENALTY}
        rigid = {**text, "master": "rigid"}
        free = ents.Contact(text, x, slave, master)
        for words, call in (
                ("master_positions", lambda: ents.Contact(text, x, slave, [[0, 1]], master_positions=[[0, 0], [1, 0]])),
                ("the master facets are line2", lambda: ents.Contact({"segment": "line3", "contact": PENALTY}, x, slave, master)),
                ("facets of 4 nodes in 2D", lambda: ents.Contact(text, x, [[0, 1, 2, 3]], master)),
                ("node 99 does not exist", lambda: ents.Contact(text, x, [[0, 99]], master)),
                ("node -1 does not exist", lambda: ents.Contact(text, x, [[0, -1]], master)),
                ("wanted are 1 of x, y", lambda: ents.Contact(text, x, slave, master, surface_coordinates="z")),
                ('leave out "patch"', lambda: ents.Contact({**text, "patch": [[0, 1], [1, 2]]}, x, slave, master)),
                ('write the normal law "augmented"', lambda: ents.Contact(
                    {"segment": "line2", "contact": {"normal": {"type": "augmented_multiplier", "stiffness": 1}}}, x, slave, master)),
                ("multipliers as unknowns", lambda: ents.Contact({"segment": "line2", "contact": {"normal": {"type": "multiplier", "stiffness": 1}}}, x, slave, master)),
                ("it moves with u", lambda: free.move(x)),
                ("update(u) comes first", lambda: free.commit()),
                ("not \"augmented\"", lambda: free.augment()),
                ("u: the shape", lambda: free.update(np.zeros(3))),
                ("slave[0, 0] is 0.5", lambda: ents.Contact(text, x, [[0.5, 1]], master)),
                ("master_positions: the shape", lambda: ents.Contact(rigid, x, slave, [[0, 1]], master_positions=[[0, 0], [1, 0]]).move([[0, 0]]))):
            with self.assertRaises(ents.Error) as caught:
                call()
            self.assertIn(words, str(caught.exception))

    def test_behind_a_concave_edge(self):
        """A slave node in the wedge behind the edge of a valley is not open: the step is cut."""
        x = np.array([[-1, 0.5], [0, 0], [1, 0.5], [-0.1, -0.25], [0.0, -0.3]])
        contact = ents.Contact({"segment": "line2", "contact": PENALTY}, x, [[4, 3]], [[0, 1], [1, 2]])
        with self.assertRaises(ents.CutStep) as caught:
            contact.update(np.zeros(10))
        self.assertIn("concave edge", str(caught.exception))


class Picture(unittest.TestCase):
    def test_plot(self):
        try:
            import matplotlib
        except ModuleNotFoundError:
            self.skipTest("no matplotlib here (Debian: python3-matplotlib)")
        matplotlib.use("Agg")
        for name in ("wave over the length", "waves"):
            mesh, model, options = CASES[name]
            x, slave, master = mesh(np.random.default_rng(1))
            contact = ents.Contact(model, x, slave, master, **options)
            contact.update(np.zeros(x.size))
            axes = contact.plot()
            axes.figure.canvas.draw()
            self.assertEqual(axes.get_xlabel(), "x")
            self.assertTrue(axes.lines or axes.collections)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
