# SPDX-License-Identifier: BSD-3-Clause
"""Published cases as decks: `ents-deck run`, and ccx's own contact on the same deck with the same stiffness, in ccx with finite strain."""
import numpy as np

import ccx
from benchmarks import cylinder_on_block, punch_on_foundation
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
        # in faces on edges of the other mesh, a few of the 35 that carry.
        aside = low.top[12]
        check.near(f"mu = {friction or 0}: ents-deck / ccx's own at r = {low.positions[aside, 0]:.0f}", 1, ours[aside][1] / own[aside][1], 1e-3)
