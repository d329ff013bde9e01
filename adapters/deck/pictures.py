#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draw the contact pairs of a job of ents-deck: python3 pictures.py [FOLDER], of the folder where this file lies by default.

FOLDER/pictures.json names the pairs and their titles; NAME.png is drawn of NAME_master.vtu, the enriched master with its height,
and NAME_slave.vtu, the slave points. Exit status 3: there is no matplotlib.
"""
import json
import pathlib
import sys
import xml.etree.ElementTree as xml

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
except ImportError:
    sys.exit(3)

SLAVE = {"color": "#c1121f", "marker": "o", "markersize": 3, "linestyle": "none", "label": "slave points", "zorder": 5}
plt.rcParams.update({"text.parse_math": False})  # names of sets have a _ or $


def arrays(file):
    """Points, cells as lists of point numbers, and what the points have by name, of a VTU file with numbers as text."""
    found = {a.get("Name"): np.array((a.text or "").split(), dtype=float) for a in xml.parse(file).iter("DataArray")}
    ends = found.pop("offsets").astype(int)
    cells = np.split(found.pop("connectivity").astype(int), ends[:-1]) if len(ends) else []
    return found.pop("position").reshape(-1, 3), cells, found


def draw_line(axes, points, cells, heights, norm):
    from matplotlib.collections import LineCollection
    lines = LineCollection([points[cell, :2] for cell in cells], array=[heights[cell].mean() for cell in cells], cmap="viridis",
                           norm=norm, linewidths=2.5)
    axes.add_collection(lines)
    axes.set_aspect("equal", adjustable="datalim")
    return lines


def draw_faces(axes, points, cells, heights, norm):
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection
    colors = matplotlib.colormaps["viridis"](norm([heights[cell].mean() for cell in cells]))
    normals = np.array([np.cross(points[c[2]] - points[c[0]], points[c[-1]] - points[c[1]]) for c in cells])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    colors[:, :3] *= 0.6 + 0.4 * np.abs(normals @ (-0.5, -0.3, 0.8))[:, None]  # light from above and the left
    axes.add_collection3d(Poly3DCollection([points[cell] for cell in cells], facecolors=colors, edgecolors=colors, linewidths=0.3))
    axes.view_init(elev=35, azim=-60)
    return matplotlib.cm.ScalarMappable(norm, "viridis")


def draw(folder, name, title):
    points, cells, fields = arrays(folder / f"{name}_master.vtu")
    slave = arrays(folder / f"{name}_slave.vtu")[0]
    heights, space = fields["height"], any(len(cell) > 2 for cell in cells)
    norm = plt.Normalize(heights.min(), heights.max() if np.ptp(heights) > 0 else heights.min() + 1)
    figure = plt.figure(figsize=(9, 6.5))
    axes = figure.add_subplot(projection="3d", computed_zorder=False) if space else figure.add_subplot()
    colored = (draw_faces if space else draw_line)(axes, points, cells, heights, norm)
    axes.plot(*slave[:, :3 if space else 2].T, **SLAVE)
    both = np.concatenate([points, slave])
    if space:  # x and y to the same scale; z, too, where the surface is not nearly flat
        low, high = both.min(axis=0), both.max(axis=0)
        size, plan = high - low, max(high[:2] - low[:2])
        flat = size[2] < 0.25 * plan
        axes.set_box_aspect([*np.maximum(size[:2], 0.02 * plan), 0.25 * plan if flat else size[2]])
        axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlabel="z, not to scale" if flat else "z",
                 zlim=(low[2], high[2]) if size[2] > 1e-6 * plan else low[2] + 0.01 * plan * np.array([-1, 1]))
        axes.locator_params(axis="z", nbins=4)
        axes.zaxis.labelpad = 12
    else:
        axes.margins(0.05)
        axes.autoscale_view()
    axes.set(xlabel="x", ylabel="y", title=title)
    axes.legend(loc="upper left", frameon=False)
    if np.ptp(heights) > 0:
        figure.colorbar(colored, ax=axes, label="height", shrink=0.6, pad=0.1 if space else 0.03)
    figure.savefig(folder / f"{name}.png", dpi=130)
    plt.close(figure)


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
    for picture in json.loads((folder / "pictures.json").read_text(encoding="utf-8")):
        draw(folder, picture["name"], picture["title"])


if __name__ == "__main__":
    main()
