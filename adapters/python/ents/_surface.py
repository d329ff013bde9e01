# SPDX-License-Identifier: BSD-3-Clause
"""A master surface of many segments, and detection on it."""
from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any

import numpy as np

from ._arrays import Error, _address, _array, _count, _frozen, _new
from ._structs import CONDITIONS, Detection, MasterMesh, Status, SurfaceAdmissibility

if TYPE_CHECKING:
    from ._model import Model


LEFT_OUT = {"slave_node": np.int64, "slave_segment": np.int64, "depth": np.float64, "slave_side": np.int32, "segment_side": np.int32}
"""What Tree.detect and Model.iterate take beside slave_normal: see ents_detection in ents.h."""


def left_out_arrays(slaves: int, segments: int, given: dict[str, Any]) -> dict[str, np.ndarray]:
    unknown = [name for name in given if name not in LEFT_OUT]
    if unknown:
        raise TypeError(f"there is no argument {unknown[0]}; what is left out of a search is given as {', '.join(LEFT_OUT)}")
    return {name: _array(name, array, (segments if name == "segment_side" else slaves,), LEFT_OUT[name]) for name, array in given.items() if array is not None}


class Tree:
    """A master surface of many segments, and detection on it.

    connectivity [segments][m], positions [nodes][d] (current), surface_coordinates [segments][m][d-1] or None (the model's own, else s = xi)
    """

    def __init__(self, model: Model, connectivity: Any, positions: Any, surface_coordinates: Any = None) -> None:
        lay = model.layout
        self.model = model
        self._connectivity = _frozen(_array("connectivity", connectivity, (None, lay.nodes), np.int64).copy())
        self._positions = _array("positions", positions, (None, lay.dimension)).copy()
        self._coordinates = None if surface_coordinates is None else _frozen(_array(
            "surface_coordinates", surface_coordinates, (len(self._connectivity), lay.nodes, lay.dimension - 1)).copy())
        self.mesh = _new(MasterMesh, segments=len(self._connectivity), connectivity=self._connectivity.ctypes.data, nodes=len(self._positions),
                         positions=self._positions.ctypes.data, surface_coordinates=_address(self._coordinates))
        size = ctypes.c_int64()
        model._call("tree_size", len(self._connectivity), ctypes.byref(size))
        self._tree = np.zeros(size.value)
        model._call("tree_build", self.mesh, self._tree, len(self._tree))

    connectivity = property(lambda self: self._connectivity, doc="[segments][m], a copy of what was given; cannot be written to")
    surface_coordinates = property(lambda self: self._coordinates, doc="[segments][m][d-1] or None, a copy; cannot be written to")

    @property
    def positions(self) -> np.ndarray:
        """[nodes][d], current; cannot be written to: call move(positions)."""
        return _frozen(self._positions.view())

    def set_temperature(self, temperature: Any) -> None:
        """Temperatures [nodes], for a model with "heat"."""
        self._temperature = _array("temperature", temperature, (len(self._positions),)).copy()
        self.mesh.temperature = self._temperature.ctypes.data

    def __repr__(self) -> str:
        return f"<ents.Tree: {len(self._connectivity)} {self.model.segment} segments over {len(self._positions)} nodes>"

    def __reduce__(self) -> tuple:
        return Tree, (self.model, self._connectivity, self._positions, self._coordinates)

    def move(self, positions: Any) -> None:
        """New current positions [nodes][d]. No other thread may be using the tree. After an error it is as before."""
        before = self._positions.copy()
        self._positions[:] = _array("positions", positions, before.shape)
        try:
            self.model._call("tree_refit", self.mesh, self._tree, len(self._tree))
        except Exception:
            self._positions[:] = before
            self.model._call("tree_build", self.mesh, self._tree, len(self._tree))
            raise

    def boxes(self) -> np.ndarray:
        """[segments][2 d]: low and high corners of boxes around the enriched segments, with their heights and borders."""
        found = np.empty((len(self._connectivity), 2 * self.model.layout.dimension))
        self.model._call("surface_boxes", self.mesh, found)
        return found

    def detect(self, slave: Any, reach: float, segment: Any = None, xi: Any = None, permitted: int = 0,
               slave_normal: Any = None, **left_out: Any) -> dict[str, np.ndarray]:
        """Which segment is each slave [n][d] projected on, with |gap| <= reach? segment [n], xi [n][d-1]: the answers of before, which
        are kept where they still hold. Returns new arrays: segment (-1: none), xi, gap, flags (Flag), other (an equally good one, or -1).
        A slave that had a segment, finds none and has not risen from the surface raises CutStep, unless `permitted` has its flag (Flag.LEFT,
        Flag.BEHIND_EDGE): look at `flags` then. Give segment -1 for slaves that were open. slave_normal [n][d], out of the slave's body:
        segments that look the same way are left out.
        left_out: self-contact and two passes, as in ents_detection. slave_node [n] the node of the tree that each slave is (-1: none): its segments are
        left out; slave_segment [n] the one on which it lies: it and those that share a node with it; depth [n] L: what a slave is behind by more is no
        contact; slave_side [n] and segment_side [segments]: segments of the slave's own side."""
        lay = self.model.layout
        slave = _array("slave", slave, (None, lay.dimension))
        n = len(slave)
        normal = None if slave_normal is None else _array("slave_normal", slave_normal, slave.shape)
        out = {"segment": np.full(n, -1, np.int64) if segment is None else _array("segment", segment, (n,), np.int64).copy(),
               "xi": np.zeros((n, lay.dimension - 1)) if xi is None else _array("xi", xi, (n, lay.dimension - 1)).copy(),
               "gap": np.zeros(n), "flags": np.zeros(n, np.int32), "other": np.full(n, -1, np.int64)}
        given = left_out_arrays(n, len(self._connectivity), left_out)
        self.model._call("detect", self.mesh, self._tree, len(self._tree), 0, n, _new(
            Detection, slave=slave.ctypes.data, reach=float(reach), permitted=int(permitted), slave_normal=_address(normal),
            **{name: array.ctypes.data for name, array in (*out.items(), *given.items())}))
        return out

    def thickness(self, slave: Any, reach: float, slave_normal: Any, before: Any = None, **left_out: Any) -> np.ndarray:
        """[n] [L] the thickness of the body below slaves [n][d] of this surface, at most 2 reach (ents_thickness). Half of it is the `depth` for `detect`
        in self-contact. before [n]: the thickness at the begin of the increment before; what is nearer than half of it is contact, no other side of the
        body. left_out: as for `detect`."""
        slave = _array("slave", slave, (None, self.model.layout.dimension))
        n = len(slave)
        normal = _array("slave_normal", slave_normal, slave.shape)
        found = np.zeros(n) if before is None else _array("before", before, (n,)).copy()
        segment, xi = np.full(n, -1, np.int64), np.zeros((n, self.model.layout.dimension - 1))
        given = left_out_arrays(n, len(self._connectivity), left_out)
        self.model._call("thickness", self.mesh, self._tree, len(self._tree), 0, n, _new(
            Detection, slave=slave.ctypes.data, reach=float(reach), slave_normal=normal.ctypes.data, segment=segment.ctypes.data, xi=xi.ctypes.data,
            **{name: array.ctypes.data for name, array in given.items()}), found)
        return found

    def state_transfer(self, state: Any, old: Any, new: Any, positions: Any = None) -> tuple[int, np.ndarray]:
        """States [n][state_size] of the begin of the increment, there on the segments `old` [n], as their slaves see them from the segments `new` [n].
        -1 on either side: no history but what has been worn off. positions [nodes][d]: those at the begin of the increment (default: the present ones).
        Returns (status, states); status is the first that is not 0 (recoverable: cut the step)."""
        model = self.model
        state = _array("state", state, (None, model.layout.state_size))
        old, new = (_array(name, value, (len(state),), np.int64) for name, value in (("old", old), ("new", new)))
        for name, segment in (("old", old), ("new", new)):
            if len(segment) and not -1 <= segment.min() <= segment.max() < len(self._connectivity):
                raise Error(Status.BAD_VALUE, f"{name}: segments are -1 .. {len(self._connectivity) - 1}")
        positions = self.positions if positions is None else _array("positions", positions, self.positions.shape)
        moved = np.where(((old >= 0) & (new >= 0))[:, None], state, model.state_opened(state))
        first = 0
        for k in np.flatnonzero((old >= 0) & (new >= 0) & (old != new)):
            s = (None, None) if self.surface_coordinates is None else self.surface_coordinates[[old[k], new[k]]]
            status, one = model.state_transfer(positions[self.connectivity[old[k]]], positions[self.connectivity[new[k]]], state[k], *s)
            if status == 0:
                moved[k] = one
            first = first or status
        return first, moved

    def check(self, reach: float = 0.0, kink: float = 0.0, samples: int = 0) -> dict[str, Any]:
        """Is the enrichment admissible on this surface? (ents_surface_check; reach [L] and kink [rad] are bounds that only the caller knows.)
        Returns dict: "admissible"; for each of CONDITIONS a dict with "judged", "violated", "value", "bound", "missing", and where: "segment", "xi", "point",
        "other", "other_xi"; "violations" [segments]: bits 1 << place in CONDITIONS; "height_min", "height_max", "samples"."""
        d = self.model.layout.dimension
        violations = np.zeros(len(self.connectivity), np.int64)
        c = _new(SurfaceAdmissibility, samples=_count("samples", samples, 0, 4096), reach=float(reach), kink=float(kink), violations=violations.ctypes.data)
        self.model.library.call("surface_check", self.model._handle, self.mesh, c, positive=Error)
        result = {"admissible": c.violated == 0, "violations": violations, "height_min": c.height_min, "height_max": c.height_max, "samples": c.samples}
        for i, name in enumerate(CONDITIONS):
            result[name] = {"judged": bool(c.judged >> i & 1), "violated": bool(c.violated >> i & 1), "value": c.value[i], "bound": c.bound[i],
                            "missing": c.missing[i], "segment": c.segment[i], "xi": list(c.xi[i])[:d - 1], "point": list(c.point[i])[:d],
                            "other": c.other[i], "other_xi": list(c.other_xi[i])[:d - 1]}
        return result
