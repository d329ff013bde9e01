#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""peel.py [ENTS-LAB] [--out FOLDER]: a bonded strip is peeled off a rigid plane, against beam theory and the balance of energy.

The load F at the end moves by d. The compliance d / F of a strip gives the length a that is free, and F^2 a^2 / (2 E' I) is what the crack
takes for its length; the bond says what that has to be. What the load has done is stored in strip and bond, or has gone with the bond.
"""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs  # noqa: E402

THICKNESS, BENDING, ENERGY, LIFT = 0.5, 1000 / (1 - 0.3 ** 2) * 0.5 ** 3 / 12, 0.01, 1.2


def draw(folder, result):
    last = len(result["steps"])

    def strip(axes):
        points = runs.vtu_points(folder, last, "bulk", displaced=True)
        cells = runs.vtu_values(folder, last, "bulk", "connectivity", "q")
        for i in range(0, len(cells), 4):
            axes.fill(*list(zip(*(points[n] for n in cells[i:i + 4])))[:2], color=runs.PALE, linewidth=0)
        pulled = list(zip(runs.vtu_points(folder, last, "slave"), runs.vtu_values(folder, last, "slave", "pressure")))
        axes.axhline(0, color=runs.DARK, linewidth=1)
        for tension, color in ((True, runs.ORANGE), (False, runs.BLUE)):
            some = [(x[0], abs(p)) for x, p in pulled if p != 0 and (p < 0) == tension]
            axes.vlines([x for x, _ in some], [-0.8 * p for _, p in some], 0, color=color, linewidth=1.5)
        axes.set(title="tension at the tip of the crack (orange), pressure ahead of it (blue)", aspect="equal", xlim=(-0.3, 12.3))
        axes.axis("off")

    def force(axes):
        lifts = [LIFT * s["value"] for s in result["steps"]]
        exact = [(2 * BENDING * ENERGY) ** 0.5 / (3 * d * (BENDING / (2 * ENERGY)) ** 0.5) ** 0.5 for d in lifts]
        axes.plot(lifts, exact, color=runs.GREY, linewidth=5, label="a beam that is clamped where the bond begins")
        axes.plot(lifts, [-s["force"] for s in result["steps"]], color=runs.BLUE, label="ents")
        axes.set(xlabel="lift of the end [mm]", ylabel="force [N/mm]", ylim=(0, 0.5))
        axes.legend(frameon=False)

    runs.draw(folder / "peel.png", (900, 620), strip, force, below=True)


def main():
    arguments = runs.arguments(__doc__, "peel")
    result = runs.solve(arguments.program, HERE / "scene.json", arguments.out)
    steps, work, gone, stored = [], 0.0, 0.0, 0.0
    print(f"{'lift [mm]':>10}{'force':>10}{'free length':>13}{'energy of crack':>17}{'work':>12}{'stored + gone':>15}")
    for step in result["steps"]:
        energy = step["energy"]
        work, gone, stored = work + energy["work"], gone + energy["dissipated"], stored + energy["stored"]
        lift, force = LIFT * step["value"], -step["force"]
        if not force > 0:
            continue
        free = (3 * BENDING * lift / force) ** (1 / 3)
        of_crack = (force * free) ** 2 / (2 * BENDING)
        if free < 8 * THICKNESS:
            continue  # no beam yet
        steps.append([runs.quantity("energy of the crack", of_crack, ENERGY), runs.quantity("work of the load", work, stored + gone)])
        print(f"{lift:>10.2f}{force:>10.5f}{free:>13.3f}{of_crack:>17.6f}{work:>12.6f}{stored + gone:>15.6f}")
    runs.write_result(arguments.out, steps)
    draw(arguments.out, result)
    return 0


if __name__ == "__main__":
    sys.exit(main())
