#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""theory_citations.py ROOT: sections of abi/manual/theory.md that sources, READMEs and the page itself cite are headings of it.

citations   "theory section 3", "theory.md, section 3.2", "sections 3, 4 and 5.1 of abi/manual/theory.md"; over ends of comment lines, too
page        its headings are numbered without a gap; the sections that it cites itself, as "section 3.2", exist
table       the last table names every file of core/tangent; files and sections in it exist

exit status: 0 all exist; 1 not so, and what is wrong is listed"""
import pathlib
import re
import sys

FOLDERS = ("core", "abi", "adapters", "tests", "examples")
SOURCES = {".cpp", ".hpp", ".h", ".c", ".f", ".f90", ".py", ".sh", ".md", ".txt", ".in", ".cmake"}
GAP = r"(?:[\s,()\[\]`*#]|//)+"  # blanks, ends of comment lines
LIST = rf"(\d+(?:\.\d+)*(?:(?:,|,?{GAP}(?:and|to))?{GAP}\d+(?:\.\d+)*(?![\d%]))*)"
CITATION = re.compile(rf"theory(?:\.md)?{GAP}sections?{GAP}{LIST}|sections?{GAP}{LIST}{GAP}of{GAP}(?:abi/manual/)?theory\.md", re.I)
OWN = re.compile(rf"\bsections?{GAP}{LIST}")


def main():
    root = pathlib.Path(sys.argv[1])
    page = root / "abi" / "manual" / "theory.md"
    text, mistakes, cited = page.read_text(), [], 0
    headings = re.findall(r"^##+ (\d+(?:\.\d+)*) \S", text, re.M)
    order = [[int(number) for number in heading.split(".")] for heading in headings]
    for before, after in zip([[0], *order], order):
        follows = [before + [1]] + [before[:k] + [before[k] + 1] for k in range(len(before))]
        if after not in follows:
            mistakes.append(f"{page}: heading {'.'.join(map(str, after))} follows {'.'.join(map(str, before))}")

    def check(file, content, pattern):
        count = 0
        for match in pattern.finditer(content):
            line = content.count("\n", 0, match.start()) + 1
            for number in re.findall(r"\d+(?:\.\d+)*", next(group for group in match.groups() if group)):
                count += 1
                if number not in headings:
                    mistakes.append(f"{file.relative_to(root)}:{line}: cites section {number}, which {page.relative_to(root)} does not have")
        return count

    files = [file for folder in FOLDERS for file in sorted((root / folder).rglob("*")) if file.suffix in SOURCES and file.is_file()]
    for file in [root / "README.md", *files]:
        if file != page and file.name != pathlib.Path(__file__).name:
            count = check(file, file.read_text(errors="replace"), CITATION)
            cited += 0 if file.name.startswith("theory_") else count
    own = check(page, text, OWN)
    rows = re.findall(r"^\| `([\w/.]+)` \|[^|]*\| ([^|]*) \|$", text[text.rfind("\n## "):], re.M)
    named = {file for file, _ in rows}
    for file, sections in rows:
        if not (root / file).is_file():
            mistakes.append(f"{page}: its last table names {file}, which does not exist")
        mistakes += [f"{page}: its last table gives {file} section {number}, which does not exist"
                     for number in re.findall(r"[\d.]+", sections) if number not in headings]
    tangents = {f"core/tangent/{file.name}" for file in (root / "core" / "tangent").iterdir()}
    mistakes += [f"{page}: its last table has no row for {file}" for file in sorted(tangents - named)]
    if not cited:
        mistakes.append(f"{root}: no citation of {page.name} was found: is the pattern of this test still that of the comments?")
    print(*mistakes, sep="\n", end="\n" if mistakes else "")
    print(f"{len(headings)} headings, {cited} citations in {len(files) + 1} files, {own} in the page itself, {len(rows)} rows of its last table")
    return 1 if mistakes else 0


if __name__ == "__main__":
    sys.exit(main())
