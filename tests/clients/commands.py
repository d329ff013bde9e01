#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""commands.py ROOT BUILD SCRATCH [--list]: the commands of the READMEs are run as they stand there.

SCRATCH becomes a folder with links to the folders of ROOT and to BUILD, so that what a command writes stays in it. Every command has
to end with exit status 0 and to print something. Not run: those that LONG names, with the reason; set-up, installation and
ctest; usage lines with [options]; programs that are not built, and those that are not installed (exit status 3). Commands of a
user's own files get those of INSTEAD and FILES; runs of FIRST_STEP stop after their first step. Files that a command names exist, also of
those that are not run. --list prints the commands and the seconds that each has taken.

examples/setup.sh has to install every package that a Python program of examples/ and adapters/ imports, but for those of OTHER_PROGRAMS.

Exit status: 0 all commands that can be run are right; 1 one fails, or a package is not installed; 2 wrong command line."""
import ast
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

FOLDERS = ("core", "abi", "adapters", "examples", "tests")
LONG = {  # a part of a command: why it is not run
    "ents-lab chart": "minutes; host_chart_test runs it with --quick",
    "mechanics_tests": "tests of this build", "laws_tests": "tests of this build", "host_scenes_test": "tests of this build",
    "host_chart_test": "tests of this build", "host_crash_test": "tests of this build", "promises_test": "tests of this build",
    "host_friction_test": "tests of this build", "adapters_scenes_table": "half an hour",
    "mutations.py": "minutes", "compare_peers.py": "a test of its own", "deck_syntax_test.py": "a test of its own", "deck_cubes_test.py": "a test of its own", "curved.py": "half an hour", "_block.py": "tests of their own",
    "ents-deck run": "adapters.deck_run does, with the ccx that adapters.calculix builds", "joint.py": "bolted_joint_test.py runs it with --quick", "torque.py": "minutes", "public/run.py": "public.* run its rows",
    "run.sh": "tests of their own", "compare_hosts.sh": "a test of its own", "quickstart.sh": "builds", "rough_afm/scene.json --out": "package.debian runs it", "gallery.sh": "minutes",
    "setup.sh": "builds", "-m venv": "prints nothing; package.wheel installs into an environment", "max_total_time": "an hour", "ents-bench": "measures, for minutes",
    "westergaard/scene.json --compare": "that of hertz2d is run; Convergence.Westergaard solves it", "texture/scene.json --compare": "that of hertz2d is run",
    "theory_test.py": "core.theory", "python/hertz.py": "adapters.python.hertz",
    "wavy3d/scene.json --compare": "minutes", "hertz3d/scene.json --compare": "minutes", "thread/scene.json --compare": "minutes",
    "--variant fine": "a minute of boundary elements; the gallery runs it", "--variant layer": "a minute of boundary elements; LayerBody.* runs some", "variants examples/cattaneo": "a minute; that of hertz2d is run",
    "area_bounds.py": "minutes; host.area_bounds runs it with --quick",
    "rough_afm/below.py": "minutes; Below.* runs two of its cases on a part of the scan", "ents-lab sublaw": "a minute; Below.SublawWritesThePartOfAModel runs one",
    "adhesion.py": "minutes, for the gallery; Adhesion.* has its cases",
    "rough/rough.py": "minutes, for the gallery", "running_in.py": "half a minute, for the gallery", "drum.py": "for the gallery",
    "sheet/sheet.py": "a minute, for the gallery", "--variant below": "Below.* runs such scenes",
    "rough_afm/cut_off.py": "minutes; RemovedWaves.* runs one of its cases on a part of the scan",
    "ridges/polar.py": "24 runs, for the gallery", "sheet/friction.py": "a minute, for the gallery",
    "screw/": "minutes; RigidBody.AScrewHasItsTorque turns it a little", "rough_afm/scene.json --variant block": "minutes, for the gallery", "ENTS_": "a longer run of a test",
}
FIRST_STEP = [f"{scene}/scene.json" for scene in ("cattaneo_mindlin", "wear_cylinder", "hertz3d", "ironing", "wavy3d", "westergaard")]  # tests solve all steps
INSTEAD = {"examples/SCENE/": "examples/hertz2d/", "out/SCENE": "out/hertz2d"}
STATUS = {"ents-lab run examples/chatter/scene.json": 1}  # its README: this scene does not converge
OTHER_PROGRAMS = {"getfem", "dolfinx", "mpi4py", "petsc4py", "ufl",  # finite element programs: their files say so and end with status 3
                  "sympy"}  # python3 -m ents generate, which names it
DECK = """*NODE, NSET=NLOW
1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n5, 0., 0., 1.\n6, 1., 0., 1.\n7, 1., 1., 1.\n8, 0., 1., 1.
*NODE, NSET=NHIGH
11, .1, .1, 1.\n12, .9, .1, 1.\n13, .9, .9, 1.\n14, .1, .9, 1.\n15, .1, .1, 2.\n16, .9, .1, 2.\n17, .9, .9, 2.\n18, .1, .9, 2.
*ELEMENT, TYPE=C3D8, ELSET=LOW
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELEMENT, TYPE=C3D8, ELSET=HIGH
2, 11, 12, 13, 14, 15, 16, 17, 18
*SURFACE, NAME=MASTER
LOW, S2
*SURFACE, NAME=SLAVE
HIGH, S1
*MATERIAL, NAME=M
*ELASTIC
1000., .3
*SOLID SECTION, ELSET=LOW, MATERIAL=M
*SOLID SECTION, ELSET=HIGH, MATERIAL=M
*SURFACE INTERACTION, NAME=I
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
1e6
*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE
SLAVE, MASTER
*STEP, NLGEOM
*STATIC
*BOUNDARY
NLOW, 1, 3
NHIGH, 3, 3, -0.001
*END STEP
"""
FILES = {"job.inp": DECK, "scan.json": '{"height": {"type": "sine", "amplitude": 0.001, "wave_vector": [1, 1]}}\n'}


def commands_of(file):
    """Lines of indented code, and code within prose, that are commands of a user who stands in the top folder."""
    found, fenced = [], False
    for line in file.read_text().splitlines():
        if line.startswith("```"):
            fenced = not fenced
        elif line.startswith("    ") and not fenced:
            found.append(line.split("   #")[0].split(" # ")[0].strip())
    found += [re.sub(r"\s+", " ", code) for code in re.findall(r"`([^`]+)`", file.read_text())]
    return [c for c in found if re.match(r"(build/bin/|/usr/bin/python3 |python3 (adapters|examples|tests)/|sh (adapters|examples|tests)/)\S*", c)
            and (" " in c or "_test" in c)]


def absent_files(command, root):
    """Files below the folders of the project that a command names and that are not there."""
    words = [word for word in re.findall(r"\S+", command) if re.match(rf"({'|'.join(FOLDERS)})/[\w./*-]+$", word)]
    return [word for word in words if not any(root.glob(word))]


def reason_to_leave_out(command, build):
    if re.search(r"\[|\.\.\.|\b(?!ENTS)[A-Z]{4,}(?!\w*,)\b(?!/)|MODEL\.json|\bDIR\b", command.replace("SLAVE,MASTER", "").replace("--pair", "")):
        return "a usage line"
    for part, reason in LONG.items():
        if part in command:
            return reason
    program = re.match(r"build/bin/([\w-]+)", command)
    if program and not (build / "bin" / program[1]).exists():
        return f"{program[1]} is not built"
    return ""


def not_in_setup(root):
    """What the programs import and examples/setup.sh does not install."""
    packages = re.search(r"^packages='([^']*)'", (root / "examples/setup.sh").read_text(), re.MULTILINE)[1].split()
    files = [file for folder in ("examples", "adapters") for file in (root / folder).rglob("*.py")]
    own = {file.stem for file in files} | {file.parent.name for file in files}
    missing = []
    for file in sorted(files):
        for node in ast.walk(ast.parse(file.read_text())):
            names = [name.name for name in node.names] if isinstance(node, ast.Import) else []
            if isinstance(node, ast.ImportFrom) and node.level == 0:
                names = [node.module]
            for name in sorted({name.split(".")[0] for name in names} - own - OTHER_PROGRAMS - sys.stdlib_module_names):
                if f"python3-{ {'mpl_toolkits': 'matplotlib'}.get(name, name)}" not in packages:
                    missing.append(f"{file.relative_to(root)}:{node.lineno}: imports {name}, which examples/setup.sh does not install")
    return missing


def main(arguments):
    if len(arguments) not in (3, 4) or arguments[3:] not in ([], ["--list"]):
        print(__doc__, file=sys.stderr)
        return 2
    root, build, scratch = (pathlib.Path(a).resolve() for a in arguments[:3])
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir(parents=True)
    for folder in FOLDERS:
        (scratch / folder).symlink_to(root / folder)
    (scratch / "build").symlink_to(build)
    for name, text in FILES.items():
        (scratch / name).write_text(text)
    environment = dict(os.environ, ENTS_LIBRARY=str(build / "lib" / "libents.so"), PYTHONDONTWRITEBYTECODE="1")
    readmes = [root / "README.md", *sorted(path for folder in FOLDERS for path in (root / folder).rglob("README.md"))]
    seen, left_out, failed, run = {}, {}, not_in_setup(root), 0
    for readme in readmes:
        for command in commands_of(readme):
            for own, other in INSTEAD.items():
                command = command.replace(own, other)
            if command in seen:
                continue
            seen[command] = readme.relative_to(root)
            if reason_to_leave_out(command, build) != "a usage line":
                failed += [f"{seen[command]}: {command}: there is no {file}" for file in absent_files(command, root)]
            reason = reason_to_leave_out(command, build)
            if reason:
                left_out.setdefault(reason, []).append(command)
                continue
            begin = time.monotonic()
            short = " --last-step 1" if re.match(r"build/bin/ents-(host|lab) run", command) and any(scene in command for scene in FIRST_STEP) else ""
            try:
                done = subprocess.run(command + short, shell=True, cwd=scratch, env=environment, stdin=subprocess.DEVNULL, capture_output=True,
                                      text=True, timeout=300)
            except subprocess.TimeoutExpired:
                failed.append(f"{seen[command]}: {command}: more than 300 s")
                continue
            if "--list" in arguments:
                print(f"{time.monotonic() - begin:6.1f} s  {command}", flush=True)
            said = (done.stdout + done.stderr).strip().splitlines()
            expected = next((status for part, status in STATUS.items() if part in command), 0)
            if done.returncode == 3 or (said and said[-1].startswith("ModuleNotFoundError")):
                left_out.setdefault(said[-1] + ": not installed", []).append(command)
            elif done.returncode != expected or not done.stdout.strip():
                failed.append(f"{seen[command]}: {command}: exit status {done.returncode}\n{(done.stdout + done.stderr)[-1000:]}")
            else:
                run += 1
    for reason, of_it in left_out.items():
        if "--list" in arguments or "is not built" in reason or "not installed" in reason:
            print(f"not run: {'; '.join(of_it)} ({reason})")
    print(f"{run} commands of READMEs run, {sum(map(len, left_out.values()))} left out, {len(failed)} failed")
    print("\n".join(failed), file=sys.stderr)
    return 1 if failed or run < 20 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
