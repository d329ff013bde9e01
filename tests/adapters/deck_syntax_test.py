#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Decks in Abaqus' syntax through ents-deck: how many are translated, how many are refused and why.

usage: deck_syntax_test.py [--build DIR] [--all] [FOLDER ...]

--build DIR   build folder with bin/ents-deck; with calculix/ccx_ents, decks that ccx reads as well are solved, too [build]
--all         a line for each deck, not for those alone that are wrong
FOLDER        decks (*.inp) of your own, at any depth: each has to be translated, or refused with file and line

Without FOLDER: decks of features.py, one for each feature of contact; "translated", or a part of the reason, stands there. Solved
decks: total reaction force against ccx's own contact in the same ccx, which has to agree within 0.5 %.

exit status: 0 done; 1 a deck is wrong; 3 ents-deck is missing"""
import argparse
import collections
import pathlib
import re
import shutil
import subprocess
import sys

from deck_features import DECKS

TOLERANCE = 5e-3


def translate(ents_deck, deck, program, out):
    """@return exit status, message without the folder's name"""
    shutil.rmtree(out, ignore_errors=True)
    ran = subprocess.run([ents_deck, deck, "--for", program, "--out", out, "--no-pictures"], capture_output=True, text=True, timeout=600)
    message = ran.stderr.strip().splitlines()[-1] if ran.stderr.strip() else ""
    return ran.returncode, message.replace(str(deck.parent) + "/", "").removeprefix("ents-deck: ")


def force(ccx, folder, name):
    """Length of the last total force that ccx prints; None: it does not end the job."""
    with open(folder / f"{name}.log", "w") as log:
        code = subprocess.run([ccx, name], cwd=folder, stdout=log, stderr=subprocess.STDOUT, timeout=600).returncode
    dat = folder / f"{name}.dat"
    found = re.findall(r"total force.*\n\s*\n\s*(\S+)\s+(\S+)\s+(\S+)", dat.read_text()) if code == 0 and dat.exists() else []
    return sum(float(x) ** 2 for x in found[-1]) ** 0.5 if found else None


def compare(ents_deck, ccx, deck, out):
    """@return cell of the table, agrees"""
    code, message = translate(ents_deck, deck, "calculix", out)
    if code:
        return f"for ccx refused: {message}", False
    own, ours = force(ccx, deck.parent, deck.stem), force(ccx, out, deck.stem)
    if not own or ours is None:
        return f"ccx's own {own}, ours {ours}", False
    return f"ccx's own {own:.5g}, ours {ours:.5g}, difference {abs(ours / own - 1):.1e}", abs(ours / own - 1) <= TOLERANCE


def reason(message):
    """What the decks that are refused for one reason have in common: the message without file, line and names."""
    message = re.sub(r"^.*?\.inp(:\d+)?: ", "", message)
    return re.sub(r"'[^']*'", "'...'", message)[:110]


def decks_of(arguments, work):
    """Paths, and what has to come of each: "" translated, a part of the reason, None: either."""
    if arguments.folders:
        for folder in arguments.folders:
            for path in sorted(folder.rglob("*.inp")):
                if re.search(rb"^\*\s*CONTACT", path.read_bytes(), re.I | re.M):
                    yield path.resolve(), None, False
        return
    for name, (text, expected, in_ccx) in DECKS.items():
        path = work / name / f"{name}.inp"
        path.parent.mkdir(parents=True)
        path.write_text(text)
        yield path, expected, in_ccx


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path("build"))
    parser.add_argument("--all", action="store_true")
    parser.add_argument("folders", nargs="*", type=pathlib.Path, metavar="FOLDER")
    arguments = parser.parse_args()
    build = arguments.build.resolve()
    ents_deck, ccx, work = build / "bin/ents-deck", build / "calculix/ccx_ents", build / "deck_syntax"
    if not ents_deck.exists():
        print(f"{ents_deck} is not here: sh adapters/calculix/run.sh --only-build")
        return 3
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    reasons, wrong, total, solved = collections.Counter(), 0, 0, 0
    for deck, expected, in_ccx in decks_of(arguments, work):
        code, message = translate(ents_deck, deck, "abaqus", work / "out")
        right = code == 0 and not message or code == 2 and re.match(r".*\.inp(:\d+)?: ", message)
        if expected is not None:
            right = right and (code == 0 if expected == "" else code == 2 and expected in message)
        cell = "translated" if code == 0 else f"refused: {message}"
        if code == 0 and in_ccx and ccx.exists():
            more, agrees = compare(ents_deck, ccx, deck, work / "ccx")
            solved += agrees
            right, cell = right and agrees, f"{cell}; {more}"
        total, wrong = total + 1, wrong + (not right)
        if code:
            reasons[reason(message)] += 1
        if arguments.all or not right:
            print(f"{deck.stem:28} {cell}{'' if right else '   WRONG' + (f', expected {expected!r}' if expected is not None else '')}", flush=True)
    for text, count in reasons.most_common() if arguments.all else []:
        print(f"{count:4}  {text}")
    print(f"{total} decks in Abaqus' syntax: {total - sum(reasons.values())} translated ({solved} of them solved, and as ccx's own contact), "
          f"{sum(reasons.values())} refused for {len(reasons)} reasons, {wrong} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
