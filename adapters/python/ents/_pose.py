# SPDX-License-Identifier: BSD-3-Clause
"""Where a rigid master is."""
from __future__ import annotations

import ctypes
from typing import Any

import numpy as np

from . import _structs
from ._arrays import _array, _count, _new
from ._library import library


class Pose:
    """A rigid master that moves and turns: x = point + turn @ y, y in the body's frame, where its nodes, tree and height never change.

        pose = ents.Pose(3, point=[0, 0, 0])
        pose.move(translation=[0, 0, -0.1], spin=[0, 0, 0.02])      # spin: rotation vector in space, radians; 2D: an angle
        seen = pose.to_body(positions)                              # slave points for detect, evaluate and assemble
        model.assemble(ents.System(..., pose=pose, body_equations=rows), seen, tree, segment)

    dimension 2 or 3; point [d] is the reference point: moments are about it. The model says "master": "rigid".
    """

    def __init__(self, dimension: int, point: Any = None) -> None:
        dimension = _count("dimension", dimension, 2, 3)
        self._dimension, self._struct = dimension, _new(_structs.Pose)
        library().call("pose_init", dimension, self._struct)
        if point is not None:
            self.move(translation=point)

    dimension = property(lambda self: self._dimension, doc="2 or 3")
    point = property(lambda self: np.array(self._struct.point[:self.dimension]), doc="[d] reference point in space")
    turn = property(lambda self: np.array(self._struct.turn[:self.dimension ** 2]).reshape(self.dimension, -1), doc="[d][d] Q")

    def __repr__(self) -> str:
        return f"<ents.Pose: point {self.point.tolist()}, turn {self.turn.tolist()}>"

    def move(self, translation: Any = None, spin: Any = None) -> None:
        """Move the reference point, and turn the body about it by a rotation vector in space."""
        d = self.dimension
        translation = None if translation is None else _array("translation", translation, (d,))
        spin = None if spin is None else _array("spin", np.atleast_1d(spin), (1 if d == 2 else 3,))
        library().call("pose_move", d, translation, spin, self._struct)

    def to_body(self, positions: Any) -> np.ndarray:
        """[n][d] in space -> [n][d] in the body's frame."""
        return self._changed("pose_to_body", "positions", positions)

    def to_space(self, vectors: Any) -> np.ndarray:
        """Normals, tractions, forces [n][d] of the body's frame in space."""
        return self._changed("pose_to_space", "vectors", vectors)

    def _changed(self, function, name, given):
        given = _array(name, given, (None, self.dimension))
        out = np.zeros_like(given)
        library().call(function, self.dimension, self._struct, len(given), given, out)
        return out

    def element(self, slave: Any, residual: Any, tangent: Any) -> tuple[np.ndarray, np.ndarray]:
        """Residual [n] and tangent [n][n] of a slave point and the body from those [d], [d][d] of Model.evaluate in its frame; n = 2d + 1 (2D), 2d + 3:
        the slave's displacement, the reference point's, the spin."""
        d = self.dimension
        n = 2 * d + (1 if d == 2 else 3)
        r, t = np.zeros(n), np.zeros((n, n))
        columns = np.ascontiguousarray(_array("tangent", tangent, (d, d)).T)
        library().call("pose_element", d, self._struct, _array("slave", slave, (d,)), _array("residual", residual, (d,)), columns, r, t)
        return r, t.T

    def _address(self) -> int:
        return ctypes.addressof(self._struct)
