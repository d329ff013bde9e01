# SPDX-License-Identifier: BSD-3-Clause
"""What the programs of several runs share: their command line, runs of ents-lab, and results as gallery.py reads them."""
import argparse
import base64
import json
import pathlib
import re
import struct
import subprocess
import sys

TOP = pathlib.Path(__file__).resolve().parents[1]
BLUE, ORANGE, PALE, GREY, DARK = "#0072b2", "#d55e00", "#56b4e9", "#bbbbbb", "#333333"  # of pictures: Okabe and Ito 2008; exact curves


def arguments(document, name):
    """NAME.py [ENTS-HOST] [--out FOLDER]; the folder is there when this returns."""
    parser = argparse.ArgumentParser(description=document, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", type=pathlib.Path, default=TOP / "build/bin/ents-lab")
    parser.add_argument("--out", default=pathlib.Path("out") / name, type=pathlib.Path)
    found = parser.parse_args()
    found.out.mkdir(parents=True, exist_ok=True)
    return found


def solve(program, scene, folder, *options):
    """Result of a scene: a file, or a dictionary, which is written into the folder. Ends the program if it is not solved."""
    if isinstance(scene, dict):
        folder.mkdir(parents=True, exist_ok=True)
        file = folder / "scene.json"
        file.write_text(json.dumps(scene))
    else:
        file = scene
    done = subprocess.run([program, "run", file, "--out", folder, *options], capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"{folder}: {done.stderr.strip() or done.stdout.strip()}")
    return json.loads((folder / "result.json").read_text())


def quantity(name, value, exact):
    """A computed number beside its exact value. If that is zero, only an absolute bound can be checked."""
    return {"name": name, "value": value, "exact": exact, "relative_error": value / exact - 1 if exact else None}


def vtu_values(folder, step, part, array, code="d"):
    """Numbers of an array of a part of a step, from the files for ParaView; code: "d", or "q" for whole numbers."""
    text = (folder / f"result_{part}_{step:04d}.vtu").read_text()
    data = base64.b64decode(re.search(rf'Name="{array}[^>]*format="binary">([^<]*)<', text)[1])
    size = struct.unpack("<Q", data[:8])[0]
    return struct.unpack(f"<{size // 8}{code}", data[8:8 + size])


def vtu_points(folder, step, part="surface", displaced=False):
    """Points of a part of a step: [(x, y, z)]."""
    x = vtu_values(folder, step, part, "Points")
    if displaced:
        x = [a + b for a, b in zip(x, vtu_values(folder, step, part, "displacement"))]
    return [x[i:i + 3] for i in range(0, len(x), 3)]


def write_result(folder, steps):
    """FOLDER/result.json: for each step a list of quantities."""
    (folder / "result.json").write_text(json.dumps({"steps": [{"exact": step} for step in steps]}, indent=1))


def draw(picture, size, *panels, below=False, projection=None):
    """A picture with matplotlib, if it is there. size: pixels; panels: functions of the axes that they fill, beside or below each other."""
    try:
        import matplotlib
        matplotlib.use("Agg")
        from matplotlib import pyplot
    except ImportError:
        print(f"no picture {picture}: matplotlib is not installed (Debian package python3-matplotlib)")
        return
    pyplot.rcParams.update({"axes.grid": True, "grid.color": "#dddddd", "axes.axisbelow": True, "legend.frameon": False, "font.size": 9})
    count = (len(panels), 1) if below else (1, len(panels))
    figure, axes = pyplot.subplots(*count, figsize=[pixels / 100 for pixels in size], layout="constrained", squeeze=False,
                                   subplot_kw={"projection": projection})
    figure.get_layout_engine().set(w_pad=0.1, h_pad=0.12)
    for panel, each in zip(panels, axes.flat):
        panel(each)
    figure.savefig(picture, dpi=100)
    pyplot.close(figure)
    print(picture)


def legend_above(axes):
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1), ncols=6, borderaxespad=0.2)
