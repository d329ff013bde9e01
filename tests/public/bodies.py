# SPDX-License-Identifier: BSD-3-Clause
"""Solutions that other codes publish as targets: cylinders, spheres, rings, punches. Closed forms where they exist."""
import math

import ents
import numpy as np
import scipy.sparse as sparse
from scipy.optimize import brentq

from fem import Body, Problem, block, dofs, face_loads
from rows import row, target


def graded(fine, size, even=20, growing=22):
    """0 .. size: `even` equal cells up to `fine`, then cells that grow by a constant factor."""
    first = fine / even
    q = brentq(lambda q: first * (q**growing - 1) / (q - 1) * q - (size - fine), 1.0001, 10)
    return np.r_[np.linspace(0, fine, even + 1), fine + first * q * (q ** np.arange(1, growing + 1) - 1) / (q - 1)]


def round_body(radius, fine, upside_down=False):
    """Half of a body, symmetric at x = 0, whose upper side is Hertz's parabola through (0, 0), and its tangent from 0.4 radius on; four radii wide and
    deep, with equal cells up to `fine`."""
    size = 4 * radius
    cells = graded(fine, size)
    n = len(cells) - 1

    def moved(x):
        across, deep = cells[np.rint(n * x[:, 0]).astype(int)], -cells[np.rint(-n * x[:, 1]).astype(int)]
        end = np.minimum(across, 0.4 * radius)
        drop = end**2 / (2 * radius) + 0.4 * (across - end)
        return np.column_stack([across, deep - drop * (1 + deep / size)])
    body = block("quad4", [n, n], [0, -1], [1, 0], moved)
    body.top = np.flatnonzero(np.arange(len(body.positions)) % (n + 1) == n)
    body.top_faces = np.column_stack([body.top[:-1], body.top[1:]])
    body.base = np.flatnonzero(np.arange(len(body.positions)) % (n + 1) == 0)
    body.axis = np.arange(n + 1)
    if upside_down:
        body.positions = body.positions * [1, -1]
        body.cells, body.top_faces = body.cells[:, ::-1], body.top_faces[:, ::-1]
    return body


def pressed_bodies(lower, upper, force, approach, axisymmetric=False):
    """Two round bodies with materials ((body, E, nu)), pressed until the force of the half that is meshed (axisymmetric: all of it) is `force`;
    approach: a first guess. Returns half-width and peak of Hertz's ellipse through the pressures, the force, and the approach of the bases."""
    (low, young_low, poisson_low), (high, young_high, poisson_high) = lower, upper
    n = len(low.positions)
    both = low.joined(high)
    normal = {"type": "penalty", "stiffness": 10 * min(young_low, young_high) / low.positions[low.top[1], 0]}
    contact = ents.Contact({"segment": "catmull_rom4", "border": 0.1, "penetration_limit": 3 * approach, "contact": {"normal": normal}}, both.positions,
                           low.top_faces, high.top_faces + n, thickness=0.0 if axisymmetric else 1.0, reach=3 * approach)
    k = sparse.block_diag([low.stiffness(young_low, poisson_low, axisymmetric), high.stiffness(young_high, poisson_high, axisymmetric)], "csr")
    held = np.concatenate([dofs(np.r_[low.axis, high.axis + n], 2, 0), dofs(low.base, 2, 1), dofs(high.base + n, 2, 1)])
    problem = Problem(k, held, contact)

    def press(depth):
        """The largest part of the motion is that of the whole upper body: Newton's iteration begins with it."""
        values = np.zeros(len(held))
        values[-len(high.base):] = -depth
        problem.u.reshape(-1, 2)[n:, 1] -= depth - press.last
        press.last = depth
        problem.solve(values=values, tolerance=1e-9)
        return contact.pressure @ contact.areas
    press.last = 0.0
    for part in (0.1, 0.2, 0.3, 0.45):
        press(part * approach)
    depth = reach_force(press, force, 0.6 * approach, 0.8 * approach)
    return *ellipse(low.positions[low.top, 0], contact), depth


def reach_force(press, force, first, second):
    """The secant method for the depth whose force is wanted, to 1e-6 of it. Returns the depth."""
    depths, forces = [first, second], [press(first), press(second)]
    while abs(forces[-1] / force - 1) > 1e-6:
        if len(depths) > 12:
            raise ArithmeticError(f"the secant method: forces {forces}")
        depths.append(depths[-1] + (force - forces[-1]) * (depths[-1] - depths[-2]) / (forces[-1] - forces[-2]))
        forces.append(press(depths[-1]))
    return depths[-1]


def ellipse(at, contact):
    """Hertz's pressure is half an ellipse over the undeformed surface: its square falls linearly with x^2 from the peak to zero at the half-width."""
    p = contact.pressure
    inside = p > 0.3 * p.max()
    slope, peak = np.polyfit(at[inside]**2, p[inside]**2, 1)
    return math.sqrt(-peak / slope), math.sqrt(peak), p @ contact.areas


def hertz(check, name, found, half_width, peak, force, tolerance):
    check.near(f"{name}: half-width / {half_width:.5g}", 1, found[0] / half_width, tolerance)
    check.near(f"{name}: peak pressure / {peak:.6g}", 1, found[1] / peak, tolerance)
    check.near(f"{name}: force / {force:.6g}", 1, found[2] / force, 1e-6)


# What is not Hertz's in these models: a penalty that gives way by p0 / (10 E / cell), 0.4 % of the approach; 16 cells in a half-width, whose square is
# 0.4 %; bodies of 32 a, whose square is 0.1 %; slopes of a / R = 0.1, whose square is 1 %.
NEAR = 0.02


@row("kratos_spheres", wrong="Hertz's spheres: a = 0.627 and p0 = 1.435467e5, 0.5 % and 1.3 % beside the closed form", source="Kratos, validation/hertz_full",
     right="a = 0.63018, p0 = 1.41641e5 to 2 % (E 1e8 and 1e6, nu 0.29, diameters 12.2474, F = 117808.787)")
def kratos_spheres(check):
    radius, force = 12.2474 / 2, 117808.787
    modulus = 1 / ((1 - 0.29**2) * (1 / 1e8 + 1 / 1e6))
    a = (3 * force * radius / 2 / (4 * modulus)) ** (1 / 3)
    found = pressed_bodies((round_body(radius, 0.8), 1e6, 0.29), (round_body(radius, 0.8, True), 1e8, 0.29), force, 0.13, True)
    check.near("closed form: a, p0", [0.63018, 1.41641], [a, 1.5e-5 * force / (math.pi * a**2)], 1e-5)
    hertz(check, "spheres", found, a, 3 * force / (2 * math.pi * a**2), force, NEAR)


@target("moose_spheres", case="two spheres, R = 2, E = 1.40625e7, nu = 0.25, F = 1e4", source="MOOSE, hertz_spherical",
        right="a = 0.1, p0 = 477464.8, approach 0.01 to 2 %")
def moose_spheres(check):
    found = pressed_bodies((round_body(2, 0.13), 1.40625e7, 0.25), (round_body(2, 0.15, True), 1.40625e7, 0.25), 1e4, 0.009, True)
    hertz(check, "spheres", found, 0.1, 477464.8, 1e4, NEAR)
    # The bases are 8 away, not infinitely far: a force on two half-spaces moves them there by 0.9 % of the approach; free sides give way by as much.
    check.near("spheres: approach / 0.01", 1, found[3] / 0.01, NEAR)


@target("vm191_cylinders", case="two cylinders, R 10 and 13, E 30000 and 29120, nu 0.25 and 0.3, 3200 N/mm, plane strain", source="Ansys VM191",
        right="half-width 1.1997, p0 = 1698.1 to 2 %")
def vm191_cylinders(check):
    found = pressed_bodies((round_body(10, 1.5), 30000, 0.25), (round_body(13, 1.5, True), 29120, 0.3), 1600, 0.5)
    hertz(check, "cylinders", found, 1.1997, 1698.1, 1600, NEAR)


@target("sphere_on_plane", case="a sphere on a rigid plane, R = 8, E = 1000, nu = 0.3, F = 60 pi", source="Hertz",
        right="a = 1.0096, p0 = 88.290, approach 0.12742 to 2 %")
def sphere_on_plane(check):
    body, force = round_body(8, 1.4), 60 * math.pi
    model = {"segment": "line2", "master": "rigid", "penetration_limit": 2, "contact": {"normal": {"type": "penalty", "stiffness": 1e4 / 0.07}}}
    contact = ents.Contact(model, body.positions, body.top_faces, [[0, 1]], master_positions=[[40, 0], [-40, 0]], thickness=0.0, reach=2)
    held = np.r_[dofs(body.base, 2, 1), dofs(body.axis, 2, 0)]
    problem = Problem(body.stiffness(1000, 0.3, True), held, contact)

    def press(depth):
        contact.move([[40, -depth], [-40, -depth]])
        problem.solve(tolerance=1e-9)
        return contact.pressure @ contact.areas
    for depth in (0.02, 0.05):
        press(depth)
    depth = reach_force(press, force, 0.08, 0.1)
    # The base is 32 away: 2.3 % of the approach for a half-space, less what free sides give way by.
    check.near("sphere: approach / 0.12742", 1, depth / 0.12742, NEAR)
    hertz(check, "sphere", ellipse(body.positions[body.top, 0], contact), 1.0096, 88.290, force, NEAR)


def annulus(inner, outer, radial, around):
    """A closed ring; its cells grow with the radius."""
    return ring(inner * (outer / inner) ** (np.arange(radial + 1) / radial), 2 * math.pi * np.arange(around) / around)


def steps_to(end, fine, even, factor=1.15):
    """0 .. end: `even` cells of about `fine`, then cells that grow by a factor."""
    cells = fine * np.r_[np.ones(even), factor ** np.arange(1, 200)]
    cells = cells[:np.searchsorted(np.cumsum(cells), end) + 1]
    return np.r_[0, np.cumsum(cells) * end / cells.sum()]


def ring(r, angle):
    """A closed ring with nodes at these radii and angles (from its lowest point on)."""
    angle, radial, around = angle - math.pi / 2, len(r) - 1, len(angle)
    positions = np.stack([np.multiply.outer(r, np.cos(angle)), np.multiply.outer(r, np.sin(angle))], -1).reshape(-1, 2)
    number = np.arange(len(positions)).reshape(radial + 1, around)
    following = np.roll(number, -1, axis=1)
    body = Body("quad4", positions, np.stack([number[:-1], number[1:], following[1:], following[:-1]], -1).reshape(-1, 4))
    body.inside, body.outside = number[0], number[-1]
    return body


def closed(nodes):
    """Faces of a closed line."""
    return np.column_stack([nodes, np.roll(nodes, -1)])


def plane_stress(young, poisson):
    """(E, nu) of plane strain that give the plane stress of these."""
    return young * (1 + 2 * poisson) / (1 + poisson)**2, poisson / (1 + poisson)


def rings(radii, young, poisson, outside=lambda angle: 0.0, interference=0.0, cells=(16, 12, 96)):
    """Two rings in plane strain: outside(angle) is the pressure outside, the interference an offset of the gap. Returns the pressures at the outer
    nodes of the inner ring, and their radial displacements."""
    inner, outer = annulus(radii[0], radii[1], cells[0], cells[2]), annulus(radii[1], radii[2], cells[1], cells[2])
    n = len(inner.positions)
    both = inner.joined(outer)
    law = {"normal": {"type": "penalty", "stiffness": 1000 * young / (radii[1] - radii[0])}, "offset": -interference - 1e-12 * radii[1]}  # closed at first
    # Outwards, on the left: the outer side of the inner ring goes clockwise, the inner side of the outer one the other way. The master is smooth: two
    # polygons would hook into each other where they slide.
    contact = ents.Contact({"segment": "catmull_rom4", "contact": law}, both.positions, closed(inner.outside)[:, ::-1], closed(outer.inside) + n,
                           reach=radii[1] / 20)
    load = np.zeros(both.positions.shape)
    for a, b in closed(outer.outside) + n:
        ends = both.positions[[a, b]]
        t = ends[1] - ends[0]
        load[[a, b]] -= outside(math.atan2(*ends.mean(axis=0)[::-1])) / 2 * np.array([t[1], -t[0]])
    problem = Problem(both.stiffness(young, poisson), np.r_[dofs(both.where(1, 0), 2, 1), dofs(both.where(0, 0), 2, 0)], contact)
    # The gap's rounding of 2^-52 x radius, times the penalty, is 1e-9 of the forces on nodes.
    problem.solve(load.ravel(), tolerance=1e-7)
    moved = np.einsum("ij,ij->i", problem.u.reshape(-1, 2)[inner.outside], inner.positions[inner.outside]) / radii[1]
    return contact.pressure, moved


@target("lame_rings", case="two rings, radii 0.2, 0.6, 1, E = 1e9, nu = 0.2, plane stress, 1e6 outside", source="Code_Aster SSNP152",
        right="pressure between them 925925.9 to 0.5 %")
def lame_rings(check):
    # Springs in a row: the penalty adds E / (1000 E / 0.4) = 4e-4 per stress of E where the rings give about 1: 0.04 %. 12 cells in a ring: 1 / 144 of the
    # bending part of the solution, which is less than half of it.
    check.near("pressure / 925925.9", 1, rings((0.2, 0.6, 1.0), *plane_stress(1e9, 0.2), outside=lambda angle: 1e6)[0] / 925925.9, 5e-3)


@target("press_fit", case="a press fit, diameters 20, 40, 60, radial interference 0.0025, E = 210e3, plane stress", source="Lame",
        right="pressure 6.1523 to 0.5 %")
def press_fit(check):
    check.near("pressure / 6.1523", 1, rings((10, 20, 30), *plane_stress(210e3, 0.3), interference=0.0025)[0] / 6.1523, 5e-3)


@target("disk_in_ring", case="a disk of 0.6 in a ring of 0.6 to 1, E = 1e9, nu = 0.2, plane strain, 1e7 + 1e5 cos 2t outside", source="Code_Aster SSNP169F",
        right="pressure between them 1e7 +- 147926.27, its radial displacement -0.00422769 to -0.00441231; the waves to 1 %")
def disk_in_ring(check):
    # A thousandth of the load: the published solution is linear, and pressures of E / 100 on a surface that moves change the waves by some per cent.
    part = 1e-3
    pressure, moved = rings((0.003, 0.6, 1.0), 1e9, 0.2, outside=lambda angle: part * (1e7 + 1e5 * math.cos(2 * angle)), cells=(64, 16, 96))
    # The disk has a hole of 0.005 of its radius; the penalty gives way by E / (1000 E / 0.4), 0.06 % of the displacements. 48 cells in a wave, 16 in
    # the ring: less than 1 / 144.
    check.near("mean pressure / 1e7", 1, pressure.mean() / part / 1e7, 1e-3)
    check.near("wave of the pressure / 147926.27", 1, np.ptp(pressure) / part / 2 / 147926.27, 0.01)
    check.near("mean displacement / 0.00432", -1, (moved.max() + moved.min()) / part / 2 / 0.00432, 1e-3)
    check.near("wave of the displacement / 9.230599e-5", 1, np.ptp(moved) / part / 2 / 9.230599e-5, 0.01)


@target("rounded_punch", case="a flat rigid punch, 5 to each side, rounded with radius 10, E* = 219780.22", source="Ciavarella, Hills, Monno 1998",
        right="a = 5.25, 5.5, 6 at P = 5892.17, 16944.8, 49467.6; peaks 2110.0, 4242.7, 8569.6 to 2 % at 5.076, 5.151, 5.298")
def rounded_punch(check):
    """The punch is a height map on one segment: 0 within 5, parabolas outside; its spline rounds the jump of the curvature over one spacing of 0.01."""
    samples = np.linspace(-9, 9, 1801)
    punch = -np.maximum(np.abs(samples) - 5, 0)**2 / 20
    # Half of the block; fine towards x = 5 from both sides, elements of 0.02 there.
    x = np.r_[5 - np.geomspace(5.02, 0.02, 40) + 0.02, 5 + 0.02 * np.arange(1, 41), 5.8 + np.cumsum(0.02 * 1.16 ** np.arange(1, 46))]
    x[0] = 0.0
    y = -np.r_[np.cumsum(0.02 * 1.16 ** np.arange(0, 46))][::-1]
    axes = np.r_[y, 0.0]
    grid = np.stack(np.meshgrid(x, axes, indexing="ij"), -1).reshape(-1, 2)
    number = np.arange(len(grid)).reshape(len(x), len(axes))
    body = Body("quad4", grid, np.stack([number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]], -1).reshape(-1, 4))
    top = number[:, -1]
    model = {"segment": "line2", "master": "rigid", "surface_coordinates": [[9], [-9]], "contact": {"normal": {"type": "penalty", "stiffness": 1e9}},
             "height": {"type": "map", "values": punch.tolist(), "boundary": "clamped", "size": [18], "origin": [-9]}}
    contact = ents.Contact(model, body.positions, np.column_stack([top[:-1], top[1:]]), [[0, 1]], master_positions=[[9, 0], [-9, 0]], reach=1.0)
    problem = Problem(body.stiffness(200000, 0.3), np.r_[dofs(number[:, 0], 2), dofs(number[0], 2, 0)], contact)
    # Prescribed depths, as far as the force is the wanted one.
    def press(depth):
        contact.move([[9, -depth], [-9, -depth]])
        problem.solve(tolerance=1e-9)
        return 2 * contact.pressure @ contact.areas
    for a, force, peak, place, first, second in ((5.25, 5892.17, 2110.0, 5.076, 0.02, 0.03), (5.5, 16944.8, 4242.7, 5.151, 0.06, 0.08),
                                                 (6, 49467.6, 8569.6, 5.298, 0.16, 0.22)):
        reach_force(press, force, first, second)
        p, at = contact.pressure, body.positions[top, 0] + problem.u[2 * top]  # the surface is drawn inwards, by 0.04 at the last peak
        near = p > 0.97 * p.max()  # the pressure is flat at its peak: that of a parabola
        curve = np.polyfit(at[near] - place, p[near], 2)
        check.near(f"P / {force}", 1, 2 * p @ contact.areas / force, 1e-6)
        last = np.flatnonzero(p > 0)[-1]
        # Elements of 0.02 in a border of 0.5: 0.02 / 0.5 / 2 in places; the half-plane is 100 deep for a contact of 5.5: (5.5 / 100)^2. The end of contact
        # lies between two nodes.
        check.near(f"a = {a}: peak / {peak}", 1, p.max() / peak, 0.02)
        check.near(f"a = {a}: place of the peak", place, place - curve[1] / curve[0] / 2, 0.02)
        check.near(f"a = {a}: a", a, at[last], at[last + 1] - at[last] + 0.01)


@target("pin_in_hole", case="a pin in the hole of an infinite plate, the same material, without friction, plane strain: "
        "half angle 10, 20, 30, 45, 60, 75, 80 degrees", source="Persson 1964",
        right="p_max R / Q = 3.657, 1.851, 1.260, 0.8820, 0.7117, 0.6281, 0.6116 to 2 %; "
        "contact ends at the angle to an element of 3 degrees (20 elements for 10 and 20 degrees)")
def pin_in_hole(check):
    # The pin is loaded round a hole of R / 50; the plate is held 20 R away. Both are felt in the square of these ratios: 0.04 %, 0.25 %.
    radius, clearance = 10.0, 0.01
    inside, outside = (0.02 * radius, radius - clearance), (radius, 20 * radius)
    pin_loads(check, annulus(*inside, 28, 120), annulus(*outside, 22, 120), clearance, 3,
              ((30, 7.9435, 1.260), (45, 2.8231, 0.8820), (60, 1.0672, 0.7117), (75, 0.28708, 0.6281), (80, 0.12615, 0.6116)))
    for loads in ((10, 82.22, 3.657),), ((20, 19.535, 1.851),):  # 20 cells in the half angle
        cell = loads[0][0] / 20
        half = steps_to(180, cell, 24)
        angle, fine = np.radians(np.r_[half, 360 - half[-2:0:-1]]), math.radians(cell) * radius
        away = [steps_to(end - begin, fine, 20) for begin, end in (inside, outside)]
        pin_loads(check, ring(inside[1] - away[0][::-1], angle), ring(outside[0] + away[1], angle), clearance, cell, loads)


def pin_loads(check, pin, plate, clearance, cell, loads):
    """The same bodies under (half angle in degrees, E' DR / Q, p_max R / Q)."""
    radius, modulus = 10.0, 1e5
    pin.positions[:, 1] -= clearance  # it touches below
    n, both = len(pin.positions), pin.joined(plate)
    stiffness = both.stiffness(modulus * (1 - 0.3**2), 0.3)
    held = np.r_[dofs(pin.inside, 2, 0), dofs(plate.outside + n, 2)]
    for angle, ratio, peak in loads:
        force = modulus * clearance / ratio
        contact = ents.Contact({"segment": "catmull_rom4", "contact": {"normal": {"type": "penalty", "stiffness": 60 * modulus / cell}}},
                               both.positions, closed(pin.outside)[:, ::-1], closed(plate.inside) + n, reach=0.5)
        load = np.zeros(both.positions.shape)
        load[pin.inside, 1] = -force / len(pin.inside)
        problem = Problem(stiffness, held, contact)
        problem.u.reshape(-1, 2)[:n, 1] = -1e-4
        for part in (0.25, 0.5, 1.0):
            problem.solve(part * load.ravel(), tolerance=1e-8)
        p = contact.pressure
        found = np.degrees(math.pi / 2 + np.arctan2(contact.points[:, 1], np.abs(contact.points[:, 0])))[p > 0].max()
        # The penalty gives way by p / (20 E'): 0.07 E' clearance / 10 over that is 0.04 % of the clearance (3 degrees; 0.1 % of what 10 degrees close, with
        # cells of half a degree). Elements of 3 in 30 degrees: 1 %.
        check.near(f"{angle} degrees: p_max R / Q / {peak}", 1, p.max() * radius / force / peak, 0.02)
        check.near(f"{angle} degrees: end of contact", angle, found, cell)


@target("plate_with_friction", case="a plate of 40 mm, plane strain, E = 1.3e11, nu = 0.2, on a rigid plane, mu 1: 5e7 on top, 15e7 on the left side, "
        "held at the right one", source="GRECO, Code_Aster SSNV128", right="u_x at x = 0, 1.25, 5, 7.5, 11.25 mm: 28.6, 27.2, 22.8, 19.8, 15.0 um to 5 %")
def plate_with_friction(check):
    size, cells = 0.04, 32
    body = block("quad4", [cells, cells], [0, 0], [size, size])
    friction = {"type": "coulomb", "coefficient": 1.0, "stiffness": 1e15}
    model = {"segment": "line2", "master": "rigid", "contact": {"normal": {"type": "penalty", "stiffness": 1e15}, "friction": friction, "offset": -1e-12}}
    contact = ents.Contact(model, body.positions, body.faces(1, 0), [[0, 1]], master_positions=[[-1, 0], [1, 0]], reach=0.01)
    load = face_loads(body.positions, body.faces(1, size), [0, -5e7]) + face_loads(body.positions, body.faces(0, 0), [15e7, 0])
    problem = Problem(body.stiffness(1.3e11, 0.2), dofs(body.where(0, size), 2, 0), contact)
    for part in np.linspace(0.1, 1, 10):
        problem.solve(part * load, tolerance=1e-8)
    places = np.array([0, 1, 4, 6, 9]) * (cells + 1)  # nodes on the plane, 1.25 mm apart
    # The published values have three digits and are of meshes like this one: the bound is theirs.
    right = np.array([28.6, 27.2, 22.8, 19.8, 15.0])
    check.near("u_x [um] / published", 1, problem.u[2 * places] * 1e6 / right, 0.05)
