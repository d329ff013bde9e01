# SPDX-License-Identifier: BSD-3-Clause
"""The same two bodies as a deck: ccx's own contact, and contact elements that ents-deck makes of it, in the same ccx (build/calculix/ccx_ents)."""
import re
import shutil
import subprocess

import numpy as np

from rows import NotHere


def faces_of(body, nodes):
    """(cell, face number from 1) of the cells' faces whose corners all are in `nodes`."""
    inside = np.isin(body.cells, nodes)
    return [(cell, face + 1) for cell in range(len(body.cells)) for face in range(4) if inside[cell, face] and inside[cell, (face + 1) % 4]]


def deck(low, high, materials, slave, master, stiffness, held, steps, friction=None, axisymmetric=False, plane_stress=False, watched=()):
    """Text of a deck (ccx reads 20 characters of a number): the lower body's nodes first. slave: nodes of the lower body, master: of the upper one (counted there). held: [(nodes, axis)] of both
    together; steps: lists of lines that each belong to one *STEP; watched: nodes whose U is printed."""
    kind = "CAX" if axisymmetric else "CPS" if plane_stress else "CPE"
    n, lines = len(low.positions), ["*NODE, NSET=ALL"]
    lines += [f"{k + 1}, {x:.13g}, {y:.13g}" for k, (x, y) in enumerate(np.vstack([low.positions, high.positions]).tolist())]
    sets = [(low, "LOW", 0, 0, slave, "SLAVE"), (high, "HIGH", n, len(low.cells), master, "MASTER")]
    for body, name, nodes, cells, *_ in sets:
        lines.append(f"*ELEMENT, TYPE={kind}{body.cells.shape[1]}, ELSET={name}")
        lines += [", ".join(map(str, [cells + k + 1, *(cell + nodes + 1).tolist()])) for k, cell in enumerate(body.cells)]
    for body, name, _, cells, on, surface in sets:
        lines += [f"*SURFACE, NAME={surface}", *[f"{cells + cell + 1}, S{face}" for cell, face in faces_of(body, on)]]
    for (_, name, *_), (young, poisson) in zip(sets, materials):
        lines += [f"*MATERIAL, NAME=M{name}", "*ELASTIC", f"{young!r}, {poisson!r}", f"*SOLID SECTION, ELSET={name}, MATERIAL=M{name}"]
    lines += ["*SURFACE INTERACTION, NAME=I", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{stiffness!r}"]
    if friction:
        lines += ["*FRICTION", f"{friction!r}, {stiffness!r}"]
    lines += ["*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE", "SLAVE, MASTER", "*BOUNDARY"]
    lines += [f"{node + 1}, {axis + 1}, {axis + 1}" for nodes, axis in held for node in nodes]
    lines += ["*NSET, NSET=WATCHED", *[f"{node + 1}," for node in watched]]
    for step in steps:
        lines += ["*STEP, NLGEOM, INC=1000", *step, "*NODE PRINT, NSET=WATCHED", "U", "*END STEP"]
    return "\n".join([*lines, ""])


def displacements(dat):
    """The last U of every node that ccx has printed: {node from 0: (x, y)}."""
    last = dat.read_text().split("displacements (vx,vy,vz)")[-1]
    return {int(node) - 1: (float(x), float(y)) for node, x, y in re.findall(r"^\s+(\d+)\s+(\S+)\s+(\S+)\s+\S+$", last, re.MULTILINE)}


def both(check, name, text):
    """(displacements by ents-deck, displacements by ccx's own contact) of the watched nodes."""
    if not check.programs.ccx.exists():
        raise NotHere(f"{check.programs.ccx} is not here: sh adapters/calculix/run.sh --only-build")
    folder = check.programs.folder / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "job.inp").write_text(text)
    ours = subprocess.run([check.programs.deck, "run", "job.inp", "--ccx", check.programs.ccx, "--no-pictures"], cwd=folder, capture_output=True, text=True,
                          check=False)
    if ours.returncode:
        raise RuntimeError(f"ents-deck run: {(ours.stderr.strip() or ours.stdout.strip())[-400:]}")
    own = subprocess.run([check.programs.ccx, "job"], cwd=folder, capture_output=True, text=True, check=False)
    if own.returncode:
        raise RuntimeError(f"ccx's own contact: {own.stdout.strip()[-400:]}")
    return displacements(folder / "job_ents/job.dat"), displacements(folder / "job.dat")
