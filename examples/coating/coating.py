#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""coating.py [ENTS-HOST] [--out FOLDER]: a textured hard coating on a soft substrate, in full contact with a soft block, against the closed form.

The texture, one wave per element of the coating, and a long wave that bends the coating over its substrate are one height on the coating.

Exact, in full contact and for small strains: each wave of amplitude A and wave number k leaves the pressure A / (C1 + C2 + 1 / eps), C the
amplitude of the displacement of each body's surface under a unit wave of pressure, eps the stiffness of the penalty. In a layer, with Airy's
function F(y) cos(k x), F = (c1 + c2 y) exp(k y) + (c3 + c4 y) exp(-k y),
    s_yy = -k^2 F cos, s_xy = k F' sin, u_x = ((1 - nu) F'' + nu k^2 F) / (2 mu k) sin, u_y = ((1 - nu) F''' - (2 - nu) k^2 F') / (2 mu k^2) cos;
the base does not move, stresses and displacements are continuous between layers, and the surface has s_yy = -cos, s_xy = 0.
"""
import json
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs  # noqa: E402

POISSON, PENALTY = 0.3, 1e6
SOFT, HARD = 100.0, 10000.0
UPPER = [(SOFT, 1.0)]                # (modulus, thickness) from the base to the surface
COATED = [(SOFT, 1.0), (HARD, 0.2)]
WAVES = {"texture": (0.00001, 25.0), "long wave": (0.0002, 0.5)}  # amplitude [mm], waves per mm


def solve(matrix, right):
    """Gauss's elimination with the largest pivot."""
    n = len(right)
    rows = [list(row) + [b] for row, b in zip(matrix, right)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda r: abs(rows[r][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for r in range(i + 1, n):
            factor = rows[r][i] / rows[i][i]
            rows[r] = [a - factor * b for a, b in zip(rows[r], rows[i])]
    x = [0.0] * n
    for i in reversed(range(n)):
        x[i] = (rows[i][n] - sum(rows[i][j] * x[j] for j in range(i + 1, n))) / rows[i][i]
    return x


def functions(k, thickness, y, young):
    """(u_x, u_y, s_yy, s_xy) of the four functions of a layer, decaying from its base or its surface; y from the base."""
    mu, nu = young / (2 * (1 + POISSON)), POISSON
    found = []
    for sign, start in ((1, thickness), (-1, 0.0)):
        for power in (0, 1):
            s, z = sign * k, y - start
            e = math.exp(s * z)
            # derivatives of z^power exp(s z)
            f = [(s**n * z**power + (n * s**(n - 1) if power and n else 0)) * e for n in range(4)]
            found.append((((1 - nu) * f[2] + nu * k * k * f[0]) / (2 * mu * k),
                          ((1 - nu) * f[3] - (2 - nu) * k * k * f[1]) / (2 * mu * k * k), -k * k * f[0], k * f[1]))
    return found


def compliance(layers, k):
    """Displacement of the surface into the layers, under the pressure cos(k x)."""
    n = 4 * len(layers)
    matrix, right = [], []

    def row(entries, value=0.0):
        matrix.append([0.0] * n)
        for layer, component, y, sign in entries:
            young, thickness = layers[layer]
            for j, all_of_it in enumerate(functions(k, thickness, y, young)):
                matrix[-1][4 * layer + j] += sign * all_of_it[component]
        right.append(value)
    row([(0, 0, 0.0, 1)])
    row([(0, 1, 0.0, 1)])
    for i in range(len(layers) - 1):
        for component in range(4):
            row([(i, component, layers[i][1], 1), (i + 1, component, 0.0, -1)])
    top = len(layers) - 1
    row([(top, 2, layers[top][1], 1)], -1.0)
    row([(top, 3, layers[top][1], 1)])
    scale = [max(abs(a) for a in line) for line in matrix]
    x = solve([[a / s for a in line] for line, s in zip(matrix, scale)], [b / s for b, s in zip(right, scale)])
    young, thickness = layers[top]
    return -sum(c * f[1] for c, f in zip(x[4 * top:], functions(k, thickness, thickness, young)))


def exact(name):
    amplitude, waves = WAVES[name]
    k = 2 * math.pi * waves
    return amplitude / (compliance(UPPER, k) + compliance(COATED, k) + 1 / PENALTY)


def share(pressure, waves):
    """Amplitude of cos(2 pi waves x) in the pressure of equally spaced nodes from x = 0 to 1."""
    n = len(pressure) - 1
    return 2 / n * sum(p * math.cos(2 * math.pi * waves * i / n) * (0.5 if i in (0, n) else 1) for i, p in enumerate(pressure))


def draw(folder, pressure):
    n, mean = len(pressure) - 1, sum(pressure[1:-1]) / (len(pressure) - 2)
    places = [k / 4000 for k in range(4001)]

    def panel(axes):
        axes.plot(places, [mean + sum(exact(name) * math.cos(2 * math.pi * WAVES[name][1] * x) for name in WAVES) for x in places],
                  color=runs.GREY, linewidth=4, label="closed form")
        axes.plot([i / n for i in range(n + 1)], pressure, color=runs.BLUE, linewidth=1.3, label="25 elements of the coating, with their texture")
        axes.set(xlabel="x [mm]", ylabel="pressure [MPa]", xlim=(0, 1))
        runs.legend_above(axes)

    runs.draw(folder / "coating.png", (1000, 420), panel)


def main():
    arguments = runs.arguments(__doc__, "coating")
    result = runs.solve(arguments.program, HERE / "scene.json", arguments.out / "run", "--nodes")
    steps = []
    for step in result["steps"]:
        nodes = step["nodes"]
        row = sorted((nodes["position"][2 * k], p) for k, p in enumerate(nodes["pressure"]))
        pressure = [p for _, p in row]
        if min(pressure) <= 0:
            print(f"{step['value']:g}: {sum(p > 0 for p in pressure)} of {len(pressure)} nodes touch")
            continue
        steps.append([runs.quantity(f"pressure of the {name}", share(pressure, WAVES[name][1]), exact(name)) for name in WAVES])
        print(f"{step['value']:g}: " + "; ".join(f"{q['name']} {q['value']:.5f} MPa, exact {q['exact']:.5f} ({100 * q['relative_error']:+.2f} %)"
                                                 for q in steps[-1]))
    if not steps:
        sys.exit("no step is in full contact")
    for name, (_, waves) in WAVES.items():
        k = 2 * math.pi * waves
        print(f"{name}: compliance of the soft block {compliance(UPPER, k):.6g}, of the coated one {compliance(COATED, k):.6g}, "
              f"without its coating {compliance([(SOFT, 1.2)], k):.6g} mm/MPa")
    runs.write_result(arguments.out, steps)
    draw(arguments.out, pressure)
    return 0


if __name__ == "__main__":
    sys.exit(main())
