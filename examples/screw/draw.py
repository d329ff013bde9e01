#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""draw.py FOLDER: FOLDER/screw.png of a run with --nodes, with matplotlib: the 16 segments of the screw, the screw itself, and the pressure on
the flank of the nut after the last step that was solved."""
import json
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import runs  # noqa: E402
from make_nut import M20  # noqa: E402


def radius(thread, angle, z):
    """Of the screw without its rounded corners."""
    half = thread.pitch / 2
    place = (z - thread.pitch * angle / (2 * math.pi) + half) % thread.pitch - half
    low = thread.pitch_radius - (0.5 - thread.root) * thread.pitch / (2 * thread.tan)
    return max(low, thread.diameter / 2 - max(abs(place) - thread.crest * half, 0) / thread.tan)


def grid(rows, columns, low, high, at):
    """x, y, z of a surface about the axis, and its radius, each [rows + 1][columns + 1]."""
    import numpy as np
    angle, z = np.meshgrid(np.linspace(0, 2 * math.pi, columns + 1), np.linspace(low, high, rows + 1))
    r = np.vectorize(at)(angle, z)
    return r * np.cos(angle), r * np.sin(angle), z, r


def stand(axes, title):
    axes.set(title=title, xlim=(-9, 9), ylim=(-9, 9), zlim=(-4, 14))
    axes.set_proj_type("ortho")
    axes.set_box_aspect((1, 1, 1), zoom=1.25)
    axes.view_init(elev=24, azim=-65)
    axes.axis("off")


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        print(__doc__)
        return 0 if sys.argv[1:] in (["-h"], ["--help"]) else 2
    folder = pathlib.Path(sys.argv[1])
    step = json.loads((folder / "result.json").read_text())["steps"][-1]
    if "nodes" not in step:
        sys.exit(f"draw.py: {folder}/result.json has no nodes: run ents-lab with --nodes")
    places, pressure = step["nodes"]["position"], step["nodes"]["pressure"]

    def segments(axes):
        axes.plot_wireframe(*grid(1, 16, -4, 14, lambda a, z: M20.pitch_radius)[:3], color="#555555", linewidth=1.2)
        stand(axes, "16 segments of the mesh")

    def screw(axes):
        *surface, r = grid(220, 72, -4, 14, lambda a, z: radius(M20, a, z))
        shade = 0.6 + 0.35 * (r - r.min()) / (r.max() - r.min())
        axes.plot_surface(*surface, facecolors=shade[..., None] * [1, 1.02, 1.05], rstride=1, cstride=1, linewidth=0, antialiased=False)
        stand(axes, "with the thread as a height")

    def flank(axes):
        shown = [k for k, p in enumerate(pressure) if p > 0]
        drawn = axes.scatter(*([places[3 * k + i] for k in shown] for i in range(3)), c=[pressure[k] for k in shown], s=5, cmap="RdYlBu_r", vmin=0,
                             depthshade=False)
        axes.figure.colorbar(drawn, ax=axes, shrink=0.55, aspect=28, pad=0.02)
        stand(axes, "pressure on the flank of the nut [MPa]")

    runs.draw(folder / "screw.png", (1200, 430), segments, screw, flank, projection="3d")
    return 0


if __name__ == "__main__":
    sys.exit(main())
