#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""adhesion.py [ENTS-LAB] [--out FOLDER]: adhesive surfaces touch, jump together, are pulled apart, and jump apart.

A rigid wave of the length L = 1 mm and the height h = 0.5 um on a layer that is thicker than L. Its work of adhesion w is given by
alpha^2 = 2 L w / (pi^2 E* h^2). Exact, for tension of no range: K. L. Johnson, Int. J. Solids Struct. 32 (1995) 423,
    p / p* = sin^2(pi a / L) - alpha sqrt(tan(pi a / L)),  p* = pi E* h / L,
whose smallest value is the pull-off. And a rigid cylinder of the radius R = 10 mm, w = 0.01 N/mm (variant "cylinder"), JKR in the plane:
    P(a) = pi E* a^2 / (4 R) - sqrt(2 pi E* a w),  pull-off -3 (pi E* w^2 R / 16)^(1/3).
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
CYLINDER = -3 * (math.pi * MODULUS * 0.01 ** 2 * 10 / 16) ** (1 / 3)


def exact(alpha):
    """p / p* at pull-off."""
    def pressure(a):
        return math.sin(math.pi * a) ** 2 - alpha * math.sqrt(math.tan(math.pi * a))
    return min(pressure(i / 20000) for i in range(1, 6000))


def scene_of(alpha):
    """The scene with this adhesion: down until it has jumped into contact, and up until it has jumped out of it."""
    scene = json.loads((HERE / "scene.json").read_text())
    work, strength, far = 0.5 * (alpha * math.pi * HEIGHT) ** 2 * MODULUS, 10 * alpha, -1.5e-3 * alpha
    scene["contact"]["model"]["contact"]["normal"].update(work=work, strength=strength, stiffness=max(2e6, 4 * strength ** 2 / work))
    scene["steps"]["values"] = [far, {"to": 0, "count": 30}, {"to": far, "count": 30}]
    return scene


def main():
    command = runs.arguments(__doc__, "adhesion")
    curves, quantities = {}, []
    for alpha in ALPHAS:
        result = runs.solve(command.program, scene_of(alpha), command.out / f"alpha_{alpha}", "--no-pictures")
        curves[alpha] = [(step["value"], step["mean_pressure"] / FULL) for step in result["steps"]]
        pull, energy = min(p for _, p in curves[alpha]), result["energy"]
        quantities.append(runs.quantity(f"pull-off / p*, alpha {alpha}", -pull, -exact(alpha)))
        quantities.append(runs.quantity(f"lost in jumps, alpha {alpha}", energy["lost_in_jumps"], energy["work"]))
        print(f"alpha {alpha}: pull-off {pull:.5f} p*, Johnson {exact(alpha):.5f}; {energy['steps_with_jumps']} jumps lose "
              f"{energy['lost_in_jumps']:.4g} +- {energy['uncertainty_of_jumps']:.1g} N mm, the loop takes {energy['work']:.4g}", flush=True)
    steps = runs.solve(command.program, HERE / "scene.json", command.out / "cylinder", "--variant", "cylinder", "--no-pictures")["steps"]
    width = 4 / 1024
    pull = 2 * min(step["force"] for step in steps) / width
    quantities.append(runs.quantity("pull-off of the cylinder", -pull, -CYLINDER))
    print(f"cylinder: pull-off {pull:.4f} N/mm, JKR {CYLINDER:.4f}")
    runs.write_result(command.out, [quantities])

    def panel(axes):
        for alpha, color in zip(ALPHAS, (runs.PALE, runs.BLUE, runs.ORANGE)):
            axes.plot([1e3 * m for m, _ in curves[alpha]], [p for _, p in curves[alpha]], color=color, label=f"alpha = {alpha}")
            axes.axhline(exact(alpha), color=color, linestyle="--", linewidth=1)
        axes.set_xlabel("motion of the wave towards the layer [um]")
        axes.set_ylabel("mean pressure / p*")
        axes.legend(title="dashed: Johnson", loc="lower left", bbox_to_anchor=(0, 0.07))
    runs.draw(command.out / "adhesion.png", (640, 400), panel)


if __name__ == "__main__":
    main()
