#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""generate_test.py FOLDER [--times]: heights in C that python3 -m ents generate writes, against the same expressions and the built-in heights.

ENTS_LIBRARY names libents.so; FOLDER is that of the package. --times: nanoseconds of an element's residual and tangent, in calls of 64 and 4096.
Exit status 3: no NumPy, no SymPy or no C compiler."""
import ctypes
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

try:
    import numpy as np
    import sympy  # noqa: F401: what generate needs
except ImportError as error:
    print(f"generate_test.py: {error} (Debian: python3-numpy, python3-sympy)")
    sys.exit(3)
COMPILER = os.environ.get("CC") or shutil.which("cc")
if not COMPILER:
    print("generate_test.py: no C compiler")
    sys.exit(3)
folder, times = sys.argv[1], "--times" in sys.argv[2:]
sys.path.insert(0, folder)
import ents  # noqa: E402

# expression, constants, segment, built-in height or None
HEIGHTS = {
    "sine": ("a*sin(pi*u)", {"a": 0.05}, "line2", {"type": "sine", "amplitude": 0.05, "wave_vector": [0.5]}),
    "waves": ("a*sin(pi*u+pi/2*v)", {"a": 0.05}, "quad4", {"type": "sine", "amplitude": 0.05, "wave_vector": [0.5, 0.25]}),
    "hill": ("0.03*exp(-((u-0.1)^2+v^2)/(2*w^2))", {"w": 0.7}, "quad4",
             {"type": "gaussian", "amplitude": 0.03, "center": [0.1, 0], "width": 0.7}),
    "mixture": ("0.02*tanh(2*u)*cos(v)/(1+u^2)+0.01*sqrt(1+v^2)*atan(u)", {}, "quad4", None),
}
SEGMENTS = {"line2": [[-1, 0], [1, 0]], "quad4": [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]}
_kept = []


def compiled(name, text, constants, *, parameters=(), data=None):
    """The generated function, registered."""
    with tempfile.TemporaryDirectory() as place:
        source = pathlib.Path(place, "height.c")
        options = [f"--constant={word}={number}" for word, number in constants.items()] + [f"--parameter={word}" for word in parameters]
        source.write_text(subprocess.run([sys.executable, "-m", "ents", "generate", text, "--name", name, *options], check=True, text=True,
                                         stdout=subprocess.PIPE, env={**os.environ, "PYTHONPATH": folder, "PYTHONDONTWRITEBYTECODE": "1"}).stdout)
        subprocess.run([COMPILER, "-O2", "-ffp-contract=off", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC", source, "-o", place + "/height.so", "-lm"], check=True)
        library = ctypes.CDLL(place + "/height.so")
    _kept.append((library, data))
    dimension = 1 if "v" not in text else 2
    ents.library().call("height_register", name.encode(), dimension, ctypes.cast(library[name], ctypes.c_void_p), data)
    return {"type": "callback", "name": name, "bound": 0.2, "slope": 2, "curvature": 20}


def models(name):
    text, constants, segment, built_in = HEIGHTS[name]
    heights = {"generated": compiled(name, text, constants), "expression": {"type": "expression", "h": text, "constants": constants}}
    if built_in:
        heights["built-in"] = built_in
    law = {"normal": {"type": "penalty", "stiffness": 1000}}
    return segment, {kind: ents.Model({"segment": segment, "height": height, "contact": law}) for kind, height in heights.items()}


def slaves(segment, count):
    rng = np.random.default_rng(5)
    flat = rng.uniform(-0.8, 0.8, (count, len(SEGMENTS[segment][0]) - 1))
    return np.column_stack([flat, np.full(count, -0.1)])


class Generated(unittest.TestCase):
    def test_heights_are_those_of_the_expression_and_of_the_built_in_height(self):
        for name in HEIGHTS:
            segment, by_kind = models(name)
            points, master = slaves(segment, 200), np.broadcast_to(np.array(SEGMENTS[segment], float), (200, *np.shape(SEGMENTS[segment])))
            results = {kind: model.evaluate(points, master, "gap residual tangent", start=points[:, :-1]) for kind, model in by_kind.items()}
            for kind, result in results.items():
                for array in ("gap", "residual", "tangent"):
                    wanted = result[array]
                    np.testing.assert_allclose(results["generated"][array], wanted, rtol=0, atol=1e-12 * np.abs(wanted).max(), err_msg=f"{name}, {kind}, {array}")

    def test_parameters_are_read_from_the_callers_memory(self):
        value = (ctypes.c_double * 1)(0.05)
        height = compiled("own", "a*sin(pi*u)", {}, parameters=["a"], data=ctypes.addressof(value))
        model = ents.Model({"segment": "line2", "height": height, "contact": {"normal": {"type": "penalty", "stiffness": 1000}}})
        for amplitude in (0.05, 0.02):
            value[0] = amplitude
            self.assertAlmostEqual(model.surface(SEGMENTS["line2"], [[0.5]])["height"][0], amplitude, 15)

    def test_mistakes_say_what_to_write(self):
        for arguments, words in ((["a*abs(u)"], "a, abs: unknown"), (["sin(u"], "is no expression"), (["u", "--constant", "a"], "NAME=NUMBER"),
                                 (["v", "--dimension", "1"], "--dimension is 1"), (["u", "--name", "jet"], "is no name"), (["__import__('os')"], "characters")):
            done = subprocess.run([sys.executable, "-m", "ents", "generate", *arguments], text=True, capture_output=True,
                                  env={**os.environ, "PYTHONPATH": folder, "PYTHONDONTWRITEBYTECODE": "1"})
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(words, done.stderr)


def measure():
    print("height    calls of   built-in  expression  generated   [ns per element, residual and tangent; median of 9]")
    for name in HEIGHTS:
        segment, by_kind = models(name)
        for count in (64, 4096):
            points, master = slaves(segment, count), np.broadcast_to(np.array(SEGMENTS[segment], float), (count, *np.shape(SEGMENTS[segment])))
            spent = {kind: [] for kind in by_kind}
            for _ in range(9):
                for kind, model in by_kind.items():
                    begin = time.perf_counter()
                    for _ in range(400):
                        model.evaluate(points, master, "residual tangent", start=points[:, :-1])
                    spent[kind].append((time.perf_counter() - begin) / 400 / count * 1e9)
            print(f"{name:9} {count:8d} " + " ".join(f"{np.median(spent[kind]) if kind in spent else float('nan'):10.0f}" for kind in ("built-in", "expression", "generated")))


if times:
    measure()
else:
    unittest.main(argv=sys.argv[:1])
