#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Public mistakes of other contact codes, run with this library: the right value against ours.

usage: run.py [--build FOLDER] [--list | --page | --write] [ROW or GROUP ...]

Without names: all rows. A GROUP is a file of this folder (surfaces, friction ...). The last column is the largest error and its tolerance.

  --build FOLDER  the build tree: bin/ents-lab, bin/ents-deck, lib/libents.so [build]
  --list          names of groups and rows
  --page          only compare README.md with the rows: each has its line there, and no other has one
  --write         after the run, write what came out into the lines of README.md

exit status: 0 all rows right; 1 a row is wrong; 2 wrong command line; 3 NumPy, SciPy or the library is missing"""
import argparse
import importlib
import os
import pathlib
import shutil
import sys
import tempfile
import traceback

HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parents[1]
GROUPS = ["surfaces", "friction", "geometry", "programs", "bodies", "benchmarks", "decks"]
sys.dont_write_bytecode = True


class Programs:
    """Where programs and scratch files are."""

    def __init__(self, build, folder):
        self.host, self.deck, self.ccx = build / "bin/ents-lab", build / "bin/ents-deck", build / "calculix/ccx_ents"
        self.folder = pathlib.Path(folder)


def command_line():
    if sys.argv[1:] in (["-h"], ["--help"]):
        sys.exit(print(__doc__))
    parser = argparse.ArgumentParser(usage=__doc__.splitlines()[2].removeprefix("usage: "), add_help=False)
    parser.add_argument("--build", type=pathlib.Path, default=TOP / "build")
    for flag in ("--list", "--page", "--write"):
        parser.add_argument(flag, action="store_true")
    parser.add_argument("names", nargs="*")
    return parser, parser.parse_args()


def load(build):
    """The groups; exit status 3 where something they need is missing."""
    os.environ.setdefault("ENTS_LIBRARY", str(build / "lib/libents.so"))
    sys.path[:0] = [str(HERE), str(TOP / "adapters/python"), str(TOP / "examples")]
    try:
        import ents
        import scipy  # noqa: F401
        ents.library()
    except (ImportError, RuntimeError, OSError) as error:
        print(f"run.py: {error} (Debian: python3-numpy python3-scipy, for /usr/bin/python3; build the library first)")
        sys.exit(3)
    for group in GROUPS:
        importlib.import_module(group)


def run(row, programs):
    """(checks of a row, CPU seconds); an exception is a check that fails."""
    from rows import Checks, NotHere
    checks, before = Checks(programs), os.times()
    try:
        row.function(checks)
    except NotHere as error:
        checks.found.clear()
        checks.missing = str(error)
    except (Exception, SystemExit) as error:  # noqa: BLE001: the other rows run all the same
        place = traceback.extract_tb(error.__traceback__)[-1]
        checks.true(f"{pathlib.Path(place.filename).name}:{place.lineno}", "no error", f"{type(error).__name__}: {error}".replace("\n", " "), False)
    after = os.times()
    return checks, sum(after[:4]) - sum(before[:4])


def show(row, checks, seconds):
    found = checks.found
    if checks.missing:
        print(f"not run  {row.name}: {checks.missing}", flush=True)
        return True
    good = all(check[-1] for check in found)
    print(f"{'right' if good else 'WRONG'}  {row.name}: {row.cells[0]} ({row.cells[1]})  {seconds:.1f} s", flush=True)
    for quantity, right, ours, error, tolerance, ok in found:
        mark, bound = "  " if ok else "->", "" if error is None else f"{error:.1e} of {tolerance:.1e}"
        print(f"   {mark} {quantity:46.46} {right:>28.28}  {ours if error is None and not ok else ours[:80]:28} {bound}")
    return good


def summary(found):
    """Ours in one cell: the quantity that is nearest to its tolerance."""
    if not all(check[-1] for check in found):
        return "**wrong**: " + "; ".join(f"{q}: {ours[:90]}" for q, _, ours, _, _, ok in found if not ok)
    numbers = [(error / tolerance if tolerance else 0, error, q, right, ours) for q, right, ours, error, tolerance, _ in found if error is not None]
    if not numbers:
        return f"{found[-1][0]}: {found[-1][2]}"
    share, error, quantity, right, ours = max(numbers)
    return f"{quantity}: {ours} for {right}{f', off by {error:.1e}' if share else ''}"


def page_differs():
    """Rows that README.md lacks, and lines there that no row has."""
    from rows import ROWS
    text = (HERE / "README.md").read_text()
    lines = [line.split("|") for line in text.splitlines() if line.startswith("| `")]
    named = [cells[1].strip().strip("`") for cells in lines]
    wrong = [f"README.md has no line for the row {name}" for name in ROWS if name not in named]
    wrong += [f"README.md: there is no row {name}" for name in named if name not in ROWS]
    return wrong + [f"README.md: {name} has other words than its row" for name in ROWS if name in named and
                    tuple(cell.strip() for cell in lines[named.index(name)][2:5]) != ROWS[name].cells]


def main():
    parser, given = command_line()
    load(given.build.resolve())
    from rows import ROWS
    known = set(ROWS) | set(GROUPS)
    for name in given.names:
        if name not in known:
            parser.error(f"there is no row or group {name}; --list names them")
    if given.page:
        wrong = page_differs()
        print("\n".join(wrong) or f"README.md has all {len(ROWS)} rows")
        sys.exit(bool(wrong))
    chosen = [row for row in ROWS.values() if not given.names or row.name in given.names or row.group in given.names]
    if given.list:
        print("\n".join(f"{row.group:10} {row.name}" for row in chosen))
        return
    folder, missed, absent, lines, total = tempfile.mkdtemp(prefix="ents-public-"), [], [], {}, 0.0
    try:
        for row in chosen:
            checks, seconds = run(row, Programs(given.build.resolve(), pathlib.Path(folder) / row.name))
            total += seconds
            if checks.missing:
                absent.append(row.name)
            else:
                lines[row.name] = f"| `{row.name}` | {' | '.join(row.cells)} | {summary(checks.found)} |"
            if not show(row, checks, seconds):
                missed.append(row.name)
    finally:
        shutil.rmtree(folder)
    if given.write:
        page = (HERE / "README.md").read_text().splitlines()
        name_of = lambda line: line.split("`")[1] if line.startswith("| `") else None
        (HERE / "README.md").write_text("\n".join(lines.get(name_of(line), line) for line in page) + "\n")
    print(f"{len(chosen)} rows, {len(chosen) - len(missed) - len(absent)} right{', wrong: ' + ', '.join(missed) if missed else ''}"
          f"{', not run: ' + ', '.join(absent) if absent else ''}; {total:.0f} s of CPU time")
    sys.exit(bool(missed))


if __name__ == "__main__":
    main()
