#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""adhesion.py [ENTS-LAB] [--out FOLDER]: an adhesive wave is pulled off an elastic layer.

A rigid wave of the length L = 1 mm and the height h = 0.5 um touches a layer that is thicker than L, and is pulled away. Its work of adhesion
w is given by alpha^2 = 2 L w / (pi^2 E* h^2). Exact, for tension of no range: K. L. Johnson, Int. J. Solids Struct. 32 (1995) 423,
    p / p* = sin^2(pi a / L) - alpha sqrt(tan(pi a / L)),  p* = pi E* h / L,
whose smallest value is the pull-off.
"""
import json
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs  # noqa: E402

MODULUS, HEIGHT = 1000 / (1 - 0.3 ** 2), 5e-4  # E*, h; L = 1
FULL = math.pi * MODULUS * HEIGHT              # p*
ALPHAS = (0.1, 0.2, 0.4)


def exact(alpha):
    """p / p* at pull-off."""
    def pressure(a):
        return math.sin(math.pi * a) ** 2 - alpha * math.sqrt(math.tan(math.pi * a))
    return min(pressure(i / 20000) for i in range(1, 6000))


def scene_of(alpha):
    """The scene with this adhesion, pulled until a little beyond the largest tension."""
    scene = json.loads((HERE / "scene.json").read_text())
    work, strength = 0.5 * (alpha * math.pi * HEIGHT) ** 2 * MODULUS, 10 * alpha
    scene["contact"]["model"]["contact"]["normal"].update(work=work, strength=strength, stiffness=max(2e6, 4 * strength ** 2 / work))
    last = {0.1: -7.5e-5, 0.2: -1.6e-4, 0.4: -3.6e-4}[alpha]
    scene["steps"]["values"] = [1e-5 * alpha / 0.2, {"to": last, "count": 30}]
    return scene


def main():
    command = runs.arguments(__doc__, "adhesion")
    curves, quantities = {}, []
    for alpha in ALPHAS:
        result = runs.solve(command.program, scene_of(alpha), command.out / f"alpha_{alpha}")
        curves[alpha] = [(step["value"], step["mean_pressure"] / FULL) for step in result["steps"]]
        pull = min(p for _, p in curves[alpha])
        quantities.append(runs.quantity(f"pull-off / p*, alpha {alpha}", -pull, -exact(alpha)))
        print(f"alpha {alpha}: pull-off {pull:.5f} p*, Johnson {exact(alpha):.5f}")
    runs.write_result(command.out, [quantities])

    def panel(axes):
        for alpha, color in zip(ALPHAS, (runs.PALE, runs.BLUE, runs.ORANGE)):
            axes.plot([1e3 * m for m, _ in curves[alpha]], [p for _, p in curves[alpha]], color=color, label=f"alpha = {alpha}")
            axes.axhline(exact(alpha), color=color, linestyle="--", linewidth=1)
        axes.set_xlabel("motion of the wave towards the layer [um]")
        axes.set_ylabel("mean pressure / p*")
        axes.legend(title="dashed: pull-off, Johnson 1995")
    runs.draw(command.out / "adhesion.png", (640, 400), panel)


if __name__ == "__main__":
    main()
