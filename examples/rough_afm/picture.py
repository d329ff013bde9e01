# SPDX-License-Identifier: BSD-3-Clause
"""picture.py FOLDER: height of the scan above the block and contact pressure of the last step, from the files that ents-host wrote."""
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from runs import vtu_points, vtu_values  # noqa: E402


def main():
    folder = pathlib.Path(sys.argv[1])
    step = json.loads((folder / "result.json").read_text())["steps"][-1]
    figure, axes = plt.subplots(1, 2, figsize=(10, 4.4), layout="constrained")
    for axis, part, array, title, colours in ((axes[0], "surface", "height", "height [um]", "gray"),
                                              (axes[1], "slave", "pressure", "contact pressure [MPa]", "inferno_r")):
        x, y, _ = zip(*vtu_points(folder, step["step"], part))
        values = vtu_values(folder, step["step"], part, array)
        low = 1e-3 * max(values) if part == "slave" else None  # nodes that are open stay white
        drawn = axis.tripcolor(x, y, values, cmap=plt.get_cmap(colours).with_extremes(under="white"), vmin=low, shading="gouraud")
        axis.set(aspect="equal", xlim=(3, 8), ylim=(3, 8), title=title, xlabel="x [um]", ylabel="y [um]")
        figure.colorbar(drawn, ax=axis)
    figure.suptitle(f"{100 * step['contact_fraction']:.1f} % of the nodes in contact at {step['mean_pressure']:.3g} MPa")
    figure.savefig(folder / "pressure.png", dpi=110)
    print(folder / "pressure.png")


if __name__ == "__main__":
    main()
