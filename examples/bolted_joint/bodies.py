# SPDX-License-Identifier: BSD-3-Clause
"""The joint with its threads as a mesh (`explicit`), and with plain cylinders on which the bolt's thread is a height (`enriched`)."""
import math
from dataclasses import dataclass

from grid import Disc, Mesh, Wound
from joint_parts import TURNS

PARTS = 4  # of a turn, whose loads are printed


@dataclass
class Fineness:
    """Of an explicit mesh: columns around; elements across a ridge, along the groove, up the ridge, from the root inwards; up the core."""
    columns: int
    ridge: int
    groove: int
    up: int
    inwards: int
    core: float


def spaced(low, high, size):
    n = max(1, round((high - low) / size))
    return [low + (high - low) * i / n for i in range(n + 1)]


def graded(low, high, count, power=1.4):
    """Fine at `low`."""
    return [low + (high - low) * (i / count) ** power for i in range(count + 1)]


def plate(mesh, joint, columns, layers, wider=1.0):
    disc = Disc(mesh, "plate", columns, 1.0)
    radii = [wider * r for r in (joint.hole / 2, joint.across / 2, 0.35 * joint.plate, joint.plate / 2)]
    heights = [-joint.grip + joint.grip * i / layers for i in range(layers + 1)]
    mesh.surfaces["PLATE_NUT"], mesh.surfaces["PLATE_HEAD"] = [], []
    for low, high in zip(heights, heights[1:]):
        rings = disc.ring_layer("PLATE", low, high, radii, radii)
        under = [e for k in (0, 1) for e in rings[k]]
        if high == 0:
            mesh.surfaces["PLATE_NUT"] = [(e, 2) for e in under]
        if low == -joint.grip:
            mesh.surfaces["PLATE_HEAD"] = [(e, 1) for e in under]
    middle = [disc.ring_node(heights[layers // 2], columns // 4 * i, 3, radii[3]) for i in range(4)]
    mesh.held += middle
    mesh.sets["HOLD_Z"] = set(middle)


def same_area(columns):
    """Factor of the radius: a polygon of so many corners then has the area of the circle."""
    return math.sqrt(2 * math.pi / columns / math.sin(2 * math.pi / columns))


def head_and_shank(mesh, joint, disc, radii, sizes, wider=1.0):
    """Up to where the thread begins; `radii` of the rings at that height, the last but one being the thread's root (plain: the cylinder)."""
    columns, bottom = disc.columns, -joint.grip - joint.head_height
    shank = radii[:-1] + [joint.pitch_radius * wider]
    wide = shank + [joint.hole / 2 * wider, joint.across / 2 * wider]
    heights = spaced(bottom, -joint.grip, sizes[0])
    mesh.surfaces["HEAD"] = []
    for low, high in zip(heights, heights[1:]):
        disc.core_layer("HEAD", low, high)
        rings = disc.ring_layer("HEAD", low, high, wide, wide)
        if high == heights[-1]:
            mesh.surfaces["HEAD"] = [(e, 2) for e in rings[len(wide) - 2]]
    mesh.held += [disc.ring_node(bottom, columns // 4 * i, len(wide) - 1, wide[-1]) for i in range(4)]
    heights = spaced(-joint.grip, joint.threaded[0] - 1, sizes[1]) + [joint.threaded[0]]
    for low, high in zip(heights, heights[1:]):
        disc.core_layer("SHANK", low, high)
        disc.ring_layer("SHANK", low, high, shank, radii if high == heights[-1] else shank)


def bearing(mesh, elements, height):
    """Faces of these elements in the plane z = height."""
    faces = {8: {1: (0, 1, 2, 3)}, 6: {3: (0, 1, 4, 3), 4: (1, 2, 5, 4), 5: (2, 0, 3, 5)}}
    all_elements, out = mesh.by_number(), []
    for e in elements:
        nodes = all_elements[e]
        for face, corners in faces[len(nodes)].items():
            if all(abs(z - height) < 1e-9 for _, _, z in mesh.at([nodes[i] for i in corners])):
                out.append((e, face))
    return out


def nut_ends(mesh, joint, wound, made, radii):
    columns = wound.columns
    mesh.surfaces["NUT"] = bearing(mesh, [e for layers in made.values() for k, e in enumerate(layers) if radii[k] > joint.hole / 2 - 1e-9], 0.0)
    mesh.held += [wound.node(columns // 4 * i, wound.last[columns // 4 * i], len(radii) - 1, radii[-1]) for i in range(4)]


def ridges(mesh, wound, owner, count, levels, edges, cells):
    """Blocks of `count` elements across on the rows 0 .. count of every pitch. `levels`: radii from the root on; edges(radius): lower and upper flank.

    `cells`: (first, number) of those along the helix, or None for all that fit. Returns elements [cell][row][level].
    """
    rows, n = len(wound.places), wound.columns

    def corner(j, turn, i, k):
        if k == 0:
            return wound.node(j, turn * rows + i, wound.root, levels[0])
        low, high = edges(levels[k])
        z = wound.start + wound.pitch * (turn + j / n) + low + (high - low) * i / count
        return wound.node(j, turn * rows + i, f"level {k}", levels[k], z)

    inwards, out = levels[-1] < levels[0], []
    for q in range(-20 * n, 60 * n):
        turn, j = divmod(q, n)
        fits = all(wound.first[c] < turn * rows and (turn * rows + count) < wound.last[c] for c in (j, j + 1))
        if not fits or (cells and not cells[0] <= q < cells[0] + cells[1]):
            continue
        block = []
        for i in range(count):
            block.append([])
            for k in range(len(levels) - 1):
                a, b = (k + 1, k) if inwards else (k, k + 1)
                block[-1].append(mesh.element(owner, [corner(c, turn, row, level) for row in (i, i + 1) for c, level in ((j, a), (j, b), (j + 1, b), (j + 1, a))]))
        out.append(block)
    if cells and len(out) != cells[1]:
        raise ValueError(f"{len(out)} cells of the thread fit, {cells[1]} were asked for")
    return out


def explicit(joint, fine):
    """Mesh of the whole joint with its threads. Surfaces: BOLT, the loaded flank of the bolt, and PART1, PART2 ... of the nut's."""
    mesh, n, p = Mesh(), fine.columns, joint.pitch
    inner, root = 5.0, joint.root_radius
    disc = Disc(mesh, "bolt", n, inner)
    inwards = graded(root, inner, fine.inwards)[::-1]
    head_and_shank(mesh, joint, disc, inwards + [joint.pitch_radius], (3.2, 3.2))

    def rows(low, high):  # of the ridge's base and of the groove
        return [low + (high - low) * i / fine.ridge for i in range(fine.ridge + 1)] + [high + (low + p - high) * i / fine.groove for i in range(1, fine.groove)]

    start = joint.bolt_ridge
    low, high = joint.threaded
    w = joint.half_width
    bolt = Wound(mesh, "thread", n, p, start, rows(-w(root), w(root)), low, high)
    bolt.root, bolt.below = fine.inwards, (lambda column, layer: disc.ring_node(low, column, layer, inwards[layer]))
    bolt.sleeve("THREAD", inwards)
    crest = joint.diameter / 2
    levels = [root, joint.bore_radius] + [joint.bore_radius + (crest - joint.bore_radius) * i / (fine.up - 1) for i in range(1, fine.up)]
    blocks = ridges(mesh, bolt, "THREAD", fine.ridge, levels, lambda r: (-w(r), w(r)), None)
    mesh.surfaces["BOLT"] = [(e, 1) for block in blocks for e in block[0][1:]]
    heights = spaced(low, high, fine.core)
    mesh.surfaces["CORE"] = []
    for a, b in zip(heights, heights[1:]):
        before = mesh.count
        disc.core_layer("CORE", a, b)
        m = n // 4
        for k in range(m * m):
            i, j = divmod(k, m)
            e = before + k + 1
            mesh.surfaces["CORE"] += [(e, face) for face, there in ((3, j == 0), (4, i == m - 1), (5, j == m - 1), (6, i == 0)) if there]
    mesh.sets["INSIDE"] = {bolt.node(j, m, 0, inner) for j in range(n) for m in range(bolt.first[j] + 1, bolt.last[j] + 1)}

    bottom = crest + joint.clearance  # of the nut's groove
    radii = [bottom] + graded(joint.hole / 2, joint.across / 2, fine.inwards - 1)

    def edges(r):
        return -p + w(r) + joint.clearance, -w(r)
    nut = Wound(mesh, "nut", n, p, start, rows(*edges(bottom)), 0.0, joint.nut_height)
    nut.root = 0
    made = nut.sleeve("NUT", radii)
    nut_ends(mesh, joint, nut, made, radii)
    levels = [bottom, crest] + [crest + (joint.bore_radius - crest) * i / (fine.up - 1) for i in range(1, fine.up)]
    blocks = ridges(mesh, nut, "NUT", fine.ridge, levels, edges, (0, TURNS * n))
    size = n // PARTS
    for i in range(TURNS * PARTS):
        mesh.surfaces[f"PART{i + 1}"] = [(e, 2) for block in blocks[i * size:(i + 1) * size] for e in block[-1][1:]]
    plate(mesh, joint, n, 6)
    return mesh


def enriched(joint, columns, rings, shaft, bore):
    """Plain cylinders of the radii `shaft` and `bore`. Surface SHAFT: of the bolt, on which its thread is a height. Set RIDGE: nodes of the nut's bore along
    the middle of its ridge, which are in the middle of the bolt's facets.

    Both have one row of nodes a pitch: their bodies then see the mean of a pitch, and what varies within it is the law's.
    """
    mesh, p, wider = Mesh(), joint.pitch, same_area(columns)
    disc = Disc(mesh, "bolt", columns, 5.0, 0.5)
    radii = [5.0 + (shaft * wider - 5.0) * k / rings for k in range(rings + 1)]
    mesh.facets = radii[-1] * math.cos(math.pi / columns)  # their distance from the axis
    head_and_shank(mesh, joint, disc, radii, (6.3, 11.0), wider)
    low, high = joint.threaded
    mesh.surfaces["SHAFT"] = []
    heights = spaced(low, high, p)
    for a, b in zip(heights, heights[1:]):
        owner = "FREE" if b < 1e-9 else "THREAD"
        disc.core_layer(owner, a, b)
        mesh.surfaces["SHAFT"] += [(e, 4) for e in disc.ring_layer(owner, a, b, radii, radii)[rings - 1]]

    radii = [bore] + [wider * (joint.hole / 2 + (joint.across - joint.hole) / 2 * k / rings) for k in range(rings + 1)]
    nut = Wound(mesh, "nut", columns, p, joint.nut_ridge, [0.0], 0.0, joint.nut_height, 0.3)
    nut_ends(mesh, joint, nut, nut.sleeve("NUT", radii), radii)
    mesh.helix = [nut.node(q % columns, q // columns, 0, radii[0]) for q in range(TURNS * columns + 1)]
    for q, number in enumerate(mesh.helix):
        if abs(mesh.nodes[number - 1][2] - joint.nut_ridge - p * q / columns) > 1e-9:
            raise ValueError(f"node {q} of the nut's thread was moved to an end of the nut")
    mesh.sets["RIDGE"] = set(mesh.helix)
    mesh.around = [n - 1 for n in mesh.helix] + [disc.ring_node(z, c, rings, 0) - 1 for z in heights for c in range(columns)]
    plate(mesh, joint, columns, 4, wider)
    return mesh
