"""python_test.py FOLDER-OF-ents LAYOUT-PROGRAM FIRST-PROGRAM: the Python module against ents.h, as the C compiler sees it, and against the library.

LAYOUT-PROGRAM prints constants, sizes and offsets of ents.h (abi/header_layout.sh), FIRST-PROGRAM is clients/first.c. The library is the one of
the environment's ENTS_LIBRARY. Exit status 3: no NumPy here, nothing was tested.
"""
import ctypes
import subprocess
import sys
import threading
import unittest
from fractions import Fraction

sys.dont_write_bytecode = True
try:
    import numpy as np
except ModuleNotFoundError:
    print("python_test.py: this Python has no NumPy (Debian: python3-numpy)")
    sys.exit(3)
folder, layout_program, first_program = sys.argv[1:4]
sys.path.insert(0, folder)
import ents  # noqa: E402

QUAD = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
FIRST = {"segment": "quad4", "height": {"type": "sine", "amplitude": 0.05, "wave_vector": [0.5, 0.25]},
         "contact": {"normal": {"type": "penalty", "stiffness": 1000}}}
FRICTION = {"segment": "line2", "height": {"type": "sine", "amplitude": 0.04, "wave_vector": [1.5]},
            "contact": {"normal": {"type": "penalty", "stiffness": 1000},
                        "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 900}}}
LINE = np.array([[-1.0, 0.1], [1.1, -0.2]])


def printed(program):
    return subprocess.run([program], check=True, capture_output=True, text=True).stdout.splitlines()


class Header(unittest.TestCase):
    def setUp(self):
        self.numbers = {words[0]: tuple(map(int, words[1:])) for words in map(str.split, printed(layout_program))}

    def test_structs(self):
        self.assertEqual({name for name in self.numbers if name.startswith("ents_") and "%" not in name}, set(ents.STRUCTS))
        for name, struct in ents.STRUCTS.items():
            fields = {key.split("%")[1]: value for key, value in self.numbers.items() if key.startswith(name + "%")}
            mine = {field: (getattr(struct, field).offset, getattr(struct, field).size) for field, _ in struct._fields_}
            self.assertEqual(mine, fields, name)
            self.assertEqual(ctypes.sizeof(struct), self.numbers[name][0], name)

    def test_constants(self):
        mine = {"ENTS_CONTRACT_MAJOR": ents.CONTRACT_MAJOR, "ENTS_CONTRACT_MINOR": ents.CONTRACT_MINOR}
        mine.update(("ENTS_" + name, value.value) for name, value in ents.Status.__members__.items())
        mine.update(("ENTS_NEEDS_" + name, value.value) for name, value in ents.Need.__members__.items())
        mine.update(("ENTS_FLAG_" + name, value.value) for name, value in ents.Flag.__members__.items())
        mine.update(("ENTS_SHARED_" + name, value.value) for name, value in ents.Shared.__members__.items())
        mine.update(("ENTS_" + ("STATE" if name == "state_end" else name.upper()), bit) for name, bit in ents.QUANTITIES.items())
        mine.update(("ENTS_ENDS_" + name, getattr(ents, "ENDS_" + name)) for name in ("STRAIGHT", "REPEATED", "QUASI_CUBIC", "QUASI_PARABOLIC"))
        mine.update(("ENTS_CHECK_" + name.upper(), place) for place, name in enumerate(ents.CONDITIONS))
        theirs = {name: value[0] for name, value in self.numbers.items() if name.startswith("ENTS_") and "%" not in name}
        self.assertEqual(mine, theirs)

    def test_needs(self):
        layout = ents.Model(FIRST).layout
        self.assertIn(ents.Need.MASTER, ents.Need(layout.needs))
        self.assertNotIn(ents.Need.FRICTION, ents.Need(layout.needs))
        self.assertIn(layout.instruction_set, (b"portable", b"avx2", b"avx512"))

    def test_library_agrees(self):
        """A struct that says it is one longer has to be refused: the library reads struct_size where Python puts it."""
        model = ents.Model(FIRST)
        for struct, call in ((ents.Layout, lambda x: model._call("model_layout", x)),
                             (ents.Input, lambda x: model._call("evaluate", 0, 0, x, ents._new(ents.Output))),
                             (ents.Output, lambda x: model._call("evaluate", 0, 0, ents._new(ents.Input), x))):
            with self.assertRaises(ents.Error) as caught:
                call(struct(struct_size=3))
            self.assertEqual(caught.exception.status, ents.Status.STRUCT_SIZE)
            self.assertIn("struct_size", str(caught.exception))


class Numbers(unittest.TestCase):
    def test_first_call_is_that_of_c(self):
        r = ents.Model(FIRST).evaluate([[-0.4, 0.3, -0.1]], QUAD, "gap residual tangent")
        mine = ["%24.16E%24.16E%24.16E" % (r["gap"][0], r["residual"][0, i], r["tangent"][0, i, 2]) for i in range(15)]
        self.assertEqual(mine, printed(first_program))

    def differences(self, model, slave, master, h, **inputs):
        """Central differences of all outputs that have a derivative among the others, one dof at a time."""
        names = "residual xi gap energy gap_gradient xi_gradient"
        x = np.vstack([slave, master]).ravel()
        columns = []
        for k in range(len(x)):
            ends = []
            for sign in (1, -1):
                y = x.copy()
                y[k] += sign * h
                y = y.reshape(-1, slave.shape[1])
                ends.append(model.evaluate(y[:1], y[1:], names, **inputs))
            columns.append({name: (ends[0][name][0] - ends[1][name][0]) / (2 * h) for name in names.split()})
        return {name: np.stack([c[name] for c in columns], axis=-1) for name in names.split()}

    def compare(self, model, slave, master, **inputs):
        h = 1e-5
        want = "residual tangent gap_gradient gap_hessian xi_gradient xi_hessian"
        r = model.evaluate(slave, master, want, **inputs)
        self.assertEqual(r["status"][0], 0)
        d = self.differences(model, slave, master, h, **inputs)
        for analytic, of in (("residual", "energy"), ("tangent", "residual"), ("gap_gradient", "gap"), ("gap_hessian", "gap_gradient"),
                             ("xi_gradient", "xi"), ("xi_hessian", "xi_gradient")):
            if analytic == "residual" and model.layout.friction:
                continue  # friction has no energy
            scale = np.abs(r[analytic][0]).max()
            # Central differences: h^2/6 times the third derivative, about (wave number)^2 of the first (5^2 at most): 4e-10, and the
            # projection's rounding over h: 1e-14 / 1e-5. Wrong indices are errors of order one.
            np.testing.assert_allclose(r[analytic][0], d[of], rtol=0, atol=1e-7 * scale, err_msg=analytic)

    def test_finite_differences_3d(self):
        warped = QUAD + [[0, 0, 0.1], [0.05, 0, 0], [0, -0.1, 0.02], [0, 0, -0.05]]
        self.compare(ents.Model(FIRST), np.array([[-0.4, 0.3, -0.1]]), warped)

    def test_finite_differences_friction(self):
        model = ents.Model(FRICTION)
        begin = model.evaluate([[0.10, -0.06]], LINE, "state_end", state=model.state_init(1))["state_end"]
        r = model.evaluate([[0.13, -0.08]], LINE, "flags tangent", state=begin)
        self.assertTrue(r["flags"][0] & ents.Flag.SLIP)
        k = r["tangent"][0]
        self.assertGreater(np.abs(k - k.T).max(), 1e-3 * np.abs(k).max())  # else a transposed tangent would go unseen
        self.compare(model, np.array([[0.13, -0.08]]), LINE, state=begin)

    def test_data_from_memory_and_rigid_master(self):
        s = np.linspace(0, 2 * np.pi, 65)[:-1]
        text = {"segment": "line2", "master": "rigid", "height": {"type": "map", "data": "wave", "boundary": "periodic", "size": [2]},
                "contact": {"normal": {"type": "penalty", "stiffness": 10}}}
        model = ents.Model(text, data={"wave": 0.1 * np.sin(s)})
        self.assertEqual(model.layout.dofs, 2)
        at = model.surface([[-1.0, 0], [1, 0]], [[-0.5], [0.0], [0.5]])
        # s = -0.5, 0, 0.5 of a period of 2 that begins at s = 0: the samples are met, the spline goes through them to rounding.
        np.testing.assert_allclose(at["height"], [-0.1, 0, 0.1], atol=1e-15)
        np.testing.assert_allclose(at["point"], [[-0.5, -0.1], [0, 0], [0.5, 0.1]], atol=1e-15)

    def test_height_functions(self):
        k = np.pi * np.array([1, 0.5])

        def wave(order, s):
            f = [0.05 * np.sin(k @ s), 0.05 * np.cos(k @ s)]
            f += [-f[0], -f[1]]
            return [f[i] * k[0] ** (i - j) * k[1] ** j for i in range(order + 1) for j in range(i + 1)]

        library = ents.library()
        library.register_height("python wave", 2, wave)
        library.register_height("python undefined", 2, lambda order, s: None)
        sine = ents.Model(FIRST)
        bounds = {"bound": 0.05, "slope": 0.16, "curvature": 0.5}
        model = ents.Model({**FIRST, "height": {"type": "callback", "name": "python wave", **bounds}})
        slave = np.array([[x, y, -0.02] for x in (-0.4, 0.3) for y in np.linspace(-0.6, 0.6, 5)])
        expected, result = (m.evaluate(slave, QUAD, want="gap residual tangent") for m in (sine, model))
        for name in ("gap", "residual", "tangent"):
            np.testing.assert_allclose(result[name], expected[name], rtol=1e-9, atol=1e-12)
        undefined = ents.Model({**FIRST, "height": {"type": "callback", "name": "python undefined", **bounds}})
        with self.assertRaisesRegex(ents.Error, "has returned None"):
            undefined.evaluate(slave, QUAD, want="gap residual")
        library.register_height("python wave", 2, None)
        with self.assertRaisesRegex(ents.Error, 'no height function called "python wave" of 2 surface coordinates'):
            ents.Model({**FIRST, "height": {"type": "callback", "name": "python wave"}})

    def test_numbers_that_change(self):
        wave = {"type": "sine", "amplitude": "top", "wave_vector": [0.5]}
        model = ents.Model({"segment": "line2", "parameters": {"top": 0.05, "eps": 100},
                            "height": {"type": "sum", "of": [wave, {"type": "field", "name": "worn", "points": [8], "boundary": "periodic", "size": [2]}]},
                            "contact": {"normal": {"type": "penalty", "stiffness": "eps"}, "wear": {"coefficient": 0.05, "slave": 0.25}}})
        self.assertEqual(list(model.parameters), ["eps", "top"])
        line = [[-1, 0], [1, 0]]
        with self.assertRaisesRegex(ents.Error, 'has a field, "worn", without memory'):
            model.evaluate([[0.3, 0]], line, "gap")
        block = model.field_init("worn")
        gaps = []
        for top in (0.05 - 1e-4, 0.05, 0.05 + 1e-4):
            model.bind({"worn": block}, top=top)
            gaps.append(model.evaluate([[0.3, 0]], line, "gap", start=[0.3])["gap"][0])
        model.bind({"worn": block})
        rates = model.derivatives([[0.3, 0]], line, start=[0.3])
        self.assertEqual(rates["residual"].shape, (1, 2, 6))
        self.assertAlmostEqual(rates["gap"][0, 1], (gaps[2] - gaps[0]) / 2e-4, 6)
        state = model.evaluate([[0.3, 0]], line, "state_end", start=[0.3], state=model.state_init(1))["state_end"]
        state = model.evaluate([[0.5, 0]], line, "state_end", start=[0.5], state=state)["state_end"]
        lost = state[0, model.layout.worn + 1]
        self.assertGreater(lost, 0.0)
        self.assertAlmostEqual(lost, 3 * state[0, model.layout.worn], 15)
        self.assertAlmostEqual(model.wear_collect("worn", block, state, [[0.5, 0]], line, area=2.0), 2 * lost, 15)
        self.assertEqual(state[0, model.layout.worn + 1], 0.0)
        heights = model.field_sample("worn", block, np.linspace(0, 2, 65)[:-1, None])
        self.assertAlmostEqual(heights.mean() * 2, -2 * lost, 12)
        with self.assertRaisesRegex(ents.Error, "no parameter mu; it has eps, top"):
            model.bind({"worn": block}, mu=1)

    def test_one_number_for_all_entries(self):
        """Of 500 elements, the last ones of which would read far behind one number that is taken for an array of them."""
        rng = np.random.default_rng(2)
        slave = rng.uniform([-0.9, -0.9, -0.1], [0.9, 0.9, 0.05], (500, 3))
        start = ents.Model(FIRST)
        unknowns = ents.Model({**FIRST, "contact": {"normal": {"type": "augmented_multiplier", "stiffness": 400},
                                                    "friction": {"type": "coulomb", "coefficient": 0.25, "stiffness": 200}}})
        self.assertEqual(unknowns.layout.multipliers, 3)
        state = unknowns.state_init(1)[0]
        for model, name, shape, more in ((start, "start", (2,), {}), (unknowns, "multiplier", (3,), {"state": state}), (start, "area", (), {})):
            for value in (0.25, np.float64(0.25), np.array(0.25)):
                whole = model.evaluate(slave, QUAD, "residual gap", **{name: np.full((500, *shape), 0.25)}, **more)
                number = model.evaluate(slave, QUAD, "residual gap", **{name: value}, **more)
                self.assertEqual(number["residual"].tobytes(), whole["residual"].tobytes(), name)
                self.assertEqual(number["gap"].tobytes(), whole["gap"].tobytes(), name)
        for name in ("master", "surface_coordinates"):
            with self.assertRaises(ents.Error) as caught:
                start.evaluate(slave, **{"master": QUAD, name: 0.25})
            self.assertEqual(caught.exception.status, ents.Status.BAD_COUNT)
            self.assertIn(name, str(caught.exception))
        with self.assertRaises(ents.Error) as caught:  # a state of 0.25 is none
            unknowns.evaluate(slave, QUAD, state=0.25, multiplier=0.0)
        self.assertEqual(caught.exception.status, ents.Status.BAD_STATE)

    def test_threads_and_batches_give_the_same_bits(self):
        model = ents.Model(FIRST)
        rng = np.random.default_rng(1)
        n = 400
        slave = rng.uniform([-0.9, -0.9, -0.1], [0.9, 0.9, 0.05], (n, 3))
        want = "gap residual tangent flags"
        whole = model.evaluate(slave, QUAD, want)
        shared = model.evaluate(slave, QUAD, want)
        for name in want.split():
            shared[name].fill(0)
        parts = [threading.Thread(target=model.evaluate, args=(slave, QUAD, want), kwargs={"first": f, "count": 50, "out": shared})
                 for f in range(0, n, 50)]
        for part in parts:
            part.start()
        for part in parts:
            part.join()
        for name in want.split():
            self.assertEqual(whole[name].tobytes(), shared[name].tobytes(), name)
        each = np.array([model.evaluate(slave[i:i + 1], QUAD[None], "gap")["gap"][0] for i in range(n)])
        self.assertEqual(each.tobytes(), whole["gap"].tobytes())


class Errors(unittest.TestCase):
    def caught(self, status, words, call):
        with self.assertRaises(ents.Error) as caught:
            call()
        self.assertEqual(caught.exception.status, status)
        for word in words:
            self.assertIn(word, str(caught.exception))

    def test_numpy_inside_a_model(self):
        """Arrays and numbers of NumPy are those of lists; what JSON cannot say is refused with what a model may hold."""
        heights = np.random.default_rng(3).normal(size=(5, 6)) * 0.02
        with_arrays = lambda values, number: ents.Model({
            "segment": "quad4", "height": {"type": "map", "values": values, "size": number([2.0, 1.5]), "boundary": "periodic"},
            "contact": {"normal": {"type": "penalty", "stiffness": number(1000.0)}}})
        results = [model.evaluate([[-0.4, 0.3, -0.1]], QUAD, "gap residual tangent") for model in (
            with_arrays(heights.tolist(), lambda x: x), with_arrays(heights, np.asarray), with_arrays(list(heights), np.float64),
            with_arrays(np.asfortranarray(heights), lambda x: np.asarray(x, np.float32)))]
        for name in ("gap", "residual", "tangent"):
            for other in results[1:]:
                np.testing.assert_array_equal(results[0][name], other[name])
        heights[1, 2] = np.nan
        self.caught(ents.Status.BAD_VALUE, ["model", "not JSON compliant"], lambda: with_arrays(heights, np.asarray))
        self.caught(ents.Status.BAD_VALUE, ["model", "is a Fraction", "NumPy arrays"], lambda: with_arrays([[0, 1], [1, 0]], lambda x: Fraction(1)))

    def test_mistakes(self):
        model = ents.Model(FIRST)
        self.caught(ents.Status.UNKNOWN_KEY, ["segmnt"], lambda: ents.Model({"segmnt": "line2"}))
        self.caught(ents.Status.JSON_SYNTAX, [], lambda: ents.Model("{"))
        self.caught(ents.Status.FILE, ["no_such_file.json"], lambda: ents.Model("no_such_file.json"))
        self.caught(ents.Status.FILE, ["no_such_library.so", "ENTS_LIBRARY"], lambda: ents.Library("./no_such_library.so"))
        self.caught(ents.Status.BAD_MASK, ["residuum"], lambda: model.evaluate([[0, 0, 0]], QUAD, "residuum"))
        self.caught(ents.Status.BAD_COUNT, ["slave"], lambda: model.evaluate([[0, 0]], QUAD))
        self.caught(ents.Status.BAD_COUNT, ["master"], lambda: model.evaluate([[0, 0, 0]], QUAD[:3]))
        self.caught(ents.Status.BAD_VALUE, ["per_direction"], lambda: model.library.sampling_points("line2", -1, [[0, 1]], [[0, 0], [1, 0]]))
        self.caught(ents.Status.NULL_ARGUMENT, ["rows"], lambda: ents.System([[0, 1, 2]], None))
        tree = ents.Tree(model, [[0, 1, 2, 3]], QUAD)
        self.caught(ents.Status.BAD_COUNT, ["slave_equations"], lambda: model.assemble(
            ents.System([[0, 1]], [[0, 1, 2]] * 4, rows=15), [[0, 0, 0]], tree, [0]))
        two = model.evaluate([[0, 0, 0]] * 2, QUAD, "gap tangent")
        for wrong in ({"out": two}, {"out": {**two, "tangent": np.zeros((3, 15, 15))}}, {"out": {}}):
            self.caught(ents.Status.BAD_COUNT, ["out"], lambda: model.evaluate([[0, 0, 0]] * 3, QUAD, "gap tangent", **wrong))
        self.caught(ents.Status.BAD_COUNT, ["out: tangent"], lambda: model.evaluate(
            [[0, 0, 0]] * 2, QUAD, "gap tangent", out={**two, "tangent": np.zeros((2, 15, 15))}))  # its memory is the other way round
        self.caught(ents.Status.NON_FINITE, ["slave"], lambda: model.evaluate([[0, np.nan, 0]], QUAD))

    def test_indices_are_whole_numbers(self):
        model = ents.Model(FIRST)
        tree = ents.Tree(model, [[0.0, 1, 2, 3]], QUAD)
        self.assertEqual(tree.connectivity.tolist(), [[0, 1, 2, 3]])
        slave, rows = [[0, 0, -0.1]], np.arange(15).reshape(5, 3)
        library = ents.library()
        combination = np.array([0, 1]), np.array([0.5]), np.array([1.0])
        for words, call in (
                ("connectivity[0, 3] is 3.7", lambda: ents.Tree(model, [[0, 1, 2, 3.7]], QUAD)),
                ("connectivity[0, 1] is nan", lambda: ents.Tree(model, [[0, np.nan, 2, 3]], QUAD)),
                ("connectivity[0, 1] is 1e+300", lambda: ents.Tree(model, [[0, 1e300, 2, 3]], QUAD)),
                ("segment[0] is 0.5", lambda: tree.detect(slave, 1, segment=[0.5], xi=[[0, 0]])),
                ("segment[0] is 0.5", lambda: model.evaluate(slave, None, "gap", tree=tree, segment=[0.5])),
                ("segment[0] is 0.5", lambda: model.blocks(slave, tree, [0.5], rows[:1], rows[1:], 15)),
                ("slave_equations[0, 0] is 0.5", lambda: model.blocks(slave, tree, [0], rows[:1] + 0.5, rows[1:], 15)),
                ("master_equations[0, 0] is 3.5", lambda: ents.System(rows[:1], rows[1:] + 0.5, rows=15)),
                ("old[0] is 0.5", lambda: tree.state_transfer(model.state_init(1), [0.5], [0])),
                ("connectivity[0, 0] is 0.5", lambda: library.tributary_areas("line2", [[0.5, 1]], [[0, 0], [1, 0]])),
                ("connectivity[0, 0] is 0.5", lambda: library.sampling_points("line2", 2, [[0.5, 1]], [[0, 0], [1, 0]])),
                ("connectivity[0, 0] is 0.5", lambda: library.smooth("line2", "bspline4", [[0.5, 1]], 2)),
                ("nodes is 2.5", lambda: library.smooth("line2", "bspline4", [[0, 1]], 2.5)),
                ("nodes[0] is 0.5", lambda: library.combine(combination, [[0, 0], [1, 0]]))):
            self.caught(ents.Status.BAD_VALUE, [words, "whole number"], call)

    def test_recoverable_statuses_are_results(self):
        model = ents.Model({**FIRST, "contact": {"normal": {"type": "penalty", "stiffness": 1000}}, "penetration_limit": 0.01})
        r = model.evaluate([[0, 0, 0.5], [0.1, 0, -0.5]], QUAD)
        self.assertEqual(r["status"].tolist(), [0, ents.Status.DEEP_PENETRATION])
        self.assertTrue(0 < r["step_factor"] < 1)
        self.assertTrue(r["message"])
        again = model.evaluate([[0, 0, 0.5], [0.1, 0, 0.5]], QUAD, out=r)
        self.assertEqual((again["status"].tolist(), again["step_factor"], again["message"]), ([0, 0], 1, ""))
        model.evaluate([[0, 0, 0.5], [0.1, 0, -0.5]], QUAD, out=r, first=0, count=1)
        self.assertEqual((r["step_factor"], r["message"]), (1, ""))
        model.evaluate([[0, 0, 0.5], [0.1, 0, -0.5]], QUAD, out=r, first=1, count=1)
        self.assertTrue(0 < r["step_factor"] < 1 and "penetration_limit" in r["message"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
