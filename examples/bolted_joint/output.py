# SPDX-License-Identifier: BSD-3-Clause
"""What ccx writes: increments, contact forces, displacements, stresses; and the section of a mesh through its first column."""
import math
import re

import numpy as np


def iterations(folder, job, steps):
    """Of each step; an error unless all steps were solved to their end."""
    file = folder / f"{job}.sta"
    rows = [line.split() for line in file.read_text().splitlines()[2:]] if file.is_file() else []
    good = [row for row in rows if len(row) == 7 and row[2].isdigit()]
    if not good or abs(float(good[-1][4]) - steps) > 1e-9:
        raise ValueError(f"{folder}: ccx has not reached the end of step {steps}, see {folder / 'log'}")
    return [sum(int(row[3]) for row in good if int(row[0]) == step) for step in range(1, steps + 1)]


def contact_forces(folder, job):
    """[{slave surface: force}] of the steps, from *CONTACT PRINT."""
    lines, out = (folder / f"{job}.dat").read_text().splitlines(), {}
    for i, line in enumerate(lines):
        found = re.search(r"statistics for slave set (\w+),.*time\s+(\S+)", line)
        if found:
            out.setdefault(float(found.group(2)), {})[found.group(1)] = [float(word) for word in lines[i + 4].split()[:3]]
    return [out[time] for time in sorted(out)]


def displacements(folder, job, count):
    """[steps][nodes][3] from *NODE PRINT, which has more digits than the .frd file."""
    out, reading = [], False
    for line in (folder / f"{job}.dat").read_text().splitlines():
        words = line.split()
        if "displacements" in line:
            reading = True
            out.append(np.zeros((count, 3)))
        elif "statistics" in line:
            reading = False
        elif reading and len(words) == 4:
            out[-1][int(words[0]) - 1] = [float(word) for word in words[1:]]
    return out


def mises(folder, job, count):
    """Of the nodes in the first step."""
    out, reading, blocks = np.zeros(count), False, 0
    with open(folder / f"{job}.frd", errors="replace") as file:
        for line in file:
            if line.startswith(" -4"):
                reading = line[5:13].strip() == "STRESS"
                blocks += reading
                if blocks > 1:
                    break
            elif reading and line.startswith(" -1"):
                x, y, z, xy, yz, zx = (float(line[13 + 12 * i:25 + 12 * i]) for i in range(6))
                out[int(line[3:13]) - 1] = math.sqrt(((x - y) ** 2 + (y - z) ** 2 + (z - x) ** 2) / 2 + 3 * (xy ** 2 + yz ** 2 + zx ** 2))
            elif line.startswith(" -3"):
                reading = False
    return out


def section(mesh, values, side):
    """Quadrilaterals of a half section: x (side -1: to the left), z, value at each corner."""
    first = set()
    for key, number in mesh.number.items():
        if key[0] in ("bolt", "plate"):
            if key[2] == 0 or (key[2] == "core" and math.hypot(*mesh.nodes[number - 1][:2]) < 1e-9):
                first.add(number)
        elif key[1] == 0:
            first.add(number)
    faces = set()
    for group in mesh.elements.values():
        for _, nodes in group:
            if len(nodes) == 8:
                loops = [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
            else:
                loops = [(0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)]
            for loop in loops:
                face = [nodes[i] for i in loop]
                if all(n in first for n in face):
                    faces.add(tuple(face) if min(face) == face[0] else tuple(face[face.index(min(face)):] + face[:face.index(min(face))]))
    # The core has no faces in this plane: from the axis to its border.
    axis = sorted((mesh.nodes[n - 1][2], n) for key, n in mesh.number.items() if key[0] == "bolt" and key[2] == "core" and n in first)
    border = {round(mesh.nodes[n - 1][2], 6): n for key, n in mesh.number.items() if key[0] == "bolt" and key[2] == 0 and key[3] == 0}
    faces |= {(a, b, border[round(high, 6)], border[round(low, 6)]) for (low, a), (high, b) in zip(axis, axis[1:])}
    return [[[side * math.hypot(*mesh.nodes[n - 1][:2]), mesh.nodes[n - 1][2], values[n - 1]] for n in face] for face in sorted(faces)]
