#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""bolted_joint_test.py BUILD SCRATCH: examples/bolted_joint. Its theory and its cell against integrals, its meshes, what it says of jobs that failed, and
a small joint in the real ccx. Exit status 3: ccx or NumPy are not here; the rest has passed then."""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "examples/bolted_joint"
sys.path.insert(0, str(FOLDER))
try:
    import numpy as np
except ImportError:
    print("NumPy is missing (apt-get install python3-numpy)")
    sys.exit(3)

import bodies
import joint
import output
from cell import DEEP, PLANE, Cell
from joint_parts import POISSON, Joint, tooth_compliances, yamamoto


def volume(mesh):
    """Sum over the elements, each divided into tetrahedra; an element that is turned over counts as an error."""
    hexahedron = [(0, 1, 3, 4), (1, 2, 3, 6), (1, 3, 4, 6), (1, 4, 5, 6), (3, 4, 6, 7)]
    wedge = [(0, 1, 2, 3), (1, 2, 3, 4), (2, 3, 4, 5)]
    total = 0.0
    for (_, size), group in mesh.elements.items():
        x = np.array(mesh.nodes)[np.array([nodes for _, nodes in group]) - 1]
        for a, b, c, d in hexahedron if size == 8 else wedge:
            part = np.einsum("ni,ni->n", np.cross(x[:, b] - x[:, a], x[:, c] - x[:, a]), x[:, d] - x[:, a]) / 6
            if size == 8 and part.min() <= 0:
                raise AssertionError("an element is turned over")
            total += np.abs(part).sum()
    return total


class Theory(unittest.TestCase):
    def test_bending_and_shear_are_those_of_a_tapered_beam(self):
        part = Joint()
        for base, depth in ((2 * part.half_width(part.root_radius), part.pitch_radius - part.root_radius),
                            (part.pitch - 2 * part.half_width(part.diameter / 2), part.diameter / 2 - part.pitch_radius)):
            n = 100000  # the midpoint rule is off by less than 1e-9
            x = (np.arange(n) + 0.5) * depth / n
            thickness = base - 2 * x * part.tan
            moment = depth - x - part.tan * part.pitch / 4  # the radial force acts half a thickness from the middle
            bending, shear, _, _ = tooth_compliances(part, base, depth)
            self.assertAlmostEqual(bending, 12 * (1 - POISSON ** 2) * np.sum(moment * (depth - x) / thickness ** 3) * depth / n, delta=1e-8)
            self.assertAlmostEqual(shear, 6 / 5 * 2 * (1 + POISSON) * np.sum(1 / thickness) * depth / n, delta=1e-8)

    def test_yamamoto(self):
        shares, root = yamamoto(Joint())
        self.assertAlmostEqual(sum(shares), 1, delta=1e-12)
        for i in range(5):
            self.assertAlmostEqual(shares[i] / shares[5], math.cosh(root * 2.5 * (5.5 - i)) / math.cosh(root * 2.5 * 0.5), delta=1e-9)

    def test_cell_of_bodies_without_ridges(self):
        """Blocks alone: in tension they are as stiff as they are thick."""
        cell = Cell(Joint(), 1)
        above = [e for e in cell.elements if any(key[2] > 0 for key in [k for k, n in cell.number.items() if n in e])]
        cell.elements = [e for e in cell.elements if e not in above]
        used = {n for e in cell.elements for n in e}
        cell.k = cell.stiffness()
        loose = [2 * n + c for n in range(len(cell.nodes)) if n not in used for c in (0, 1)]
        cell.k[loose, loose] = PLANE
        bolt, nut = cell.plain_depths()
        self.assertAlmostEqual(bolt, 0, delta=1e-9 * DEEP)
        self.assertAlmostEqual(nut, 0, delta=1e-9 * DEEP)

    def test_cell_converges(self):
        values = []
        for fine in (1, 2):
            cell = Cell(Joint(), fine)
            values.append(cell.contact_stiffness(cell.plain_depths()))
        self.assertAlmostEqual(values[0] / values[1], 1, delta=0.06)  # and from 2 to 3: 0.8 %


class Meshes(unittest.TestCase):
    def test_volumes(self):
        """Of polygons of 16 corners, and of the thread within the accuracy of its cut ends."""
        part, area = Joint(), 8 * math.sin(math.pi / 8) / math.pi
        mesh = bodies.enriched(part, 16, 2, 8.6, 9.9)
        circles = {"HEAD": 15 ** 2 * 12.5, "PLATE": (30 ** 2 - 11 ** 2) * 40}
        whole = math.pi * sum(circles.values())
        only = bodies.Mesh()
        only.nodes = mesh.nodes
        only.elements = {key: group for key, group in mesh.elements.items() if key[0] in circles}
        self.assertAlmostEqual(volume(only) / whole, 1, delta=1e-9)  # enriched: polygons of the circles' area
        mesh = bodies.explicit(part, bodies.Fineness(16, 4, 1, 3, 2, 2.5))
        only.nodes = mesh.nodes
        only.elements = {key: group for key, group in mesh.elements.items() if key[0] in circles}
        self.assertAlmostEqual(volume(only) / whole / area, 1, delta=1e-9)
        self.assertEqual(len(mesh.surfaces["PART1"]), len(mesh.surfaces["PART24"]))
        volume(mesh)

    def test_nodes_of_the_ridge_lie_on_the_thread(self):
        part = Joint()
        mesh = bodies.enriched(part, 16, 2, 8.6, 9.9)
        model = joint.model_of(part, mesh, 9.9, 1.0)["height"]["of"]
        for q, number in enumerate(mesh.helix):
            x, y, z = mesh.nodes[number - 1]
            place = z - model[0]["offset"] - part.pitch * math.atan2(y, x) / (2 * math.pi)  # from the middle of a ridge
            place -= part.pitch * round(place / part.pitch)
            flank = mesh.facets + model[1]["value"] + (part.pitch / 4 - abs(place)) / part.tan
            self.assertAlmostEqual(flank - math.hypot(x, y), joint.CLOSED, delta=1e-9, msg=f"node {q}")
            self.assertLess(place, 0)  # the lower flank


    def test_the_model_is_the_one_that_is_shown(self):
        part, cell = Joint(), Cell(Joint(), 2)
        depths = cell.plain_depths()
        shaft, bore = joint.plain_radii(part, depths)
        mesh = bodies.enriched(part, *joint.PLAIN["enriched"], shaft, bore)
        model = joint.model_of(part, mesh, bore, cell.contact_stiffness(depths) / part.pitch)

        def numbers(value):
            return [number for item in (value.values() if isinstance(value, dict) else value) for number in numbers(item)] \
                if isinstance(value, (dict, list)) else [value]
        for own, shown in zip(numbers(model), numbers(json.loads((FOLDER / "model.json").read_text())), strict=True):
            if isinstance(own, str):
                self.assertEqual(own, shown)
            else:
                self.assertAlmostEqual(own / shown, 1, delta=1e-6)  # linear algebra of other libraries rounds differently


class Failures(unittest.TestCase):
    def test_a_job_that_stopped(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            with self.assertRaisesRegex(ValueError, "has not reached the end"):
                output.iterations(folder, "job", 2)
            rows = "\n\n 1 1 1 5 1.0 1.0 1.0\n 2 1 1U 4 1.0 0.0 1.0\n 2 1 2 4 1.5 0.5 0.5\n"
            (folder / "job.sta").write_text(rows)
            with self.assertRaisesRegex(ValueError, "has not reached the end"):
                output.iterations(folder, "job", 2)
            (folder / "job.sta").write_text(rows + " 2 2 1 3 2.0 1.0 0.5\n")
            self.assertEqual(output.iterations(folder, "job", 2), [5, 7])

    def test_lost_contact(self):
        parts = [[1.0] * 24, [1.0] * 24]
        bearings = [[-24.0, 24.0]] * 2
        self.assertEqual(len(joint.judged({}, "x", bearings, parts)["shares"]), 6)
        with self.assertRaisesRegex(ValueError, "lost its contact"):
            joint.judged({}, "x", bearings, [parts[0], [0.0] + [1.0] * 23])
        with self.assertRaisesRegex(ValueError, "bearing face"):
            joint.judged({}, "x", [[-24.0, 25.0]] * 2, parts)


if __name__ == "__main__":
    build, scratch = sys.argv[1:3]
    if not unittest.main(argv=sys.argv[:1], exit=False).result.wasSuccessful():
        sys.exit(1)
    done = subprocess.run([sys.executable, "-B", str(FOLDER / "joint.py"), "--quick", "--build", build, "--out", scratch], capture_output=True, text=True, check=False)
    print(done.stdout + done.stderr, end="")
    sys.exit(done.returncode)
