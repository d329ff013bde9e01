#!/usr/bin/env python3
"""comment_tables.py [ROOT]: no table in a comment has been re-wrapped.

Tables and formulas of comments state what the code computes. A formatter that fills lines up to the column limit
takes their rows for prose: the end of a row becomes the beginning of the next line, in the column of the keys.
Reported is a line of a comment that goes on with a row of a table (indented by more than one blank, or with a gap
of three blanks after its key) or with an @param, @return or @throws, although

  - it begins in the column in which that row begins, not to the right of it;
  - its first word did not fit into the row: the row is as long as the column limit allows;
  - it is no row itself: no list item, and no text in the column in which the row has its text.

A row that goes on has its next line indented, at best to the column of the text.
"""
import pathlib
import re
import sys

LIMIT = 110  # ColumnLimit of .clang-format
FOLDERS = ("core", "abi", "adapters", "examples", "tests")
BY_HAND = ("abi/ents.h",)  # no formatter has been over it: its lines are longer
COMMENT = re.compile(r"(\s*(?://[/!]?<?|\*(?!/)|/\*+))(\s*)(.*)$")
TAG = re.compile(r"@\w+ ")
BULLET = re.compile(r"(?:[-*]|\d+\.) ")
ITEM = re.compile(BULLET.pattern + r"|@\w")


def text_columns(line, gap=2):
    """Columns in which something begins after a gap of at least `gap` blanks within the comment's text."""
    comment = COMMENT.match(line)
    return {comment.start(3) + found.end() for found in re.finditer(r"(?<=\S)\s{%d,}" % gap, comment[3])}


def wrapped_rows(text):
    """Numbers of the lines that go on with a row of the line before, in the column of its key."""
    row = key_column = None  # the line before, if it is a row or goes on with one
    texts = set()            # columns of texts in the rows of this comment
    for number, line in enumerate(text.splitlines(), 1):
        comment = COMMENT.match(line)
        if not comment or not comment[3]:
            row, texts = None, set()
            continue
        column, indent, words = comment.start(3), len(comment[2]), comment[3]
        full = row is not None and len(row) <= LIMIT < len(row) + 1 + len(words.split()[0])
        if full and column == key_column and column not in texts:
            ends = re.search(r"[\w)][,;.]$", row) and not TAG.match(COMMENT.match(row)[3])
            aligned = text_columns(line) & texts
            if not ends and not aligned and not ITEM.match(words):
                yield number
        is_row = indent > 1 or BULLET.match(words) or TAG.match(words) or text_columns(line, 3)
        goes_on = row is not None and column > key_column
        if is_row and not (goes_on and (full or column in texts)):
            key_column = column
        row = line if is_row or goes_on else None
        texts |= text_columns(line) if is_row else set()
        texts |= {column + found.end() for found in [BULLET.match(words)] if found}


GOOD = """
//   penalty  W = eps g^2 / 2 and words that fill this line up to the column limit of all the sources, almost so
//   exponential  is a row of its own, since its line does not go on with the one before it, it is no
//                row that is full
//   flat   x_s - rho_e has the component zeta - h > 0 along n, which is a row that goes on in the next line: it
//          has its text here
// @param file  a text that fills this line up to the column limit, so that the next word comes in another line
//              with its indentation
// Prose that fills a line up to the column limit goes on in the next line, in the same column, as it should be
// without being reported.
"""
BAD = """
  //   flat   rho_e is a graph over the plane: n_e . n > 0, and x_s - rho_e = g n_e has the component zeta - h
  //   > 0 along n quad4, plain   rho is a graph over the plane of its middle if its normals are on the side
// shadow    C . (D2 of the ray's equations) with the covector C = b c + t_a onto^a: G = 0, P = -1, and the
// terms of a ray that turns D2xi      of the normal projection
// @param unknowns  positions of slave and master nodes, then multipliers: where `input` points. Changed and
// restored
"""


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    if list(wrapped_rows(GOOD)) or list(wrapped_rows(BAD)) != [3, 5, 7]:
        sys.exit(f"the rule is wrong: {list(wrapped_rows(GOOD))} of the good, {list(wrapped_rows(BAD))} of the bad sample")
    found = files = 0
    for path in sorted(path for folder in FOLDERS for path in (root / folder).rglob("*")):
        name = str(path.relative_to(root))
        if path.suffix in (".h", ".hpp", ".c", ".cpp") and name not in BY_HAND:
            files += 1
            for number in wrapped_rows(path.read_text()):
                found += 1
                print(f"{name}:{number}: goes on with the row above it: indent this line, or mend the table",
                      file=sys.stderr)
    print(f"{found} re-wrapped rows in the comments of {files} files")
    sys.exit(1 if found or files < 100 else 0)


main()
