# SPDX-License-Identifier: BSD-3-Clause
"""Solves the scenes of gallery.json and compares their results with exact answers."""
import argparse
import base64
import html
import json
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
STYLE = """
body { font: 16px/1.5 sans-serif; color: #222; max-width: 70rem; margin: 0 auto; padding: 1rem; }
h1 { font-size: 1.5rem; } h2 { font-size: 1.15rem; margin: 0 0 .3rem; }
.wide { overflow-x: auto; } table { border-collapse: collapse; }
th, td { text-align: left; padding: .25rem .7rem .25rem 0; border-bottom: 1px solid #ddd; vertical-align: top; white-space: nowrap; }
td.text { white-space: normal; min-width: 9rem; } .number { text-align: right; } .missed { color: #a00; font-weight: bold; }
section { margin: 2rem 0; } img { max-width: 100%; height: auto; }
"""
TITLES = ("scene", "quantity", "exact answer", "reached", "exact", "difference", "bound", "time [s]", "")
NUMBERS = (3, 4, 5, 6, 7)
HEADING = "## Every check of the gallery"
SAID = "Written by `gallery.py --readme`: the largest difference of each quantity over all steps."


def problem(text):
    """The command line or gallery.json is wrong."""
    print(f"gallery: {text}", file=sys.stderr)
    sys.exit(2)


def number(value):
    return f"{value:.4g}"


def largest(steps, check):
    """The step of the largest error: (error, quantity); None where no step has that quantity with an exact answer. Steps whose exact
    value is below check["from"] are left out."""
    key = "relative_error" if "bound" in check else "difference"
    found = []
    for step in steps:
        for quantity in step["exact"]:
            if quantity["name"] != check["quantity"] or quantity["exact"] is None or quantity["value"] is None:
                continue
            error = quantity["value"] - quantity["exact"] if key == "difference" else quantity[key]
            if error is not None and quantity["exact"] >= check.get("from", 0):
                found.append((abs(error), quantity))
    return max(found, key=lambda pair: pair[0]) if found else None


def judge(scene, check, steps, seconds):
    """A row of the table, and what is wrong with it (empty: nothing)."""
    row = [scene, check["quantity"], check["exact"]]
    bound = check.get("bound", check.get("absolute_bound"))
    worst = largest(steps, check)
    if worst is None:
        names = sorted({quantity["name"] for step in steps for quantity in step["exact"]})
        return row + ["", "", "", number(bound), seconds, "MISSED"], f"{scene}: no step has an exact \"{check['quantity']}\"; there are: {', '.join(names)}"
    error, quantity = worst
    percent = "bound" in check
    text = (lambda x: f"{100 * x:.2g} %") if percent else number
    row += [number(quantity["value"]), number(quantity["exact"]), text(error), text(bound), seconds]
    if error <= bound:
        return row + [""], ""
    return row + ["MISSED"], f"{scene}: {check['quantity']} differs by {text(error)}, bound {text(bound)}"


def label(entry):
    """Name of a scene, and of the folder of its results: that of its variant is added."""
    return "_".join([entry["scene"], *entry.get("variant", "").split()])


def solve(host, entry, folder):
    """Run one scene, or the program of an entry that takes several runs: (rows, failures, title of the scene)."""
    name, variant = label(entry), entry.get("variant")
    file = HERE / entry["scene"] / "scene.json"
    if not file.is_file():
        problem(f"\"scene\": \"{entry['scene']}\": there is no {file}")
    title = json.loads(file.read_text())["title"]
    begin = time.monotonic()
    command = [host, "run", file, *(["--variant", variant] if variant else [])]
    if "program" in entry:
        command = [sys.executable, "-B", HERE / entry["scene"] / entry["program"], host]
    done = subprocess.run([*command, "--out", folder], capture_output=True, text=True, check=False)
    seconds = f"{time.monotonic() - begin:.1f}"
    said = (done.stderr.strip() or done.stdout.strip()).splitlines() or ["nothing was printed"]
    if "fails" in entry:
        good = done.returncode == 1 and entry["fails"] in done.stderr
        row = [name, "ends with", entry["fails"], f"exit code {done.returncode}", "exit code 1", "", "", seconds, "" if good else "MISSED"]
        return [row], [] if good else [f"{name}: has to fail with \"{entry['fails']}\": exit code {done.returncode}, {said[-1]}"], title
    if done.returncode != 0:
        return [[name, "solved", "", f"exit code {done.returncode}", "exit code 0", "", "", seconds, "MISSED"]], [f"{name}: {said[-1]}"], title
    steps = json.loads((folder / "result.json").read_text())["steps"]
    if not entry.get("checks"):
        return [[name, "solved", "none", f"{len(steps)} steps", "", "", "", seconds, ""]], [], title
    judged = [judge(name, check, steps, seconds) for check in entry["checks"]]
    return [row for row, _ in judged], [wrong for _, wrong in judged if wrong], title


def markdown(rows):
    lines = ["| " + " | ".join(TITLES) + " |", "|" + "|".join("---:" if i in NUMBERS else "---" for i in range(len(TITLES))) + "|"]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def readme(rows, labels):
    """Puts these rows into the table of examples/README.md, which keeps those of other scenes; without times, which no two runs share."""
    file = HERE / "README.md"
    before, found, rest = file.read_text().partition(f"{HEADING}\n")
    if not found:
        problem(f"{file}: no heading \"{HEADING}\"")
    columns = [TITLES.index(title) for title in ("scene", "quantity", "exact answer", "difference", "bound")]
    done = {row[0] for row in rows}
    lines = [line for line in rest.splitlines() if line.startswith("| ") and line.split(" ")[1] in labels and line.split(" ")[1] not in done]
    lines += ["| " + " | ".join(row[i] for i in columns) + " |" for row in rows if row[TITLES.index("bound")]]
    lines.sort(key=lambda line: labels.index(line.split(" ")[1]))
    after = rest[rest.index("\n## "):] if "\n## " in rest else ""
    head = ["| " + " | ".join(TITLES[i] for i in columns) + " |", "|---|---|---|---:|---:|"]
    file.write_text(f"{before}{HEADING}\n\n{SAID}\n\n" + "\n".join(head + lines) + "\n" + after)


def page(rows, scenes):
    def cell(i, text, tag="td"):
        kind = "number" if i in NUMBERS else "missed" if text == "MISSED" else "text" if i in (1, 2) else ""
        return f'<{tag} class="{kind}">{html.escape(text)}</{tag}>'

    table = "".join("<tr>" + "".join(cell(i, text) for i, text in enumerate(row)) + "</tr>\n" for row in rows)
    head = "".join(cell(i, text, "th") for i, text in enumerate(TITLES))
    sections = ""
    for name, title, picture in scenes:
        if picture:
            data = base64.b64encode(picture.read_bytes()).decode()
            sections += (f'<section><h2>{html.escape(name)}: {html.escape(title)}</h2>'
                         f'<img alt="{html.escape(title)}" src="data:image/png;base64,{data}"></section>\n')
    return (f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">'
            f"<title>ents: gallery</title><style>{STYLE}</style></head><body><h1>ents: every scene against its exact answer</h1>"
            '<p>Each row shows the step with the largest difference. On a narrow screen the table scrolls sideways.</p>'
            f'<div class="wide"><table><tr>{head}</tr>\n{table}</table></div>\n{sections}</body></html>\n')


def main():
    parser = argparse.ArgumentParser(
        prog="sh examples/gallery.sh", description="Builds ents-lab, solves the scenes of examples/gallery.json and compares every result "
        "with its exact answer. Writes DIR/gallery.md, the table, DIR/index.html, one page with table and pictures, and the results of each "
        "scene in DIR/SCENE.", epilog="exit status: 0 all bounds are met; 1 one is missed, or a scene was not solved; 2 the command line or "
        "the list is wrong")
    parser.add_argument("scene", nargs="*", help="only these scenes")
    parser.add_argument("--out", type=Path, default=Path("out/gallery"), metavar="DIR", help="default: out/gallery")
    parser.add_argument("--list", type=Path, default=HERE / "gallery.json", metavar="FILE", help="default: examples/gallery.json")
    parser.add_argument("--host", type=Path, default=HERE.parent / "build/bin/ents-lab", metavar="PROGRAM", help="default: build/bin/ents-lab")
    parser.add_argument("--readme", action="store_true", help="write the rows into the table of examples/README.md, if all bounds are met")
    options = parser.parse_args()
    try:
        entries = json.loads(options.list.read_text())
    except (OSError, ValueError) as error:
        problem(f"{options.list}: {error}")
    known = [entry["scene"] for entry in entries]
    for name in options.scene:
        if name not in known:
            problem(f"no scene \"{name}\" in {options.list}; there are: {', '.join(known)}")
    if not options.host.is_file():
        problem(f"no program {options.host}: run sh examples/setup.sh --target ents-lab")
    chosen = [entry for entry in entries if not options.scene or entry["scene"] in options.scene]
    rows, failures, scenes = [], [], []
    for i, entry in enumerate(chosen):
        print(f"[{i + 1}/{len(chosen)}] {label(entry)} ...", flush=True)
        folder = options.out / label(entry)
        folder.mkdir(parents=True, exist_ok=True)
        for old in folder.glob("*.png"):
            old.unlink()
        new, wrong, title = solve(options.host, entry, folder)
        for row in new:
            print("    " + "  ".join(cell for cell in row[1:] if cell), flush=True)
        rows += new
        failures += wrong
        picture = folder / entry["picture"] if "picture" in entry else None
        scenes.append((label(entry), title, picture if picture and picture.is_file() else None))
        if picture and not wrong and not picture.is_file():
            failures.append(f"{label(entry)}: no picture {picture.name} was drawn; is matplotlib installed (Debian: python3-matplotlib)?")
    (options.out / "gallery.md").write_text(markdown(rows))
    (options.out / "index.html").write_text(page(rows, scenes))
    if options.readme and not failures:
        readme(rows, [label(entry) for entry in entries])
    for text in failures:
        print(f"MISSED {text}", file=sys.stderr)
    print(f"{options.out / 'index.html'}, {options.out / 'gallery.md'}: {len(chosen)} scenes, {len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
