# SPDX-License-Identifier: BSD-3-Clause
"""gallery.py EXAMPLES ENTS_HOST: what it says of bounds that are met and missed, and that every scene is in its list."""
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

EXAMPLES, HOST = Path(sys.argv[1]), Path(sys.argv[2])


class Gallery(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))

    def run_gallery(self, entries, *arguments):
        list_file = self.folder / "list.json"
        list_file.write_text(json.dumps(entries))
        return subprocess.run([sys.executable, EXAMPLES / "gallery.py", "--host", HOST, "--list", list_file, "--out", self.folder / "out",
                               *arguments], capture_output=True, text=True, check=False)

    def entry(self, **check):
        return {"scene": "slope", "checks": [{"quantity": "moved", "exact": "a rigid block", **check}]}

    def test_every_scene_is_listed(self):
        listed = {entry["scene"] for entry in json.loads((EXAMPLES / "gallery.json").read_text())}
        there = {file.parent.name for file in EXAMPLES.glob("*/scene.json")}
        self.assertEqual(there - listed, {"fortran_host"})  # solved by a program of its own
        self.assertEqual(listed - there, set())

    def test_the_readme_has_every_check(self):
        text = (EXAMPLES / "README.md").read_text().partition("## Every check of the gallery")[2]
        rows = {tuple(cell.strip() for cell in line.split("|")[1:4]) for line in text.splitlines() if line.startswith("| ")}
        bounds = {tuple(cell.strip() for cell in line.split("|")[1:3]): line.split("|")[5].strip() for line in text.splitlines()
                  if line.startswith("| ") and line.count("|") == 6}
        for entry in json.loads((EXAMPLES / "gallery.json").read_text()):
            label = "_".join([entry["scene"], *entry.get("variant", "").split()])
            for check in entry.get("checks", []):
                self.assertIn((label, check["quantity"], check["exact"]), rows, "run examples/gallery.py --readme")
                bound = f"{100 * check['bound']:.2g} %" if "bound" in check else f"{check['absolute_bound']:.4g}"
                self.assertEqual(bounds[label, check["quantity"]], bound, "run examples/gallery.py --readme")

    def test_a_bound_that_is_met(self):
        done = self.run_gallery([self.entry(bound=5e-5), {"scene": "chatter", "fails": "no convergence"}])
        self.assertEqual(done.returncode, 0, done.stderr)
        table = (self.folder / "out/gallery.md").read_text()
        self.assertIn("| slope | moved | a rigid block |", table)
        self.assertNotIn("MISSED", table)
        self.assertIn("chatter", (self.folder / "out/index.html").read_text())

    def test_a_bound_that_is_missed(self):
        for check in ({"bound": 1e-9}, {"absolute_bound": 1e-12}):
            done = self.run_gallery([self.entry(**check)])
            self.assertEqual(done.returncode, 1)
            self.assertIn("MISSED slope: moved differs by", done.stderr)
            self.assertIn("MISSED", (self.folder / "out/gallery.md").read_text())

    def test_a_variant_and_steps_that_do_not_count(self):
        entry = {"scene": "patch_test", "variant": "sampling3", "checks": [{"quantity": "largest pressure", "exact": "uniform", "bound": 0.02}]}
        done = self.run_gallery([entry])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("| patch_test_sampling3 | largest pressure |", (self.folder / "out/gallery.md").read_text())
        self.assertTrue((self.folder / "out/patch_test_sampling3/result.json").is_file())
        entry["checks"][0]["from"] = 1e9
        done = self.run_gallery([entry])
        self.assertEqual(done.returncode, 1)
        self.assertIn('no step has an exact "largest pressure"', done.stderr)

    def test_a_program_of_several_runs(self):
        program = self.folder / "program.py"
        entry = {"scene": "slope", "program": str(program), "checks": [{"quantity": "speed", "exact": "one", "bound": 0.02}]}
        text = f"""import sys; sys.path.insert(0, {str(EXAMPLES)!r}); import runs
arguments = runs.arguments("", "none")
runs.solve(arguments.program, runs.TOP / "examples/slope/scene.json", arguments.out / "slope")
runs.write_result(arguments.out, [[runs.quantity("speed", 1.0, 1.0)], [runs.quantity("speed", SPEED, 1.0)]])
"""
        for speed, status in (("0.99", 0), ("0.97", 1)):
            program.write_text(text.replace("SPEED", speed))
            done = self.run_gallery([entry])
            self.assertEqual(done.returncode, status, done.stderr)
        self.assertIn("MISSED slope: speed differs by 3 %", done.stderr)
        program.write_text("import sys; sys.exit('out of speed')")
        done = self.run_gallery([entry])
        self.assertEqual(done.returncode, 1)
        self.assertIn("MISSED slope: out of speed", done.stderr)

    def test_a_quantity_that_is_not_there(self):
        done = self.run_gallery([{"scene": "slope", "checks": [{"quantity": "speed", "exact": "none", "bound": 1}]}])
        self.assertEqual(done.returncode, 1)
        self.assertIn('no step has an exact "speed"; there are: friction / mu N', done.stderr)

    def test_a_scene_that_ends_otherwise(self):
        for entry in ({"scene": "chatter"}, {"scene": "slope", "fails": "no convergence"}, {"scene": "chatter", "fails": "out of memory"}):
            done = self.run_gallery([entry])
            self.assertEqual(done.returncode, 1, entry)
            self.assertIn(f"MISSED {entry['scene']}: ", done.stderr)

    def test_a_command_line_that_is_wrong(self):
        for done, text in ((self.run_gallery([], "slop"), 'no scene "slop"'), (self.run_gallery([{"scene": "none"}]), '"scene": "none"'),
                           (self.run_gallery([], "--host", "nowhere"), "no program nowhere")):
            self.assertEqual(done.returncode, 2)
            self.assertIn(text, done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
