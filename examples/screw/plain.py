#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""plain.py [ENTS-HOST] [--out FOLDER]: the screw on plain quad4 segments wrapped round a cylinder, beside the smoothed one.

A prism of n sides whose mean radius is that of the screw carries the same thread as the same height. The preload, then a turn of three degrees in
ten steps; torque over force against the exact value at the radius at which the flank carries.
"""
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE)]
import make_nut  # noqa: E402
import runs  # noqa: E402
import torque  # noqa: E402

SEGMENTS = [("quad4", 4, 4), ("quad4", 64, 1), ("quad4", 256, 1), ("quad4", 1024, 1), ("bspline16", 4, 4), ("bspline16", 8, 2), ("bspline16", 16, 1)]  # kind, around, along


def scene(segment, around, along):
    found = torque.scene(make_nut.M20, 0.1, 1)
    half = math.pi / around
    mean = 1.0 if segment == "bspline16" else math.cos(half) / half * math.log((1 + math.sin(half)) / math.cos(half))
    found["contact"]["master"]["rigid_body"]["cylinder"].update(radius=make_nut.M20.pitch_radius / mean, around=around, along=along)
    found["contact"]["model"]["segment"] = segment
    if segment == "quad4":
        found["contact"]["model"]["border"] = 0.1  # the surfaces of two neighbours end up to 0.07 of half a segment apart
    found["steps"]["values"] = [1, {"to": 2, "count": 10}]
    return found


def exact(radius, mu=0.1):
    """Torque over force of a rigid helix at this radius, tightened."""
    rise = make_nut.M20.pitch / (2 * math.pi * radius)
    secant = math.hypot(1, math.tan(math.radians(make_nut.M20.half_angle)) / math.hypot(1, rise))
    return radius * (rise + mu * secant) / (1 - mu * secant * rise)


def main():
    arguments = runs.arguments(__doc__, "screw_plain")
    print(f"{'segments':<22}{'prism lies in':>16}{'torque / force':>22}{'exact':>9}{'slipping':>10}")
    for segment, around, along in SEGMENTS:
        folder = arguments.out / f"{segment}_{around}x{along}"
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "nut.inp").write_text(make_nut.nut(make_nut.M20, turns=2))
        steps = runs.solve(arguments.program, scene(segment, around, along), folder)["steps"][2:]
        ratio = [-step["moment"][2] / step["contact_force"][2] for step in steps]
        found = [{q["name"]: q["value"] for q in step["exact"]} for step in steps]
        radius = found[-1]["mean radius of contact"]
        short = make_nut.M20.pitch_radius * (1 - math.cos(math.pi / around)) if segment == "quad4" else 0.0
        print(f"{segment + f' {around} x {along}':<22}{1000 * short:>13.1f} um{min(ratio):>12.4f}{max(ratio):>10.4f}"
              f"{exact(radius):>9.4f}{min(f['slipping'] for f in found):>8.0f} %", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
