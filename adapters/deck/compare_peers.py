#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""ccx's own test decks with *CONTACT PAIR (Debian's package calculix-ccx-test): ccx's own contact against ents-deck's user elements, in the same ccx.

usage: compare_peers.py [--build DIR] [--out DIR] [--all] [DECK ...]

--build DIR   build folder with bin/ents-deck and calculix/ccx_ents (sh adapters/calculix/run.sh --only-build) [build]
--out DIR     jobs and results go there [DIR/peers of the build folder]
--all         all 48 decks, those that are refused with their reason; else the eight that have to agree within 1 %

Both jobs of a deck get the same output requests. Displacements: largest difference of a node over the largest displacement. Forces: sum of the
differences of the reactions of all supported nodes over the sum of these reactions.

exit status: 0 the eight agree, 1 they do not, 3 ccx, its tests or the build are missing"""
import argparse
import gzip
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

TESTS = pathlib.Path("/usr/share/doc/calculix-ccx-test/examples/test")
LIMIT = 0.01
MUST_AGREE = ["contact1", "contact3", "contact4", "friction1", "hueeber1", "punch1", "contactenergy", "scheibe2f2f"]
WHY = {
    "contact1": "exponential law: equal value and slope at d = 0 only",
    "contact3": "ccx's smoothed linear law (its second constant)",
    "contact4": "quadratic faces, points in them against ccx's",
    "friction1": "points in faces against nodes (TYPE=NODE TO SURFACE)",
    "cubespring": "points in faces against nodes (TYPE=NODE TO SURFACE)",
    "scheibe2n2f": "points in faces against nodes that lie on kinks of the master; scheibe2f2f agrees",
    "punch1": "slave faces over edges of the master: ccx cuts them there",
    "punch2": "slave faces over edges of the master: ccx cuts them there",
    "thread": "slave faces that only partly lie on the master: ccx cuts them",
    "cubef2f1": "tied: 18 triangles of the slave on 64 faces of the master, held at points; cubef2f2, the sides swapped, agrees",
    "beamcontact": "slave faces half beyond the edge of the master, where all of the pressure is: it acts where a face's points are",
    "bolt": "exponential law, far from d = 0: ccx's and Abaqus's are two laws",
}


def deck_text(path):
    data = gzip.open(path).read() if path.suffix == ".gz" else path.read_bytes()
    return data.decode("latin-1")


def supports(text):
    """Sets and nodes of all *BOUNDARY."""
    names, inside = [], False
    for line in text.splitlines():
        if line.startswith("**"):
            continue
        if line.startswith("*"):
            inside = re.match(r"\*\s*BOUNDARY", line, re.I) is not None
        elif inside and line.strip():
            names.append(line.split(",")[0].strip())
    return sorted(set(names))


def with_output(text):
    """The same requests in both jobs: displacements of all nodes, total reaction."""
    first = re.search(r"^\*\s*STEP\b", text, re.I | re.M).start()
    nodes = "*NSET, NSET=PEERS\n" + "".join(f"{name},\n" for name in supports(text))
    text = text[:first] + nodes + text[first:]
    return re.sub(r"^\*\s*END\s*STEP", "*NODE PRINT, NSET=PEERS\nRF\n*NODE FILE\nU\n*END STEP", text, flags=re.I | re.M)


def displacements(path):
    """Of the last increment in a .frd file."""
    out, reading = {}, False
    for line in path.read_text(errors="replace").splitlines():
        if line.startswith(" -4"):
            reading = line[5:13].strip() == "DISP"
            if reading:
                out = {}
        elif reading and line.startswith(" -1"):
            out[int(line[3:13])] = [float(line[13 + 12 * i:25 + 12 * i]) for i in range(3)]
        elif line.startswith(" -3"):
            reading = False
    return out


def reactions(path):
    """Of the supported nodes in the last increment of a .dat file."""
    out, reading = {}, False
    for line in path.read_text(errors="replace").splitlines():
        words = line.split()
        if "forces" in line:
            reading, out = "PEERS" in line.upper(), {} if "PEERS" in line.upper() else out
        elif reading and len(words) == 4:
            out[int(words[0])] = [float(word) for word in words[1:]]
    return out


def solve(ccx, folder, job):
    begin = time.perf_counter()
    with open(folder / "log", "w") as log:
        code = subprocess.run([ccx, job], cwd=folder, stdout=log, stderr=subprocess.STDOUT, timeout=1200, env={**os.environ, "OMP_NUM_THREADS": "1"}).returncode
    seconds = time.perf_counter() - begin
    rows = [line.split() for line in (folder / f"{job}.sta").read_text().splitlines()[2:]] if (folder / f"{job}.sta").exists() else []
    accepted = [row for row in rows if len(row) >= 4 and row[2].isdigit()]
    return code, sum(int(row[3]) for row in accepted), len(accepted), seconds


def compare(name, path, build, out):
    """@return row of the table, differences or None"""
    folder = out / name
    own = folder / "ents"
    shutil.rmtree(own, ignore_errors=True)
    folder.mkdir(parents=True, exist_ok=True)
    text = deck_text(path)
    deck = folder / f"{name}.inp"
    deck.write_text(text, encoding="latin-1")
    made = subprocess.run([build / "bin/ents-deck", deck, "--for", "calculix", "--out", own, "--no-pictures"], capture_output=True, text=True)
    (folder / "ents-deck.log").write_text(made.stdout + made.stderr)
    if made.returncode:
        reason = made.stderr.strip().replace("ents-deck: ", "").replace(str(folder) + "/", "")
        return f"{name:<14} refused: {reason}", None
    deck.write_text(with_output(text), encoding="latin-1")
    new = own / f"{name}.inp"
    new.write_text(with_output(new.read_text(encoding="latin-1")), encoding="latin-1")
    ccx = build / "calculix/ccx_ents"
    code, iterations, increments, seconds = solve(ccx, folder, name)
    if code:
        return f"{name:<14} ccx's own contact fails (exit {code})", None
    code, mine, my_increments, my_seconds = solve(ccx, own, name)
    if code:
        error = next((line.strip() for line in (own / "log").read_text(errors="replace").splitlines() if "ERROR" in line), "")
        return f"{name:<14} U1E fails (exit {code}): {error}", (math.inf, math.inf)
    theirs, ours = displacements(folder / f"{name}.frd"), displacements(own / f"{name}.frd")
    size = max(math.hypot(*u) for u in theirs.values())
    difference = max(math.dist(u, ours[node]) for node, u in theirs.items() if node in ours) / size
    force, my_force = reactions(folder / f"{name}.dat"), reactions(own / f"{name}.dat")
    forces = sum(math.dist(r, my_force[node]) for node, r in force.items()) / sum(math.hypot(*r) for r in force.values())
    row = (f"{name:<14} {difference:<10.1e} {forces:<10.1e} {f'{mine}/{my_increments} : {iterations}/{increments}':<17} {my_seconds:5.2f} : {seconds:<5.2f}  "
           f"{WHY.get(name, '')}")
    return row, (difference, forces)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path("build"))
    parser.add_argument("--out", type=pathlib.Path)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("decks", nargs="*")
    options = parser.parse_args()
    build = options.build.resolve()
    out = (options.out or build / "peers").resolve()
    for needed in (build / "bin/ents-deck", build / "calculix/ccx_ents", TESTS):
        if not needed.exists():
            print(f"compare_peers.py: {needed} is missing (apt-get install calculix-ccx-test; sh adapters/calculix/run.sh --only-build)", file=sys.stderr)
            return 3
    paths = {path.name.split(".")[0]: path for path in sorted(TESTS.glob("*.inp*"))}
    if options.all:
        names = [name for name, path in paths.items() if re.search(r"^\*\s*CONTACT\s*PAIR", deck_text(path), re.I | re.M)]
    else:
        names = options.decks or MUST_AGREE
    print("differences of U1E from ccx's own contact in the same ccx; U1E : ccx's own\n"
          "deck           displ.     forces     iterations/incr.  seconds        why they differ")
    ok, solved, refused, within = True, 0, 0, 0
    for name in names:
        row, difference = compare(name, paths[name], build, out)
        print(row, flush=True)
        refused += " refused: " in row
        solved += difference is not None and max(difference) < math.inf
        within += difference is not None and max(difference) <= LIMIT
        if name in MUST_AGREE:
            ok = ok and difference is not None and max(difference) <= LIMIT
    print(f"{len(names)} decks: {solved} solved, {within} of them within {LIMIT:.0%}; {refused} refused")
    if not ok:
        print(f"differences above {LIMIT:.0%}", file=sys.stderr)
    return 0 if ok else 1


sys.exit(main())
