#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""unwind.py [ENTS-HOST] [--out FOLDER]: an M20 screw that is pulled with 20 kN and held by a torque, which is then taken away.

Below the coefficient of friction from which the screw locks itself (0.0354) the load unwinds it, more than once round, against a soft spring about
its axis; above it stays where it is. Nothing but the loads drives the screw. A nut of one turn, which is elastic.

Exact: T / F = r (tan a - mu sec b) / (1 + mu sec b tan a), r the radius at which the flank carries; the spring has that torque.
"""
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE)]
import make_nut  # noqa: E402
import runs  # noqa: E402
import torque  # noqa: E402

THREAD, FORCE, SPRING = make_nut.M20, 20000.0, 500.0  # N; N mm per radian
RUNS = {0.02: 24, 0.05: 8}  # friction: steps in which the torque is taken away


def scene(mu, steps):
    found = torque.scene(THREAD, mu, 1)
    del found["exact"]  # of a prescribed turn
    body = found["contact"]["master"]["rigid_body"]
    del body["prescribed"]
    held = FORCE * THREAD.pitch / (2 * math.pi)  # what a screw without friction needs
    body["loads"] = [{"z": -FORCE, "path": [[0, 0], [1, 1]]}, {"turn_z": held, "path": [[0, 0], [1, 1], [2, 0]]}]
    body["springs"] = [{"turn_z": SPRING}]
    found["steps"]["values"] = [1, {"to": 2, "count": steps}]
    found["solver"] = {"extrapolate": True, "tolerance": 1e-9}
    return found


def mean_radius(nodes):
    """Where the flank carries on average, weighted with the axial forces."""
    radii = [math.hypot(*nodes["position"][i:i + 2]) for i in range(0, len(nodes["position"]), 3)]
    return sum(r * f for r, f in zip(radii, nodes["force"][2::3])) / sum(nodes["force"][2::3])


def exact(radius, mu):
    rise = THREAD.pitch / (2 * math.pi * radius)
    secant = math.hypot(1, THREAD.tan / math.hypot(1, rise))
    return radius * (rise - mu * secant) / (1 + mu * secant * rise)


def draw(folder, results):
    def panel(axes):
        for mu, result in results.items():
            axes.plot([2 - step["value"] for step in result["steps"]],
                      [-step["reference_point"]["turns"][2] / (2 * math.pi) for step in result["steps"]], "o-", markersize=5, label=f"friction {mu}")
        axes.set(xlabel="torque that holds the screw, over that without friction", ylabel="turns it has unwound", xlim=(1, 0))
        axes.set_ylim(bottom=-0.05)
        axes.legend(loc="upper left")

    runs.draw(folder / "unwind.png", (700, 420), panel)


def main():
    arguments = runs.arguments(__doc__, "screw_unwind")
    results, quantities = {}, []
    print(f"{'friction':>8}{'held':>7}{'turns':>9}{'torque / force':>16}{'exact':>9}{'error':>10}  residuals of the last iterations")
    for mu, count in RUNS.items():
        folder = arguments.out / f"friction_{mu}"
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "nut.inp").write_text(make_nut.nut(THREAD, turns=1))
        results[mu] = runs.solve(arguments.program, scene(mu, count), folder, "--nodes")
        for step in results[mu]["steps"]:
            turns = step["reference_point"]["turns"][2] / (2 * math.pi)
            ratio, locked = -step["moment"][2] / step["contact_force"][2], exact(mean_radius(step["nodes"]), mu)
            unwinds = turns < -0.05
            print(f"{mu:>8.2f}{2 - step['value']:>7.2f}{turns:>9.4f}{ratio:>16.4f}"
                  + (f"{locked:>9.4f}{100 * (ratio / locked - 1):>8.2f} %" if unwinds else f"{'':>9}{'sticks':>10}")
                  + "  " + " ".join(f"{r:.0e}" for r in step["increments"][-1]["residuals"][-4:]), flush=True)
            if unwinds:
                quantities.append([runs.quantity("torque / force, unwinding", ratio, locked)])
    quantities.append([runs.quantity("turns, friction 0.05", abs(results[0.05]["steps"][-1]["reference_point"]["turns"][2]) / (2 * math.pi), 0.0),
                       runs.quantity("turns, friction 0.02", -results[0.02]["steps"][-1]["reference_point"]["turns"][2] / (2 * math.pi),
                                     exact(mean_radius(results[0.02]["steps"][-1]["nodes"]), 0.02) * FORCE / SPRING / (2 * math.pi))])
    runs.write_result(arguments.out, quantities)
    draw(arguments.out, results)
    return 0


if __name__ == "__main__":
    sys.exit(main())
