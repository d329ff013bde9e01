#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""running_in.py [ENTS-HOST] [--out FOLDER]: a textured slider that wears, in full contact with an elastic layer, against the closed form.

Exact, in full contact and for small slopes (Archard's law, wear k p per slid length): a wave of the texture of amplitude A leaves a wave of the
pressure of amplitude A / C, which wears it off: A = A0 exp(-k s / C), C = c + 1 / eps. c is the compliance of a bonded layer at that wave length
in plane strain, eps the stiffness of the penalty. The worn volume is k F s.
"""
import json
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs  # noqa: E402


def compliance(young, poisson, wave_number, thickness):
    """Displacement of the surface of a bonded layer under a unit wave of pressure."""
    kappa, t = 3 - 4 * poisson, wave_number * thickness
    return (2 * (1 - poisson**2) / (young * wave_number) * (kappa * math.sinh(2 * t) - 2 * t)
            / (kappa * math.cosh(2 * t) + 2 * t * t + (1 + kappa**2) / 2))


def first_wave(nodes):
    """Amplitude of cos(2 pi x) in the pressure; the nodes are equally far apart, and the last one is the first."""
    places, pressure = nodes["position"][::2], nodes["pressure"]
    pairs = sorted(zip(places, pressure))[:-1] if max(places) - min(places) > 1 - 1e-9 else list(zip(places, pressure))
    return abs(2 / len(pairs) * sum(p * math.cos(2 * math.pi * x) for x, p in pairs))


def draw(folder, result, slid, rate, amplitude):
    last = len(slid) - 1

    def pressures(axes):
        for i in (0, last // 4, last // 2, last):
            nodes = result["steps"][i]["nodes"]
            axes.plot(*zip(*sorted(zip(nodes["position"][::2], nodes["pressure"]))), linewidth=2, label=f"{slid[i] / 1000:g} m")
        axes.set(xlabel="place [mm]", ylabel="pressure [MPa]", xlim=(-0.5, 0.5))
        axes.set_ylim(bottom=0)
        axes.legend(loc="lower center", title="slid")

    def amplitudes(axes):
        metres = [0.9 * k / 300 for k in range(301)]
        axes.plot(metres, [amplitude * math.exp(-rate * 1000 * s) for s in metres], color=runs.DARK, linewidth=1.5, label="exact")
        axes.plot([s / 1000 for s in slid], [first_wave(step["nodes"]) for step in result["steps"]], "o", color=runs.BLUE, label="computed")
        axes.set(xlabel="slid [m]", ylabel="amplitude of the pressure [MPa]", xlim=(0, 0.9))
        axes.set_ylim(bottom=0)
        axes.legend(loc="upper right")

    runs.draw(folder / "running_in.png", (1000, 420), pressures, amplitudes)


def main():
    arguments = runs.arguments(__doc__, "running_in")
    result = runs.solve(arguments.program, HERE / "scene.json", arguments.out / "run", "--nodes")
    scene = json.loads((HERE / "scene.json").read_text())
    material, contact = scene["materials"]["block"], scene["contact"]["model"]["contact"]
    wear, height = contact["wear"]["coefficient"], scene["contact"]["model"]["height"]["of"][0]["amplitude"]
    (first, rest) = scene["history"]["slid"]
    slid = [first, *(first + (rest["to"] - first) * (i + 1) / rest["count"] for i in range(rest["count"]))]
    in_all = compliance(material["young"], material["poisson"], 2 * math.pi, 1) + 1 / contact["normal"]["stiffness"]
    steps = []
    print(f"{'slid [m]':>8}{'amplitude [MPa]':>18}{'exact':>10}{'error':>10}{'worn [mm^2]':>14}{'k F s':>10}")
    for s, step in zip(slid, result["steps"]):
        found = [runs.quantity("amplitude of the pressure", first_wave(step["nodes"]), height / in_all * math.exp(-wear * s / in_all)),
                 runs.quantity("worn volume of the slider", step["wear"]["master_volume"], wear * step["force"] * s)]
        steps.append(found)
        print(f"{s / 1000:>8.3f}" + f"{found[0]['value']:>18.4f}{found[0]['exact']:>10.4f}{100 * found[0]['relative_error']:>8.2f} %"
              f"{found[1]['value']:>14.6f}{found[1]['exact']:>10.6f}")
    runs.write_result(arguments.out, steps)
    draw(arguments.out, result, slid, wear / in_all, height / in_all)
    return 0


if __name__ == "__main__":
    sys.exit(main())
