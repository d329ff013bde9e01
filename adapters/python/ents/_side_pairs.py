# SPDX-License-Identifier: BSD-3-Clause
"""Which facets face each other: a slave point touches facets that look against it, and no others."""
from __future__ import annotations

import warnings
from typing import Optional

import numpy as np

from ._arrays import Error
from ._both_sides import BothSides
from ._sides import refuse_shared, reversed_pair
from ._structs import Status
from ._surface import Tree
from ._surfaces import MasterSurface, SlavePoints

FACING = -0.05  # cosine of the two normals up to which facets face each other: about 93 degrees
SAME_WAY = ("slave and master facets look the same way: one of the sides is listed in the wrong order. Normals point out of the bodies, at each other "
            "(2D: to the left of the way from the first node of a facet to the second; 3D: corners counter-clockwise, seen from outside). "
            "Reverse its facets: facets[:, ::-1]")


class SidePairs:
    """Orientation of slave points and segments against each other.

    joined [points] bool: nodes of both surfaces, where the bodies are one: no contact there
    """

    def __init__(self, slave: SlavePoints, master: MasterSurface, positions: np.ndarray, one_mesh: bool, both: Optional[BothSides] = None) -> None:
        self._slave, self._master, self._both, self.now = slave, master, both, positions
        used = np.unique(np.concatenate([group.nodes.ravel() for group in slave.groups]))
        self.joined = np.zeros(len(slave.areas), bool)
        if both is not None:
            self.joined = self._on_both_sides()
        elif one_mesh:
            refuse_shared(slave.groups, master.groups)
            of_master = np.unique(np.concatenate([group.nodes.ravel() for group in master.groups]))
            if slave.nodes is not None:
                self.joined = np.isin(slave.nodes, of_master)
            used = np.union1d(used, of_master)
        self._bodies = len(used) < len(positions)  # nodes beside those of the surfaces
        self.judged, self._sign = both is not None and both.one_surface, 1.0
        pair = reversed_pair(slave.groups)
        if pair is not None:
            self.judged, self._sign = True, 0.0
            warnings.warn(f"slave: the neighbours {pair[0]} and {pair[1]} are not oriented alike. Their forces are right; master facets that look the same way "
                          "as the slave are not recognised", UserWarning, stacklevel=4)

    def _on_both_sides(self) -> np.ndarray:
        """[points] bool: nodes of facets of both sides of two passes."""
        sides, points = self._both.sides, self._slave.nodes
        if sides is None or points is None:
            return np.zeros(len(self._slave.areas), bool)
        of_side = [np.concatenate([group.nodes[sides[group.numbers] == side].ravel() for group in self._slave.groups]) for side in (0, 1)]
        return np.isin(points, of_side[0]) & np.isin(points, of_side[1])

    def left_out(self, points: np.ndarray) -> dict[str, np.ndarray]:
        """Arguments of the search for these points, beside their normals."""
        return {} if self._both is None else self._both.left_out(points)

    def _cosines(self, points: np.ndarray, positions: np.ndarray, segments: np.ndarray) -> np.ndarray:
        """Of the normals of slave points and of segments: -1 where they face each other."""
        return self._sign * np.einsum("ij,ij->i", self._slave.normals(self.now, points), self._master.normals(positions, segments))

    def judge(self, tree: Tree, segment: np.ndarray) -> None:
        """Once: do all slave points that find a segment look the same way as that? Then a side is listed in the wrong order."""
        found = np.flatnonzero(segment >= 0)
        if self.judged or not len(found):
            return
        self.judged = True
        if not (self._cosines(found, tree.positions, segment[found]) > 0.1).all():
            return
        if self._bodies:
            raise Error(Status.BAD_VALUE, SAME_WAY)
        self._sign = -1.0
        warnings.warn(f"{SAME_WAY}. The master is taken as it is, the slave's order has no effect here", UserWarning, stacklevel=4)

    def normals(self) -> Optional[np.ndarray]:
        """[points][d] out of the slave's body, for the search; None where they mean nothing, or before the first `judge`."""
        return self._sign * self._slave.normals(self.now, np.arange(len(self._slave.areas))) if self.judged and self._sign else None

    def faces(self, tree: Tree, points: np.ndarray, segment: np.ndarray) -> np.ndarray:
        """[points] bool: do these slave points and segments look at each other?"""
        return self._cosines(points, tree.positions, segment) < FACING


def warn_of_deep(tree: Tree, pairs: SidePairs, points: np.ndarray, lost: np.ndarray, reach: float) -> None:
    """Points `lost` that find no segment in the first configuration: which of them are behind the surface, deeper than reach? Two faces of one thin
    solid are behind each other, too: hence a warning."""
    if not len(lost):
        return
    far = tree.detect(points[lost], 1e90, **pairs.left_out(lost))
    deep = np.flatnonzero((far["segment"] >= 0) & (far["gap"] < -reach))
    deep = deep[pairs.faces(tree, lost[deep], far["segment"][deep])]
    if len(deep):
        warnings.warn(f"slave point {lost[deep[0]]} begins {-far['gap'][deep[0]]:.6g} behind the master, more than reach = {reach:.6g} ({len(deep)} such points): "
                      "it has no contact. If it should, give a larger reach, or turn the facets of the master if they look the wrong way", UserWarning, stacklevel=4)
