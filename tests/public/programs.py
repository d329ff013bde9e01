# SPDX-License-Identifier: BSD-3-Clause
"""Rows that ents-lab and ents-deck run."""
import json
import math
import pathlib
import re
import shutil
import subprocess

import ents
import numpy as np

import runs
from rows import row, target

SCENES = pathlib.Path(__file__).parent / "scenes"


def host(check, scene, folder, *options):
    """(result, text on both streams) of a scene: a file of scenes/, or a dictionary. All nodes are in the result."""
    place = check.programs.folder / folder
    place.mkdir(parents=True, exist_ok=True)
    file = SCENES / scene if isinstance(scene, str) else place / "scene.json"
    if not isinstance(scene, str):
        file.write_text(json.dumps(scene))
    done = subprocess.run([check.programs.host, "run", file, "--nodes", "--no-pictures", "--out", place, *options], capture_output=True, text=True,
                          check=False)
    if done.returncode:
        raise RuntimeError(f"ents-lab run {file.name} {' '.join(options)}: {done.stderr.strip() or done.stdout.strip()}")
    return json.loads((place / "result.json").read_text()), done.stdout + done.stderr


def rolling_scene():
    """The lower arc of a circle of radius 1, +- 0.6, in 24 segments. Its normal is on the left, so the nodes go to the left."""
    scene = json.loads((SCENES / "cylinder_rolls.json").read_text())
    angles = np.linspace(0.6, -0.6, 25)
    step = angles[1] - angles[0]
    angles = np.r_[angles[0] - step, angles, angles[-1] + step]
    scene["contact"]["master"]["rigid_body"].update(nodes=np.column_stack([np.sin(angles), 1 - np.cos(angles)]).tolist(),
                                                    segments=[[k, k + 1, k + 2, k + 3] for k in range(24)])
    return scene


@row("rolling", wrong="a rolling cylinder spins too fast", source="brax #78, newton #3377",
     right="omega R = v, up to the creep of elastic bodies: less than mu a / R")
def rolling(check):
    result, _ = host(check, rolling_scene(), "rolling")
    at = [(step["reference_point"]["displacement"][0], step["reference_point"]["turns"][0]) for step in result["steps"][3:]]
    # Half-width by Hertz. Carter's creep is mu a / R (1 - sqrt(1 - Q / (mu P))): at most mu a / R. The first 2 a of the way, in which the
    # contact renews itself, are left out.
    a = math.sqrt(4 * 1.38 * 0.91 / (math.pi * 1000))
    way = [x for x, _ in at]
    first = next(k for k, x in enumerate(way) if x > 2 * a)
    ratio = (at[-1][1] - at[first][1]) / (at[-1][0] - at[first][0])
    check.near("omega R / v", -1, ratio, 0.5 * a)
    steps = [(t1 - t0) / (x1 - x0) for (x0, t0), (x1, t1) in zip(at[first:], at[first + 1:])]
    # In a step of 0.0075 a node (distance 0.0083) enters or not, which jerks the turn; not more than twice the creep.
    check.near("omega R / v in each step", -1, steps, a)
    last = result["steps"][-1]
    # Newton's tolerance of 1e-10 of the forces, at the arm of 1.
    check.near("moment / force", 0, abs(last["moment"][0]) / 1.38, 1e-8)


@row("restart", wrong="results after a restart are wrong", source="MOOSE #27216", right="equal bits, with friction and a body that turns")
def restart(check):
    scene = rolling_scene()
    whole, _ = host(check, scene, "whole")
    host(check, scene, "part", "--last-step", "20")
    again, _ = host(check, scene, "part", "--restart", check.programs.folder / "part" / "checkpoint.json")

    def bare(step):
        return {key: value for key, value in step.items() if key != "wall_time"}
    same = sum(bare(a) == bare(b) for a, b in zip(whole["steps"], again["steps"]))
    check.near("steps of 44 that are the same, every digit", 44, same, 0)
    check.true("fingerprint of the state", whole["fingerprint"], again["fingerprint"], whole["fingerprint"] == again["fingerprint"])


@row("axisymmetric_pair", wrong="axisymmetric bodies are pulled together over a distance; another force when master and slave are swapped",
     source="MOOSE #11968", right="no force before contact; equal forces to 1 %")
def axisymmetric_pair(check):
    one, _ = host(check, "axisymmetric.json", "axisymmetric")
    other, _ = host(check, "axisymmetric.json", "axisymmetric_swapped", "--variant", "swapped")
    for name, result in (("ball as slave", one), ("plate as slave", other)):
        check.near(f"{name}: force before contact", 0, [step["contact_force"][1] for step in result["steps"][:2]], 0)
    forces = [np.array([abs(step["contact_force"][1]) for step in result["steps"][2:]]) for result in (one, other)]
    check.near("force swapped / force", 1, forces[1] / forces[0], 0.01)


@row("files_are_the_arrays", wrong="status or pressure in the files is 0", source="FEBio #116, #71", right="files = internal arrays, for every law")
def files_are_the_arrays(check):
    laws = ["penalty", *json.loads((SCENES / "laws.json").read_text())["variants"]]
    worst, empty, numbers = 0.0, [], {"open": 0, "stick": 1, "slip": 2, "shear limit": 3}
    for law in laws:
        result, _ = host(check, "laws.json", f"laws_{law}", *([] if law == "penalty" else ["--variant", law]))
        for step in result["steps"]:
            nodes = {**step["nodes"], "status": [numbers[word] for word in step["nodes"]["status"]]}
            for array in ("gap", "pressure", "traction", "slip", "status"):
                file = np.array(runs.vtu_values(check.programs.folder / f"laws_{law}", step["step"], "slave", array))
                inside = np.array(nodes[array], float)
                if array == "traction":  # files have three components
                    file = file.reshape(-1, 3)[:, :2].ravel()
                worst = max(worst, np.abs(file - inside).max())
        if max(nodes["pressure"]) <= 0 or max(nodes["status"]) == 0:
            empty.append(law)
    check.near(f"largest difference, {len(laws)} laws", 0, worst, 0)
    check.true("laws without pressure or status", "none", ", ".join(empty) or "none", not empty)


@row("no_opposite", wrong="a warning for every node that has no opposite", source="MOOSE #33807", right="none")
def no_opposite(check):
    result, text = host(check, "wide.json", "wide")
    alone = sum(k < 0 for k in result["steps"][-1]["nodes"]["segment"])
    warnings = len(re.findall("warning", text, re.IGNORECASE))
    check.true("slave nodes without opposite", "most of 201", str(alone), alone > 100)
    check.near("warnings", 0, warnings, 0)


def deck(extra):
    """Two C3D8 cubes, the upper one pressed on the lower one, in ccx's keywords."""
    lines = ["*NODE, NSET=NALL"]
    for base in (0, 1):
        corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
        lines += [f"{8 * base + 4 * k + i + 1}, {x}., {y}., {base + k}." for k in (0, 1) for i, (x, y) in enumerate(corners)]
    for base, name in ((0, "LOW"), (1, "HIGH")):
        lines += [f"*ELEMENT, TYPE=C3D8, ELSET={name}", ", ".join(str(n) for n in [base + 1, *range(8 * base + 1, 8 * base + 9)])]
    lines += ["*SURFACE, NAME=SLAVE", "HIGH, S1", "*SURFACE, NAME=MASTER", "LOW, S2", "*MATERIAL, NAME=M", "*ELASTIC", "1000., 0.",
              "*SOLID SECTION, ELSET=LOW, MATERIAL=M", "*SOLID SECTION, ELSET=HIGH, MATERIAL=M", "*SURFACE INTERACTION, NAME=I",
              "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", "1e5", "*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE", "SLAVE, MASTER",
              "*BOUNDARY", "1, 1, 3", "2, 2, 3", "3, 3, 3", "4, 1, 1", "4, 3, 3", "9, 1, 2", "10, 2, 2", "*STEP", "*STATIC", "*CLOAD"]
    lines += [f"{n}, 3, -0.25" for n in range(13, 17)]
    return "\n".join([*lines, *extra, "*END STEP", ""])


@row("contact_print", wrong="a deck that asks for a print of the contact kills the job", source="CalculiX #139", right="converted, or refused in words")
def contact_print(check):
    for name, extra in (("CONTACT PRINT", ["*CONTACT PRINT, SLAVE=SLAVE, MASTER=MASTER", "CF"]), ("CONTACT FILE", ["*CONTACT FILE", "CDIS, CSTR"]),
                        ("both, to the .dat and .frd files", ["*CONTACT PRINT", "CDIS", "*CONTACT FILE", "CDIS"])):
        folder = check.programs.folder / name.replace(" ", "_").replace("/", "_")
        folder.mkdir(parents=True, exist_ok=True)
        shutil.rmtree(folder / "ents", ignore_errors=True)
        (folder / "job.inp").write_text(deck(extra))
        done = subprocess.run([check.programs.deck, folder / "job.inp", "--for", "calculix", "--out", folder / "ents"], capture_output=True, text=True,
                              check=False)
        words = (done.stdout + done.stderr).strip()
        if done.returncode == 0:  # without ccx's own contact its print has nothing to print, and stops the job
            text = (folder / "ents" / "job.inp").read_text().upper()
            active = [line for line in text.splitlines() if line.startswith("*CONTACT")]
            said = text.count("IS LEFT OUT")
            check.true(name, "converted, and said", f"converted; {len(active)} keywords of contact left, {said} comments",
                       not active and "*USER ELEMENT" in text and said == sum(line.startswith("*CONTACT") for line in extra))
        else:
            check.true(name, "refused with the keyword", words[:70], done.returncode == 2 and "CONTACT" in words)


@target("patch", case="two blocks, total height 2, E = 2e6, nu = 0, squeezed by 0.1, meshes that do not match",
        source="El-Abbasi, Bathe 2001; Code_Aster SSNP121", right="pressure 1e5, displacement of the interface -0.05 everywhere (linear elements, 2D and 3D)")
def patch(check):
    for name, scene, options, axis in (("quad4", "patch2d.json", (), 1), ("tri3", "patch2d.json", ("--variant", "triangles"), 1),
                                       ("hex8", "patch3d.json", (), 2)):
        result, _ = host(check, scene, f"patch_{name}", *options)
        nodes = result["steps"][-1]["nodes"]
        # Uzawa's iteration ends at gaps of 1e-10 of the size, which the stiffness of 1e7 makes pressures of 1e-3.
        check.near(f"{name}: pressure / 1e5", 1, np.array(nodes["pressure"]) / 1e5, 1e-8)
        check.near(f"{name}: place of the interface", -0.05, np.array(nodes["position"]).reshape(-1, axis + 1)[:, axis], 2e-10)
