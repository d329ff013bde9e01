# SPDX-License-Identifier: BSD-3-Clause
"""Faces and edges: second order, mixed shapes, edges of the master, surfaces that touch themselves, thin bodies, combs."""
import ents
import numpy as np

from fem import Body, Problem, block, dofs, face_loads
from rows import row

HARD = {"type": "penalty", "stiffness": 1e4}  # blocks here have E = 1000 and elements of 0.5: 5 E / l


def on_rigid_plane(body, slave, normal=HARD, **options):
    """The body's faces over a rigid plane z = 0 (2D: y = 0) that is much larger than they are."""
    d = body.positions.shape[1]
    corners = [[-9, 0], [9, 0]] if d == 2 else [[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]]
    model = {"segment": "line2" if d == 2 else "quad4", "master": "rigid", "contact": {"normal": normal}}
    return ents.Contact(model, body.positions, slave, [list(range(len(corners)))], master_positions=corners, reach=0.3, **options)


def pressed(body, contact, top):
    """Unit pressure on the faces at height `top`, sides free (Poisson's ratio 0): the pressures of all slave points."""
    d = body.positions.shape[1]
    load = face_loads(body.positions, body.faces(d - 1, top), [0] * (d - 1) + [-1])
    problem = Problem(body.stiffness(1000, 0), np.unique(np.concatenate([dofs(body.where(i, 0), d, i) for i in range(d - 1)])), contact)
    # The body starts 0.01 deep, so that contact alone holds it.
    problem.u[d - 1::d] = -0.01
    problem.solve(load)
    return contact.pressure


# Newton's iteration ends below 1e-12 of the forces; with entries of K up to 5e3 and displacements of 1e-3 to 1e-2 rounding moves forces on nodes
# by 100 terms x 5e3 x 1e-2 x 2^-53 = 6e-13, and a node of area 1/36 has a pressure of 36 times that.
UNIFORM = 4e-11


@row("second_order_solids", wrong="forces on corner nodes point against the pressure; the pressure is patchy", source="solids of second order "
     "(C3D10, C3D20) with nodes as slave points", right="pressure 1 in every point")
def second_order_solids(check):
    for element in ("hex20", "tet10"):
        body = block(element, [2, 2, 2], [0, 0, 0], [1, 1, 1])
        contact = on_rigid_plane(body, body.faces(2, 0))
        check.near(f"{element}, default slave points", 1, pressed(body, contact, 1), UNIFORM)


def mixed_block(low, high, skewed=lambda x: x):
    """3 x 3 x 2 cells; some of them are two wedges, hexahedra with two pairs of nodes in one place, so that the surface has triangles."""
    body = block("hex8", [3, 3, 2], low, high, skewed)
    cells = []
    for cell in body.cells:
        middle = body.positions[cell].mean(axis=0)[:2]
        if int(7 * middle[0] + 5 * middle[1]) % 2:
            cells += [cell[[0, 1, 2, 2, 4, 5, 6, 6]], cell[[0, 2, 3, 3, 4, 6, 7, 7]]]
        else:
            cells.append(cell)
    return Body("hex8", body.positions, cells)


@row("mixed_faces", wrong="a surface of triangles and quadrilaterals is refused or wrong", source="every mesh that is mostly hexahedra",
     right="patch test, facets of mixed length and quadrilaterals with two equal nodes: pressure 1 to 1e-13, on a master of such facets to 1e-9")
def mixed_faces(check):
    """On the plane the pressure is k x 1e-4 with k = 1e4, to a few roundings; areas are sums of some products: 1e-13 leaves room for hundreds."""
    body = mixed_block([0, 0, 0], [1, 1, 1])
    faces = body.faces(2, 0)
    kinds = {len(face) for face in faces}
    check.true("the surface has", "triangles and quadrilaterals", " and ".join(f"{sum(len(f) == k for f in faces)} of {k} nodes" for k in sorted(kinds)),
               kinds == {3, 4})
    as_quads = [face if len(face) == 4 else [*face, face[-1]] for face in faces]
    check.near("two equal nodes", 1, uniform_depth(body, as_quads), 1e-13)
    check.near("mixed length", 1, uniform_depth(body, faces), 1e-13)
    # A projection stays 1e-9 of a side away from the corner with two nodes (ents.h): so much of a force goes to other nodes of the master.
    check.near("two equal nodes, on an elastic block", 1, between_blocks(as_quads=True), 1e-9)
    check.near("mixed length, on an elastic block", 1, between_blocks(as_quads=False), 1e-9)


def uniform_depth(body, faces):
    """Every node 1e-4 deep: what the plane gives to the nodes against what a uniform pressure of 1 gives them (an area of each)."""
    contact = on_rigid_plane(body, faces)
    u = np.zeros(body.positions.shape)
    u[:, 2] = -1e-4
    residual, _ = contact.update(u.ravel())
    loads = np.zeros(len(u))
    for face in faces:
        nodes = list(dict.fromkeys(face))
        a, b, c = body.positions[np.array(nodes[:3])]
        area = np.linalg.norm(np.cross(b - a, c - a)) / (2 if len(nodes) == 3 else 1)
        loads[np.array(nodes)] += area / len(nodes)
    used = np.unique(np.concatenate(faces))
    return -residual.reshape(-1, 3)[used, 2] / loads[used]


def between_blocks(as_quads):
    """Both surfaces of mixed faces, node on node, and skew; all nodes are held sideways, so that no corner leaves the master's edge."""
    skew = lambda x: x + np.column_stack([0.1 * x[:, 1], -0.15 * x[:, 0], 0 * x[:, 0]])
    upper, lower = mixed_block([0, 0, 0], [1, 1, 1], skew), mixed_block([0, 0, -1], [1, 1, 0], skew)
    top, bottom = upper.faces(2, 0), [[node + len(upper.positions) for node in face] for face in lower.faces(2, 0)]
    pad = (lambda f: f if len(f) == 4 else [*f, f[-1]]) if as_quads else (lambda f: f)
    both = upper.joined(lower)
    model = {"segment": "quad4", "border": 0.05, "contact": {"normal": HARD}}
    contact = ents.Contact(model, both.positions, [pad(f) for f in top], [pad(f) for f in bottom], reach=0.3)
    held = np.concatenate([dofs(both.where(2, -1), 3), dofs(np.arange(len(both.positions)), 3, 0, 1)])
    problem = Problem(both.stiffness(1000, 0), np.unique(held), contact)
    problem.u.reshape(-1, 3)[:len(upper.positions), 2] = -1e-4  # the depth that a pressure of 1 has
    problem.solve(face_loads(both.positions, upper.faces(2, 1), [0, 0, -1]))
    return contact.pressure


@row("over_the_end", wrong="points that leave the master keep their forces, lose all of them, or stop the job", source="MOOSE #18853, #22256, #33572",
     right="N = pressure x overlap, to half of the length that a point stands for: about face / (2 n) with n points per direction")
def over_the_end(check):
    faces, width, depth = 8, 1.0, 1e-3
    law = {"border": 1e-7, "master": "rigid", "contact": {"normal": {"type": "penalty", "stiffness": 1 / depth}}}
    x = np.column_stack([np.linspace(0, width, faces + 1), np.zeros(faces + 1)])
    chain = np.column_stack([np.arange(1, faces + 1), np.arange(faces)])
    floor = np.column_stack([np.linspace(-1, width, 17), np.zeros(17)])
    # In steps of 0.137 to the right, over the end of the master at x = 1, and back.
    shifts = np.r_[np.arange(9) * 0.137, 1.5, np.arange(8, -1, -1) * 0.137]
    for n in (1, 2, 5):
        contact = ents.Contact({"segment": "line2", **law}, x, chain, np.column_stack([np.arange(16), np.arange(1, 17)]), master_positions=floor,
                               sampling=n, leave=True)
        force = []
        for shift in shifts:
            residual, _ = contact.update(np.tile([shift, -depth], len(x)))
            contact.commit()
            force.append(-residual[1::2].sum())
        check.near(f"2D, n = {n}", np.clip(width - shifts, 0, width), force, lost_or_kept(n, width / faces))
    grid = block("hex8", [4, 4, 1], [0, 0, 0], [1, 1, 1])
    plane = block("hex8", [8, 8, 1], [-1, -0.5, -1], [1, 1.5, 0])
    for n in (1, 3):
        contact = ents.Contact({"segment": "quad4", **law}, grid.positions, grid.faces(2, 0), plane.faces(2, 0), master_positions=plane.positions,
                               sampling=n, leave=True)
        shifts, force = np.arange(6) * 0.23, []
        for shift in shifts:
            residual, _ = contact.update(np.tile([shift, 0, -depth], len(grid.positions)))
            contact.commit()
            force.append(-residual[2::3].sum())
        check.near(f"3D, n = {n}", np.clip(1 - shifts, 0, 1), force, lost_or_kept(n, 0.25))


def lost_or_kept(n, face):
    """A point is lost or kept as a whole: half of the largest length that a point stands for. Points are Gauss's; of equal ones it were face / (2 n)."""
    return np.polynomial.legendre.leggauss(n)[1].max() / 4 * face + 1e-12


@row("self_contact", wrong="contact of a surface with itself is missed without a word", source="Kratos #11314, OpenRadioss PR 704",
     right="found, or refused with the reason and what to do")
def self_contact(check):
    """A hairpin whose legs close until they overlap by 0.02, one list of faces as slave and as master: depth and pressure of the points of the ends."""
    x = np.array([[1, 0.01], [0.5, 0.01], [0, 0.01], [-0.3, 0.25], [-0.6, 0], [-0.3, -0.25], [0, -0.01], [0.5, -0.01], [1, -0.01]])
    chain = np.column_stack([np.arange(8), np.arange(1, 9)])
    contact = ents.Contact({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 1e3}}}, x, chain, chain, reach=0.1)
    contact.update(np.zeros(x.size))
    contact.commit()
    u = np.zeros(x.shape)
    u[:2, 1], u[7:, 1] = -0.02, 0.02
    contact.update(u)
    ends = np.r_[0, 1, 14, 15]  # two points in the first face and in the last
    check.near("gap of the ends' points", -0.02, contact.gap[ends], 1e-12)
    check.near("pressure there", 20, contact.pressure[ends], 1e-9)


@row("thin_solid", wrong="the two faces of one thin solid press each other", source="OpenRadioss PR 1544",
     right="no force, or a refusal in words")
def thin_solid(check):
    """Upper faces as slave, lower faces as master of a plate of 0.02. Each lies 0.02 behind the other."""
    plate = block("hex8", [4, 4, 1], [0, 0, 0], [1, 1, 0.02])
    model = {"segment": "quad4", "contact": {"normal": {"type": "penalty", "stiffness": 1e3}}}
    for options, limit in (({"reach": 0.015}, {}), ({}, {"penetration_limit": 0.01})):
        name = " ".join(f"{key} {value}" for key, value in {**options, **limit}.items())
        try:
            contact = ents.Contact({**model, **limit}, plate.positions, plate.faces(2, 0.02), plate.faces(2, 0), **options)
            residual, _ = contact.update(np.zeros(plate.positions.size))
            check.near(f"largest force, {name}", 0, np.abs(residual).max(), 0)
        except (ents.Error, ents.CutStep) as error:
            words = str(error)
            check.true(name, "refused: too deep", words[:60] + " ...", "-0.02" in words or "0.02 behind" in words)


def comb(teeth, width, height):
    """Corners of a comb, its teeth upwards, from the left to the right: line2 facets whose normals point out."""
    corners = []
    for k in range(teeth):
        left = 2 * k * width
        corners += [[left, 0], [left, height], [left + width, height], [left + width, 0]]
    return np.array([[-width, 0], *corners, [corners[-1][0] + width, 0]], float)


def distance_behind(points, line):
    """Signed distance to the comb's boundary, negative inside: winding by heights for these axis-parallel polygons, distance to segments."""
    a, b = line[:-1], line[1:]
    t = np.clip(np.einsum("ijk,jk->ij", points[:, None] - a, b - a) / np.einsum("jk,jk->j", b - a, b - a), 0, 1)
    distance = np.linalg.norm(points[:, None] - (a + t[:, :, None] * (b - a)), axis=2).min(axis=1)
    inside = np.zeros(len(points), bool)
    for k in range((len(line) - 2) // 4):
        low, high = line[1 + 4 * k], line[3 + 4 * k]
        inside |= (points[:, 0] > low[0]) & (points[:, 0] < high[0]) & (points[:, 1] < high[1])
    return np.where(inside | (points[:, 1] < 0), -distance, distance)


@row("comb_in_comb", wrong="points between the teeth find no face, or the far side of a tooth", source="dolfinx_contact #107, PR 118",
     right="the distance to the nearest face, positive outside; points in a corner are flagged or cut the step")
def comb_in_comb(check):
    line = comb(5, 1.0, 4.0)
    x = np.random.default_rng(1).uniform([0.2, 0.1], [8.8, 4.3], (2000, 2))
    exact = distance_behind(x, line)
    model = ents.Model({"segment": "line2", "master": "rigid", "contact": {"normal": {"type": "penalty", "stiffness": 1.0}}})
    chain = np.column_stack([np.arange(len(line) - 1), np.arange(1, len(line))])
    found = ents.Tree(model, chain, line).detect(x, 2.0)
    hit, flagged = found["segment"] >= 0, found["flags"] & (ents.Flag.BEHIND_EDGE | ents.Flag.AMBIGUOUS) != 0
    # A point outside that projects on no face is ahead of a convex edge, the top corner of a tooth, and open.
    ahead = ~hit & (exact > 0)
    # Rounding of coordinates of 9: 9 x 2^-52.
    check.near("gap of the points that found a face", exact[hit], found["gap"][hit], 4e-15)
    check.near("points inside a tooth without face and flag", 0, np.count_nonzero(~hit & ~flagged & (exact < 0)), 0)
    check.true("points without a face", "above a tooth's corner", f"{np.count_nonzero(ahead)} of {len(x)}, lowest at y = {x[ahead, 1].min():.4g}",
               x[ahead, 1].min() > 4)
    # The other comb's teeth stand in the gaps, 1e-3 beside the left flanks, and go 2e-3 to the left: every point of their flanks closes.
    flanks = np.array([[2 * k - 1 + 1e-3, y] for k in range(1, 5) for y in np.linspace(0.2, 3.8, 10)])
    facets = np.array([[10 * k + j + 1, 10 * k + j] for k in range(4) for j in range(9)])
    contact = ents.Contact(model, flanks, facets[:, ::-1], chain, master_positions=line, reach=0.6)
    contact.update(np.zeros(flanks.size))
    check.near("gaps beside the flanks", 1e-3, contact.gap, 4e-15)
    contact.update(np.tile([-2e-3, 0.0], len(flanks)))
    check.near("gaps behind the flanks", -1e-3, contact.gap, 4e-15)
