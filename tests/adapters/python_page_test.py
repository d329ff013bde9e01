"""python_page_test.py FOLDER-OF-ents: the programs on the page adapters/python/README.md, run as they stand. Exit status 3: no NumPy or SciPy here."""
import contextlib
import io
import pathlib
import re
import sys
import unittest
import warnings

sys.dont_write_bytecode = True
try:
    import numpy as np
    import scipy  # noqa: F401
except ModuleNotFoundError as error:
    print(f"python_page_test.py: {error} (Debian: python3-numpy, python3-scipy)")
    sys.exit(3)
sys.path.insert(0, sys.argv[1])


class Page(unittest.TestCase):
    def test_programs(self):
        page = (pathlib.Path(__file__).resolve().parents[2] / "adapters" / "python" / "README.md").read_text()
        first, second = re.findall(r"```python\n(.*?)```", page, re.S)
        names, printed = {}, io.StringIO()
        with warnings.catch_warnings(), contextlib.redirect_stdout(printed):
            warnings.simplefilter("error")
            exec(first, names)
            contact, u = names["contact"], names["u"]
            # The springs carry what the contact does.
            self.assertAlmostEqual(5.0 * u[1::2].sum(), -contact.residual[1::2].sum(), delta=1e-8)
            exec(second, names)
        lines = printed.getvalue().splitlines()
        self.assertEqual(len(lines), 6)
        forces = [float(line.split()[2]) for line in lines]
        self.assertTrue(0 == forces[0] < forces[-1] and forces == sorted(forces))
        self.assertEqual(names["load"], 1)
        force = names["K"] @ names["u"] + names["contact"].residual - names["force"]
        self.assertLess(np.abs(force).max(), 1e-9)

    def test_a_step_without_convergence_is_not_committed(self):
        page = (pathlib.Path(__file__).resolve().parents[2] / "adapters" / "python" / "README.md").read_text()
        first = re.findall(r"```python\n(.*?)```", page, re.S)[0]
        self.assertIn("range(30)", first)
        with self.assertRaisesRegex(RuntimeError, "no convergence at y = -0.05"):
            exec(first.replace("range(30)", "range(1)"), {})

    def test_lines(self):
        page = (pathlib.Path(__file__).resolve().parents[2] / "adapters" / "python" / "README.md").read_text()
        self.assertFalse([line for line in page.splitlines() if len(line) > 120 and not line.startswith("|")])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
