"""contact_surfaces_test.py FOLDER-OF-ents: which surfaces ents.Contact takes, and which it refuses. Exit status 3: no NumPy or SciPy here."""
import sys
import unittest
import warnings

sys.dont_write_bytecode = True
try:
    import numpy as np
    import scipy  # noqa: F401
    from bodies import block, chain, mixed_sheet, newton, stiffness, two_blocks
except ModuleNotFoundError as error:
    print(f"contact_surfaces_test.py: {error} (Debian: python3-numpy, python3-scipy)")
    sys.exit(3)
sys.path.insert(0, sys.argv[1])
import ents  # noqa: E402

PENALTY = {"normal": {"type": "penalty", "stiffness": 1e3}}
LINE, QUAD = ({"segment": segment, "contact": PENALTY} for segment in ("line2", "quad4"))
PLANE = [[-1, -1, 0], [3, -1, 0], [3, 3, 0], [-1, 3, 0]]


def rough_pair(**options):
    """Facets of 3 x 3 quadrilaterals over 4 x 4, both bent at random and rough, in touch. Returns the contact and a generator of random numbers."""
    rng = np.random.default_rng(1)

    def grid(n, low, high):
        x = np.linspace(low, high, n + 1)
        nodes = np.array([[a, b, 0] for b in x for a in x])
        return nodes, np.array([[j * (n + 1) + i, j * (n + 1) + i + 1, (j + 1) * (n + 1) + i + 1, (j + 1) * (n + 1) + i] for j in range(n) for i in range(n)])
    (below, master), (above, slave) = grid(4, -0.1, 1.1), grid(3, 0.0, 1.0)
    x = np.vstack([below, above])
    x += rng.uniform(-1, 1, x.shape) * [0.02, 0.02, 0.01]
    model = {"segment": "quad4", "height": {"type": "sine", "amplitude": 0.02, "wave_vector": [2, 1]},
             "contact": {"normal": {"type": "penalty", "stiffness": 100}, "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 50}}}
    return ents.Contact(model, x, slave[:, ::-1] + len(below), master, reach=0.3, surface_coordinates="xy", **options), rng


class BothSidesRough(unittest.TestCase):
    WAVE = {"type": "sine", "amplitude": 0.03, "wave_vector": [1, 2]}

    def test_tangent_and_balance(self):
        """Friction included. The stencil's error is 1e-20 times a fifth derivative, its rounding 1e-16 / 1e-5."""
        contact, rng = rough_pair(slave_height=self.WAVE, slave_surface_coordinates="xy")
        self.assertEqual(len(contact.areas), 36)  # sampling 2
        u = np.zeros(contact.rows)
        contact.update(u)
        contact.commit()
        u, v, t = rng.uniform(-1e-3, 1e-3, contact.rows), rng.uniform(-1, 1, contact.rows), 1e-5
        residual, tangent = contact.update(u)
        self.assertGreater((contact.pressure > 0).sum(), 10)
        ahead = [contact.update(u + k * t * v, tangent=False)[0] for k in (-2, -1, 1, 2)]
        slope = (8 * (ahead[2] - ahead[1]) - (ahead[3] - ahead[0])) / (12 * t)
        self.assertLess(np.abs(slope - tangent @ v).max(), 1e-10 * np.abs(tangent).max())
        self.assertLess(np.abs(residual.reshape(-1, 3).sum(axis=0)).max(), 1e-14)

    def test_places(self):
        """Heights are added along the normals of the facets; a constant one is an offset of both the place and the gap."""
        flat, raised = (rough_pair(sampling=3, **options)[0] for options in ({}, {"slave_height": {"type": "constant", "value": 0.01}}))
        for contact in (flat, raised):
            contact.update(np.zeros(contact.rows))
        np.testing.assert_allclose(np.linalg.norm(raised.points - flat.points, axis=1), 0.01, atol=1e-15)
        self.assertTrue((raised.points[:, 2] < flat.points[:, 2]).all())

    def force(self, n, swapped):
        """Two blocks of n and 5 n / 4 cells, two rough sides, pressed by 0.004 beyond touch."""
        heights = [{"type": "sine", "amplitude": 0.004, "wave_vector": [2], "phase": 0.6}, {"type": "sine", "amplitude": 0.003, "wave_vector": [3], "phase": -0.3}]
        x, k, below, above = two_blocks((n, n // 2), (n + n // 4, n // 2), young=(1.0, 2.0), gap=0.007)
        sides = [chain(below[-1]), chain(above[0][::-1])]
        if swapped:
            heights, sides = heights[::-1], sides[::-1]
        model = {"segment": "line2", "height": heights[0], "contact": {"normal": {"type": "penalty", "stiffness": 300}}}
        contact = ents.Contact(model, x, sides[1], sides[0], sampling=4, surface_coordinates="x", slave_height=heights[1], slave_surface_coordinates="x", reach=0.05)
        held = np.zeros(x.shape, bool)
        held[below[0]] = held[above[-1]] = held[np.abs(x[:, 0] - 0.5) > 0.5 - 1e-9, 0] = True
        u = np.zeros(x.shape)
        for depth in np.arange(1, 12) * 1e-3:
            u[above[-1], 1] = -depth
            u = newton(contact, k, u.ravel(), np.flatnonzero(~held.ravel()))[0].reshape(x.shape)
            contact.commit()
        return (k @ u.ravel()).reshape(x.shape)[above[-1], 1].sum()

    def test_sides_swapped(self):
        """Equal within the discretisation, of second order: 9.4e-3 with 8 cells, 1.9e-3 with 16, 4.0e-4 with 32."""
        apart = [abs(self.force(n, False) / self.force(n, True) - 1) for n in (8, 16)]
        print("sides swapped, 8 and 16 cells:", *(f"{a:.1e}" for a in apart))
        self.assertLess(apart[0], 0.012)
        self.assertLess(apart[1], apart[0] / 3.5)

    def test_refusals(self):
        for words, options in (("sampling: 0", {"sampling": 0}), ('"x"; wanted are 2 of x, y, z', {"slave_surface_coordinates": "x"}),
                               ("in 2D, the model is in 3D", {"slave_height": ents.Model({"segment": "line2"})}),
                               ("slave_height is not", {"slave_height": None, "slave_surface_coordinates": "xy"})):
            with self.assertRaises(ents.Error) as caught:
                rough_pair(**{"slave_height": self.WAVE, **options})
            self.assertIn(words, str(caught.exception))


class Refused(unittest.TestCase):
    def caught(self, words, call, kind=ents.Error):
        with self.assertRaises(kind) as caught:
            call()
        for word in words if isinstance(words, list) else [words]:
            self.assertIn(word, str(caught.exception))
        return caught.exception

    def test_facets_of_which_some_are_on_both_sides(self):
        x = np.column_stack([np.arange(5.0), np.zeros(5)])
        both = chain(np.arange(5))
        error = self.caught(["1 of the facets are master facets", "with itself", "all of them", "slave facet 2"], lambda: ents.Contact(LINE, x, both[:3], both[2:, ::-1]))
        self.assertEqual(error.element, 2)

    def test_bodies_that_are_joined_in_a_node_have_no_contact_there(self):
        """A crack: its faces share the tip."""
        x = np.array([[0.0, 0], [1, 0], [2, 0], [0, -0.01], [1, -0.01]])
        contact = ents.Contact(LINE, x, [[4, 3], [2, 4]], [[0, 1], [1, 2]])
        contact.update(np.zeros(10))
        self.assertEqual(contact.nodes.tolist(), [2, 3, 4])
        np.testing.assert_allclose(contact.pressure, [0, 10, 10])
        self.assertTrue(np.isnan(contact.gap[0]))

    def test_corners_in_rows(self):
        """Quadrilaterals in tensor order: refused with both orders, taken with order="tensor". Force: stiffness 1000, depth 0.01, area 1."""
        a = np.linspace(0, 1, 4)
        x = np.vstack([np.c_[np.stack(np.meshgrid(a, a, indexing="ij"), -1).reshape(-1, 2), np.full(16, -0.01)], PLANE])
        i = np.arange(16).reshape(4, 4)
        tensor = np.stack([i[:-1, :-1], i[:-1, 1:], i[1:, :-1], i[1:, 1:]], -1).reshape(-1, 4)
        for facets in (tensor, np.vstack([tensor[:8][:, [0, 1, 3, 2]], tensor[8:]])):
            for sampling in (0, 2):
                self.caught([f"facet {0 if facets is tensor else 8}", 'order="tensor"', f"[{facets[-1][0]}," if facets is not tensor else "[0, 1, 5, 4]"],
                            lambda: ents.Contact(QUAD, x, facets, [[16, 17, 18, 19]], sampling=sampling))
        for options in ({"order": "tensor"}, {"order": "tensor", "sampling": 2}):
            contact = ents.Contact(QUAD, x, tensor, [[16, 17, 19, 18]], **options)
            residual, _ = contact.update(np.zeros(60))
            self.assertAlmostEqual(residual.reshape(-1, 3)[:16, 2].sum(), -10, delta=1e-12)
        self.caught('there are "ring" and "tensor"', lambda: ents.Contact(QUAD, x, tensor, [[16, 17, 18, 19]], order="rows"))

    def test_a_facet_without_area_is_named_and_spoils_nothing(self):
        x = np.vstack([np.c_[np.linspace(2.5, 0.5, 5), np.full(5, -0.01)], [[1.5, -0.01]], np.c_[np.linspace(0, 3, 4), np.zeros(4)]])
        slave, master = chain(np.arange(5)), chain(np.arange(6, 10))
        self.caught("facet 4 is [0, 0]: it names a node twice", lambda: ents.Contact(LINE, x, np.vstack([slave, [[0, 0]]]), master))
        with self.assertWarnsRegex(UserWarning, r"facet 4, \[2, 5\], has no area"):
            contact = ents.Contact(LINE, x, np.vstack([slave, [[2, 5]]]), master)
        contact.update(np.zeros(x.size))
        np.testing.assert_allclose(contact.areas, [0.25, 0.5, 0.5, 0.5, 0.25])
        np.testing.assert_allclose(contact.pressure, 10)
        self.caught("facet 3, [9, 10], has no area", lambda: ents.Contact(LINE, np.vstack([x, x[9]]), slave, np.vstack([master, [[9, 10]]])))

    def test_one_reversed_facet(self):
        x = np.vstack([np.c_[np.linspace(2.5, 0.5, 5), np.full(5, -0.01)], np.c_[np.linspace(0, 3, 4), np.zeros(4)]])
        slave, master = chain(np.arange(5)), chain(np.arange(5, 9))
        turned = master.copy()
        turned[1] = turned[1, ::-1]
        self.caught("neighbours 0 and 1 are not oriented alike", lambda: ents.Contact(LINE, x, slave, turned))
        grid = np.array([[i, j, 0.0] for j in range(3) for i in range(3)])
        facets = np.array([[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6], [4, 5, 8, 7]])
        facets[3] = facets[3, ::-1]
        high = np.vstack([grid, [[0.5, 0.5, -0.01], [0.6, 1.5, -0.01], [1.5, 0.6, -0.01]]])
        error = self.caught("not oriented alike", lambda: ents.Contact(QUAD, high, [[9, 10, 11]], facets))
        self.assertIn(error.element, (1, 2, 3))
        with self.assertWarnsRegex(UserWarning, "slave: the neighbours"):
            ents.Contact(LINE, x, np.vstack([slave[:2], slave[2:, ::-1]]), master)

    def test_a_side_in_the_wrong_order(self):
        x, K, n, m = two_blocks((4, 2), (4, 2), gap=1e-3)
        right = chain(m[0, ::-1])  # outwards is down: from right to left
        ents.Contact(LINE, x, right, chain(n[-1])).update(np.zeros(x.size))
        for slave, master in ((right[:, ::-1], chain(n[-1])), (right, chain(n[-1])[:, ::-1])):
            self.caught(["look the same way", "facets[:, ::-1]"], lambda: ents.Contact(LINE, x, slave, master).update(np.zeros(x.size)))

    def test_counts_and_shapes(self):
        x = np.vstack([np.c_[np.linspace(2.5, 0.5, 5), np.full(5, -0.01)], np.c_[np.linspace(0, 3, 4), np.zeros(4)]])
        slave, master = chain(np.arange(5)), chain(np.arange(5, 9))
        make = lambda **more: ents.Contact(LINE, x, slave, master, **more)
        self.assertEqual(make(rows=18.0).rows, 18)
        masked = np.ma.masked_greater(x, 2.9)
        for words, call in (
                ("slave: there are no facets", lambda: ents.Contact(LINE, x, [], master)),
                ("master: there are no facets", lambda: ents.Contact(LINE, x, slave, np.zeros((0, 2), int))),
                ("rows is 17.5", lambda: make(rows=17.5)),
                ("dofs: from 0 to 17; there are 10 rows", lambda: make(rows=10)),
                ("sampling is 2.5", lambda: make(sampling=2.5)),
                ("offset: the shape is (3,), wanted is (5,)", lambda: make(offset=[0, 0, 0])),
                ("reach is -1", lambda: make(reach=-1)),
                ("thickness is -1", lambda: make(thickness=-1)),
                ("slave: facets of 4 nodes in 2D", lambda: ents.Contact(LINE, x, [[0, 1], [1, 2, 3, 4]], master)),
                ("positions[8, 0] is masked", lambda: ents.Contact(LINE, masked, slave, master)),
                ("positions[0, 0] is not finite", lambda: ents.Contact(LINE, np.r_[[[np.nan, 0]], x[1:]], slave, master)),
                ("wanted are real numbers", lambda: ents.Contact(LINE, x + 1j, slave, master)),
                ("no contact law", lambda: ents.Contact({"segment": "line2"}, x, slave, master)),
                ("update(u) comes first", lambda: ents.Contact({"segment": "line2", "contact": {"normal": {"type": "augmented", "stiffness": 1}}}, x, slave,
                                                               master).augment()),
                ("plain facets need no neighbours", lambda: make(mirror=[("x", 0)]))):
            self.caught(words, call)
        self.assertTrue(np.isnan(make().gap).all())


class Shapes(unittest.TestCase):
    def test_second_order_faces_carry_a_constant_pressure(self):
        """A plane 0.01 deep in a plane: every node has its share of a pressure of 10, by default."""
        a = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
        quad8 = np.vstack([a, (a + np.roll(a, -1, axis=0)) / 2])
        tri6 = np.vstack([a[:3], (a[:3] + np.roll(a[:3], -1, axis=0)) / 2])
        for x, shares, count in ((quad8, [-1 / 12] * 4 + [1 / 3] * 4, 4), (tri6, [0] * 3 + [1 / 6] * 3, 3)):
            nodes = np.vstack([np.c_[x, np.full(len(x), -0.01)], PLANE])
            facet, master = [list(range(len(x)))[:]], [len(x) + np.arange(4)]
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                contact = ents.Contact(QUAD, nodes, facet, master)
                residual, _ = contact.update(np.zeros(nodes.size))
            self.assertEqual((contact.sampling, len(contact.areas), contact.nodes), (2, count, None))
            np.testing.assert_allclose(contact.pressure, 10, rtol=1e-12)
            np.testing.assert_allclose(residual.reshape(-1, 3)[:len(x), 2], -10 * np.array(shares), atol=1e-12)
            with self.assertRaisesRegex(ents.Error, "sampling: 0 puts the slave points on the nodes of .* write sampling=2"):
                ents.Contact(QUAD, nodes, facet, master, sampling=0)

    def test_axisymmetric(self):
        """thickness=0: a ring from r = 1 to 2, 0.01 deep in a plane. Areas and forces are of the full turn about the y axis."""
        contact = ents.Contact({**LINE, "master": "rigid"}, [[2, -0.01], [1, -0.01]], [[0, 1]], [[0, 1]],
                               master_positions=[[0.5, 0], [3, 0]], thickness=0)
        residual, _ = contact.update(np.zeros(4))
        self.assertAlmostEqual(contact.areas.sum(), 3 * np.pi, 13)
        self.assertAlmostEqual(-residual[1::2].sum(), 30 * np.pi, 12)

    def test_patch_test_over_triangles_and_quadrilaterals(self):
        """Two blocks of wedges and bricks under a uniform pressure: that pressure at all nodes, and a linear displacement, to 1e-13."""
        flat, facets = mixed_sheet()
        doubled = np.array([f if len(f) == 4 else [*f, f[2]] for f in facets])
        count, layers = len(flat), 2
        sheet = lambda z: np.c_[flat, np.full(count, z)]
        x = np.vstack([sheet(z) for z in (-1, -0.5, 0, 0, 0.5, 1)])
        cells = np.vstack([np.hstack([doubled + k * count, doubled + (k + 1) * count]) for k in (0, 1, 3, 4)])
        K = stiffness(x, cells, young=1.0, poisson=0.3)
        slave = [[3 * count + node for node in facet[::-1]] for facet in facets]
        master = [[layers * count + node for node in facet] for facet in facets]
        pressure, eps = 0.01, 10.0
        for facets_of_slave, facets_of_master in ((slave, master), ([*map(list, 3 * count + doubled[:, ::-1])], layers * count + doubled)):
            contact = ents.Contact({"segment": "quad4", "contact": {"normal": {"type": "penalty", "stiffness": eps}}}, x, facets_of_slave, facets_of_master)
            force = np.zeros(x.size)
            areas = contact.areas  # of the same sheet: nodes of the top have those of the slave
            force.reshape(-1, 3)[5 * count:, 2] = -pressure * areas
            fixed = np.zeros(x.shape, bool)
            fixed[:count, 2] = True  # below
            for c in (0, 1):
                fixed[np.abs(x[:, c]) < 1e-12, c] = True
            free = np.flatnonzero(~fixed.ravel())
            u, iterations = newton(contact, K, np.zeros(x.size), free, force, tolerance=1e-16)  # a gap of 0 holds the upper one
            self.assertLessEqual(iterations, 3)
            np.testing.assert_allclose(contact.pressure, pressure, rtol=1e-13)
            strain = -pressure  # of E = 1
            wanted = np.c_[-0.3 * strain * x[:, :2], np.where(np.arange(len(x)) < 3 * count, strain * (x[:, 2] + 1), strain * (x[:, 2] + 1) - pressure / eps)]
            np.testing.assert_allclose(u.reshape(-1, 3), wanted, rtol=0, atol=1e-13)

    def test_lists_of_facets_of_both_lengths(self):
        x = np.vstack([[[0, 0, -0.01], [1, 0, -0.01], [1, 1, -0.01], [0, 1, -0.01], [2, 0.5, -0.01]], PLANE])
        for sampling in (0, 1, 3):
            contact = ents.Contact(QUAD, x, [[3, 2, 1, 0], [1, 2, 4]], [[5, 6, 7], [5, 7, 8]], sampling=sampling)
            residual, _ = contact.update(np.zeros(x.size))
            self.assertAlmostEqual(contact.areas.sum(), 1.5, 13)
            np.testing.assert_allclose(contact.pressure, 10, rtol=1e-12)
            np.testing.assert_allclose(residual.reshape(-1, 3)[:5, 2], [-2.5, -2.5 - 5 / 3, -2.5 - 5 / 3, -2.5, -5 / 3], rtol=1e-12)
        with self.assertRaisesRegex(ents.Error, 'facets quad4 and tri3: write "quad4"'):
            ents.Contact({"segment": "tri3", "contact": PENALTY}, x, [[3, 2, 1, 0]], [[5, 6, 7, 8], [0, 1, 4]])


class Edges(unittest.TestCase):
    def press(self, widths, counts, **options):
        """Two rectangles that slide on side rollers where they are flush, pressed by 2 %."""
        x, K, n, m = two_blocks((counts[0], 4), (counts[1], 4), widths)
        contact = ents.Contact(LINE, x, chain(m[0, ::-1]), chain(n[-1]), **options)
        fixed = np.zeros(x.shape, bool)
        fixed[n[0], 1] = fixed[m[-1], 1] = True
        fixed[np.r_[n[:, 0], m[:, 0]], 0] = True
        fixed[np.r_[n[:, -1], m[:, -1]], 0] = widths[0] == widths[1]
        u = np.zeros(x.size)
        u.reshape(-1, 2)[m[-1], 1] = -0.02
        return contact, *newton(contact, K, u, np.flatnonzero(~fixed.ravel()))

    def test_flush_blocks_of_equal_width(self):
        contact, u, iterations = self.press(((0, 1), (0, 1)), (9, 7))
        self.assertLessEqual(iterations, 5)
        self.assertEqual(contact.model.border, 0.1)
        # side rollers: E (1 - nu) / (1 + nu) / (1 - 2 nu) strain, and the penalty in between
        modulus = 0.7 / 1.3 / 0.4
        mean = contact.pressure @ contact.areas
        self.assertAlmostEqual(mean, 0.02 / (1 / modulus + 1e-3), delta=3e-3 * mean)  # the meshes do not match

    def test_every_kind_of_model_has_the_border(self):
        x, K, n, m = two_blocks((3, 2), (3, 2), gap=-0.01)
        model = ents.Model({"segment": "line2", "parameters": {"eps": 100.0}, "contact": {"normal": {"type": "penalty", "stiffness": "eps"}}})
        model.bind(eps=200.0)
        contact = ents.Contact(model, x, chain(m[0, ::-1]), chain(n[-1]))
        self.assertEqual((contact.model.border, model.border), (0.1, None))
        for eps in (200, 300):
            contact.update(np.zeros(x.size))
            np.testing.assert_allclose(contact.pressure, eps * 0.01)
            model.bind(eps=300.0)
        self.assertEqual(ents.Contact({**LINE, "border": 0.02}, x, chain(m[0, ::-1]), chain(n[-1])).model.border, 0.02)
        self.assertEqual(ents.Contact('{"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 1}}}', x, chain(m[0, ::-1]), chain(n[-1])).model.border, 0.1)

    def test_a_narrow_block_on_a_wide_one(self):
        """Slave nodes above master nodes: none alternates between two facets, and the force is that of a block that is a little shifted."""
        shifted, _, _ = self.press(((0, 2), (0.013, 1.013)), (8, 4))
        contact, u, iterations = self.press(((0, 2), (0, 1)), (8, 4))
        self.assertLessEqual(iterations, 5)
        self.assertGreater(contact.pressure.min(), 0.02)
        forces = [c.pressure @ c.areas for c in (contact, shifted)]
        self.assertAlmostEqual(forces[0], forces[1], delta=0.015 * forces[1])

    def test_side_faces_among_the_master_facets(self):
        """All boundary facets of a block as master: the pressures are those with its top alone."""
        results = []
        for whole in (False, True):
            x, K, n, m = two_blocks((4, 4), (4, 4))
            around = np.r_[n[0, ::1], n[1:, -1], n[-1, -2::-1], n[-2::-1, 0]]
            master = chain(around)[:, ::-1] if whole else chain(n[-1])
            contact = ents.Contact(LINE, x, chain(m[0, ::-1]), master)
            fixed = np.zeros(x.shape, bool)
            fixed[n[0], 1] = fixed[m[-1], 1] = True
            fixed[n[0, 0], 0] = fixed[m[-1, 0], 0] = True
            u = np.zeros(x.size)
            u.reshape(-1, 2)[m[-1], 1] = -0.02
            newton(contact, K, u, np.flatnonzero(~fixed.ravel()))
            results.append(contact.pressure.copy())
        np.testing.assert_allclose(results[1], results[0], rtol=1e-6)

    def test_a_row_that_is_pushed_over_the_end(self):
        """N = p x overlap, to a face over 2 n with n points; without leave=True the step is cut, and the message says so."""
        cells, n, depth = 8, 4, 0.01
        x = np.c_[np.linspace(2, 0, cells + 1), np.full(cells + 1, -depth)]
        make = lambda **more: ents.Contact({**LINE, "master": "rigid", "border": 1e-7}, x, chain(np.arange(cells + 1)), [[0, 1]], master_positions=[[-1, 0], [2, 0]],
                                           sampling=n, **more)
        contact, held = make(leave=True), make()
        held.update(np.zeros(x.size))
        held.commit()
        for step in range(1, 11):
            u = np.tile([0.25 * step, 0.0], cells + 1)
            residual, _ = contact.update(u)
            contact.commit()
            overlap = max(0.0, 2 - 0.25 * step)
            self.assertLessEqual(abs(-residual[1::2].sum() - 1e3 * depth * overlap), 1e3 * depth * 0.25 / (2 * n) + 1e-12)
        with self.assertRaisesRegex(ents.CutStep, "lies beside all segments .* leave=True"):
            held.update(np.tile([0.25, 0.0], cells + 1))
        deep = make(leave=True, reach=0.1)
        deep.update(np.zeros(x.size))
        with self.assertRaisesRegex(ents.CutStep, "penetrates by 0.51, more than reach"):
            deep.update(np.tile([0.0, -0.5], cells + 1))


class Rigid(unittest.TestCase):
    def test_a_smoothed_master_that_is_rigid(self):
        x = np.c_[np.linspace(2, 1, 4), np.full(4, -0.01)]
        line = np.c_[np.arange(4.0), np.zeros(4)]
        contact = ents.Contact({"segment": "bspline4", "master": "rigid", "contact": PENALTY}, x, chain(np.arange(4)), chain(np.arange(4)), master_positions=line)
        residual, tangent = contact.update(np.zeros(8))
        np.testing.assert_allclose(contact.pressure, 10, rtol=1e-12)
        np.testing.assert_allclose(tangent.diagonal()[1::2], 1e3 * contact.areas, rtol=1e-12)


class Mirror(unittest.TestCase):
    def test_half_of_a_smoothed_surface_is_the_half_of_the_whole(self):
        """Forces and tangent of one half with its plane of symmetry are those of the whole surface, in symmetric displacements."""
        for segment, d in (("bspline4", 2), ("catmull_rom4", 2), ("bspline16", 3)):
            with self.subTest(segment):
                x, slave, master = self.surfaces(d)
                whole = ents.Contact({"segment": segment, "contact": PENALTY}, x, slave, master, sampling=2)
                right = lambda facets: facets[(x[facets][:, :, 0] > -1e-12).all(axis=1)]
                half = ents.Contact({"segment": segment, "contact": PENALTY}, x, right(slave), right(master), sampling=2, mirror=[("x", 0.0)])
                u = 0.01 * np.stack([np.sin(x[:, 0]), *np.cos(x[:, 1:].T + x[:, 0] ** 2)], axis=1)
                forces = whole.update(u)[0].reshape(-1, d)
                halves = half.update(u)[0].reshape(-1, d)
                self.assertGreater(np.abs(forces).max(), 1e-2)
                inner, on = x[:, 0] > 1e-9, np.abs(x[:, 0]) < 1e-9
                np.testing.assert_allclose(halves[inner], forces[inner], atol=1e-13)
                np.testing.assert_allclose(2 * halves[on][:, 1:], forces[on][:, 1:], atol=1e-13)
                dense, h = half.tangent.toarray(), 1e-6
                for k in np.flatnonzero(np.abs(dense).sum(axis=0))[::5]:
                    step = h * np.eye(x.size)[k]
                    ends = [half.update(u.ravel() + sign * step)[0] for sign in (1, -1)]
                    np.testing.assert_allclose(dense[:, k], (ends[0] - ends[1]) / (2 * h), rtol=0, atol=1e-6 * np.abs(dense).max())
        with self.assertRaisesRegex(ents.Error, "the plane x = 0.5 is no border of the master"):
            ents.Contact({"segment": "bspline4", "contact": PENALTY}, *self.surfaces(2), mirror=[("x", 0.5)])

    @staticmethod
    def surfaces(d):
        a, b = np.linspace(-1, 1, 9), np.linspace(-0.75, 0.75, 7)
        if d == 2:
            x = np.vstack([np.c_[a, -0.1 * a ** 2], np.c_[b, -0.1 * b ** 2 - 0.01]])
            return x, chain(9 + np.arange(7)[::-1]), chain(np.arange(9))
        x, facets = [], []
        for line, depth in ((a, 0.0), (b, 0.01)):
            y = np.linspace(-1, 1, 5) * line[-1]
            grid = np.stack(np.meshgrid(line, y), -1).reshape(-1, 2)
            k = sum(map(len, x)) + np.arange(len(grid)).reshape(len(y), len(line))
            x.append(np.c_[grid, -0.1 * (grid ** 2).sum(axis=1) - depth])
            facets.append(np.stack([k[:-1, :-1], k[:-1, 1:], k[1:, 1:], k[1:, :-1]], -1).reshape(-1, 4))
        return np.vstack(x), facets[1][:, ::-1], facets[0]


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
