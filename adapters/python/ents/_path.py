# SPDX-License-Identifier: BSD-3-Clause
"""What a slave point may have passed in an increment that moves it farther than it is searched for."""
from __future__ import annotations

import warnings

import numpy as np

from ._arrays import CutStep
from ._side_pairs import SidePairs
from ._structs import Status
from ._surface import Tree

MOST = 64  # places looked at on the way of a point


class Path:
    """Slave points and segments at the begin of the increment. open [points] bool: those without contact then."""

    def __init__(self, points: np.ndarray, positions: np.ndarray, is_open: np.ndarray) -> None:
        self.points, self._positions, self._open = points, positions, is_open

    def refuse_crossed(self, tree: Tree, pairs: SidePairs, points: np.ndarray, still_open: np.ndarray, reach: float) -> None:
        """CutStep for a point that was open, is open, and was behind the surface in between. Only a point that has moved by more than `reach` relative
        to the master can be beyond what the search sees."""
        moved = np.linalg.norm(points - self.points, axis=1) + np.linalg.norm(tree.positions - self._positions, axis=1).max(initial=0.0)
        farthest = np.flatnonzero(self._open & still_open & (moved > reach))
        if len(farthest):  # whose way does not meet the box of the master at all
            low, high = (of.reduce(np.vstack([self._positions, tree.positions])) for of in (np.minimum, np.maximum))
            ends = self.points[farthest], points[farthest]
            farthest = farthest[((np.minimum(*ends) <= high + reach) & (np.maximum(*ends) >= low - reach)).all(axis=1)]
        if not len(farthest):
            return
        longest = moved[farthest].max()
        count = int(np.ceil(2 * longest / reach))
        if count > MOST:
            k = int(farthest[moved[farthest].argmax()])
            raise CutStep(Status.NO_PROJECTION, f"slave point {k} moves by {longest:.6g} relative to the master, {longest / reach:.3g} times reach: it may pass through the "
                          "surface unseen. Take a smaller step, or give a larger reach", k, MOST * reach / (2 * longest))
        end = tree.positions.copy()
        try:
            for part in np.arange(1, count) / count:
                tree.move(self._positions + part * (end - self._positions))
                place = self.points[farthest] + part * (points[farthest] - self.points[farthest])
                found = tree.detect(place, reach)
                behind = np.flatnonzero((found["segment"] >= 0) & (found["gap"] < 0))
                behind = behind[pairs.faces(tree, farthest[behind], found["segment"][behind])]
                if len(behind):
                    k = int(farthest[behind[0]])
                    raise CutStep(Status.NO_PROJECTION, f"slave point {k} passes through the master between the begin of the increment and here (at {part:.3g} of the way): "
                                  "take a smaller step", k, float(part))
        finally:
            tree.move(end)


def warn_of_deep(tree: Tree, pairs: SidePairs, points: np.ndarray, lost: np.ndarray, reach: float) -> None:
    """Points `lost` that find no segment in the first configuration: which of them are behind the surface, deeper than reach? Two faces of one thin
    solid are behind each other, too: hence a warning."""
    if not len(lost):
        return
    far = tree.detect(points[lost], 1e90)
    deep = np.flatnonzero((far["segment"] >= 0) & (far["gap"] < -reach))
    deep = deep[pairs.faces(tree, lost[deep], far["segment"][deep])]
    if len(deep):
        warnings.warn(f"slave point {lost[deep[0]]} begins {-far['gap'][deep[0]]:.6g} behind the master, more than reach = {reach:.6g} ({len(deep)} such points): "
                      "it has no contact. If it should, give a larger reach, or turn the facets of the master if they look the wrong way", UserWarning, stacklevel=4)
