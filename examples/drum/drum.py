#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""drum.py [ENTS-HOST] [--out FOLDER]: the signal of a textured drum, with smoothed segments and with plain ones.

A rigid drum of radius 10 mm turns by 30 degrees under a knife edge that is guided along y and pushed down by a spring. The drum is a mesh of
segments of 15 degrees; its texture, 10 waves of 20 um, is a height along the circumference.

Exact: the edge stands on r(s) = R + A sin(k s), s = R times the angle. The spring pushes with F = c (r - r0), and without friction the work
of the torque is that of the spring: T = F dr/d(angle).
"""
import json
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs  # noqa: E402

RADIUS, AMPLITUDE, WAVES = 10.0, 0.02, 2.0  # waves per mm
STIFFNESS, RELAXED = 1000.0, 9.75           # E / 3 of the triangle [N/mm]; place of the edge without force
WAYS = {"bspline": "C2 splines", "catmull_rom": "C1 splines", "plain": "plain segments"}
BORDERS = [7.5 + 15 * i for i in range(2)]  # degrees


def exact(turn):
    """(force, torque / force) at a turn [degrees]."""
    a, k = math.radians(turn), 2 * math.pi * WAVES
    return STIFFNESS * (RADIUS + AMPLITUDE * math.sin(k * RADIUS * a) - RELAXED), AMPLITUDE * k * RADIUS * math.cos(k * RADIUS * a)


def signal(result):
    """[(turn, force, torque / force)], the torque against the turn."""
    rows = []
    for step in result["steps"]:
        force = -step["contact_force"][1]
        rows.append((30 * (step["value"] - 1), force, -step["moment"][0] / force))
    return rows


def quantities(name, rows):
    """Of each row, and the largest jump beside a border: of what the exact answer does not do from a step to the next. Plain segments reach
    a hundredth of a segment beyond their borders, so that the jump is not at the border itself."""
    steps = []
    for turn, force, arm in rows:
        right = exact(turn)
        steps.append([runs.quantity(f"force, {name}", force, right[0]), runs.quantity(f"torque / force, {name}", arm, right[1])])
    pairs = [(a, b) for a, b in zip(rows, rows[1:]) if any(a[0] < x + 0.5 and b[0] > x - 0.5 for x in BORDERS)]
    jump = max(abs(b[2] - a[2] - exact(b[0])[1] + exact(a[0])[1]) for a, b in pairs)
    steps.append([runs.quantity(f"jump of torque / force, {name}", jump, 0.0)])
    return steps


def draw(folder, signals):
    turns = [t / 100 for t in range(3001)]

    def panel(axes, quantity):
        def curve(name, color, label):
            axes.plot([row[0] for row in signals[name]], [row[1 + quantity] for row in signals[name]], color=color, linewidth=1.5, label=label)

        curve("plain", runs.ORANGE, "plain segments")
        axes.plot(turns, [exact(t)[quantity] for t in turns], color=runs.GREY, linewidth=4, label="exact")
        curve("bspline", runs.BLUE, "C2 splines")
        for x in BORDERS:
            axes.axvline(x, color="#999999", linewidth=1, dashes=(4, 3))
        axes.set(xlim=(0, 30), ylabel=("force [N]", "torque / force [mm]")[quantity], xlabel=("", "turn [degrees]; dashed: borders of segments")[quantity])
        axes.grid(False, axis="x")
        if quantity == 0:
            runs.legend_above(axes)

    runs.draw(folder / "drum.png", (1100, 620), lambda axes: panel(axes, 0), lambda axes: panel(axes, 1), below=True)


def main():
    arguments = runs.arguments(__doc__, "drum")
    signals, steps = {}, []
    for name in WAYS:
        options = [] if name == "bspline" else ["--variant", name]
        signals[name] = signal(runs.solve(arguments.program, HERE / "scene.json", arguments.out / name, *options))
        steps += quantities(name, signals[name])
    runs.write_result(arguments.out, steps)
    draw(arguments.out, signals)
    print(f"{'segments':<16}{'force':>10}{'torque / force':>18}{'jump of torque / force at borders':>36}")
    for name, words in WAYS.items():
        worst = {}
        for q in (q for step in steps for q in step if q["name"].endswith(", " + name)):
            worst[q["name"]] = max(worst.get(q["name"], 0), abs(q["relative_error"] if q["name"].startswith("force") else q["value"] - q["exact"]))
        force, arm, jump = worst.values()
        print(f"{words:<16}{100 * force:>8.3f} %{arm:>15.4f} mm{jump:>33.5f} mm")
    return 0


if __name__ == "__main__":
    sys.exit(main())
