"""contact_wear_test.py FOLDER-OF-ents: ents.Contact whose surfaces wear, on both sides. Exit status 3: no NumPy or SciPy here."""
import copy
import os
import pickle
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
try:
    import numpy as np
    import scipy  # noqa: F401
    from bodies import chain, newton, two_blocks
except ModuleNotFoundError as error:
    print(f"contact_wear_test.py: {error} (Debian: python3-numpy, python3-scipy)")
    sys.exit(3)
sys.path.insert(0, sys.argv[1])
import ents  # noqa: E402

STIFFNESS, COEFFICIENT = 200.0, 2e-3


def worn(cells, size=1.0, boundary="clamped"):
    return {"type": "field", "name": "worn", "points": [cells + (boundary == "clamped")], "boundary": boundary, "size": [size]}


def height(cells, amplitude=0.0, phase=0.0, waves=1):
    """A field of `cells` cells and a wave beneath it."""
    field = worn(cells)
    return field if not amplitude else {"type": "sum", "of": [{"type": "sine", "amplitude": amplitude, "wave_vector": [waves], "phase": phase}, field]}


def wearing(master, share, **more):
    return {"segment": "line2", "parameters": {"slid": 0.0}, "height": master, "contact": {
        "normal": {"type": "penalty", "stiffness": STIFFNESS}, "wear": {"coefficient": COEFFICIENT, "slave": share, "sliding": "slid", **more}}}


def bound(text):
    """An ents.Model with fields of zero."""
    model = ents.Model(text)
    model.bind({name: model.field_init(name) for name in model._field_points})
    return model


def slide(model, by):
    model.bind(model.fields, slid=by)


def sample(model, x):
    return model.field_sample("worn", model.fields["worn"], np.asarray(x)[:, None])


class States(unittest.TestCase):
    def test_open_points_keep_what_has_been_worn_off(self):
        wear = {"normal": {"type": "penalty", "stiffness": 800}, "wear": {"coefficient": 1e-3, "sliding": "slid"}}
        contact = ents.Contact({"segment": "line2", "master": "rigid", "parameters": {"slid": 5.0}, "contact": wear}, [[0.2, 0.0], [0.8, 0.0]], [[1, 0]],
                               [[0, 1]], master_positions=[[0, 0], [1, 0]], reach=0.5)
        for y in (-0.01, 0.1, 5.0, 0.1, -0.02):  # closed, open, nowhere, open, closed
            before = contact.state[:, contact.model.layout.worn].copy()
            contact.update(np.tile([0.0, y], 2))
            contact.commit()
            worn = contact.state[:, contact.model.layout.worn]
            if y > 0:
                np.testing.assert_array_equal(worn, before)
                self.assertGreater(worn.min(), 0)
            else:  # p = k (y + worn) / (1 + k 5e-3), worn off: 5e-3 p
                np.testing.assert_allclose(worn, before + 5e-3 * 800 * (-y - before) / (1 + 4), rtol=1e-12)

    def test_the_first_configuration_wears_nothing(self):
        wear = {"normal": {"type": "penalty", "stiffness": 800}, "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 700}, "wear": {"coefficient": 1e-3, "sliding": "slid"}}
        contact = ents.Contact({"segment": "line2", "master": "rigid", "parameters": {"slid": 5.0}, "contact": wear}, [[0.2, -0.01], [0.8, -0.01]], [[1, 0]],
                               [[0, 1]], master_positions=[[0, 0], [1, 0]], reach=0.5)
        contact.update(np.zeros(4))
        np.testing.assert_allclose(contact.state[:, contact.model.layout.worn], 5e-3 * 800 * 0.01 / (1 + 4), rtol=1e-12)


class Uniform(unittest.TestCase):
    """Facets that are pressed into each other by a given depth, and slide: both lose their share of k p s."""

    def contact(self, share, slave_height=True, cells=4, thickness=1.0):
        x = np.vstack([np.column_stack([np.linspace(0, 1, n), np.zeros(n)]) for n in (4, cells + 1)])
        options = {"slave_height": height(cells), "slave_surface_coordinates": "x"} if slave_height else {"sampling": 2}
        model = bound(wearing(height(cells), share))
        return model, ents.Contact(model, x, chain(np.arange(cells + 5)[:3:-1]), chain(np.arange(4)), surface_coordinates="x", reach=0.3, thickness=thickness, **options), x

    def press(self, contact, x, depth):
        u = np.zeros(x.shape)
        u[4:, 1] = -depth
        contact.update(u.ravel())
        contact.commit()
        return contact.pressure

    def test_shares_of_k_p_s(self):
        """With p of each increment: exactly, as the points integrate cubics, and volumes add up; the next increment sees both heights."""
        for share in (0.0, 0.3, 1.0):
            model, contact, x = self.contact(share)
            depth, lost, volumes = 0.01, 0.0, np.zeros(2)
            for by in (0.5, 0.25, 1.0):
                slide(model, by)
                p = self.press(contact, x, depth)
                expected = STIFFNESS * (depth - lost) / (1 + COEFFICIENT * by * STIFFNESS)
                np.testing.assert_allclose(p, expected, rtol=1e-13)
                lost += COEFFICIENT * expected * by
                volumes += contact.collect_wear()
                for part, surface in ((share, contact.slave_surface), (1 - share, model)):
                    np.testing.assert_allclose(sample(surface, np.linspace(0, 1, 23)), -part * lost, rtol=1e-12, atol=1e-18)
                depth += 0.003
            np.testing.assert_allclose(volumes, [share * lost, (1 - share) * lost], rtol=1e-13, atol=1e-18)
            self.assertAlmostEqual(volumes.sum() / lost, 1.0, 13)
            print(f"share {share}: depths {-sample(contact.slave_surface, [0.4])[0]:.12e} {-sample(model, [0.4])[0]:.12e} of k p s = {lost:.12e}")

    def test_axisymmetric(self):
        """Areas are those of the full turn, and so are the volumes."""
        model, contact, x = self.contact(0.3, thickness=0.0)
        slide(model, 0.5)
        lost = COEFFICIENT * 0.5 * self.press(contact, x, 0.01)[0]
        np.testing.assert_allclose(contact.collect_wear(), [0.3 * np.pi * lost, 0.7 * np.pi * lost], rtol=1e-13)
        for part, surface in ((0.3, contact.slave_surface), (0.7, model)):
            np.testing.assert_allclose(sample(surface, np.linspace(0, 1, 23)), -part * lost, rtol=1e-12)

    def test_without_a_field_the_state_keeps_the_depth(self):
        """Flat sides: the same pressures, for the depth opens the gap along the same normal."""
        pressures = []
        for rough in (True, False):
            model, contact, x = self.contact(0.4, rough)
            found = []
            for by in (0.5, 0.25):
                slide(model, by)
                found.append(self.press(contact, x, 0.01).copy())
                ours, theirs = contact.collect_wear()
                self.assertEqual(ours > 0, rough)
                self.assertGreater(theirs, 0)
            pressures.append(found)
        np.testing.assert_allclose(*pressures, rtol=1e-13)

    def test_share_0_is_what_the_master_alone_does(self):
        """To the bit: the library's call by hand, for the master's states."""
        model, contact, x = self.contact(0.0)
        slide(model, 0.5)
        self.press(contact, x, 0.01)
        block, before = model.fields["worn"].copy(), contact.slave_surface.fields["worn"].copy()
        volume = model.wear_collect("worn", block, contact.state.copy(), contact.points, tree=contact.tree, segment=contact.segment, area=contact.areas)
        self.assertEqual(contact.collect_wear(), (0.0, volume))
        self.assertEqual(model.fields["worn"].tobytes(), block.tobytes())
        after = contact.slave_surface.fields["worn"]
        self.assertEqual(after[4:].tobytes(), before[4:].tobytes())
        residual = contact.update(np.zeros(contact.rows), tangent=False)[0]
        model, plain, x = self.contact(0.0)
        model.bind({"worn": block}, slid=0.5)
        plain.state = contact.state
        plain.tree.move(plain.tree.positions)
        self.assertEqual(residual.tobytes(), plain.update(np.zeros(contact.rows), tangent=False)[0].tobytes())

    def test_copies_and_files_go_on_with_the_same_bits(self):
        model, contact, x = self.contact(0.3)
        slide(model, 0.5)
        self.press(contact, x, 0.01)
        early = copy.deepcopy(contact)  # between commit and collect_wear
        first = contact.collect_wear()
        self.assertEqual(early.collect_wear(), first)
        later = pickle.loads(pickle.dumps(contact))
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "history.npz")
            contact.save(file)
            again = self.contact(0.3)[1]
            again.load(file)
        again.model.bind(again.model.fields, slid=0.5)
        u = np.zeros(x.shape)
        u[4:, 1] = -0.012
        bits = contact.update(u.ravel(), tangent=False)[0].tobytes()
        for name, other in (("copied before", early), ("pickled", later), ("loaded", again)):
            self.assertEqual(other.update(u.ravel(), tangent=False)[0].tobytes(), bits, name)
        self.assertNotEqual(self.contact(0.3)[1].update(u.ravel(), tangent=False)[0].tobytes(), bits)

    def test_what_lies_between_two_increments(self):
        """A step that was cut changes nothing of what is collected; the tree knows the new heights, and the increment begins with the points on them."""
        found = []
        for cut in (False, True):
            model, contact, x = self.contact(0.3)
            slide(model, 0.5)
            self.press(contact, x, 0.01)
            if cut:
                u = np.zeros(x.shape)
                u[:4, 0], u[4:, 1] = x[:4, 0], -0.5  # a master twice as long, and a slave far below it
                with self.assertRaises(ents.CutStep):
                    contact.update(u.ravel())
            contact.collect_wear()
            self.assertTrue((contact.tree.detect(contact.points, 0.3)["segment"] >= 0).all())
            found.append((model.fields["worn"].tobytes(), contact.slave_surface.fields["worn"].tobytes()))
            begin = contact._points_begin
            u = np.zeros(x.shape)
            u[4:, 1] = -0.01
            contact.update(u.ravel())
            self.assertEqual(begin.tobytes(), contact.points.tobytes())
        self.assertEqual(*found)

    def test_tangent(self):
        """The wear of the increment is part of the element: with worn heights on both sides the tangent stays exact."""
        x = np.vstack([np.column_stack([np.linspace(-0.1, 1.1, 5), np.zeros(5)]), np.column_stack([np.linspace(0, 1, 6), np.zeros(6)])])
        rng = np.random.default_rng(3)
        x += rng.uniform(-0.01, 0.01, x.shape)
        model = bound(wearing(height(8, 0.01), 0.3))
        contact = ents.Contact(model, x, chain(np.arange(5, 11)[::-1]), chain(np.arange(5)), surface_coordinates="x", reach=0.3,
                               slave_height=height(8, 0.015, 1.0), slave_surface_coordinates="x")
        slide(model, 0.5)
        u = rng.uniform(-2e-3, 2e-3, contact.rows)
        for k in range(2):
            contact.update(u - 2e-3 * (np.arange(contact.rows) > 10))
            contact.commit()
            self.assertGreater(min(contact.collect_wear()), 0)
        v, t = rng.uniform(-1, 1, contact.rows), 1e-5
        residual, tangent = contact.update(u)
        self.assertGreater((contact.pressure > 0).sum(), 2)
        ahead = [contact.update(u + k * t * v, tangent=False)[0] for k in (-2, -1, 1, 2)]
        slope = (8 * (ahead[2] - ahead[1]) - (ahead[3] - ahead[0])) / (12 * t)
        self.assertLess(np.abs(slope - tangent @ v).max(), 1e-9 * np.abs(tangent).max())
        self.assertLess(np.abs(residual.reshape(-1, 2).sum(axis=0)).max(), 1e-14)

    def test_refusals(self):
        model, contact, x = self.contact(0.3)
        plain = ents.Contact(ents.Model(wearing(None, 0.3)), x, chain(np.arange(9)[:3:-1]), chain(np.arange(4)), sampling=2, reach=0.3)
        dry = ents.Contact({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 1}}}, x, chain(np.arange(9)[:3:-1]), chain(np.arange(4)))
        u = np.zeros(x.shape)
        for words, call in (("does not wear", dry.collect_wear), ("could take it", plain.collect_wear), ("commit() come first", contact.collect_wear),
                            ("no height of its own", lambda: plain.collect_wear(slave="worn")), ('slave="won", but slave_height has worn', lambda: contact.collect_wear(slave="won")),
                            ('master="won", but the model has worn', lambda: contact.collect_wear(master="won"))):
            with self.assertRaises(ents.Error) as caught:
                call()
            self.assertIn(words, str(caught.exception))
        u[4:, 1] = -0.01
        slide(model, 0.5)
        self.press(contact, x, 0.01)
        contact.update(u.ravel())
        with self.assertRaisesRegex(ents.Error, "commit"):
            contact.collect_wear()
        contact.commit()
        frozen = model.fields["worn"].copy()
        frozen.setflags(write=False)
        model.bind({"worn": frozen}, slid=0.5)
        with self.assertRaisesRegex(ents.Error, "cannot be written to"):
            contact.collect_wear()
        self.assertEqual(np.abs(contact.slave_surface.fields["worn"][4:]).max(), 0)


class Waves(unittest.TestCase):
    """Two elastic blocks with waves on both sides, pressed and worn."""

    def run_in(self, n, lower, upper, share, swapped=False, scale=0.01):
        """Amplitudes of the lower and the upper side, in `scale`. Returns both fields at 16 places, the force, and the volumes of (lower, upper)."""
        lower, upper = scale * lower, scale * upper
        x, k, below, above = two_blocks((n, n // 2), (n + n // 4, n // 2), young=(1.0, 1.0), gap=lower + upper)
        sides, waves = [chain(below[-1]), chain(above[0][::-1])], [lower, upper]
        if swapped:
            sides, waves = sides[::-1], waves[::-1]
        model = bound(wearing(height(8, waves[0], np.pi / 2), 1 - share if swapped else share))
        contact = ents.Contact(model, x, sides[1], sides[0], sampling=4, surface_coordinates="x", reach=0.05,
                               slave_height=height(8, waves[1], np.pi / 2), slave_surface_coordinates="x")
        held = np.zeros(x.shape, bool)
        held[below[0]] = held[above[-1]] = held[np.abs(x[:, 0] - 0.5) > 0.5 - 1e-9, 0] = True
        u, volumes = np.zeros(x.shape), np.zeros(2)
        for step in range(6):
            slide(model, 0.0 if step < 3 else 20.0)
            u[above[-1], 1] = -0.004 * scale * min(step + 1, 3)
            u = newton(contact, k, u.ravel(), np.flatnonzero(~held.ravel()))[0].reshape(x.shape)
            contact.commit()
            volumes += contact.collect_wear()
        force = (k @ u.ravel()).reshape(x.shape)[above[-1], 1].sum()
        self.assertTrue(0.3 < (contact.pressure > 0).mean() < 1)
        places = (np.arange(16) + 0.5) / 16
        fields = [sample(contact.slave_surface, places), sample(model, places)]
        return (fields if swapped else fields[::-1]), force, (volumes if swapped else volumes[::-1])

    def test_sides_swapped(self):
        """Share 1 with swapped sides is share 0: equal within the discretisation. Depth, volume and force differ by 1.3e-3, 1.4e-3, 1.4e-3 with 8 cells,
        1.8e-4, 1.4e-4, 2.2e-4 with 16, 5.7e-5, 3.9e-5, 4.8e-5 with 32: second order, down to the slope of the waves (below)."""
        apart = []
        for n in (8, 16, 32):
            (one, force, volume), (other, force_2, volume_2) = (self.run_in(n, 0.004, 0.003, 0.0, swapped) for swapped in (False, True))
            self.assertEqual(np.abs(one[1]).max(), 0.0)  # the upper side loses nothing
            self.assertEqual(np.abs(other[1]).max(), 0.0)
            self.assertGreater(np.abs(one[0]).max(), 1e-6)
            apart.append([np.linalg.norm(one[0] - other[0]) / np.linalg.norm(one[0]), abs(volume[0] / volume_2[0] - 1), abs(force / force_2 - 1)])
            print(f"{n} cells: swapped sides differ by depth {apart[-1][0]:.2e}, volume {apart[-1][1]:.2e}, force {apart[-1][2]:.2e}")
        self.assertLess(max(apart[0]), 2e-3)
        for coarse, fine in zip(apart, apart[1:]):
            for quantity in range(3):
                self.assertLess(fine[quantity], coarse[quantity] / 3)

    def test_the_composite_wears(self):
        """Both sides rough, each with its share: the sum of the heights is that of one side with the composite sine that wears alone. They differ by what a
        theory of small slopes leaves out: in proportion to the slope 0.044 scale, 8.3e-4 of the depth at 1, 9.2e-5 at 0.1, 9.3e-6 at 0.01."""
        for scale, bound_of_depth in ((1.0, 1e-3), (0.1, 1.5e-4), (0.01, 1.5e-5)):
            (lower, upper), force, volume = self.run_in(16, 0.004, 0.003, 0.3, scale=scale)
            (one, _), force_1, volume_1 = self.run_in(16, 0.007, 0.0, 0.0, scale=scale)
            found = np.linalg.norm(lower + upper - one) / np.linalg.norm(one), abs(force / force_1 - 1), abs(volume.sum() / volume_1.sum() - 1)
            print(f"slope {0.044 * scale:.0e}: composite and one-sided differ by depth {found[0]:.2e}, force {found[1]:.2e}, volume {found[2]:.2e}; "
                  f"share of the slave {volume[1] / volume.sum():.12f}")
            self.assertLess(max(found), bound_of_depth)
            self.assertLess(abs(volume[1] / volume.sum() - 0.3), 1e-10)
            np.testing.assert_allclose(upper / 0.3, lower / 0.7, atol=2e-2 * np.abs(lower).max())  # the same places are worn on both sides


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
