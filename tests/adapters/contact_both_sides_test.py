"""contact_both_sides_test.py FOLDER-OF-ents: surfaces in contact with themselves, and two passes, in ents.Contact. The library is the one of the
environment's ENTS_LIBRARY. Exit status 3: no NumPy or SciPy here."""
import pickle
import sys
import tempfile
import unittest
from collections import Counter

sys.dont_write_bytecode = True
try:
    import numpy as np
    import scipy.sparse as sparse
    from bodies import chain, newton, stiffness, two_blocks
except ModuleNotFoundError as error:
    print(f"contact_both_sides_test.py: {error} (Debian: python3-numpy, python3-scipy)")
    sys.exit(3)
sys.path.insert(0, sys.argv[1])
import ents  # noqa: E402


def model(segment="line2", stiffness=50.0, **more):
    return {"segment": segment, "contact": {"normal": {"type": "penalty", "stiffness": stiffness}, **more}}


def strip(middle, normals, offsets):
    """Nodes, cells and numbers [layers][columns] of a strip along a line: one layer at each offset along the normals."""
    x = np.vstack([middle + offset * normals for offset in offsets])
    n = np.arange(len(x)).reshape(len(offsets), len(middle))
    cells = np.stack([n[:-1, :-1], n[:-1, 1:], n[1:, 1:], n[1:, :-1]], -1).reshape(-1, 4)
    a, b, c = x[cells[0, 0]], x[cells[0, 1]], x[cells[0, 3]]
    return x, cells if np.cross(b - a, c - a) > 0 else cells[:, ::-1], n


def skin(cells):
    """Facets of two nodes on the boundary of cells of four, the outside on the left."""
    edges = [(int(c[(i + 1) % 4]), int(c[i])) for c in cells for i in range(4)]
    count = Counter(tuple(sorted(edge)) for edge in edges)
    return np.array([edge for edge in edges if count[tuple(sorted(edge))] == 1])


def skin_of_hexahedra(cells):
    faces = [tuple(int(c[i]) for i in face) for c in cells
             for face in ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))]
    count = Counter(tuple(sorted(face)) for face in faces)
    return np.array([face for face in faces if count[tuple(sorted(face))] == 1])


def press(contact, K, shape, fixed, target, steps):
    """Displacements and forces on the supports after so many equal steps."""
    free, u = np.flatnonzero(~fixed.ravel()), np.zeros(K.shape[0])
    for step in range(1, steps + 1):
        u = u.copy()
        u[fixed.ravel()] = target[fixed] * step / steps
        u, _ = newton(contact, K, u, free)
        contact.commit()
    return u.reshape(shape), (K @ u + contact.residual).reshape(shape)


class Fold:
    """A fold of two legs and a bend, or its upper half."""

    def __init__(self, whole, closing=0.23):
        legs = np.linspace(4, 0, 21)
        bend = np.linspace(np.pi / 2, 3 * np.pi / 2 if whole else np.pi, 13 if whole else 7)[1:]
        normals = np.vstack([np.tile([0.0, 1.0], (21, 1)), np.column_stack([np.cos(bend), np.sin(bend)]), np.tile([0.0, -1.0], (20 if whole else 0, 1))])
        middle = np.zeros((len(normals), 2))
        middle[:21, 0] = legs
        if whole:
            middle[-20:, 0] = legs[::-1][1:]
        self.x, cells, n = strip(middle, normals, (0.2, 0.35, 0.5))
        self.K, self.skin, self.inner = stiffness(self.x, cells), skin(cells), chain(n[0])
        self.top, self.numbers = n[-1, :11], n
        self.fixed, self.target = np.zeros(self.x.shape, bool), np.zeros(self.x.shape)
        self.fixed[self.top], self.target[self.top, 1] = True, -closing
        if whole:
            self.fixed[n[-1, -11:]], self.target[n[-1, -11:], 1] = True, closing
        else:
            self.fixed[n[:, -1], 1] = True


class OneSurface(unittest.TestCase):
    def test_a_fold_without_its_plane_of_symmetry_is_the_half_on_a_plane(self):
        half, whole = Fold(False), Fold(True)
        for sampling, faces in ((2, whole.skin), (0, whole.inner)):
            plane = ents.Contact({**model(stiffness=100.0), "master": "rigid"}, half.x, half.inner[:21], [[0, 1]], master_positions=[[-1.0, 0.0], [5.0, 0.0]],
                                 reach=0.3, sampling=sampling)
            right, force = press(plane, half.K, half.x.shape, half.fixed, half.target, 20)
            contact = ents.Contact(model(), whole.x, faces, faces, sampling=sampling)
            u, forces = press(contact, whole.K, whole.x.shape, whole.fixed, whole.target, 20)
            columns = half.numbers.shape[1]
            # The normals of the legs are bent, that of the plane is not: 4e-7.
            self.assertLess(abs(forces[whole.top, 1].sum() / force[half.top, 1].sum() - 1), 1e-6)
            self.assertLess(np.abs(u[whole.numbers[:, :columns]] - right[half.numbers]).max(), 1e-6)
            self.assertLess(np.abs(u[whole.numbers] - u[whole.numbers[:, ::-1]] * [1, -1]).max(), 1e-12)
            self.assertLess(np.abs(contact.residual.reshape(-1, 2).sum(axis=0)).max(), 1e-13)
            self.assertGreater((contact.pressure > 0).sum(), 20)

    def test_waves_meet_their_mirror_images(self):
        """The fold is rough inside: its points lie on the height of the model. The half has waves, too, on a smooth plane: its forces have other
        directions by the slope."""
        half, whole = Fold(False), Fold(True)
        for amplitude, number in ((0.005, 1.5), (0.01, 3.0)):
            waves, slope = {"type": "sine", "amplitude": amplitude, "wave_vector": [number]}, amplitude * number
            plane = ents.Contact({**model(stiffness=100.0), "master": "rigid"}, half.x, half.inner[:21], [[0, 1]], master_positions=[[-1.0, 0.0], [5.0, 0.0]],
                                 reach=0.3, sampling=4, slave_height=waves, slave_surface_coordinates="x")
            right, force = press(plane, half.K, half.x.shape, half.fixed, half.target, 20)
            contact = ents.Contact({**model(), "height": waves}, whole.x, whole.skin, whole.skin, sampling=4, surface_coordinates="x")
            u, forces = press(contact, whole.K, whole.x.shape, whole.fixed, whole.target, 20)
            self.assertEqual((contact.pressure > 0).sum(), 2 * (plane.pressure > 0).sum())
            self.assertLess(abs(forces[whole.top, 1].sum() / force[half.top, 1].sum() - 1), slope ** 2)
            self.assertLess(np.abs(u[whole.numbers] - u[whole.numbers[:, ::-1]] * [1, -1]).max(), 1e-12)
            self.assertLess(np.abs(contact.residual.reshape(-1, 2).sum(axis=0)).max(), 1e-13)
            e = np.random.default_rng(1).normal(size=u.size) * 1e-7
            change = contact.update(u.ravel() + e)[0] - contact.update(u.ravel() - e)[0]
            _, tangent = contact.update(u.ravel())
            self.assertLess(np.abs(change - 2 * (tangent @ e)).max(), 1e-8 * np.abs(tangent @ e).max())

    def test_a_strip_like_a_c_closed_on_itself(self):
        """A ring with a slit: its ends are pressed on each other. The upper half, on a plane, is the same."""
        slit = 0.03

        def ring(whole):
            angle = np.linspace(slit, (2 if whole else 1) * np.pi - (slit if whole else 0), 61 if whole else 31)
            normals = np.column_stack([np.cos(angle), np.sin(angle)])
            x, cells, n = strip(np.zeros((len(angle), 2)), normals, np.linspace(0.8, 1.0, 4))
            x[n[:, 0], 1] = 0.8 * slit  # ends that are parallel
            if whole:
                x[n[:, -1], 1] = -0.8 * slit
            fixed, target = np.zeros(x.shape, bool), np.zeros(x.shape)
            for column, sign in ((15, -1), (45, 1)) if whole else ((15, -1),):
                fixed[n[-1, column]], target[n[-1, column], 1] = True, sign * 0.06
            if not whole:
                fixed[n[:, -1], 1] = True
            return x, cells, n, fixed, target
        x, cells, n, fixed, target = ring(False)
        K = stiffness(x, cells)
        plane = ents.Contact({**model(stiffness=40.0), "master": "rigid"}, x, chain(n[::-1, 0]), [[1, 0]], master_positions=[[2.0, 0.0], [0.0, 0.0]],
                             reach=0.1, sampling=2)
        right, force = press(plane, K, x.shape, fixed, target, 4)
        whole, cells, m, fixed, target = ring(True)
        faces = skin(cells)
        contact = ents.Contact(model(stiffness=20.0), whole, faces, faces)
        u, forces = press(contact, stiffness(whole, cells), whole.shape, fixed, target, 4)
        self.assertGreater((plane.pressure > 0).sum(), 0)
        # The ends turn by 0.07, and their normals with them, that of the plane does not: 0.07^2 / 2 of the overlap, which is 1 % of what closes the slit.
        self.assertLess(abs(forces[m[-1, 15], 1] / force[n[-1, 15], 1] - 1), 1e-4)
        self.assertLess(np.abs(u[m[:, :31]] - right[n]).max(), 1e-4)

    def test_a_thin_body_does_not_touch_its_own_other_side(self):
        """A strip of one tenth, stretched until it has a quarter of its thickness, and turned: no pressure."""
        line = np.column_stack([np.linspace(0, 1, 21), np.zeros(21)])
        x, cells, _ = strip(line, np.tile([0.0, 1.0], (21, 1)), (0.0, 0.1))
        faces = skin(cells)
        contact = ents.Contact(model(), x, faces, faces, reach=0.5)
        for k in range(1, 25):
            now, turn = x * [2 ** (k / 12), 2 ** (-k / 12)], 0.2 * k
            now = now @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
            contact.update((now - x).ravel())
            self.assertEqual(contact.pressure.max(), 0.0)
            contact.commit()
        self.assertLess(np.median(contact.body_thickness), 0.03)
        # Halved within one increment: the limit that is documented. It is seen as contact, and not silent.
        contact = ents.Contact(model(), x, faces, faces, reach=0.5)
        contact.update((x * [1, 0.4] - x).ravel())
        self.assertGreater(contact.pressure.max(), 0.0)

    def test_what_passes_through_in_one_increment_cuts_the_step(self):
        fold = Fold(True)
        contact = ents.Contact(model(), fold.x, fold.skin, fold.skin)
        upper = (fold.x[:, 1] > 0) & (fold.x[:, 0] > 0)
        u = np.where(upper[:, None], [0.0, -1.0], [0.0, 1.0]) * (np.clip(fold.x[:, :1], 0, 2) / 2)
        for closing in (0.45, 0.8, 2.0, 1000.0):  # legs of 0.3, 0.4 apart
            with self.subTest(closing), self.assertRaises(ents.CutStep):
                contact.update((closing * u).ravel())
        contact.update((0.1 * u).ravel())
        contact.commit()

    def test_history(self):
        fold = Fold(True)
        law = model(friction={"type": "coulomb", "coefficient": 0.3, "stiffness": 20.0})
        contact = ents.Contact(law, fold.x, fold.skin, fold.skin)
        press(contact, fold.K, fold.x.shape, fold.fixed, fold.target, 20)
        copy = pickle.loads(pickle.dumps(contact))
        with tempfile.TemporaryDirectory() as folder:
            contact.save(folder + "/saved.npz")
            other = ents.Contact(law, fold.x, fold.skin, fold.skin)
            other.load(folder + "/saved.npz")
        u = (0.21 * np.where(fold.x[:, 1:] > 0, [0.003, -1.0], [0.0, 1.0]) * (np.clip(fold.x[:, :1], 0, 2) / 2)).ravel()
        first = contact.update(u)
        for again in (copy, other):
            found = again.update(u)
            self.assertTrue((found[0] == first[0]).all() and (found[1] != first[1]).nnz == 0)
        self.assertGreater(np.abs(contact.traction).max(), 0.0)

    def test_refusals(self):
        x = np.array([[0.0, 0], [1, 0], [2, 0], [0, 1], [1, 1]])
        faces = np.array([[0, 1], [1, 2]])
        for law, words in ((model(), "deforms"),
                           ({"segment": "line2", "contact": {"normal": {"type": "augmented", "stiffness": 5.0}}}, "over-constraint")):
            rigid = {"master": "rigid"} if words == "deforms" else {}
            with self.subTest(words), self.assertRaisesRegex(ents.Error, words):
                ents.Contact({**law, **rigid}, x, faces, faces)
        with self.assertRaisesRegex(ents.Error, "its height varies .a."):
            ents.Contact({**model(), "parameters": {"a": 0.1}, "height": {"type": "constant", "value": "a"}}, x, faces, faces)
        with self.assertRaisesRegex(ents.Error, "leave it out, or write it into the model"):
            ents.Contact(model(), x, faces, faces, slave_height={"type": "constant", "value": 0.1})
        with self.assertRaisesRegex(ents.Error, "all of them"):
            ents.Contact(model(), x, faces, faces[:1])
        contact = ents.Contact(model(), x, faces, faces)
        with self.assertRaisesRegex(ents.Error, "adds up to zero"):
            contact.resultants()


class Tubes:
    """Two tubes that cross, a gap between them."""

    def __init__(self, round_=16, along=8, gap=0.02):
        angle = np.linspace(0, 2 * np.pi, round_ + 1)[:-1]
        length = np.linspace(-1.5, 1.5, along + 1)
        points = np.array([[l, r * np.cos(a), r * np.sin(a)] for l in length for r in (0.35, 0.5) for a in angle])
        n = np.arange(len(points)).reshape(along + 1, 2, round_)
        turn = np.roll(n, -1, axis=2)
        cells = np.stack([n[:-1, 0], n[1:, 0], n[1:, 1], n[:-1, 1], turn[:-1, 0], turn[1:, 0], turn[1:, 1], turn[:-1, 1]], -1).reshape(-1, 8)
        a = points[cells[0]]
        if np.dot(np.cross(a[1] - a[0], a[3] - a[0]), a[4] - a[0]) < 0:
            cells = cells[:, [4, 5, 6, 7, 0, 1, 2, 3]]
        # The upper one along x; the lower one turned by a right angle, and by a little more so that no nodes lie above each other.
        c, s = np.cos(1.5), np.sin(1.5)
        lower = points @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) + [0.03, 0.02, -1.0 - gap]
        self.x = np.vstack([points, lower])
        self.all = skin_of_hexahedra(cells)
        outside = np.isin(self.all, n[:, 1]).all(axis=1)
        self.upper, self.lower = self.all[outside], len(points) + self.all[outside]
        self.all = np.vstack([self.all, len(points) + self.all])
        self.K = sparse.block_diag([stiffness(points, cells), stiffness(lower, cells)], "csr")
        self.fixed, self.target = np.zeros(self.x.shape, bool), np.zeros(self.x.shape)
        ends = np.abs(points[:, 0]) > 1.49
        self.fixed[:len(points)][ends] = self.fixed[len(points):][ends] = True
        self.target[:len(points), 2][ends] = -0.2


class CrossedTubes(unittest.TestCase):
    def test_all_faces_are_two_passes_over_the_outer_ones(self):
        """All faces of both tubes, inner ones and ends, against themselves: what touches are the outer faces, and each side is a slave."""
        tubes, found = Tubes(), {}
        law = model("quad4", 20.0)
        for name, contact in (("self", ents.Contact(law, tubes.x, tubes.all, tubes.all)), ("two", ents.Contact(law, tubes.x, tubes.upper, tubes.lower, sampling=2, two_pass=True)),
                              ("swapped", ents.Contact(law, tubes.x, tubes.lower, tubes.upper, sampling=2, two_pass=True)),
                              ("one", ents.Contact(law, tubes.x, tubes.upper, tubes.lower, sampling=2))):
            found[name] = press(contact, tubes.K, tubes.x.shape, tubes.fixed, tubes.target, 4)
            self.assertGreater((contact.pressure > 0).sum(), 3)
            self.assertLess(np.abs(contact.residual.reshape(-1, 3).sum(axis=0)).max(), 1e-14)
        force = {name: abs(forces[tubes.target[:, 2] < 0, 2].sum()) for name, (_, forces) in found.items()}
        size = np.abs(found["two"][0]).max()
        for name in ("self", "swapped"):
            self.assertLess(np.abs(found[name][0] - found["two"][0]).max(), 1e-12 * size)
            self.assertLess(abs(force[name] / force["two"] - 1), 1e-12)
        self.assertLess(abs(force["one"] / force["two"] - 1), 0.1)  # coarse
        print("crossed tubes: force", force)


class TwoPasses(unittest.TestCase):
    def blocks(self, lower=(8, 4), upper=(11, 4)):
        x, K, n, m = two_blocks(lower, upper)
        fixed, target = np.zeros(x.shape, bool), np.zeros(x.shape)
        fixed[n[0], 1] = fixed[m[-1], 1] = True
        fixed[np.isin(x[:, 0], (0.0, 1.0)), 0] = True
        target[m[-1], 1] = -0.01
        return x, K, chain(m[0][::-1]), chain(n[-1]), fixed, target

    def test_patch(self):
        """Pressure between two blocks, lowest and highest: see adapters/python/README.md."""
        for cells, sampling in (((8, 4), 0), ((8, 4), 2), ((11, 4), 0), ((11, 4), 8)):
            x, K, slave, master, fixed, target = self.blocks((8, 4), cells)
            row = []
            for two in (False, True):
                contact = ents.Contact(model(), x, slave, master, sampling=sampling, two_pass=two)
                press(contact, K, x.shape, fixed, target, 1)
                mean = abs(contact.residual.reshape(x.shape)[np.unique(slave), 1].sum())  # width 1
                row.append((contact.pressure.min() / mean, contact.pressure.max() / mean))
            print(f"8:{cells[0]}, {sampling} points: one pass {row[0][0]:.4f} .. {row[0][1]:.4f}, two passes {row[1][0]:.4f} .. {row[1][1]:.4f}")
            if cells == (8, 4):
                self.assertLess(np.abs(np.array(row) - 1).max(), 1e-9)
            else:
                self.assertLess(np.abs(np.array(row) - 1).max(), 0.15)

    def test_swapping_the_sides_changes_nothing(self):
        x, K, slave, master, fixed, target = self.blocks()
        rng = np.random.default_rng(1)
        law = model(friction={"type": "coulomb", "coefficient": 0.2, "stiffness": 30.0})
        u = np.zeros(x.shape)
        u[np.unique(slave), 1], u[np.unique(slave), 0] = -0.003, 0.001
        u += 1e-4 * rng.standard_normal(x.shape)
        found = []
        for sides in ((slave, master), (master, slave)):
            contact = ents.Contact(law, x, *sides, two_pass=True)
            contact.update(0.5 * u.ravel())
            contact.commit()
            residual, tangent = contact.update(u.ravel())
            found.append((residual, tangent.toarray(), sum(contact.resultants()[part] for part in ("normal", "tangential")), contact.energies))
        size = np.abs(found[0][1]).max()
        self.assertLess(np.abs(found[0][0] - found[1][0]).max(), 1e-12 * np.abs(found[0][0]).max())
        self.assertLess(np.abs(found[0][1] - found[1][1]).max(), 1e-12 * size)
        self.assertLess(np.abs(found[0][2] + found[1][2]).max(), 1e-12 * np.abs(found[0][2]).max())
        for name, energy in found[0][3].items():
            self.assertAlmostEqual(energy, found[1][3][name], delta=1e-12 * abs(energy))
        # The tangent is that of both passes, and the force on the slave's side is the one of the resultants.
        contact, h = ents.Contact(law, x, slave, master, two_pass=True), 1e-7
        contact.update(0.5 * u.ravel())
        contact.commit()
        v = rng.standard_normal(x.size) * (np.abs(found[0][0]) > 0)
        rate = (contact.update(u.ravel() + h * v)[0] - contact.update(u.ravel() - h * v)[0]) / (2 * h)
        self.assertLess(np.abs(rate - found[0][1] @ v).max(), 1e-6 * np.abs(rate).max())
        self.assertLess(np.abs(found[0][0].reshape(x.shape)[np.unique(slave)].sum(axis=0) + found[0][2][:2]).max(), 1e-14)

    def test_friction_is_that_of_one_pass(self):
        """Blocks pressed and drawn: sliding force over normal force is the coefficient."""
        x, _, n, m = two_blocks((8, 4), (11, 4), widths=((0.0, 1.0), (0.2, 0.8)))
        slave, master = chain(m[0][::-1]), chain(n[-1])
        u = np.zeros(x.shape)
        upper = np.arange(len(x)) >= slave.min()
        law = model(friction={"type": "coulomb", "coefficient": 0.2, "stiffness": 30.0})
        forces = []
        for two in (False, True):
            contact = ents.Contact(law, x, slave, master, sampling=16, two_pass=two, leave=True)
            for drawn in (0.0, 0.001, 0.04):
                u[upper] = [drawn, -0.01]
                contact.update(u.ravel())
                contact.commit()
            force = contact.residual.reshape(x.shape)[upper].sum(axis=0)
            self.assertAlmostEqual(abs(force[0] / force[1]), 0.2, delta=1e-12)
            forces.append(force)
            self.assertAlmostEqual(contact.pressure.max(), 0.5, delta=1e-12)  # 50 * 0.01, whole
        # Points of the lower side under the upper one: 16 on each of 8 facets, and the border of the upper facets, 0.05 of each.
        self.assertLess(np.abs(forces[1] / forces[0] - 1).max(), 0.02)

    def test_refusals(self):
        x, _, slave, master, _, _ = self.blocks()
        for law, words in (({**model(), "height": {"type": "constant", "value": 0.1}}, "give the same one as slave_height"),
                           ({"segment": "line2", "contact": {"normal": {"type": "augmented", "stiffness": 5.0}}}, "over-constraint"),
                           (model(wear={"coefficient": 1e-3}, friction={"type": "coulomb", "coefficient": 0.3, "stiffness": 1.0}), "wear"),
                           ({**model(), "projection": {"type": "shadow_direction", "direction": [0, 1]}}, "one ray"),
                           ({"segment": "line2", "contact": {"normal": {"type": "multiplier", "stiffness": 1.0}}}, "over-constraint")):
            with self.subTest(words), self.assertRaisesRegex(ents.Error, words):
                ents.Contact(law, x, slave, master, two_pass=True)
        with self.assertRaisesRegex(ents.Error, "deforms"):
            ents.Contact({**model(), "master": "rigid"}, x, slave, [[0, 1]], master_positions=[[0.0, 0.0], [1.0, 0.0]], two_pass=True)
        with self.assertRaisesRegex(ents.Error, "leave out comm"):
            ents.Contact(model(), x, slave, master, two_pass=True, comm=object())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
