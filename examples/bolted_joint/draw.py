#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""draw.py FOLDER: FOLDER/joint.png of a run of joint.py, with matplotlib: half sections of both meshes, and what each quarter turn of the thread
carries."""
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import runs  # noqa: E402
from bodies import PARTS  # noqa: E402
from joint_parts import TURNS, Joint  # noqa: E402

GAP = 1.0  # between the halves of the picture
STEEL, RED = "#2c5f8a", "#b0201c"


def thread(joint, offset):
    """The thread on the plain bolt at the section: x, z."""
    points = []
    for k in range(2751):
        z = joint.threaded[0] + 0.01 * k
        place = (z - offset + joint.pitch / 2) % joint.pitch - joint.pitch / 2
        flank = joint.pitch_radius + (joint.pitch / 4 - abs(place)) / joint.tan
        points.append((GAP + min(joint.diameter / 2, max(joint.root_radius, flank)), min(z, joint.threaded[1])))
    return points


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        print(__doc__)
        return 0 if sys.argv[1:] in (["-h"], ["--help"]) else 2
    folder = pathlib.Path(sys.argv[1])
    result = json.loads((folder / "result.json").read_text())
    threads = [name for name in result if name in ("small", "coarse", "fine")][-1]
    own, other = result["enriched"], result[threads]
    joint, model = Joint(), json.loads((folder / "enriched/model.json").read_text())["height"]["of"][0]

    def sections(axes):
        from matplotlib import collections, colors
        stress = colors.LinearSegmentedColormap.from_list("stress", [STEEL, "#8fbcd9", "#f7f4dc", "#e8923d", RED])
        for name, right, width in ((threads, 0, 0.2), ("enriched", GAP, 0.5)):
            faces = json.loads((folder / f"section_{name}.json").read_text())
            drawn = axes.add_collection(collections.PolyCollection(
                [[(x + right, z) for x, z, _ in face] for face in faces], array=[sum(v for _, _, v in face) / len(face) for face in faces], cmap=stress,
                norm=colors.Normalize(0, 500), edgecolors="#404040", linewidths=width))
        axes.plot(*zip(*thread(joint, model["offset"])), color=RED, linewidth=1.3)
        for word, x, z in (("nut", -13.5, 15.5), ("plate", -17, -9), ("bolt", -3, 19)):
            axes.text(x, z, word, ha="center", va="center", fontsize=11)
        axes.set(xlim=(-21, 21), ylim=(-11.3, 20.8), aspect="equal")
        axes.set_title(loc="left", fontsize=9, label=f"threads as a mesh: {other['nodes']} nodes, {other['seconds']:.0f} s      |      "
                 f"plain cylinders: {own['nodes']} nodes, {own['seconds']:.1f} s")
        axes.axis("off")
        axes.figure.colorbar(drawn, ax=axes, shrink=0.8, aspect=50, pad=0.01, ticks=(0, 200, 400)).ax.set_title("von Mises\n[MPa]", fontsize=9)

    def turns(axes):
        middle, quarters = [i + 0.5 for i in range(TURNS)], [(i + 0.5) / PARTS for i in range(len(own["parts"]))]
        axes.bar(middle, [100 * x for x in other["shares"][:TURNS]], 0.9, color=STEEL, alpha=0.25, label="turns, threads as a mesh")
        axes.hlines([100 * x for x in own["shares"][:TURNS]], [x - 0.45 for x in middle], [x + 0.45 for x in middle], color=RED, linewidth=2.5,
                    label="turns, plain cylinders")
        axes.plot(quarters, [100 * PARTS * x for x in other["parts"]], color=STEEL, linewidth=1.5, label="quarter turns, threads as a mesh")
        axes.plot(quarters, [100 * PARTS * x for x in own["parts"]], "o", color=RED, fillstyle="none", label="quarter turns, plain cylinders")
        axes.plot(middle, [100 * x for x in result["yamamoto"][:TURNS]], "s", color="#555555", fillstyle="none", label="turns, Yamamoto's theory")
        axes.set(xlim=(0, TURNS), ylim=(0, 32), xlabel="turn", ylabel="% of the preload per turn",
                 title="load along the nut's thread, from the plate on")
        axes.grid(False, axis="x")
        axes.spines[["top", "right"]].set_visible(False)
        axes.legend(loc="upper right")

    runs.draw(folder / "joint.png", (1400, 640), sections, turns)
    return 0


if __name__ == "__main__":
    sys.exit(main())
