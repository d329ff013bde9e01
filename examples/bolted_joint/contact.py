# SPDX-License-Identifier: BSD-3-Clause
"""The contact elements of a job that ents-deck has made: their areas, and the forces that they carry."""
import json
import os
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "adapters/python"))


def elements_of(folder, job):
    """{element: its nodes, slave first} of the user elements in the deck."""
    out, inside, line_so_far = {}, False, ""
    for line in (folder / f"{job}.inp").read_text().splitlines():
        if line.startswith("*"):
            inside = line.upper().startswith("*ELEMENT") and "TYPE=U1E" in line.upper()
        elif inside:
            line_so_far += line.strip()
            if not line_so_far.endswith(","):
                words = [int(word) for word in line_so_far.split(",")]
                out[words[0]], line_so_far = words[1:], ""
    return out


def tables(folder):
    """(file, lines) of ents_k.txt."""
    return [(file, file.read_text().splitlines()) for file in sorted(folder.glob("ents_[0-9]*.txt"))]


def set_areas(folder, job, areas):
    """ents-deck takes areas from the slave's faces; here {slave node: area}."""
    elements, found = elements_of(folder, job), set()
    for file, lines in tables(folder):
        out = []
        for line in lines:
            if not line.startswith("#"):
                element, _, rest = line.split(" ", 2)
                slave = elements[int(element)][0]
                found.add(slave)
                line = f"{element} {areas[slave]!r} {rest}"
            out.append(line)
        file.write_text("\n".join(out) + "\n")
    if found != set(areas):
        raise ValueError(f"{len(set(areas) - found)} nodes of the thread have no contact element")


def forces(folder, job, positions, library):
    """{slave node: (force on the bolt, gap)} at these positions, by the library."""
    os.environ["ENTS_LIBRARY"] = str(library)
    import ents  # noqa: PLC0415, the environment tells it which library
    elements, out = elements_of(folder, job), {}
    for file, lines in tables(folder):
        model = ents.Model(json.loads(file.with_suffix(".json").read_text()))
        for line in lines:
            if line.startswith("#"):
                continue
            words = line.split()
            nodes = np.array(elements[int(words[0])]) - 1
            s = np.array([float(word) for word in words[2:]]).reshape(1, -1, 2)
            result = model.evaluate(positions[nodes[:1]], positions[nodes[1:]][None], "gap residual", surface_coordinates=s, area=[float(words[1])])
            if result["status"][0] != 0:
                raise ValueError(f"element {words[0]} has no projection, status {result['status'][0]}")
            out[int(nodes[0]) + 1] = result["residual"][0][:3], float(result["gap"][0])
    return out
