#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""sheet.py [ENTS-HOST] [--out FOLDER]: a corrugated sheet as a height on a flat strip, against the mesh of the corrugation.

A sheet of thickness t whose middle is z = f sin(pi x / c) is held at x = 0; a round indenter bends it down by 25 mm, 85 mm away from there, and
slides outwards over two of its waves. Enrichment changes where the surface is, not how stiff the sheet is: the strip gets a thickness and a modulus that have
the bending and the membrane stiffness of the corrugation, per width and in plane strain,

    D = (c / s) E t^3 / (12 (1 - nu^2)),    1 / A = (1 / c) (integral of z^2 ds / D0 + integral of (dx/ds)^2 (1 - nu^2) / (E t) ds),

s the length of half a wave, D0 that of the flat sheet: t* = sqrt(12 D / A), E* = A / t*, nu* = 0.
"""
import json
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import runs  # noqa: E402

YOUNG, POISSON = 210000.0, 0.0
F, C, THICKNESS, WAVES = 2.0, 10.0, 0.5, 8
K = math.pi / C
ALONG, ACROSS = 3520, 1  # elements of the explicit mesh
START = (85.0, 2.26)     # lowest point of the indenter


def equivalent(points=20000):
    """(D, A) of the corrugation, per width, by the midpoint rule over half a wave."""
    flat = YOUNG * THICKNESS**3 / (12 * (1 - POISSON**2))
    length = squares = shares = 0.0
    for i in range(points):
        x = (i + 0.5) * C / points
        ds = math.hypot(1, F * K * math.cos(K * x)) * C / points
        length += ds
        squares += (F * math.sin(K * x))**2 * ds
        shares += (C / points)**2 / ds
    return C / length * flat, C / (squares / flat + shares * (1 - POISSON**2) / (YOUNG * THICKNESS))


def middle(count):
    """(x, z, slope) of points at equal distances along the middle of the sheet."""
    fine, at, arc = 40 * count, [], 0.0
    step = 2 * C * WAVES / fine
    arcs = [0.0]
    for i in range(fine):
        arcs.append(arcs[-1] + step * math.hypot(1, F * K * math.cos(K * (i + 0.5) * step)))
    i = 0
    for j in range(count + 1):
        arc = arcs[-1] * j / count
        while i + 1 < fine and arcs[i + 1] < arc:
            i += 1
        x = step * (i + (arc - arcs[i]) / (arcs[i + 1] - arcs[i]))
        at.append((x, F * math.sin(K * x), F * K * math.cos(K * x)))
    return at


def deck(name, nodes, elements, sets, surfaces):
    """An Abaqus deck of quadrilaterals; surfaces: [(name, [(element, face)])]."""
    lines = ["*NODE"] + [f"{i + 1}, {x:.9g}, {y:.9g}" for i, (x, y) in enumerate(nodes)]
    lines += [f"*ELEMENT, TYPE=CPE4, ELSET={name}"] + [f"{i + 1}, " + ", ".join(str(n + 1) for n in e) for i, e in enumerate(elements)]
    for set_name, members in sets:
        lines.append(f"*NSET, NSET={set_name}")
        lines += [str(n + 1) for n in members]
    for surface, faces in surfaces:
        lines.append(f"*SURFACE, NAME={surface}")
        lines += [f"{e + 1}, S{f}" for e, f in faces]
    return "\n".join(lines) + "\n"


def band(columns, rows, at):
    """Nodes and elements of a grid of points at(i, j), j from below."""
    nodes = [at(i, j) for j in range(rows + 1) for i in range(columns + 1)]
    wide = columns + 1
    elements = [(j * wide + i, j * wide + i + 1, (j + 1) * wide + i + 1, (j + 1) * wide + i) for j in range(rows) for i in range(columns)]
    return nodes, elements


def corrugation():
    line = middle(ALONG)

    def at(i, j):
        x, z, slope = line[i]
        out = THICKNESS * (j / ACROSS - 0.5) / math.hypot(1, slope)
        return x - out * slope, z + out
    nodes, elements = band(ALONG, ACROSS, at)
    held = [j * (ALONG + 1) for j in range(ACROSS + 1)]
    top = [((ACROSS - 1) * ALONG + i, 3) for i in range(ALONG)]
    return deck("SHEET", nodes, elements, [("X_MIN", held)], [("Y_MAX", top)])


def indenter(radius=4.0, inner=2.5, columns=98, rows=2):
    """The lower part of a ring, above a crest of the sheet."""
    def at(i, j):
        a, r = math.radians(-160 + 140 * i / columns), radius + (inner - radius) * j / rows
        return START[0] + r * math.cos(a), START[1] + radius + r * math.sin(a)
    nodes, elements = band(columns, rows, at)
    wide = columns + 1
    return deck("INDENTER", nodes, elements, [("INNER", list(range(rows * wide, (rows + 1) * wide)))],
                [("ROUND", [(i, 1) for i in range(columns)])])


def explicit(scene, folder):
    """The same scene with the mesh of the corrugation."""
    (folder / "corrugation.inp").write_text(corrugation())
    scene["materials"]["steel"] = {"law": "st_venant_kirchhoff", "young": YOUNG, "poisson": POISSON}
    scene["parts"] = [{"name": "sheet", "material": "steel", "deck": str((folder / "corrugation.inp").resolve())},
                      dict(scene["parts"][1], deck=str(HERE / "indenter.inp"))]
    scene["supports"][0]["nodes"] = "sheet.X_MIN"
    scene["contact"]["master"] = {"faces": "sheet.Y_MAX", "ends": "straight"}
    scene["contact"]["model"]["height"] = None
    scene["solver"]["tolerance"] = 1e-6  # rounding of a modulus 10^3 times as large
    return scene


def draw(folder, rows):
    middle_step = len(rows) // 2
    strip, mesh = (runs.vtu_points(folder / name, middle_step) for name in ("strip", "explicit"))
    ring = runs.vtu_points(folder / "strip", middle_step, "slave")
    bulk = runs.vtu_points(folder / "strip", middle_step, "bulk", displaced=True)
    columns = len(bulk[:2 * 401]) // 2
    outline = bulk[:columns] + bulk[columns:2 * columns][::-1] + bulk[:1]

    def shapes(axes):
        axes.fill(*list(zip(*outline))[:2], color="#dddddd", label="strip of equal stiffness")
        for points, color, width, label in ((mesh, runs.PALE, 4, "mesh of the corrugation"), (strip, runs.ORANGE, 1.5, "its height on the strip"),
                                            (ring, runs.DARK, 3, "indenter")):
            axes.plot(*list(zip(*points))[:2], color=color, linewidth=width, label=label)
        axes.set(xlim=(-2, 160), ylim=(-45, 8), aspect="equal")
        axes.axis("off")
        axes.legend(loc="lower left", bbox_to_anchor=(0.2, 0.05))

    def forces(axes):
        slide, along, across, mesh_along, mesh_across = zip(*rows)
        for y, color, width, label in ((mesh_across, runs.GREY, 5, "across, mesh of the corrugation"), (across, runs.ORANGE, 1.5, "height on the strip"),
                                       (mesh_along, runs.GREY, 5, "along, mesh of the corrugation"), (along, runs.BLUE, 1.5, "height on the strip")):
            axes.plot(slide, y, color=color, linewidth=width, label=label)
        axes.set(xlabel="slide [mm]", ylabel="force [N]")
        runs.legend_above(axes)

    runs.draw(folder / "sheet.png", (1100, 720), shapes, forces, below=True)


def main():
    arguments = runs.arguments(__doc__, "sheet")
    bending, membrane = equivalent()
    thickness = math.sqrt(12 * bending / membrane)
    print(f"bending stiffness {bending:.2f} N mm, membrane stiffness {membrane:.2f} N/mm: t* {thickness:.6f} mm, E* {membrane / thickness:.5f} MPa")
    scene = json.loads((HERE / "scene.json").read_text())
    strip = runs.solve(arguments.program, HERE / "scene.json", arguments.out / "strip")
    (arguments.out / "explicit").mkdir(parents=True, exist_ok=True)
    mesh = runs.solve(arguments.program, explicit(scene, arguments.out), arguments.out / "explicit")
    rows, steps = [], []
    largest = max(math.hypot(*step["contact_force"]) for step in mesh["steps"])
    for a, b in zip(strip["steps"], mesh["steps"]):
        f, g = a["contact_force"], b["contact_force"]
        if a["value"] >= 1:
            rows.append((40 * (a["value"] - 1), f[0], -f[1], g[0], -g[1]))
        steps.append([runs.quantity("force", math.hypot(*f), math.hypot(*g)),
                      runs.quantity("difference of the force / largest force", math.hypot(f[0] - g[0], f[1] - g[1]) / largest, 0.0),
                      runs.quantity("difference of the force / force", math.hypot(f[0] - g[0], f[1] - g[1]) / math.hypot(*g), 0.0)])
    runs.write_result(arguments.out, steps)
    draw(arguments.out, rows)
    for name in ("force", "difference of the force / largest force", "difference of the force / force"):
        worst = max(abs(q["relative_error"] if name == "force" else q["value"]) for step in steps for q in step if q["name"] == name)
        print(f"largest difference, {name}: {100 * worst:.2f} %")
    for name, run in (("strip", strip), ("mesh", mesh)):
        print(f"{name}: {run['sizes']['elements']} elements, {run['sizes']['equations']} equations, {run['wall_time']['total']:.1f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
