"""python_surfaces_test.py FOLDER-OF-ents: the Python module on whole surfaces: assembly, trees, smoothing, areas, states that move. The library is the
one of the environment's ENTS_LIBRARY. Exit status 3: no NumPy here."""
import contextlib
import os
import pathlib
import re
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
try:
    import numpy as np
except ModuleNotFoundError as error:
    print(f"python_surfaces_test.py: {error} (Debian: python3-numpy)")
    sys.exit(3)
folder = sys.argv[1]
sys.path.insert(0, folder)
import ents  # noqa: E402

FRICTION = {"segment": "line2", "height": {"type": "sine", "amplitude": 0.04, "wave_vector": [1.5]},
            "contact": {"normal": {"type": "penalty", "stiffness": 1000},
                        "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 900}}}


@contextlib.contextmanager
def inside(folder):
    before = os.getcwd()
    os.chdir(folder)
    try:
        yield
    finally:
        os.chdir(before)


class Surfaces(unittest.TestCase):
    def test_blocks_are_the_derivative_of_the_residual(self):
        """On a polyline of three segments, in equations that are not in the order of the nodes; one dof is prescribed."""
        model = ents.Model({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 100}, "friction": {
            "type": "coulomb", "coefficient": 0.3, "stiffness": 90}}})
        x = np.array([[0.0, 0.0], [1, 0.1], [2, 0.05], [3, 0], [0.4, -0.05], [1.6, -0.02], [2.5, 0.6]])
        equations = np.array([5, 0, 3, 8, 1, 9, 2, 4, 6, 7, -1, 10, 11, 12]).reshape(-1, 2)
        tree = ents.Tree(model, [[0, 1], [1, 2], [2, 3]], x[:4])
        area = np.array([0.5, 0.7, 0.9])
        before = tree.detect(x[4:], reach=0.3)["segment"]
        state = model.state_init(3)
        state[:2] = model.evaluate(x[4:6], None, "state_end", tree=tree, segment=before[:2], area=area[:2], state=state[:2])["state_end"]
        x[4:6] += [[0.1, -0.02], [-0.001, -0.02]]

        def both(x):
            tree.move(x[:4])
            found = tree.detect(x[4:], reach=0.3)
            return found, *model.blocks(x[4:], tree, found["segment"], equations[4:], equations[:4], 13, area=area, state=state, want="gap flags")
        found, residual, (v, (i, j)), result = both(x)
        self.assertEqual(found["segment"].tolist(), [0, 1, -1])
        self.assertEqual(result["closed"].tolist(), [0, 1])
        self.assertTrue(result["flags"][0] & ents.Flag.SLIP and result["flags"][1] & ents.Flag.STICK)
        np.testing.assert_allclose(result["gap"], found["gap"][:2], rtol=1e-14)  # one projection starts from the other's answer
        dense = np.zeros((13, 13))
        np.add.at(dense, (i, j), v)
        h = 1e-6
        for node, c in np.ndindex(x.shape):
            if equations[node, c] >= 0:
                ends = [both(x + sign * h * np.eye(14)[2 * node + c].reshape(7, 2))[1] for sign in (1, -1)]
                # h^2 and rounding over h: both below 1e-9 of K
                np.testing.assert_allclose(dense[:, equations[node, c]], (ends[0] - ends[1]) / (2 * h), atol=1e-6 * np.abs(dense).max())
        self.assertGreater(np.abs(residual).max(), 0)
        residual, (v, _), _ = model.blocks(x[4:], tree, [-1, -1, -1], equations[4:], equations[:4], 13, area=area, state=state)
        self.assertEqual((np.abs(residual).max(), len(v)), (0, 0))

    class Rows:
        """A matrix in compressed rows, as scipy.sparse.csr_matrix has it, with a place for everything."""

        def __init__(self, n, index):
            self.indptr, self.indices = np.arange(0, n * n + 1, n, dtype=index), np.tile(np.arange(n, dtype=index), n)
            self.data = np.zeros(n * n)

        def dense(self):
            return self.data.reshape(len(self.indptr) - 1, -1)

    def test_assembly(self):
        """The library's sums are those of `blocks`, of all and open elements, in two integer types, twice into the same places."""
        model = ents.Model(FRICTION)
        x = np.array([[0.0, 0.0], [1, 0.1], [2, 0.05], [3, 0], [0.4, -0.05], [1.6, -0.02], [2.5, 0.6]])
        equations = np.array([5, 0, 3, 8, 1, 9, 2, 4, 6, 7, -1, 10, 11, 12]).reshape(-1, 2)
        tree = ents.Tree(model, [[0, 1], [1, 2], [2, 3]], x[:4])
        area, state = np.array([0.5, 0.7, 0.9]), model.state_init(3)
        segment = tree.detect(x[4:], reach=0.3)["segment"]
        state[:2] = model.evaluate(x[4:6], None, "state_end", tree=tree, segment=segment[:2], area=area[:2], state=state[:2])["state_end"]
        x[4:6] += [[0.05, -0.02], [-0.001, -0.02]]
        r, (v, (i, j)), result = model.blocks(x[4:], tree, segment, equations[4:], equations[:4], 13, area=area, state=state, want="state_end gap")
        k = np.zeros((13, 13))
        np.add.at(k, (i, j), v)
        self.assertGreater(np.abs(k - k.T).max(), 1e-3 * np.abs(k).max())
        for index in (np.int32, np.int64):
            matrix = self.Rows(13, index)
            system = ents.System(equations[4:], equations[:4], matrix)
            for repeat in (1, 2):
                whole = model.assemble(system, x[4:], tree, segment, "state_end gap", area=area, state=state)
                # sums of three numbers in another order
                np.testing.assert_allclose(system.residual, repeat * r, atol=1e-14 * np.abs(r).max())
                np.testing.assert_allclose(matrix.dense(), repeat * k, atol=1e-14 * np.abs(k).max())
            np.testing.assert_array_equal(whole["state_end"][:2], result["state_end"])
            np.testing.assert_array_equal(whole["gap"][:2], result["gap"])
        alone = ents.System(equations[4:], equations[:4], rows=13)
        model.assemble(alone, x[4:], tree, segment, area=area, state=state)
        np.testing.assert_allclose(alone.residual, r, atol=1e-14 * np.abs(r).max())
        matrix.data[:] = 0
        matrix.indices[:] = np.sort(np.tile((np.arange(13) + 1) % 12, 13).reshape(13, 13), axis=1).ravel()  # row 1 has no column 12
        with self.assertRaises(ents.Error) as caught:
            model.assemble(ents.System(equations[4:] + 2 * (equations[4:] == 10), equations[:4], matrix), x[4:], tree, segment, area=area, state=state)
        self.assertEqual(caught.exception.status, ents.Status.BAD_PATTERN)

    def test_assembly_after_a_change(self):
        """Another matrix, other equations, another tree or model: nothing goes where the entries were before."""
        x = np.array([[0.0, 0.0], [1, 0.1], [2, 0.05], [3, 0], [0.4, -0.05], [1.6, -0.02], [2.5, -0.02]])
        model = ents.Model(FIRST_2D := {"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 1000}}})
        nodes, slave = np.arange(8).reshape(-1, 2), np.arange(8, 14).reshape(-1, 2)
        tree = ents.Tree(model, [[0, 1], [1, 2], [2, 3]], x[:4])

        def place(i, j):  # of two neighbours, or of a slave and a master node
            return (i < 8) != (j < 8) or abs(i // 2 - j // 2) <= 1
        narrow = self.Rows(14, np.int32)
        kept = np.array([place(i, j) for i in range(14) for j in range(14)])
        narrow.indptr = np.concatenate([[0], np.cumsum(kept.reshape(14, 14).sum(axis=1))]).astype(np.int32)
        narrow.indices, narrow.data = narrow.indices[kept], narrow.data[kept]

        def sums(system, model=model, tree=tree):
            system.residual[:], system.matrix.data[:] = 0, 0
            result = model.assemble(system, x[4:], tree, [0, 1, 2], "flags")
            self.assertTrue((result["flags"] & ents.Flag.CONTACT).all())
            dense = np.zeros((14, 14))
            np.add.at(dense, (np.repeat(np.arange(14), np.diff(system.matrix.indptr)), system.matrix.indices), system.matrix.data)
            return system.residual.tobytes(), dense.tobytes()
        fresh = sums(ents.System(slave, nodes, self.Rows(14, np.int32)))
        system = ents.System(slave, nodes, narrow)
        self.assertEqual(sums(system), fresh)
        system.matrix = self.Rows(14, np.int32)
        self.assertEqual(sums(system), fresh, "another matrix")
        system.matrix = narrow
        self.assertEqual(sums(system), fresh, "one with fewer entries")
        system.matrix.indptr, system.matrix.indices, system.matrix.data = (getattr(self.Rows(14, np.int32), a) for a in ("indptr", "indices", "data"))
        self.assertEqual(sums(system), fresh, "other arrays in it")

        other = np.arange(6).reshape(-1, 2)[::-1], np.arange(6, 14).reshape(-1, 2)
        system.slave_equations, system.master_equations = other[0].tolist(), other[1].astype(np.int32)
        self.assertEqual(sums(system), sums(ents.System(*other, self.Rows(14, np.int32))), "other equations")
        given = slave.copy()
        system.slave_equations, system.master_equations = given, nodes
        given[:] = 1 << 40
        self.assertEqual(sums(system), fresh, "the caller's array is not the system's")
        with self.assertRaises(ValueError):
            system.slave_equations[0, 0] = 5

        back = ents.Tree(model, [[3, 2], [2, 1], [1, 0]], x[3::-1])
        self.assertNotEqual(sums(system), sums(system, tree=back))
        self.assertEqual(sums(system, tree=back), sums(ents.System(slave, nodes, self.Rows(14, np.int32)), tree=back), "another tree")
        self.assertEqual(sums(system), fresh)
        wide = ents.Model({**FIRST_2D, "segment": "catmull_rom4"})
        curved = ents.Tree(wide, [[0, 1, 2, 3], [3, 2, 1, 0], [0, 1, 2, 3]], x[:4])
        arguments = x[4:] * [0, 1] + [1.5, -0.1], curved, [0, 0, 2]
        results = []
        for used in (system, ents.System(slave, nodes, self.Rows(14, np.int32))):
            used.residual[:], used.matrix.data[:] = 0, 0
            wide.assemble(used, *arguments)
            results.append((used.residual.tobytes(), used.matrix.data.tobytes()))
            self.assertGreaterEqual(used._places.shape[1], 2 * 5 ** 2 + 1, "room for the entries of four master nodes")
        self.assertEqual(*results, "another model")

        for wrong, words in ((self.Rows(13, np.int32), "14 rows"), (self.Rows(15, np.int32), "14 rows")):
            system.matrix = wrong
            with self.assertRaises(ents.Error) as caught:
                model.assemble(system, x[4:], tree, [0, 1, 2])
            self.assertEqual(caught.exception.status, ents.Status.BAD_COUNT)
            self.assertIn(words, str(caught.exception))
        system.residual = np.zeros(14, np.float32)
        with self.assertRaises(ents.Error) as caught:
            model.assemble(system, x[4:], tree, [0, 1, 2])
        self.assertIn("residual", str(caught.exception))

    def test_assembly_of_points_and_smoothed_surfaces(self):
        """Points inside slave facets on a smoothed master: forces in balance, and the tangent is the derivative of the residual."""
        model = ents.Model({"segment": "bspline4", "height": {"type": "sine", "amplitude": 0.02, "wave_vector": [0.3]},
                            "contact": {"normal": {"type": "penalty", "stiffness": 100}}})
        master = np.array([[0.0, 0], [1, 0.1], [2, 0.05], [3, 0]])
        slave = np.array([[0.7, -0.1], [1.5, 0.0], [2.6, -0.06]])
        x = np.vstack([master, slave])
        segments, smoothed = model.library.smooth("line2", "bspline4", [[0, 1], [1, 2], [2, 3]], 4)
        inside, areas = model.library.sampling_points("line2", 3, [[0, 1], [1, 2]], slave)
        self.assertEqual(len(areas), 6)
        np.testing.assert_allclose(areas.sum(), np.linalg.norm(np.diff(slave, axis=0), axis=1).sum(), rtol=1e-14)
        equations = np.arange(14).reshape(-1, 2)
        tree = ents.Tree(model, segments, model.library.combine(smoothed, master))

        def both(x):
            tree.move(model.library.combine(smoothed, x[:4]))
            points = model.library.combine(inside, x[4:])
            matrix = self.Rows(14, np.int32)
            system = ents.System(equations[4:], equations[:4], matrix, slave=inside, master=smoothed)
            result = model.assemble(system, points, tree, tree.detect(points, reach=0.5)["segment"], "flags", area=areas)
            return system.residual, matrix.dense(), result
        r, k, result = both(x)
        self.assertTrue((result["flags"] & ents.Flag.CONTACT).all())
        np.testing.assert_allclose(r.reshape(-1, 2).sum(axis=0), 0, atol=1e-14 * np.abs(r).sum())
        h = 1e-6
        for dof in range(14):
            ends = [both(x + sign * h * np.eye(14)[dof].reshape(7, 2))[0] for sign in (1, -1)]
            np.testing.assert_allclose(k[:, dof], (ends[0] - ends[1]) / (2 * h), atol=1e-6 * np.abs(k).max())

    def test_state_transfer(self):
        """The anchor of friction goes with the place on the surface: the same slip as seen from the segment behind the node between two."""
        model = ents.Model({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 100}, "friction": {
            "type": "coulomb", "coefficient": 0.9, "stiffness": 10}}})
        tree = ents.Tree(model, [[0, 1], [1, 2]], [[0.0, 0], [1, 0], [3, 0]])
        begin = model.evaluate([[0.9, -0.1]], None, "state_end", tree=tree, segment=[0], state=model.state_init(1))["state_end"]
        status, moved = tree.state_transfer(np.vstack([begin] * 3), [0, 0, -1], [1, 0, 1])
        self.assertEqual(status, 0)
        np.testing.assert_array_equal(moved[1], begin[0])
        np.testing.assert_array_equal(moved[2], model.state_init(1)[0])
        r = model.evaluate([[1.1, -0.1]], None, "traction flags", tree=tree, segment=[1], state=moved[:1])
        self.assertTrue(r["flags"][0] & ents.Flag.STICK)
        # stiffness times the way from 0.9 to 1.1
        np.testing.assert_allclose(np.abs(r["traction"][0]), [2, 0], atol=1e-13)

    def test_check(self):
        """A height on plain facets: admissible where they lie in one plane, with a jump where they meet at an angle."""
        model = ents.Model({"segment": "line2", "height": {"type": "polynomial", "coefficients": [0.1]}})
        segments = [[0, 1], [1, 2]]
        s = np.array([[[0.0], [1]], [[1], [2]]])
        flat = ents.Tree(model, segments, [[0.0, 0], [1, 0], [2, 0]], s).check()
        self.assertTrue(flat["admissible"] and not flat["violations"].any())
        self.assertEqual((flat["height_min"], flat["height_max"]), (0.1, 0.1))
        bent = ents.Tree(model, segments, [[0.0, 0], [1, 0], [1, -1]], s).check()
        self.assertFalse(bent["admissible"])
        self.assertTrue(bent["jump"]["judged"] and bent["jump"]["violated"])
        # ends 0.1 along two normals at right angles
        np.testing.assert_allclose(bent["jump"]["value"], 0.1 * np.sqrt(2), rtol=1e-12)
        self.assertEqual({bent["jump"]["segment"], bent["jump"]["other"]}, {0, 1})
        self.assertTrue((bent["violations"] >> ents.CONDITIONS.index("jump") & 1).all())

    def test_smoothed_line(self):
        """Equidistant nodes on a line: equidistant control points, and a curve through the nodes."""
        x = np.column_stack([np.arange(4.0), np.zeros(4)])
        segments, combination = ents.library().smooth("line2", "bspline4", [[0, 1], [1, 2], [2, 3]], 4)
        points = ents.library().combine(combination, x)
        np.testing.assert_array_equal(points[segments][:, :, 0], [[-1, 0, 1, 2], [0, 1, 2, 3], [1, 2, 3, 4]])
        tree = ents.Tree(ents.Model({"segment": "bspline4"}), segments, points)
        np.testing.assert_allclose(tree.detect([[1.25, 0.1]], 1)["xi"], [[-0.5]], atol=1e-14)

    def test_contact_area(self):
        area = ents.library().contact_area("line2", [[0, 1], [1, 2]], [[0, 0], [1, 0], [3, 0]], [0, 0, 0.1], [2, 1, 0], modulus=5, thickness=2)
        self.assertEqual((area["surface"], area["counted"], area["peak_pressure"]), (6, 4, 2))
        self.assertTrue(2 < area["zero_line"] < 6)
        self.assertEqual(area["estimate"], area["zero_line"])
        with self.assertRaisesRegex(ents.Error, "'facet' must be line2, tri3 or quad4"):
            ents.library().contact_area("quad9", [[0] * 9], [[0, 0, 0]], [0], [0])

    def test_tributary_areas(self):
        areas = ents.library().tributary_areas("line2", [[0, 1], [1, 2]], [[0, 0], [1, 0], [3, 0]], thickness=2)
        np.testing.assert_allclose(areas, [1, 3, 2], rtol=1e-15)


    def test_combinations_of_other_integers(self):
        """scipy.sparse has 32-bit indices: what ents_combine reads is 64-bit all the same."""
        x = np.array([[0.0, 0], [1, 0.2], [2, -0.1], [3, 0]])
        _, (begin, of, weights) = ents.library().smooth("line2", "bspline4", [[0, 1], [1, 2], [2, 3]], 4.0)
        narrow = begin.astype(np.int32), list(of), weights.tolist()
        np.testing.assert_array_equal(ents.library().combine(narrow, x), ents.library().combine((begin, of, weights), x))

    def test_table_of_areas_as_adapters_readme_makes_it(self):
        """The block of Python in adapters/README.md, run as it stands, gives the areas of a sheet of 2 x 1 quadrilaterals."""
        readme = (pathlib.Path(__file__).resolve().parents[2] / "adapters" / "README.md").read_text()
        code, = re.findall(r"```python\n(.*?)```", readme, re.S)
        with tempfile.TemporaryDirectory() as job, inside(job):
            exec(code, {})
            table = np.loadtxt("ents_7.txt")
        np.testing.assert_array_equal(table[:, 0], [90001, 90002, 90003, 90004, 90005, 90006])
        np.testing.assert_allclose(table[:, 1], [0.25, 0.5, 0.25, 0.25, 0.5, 0.25], rtol=1e-15)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
