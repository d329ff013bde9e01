# SPDX-License-Identifier: BSD-3-Clause
"""Published cases as decks: `ents-deck run`, and ccx's own contact on the same deck with the same stiffness, in ccx with finite strain."""
import math

import numpy as np

import ccx
from benchmarks import cylinder_on_block, punch_on_foundation
from bodies import annulus
from fem import block
from rows import target

STEEL, ALUMINIUM = (210e3, 0.3), (70e3, 0.3)


def on_base(low, high):
    """[(nodes, axis)]: both bodies on the axis of symmetry, the lower one fixed below."""
    return [(np.r_[low.left, high.left + len(low.positions)], 0), (low.base, 0), (low.base, 1)]


def static(loads, increments=5):
    return ["*STATIC", f"{1 / increments!r}, 1., 1e-5, {1 / increments!r}", *loads]


@target("nafems_cylinder_deck", case="nafems_cylinder as a deck of CPE4, finite strain; mu 0, 0.1", source="NAFEMS (Konter no. 1), Code_Aster SSNP154",
        right="the block's top goes down by 1.307, with friction by 1.301, to 2 %")
def nafems_cylinder_deck(check):
    low, high, notch, _ = cylinder_on_block(8, 7, 8.0)
    n = len(low.positions)
    high.positions[:, 1] -= 0.002  # in contact at first; a body that nothing holds has no stiffness
    near = high.base[high.positions[high.base, 0] < 20]
    loads = ["*CLOAD", *[f"{node + n + 1}, 2, {-17500 / len(notch)!r}" for node in notch]]
    for friction, published in ((None, 1.307), (0.1, 1.301)):
        text = ccx.deck(low, high, (ALUMINIUM, STEEL), low.top, near, 10 * 70e3, on_base(low, high), [static(loads)], friction, watched=[low.top[0]])
        ours, own = ccx.both(check, f"mu_{friction or 0}", text)
        # 6 cells in the half-width of contact give 1 %, the penalty gives way by p0 / (10 E) = 0.005; the published codes' own meshes do the rest.
        check.near(f"mu = {friction or 0}: displacement / {published}", 1, -ours[low.top[0]][1] / published, 0.02, -own[low.top[0]][1] / published)


@target("nafems_punch_deck", case="nafems_punch as a deck of CAX4, finite strain; mu 0, 0.1", source="NAFEMS (Konter no. 2), Code_Aster SSNA122",
        right="the axis goes down by 0.1329, with friction by 0.1308, to 1 %")
def nafems_punch_deck(check):
    low, high, _ = punch_on_foundation(1.0)
    n, cells = len(low.positions), len(low.cells)
    high.positions[:, 1] -= 1e-4
    near = high.base[high.positions[high.base, 0] < 44]
    loads = ["*DLOAD", *[f"{cells + cell + 1}, P{face}, 100." for cell, face in ccx.faces_of(high, high.top)]]
    for friction, published in ((None, 0.1329), (0.1, 0.1308)):
        text = ccx.deck(low, high, (ALUMINIUM, STEEL), low.top[low.positions[low.top, 0] < 60], near, 10 * 70e3, on_base(low, high), [static(loads, 2)],
                        friction, axisymmetric=True, watched=low.top[[0, 12]])
        ours, own = ccx.both(check, f"mu_{friction or 0}", text)
        check.near(f"mu = {friction or 0}: displacement / {published}", 1, -ours[low.top[0]][1] / published, 0.01, -own[low.top[0]][1] / published)
        # ccx's own contact loses the node on the axis, where faces of the wedge have two nodes in one place. The two differ by where their points lie
        # in faces on edges of the other mesh, a few of those that carry.
        aside = low.top[12]
        check.near(f"mu = {friction or 0}: ents-deck / ccx's own at r = {low.positions[aside, 0]:.0f}", 1, ours[aside][1] / own[aside][1], 1e-3)


def rings(check, name, radii, interference, material, outside, increments):
    """Displacements of the outer nodes of the inner ring, outwards: (ents-deck, ccx's own contact), CPS4."""
    inner, outer = annulus(radii[0], radii[1], 8, 48), annulus(radii[1] - interference, radii[2], 6, 48)
    n, cells = len(inner.positions), len(inner.cells)
    both = inner.joined(outer)
    # Along x and y the rings are held sideways.
    held = [(np.flatnonzero(np.abs(both.positions[:, 1 - axis]) > np.abs(both.positions[:, axis]) * 1e9), axis) for axis in (0, 1)]
    loads = [] if outside == 0 else ["*DLOAD", *[f"{cells + cell + 1}, P{face}, {outside!r}" for cell, face in ccx.faces_of(outer, outer.outside)]]
    stiffness = 1000 * material[0] / (radii[1] - radii[0])
    text = ccx.deck(inner, outer, (material, material), inner.outside, outer.inside, stiffness, held, [static(loads, increments)], watched=inner.outside,
                    plane_stress=True)
    outwards = inner.positions[inner.outside] / radii[1]
    return [np.einsum("ij,ij->i", [u[node] for node in inner.outside], outwards) for u in ccx.both(check, name, text)]


def shrinks(radii, young, poisson, pressure):
    """Lame: the outer radius of a ring under pressure outside."""
    a, b = radii[0] ** 2, radii[1] ** 2
    return -pressure * radii[1] / young * ((b + a) / (b - a) - poisson)


def compare_rings(check, name, radii, overlap, material, outside, pressure):
    """Displacement of the inner ring over Lame's under this pressure between the rings."""
    ours, own = rings(check, name, radii, overlap, material, outside, 1)
    right = shrinks(radii, *material, pressure)
    check.near("displacement / Lame's", 1, ours / right, 5e-3, own.mean() / right)


@target("lame_rings_deck", case="lame_rings as a deck of CPS4", source="Code_Aster SSNP152", right="pressure between them 925925.9 to 0.5 %, by the inner ring's displacement")
def lame_rings_deck(check):
    # 1 / 8 of a ring's width in a cell: 1 / 64 of the bending part, which is less than a fifth of it there; strains of 0.1 %.
    compare_rings(check, "rings", (0.2, 0.6, 1.0), 0.0, (1e9, 0.2), 1e6, 925925.9)


@target("press_fit_deck", case="press_fit as a deck of CPS4", source="Lame", right="pressure 6.1523 to 0.5 %, by the inner ring's displacement")
def press_fit_deck(check):
    compare_rings(check, "fit", (10.0, 20.0, 30.0), 0.0025, (210e3, 0.3), 0, 6.1523)


def quarter_ring(inner, outer, radial, around):
    """A quarter of a ring of CPE8, whose middles lie on the circles: where two polygons slide, their corners hook into each other."""
    polar = lambda x: (inner * (outer / inner) ** x[:, :1]) * np.column_stack([np.cos(math.pi / 2 * x[:, 1]), np.sin(math.pi / 2 * x[:, 1])])
    body = block("quad8", [radial, around], [0, 0], [1, 1], polar)
    step = math.pi / 2 / around
    between = np.abs(np.arctan2(body.positions[:, 1], body.positions[:, 0]) / step % 1 - 0.5) < 0.1
    body.positions[between] /= math.cos(step / 2)
    r = np.hypot(*body.positions.T)
    body.inside, body.outside = np.flatnonzero(r < inner * 1.0001), np.flatnonzero(r > outer * 0.9999)
    return body


@target("disk_in_ring_deck", case="disk_in_ring as a deck of CPE8, a quarter of it", source="Code_Aster SSNP169F",
        right="radial displacement between -0.00422769 and -0.00441231: mean to 0.5 %, wave to 2 %")
def disk_in_ring_deck(check):
    part = 1e-3  # as in disk_in_ring
    inner, outer = quarter_ring(0.006, 0.6, 16, 12), quarter_ring(0.6, 1.0, 4, 12)
    before, both = len(inner.cells), inner.joined(outer)
    middle = lambda cell: math.atan2(*outer.positions[outer.cells[cell, :4]].mean(axis=0)[::-1])
    loads = [f"{before + cell + 1}, P{face}, {part * (1e7 + 1e5 * math.cos(2 * middle(cell)))!r}" for cell, face in ccx.faces_of(outer, outer.outside)]
    held = [(np.flatnonzero(np.abs(both.positions[:, axis]) < 1e-9), axis) for axis in (0, 1)]
    text = ccx.deck(inner, outer, [(1e9, 0.2)] * 2, inner.outside, outer.inside, 1000 * 1e9 / 0.4, held, [static(["*DLOAD", *loads], 1)],
                    watched=inner.outside)
    ours, own = (np.array([u[node] @ inner.positions[node] for node in inner.outside]) / 0.6 / part for u in ccx.both(check, "disk", text))
    # 24 quadratic cells in a wave; the penalty gives way by 0.06 % of the displacements, the hole takes 0.01 %.
    for name, of, right, bound in (("mean displacement / 0.00432", lambda u: (u.max() + u.min()) / 2, -0.00432, 5e-3),
                                   ("wave of the displacement / 9.230599e-5", lambda u: np.ptp(u) / 2, 9.230599e-5, 0.02)):
        check.near(name, 1, of(ours) / right, bound, of(own) / right)


@target("patch_deck", case="patch as decks of CPE4 and CPE8, finite strain: 3 faces under 3, 2 and 5", source="El-Abbasi, Bathe 2001; Code_Aster SSNP121",
        right="displacement of the interface -0.05: to 1e-6 where faces match, else to 0.5 % (stresses, on the page of ents-deck: 0.3 %)")
def patch_deck(check):
    for element in ("quad4", "quad8"):
        for above in (3, 2, 5):
            low, high = block(element, [3, 2], [0, 0], [1, 1]), block(element, [above, 2], [0, 1], [1, 2])
            n, both = len(low.positions), low.joined(high)
            high.positions[:, 1] -= 1e-9
            interface = low.where(1, 1)
            held = [(both.where(0, 0), 0), (low.where(1, 0), 1)]
            drive = ["*BOUNDARY", *[f"{node + n + 1}, 2, 2, -0.1" for node in high.where(1, 2 - 1e-9)]]
            text = ccx.deck(low, high, [(2e6, 0.0)] * 2, interface, high.where(1, 1 - 1e-9), 2e12, held, [static(drive, 1)], watched=interface)
            ours, own = ccx.both(check, f"{element}_{above}", text)
            # The penalty gives way by 1e5 / 2e12.
            check.near(f"{element}, 3 under {above}: displacement / -0.05", 1, [ours[node][1] / -0.05 for node in interface],
                       2e-6 if above == 3 else 5e-3, np.mean([own[node][1] for node in interface]) / -0.05)
