#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draw core/way.svg: the way of a slave position to an entry of the tangent, and who includes whom.

usage: way.py ROOT > core/way.svg

Stages and what they pass on are written here; the thin arrows are the #include lines of the sources, and a file that is
named has to exist. A test compares the committed picture with this one.

exit status: 0 done; 1 a file that is named does not exist, or nothing includes a folder; 2 wrong command line"""
import html
import pathlib
import re
import sys

# Folder, what it makes, files to begin with, what it passes on to the next.
STAGES = [
    ("height", "h and its derivatives at s(xi)", ["height", "formulas", "spline_height"], "h, h', h''"),
    ("surface", "rho_e = rho + h n, its derivatives, F_,xixi", ["basis", "rho", "surface_at"], "x_s - rho_e, rho_e,a, F_,xixi"),
    ("projection", "xi by Newton's method, gap and normal", ["projected_point", "projection", "search"], "xi, g, n_e"),
    ("law", "normal force, friction, wear", ["laws", "friction", "wear"], "W', W'', t_a"),
    ("tangent", "forms, expanded to vectors of dofs, and their products", ["projection_forms", "frictionless_tangent", "tangent_sum", "write_tangent"], "R_i, K_ij"),
]
ELEMENT = ["inputs", "fast_block", "general_block", "small_results"]
ABI = ["evaluate", "element_block", "element_call"]
TOP, HEIGHT, STEP, LEFT, RIGHT = 130, 64, 98, 330, 700
ORDER = [name for name, *_ in STAGES]


def includes(root):
    """(folder, another folder of which it includes a file)"""
    found = set()
    for file in [*root.glob("core/*/*.[ch]pp"), *root.glob("abi/*/*.[ch]pp")]:
        own = "abi" if file.parts[-3] == "abi" else file.parent.name
        for area, rest in re.findall(r'^ *#include "(core|abi)/([^"]+)"', file.read_text(), re.M):
            other = rest.split("/")[0] if area == "core" else "abi"
            found.add((own, other))
    return found


def check(root, folder, names):
    for name in names:
        if not list((root / folder).glob(f"{name}.[ch]pp")):
            sys.exit(f"way.py: {folder}/{name} does not exist; name another file to begin with")


class Picture:
    def __init__(self):
        self.lines = []

    def text(self, x, y, words, size=13, anchor="start", weight="normal", fill="#222"):
        self.lines.append(f'<text x="{x}" y="{y}" font-size="{size}" text-anchor="{anchor}" font-weight="{weight}" fill="{fill}">'
                          f"{html.escape(words, quote=False)}</text>")

    def box(self, x, y, width, height, fill):
        self.lines.append(f'<rect x="{x}" y="{y}" width="{width}" height="{height}" rx="6" fill="{fill}" stroke="#445"/>')

    def arrow(self, path, stroke="#223", width=1.4, more=""):
        end = "against" if stroke == "#c22" else "end"
        self.lines.append(f'<path d="{path}" fill="none" stroke="{stroke}" stroke-width="{width}" marker-end="url(#{end})"{more}/>')

    def named(self, x, y, name, what, files, wide=False):
        self.text(x, y, name, 15, weight="bold")
        self.text(x + (90 if wide else 0), y + (0 if wide else 19), what)
        self.text(x, y + (20 if wide else 37), ", ".join(files), 12, fill="#456")


def draw(root):
    included, p = includes(root), Picture()
    check(root, "abi/call", ABI)
    check(root, "core/element", ELEMENT)
    for name, _, files, _ in STAGES:
        check(root, f"core/{name}", files)
    for name in (*ORDER, "element", "numbers", "model"):
        if not any(other != name and to == name for other, to in included):
            sys.exit(f"way.py: nothing includes core/{name}")
    bottom = TOP + STEP * len(STAGES)
    p.arrow("M 120 8 V 34")
    p.text(130, 24, "ents_evaluate: x_s, x_i, state, area", fill="#223")
    p.box(40, 36, 880, 54, "#e8eef7")
    p.named(54, 58, "abi", "checks the arguments, takes elements in blocks, writes messages", ABI, wide=True)
    p.box(40, TOP, 190, bottom - TOP - STEP + HEIGHT, "#f5efdf")
    p.text(54, TOP + 24, "element", 15, weight="bold")
    for line, words in enumerate(["calls the stages in order,", "for one element, or for 4", "or 8, one in each lane", "of a register"]):
        p.text(54, TOP + 43 + 17 * line, words)
    for line, name in enumerate(ELEMENT):
        p.text(54, TOP + 120 + 17 * line, name, 12, fill="#456")
    p.arrow(f"M 120 90 V {TOP - 2}")
    for k, (name, what, files, passes) in enumerate(STAGES):
        y = TOP + STEP * k
        p.box(LEFT, y, RIGHT - LEFT, HEIGHT, "#e6f2e6")
        p.named(LEFT + 12, y + 19, name, what, files)
        if ("element", name) in included:
            p.arrow(f"M 230 {y + 24} H {LEFT - 2}", stroke="#889")
        last = k == len(STAGES) - 1
        p.arrow(f"M 515 {y + HEIGHT} V {y + STEP - 2 + (10 if last else 0)}", width=2.2)
        p.text(527, y + HEIGHT + 23, passes, 13, fill="#223")
    y = TOP + STEP * 2 + 40
    p.arrow(f"M {LEFT} {y} H {LEFT - 22} V {TOP + 44} H {LEFT - 2}", width=2.2)
    p.text(LEFT - 52, y + 16, "until xi", 12, "middle", fill="#223")
    p.text(LEFT - 52, y + 31, "is found", 12, "middle", fill="#223")
    p.text(515, bottom + 24, "to the host", 13, "middle")
    pairs = sorted(((a, b) for a in ORDER for b in ORDER if a != b and (a, b) in included), key=lambda ab: (abs(ORDER.index(ab[0]) - ORDER.index(ab[1])), ab))
    for k, (a, b) in enumerate(pairs):
        i, j, x = ORDER.index(a), ORDER.index(b), RIGHT + 26 + 24 * k
        start, end = TOP + STEP * i + 8 + 6 * j, TOP + STEP * j + 28 + 5 * i
        against = i < j
        p.arrow(f"M {RIGHT} {start} H {x} V {end} H {RIGHT + 3}", "#c22" if against else "#889", more=' stroke-dasharray="5 3"' if against else "")
    p.box(40, bottom + 40, 880, 54, "#eee")
    p.named(54, bottom + 62, "numbers", "double, dual numbers, vectors, lanes",
            ["scalar", "vec", "lanes", "elementary"], wide=True)
    p.text(500, bottom + 62, "model", 15, weight="bold")
    p.text(556, bottom + 62, "list of bases, plan, arrays of results")
    p.text(500, bottom + 82, "model, plan, results", 12, fill="#456")
    p.text(40, bottom + 118, "Thick arrows: the way of the data. Thin arrows: a folder includes files of another; red: against the order of the "
           "stages. numbers and model are included by all.", 12)
    check(root, "core/numbers", ["scalar", "vec", "lanes", "elementary"])
    check(root, "core/model", ["model", "plan", "results"])
    height = bottom + 130
    marker = ('<marker id="{}" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" orient="auto" markerUnits="userSpaceOnUse">'
              '<path d="M 0 0 L 8 4 L 0 8 z" fill="{}"/></marker>')
    return "\n".join([f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 960 {height}" font-family="sans-serif">',
                      "<defs>" + marker.format("end", "#223") + marker.format("against", "#c22") + "</defs>",
                      f'<rect width="960" height="{height}" fill="#fff"/>', *p.lines, "</svg>"])


if len(sys.argv) != 2:
    print(__doc__, file=sys.stderr)
    sys.exit(2)
print(draw(pathlib.Path(sys.argv[1])))
