# SPDX-License-Identifier: BSD-3-Clause
"""A master surface of many segments, and detection on it."""
import ctypes

import numpy as np

from ._arrays import CutStep, Error, _address, _array, _new
from ._structs import CONDITIONS, Detection, MasterMesh, Status, SurfaceAdmissibility


class Tree:
    """A master surface of many segments, and detection on it.

    connectivity [segments][m], positions [nodes][d] (current), surface_coordinates [segments][m][d-1] or None (the model's own, else s = xi)
    """

    def __init__(self, model, connectivity, positions, surface_coordinates=None):
        lay = model.layout
        self.model = model
        self.connectivity = _array("connectivity", connectivity, (None, lay.nodes), np.int64).copy()
        self.positions = _array("positions", positions, (None, lay.dimension)).copy()
        self.surface_coordinates = None if surface_coordinates is None else _array(
            "surface_coordinates", surface_coordinates, (len(self.connectivity), lay.nodes, lay.dimension - 1)).copy()
        self.mesh = _new(MasterMesh, segments=len(self.connectivity), connectivity=self.connectivity.ctypes.data, nodes=len(self.positions),
                         positions=self.positions.ctypes.data, surface_coordinates=_address(self.surface_coordinates))
        size = ctypes.c_int64()
        model._call("tree_size", len(self.connectivity), ctypes.byref(size))
        self._tree = np.zeros(size.value)
        model._call("tree_build", self.mesh, self._tree, len(self._tree))

    def move(self, positions):
        """New current positions [nodes][d]. No other thread may be using the tree."""
        self.positions[:] = _array("positions", positions, self.positions.shape)
        self.model._call("tree_refit", self.mesh, self._tree, len(self._tree))

    def detect(self, slave, reach, segment=None, xi=None, permitted=0):
        """Which segment is each slave [n][d] projected on, with |gap| <= reach? segment [n], xi [n][d-1]: the answers of before, which
        are kept where they still hold. Returns new arrays: segment (-1: none), xi, gap, flags (Flag), other (an equally good one, or -1).
        A slave that had a segment, finds none and has not risen from the surface raises CutStep, unless `permitted` has its flag (Flag.LEFT,
        Flag.BEHIND_EDGE): look at `flags` then. Give segment -1 for slaves that were open."""
        lay = self.model.layout
        slave = _array("slave", slave, (None, lay.dimension))
        n = len(slave)
        out = {"segment": np.full(n, -1, np.int64) if segment is None else _array("segment", segment, (n,), np.int64).copy(),
               "xi": np.zeros((n, lay.dimension - 1)) if xi is None else _array("xi", xi, (n, lay.dimension - 1)).copy(),
               "gap": np.zeros(n), "flags": np.zeros(n, np.int32), "other": np.full(n, -1, np.int64)}
        report = self.model._call("detect", self.mesh, self._tree, len(self._tree), 0, n, _new(
            Detection, slave=slave.ctypes.data, reach=reach, permitted=int(permitted), **{name: array.ctypes.data for name, array in out.items()}))
        if report.status:
            raise CutStep(Status(report.status), report.message.decode(), report.element, report.step_factor)
        return out

    def state_transfer(self, state, old, new, positions=None):
        """States [n][state_size] of the begin of the increment, there on the segments `old` [n], as their slaves see them from the segments `new` [n].
        -1 on either side: no history but what has been worn off. positions [nodes][d]: those at the begin of the increment (default: the present ones).
        Returns (status, states); status is the first that is not 0 (recoverable: cut the step)."""
        model = self.model
        state = _array("state", state, (None, model.layout.state_size))
        old, new = (_array(name, value, (len(state),), np.int64) for name, value in (("old", old), ("new", new)))
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

    def check(self, reach=0.0, kink=0.0, samples=0):
        """Is the enrichment admissible on this surface? (ents_surface_check; reach [L] and kink [rad] are bounds that only the caller knows.)
        Returns dict: "admissible"; for each of CONDITIONS a dict with "judged", "violated", "value", "bound", "missing", and where: "segment", "xi", "point",
        "other", "other_xi"; "violations" [segments]: bits 1 << place in CONDITIONS; "height_min", "height_max", "samples"."""
        d = self.model.layout.dimension
        violations = np.zeros(len(self.connectivity), np.int64)
        c = _new(SurfaceAdmissibility, samples=samples, reach=reach, kink=kink, violations=violations.ctypes.data)
        report = self.model._call("surface_check", self.mesh, c)
        if report.status:
            raise Error(Status(report.status), report.message.decode(), report.element)
        result = {"admissible": c.violated == 0, "violations": violations, "height_min": c.height_min, "height_max": c.height_max, "samples": c.samples}
        for i, name in enumerate(CONDITIONS):
            result[name] = {"judged": bool(c.judged >> i & 1), "violated": bool(c.violated >> i & 1), "value": c.value[i], "bound": c.bound[i],
                            "missing": c.missing[i], "segment": c.segment[i], "xi": list(c.xi[i])[:d - 1], "point": list(c.point[i])[:d],
                            "other": c.other[i], "other_xi": list(c.other_xi[i])[:d - 1]}
        return result
