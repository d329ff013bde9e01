#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The pictures that ents-deck leaves: drawn with matplotlib, in space and in the plane, and what it says where there is none.

    python3 tests/adapters/deck_pictures_test.py ENTS_DECK

Exit status 3: there is no matplotlib."""
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

ENTS_DECK = sys.argv.pop(1)
ROOT = pathlib.Path(__file__).resolve().parents[2]
DECKS = {"space": ROOT / "adapters" / "deck" / "example" / "press.inp", "plane": ROOT / "tests" / "adapters" / "decks" / "geared.inp"}


def translated(deck, out, **environment):
    return subprocess.run([ENTS_DECK, deck, "--for", "calculix", "--out", out], capture_output=True, text=True, timeout=600,
                          env={**os.environ, **environment})


class Pictures(unittest.TestCase):
    def test_are_drawn(self):
        for name, deck in DECKS.items():
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                out = pathlib.Path(folder) / "it's a job"  # the shell has its own thoughts about such names
                ran = translated(deck, out)
                self.assertEqual(ran.returncode, 0, ran.stderr)
                line = next(line for line in ran.stdout.splitlines() if line.startswith("pictures"))
                for file in ("pair_1_master.vtu", "pair_1_slave.vtu", "pair_1.png"):
                    self.assertIn(str(out / file), line)
                png = (out / "pair_1.png").read_bytes()
                self.assertEqual(png[:8], b"\x89PNG\r\n\x1a\n")
                width, height = struct.unpack(">II", png[16:24])
                self.assertGreater(min(width, height), 500)
                self.assertEqual({f.suffix for f in out.glob("pair_*")}, {".vtu", ".png"})

    def test_say_what_to_install(self):
        with tempfile.TemporaryDirectory() as folder:
            package = pathlib.Path(folder) / "matplotlib"  # found before the real one
            package.mkdir()
            (package / "__init__.py").write_text("raise ImportError('none')\n")
            out = pathlib.Path(folder) / "job"
            ran = translated(DECKS["space"], out, PYTHONPATH=folder)
            self.assertEqual(ran.returncode, 0, ran.stderr)
            self.assertIn("python3-matplotlib", ran.stdout)
            self.assertIn(str(out / "pictures.py"), ran.stdout)
            self.assertTrue((out / "press.inp").exists())
            self.assertFalse((out / "pair_1.png").exists())


if __name__ == "__main__":
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        if subprocess.run(["/usr/bin/python3", "-c", "import matplotlib"], capture_output=True).returncode:
            sys.exit(3)
    unittest.main()
