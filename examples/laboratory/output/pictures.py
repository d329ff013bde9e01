#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draw the pictures of a run: python3 pictures.py [FOLDER], of the folder where this file lies by default.

FOLDER/pictures.json has the numbers and words of every picture; NAME.svg and NAME.png are drawn for each.
Exit status 3: there is no matplotlib.
"""
import json
import math
import pathlib
import sys

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
    from matplotlib import ticker
except ImportError:
    sys.exit(3)

INK, FAINT, WRONG, GRID = "#222222", "#777777", "#c1121f", "#e4e4e4"
OKABE_ITO = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00"]  # told apart with any colour vision
MARKERS, OPEN_MARKERS = "os^Dv*", "os^Dvp"
plt.rcParams.update({
    "font.family": "DejaVu Sans", "font.size": 10.5, "svg.fonttype": "none", "svg.hashsalt": "ents", "text.color": INK,
    "axes.edgecolor": INK, "axes.labelcolor": INK, "axes.spines.top": False, "axes.spines.right": False, "axes.linewidth": 0.9,
    "axes.axisbelow": True, "xtick.color": INK, "ytick.color": INK, "legend.frameon": False, "legend.fontsize": 10,
    "text.parse_math": False})  # rough_afm stays what it is


def save(figure, folder, name):
    figure.savefig(folder / f"{name}.svg", metadata={"Date": None})
    figure.savefig(folder / f"{name}.png", dpi=200)
    plt.close(figure)


def common_power(largest):
    """The power of 1000 to take out of numbers up to `largest`, as a power of ten: 0 from 1e-2 to 1e5."""
    if not 0 < largest < math.inf or 1e-2 <= largest < 1e5:
        return 0
    return 3 * math.floor(math.log10(largest) / 3)


def axis_label(label, unit, power=0):
    digits = str(power).translate(str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻"))
    scale = " ".join(word for word in ("10" + digits if power else "", unit) if word)
    return f"{label} [{scale}]" if scale else label


def values_of(numbers):
    return np.array([math.nan if value is None else value for value in numbers], dtype=float)


def titles(figure, title, subtitle, left=0.1):
    """Title and subtitle in the upper left corner of a figure."""
    height = figure.get_figheight()
    figure.text(left, 1 - 0.3 / height, title, fontsize=13, fontweight="bold")
    figure.text(left, 1 - 0.53 / height, subtitle, fontsize=9.5, color=FAINT)


# Charts

class Scale:
    """An axis with its range: the data with a margin, so that no marker sits on a border; from 0 it stays at 0. Numbers that differ by less
    than a thousandth are drawn as equal: the axis has their digits."""

    def __init__(self, axis, values):
        self.logarithmic = axis["logarithmic"]
        values = values[np.isfinite(values) & ((values > 0) | (not self.logarithmic))]
        low, high = (values.min(), values.max()) if values.size else (1, 10) if self.logarithmic else (0, 1)
        if self.logarithmic:
            margin = max((high / low) ** 0.06, 1.15)
            self.low, self.high = low / margin, high * margin
        else:
            low, high = (given if given is not None else value for given, value in ((axis["min"], low), (axis["max"], high)))
            if abs(high - low) < 1e-3 * max(abs(low), abs(high)) or high == low:
                middle, half = 0.5 * (low + high), 0.05 * max(abs(low), abs(high)) or 0.5
                low, high = middle - half, middle + half
            span = high - low
            self.low, self.high = 0 if 0 <= low <= 0.1 * span else low - 0.05 * span, high + 0.06 * span
        self.low = self.low if axis["min"] is None else axis["min"]
        self.high = self.high if axis["max"] is None else axis["max"]
        self.power = 0 if self.logarithmic else common_power(max(abs(self.low), abs(self.high)))
        self.unit = 10.0 ** -self.power

    def holds(self, values):
        """Whether all numbers lie in the range, its ends included."""
        values = values[np.isfinite(values)]
        return bool(np.all((values >= self.low) & (values <= self.high)))

    def set(self, which, axis):
        if self.logarithmic:
            which._set_axes_scale("log")
            decades = math.log10(self.high / self.low)
            if decades < 2:  # hardly any powers of ten: 1-2-5 steps
                which.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
                which.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))
                which.set_minor_formatter(ticker.NullFormatter())
            else:
                which.set_major_locator(ticker.LogLocator(numticks=100 if decades <= 11 else 6))
                which.set_major_formatter(ticker.FuncFormatter(
                    lambda value, _: "10" + f"{round(math.log10(value))}".translate(str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻"))))
        elif axis["tic_step"] > 0:
            which.set_major_locator(ticker.MultipleLocator(axis["tic_step"] * self.unit))
        which.set_label_text(axis_label(axis["label"], axis["unit"], self.power))
        which.set_view_interval(self.low * self.unit, self.high * self.unit, ignore=True)


def fitted_order(x, y):
    """Slope of log y over log x by least squares through the last three points; NaN with less than two."""
    good = (x > 0) & (y > 0)
    x, y = np.log(x[good][-3:]), np.log(y[good][-3:])
    return np.polyfit(x, y, 1)[0] if x.size > 1 and np.ptp(x) > 0 else math.nan


def look(curve, index, count):
    """How a curve is drawn. Exact lines lie on top: dense markers do not hide them."""
    color = OKABE_ITO[index % 6] if count <= 6 else matplotlib.colormaps["viridis"](0.875 * index / (count - 1))
    marker = {"marker": MARKERS[index % 6 if count <= 6 else 0], "markeredgewidth": 0,
              "markersize": 3.6 if len(curve["x"]) > 60 and curve["style"] == "points" else 5.5}
    return {
        "exact": {"color": INK, "linewidth": 1.2, "zorder": 4},
        "exact_dashed": {"color": INK, "linewidth": 1.2, "zorder": 4, "dashes": (8, 4)},
        "line": {"color": color, "linewidth": 1.8},
        "points": {"color": color, "linestyle": "none", **marker},
        "both": {"color": color, "linewidth": 1.3, "markevery": max(1, len(curve["x"]) // 30), **marker},
        "dashed": {"color": color, "linewidth": 1.3, "dashes": (9, 5)},
        "area": {"color": color, "linewidth": 1.5},
        "wrong": {"color": WRONG, "linestyle": "none", "marker": OPEN_MARKERS[index % 6], "fillstyle": "none", "markersize": 11,
                  "markeredgewidth": 2, "zorder": 5},
        "wrong_line": {"color": WRONG, "linewidth": 2.4, "zorder": 4},
    }[curve["style"]]


def draw_guides(axes, guides, x, y):
    """Thin straight lines across the chart, with a word at the end of each."""
    for guide in guides:
        across, scale = (axes.axvline, x) if guide["vertical"] else (axes.axhline, y)
        at = guide["value"] * scale.unit
        across(at, color=FAINT, linewidth=1, dashes=(5, 4), zorder=1)
        if guide["vertical"]:
            right = (guide["value"] - x.low) / (x.high - x.low) > 0.7
            axes.annotate(guide["label"], (at, 0.965), xycoords=("data", "axes fraction"), xytext=(-5 if right else 5, 0),
                          textcoords="offset points", ha="right" if right else "left", color=FAINT, fontsize=9.5)
        else:
            axes.annotate(guide["label"], (0.985, at), xycoords=("axes fraction", "data"), xytext=(0, 4),
                          textcoords="offset points", ha="right", color=FAINT, fontsize=9.5)


def draw_slope(axes, curve, order, y):
    """A right triangle of that order, a little below the middle of a curve."""
    u, v = values_of(curve["x"]), values_of(curve["y"])
    low, high = u.min(), u.max()
    a, b = low * (high / low) ** 0.42, low * (high / low) ** 0.68
    at_a, at_b = np.exp(np.interp(np.log([a, b]), *(np.log(z[np.argsort(u)]) for z in (u, v))))
    falling = fitted_order(u, v) < 0
    ratio = (b / a) ** (-order if falling else order)
    left = min(at_a, at_b / ratio) * (y.high / y.low) ** -0.07
    right, upright = left * ratio, a if falling else b
    axes.fill([a, b, upright], [left, right, min(left, right)], facecolor="#77777722", edgecolor=FAINT, linewidth=1)
    axes.annotate("1", (math.sqrt(a * b), min(left, right)), xytext=(0, -12), textcoords="offset points", ha="center", fontsize=9.5)
    axes.annotate(f"{order:g}", (upright, math.sqrt(left * right)), xytext=(-6 if falling else 6, 0), textcoords="offset points",
                  ha="right" if falling else "left", va="center", fontsize=9.5)


def draw_chart(chart, folder):
    curves, guides = chart["curves"], chart["guides"]
    data = {z: np.concatenate([values_of(c[z]) for c in curves] + [[g["value"] for g in guides if g["vertical"] == (z == "x")]])
            for z in "xy"}
    x, y = Scale(chart["x"], data["x"]), Scale(chart["y"], data["y"])
    height = min(max(1.9 + 7.8 * (y.high - y.low) / (x.high - x.low), 3), 9) if chart["equal_axes"] else 6
    figure, axes = plt.subplots(figsize=(9, height))
    figure.subplots_adjust(left=0.1, right=0.97, top=1 - 0.75 / height, bottom=0.6 / height)
    axes.grid(color=GRID, linewidth=0.8)
    colored = [c for c in curves if c["style"] not in ("exact", "exact_dashed", "wrong_line")]
    for curve in curves:
        u, v = values_of(curve["x"]), values_of(curve["y"])
        label = curve["label"]
        if curve["fit_order"] and not math.isnan(order := fitted_order(u, v)):
            label += f", order {abs(order):.2f}" + " of the last three" * (len(u) > 3)
        style = look(curve, next((i for i, c in enumerate(colored) if c is curve), 0), len(colored))
        cut = not (x.holds(u) and y.holds(v))  # else markers on a border are whole
        axes.plot(u * x.unit, v * y.unit, label=label or "_", clip_on=cut, **style)
        if curve["style"] == "area":
            axes.fill_between(u * x.unit, 0, v * y.unit, color=style["color"], alpha=0.18)
    x.set(axes.xaxis, chart["x"]), y.set(axes.yaxis, chart["y"])
    draw_guides(axes, guides, x, y)
    if chart["slope_triangle"] and x.logarithmic and y.logarithmic:
        for curve in [c for c in curves if c["fit_order"] and len(c["x"]) > 1][:1]:
            draw_slope(axes, curve, chart["slope_triangle"], y)
    if chart["equal_axes"]:
        axes.set_aspect("equal", adjustable="box")
    entries = len(axes.get_legend_handles_labels()[1])
    if entries > 8 or any(len(c["label"]) > 60 for c in curves):
        more = 0.24 * entries + 0.1
        figure.set_figheight(height + more)
        figure.subplots_adjust(top=1 - 0.75 / (height + more), bottom=(0.6 + more) / (height + more))
        axes.legend(loc="upper left", bbox_to_anchor=(0, -0.5 / (height - 1.35)), borderaxespad=0)
    elif entries:
        axes.legend(loc="best")
    titles(figure, chart["title"], chart["subtitle"])
    save(figure, folder, chart["name"])


# Maps

def colors_of(field):
    """Range of the colours, and of all values that are not blank. White: nothing touches, which is not a value."""
    values = values_of(field["values"])
    blank = ~np.isfinite(values) | ((values == 0) & field["blank_zero"])
    seen = np.sort(values[~blank])
    image = np.ma.masked_array(values, blank).reshape(field["rows"], field["columns"])
    if not seen.size:
        return image, 0, 1, 0, 1
    cut = min(max(1 - field["clip"], 0), 1) * seen.size  # left out above, or at both ends
    above = min(seen.size - 1, round(cut if field["blank_zero"] else 0.5 * cut))
    low = min(0.0, seen[0]) if field["blank_zero"] else seen[min(above, seen.size - 1 - above)]
    high = seen[seen.size - 1 - above]
    if field["palette"] == "diverging":
        low, high = -max(abs(low), abs(high)), max(abs(low), abs(high))
    if not high > low:
        high = low + (abs(low) or 1)
    return image, low, high, seen[0], seen[-1]


def draw_maps(maps, folder):
    """Scalars over the same rectangle side by side, each with its colour bar."""
    count = len(maps["maps"])
    x0, x1, y0, y1 = (maps[key] for key in ("x_min", "x_max", "y_min", "y_max"))
    left, bar, gap, top, bottom = 0.75, 0.88, 0.12, 0.96, 1.05  # inches
    aspect = (y1 - y0) / (x1 - x0)
    side = min((9.6 - left - count * bar - (count - 1) * gap) / count, 5.6, 5.6 / aspect)
    width, height = left + count * (side + bar) + (count - 1) * gap, top + bottom + side * aspect
    figure = plt.figure(figsize=(width, height))
    titles(figure, maps["title"], maps["subtitle"], left / width)
    power = common_power(max(map(abs, (x0, x1, y0, y1))))
    length = 10.0 ** -power
    for k, field in enumerate(maps["maps"]):
        image, low, high, least, most = colors_of(field)
        at = left + k * (side + bar + gap)
        axes = figure.add_axes([at / width, bottom / height, side / width, side * aspect / height])
        # A pixel is centred on its sample: samples on the border have half of their pixels outside.
        half = [0.5 * (b - a) / (n - 1) if field["at_nodes"] and n > 1 else 0
                for a, b, n in ((x0, x1, field["columns"]), (y0, y1, field["rows"]))]
        unit = 10.0 ** -(own := common_power(max(abs(low), abs(high))))
        drawn = axes.imshow(image * unit, origin="lower", interpolation="nearest", aspect="auto", vmin=low * unit, vmax=high * unit,
                            cmap="RdBu_r" if field["palette"] == "diverging" else field["palette"],
                            extent=[(x0 - half[0]) * length, (x1 + half[0]) * length, (y0 - half[1]) * length, (y1 + half[1]) * length])
        axes.spines[:].set_visible(True)
        axes.set_title(axis_label(field["title"], field["unit"], own), loc="left", fontsize=10.5)
        axes.set_xlabel(axis_label(maps["x_label"], maps["unit"], power))
        if k == 0:
            axes.set_ylabel(axis_label(maps["y_label"], maps["unit"], power))
        else:
            axes.tick_params(labelleft=False)
        beside = figure.add_axes([(at + side + 0.1) / width, bottom / height, 0.13 / width, side * aspect / height])
        figure.colorbar(drawn, cax=beside).outline.set_visible(False)
        if most > high or least < low:
            ends = f"peak {most * unit:.4g}" if field["blank_zero"] else f"values from {least * unit:.3g} to {most * unit:.3g}"
            figure.text((at + side + 0.23) / width, 0.1 / height, f"{100 * field['clip']:.3g} % lie within the colours;\n{ends}",
                        fontsize=8, color=FAINT, ha="right", gid=f"note_{k}")
    save(figure, folder, maps["name"])


# Surfaces

def draw_section(surface, folder):
    """A surface in the plane: lines with markers on them. Segments need not meet."""
    columns = surface["columns"]
    enriched, base = (np.array(surface[key], dtype=float).reshape(-1, columns, 2) for key in ("enriched", "base"))
    wrong = np.array(surface["wrong"] or [0], dtype=bool)
    blank = {"fit_order": False}

    def line(label, points, style):
        broken = np.concatenate([points, np.full((len(points), 1, 2), np.nan)], axis=1).reshape(-1, 2)
        return {"label": label, "x": broken[:, 0], "y": broken[:, 1], "style": style, **blank}

    low, high = (np.concatenate([enriched, base]).reshape(-1, 2).__getattribute__(end)(axis=0) for end in ("min", "max"))
    spans = high - low
    equal = spans[1] > 0.2 * spans[0] and spans[0] > 0.2 * spans[1]
    curves = [line("segment ρ", base, "dashed")] if len(base) else []
    curves += [line("enriched surface ρₑ = ρ + h n", enriched[~wrong], "exact")] if not wrong.all() else []
    curves += [line("segments that fail", enriched[wrong], "wrong_line")] if wrong.any() else []
    curves += [{"label": p["label"], "x": [p["x"]], "y": [p["y"]], "style": "wrong" if p["wrong"] else "points", **blank}
               for p in surface["places"]]
    axis = {"unit": surface["unit"], "logarithmic": False, "min": None, "max": None, "tic_step": 0}
    words = [surface["subtitle"]] * bool(surface["subtitle"]) + ["axes not to the same scale"] * (not equal)
    draw_chart({"name": surface["name"], "title": surface["title"], "subtitle": "; ".join(words), "x": {"label": "x", **axis},
                "y": {"label": "y", **axis}, "curves": curves, "guides": [], "slope_triangle": 0, "equal_axes": equal}, folder)


def faces_of(points, height, most):
    """Corners of quadrilaterals over a grid that is thinned out to about `most` lines per direction; their heights."""
    keep = [sorted({*range(0, n, max(1, (n + most - 2) // most)), n - 1}) for n in height.shape]
    points, height = points[np.ix_(*keep)], height[np.ix_(*keep)]
    corners = [(slice(None, -1), slice(None, -1)), (slice(None, -1), slice(1, None)), (slice(1, None), slice(1, None)),
               (slice(1, None), slice(None, -1))]
    return (np.stack([points[c] for c in corners], axis=2).reshape(-1, 4, 3),
            np.mean([height[c] for c in corners], axis=0).reshape(-1))


def shades(quads):
    """Light from above and the left, 0.55 to 1."""
    normal = np.cross(quads[:, 2] - quads[:, 0], quads[:, 3] - quads[:, 1])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
    light = np.array([-0.5, -0.3, 0.8])
    return 0.55 + 0.45 * np.abs(normal @ light) / np.linalg.norm(light)


def draw_shaded(surface, folder):
    """A surface in space, coloured by its height; numbered arrows at the places, and a list of them below."""
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection
    shape = (-1, surface["rows"], surface["columns"])
    points, height = np.array(surface["enriched"], dtype=float).reshape(*shape, 3), np.array(surface["height"], dtype=float).reshape(shape)
    wrong = np.array(surface["wrong"] or [0], dtype=bool)
    low, high = points.reshape(-1, 3).min(axis=0), points.reshape(-1, 3).max(axis=0)
    plan, relief = max(high[0] - low[0], high[1] - low[1]), high[2] - low[2]
    times = max([1] + [f for f in (2, 5, 10, 20, 50, 100, 200, 500, 1000) if relief * f <= 0.25 * plan])  # else relief is not seen
    power, height_power = common_power(plan), common_power(np.abs(height).max())
    length = 10.0 ** -power * np.array([1, 1, times])
    most = max(3, int(72 / math.sqrt(len(height))))
    parts = [faces_of(points[s] * length, height[s] * 10.0 ** -height_power, most) for s in range(len(height))]
    quads, heights = (np.concatenate([part[i] for part in parts]) for i in (0, 1))
    norm = plt.Normalize(heights.min(), heights.max() if np.ptp(heights) > 0 else heights.min() + 1)
    colors = matplotlib.colormaps["viridis"](norm(heights))
    if wrong.any() and not wrong.all():  # the heights are worth more where all fail
        colors[np.repeat(wrong, [len(part[1]) for part in parts])] = matplotlib.colors.to_rgba(WRONG)
    colors[:, :3] *= shades(quads)[:, None]
    words = [surface["subtitle"]] * bool(surface["subtitle"])
    if wrong.any() and len(wrong) > 1:
        words.append("all of them fail" if wrong.all() else "those in red fail")
    words += [f"heights drawn {times} times"] * (times > 1)
    listed = 0.24 * len(surface["places"])
    figure = plt.figure(figsize=(9, 6 + listed))
    axes = figure.add_axes([0, (0.1 + listed) / (6 + listed), 0.88, 5.2 / (6 + listed)], projection="3d", computed_zorder=False)
    axes.add_collection3d(Poly3DCollection(quads, facecolors=colors, edgecolors=colors, linewidths=0.3))
    box = np.array([low, high]) * length
    margin = 0.01 * plan * length[0]
    axes.set(xlim=(box[0, 0] - margin, box[1, 0] + margin), ylim=(box[0, 1] - margin, box[1, 1] + margin),
             zlim=(box[0, 2], box[1, 2] + (0 if relief > 0 else 1e-3 * plan * length[0])), zticks=[],
             xlabel=axis_label("x", surface["unit"], power), ylabel=axis_label("y", surface["unit"], power))
    axes.xaxis.labelpad = axes.yaxis.labelpad = 12
    axes.zaxis.line.set_visible(False)
    axes.set_box_aspect(np.maximum(np.ptp(box, axis=0), 0.02 * np.ptp(box, axis=0).max()), zoom=1.1)
    axes.view_init(elev=40, azim=-60)
    for pane in (axes.xaxis, axes.yaxis, axes.zaxis):
        pane.pane.set_visible(False)
    axes.grid(False)
    for k, place in enumerate(surface["places"], 1):
        color = WRONG if place["wrong"] else INK
        at = np.array([place["x"], place["y"], place["z"]]) * length
        above = at[2] + 0.22 * plan * length[0]
        axes.plot([at[0]] * 2, [at[1]] * 2, [at[2], above], color=color, linewidth=1.4, zorder=5)
        axes.plot([at[0]], [at[1]], [at[2]], marker="v", markersize=6, color=color, zorder=6)
        axes.text(at[0], at[1], above, f" {k}", color=color, fontsize=11, fontweight="bold", zorder=6)
        figure.text(0.05, (0.1 + 0.24 * (len(surface["places"]) - k)) / (6 + listed), f"{k}   {place['label']}", color=color)
    bar = figure.add_axes([0.9, (1.5 + listed) / (6 + listed), 0.015, 3 / (6 + listed)])
    figure.colorbar(plt.cm.ScalarMappable(norm, "viridis"), cax=bar).outline.set_visible(False)
    figure.text(0.98, (4.62 + listed) / (6 + listed), axis_label("height h", surface["unit"], height_power), ha="right")
    titles(figure, surface["title"], "; ".join(words), 0.04)
    save(figure, folder, surface["name"])


def draw_surface(surface, folder):
    (draw_section if surface["dimension"] == 2 else draw_shaded)(surface, folder)


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
    kinds = {"chart": draw_chart, "maps": draw_maps, "surface": draw_surface}
    for picture in json.loads((folder / "pictures.json").read_text(encoding="utf-8")):
        kinds[picture["kind"]](picture, folder)


if __name__ == "__main__":
    main()
