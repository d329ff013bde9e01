#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compare what ccx (job.dat by two threads, one_thread.dat by one) and ents-lab (host/) say about the problem in a folder that make.py wrote.

usage: compare.py FOLDER

exit status: 0 they agree, 1 they do not"""
import base64
import json
import pathlib
import re
import struct
import sys
import xml.etree.ElementTree as xml

# ccx prints seven digits: half a unit of the last one of a number that begins with 1 is 5e-7 of it. Displacements are
# compared relative to the largest.
TOLERANCE = 1e-6


def ccx(file):
    """Of each increment: force on the support, displacements of the block's nodes."""
    forces, displacements, target = [], [], None
    for line in file.read_text().splitlines():
        if line.strip().startswith("total force"):
            target = forces
        elif line.strip().startswith("displacements"):
            displacements.append({})
            target = displacements[-1]
        elif line.strip() and target is forces:
            forces.append([float(word) for word in line.split()])
            target = None
        elif line.strip() and target is not None:
            words = line.split()
            target[int(words[0])] = [float(word) for word in words[1:4]]
    return forces, displacements


def nodes(folder):
    """Coordinates of the deck's nodes, by number."""
    found = {}
    for line in (folder / "block.inp").read_text().splitlines()[1:]:
        if line.startswith("*"):
            return found
        number, *x = line.split(",")
        found[int(number)] = tuple(float(value) for value in x)


def array(file, name):
    """A Float64 array of a VTU file; "Points": the positions."""
    for data in xml.parse(file).iter("DataArray"):
        if data.get("Name") == name:
            text = re.sub(r"\s", "", data.text)
            raw = base64.b64decode(text)
            header = 8 if struct.unpack("<Q", raw[:8])[0] == len(raw) - 8 else 4
            return struct.unpack(f"<{(len(raw) - header) // 8}d", raw[header:])
    sys.exit(f"{file}: no array {name}")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    forces, displacements = ccx(folder / "job.dat")
    one_thread, _ = ccx(folder / "one_thread.dat")
    steps = json.loads((folder / "host" / "result.json").read_text())["steps"]
    if not len(forces) == len(displacements) == len(steps):
        sys.exit(f"{len(forces)} increments in ccx, {len(steps)} in ents-lab")
    iterations = {}
    for line in (folder / "job.sta").read_text().splitlines():
        words = line.split()
        if len(words) >= 4 and words[0] == "1":
            iterations[int(words[1])] = int(words[3])
    print("increment  vertical force: ccx  ents-lab         difference: forces  displacements  threads   iterations ccx : host")
    mesh, worst = nodes(folder), 0
    for k, step in enumerate(steps):
        vtu = folder / "host" / f"result_bulk_{k + 1:04d}.vtu"
        points, values = array(vtu, "Points"), array(vtu, "displacement")
        at = {tuple(round(x, 9) for x in points[i:i + 3]): values[i:i + 3] for i in range(0, len(points), 3)}
        difference = max(abs(u - v) for node, x in mesh.items()
                         for u, v in zip(displacements[k][node], at[tuple(round(c, 9) for c in x)])) / max(map(abs, values))
        a, b = forces[k], step["contact_force"]
        of_force = max(abs(p - q) for p, q in zip(a, b)) / max(map(abs, b))
        of_threads = max(abs(p - q) for p, q in zip(a, one_thread[k])) / max(map(abs, b))
        worst = max(worst, of_force, of_threads, difference)
        print(f"{k + 1:9}  {a[2]:<19.7g}  {b[2]:<16.10g}  {of_force:<18.0e}  {difference:<13.0e}  {of_threads:<8.0e}  "
              f"{iterations.get(k + 1, 0)} : {len(step['increments'][0]['residuals'])}")
    print(f"worst difference {worst:.1e}, tolerance {TOLERANCE:.0e}")
    sys.exit(worst > TOLERANCE)


main()
