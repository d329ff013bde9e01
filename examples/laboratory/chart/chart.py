#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draw the charts of ents-lab chart: python3 chart.py [--no-pictures] [FOLDER], of its own folder by default.

Of FOLDER/chart.json it makes chart.html, one page with everything in it, to be read without a network; work_precision.svg;
and stability_NAME.svg and .png. Exit status 3: there is no matplotlib.
"""
import collections
import html
import io
import json
import math
import pathlib
import re
import string
import sys

import pictures
from pictures import GRID, INK, plt

FAMILIES = [  # colour (Okabe and Ito 2008 first) and marker, in the order of legends
    ("#0072b2", "o"), ("#332288", "p"), ("#56b4e9", "D"), ("#d55e00", "s"), ("#882255", "P"), ("#a8760a", "X"), ("#009e73", "^"),
    ("#e69f00", "v"), ("#cc79a7", "h")]
PRICES = {"cpu": "CPU time of the whole solve [s]", "contact_cpu": "CPU time of the contact part [s]",
          "segments": "contact segments of the master", "dofs": "dofs of block and master"}
BLUES = ["#deebf7", "#b3d3ea", "#7fb5da", "#4292c6", "#1f64a8"]  # solved, a step for each factor of four iterations from 32 on
BEFORE, DURING = "#ffe08a", "#f4a93b"  # flagged by the check, or on the way
LETTERS = ((BEFORE, "F"), (BEFORE, "E"), (BEFORE, "S"), (BEFORE, "X"), (DURING, "A"), (DURING, "B"), (DURING, "J"), (DURING, "U"))
ENDS = {}  # colour and letter of each way to be flagged, filled from chart.json
WRONG, UNJUDGED, DIVERGED = "#d00000", "#c77dff", "#8d8d8d"


def number(value, digits=2):
    """As the tables of ents-lab: fixed from 1e-3 to 1e6, else with an exponent."""
    if value == 0 or not math.isfinite(value):
        return f"{value:g}"
    value = float(f"{value:.{digits - 1}e}")
    power = math.floor(math.log10(abs(value)))
    if not -3 <= power < max(digits, 5) + 1:
        return f"{value:.{digits - 1}e}"
    return f"{value:.{max(0, digits - 1 - power)}f}"


def charted(run):
    """Has the run an error of its own, with the exact tangent?"""
    return run.get("error") is not None and run["error"] > 0 and run["tangent"] == "consistent"


def price_of(run, price):
    return run["block_dofs"] + run["master_dofs"] if price == "dofs" else run[price]


# Work-precision diagrams

def ticks(axis, percent):
    """Powers of ten; with less than two decades 2 and 5 have numbers, too."""
    low, high = axis.get_view_interval()
    digits = (1, 2, 5) if math.log10(high / low) < 2 else (1,)
    places = [d * 10.0 ** p for p in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1) for d in range(1, 10)]
    shown = [p for p in places if low <= p <= high]
    named = [p for p in shown if float(f"{p:.0e}"[0]) in digits]
    suffix, factor = (" %", 100) if percent else ("", 1)
    texts = [(f"{factor * p:.0e}" if not 0.9e-4 < factor * p < 1.1e4 else f"{factor * p:.12g}") + suffix for p in named]
    axis.set_ticks(named, texts)
    axis.set_ticks([p for p in shown if p not in named], minor=True)
    axis.set_minor_formatter(pictures.ticker.NullFormatter())


def front(runs, price):
    """Runs that no other beats in price and error together, cheapest first."""
    least, best = math.inf, []
    for run in sorted(filter(charted, runs), key=lambda run: (price_of(run, price), run["error"])):
        if run["error"] < least:
            least = run["error"]
            best.append(run)
    return best


def work_panel(axes, work, price):
    """Errors over a price; each mark has the group id mark_K, K the number of the run. A curve: one slave mesh and finer and
    finer masters; with one enriched segment, finer and finer slave meshes."""
    runs = [(k, run) for k, run in enumerate(work["runs"]) if charted(run)]
    axes.set(xscale="log", yscale="log", xlabel=PRICES[price], ylabel="error", autoscale_on=False)
    if not runs:
        return
    for axis, values in ((axes.xaxis, [price_of(r, price) for _, r in runs]), (axes.yaxis, [r["error"] for _, r in runs])):
        low, high = math.log10(min(values)) - 0.12, math.log10(max(values)) + 0.12
        middle, half = 0.5 * (low + high), max(0.5 * (high - low), 0.55)  # a decade at least, so that two tics are there
        axis.set_view_interval(10 ** (middle - half), 10 ** (middle + half), ignore=True)
        ticks(axis, axis is axes.yaxis)
    axes.grid(color=GRID, linewidth=0.8)
    axes.tick_params(which="both", direction="in", pad=6)
    if axes.get_ylim()[0] <= 0.01 <= axes.get_ylim()[1]:
        axes.axhline(0.01, color="#888888", linewidth=0.9, dashes=(5, 4))
    if work["asked"] > 0:  # shares of an error do not compete
        best = front(work["runs"], price)
        axes.step([price_of(r, price) for r in best], [r["error"] for r in best], where="post", color="#c9c9c9", linewidth=6,
                  solid_joinstyle="round", solid_capstyle="round")
    curves = collections.defaultdict(list)
    for _, run in runs:
        curves[run["family"], run["divisions"] if run["family"] <= 2 else run["slave_mesh"], run["counted"]].append(run)
    for (family, _, counted), of in curves.items():
        axes.plot([price_of(r, price) for r in of], [r["error"] for r in of], color=FAMILIES[family][0], linewidth=1.4, alpha=0.55,
                  linestyle=(0, (3, 3)) if counted else "-")
    for k, run in sorted(runs, key=lambda each: -each[1]["family"]):  # the first family on top
        axes.plot([price_of(run, price)], [run["error"]], gid=f"mark_{k}", **mark(run["family"], run["counted"]))


def mark(family, hollow=False):
    color, shape = FAMILIES[family]
    return {"marker": shape, "markersize": {"s": 8, "D": 8, "X": 11, "P": 11}.get(shape, 9.5), "linestyle": "none", "clip_on": False,
            "markerfacecolor": "#ffffff" if hollow else color, "markeredgecolor": color if hollow else "#ffffff",
            "markeredgewidth": 1.6 if hollow else 1}


def tip(run):
    """What a mark says when it is pointed at."""
    return (f"{run['name']}: error {number(100 * run['error'])} %, {number(run['cpu'])} s, contact "
            f"{number(1e3 * run['contact_cpu'])} ms, {price_of(run, 'dofs')} dofs, {run['iterations']} iterations")


def legend_of(works, families):
    handles = [plt.Line2D([], [], label=name, **mark(family)) for family, name in families]
    if any(run["counted"] for work in works for run in work["runs"]):
        handles.append(plt.Line2D([], [], linestyle="none", label="hollow: area counted"))
    return handles + [plt.Line2D([], [], color="#c9c9c9", linewidth=6, label="Pareto front")]


def work_picture(works, families, folder):
    """Several problems, a row each."""
    figure, rows = plt.subplots(len(works), 2, figsize=(8.8, 3.2 * len(works) + 0.9), squeeze=False, layout="constrained")
    for row, work in zip(rows, works):
        for axes, price in zip(row, ("segments", "cpu")):
            work_panel(axes, work, price)
        row[0].set_title(work["title"], loc="left", fontsize=10.5, fontweight="bold")
    figure.legend(handles=legend_of(works, families), loc="upper left", ncols=3, fontsize=9.5)
    figure.get_layout_engine().set(rect=(0, 0, 1, 1 - 0.9 / figure.get_figheight()))
    pictures.save(figure, folder, "work_precision")


# Stability maps

def look(panel, k):
    """Colour and letter of a cell."""
    fate, end = panel["fate"][k], panel["end"][k]
    if fate == "solved":
        step = math.log2(max(panel["iterations"][k], 1) / 32) / 2 + 1
        return BLUES[min(max(math.floor(step), 0), 4)], ""
    if fate != "flagged":
        return {"silently wrong": (WRONG, "W"), "unjudged": (UNJUDGED, "?"), "diverged": (DIVERGED, "")}[fate]
    return ENDS.get(end, (DURING, str(panel["status"][k] % 10)))


def cells(axes, chart, panel, ends_only=False):
    """One panel: a square for each cell, with its letter."""
    columns, rows = len(chart["x"]["values"]), len(chart["y"]["values"])
    looks = [look(panel, k) for k in range(columns * rows)]
    axes.add_collection(pictures.matplotlib.collections.PolyCollection(
        [[(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)] for j in range(rows) for i in range(columns)],
        facecolors=[color for color, _ in looks], edgecolors="none", antialiaseds=False, gid="cells"))
    letters = collections.defaultdict(list)
    for k, (_, letter) in enumerate(looks):
        if letter:
            letters[letter].append((k % columns + 0.5, k // columns + 0.5))
    with plt.rc_context({"text.parse_math": True, "mathtext.default": "regular"}):
        for letter, places in letters.items():
            axes.scatter(*zip(*places), marker=f"${letter}$", s=30 if ends_only else 12, linewidths=0, color="#ffffff" if letter == "W" else INK)
    axes.set(xlim=(0, columns), ylim=(0, rows), aspect="equal")
    for axis, values in ((axes.xaxis, chart["x"]["values"]), (axes.yaxis, chart["y"]["values"])):
        shown = sorted({0, len(values) - 1} if ends_only else {0, (len(values) - 1) // 2, len(values) - 1})
        axis.set_ticks([i + 0.5 for i in shown], [number(values[i]) for i in shown])
    axes.tick_params(length=0 if ends_only else 2.5)


def panels_of(chart, surface):
    return [p for p in chart["panels"] if p["surface"] == surface and p["rules"]]


def surfaces_of(chart):
    return list(dict.fromkeys(p["surface"] for p in chart["panels"]))


def map_picture(chart, folder):
    """All panels of a map, a row for each surface."""
    surfaces = surfaces_of(chart)
    figure, rows = plt.subplots(len(surfaces), 6, figsize=(9.4, 1.75 * len(surfaces) + 1.4), squeeze=False)
    height = figure.get_figheight()
    figure.subplots_adjust(left=0.075, right=0.99, top=1 - 1.0 / height, bottom=0.5 / height, hspace=0.3, wspace=0.1)
    pictures.titles(figure, chart["title"], "blue: solved (the darker, the more iterations); yellow: flagged, the letter says by what; "
                    "grey: diverged; red W: silently wrong", 0.01)
    for row, surface in zip(rows, surfaces):
        lowest = surface == surfaces[-1]
        for k, (axes, panel) in enumerate(zip(row, panels_of(chart, surface))):
            cells(axes, chart, panel)
            axes.set_title(f"{panel['projection']}, {panel['tangent']}", fontsize=7.5, loc="left", pad=3)
            axes.tick_params(labelsize=7, labelleft=k == 0, labelbottom=lowest)
            axes.set_xlabel(chart["x"]["label"] if lowest else "", fontsize=8)
            axes.set_ylabel(chart["y"]["label"] if k == 0 else "", fontsize=8)
        row[0].annotate(surface, (0, 1), xycoords="axes fraction", xytext=(0, 14), textcoords="offset points", fontsize=9,
                        fontweight="bold")
    pictures.save(figure, folder, f"stability_{chart['name']}")


# The page

def inline(figure, title, kind, tips):
    """A figure as an element of the page. @param tips  texts by the ids of groups; "cells": a list, one for each cell"""
    stream = io.StringIO()
    figure.savefig(stream, format="svg", metadata={"Date": None})
    plt.close(figure)
    svg = stream.getvalue()
    svg = svg[svg.index("<svg"):]
    svg = re.sub(r"<metadata>.*?</metadata>|<clipPath.*?</clipPath>| clip-path=\"[^\"]*\"", "", svg, flags=re.S)
    svg = re.sub(r"<svg[^>]*viewBox=\"([^\"]*)\"[^>]*>", lambda m: f'<svg class="{kind}" viewBox="{m[1]}" role="img" '
                 f'aria-label="{html.escape(title)}">', svg, count=1)
    for name, texts in tips.items():
        if name == "cells":
            start = svg.index('<g id="cells">')
            end = svg.index("</g>", start)
            told = iter(texts)
            svg = svg[:start] + re.sub(r"(<path [^>]*?)/>", lambda m: f"{m[1]}><title>{html.escape(next(told))}</title></path>",
                                       svg[start:end]) + svg[end:]
        else:
            svg = svg.replace(f'<g id="{name}">', f"<g><title>{html.escape(texts)}</title>")
    svg = svg.replace('<g id="axes_1">', '<g class="x">')
    return re.sub(r"<g id=\"[^\"]*\">", "<g>", svg)


def work_svg(work, price):
    figure, axes = plt.subplots(figsize=(440 / 72, 304 / 72))
    figure.subplots_adjust(left=68 / 440, right=1 - 26 / 440, top=1 - 14 / 304, bottom=50 / 304)
    work_panel(axes, work, price)
    axes.yaxis.set_label_coords(-50 / 346, 0.5)
    axes.xaxis.set_label_coords(0.5, -32 / 240)
    tips = {f"mark_{k}": tip(run) for k, run in enumerate(work["runs"]) if charted(run)}
    return inline(figure, f"{work['title']}: error over {PRICES[price]}", "w", tips)


def panel_svg(chart, panel):
    columns, rows = len(chart["x"]["values"]), len(chart["y"]["values"])
    width, height = max(14 * columns, 7 * len(chart["x"]["label"]) - 16), max(14 * rows, 7 * len(chart["y"]["label"]) - 12)
    figure = plt.figure(figsize=((width + 66) / 72, (height + 44) / 72))
    axes = figure.add_axes([58 / (width + 66), 38 / (height + 44), width / (width + 66), height / (height + 44)])
    cells(axes, chart, panel, ends_only=True)
    axes.set(xlabel=chart["x"]["label"], ylabel=chart["y"]["label"], frame_on=False)
    cell = min(width / columns, height / rows)  # of few cells the axes are smaller than their place
    axes.xaxis.set_label_coords(0.5, -18 / (cell * rows))
    axes.yaxis.set_label_coords(-46 / (cell * columns), 0.5)
    texts = []
    for k, fate in enumerate(panel["fate"]):
        end = f"status {panel['status'][k]}" if panel["end"][k] == "status" else panel["end"][k]
        texts.append(f"{number(chart['x']['values'][k % columns], 3)}, {number(chart['y']['values'][k // columns], 3)}: {fate}"
                     f"{': ' + end if fate == 'flagged' else ''}, {panel['iterations'][k]} iterations")
    return inline(figure, ", ".join((chart["title"], panel["surface"], panel["projection"], panel["tangent"])), "m", {"cells": texts})


def table(head, rows):
    """@param rows  lists of cells, after a class of the row or None"""
    lines = "".join(f"<tr{f' class={kind}' if kind else ''}>" + "".join(f"<td>{html.escape(str(c))}</td>" for c in row) + "</tr>"
                    for kind, row in rows)
    return '<div class="wide"><table><tr>' + "".join(f"<th>{html.escape(h)}</th>" for h in head) + f"</tr>{lines}</table></div>"


def items(lines):
    return "<ul>" + "".join(f"<li>{line}</li>" for line in lines) + "</ul>"


def key_of(entries):
    return '<div class="key">' + "".join(f"<span>{entry}</span>" for entry in entries) + "</div>"


def swatch(figure_of):
    figure = plt.figure(figsize=(14 / 72, 14 / 72))
    axes = figure.add_axes([0, 0, 1, 1], xlim=(-1, 1), ylim=(-1, 1), frame_on=False, xticks=[], yticks=[])
    figure_of(axes)
    return inline(figure, "", "k", {})


def work_key(work):
    entries = [swatch(lambda axes: axes.plot([0], [0], **mark(family))) + html.escape(name) for family, name in work["families"]]
    if any(run["counted"] for run in work["runs"]):
        entries.append("filled: corrected between the nodes; hollow: counted")
    if work["asked"] > 0:
        entries.append(swatch(lambda axes: axes.plot([-0.8, 0.8], [0, 0], color="#c9c9c9", linewidth=6)) + "Pareto front")
    return key_of(entries)


def truth_section(works):
    rows = []
    for work in works:
        for k, m in enumerate(work["methods"]):
            first = k == 0
            rows.append(("new" if first else None, [
                work["title"] if first else "", f"{100 * m['asked']:.3g} %" if first else "", m["method"],
                "yes" if m["reached"] else f"no:\u00a0{100 * m['best_error']:.3g}\u00a0%", m["segments"], m["dofs"], number(m["cpu"])]))
    return "" if not rows else table(["scene and quantity", "asked", "method", "reached", "segments", "dofs", "solve [s]"], rows) + items(
        f"<b>{html.escape(work['title'])}:</b> {html.escape(work['sentence'])}" for work in works if work["sentence"])


def equal_section(works):
    rows, notes = [], []
    for work in works:
        keys = ("enriched", "global_plain", "fewest_plain", "cheapest_plain", "fewest_smoothed", "cheapest_smoothed")
        at = {key: work["runs"][k] if key in keys and k is not None else k for key, k in work["equal_accuracy"].items()}
        enriched, few = at["enriched"], at["fewest_plain"]
        if enriched is None or work["asked"] != at["error"]:
            continue
        seen = [at[key] for key in ("fewest_plain", "fewest_smoothed", "cheapest_plain", "cheapest_smoothed")]
        segments = [r["segments"] if r else "-" for r in (enriched, *seen[:2])]
        rows.append((None, [work["name"], *segments, *(number(r["cpu"]) if r else "-" for r in (enriched, *seen[2:])),
                            *(number(1e3 * r["contact_cpu"]) if r else "-" for r in (enriched, *seen[2:])),
                            number(100 * enriched["contact_cpu"] / enriched["cpu"]) + " %"]))
        note = f"<b>{html.escape(work['name'])}:</b> "
        if few:
            note += f"{few['segments'] // enriched['segments']} times fewer segments than plain ones (counted over {html.escape(work['period'])}); "
        takes = {0: "none takes", 1: "1 takes"}.get(at["faster"], f"{at['faster']} take")
        note += (f"of {at['reaching']} runs with plain or smoothed segments that reach 1 %, {takes} less time than the enriched one by more "
                 "than the noise." if at["reaching"] else
                 "no plain or smoothed surface here reaches 1 %" + ("." if work["exact"] else ", the truth itself aside."))
        if wide := at["global_plain"]:
            coarsest = wide["segments"] == min(r["segments"] for r in work["runs"] if r["family"] == wide["family"]
                                               and r["slave_mesh"] == wide["slave_mesh"] and "segments" in r)
            moved = "forces" if work["forces"] else "master's motion"
            note += (f" For 1 % of the {moved} instead, {wide['segments']} plain "
                     f"segments do ({'the fewest here; ' if coarsest else ''}against the finest ones).")
        if at["plain_following"]:
            note += f" To follow the surface itself to 1 % of its amplitude, {at['plain_following']} plain segments are needed."
        notes.append(note)
    return table(["scene", "segments: enriched", "plain", "smoothed", "solve [s]: enriched", "plain", "smoothed",
                          "contact [ms]: enriched", "plain", "smoothed", "contact part of the enriched solve"], rows) + items(notes)


def tangent_section(works):
    rows = []
    for work in works:
        meshes = {run["slave_mesh"] for run in work["runs"] if run["tangent"] != "consistent"}
        rows += [(None, [work["name"], run["slave_mesh"], run["tangent"], run["iterations"], run["cuts"], number(run["cpu"]),
                         number(1e3 * run["contact_cpu"]), f"{number(100 * run['error'])} %"])
                 for run in work["runs"] if run["family"] == 0 and run["slave_mesh"] in meshes and run.get("error") is not None]
    return table(["scene", "slave mesh", "tangent", "iterations", "cut steps", "solve [s]", "contact [ms]", "error"], rows) if rows else ""


def work_section(work):
    text = (f'<h3 id="work_{work["name"]}">{html.escape(work["title"])}</h3><p>{html.escape(work["text"])} <b>Error:</b> '
            f'{html.escape(work["quantity"])}, against {html.escape(work["truth"])}.</p>{work_key(work)}<div class="charts">')
    text += "".join(f"<figure>{work_svg(work, price)}</figure>" for price in PRICES) + "</div>"
    return text + items(map(html.escape, work["advice"] + work["comparisons"] + [
        f"Not solved: {r['way']} {r['divisions']}, {r['slave_mesh']}: {r['failure']}" for r in work["runs"] if "failure" in r]))


def map_key():
    entries = [(color, "", name) for color, name in zip(BLUES, ("solved, < 32 iterations in all", "< 128", "< 512", "< 2048", "more"))]
    entries += [(*what, end) for end, what in ENDS.items()]
    entries += [(DURING, "6", "a digit: that status of ents.h (6: penetration limit)"),
                (DIVERGED, "", "diverged, in spite of six halvings"), (WRONG, "W", "silently wrong")]
    return key_of(f'<i style="background:{c}">{letter}</i>{html.escape(text)}' for c, letter, text in entries)


def map_section(chart):
    text = f'<h3 id="{chart["name"]}">{html.escape(chart["title"])}</h3><p>{html.escape(chart["text"])}</p>'
    for surface in surfaces_of(chart):
        text += f'<h4>{html.escape(surface)}</h4><div class="panels">' + "".join(
            f"<figure>{panel_svg(chart, p)}<figcaption>{p['projection']}, {p['tangent']}</figcaption></figure>"
            for p in panels_of(chart, surface)) + "</div>"
    rows = []
    for panel in chart["panels"]:
        taken = sorted(n for n, fate in zip(panel["iterations"], panel["fate"]) if fate == "solved")
        rows.append((None if panel["rules"] else "careless", [
            panel["surface"], panel["projection"], panel["tangent"] + ("" if panel["rules"] else ", no rules"),
            *(panel["fate"].count(fate) for fate in ("solved", "flagged", "diverged", "silently wrong")),
            taken[len(taken) // 2] if taken else "-"]))
    return text + "<h4>Counts</h4>" + table(["surface", "projection", "tangent", "solved", "flagged", "diverged", "silently wrong",
                                             "median iterations"], rows)


def page(data, template):
    works = data["work_precision"]
    parts = {"version": data["version"], "error": "1 %", "area_error": "3 %", "truth": truth_section(works), "equal": equal_section(works),
             "works": "".join(map(work_section, works)), "tangents": tangent_section(works), "map_key": map_key(),
             "maps": "".join(map(map_section, data["stability"])),
             "wrong": table(["Fig. 4", "wrong because", "example", "ents_surface_check says", "on the way"], [
                 (None, [row[key] for key in ("panel", "what", "example", "surface_check", "on_the_way")]) for row in data["wrong_heights"]])}
    for name in ("truth", "tangents"):  # a chapter without its table goes
        template = re.sub(f"<!--{name}-->(.*?)<!--end-->", r"\1" if parts[name] else "", template, flags=re.S)
    return string.Template(template).substitute(parts)


def main():
    folder = pathlib.Path(next((word for word in sys.argv[1:] if word != "--no-pictures"), pathlib.Path(__file__).parent))
    data = json.loads((folder / "chart.json").read_text(encoding="utf-8"))
    ENDS.update(zip(data["ends"], LETTERS))
    template = (pathlib.Path(__file__).parent / "page.html").read_text(encoding="utf-8")
    (folder / "chart.html").write_text(page(data, template), encoding="utf-8")
    work_picture([work for work in data["work_precision"] if work["name"] in data["pictured"]], data["families"], folder)
    for chart in data["stability"] * ("--no-pictures" not in sys.argv):
        map_picture(chart, folder)


if __name__ == "__main__":
    main()
