#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""python3 -m ents hosts: its numbers are those of the library, and the pages of the hosts say the same of the same model."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ADAPTERS = pathlib.Path(__file__).resolve().parents[2] / "adapters"
sys.path.insert(0, str(ADAPTERS / "python"))
import ents  # noqa: E402
from ents import _hosts  # noqa: E402

CONTACT = {"normal": {"type": "penalty", "stiffness": 1e5}, "friction": {"type": "coulomb", "coefficient": 0.2, "stiffness": 1e5}}
FRICTION = {"segment": "quad4", "contact": CONTACT}
PAGES = {"Abaqus/Standard, UEL": "abaqus/uel", "Abaqus/Standard, UINTER": "abaqus/uinter", "Abaqus/Explicit": "abaqus/vuel", "Ansys": "ansys/userelem",
         "Marc": "marc/uselem", "LS-DYNA": "lsdyna/usld"}


class Hosts(unittest.TestCase):
    def test_pages_say_what_the_library_says(self):
        lines = dict(_hosts.lines(ents.Model(FRICTION)))
        for host, folder in PAGES.items():
            self.assertIn(lines[host], (ADAPTERS / folder / "README.md").read_text(), host)
        states = ents.Model(FRICTION).layout.state_size
        self.assertIn(f"    *DEPVAR\n    {states}\n", (ADAPTERS / "calculix/README.md").read_text())
        uel = (ADAPTERS / "abaqus/uel/README.md").read_text()
        self.assertIn(f"NODES=2, COORDINATES=3, PROPERTIES=3, VARIABLES={states + 9}, UNSYMM", uel)  # a rigid body

    def test_multipliers_have_a_node_and_no_place_in_explicit_programs(self):
        lines = dict(_hosts.lines(ents.Model({"segment": "line2", "contact": {"normal": {"type": "multiplier", "stiffness": 1e5}}}), 3))
        self.assertIn("NODES=6, COORDINATES=2", lines["Abaqus/Standard, UEL"])
        self.assertFalse({"Abaqus/Explicit", "Abaqus/Standard, UINTER", "LS-DYNA"} & set(lines))

    def test_heat_takes_temperatures(self):
        for segment, dofs in (("line2", "1, 2, 11"), ("quad4", "1, 2, 3, 11")):
            lines = dict(_hosts.lines(ents.Model({"segment": segment, "contact": CONTACT | {"heat": {"conductance": 3}}})))
            self.assertTrue(lines["Abaqus/Standard, UEL"].endswith(", UNSYMM; below it " + dofs), lines)
            self.assertEqual(set(lines), {"Abaqus/Standard, UEL", "Abaqus/Standard, UINTER", "CalculiX", "other hosts"})

    def test_command_line(self):
        run = lambda *words: subprocess.run([sys.executable, "-m", "ents", "hosts", *words], capture_output=True, text=True, check=False,
                                            cwd=ADAPTERS / "python")
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "ents_7.json"
            file.write_text(json.dumps(FRICTION))
            done = run(str(file))
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("4 master nodes, 9 history variables", done.stdout)
            self.assertIn("STATE VARS, 9", done.stdout)
            self.assertIn("NODES=8", run(str(file), "--slave-nodes", "4").stdout)
            self.assertEqual(run(str(file), "--slave-nodes", "0").returncode, 2)
            self.assertEqual(run(str(file.with_name("none.json"))).returncode, 1)
        self.assertEqual(run().returncode, 2)


if __name__ == "__main__":
    unittest.main()
