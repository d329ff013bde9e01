#!/usr/bin/env python3
"""readmes.py ROOT BUILD: what the READMEs show is what is there; of the pages of the manual and of .github, links and commands.

listings   a fenced block of code is a part, unchanged, of a file that its README links to
links      relative links name files, and headings of READMEs
commands   programs, files, and tests that a command names exist: a filter of tests that matches none is a mistake
heights    the library accepts every height of the top README
models     the library accepts every model of a README, {"segment": ...
python     the indented Python of adapters/python/README.md prints a number
size       the top README has at most 160 lines; its lines of prose have at most 120 characters
versions   of library and contract, in the top README and the pages of the manual

BUILD has bin/ with the programs and CTestTestfile.cmake; ENTS_LIBRARY names libents.so. Exit status 3: no NumPy.
"""
import functools
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import textwrap

root, build = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
sys.path.insert(0, str(root / "adapters" / "python"))
mistakes = []
counts = dict.fromkeys(["READMEs", "listings", "links", "commands", "filters", "heights", "models", "python"], 0)
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
# python_surfaces_test.py runs the block of the first page, python_page_test.py those of the second.
RUN_ELSEWHERE = {"adapters/README.md": "python", "adapters/python/README.md": "python"}


def slug(heading):
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


def blocks(lines):
    """(number of the line, language or None for indented code, lines) of every block of code; and the lines of prose"""
    found, prose, inside = [], [], None
    for number, line in enumerate(lines, 1):
        if line.startswith("```"):
            if inside is None:
                inside = (number, line[3:].strip(), [])
                found.append(inside)
            else:
                inside = None
        elif inside:
            inside[2].append(line)
        elif line.startswith("    "):
            found.append((number, None, [line[4:]]))
        else:
            prose.append((number, line))
    return found, prose


def listing_is_shown(code, files):
    for file in files:
        text = file.read_text(errors="replace").splitlines()
        if any(text[i:i + len(code)] == code for i in range(len(text) - len(code) + 1)):
            return True
    return False


def check_link(where, folder, target):
    if re.match(r"[a-z]+:", target):
        return
    counts["links"] += 1
    path, _, anchor = target.partition("#")
    file = (folder / path).resolve() if path else where[0]
    if not file.exists():
        mistakes.append(f"{where[1]}: no such file: {target}")
        return
    if file.is_dir():
        file = file / "README.md"
    if anchor and anchor not in {slug(h) for h in re.findall(r"(?m)^#+ (.*)$", file.read_text())}:
        mistakes.append(f"{where[1]}: no such heading: {target}")


def ctest_lists(*options):
    with tempfile.TemporaryDirectory() as folder:  # in `build` it would empty LastTest.log of the ctest that runs this
        (pathlib.Path(folder) / "CTestTestfile.cmake").write_text(f'subdirs("{build}")\n')
        command = [shutil.which("ctest"), "--test-dir", folder, "-N", *options]
        return subprocess.run(command, capture_output=True, text=True).stdout


@functools.cache
def all_tests_are_built():
    return (build / "CTestTestfile.cmake").exists() and "_NOT_BUILT" not in ctest_lists()


def check_command(where, text):
    """`text` is a line of a block of commands, or code within prose."""
    for word in re.findall(r"(?<![\w./-])(?:examples|tests|adapters|abi|core)/[\w./-]+\w", text):
        if re.search(r"(^|/)[A-Z]+(/|$)", word):  # examples/SCENE/scene.json: for the reader to fill in
            continue
        counts["commands"] += 1
        if not (root / word).exists():
            mistakes.append(f"{where}: no such file: {word}")
    for program in re.findall(r"build/bin/([\w-]+)", text):
        counts["commands"] += 1
        if not re.search(rf"\b{program}\b", targets):
            mistakes.append(f"{where}: no such program: {program}")
        pattern = re.search(r"--gtest_filter='?([^'\s`]+)", text)
        if pattern and (build / "bin" / program).exists():
            counts["filters"] += 1
            listed = subprocess.run([build / "bin" / program, "--gtest_list_tests", f"--gtest_filter={pattern[1]}"],
                                    capture_output=True, text=True).stdout
            if "\n  " not in listed:
                mistakes.append(f"{where}: {program} has no test {pattern[1]}")
    option = re.search(r"^ctest .*?(-[LR]) +'?([^'\s]+)", text)
    if option and not option[2].isupper() and all_tests_are_built():
        counts["filters"] += 1
        if "Total Tests: 0" in ctest_lists(*option.groups()):
            mistakes.append(f"{where}: ctest finds no test: {text}")


def check_readme(file):
    counts["READMEs"] += 1
    name, folder = str(file.relative_to(root)), file.parent
    code, prose = blocks(file.read_text().splitlines())
    text = "\n".join(line for _, line in prose)
    linked = [folder / path for path in LINK.findall(text) if (folder / path).is_file()]
    for number, language, lines in code:
        where = f"{name}:{number}"
        if language is None:
            check_command(where, lines[0])
        elif RUN_ELSEWHERE.get(name) != language:
            counts["listings"] += 1
            if not listing_is_shown(lines, linked):
                mistakes.append(f"{where}: this listing is no part of a file that the README links to")
    for target in LINK.findall(re.sub(r"`[^`]*`", "", text)):
        check_link((file, name), folder, target)
    for command in re.findall(r"`((?:sh |build/bin/|ctest |python3 )[^`]+)`", text):
        check_command(name, command.replace("\n", " "))


def check_top(file):
    text = file.read_text()
    lines = text.splitlines()
    if len(lines) > 160:
        mistakes.append(f"README.md has {len(lines)} lines, more than 160")
    for number, line in blocks(lines)[1]:
        if len(line) > 120 and not line.startswith(("|", "![")):
            mistakes.append(f"README.md:{number}: {len(line)} characters, more than 120")
    try:
        import ents
    except ImportError as error:
        print(f"not run: {error}")
        sys.exit(3)
    for height in re.findall(r"`(\{\"type\".*?\})`", text):
        counts["heights"] += 1
        try:
            ents.Model({"segment": "quad4", "height": json.loads(height)}, directory=str(root / "examples" / "rough_afm"))
        except (ValueError, ents.Error) as error:
            mistakes.append(f"README.md: {height}: {error}")


def check_models(file):
    import ents
    text = "\n".join(line[4:] if line.startswith("    ") else "" for line in file.read_text().splitlines())
    for start in re.finditer(r'^\{"segment"', text, re.M):
        counts["models"] += 1
        try:
            ents.Model(json.JSONDecoder().raw_decode(text[start.start():])[0])
        except (ValueError, ents.Error) as error:
            mistakes.append(f"{file.relative_to(root)}: a model: {error}")


def check_python(file):
    code = re.search(r"(?m)^    import ents\n(?:    .*\n)+", file.read_text())
    program = textwrap.dedent(code[0]) if code else "raise SystemExit('there is none')"
    done = subprocess.run([sys.executable, "-B", "-c", program], env=dict(os.environ, PYTHONPATH=sys.path[0]), capture_output=True, text=True)
    counts["python"] += 1
    if done.returncode or not re.fullmatch(r"-?[0-9.]+\n", done.stdout):
        mistakes.append(f"{file.relative_to(root)}: its Python: {done.stdout}{done.stderr}")


def check_versions():
    """The pages that name a version name that of CMakeLists.txt, or the contract of ents.h."""
    library = re.search(r"VERSION (\d+\.\d+\.\d+)", (root / "CMakeLists.txt").read_text())[1]
    contract = ".".join(re.findall(r"#define ENTS_CONTRACT_M\w+ (\d+)", (root / "abi" / "ents.h").read_text()))
    for page, words in (("README.md", ("Version {library}", "contract {contract}")), ("abi/manual/cite.md", ("version {library}",)),
                        ("abi/manual/changes.md", ("({library}, `ents_version`)", "({contract},", "| {contract} |"))):
        text = (root / page).read_text()
        mistakes.extend(f"{page}: does not say \"{word}\"" for word in (w.format(library=library, contract=contract) for w in words)
                        if word not in text)


FOLDERS = ("core", "abi", "adapters", "examples", "tests")  # and nothing of a build


def sources(name):
    return [root / name, *sorted(path for folder in FOLDERS for path in (root / folder).rglob(name))]


targets = "\n".join(path.read_text() for path in sources("CMakeLists.txt"))
pages = [root / ".github" / "CONTRIBUTING.md", *(root / "abi" / "manual" / f"{name}.md" for name in ("changes", "decisions"))]
for readme in sources("README.md") + pages:
    check_readme(readme)
check_top(root / "README.md")
check_versions()
for readme in sources("README.md"):
    check_models(readme)
check_python(root / "adapters" / "python" / "README.md")
print(", ".join(f"{count} {what}" for what, count in counts.items()))
if min(count for what, count in counts.items() if what != "filters") == 0 or mistakes:
    print("\n".join(mistakes) or "nothing was checked of one kind", file=sys.stderr)
    sys.exit(1)
