"""python_guards_test.py FOLDER-OF-ents: no status of the library is dropped, nothing is read or written beyond arrays, and what is hardly meant is said.
Exit status 3: no NumPy here."""
import copy
import os
import pickle
import sys
import tempfile
import unittest
import warnings

sys.dont_write_bytecode = True
try:
    import numpy as np
except ModuleNotFoundError as error:
    print(f"python_guards_test.py: {error} (Debian: python3-numpy)")
    sys.exit(3)
sys.path.insert(0, sys.argv[1])
import ents  # noqa: E402

PENALTY = {"normal": {"type": "penalty", "stiffness": 1e3}}
LINE, QUAD = np.array([[-1.0, 0], [1, 0]]), np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0.0]])
PLAIN = {"segment": "line2", "contact": PENALTY}
FLAT = [[0, 1, 2, 3], [1, 4, 5, 2]], np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [1, 0, 0], [1, 1, 0.0]])  # the second has no area


class Cases(unittest.TestCase):
    def refused(self, status, words, call, kind=ents.Error):
        with self.assertRaises(kind) as caught:
            call()
        self.assertEqual(caught.exception.status, status, str(caught.exception))
        for word in words:
            self.assertIn(word, str(caught.exception))
        return caught.exception


class Statuses(Cases):
    def test_derivatives_of_elements_that_are_refused(self):
        model = ents.Model({**PLAIN, "parameters": {"eps": 100.0}, "penetration_limit": 0.05, "contact": {"normal": {"type": "penalty", "stiffness": "eps"}}})
        good, deep = [0.1, -0.01], [0.1, -5.0]
        np.testing.assert_allclose(model.derivatives([good], LINE)["residual"][0, 0, 1], -0.01)
        for slave, k in (([good, deep], 1), ([deep, good], 0)):
            for more in ({}, {"adjoint": np.ones((2, 6))}):
                error = self.refused(ents.Status.DEEP_PENETRATION, ["penetration_limit"], lambda: model.derivatives(slave, LINE, **more), ents.CutStep)
                self.assertEqual(error.element, k)

    def test_derivatives_with_values_of_the_slave(self):
        model = ents.Model({**PLAIN, "parameters": {"eps": 100.0}, "contact": {"normal": {"type": "penalty", "stiffness": "eps"}, "offset": 0}})
        values = [-0.005, 1, 1]  # the gap is smaller by 0.005
        found = model.derivatives([[0.1, -0.01]], LINE, slave_values=values)
        residual = model.evaluate([[0.1, -0.01]], LINE, "residual", slave_values=values)["residual"][0]
        np.testing.assert_allclose(residual[1], -1.5)
        np.testing.assert_allclose(found["residual"][0, 0], residual / 100)
        np.testing.assert_allclose(found["energy"], 0.5 * 0.015 ** 2)

    def test_facets_without_area(self):
        library = ents.library()
        for call in (lambda: library.tributary_areas("quad4", *FLAT), lambda: library.sampling_points("quad4", 2, *FLAT),
                     lambda: library.contact_area("quad4", *FLAT, np.zeros(6), np.ones(6))):
            error = self.refused(ents.Status.DEGENERATE_SEGMENT, [], call)
            self.assertEqual(error.element, 1)
            self.assertNotIsInstance(error, ents.CutStep)

    def test_surface_and_wear(self):
        self.refused(ents.Status.DEGENERATE_SEGMENT, [], lambda: ents.Model(PLAIN).surface(np.zeros((2, 2)), [[0.0]]))
        model = ents.Model({"segment": "line2", "height": {"type": "field", "name": "f", "points": [9], "boundary": "clamped", "size": [2], "origin": [-1]},
                            "contact": {**PENALTY, "wear": {"coefficient": 0.03, "slave": 0.4}}})
        block, state, slave = model.field_init("f"), None, np.array([[0.1, -0.02]])
        model.bind({"f": block})
        for move in (0.0, 0.3):
            slave = slave + [[move, 0]]
            state = model.evaluate(slave, LINE, "state_end", state=model.state_init(1) if state is None else state)["state_end"]
        kept = state.copy()
        self.refused(ents.Status.DEGENERATE_SEGMENT, [], lambda: model.wear_collect("f", block, state, slave, np.zeros((2, 2))))
        np.testing.assert_array_equal(state, kept)
        self.assertGreater(model.wear_collect("f", block, state, slave, LINE), 0)


class Heights(Cases):
    def model(self, function, **keys):
        ents.library().register_height("guards", 1, function)
        with warnings.catch_warnings():
            if not keys:
                warnings.simplefilter("ignore")
            return ents.Model({**PLAIN, "master": "rigid", "height": {"type": "callback", "name": "guards", **keys}})

    def row(self, model):
        """A row of 11 slave points over one segment."""
        x = np.c_[np.linspace(0.5, -0.5, 11), np.full(11, 0.05)]
        return ents.Contact(model, x, np.c_[np.arange(10), np.arange(1, 11)], [[0, 1]], master_positions=LINE, reach=0.5)

    def test_what_a_height_function_raises(self):
        calls = []

        def raises(order, s):
            calls.append(order)
            raise ZeroDivisionError("in the height")
        model = self.model(raises, bound=0.1, slope=0.1, curvature=0.1)
        for call in (lambda: model.evaluate([[0.1, 0.0]], LINE, "gap"), lambda: ents.Tree(model, [[0, 1]], LINE).detect([[0.1, 0.0]], 0.5),
                     lambda: model.surface(LINE, [[0.0]])):
            with self.assertRaisesRegex(ZeroDivisionError, "in the height"):
                call()
        self.assertEqual(len(calls), 3)  # one of each call
        model = self.model(lambda order, s: "text", bound=0.1, slope=0.1, curvature=0.1)
        with self.assertRaises(ValueError):
            model.evaluate([[0.1, 0.0]], LINE, "gap")
        model = self.model(lambda order, s: calls.append(order), bound=0.1, slope=0.1, curvature=0.1)  # forgets to return
        self.refused(ents.Status.NO_PROJECTION, ["returned None", "first 1000 calls"], lambda: model.evaluate([[0.1, 0.0]], LINE, "gap"))
        self.assertLess(len(calls), 1010)
        for value in (None, np.nan):  # once for all slave points of a surface
            calls.clear()
            model = self.model(lambda order, s: calls.append(order) or (value if value is None else [value + 0 * s[0]] * (order + 1)))
            contact = self.row(model)
            self.refused(ents.Status.NO_PROJECTION, ["returned None or NaN"], lambda: contact.update(np.zeros(contact.rows)))
            self.assertLess(len(calls), 1010)
        calls.clear()
        contact = self.row(self.model(raises, bound=0.1, slope=0.1, curvature=0.1))
        with self.assertRaisesRegex(ZeroDivisionError, "in the height"):
            contact.update(np.zeros(contact.rows))
        self.assertEqual(len(calls), 1)
        half = lambda order, s: None if (s[0] > 0).any() else [0 * s[0]] * (order + 1)
        model = self.model(half, bound=0.1, slope=0.1, curvature=0.1)
        status = model.evaluate([[-0.5, 0.1], [0.5, 0.1]], LINE, "gap", start=[0.0])["status"]
        self.assertTrue(status[0] == 0 and status[1] > 0, status)

    def test_a_height_function_without_bounds(self):
        wave = lambda order, s: [0.1 * np.sin(s[0]), 0.1 * np.cos(s[0]), -0.1 * np.sin(s[0]), -0.1 * np.cos(s[0])][:order + 1]
        with self.assertWarnsRegex(UserWarning, '"guards" comes without slope, curvature: .* 100 000 calls a slave point'):
            self.model(wave, bound=0.1)
        calls = []
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            contact = self.row(self.model(lambda order, s: calls.append(order) or wave(order, s), bound=0.1, slope=0.1, curvature=0.1))
        contact.update(np.zeros(contact.rows))
        self.assertLess(len(calls), 1109)
        self.assertAlmostEqual(contact.gap[5], 0.05 / np.sqrt(1.01), delta=1e-3)  # h = 0.1 s near the middle

    def test_maps_that_are_hardly_meant(self):
        rng = np.random.default_rng(0)
        heights = 0.01 * rng.normal(size=(12, 9))
        map_of = lambda values, **more: ents.Model({"segment": "quad4", "height": {"type": "map", "data": "scan", "size": [2, 2], "boundary": "clamped", **more},
                                                    "contact": PENALTY}, data={"scan": values})
        x, y = np.meshgrid(np.arange(6.0), np.arange(5.0))
        for words, values in (("the numbers of columns", np.vstack([np.arange(9), heights])), ("look like x, y, z", np.c_[x.ravel(), y.ravel(), rng.normal(size=30)]),
                              ("lift the whole surface", heights + 3.0)):
            with self.assertWarnsRegex(UserWarning, f'"scan".*{words}'):
                map_of(values)
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "scan.csv"), "w") as file:
                file.write("0,1,2,3,4,5,6,7,8\n" + "\n".join(",".join(f"{h:.6f}" for h in row) for row in heights))
            with self.assertWarnsRegex(UserWarning, '"scan.csv": the first row is 0, 1, 2'):
                ents.Model({"segment": "quad4", "height": {"type": "map", "file": "scan.csv", "size": [2, 2], "boundary": "clamped"}}, directory=folder)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            map_of(heights)
        profile = lambda values: self.row(ents.Model({"segment": "line2", "master": "rigid", "contact": PENALTY, "height": {
            "type": "map", "data": "scan", "size": [2], "boundary": "clamped"}}, data={"scan": values}))
        for words, values in (("are they in the mesh's unit of length", 400 * heights[:1]), ("farther than reach = 0.5", heights[:1] + 0.8 * np.sign(heights[:1]))):
            with self.assertWarnsRegex(UserWarning, words):
                profile(values)
        masked = np.ma.masked_less(heights, heights.min() + 1e-9)
        row, column = np.unravel_index(heights.argmin(), heights.shape)
        for call in (lambda: map_of(masked), lambda: ents.Model({"segment": "quad4", "height": {"type": "map", "values": masked, "size": [2, 2], "boundary": "clamped"}})):
            self.refused(ents.Status.NON_FINITE, [f"[{row}, {column}] is masked"], call)
        self.refused(ents.Status.NON_FINITE, ["slave[0, 1] is masked"], lambda: ents.Model(PLAIN).evaluate(np.ma.masked_array([[0, 1.0]], [[False, True]]), LINE))


class Bounds(Cases):
    """Nothing beyond the arrays that Python gives."""

    def test_ranges(self):
        model, slave = ents.Model(PLAIN), np.zeros((4, 2)) - [0, 0.1]
        for first, count in ((0, 5), (0, 10 ** 9), (5, None), (-1, 1), (4, 1), (2, 3), (0, -1), (0.5, 1)):
            self.refused(ents.Status.BAD_VALUE, ["give a whole number"], lambda: model.evaluate(slave, LINE, "gap", first=first, count=count))
        self.assertEqual(model.evaluate(slave, LINE, "gap", first=4)["status"].tolist(), [0] * 4)

    def test_trees(self):
        plain, space, curved = (ents.Model({"segment": segment, "contact": PENALTY}) for segment in ("line2", "quad4", "line3"))
        tree = ents.Tree(plain, [[0, 1]], LINE)
        gap = tree.detect([[0.1, 0.1]], 1)["gap"]
        for name in ("positions", "connectivity", "surface_coordinates"):
            with self.assertRaises(AttributeError):
                setattr(tree, name, LINE + 1)
        with self.assertRaises(ValueError):
            tree.connectivity[0, 0] = 99
        for model, slave in ((curved, [[0, -0.1]]), (space, [[0, -0.1, 0]])):
            d, nodes = model.layout.dimension, model.layout.nodes
            rows = np.arange(d * (nodes + 1)).reshape(-1, d)
            for call in (lambda: model.evaluate(slave, tree=tree, segment=[0], want="gap"), lambda: model.blocks(slave, tree, [0], rows[:1], rows[1:], rows.size),
                         lambda: model.assemble(ents.System(rows[:1], rows[1:], rows=rows.size), slave, tree, [0]),
                         lambda: model.iterate(slave, tree, 1.0, system=ents.System(rows[:1], rows[1:], rows=rows.size))):
                self.refused(ents.Status.BAD_VALUE, ["segments of 2 nodes in 2D", "make it with this model"], call)
        rows = np.arange(6).reshape(3, 2)
        self.refused(ents.Status.BAD_COUNT, ["1 nodes; there are 2 slave points"], lambda: plain.assemble(
            ents.System(rows[:1], rows[1:], rows=6), [[0, -0.1], [0.1, -0.1]], tree, [0, 0]))
        with self.assertRaises(ents.Error):
            tree.move(LINE * np.nan)
        np.testing.assert_array_equal(tree.detect([[0.1, 0.1]], 1)["gap"], gap)  # as it was

    def test_facets_of_another_width(self):
        library, x = ents.library(), np.zeros((4, 3))
        for call in (lambda: library.tributary_areas("quad9", [[0, 1, 2, 3]], x), lambda: library.sampling_points("quad8", 2, [[0, 1, 2, 3]], x),
                     lambda: library.smooth("quad4", "bspline16", [[0, 1]], 4), lambda: library.contact_area("quad4", [[0, 1]], x, np.zeros(4), np.zeros(4))):
            self.refused(ents.Status.BAD_COUNT, ["connectivity: the shape"], call)
        self.refused(ents.Status.BAD_VALUE, ["there is no 'hexagon'"], lambda: library.tributary_areas("hexagon", [[0, 1]], x))
        for begin in ([0, 3], [1, 1], [0, 2, 1], []):
            self.refused(ents.Status.BAD_VALUE, ["never falls"], lambda: library.combine((begin, [0, 1], [1.0, 1.0]), x))

    def test_random_arguments(self):
        """Random shapes, types and counts: a result or an exception, never an access beyond (run under valgrind or AddressSanitizer to see one)."""
        rng = np.random.default_rng(5)
        friction = {**PENALTY, "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 500}}
        models = [ents.Model({"segment": segment, **more}) for segment in ("line2", "quad4", "bspline4") for more in (
            {"contact": friction}, {"contact": PENALTY, "master": "rigid"}, {"parameters": {"a": 0.1}, "height": {"type": "constant", "value": "a"}, "contact": PENALTY})]
        trees = [ents.Tree(m, np.arange(m.layout.nodes)[None], rng.normal(size=(m.layout.nodes, m.layout.dimension))) for m in models]

        def array(shape=None, low=-3, high=9):
            shape = tuple(rng.integers(0, 5, rng.integers(0, 4))) if shape is None or rng.random() < 0.2 else shape
            kind = rng.integers(0, 8)
            values = rng.integers(low, high, shape) if kind < 4 else rng.normal(size=shape)
            return (values, values.astype(np.int32), values.tolist(), np.asfortranarray(values), values, values.astype(np.float32), values.tolist(), None)[kind]

        def number():
            return (int(rng.integers(-2, 6)), float(rng.normal()), None, 10 ** 12, -1, "2", np.int8(2))[rng.integers(0, 7)]

        def calls():
            k = rng.integers(len(models))
            model, tree, other = models[k], trees[k], trees[rng.integers(len(trees))]
            d, m, n = model.layout.dimension, model.layout.nodes, int(rng.integers(0, 4))
            size, slave, segment = model.layout.state_size, array((n, d)), array((n,), -1, 2)
            state = model.state_init(n) if rng.random() < 0.5 else array((n, size))
            equations = array((n, d), -1, 8), array((m, d), -1, 8)
            system = lambda: ents.System(*equations, rows=8)
            facet = ("line2", "quad4", "tri6", "quad9")[rng.integers(4)]
            width = int(facet[-1])
            points = array((5, 2 if facet[0] == "l" else 3))
            yield lambda: model.evaluate(slave, array((m, d)), "gap residual tangent state_end", state=state, start=array((n, d - 1)), area=array((n,)),
                                         first=number(), count=number())
            yield lambda: model.evaluate(slave, None, "gap residual", tree=other, segment=segment, state=state)
            yield lambda: model.blocks(slave, other, segment, *equations, number())
            yield lambda: model.assemble(system(), slave, other, segment, state=state)
            yield lambda: model.iterate(slave, other, 1.0, segment, array((n, d - 1)), "gap", system=system(), state=state, positions_begin=array((m, d)))
            yield lambda: tree.detect(slave, number(), segment, array((n, d - 1)))
            yield lambda: tree.state_transfer(state, segment, array((n,), -1, 2), array((m, d)))
            yield lambda: tree.move(array((m, d)))
            yield lambda: model.derivatives(slave, array((m, d)), state=state, adjoint=array((n, model.layout.dofs)))
            yield lambda: model.surface(array((m, d)), array((n, d - 1)), array((m, d - 1)))
            yield lambda: model.state_augment(state, array((n, size)))
            yield lambda: model.state_opened(state)
            yield lambda: model.library.tributary_areas(facet, array((2, width), 0, 6), points, number())
            yield lambda: model.library.sampling_points(facet, number(), array((2, width), 0, 6), points)
            yield lambda: model.library.contact_area(facet, array((2, width), 0, 6), points, array((5,)), array((5,)))
            yield lambda: model.library.smooth(facet, ("bspline4", "bspline16", "bezier15", "x")[rng.integers(4)], array((2, width), 0, 6), number())
            yield lambda: model.library.combine((array((3,), 0, 4), array((4,), 0, 6), array((4,))), array((5, 3)))
            yield lambda: ents.Tree(model, array((2, m), 0, 6), array((5, d)))
        worked = 0
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for _ in range(int(os.environ.get("ENTS_RANDOM_ARGUMENTS", 300))):
                for call in calls():
                    try:
                        call()
                        worked += 1
                    except (ents.Error, TypeError, ValueError, MemoryError):
                        pass
        self.assertGreater(worked, 100)


class Objects(Cases):
    def test_copies(self):
        model = ents.Model({"segment": "line2", "parameters": {"a": 0.1, "eps": 100.0}, "height": {"type": "sum", "of": [
            {"type": "constant", "value": "a"}, {"type": "field", "name": "f", "points": [8], "boundary": "clamped", "size": [2], "origin": [-1]}]},
            "contact": {"normal": {"type": "penalty", "stiffness": "eps"}}})
        model.bind({"f": model.field_init("f", np.linspace(0, 0.01, 8))}, a=0.2)
        tree = ents.Tree(model, [[0, 1]], LINE)
        want = model.evaluate([[0.1, 0.15]], LINE, "gap residual")
        for again in (pickle.loads(pickle.dumps(model)), copy.deepcopy(model), pickle.loads(pickle.dumps(tree)).model):
            got = again.evaluate([[0.1, 0.15]], LINE, "gap residual")
            self.assertEqual((got["gap"].tobytes(), got["residual"].tobytes()), (want["gap"].tobytes(), want["residual"].tobytes()))
        pose = ents.Pose(3, [1, 2, 3])
        pose.move(spin=[0.1, 0.2, 0.3])
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(pose)).turn, pose.turn)
        self.refused(ents.Status.BAD_VALUE, ["no field g"], lambda: model.bind({"g": np.zeros(3)}))

    def test_names(self):
        self.assertEqual(ents.__version__, ents.library().version())
        for name in ents.__all__:
            self.assertTrue(hasattr(ents, name), name)
        folder = os.path.dirname(ents.__file__)
        self.assertTrue(os.path.exists(os.path.join(folder, "py.typed")))
        for words, thing in (("line2, 2D", ents.Model(PLAIN)), ("1 line2 segments over 2 nodes", ents.Tree(ents.Model(PLAIN), [[0, 1]], LINE)),
                             ("6 rows", ents.System([[0, 1]], None, rows=6)), ("point [0.0, 0.0]", ents.Pose(2))):
            self.assertIn(words, repr(thing))
        for function in (ents.Contact.__init__, ents.Model.evaluate, ents.Model.iterate, ents.Tree.detect, ents.Library.smooth):
            self.assertGreater(len(function.__doc__), 200)
            self.assertIn("return", function.__annotations__)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
