# SPDX-License-Identifier: BSD-3-Clause
"""What an ents.Contact has found: results per slave point, energy and area, restart files and copies, a picture."""
from __future__ import annotations

import hashlib
import os
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from ._arrays import Error, _array, _frozen
from ._structs import Flag, Status

if TYPE_CHECKING:
    import scipy.sparse

SAVED = ("state", "segment_begin", "tree_begin", "hint", "xi", "own")


def _result(name: str, doc: str) -> property:
    return property(lambda self: self._results[name], doc=doc)


class ContactResults:
    """The results of a Contact; it has no constructor of its own."""

    gap = _result("gap", "[points] [L]; nan: nothing within reach, or no update() yet")
    pressure = _result("pressure", "[points] [F/A], per undeformed area; > 0 in contact")
    traction = _result("traction", "[points][d] [F/A] friction, as it acts on the master")
    flags = _result("flags", "[points] see ents.Flag")
    segment = _result("segment", "[points] segment of a point in contact; -1: open")
    points = _result("points", "[points][d] [L] where the slave points are")
    residual = _result("residual", "[rows] [F] internal force of the last update(), and power that leaves the nodes")
    heat = _result("heat", "[points][2] power through the gap, from slave to master, and made by friction; zeros without \"heat\" in the model")
    positions = property(lambda self: self._positions, doc="[nodes][d] undeformed positions [L], a copy of what was given")
    dofs = property(lambda self: self._dofs, doc="[nodes][d] equation of each displacement, -1: none")
    rows = property(lambda self: self._rows, doc="number of equations")
    nodes = property(lambda self: self._slave.nodes, doc="[points] the node that each slave point is, ascending; None: points are inside the facets")
    areas = property(lambda self: self._slave.areas, doc="[points] [A] tributary areas of the undeformed surface")
    body_thickness = property(lambda self: None if self._both is None or not self._both.one_surface else self._both.thickness.copy(),
                         doc="[points] [L] self-contact: of the body below each point at the begin of the increment, at most 2 reach; else None")
    sampling = property(lambda self: self._slave.sampling, doc="points per direction inside each slave facet; 0: slave points are nodes")

    def _start_results(self, count: int) -> None:
        d = self._positions.shape[1]
        for array in (self._slave.areas, self._slave.nodes):
            if array is not None:
                array.setflags(write=False)
        self._results: dict[str, Any] = {"gap": np.full(count, np.nan), "pressure": np.zeros(count), "traction": np.zeros((count, d)),
                                         "flags": np.zeros(count, np.int32), "segment": np.full(count, -1, np.int64), "points": self._slave.at(self._positions), "heat": np.zeros((count, 2))}
        for array in self._results.values():
            array.setflags(write=False)
        self._results["residual"], self._matrix = np.zeros(self.rows), None
        self._committed, self._searched, self._energy = (np.full(count, -1, np.int64), np.zeros((count, d - 1))), None, None

    def _keep(self, points: np.ndarray, result: dict[str, Any], residual: np.ndarray, matrix: Any) -> None:
        """The result of an update."""
        segment, flags = result["segment"], result["flags"]
        closed = np.where(flags & Flag.CONTACT != 0, segment, -1)
        kept = {"gap": np.where(segment >= 0, result["gap"], np.nan), "pressure": result["pressure"], "flags": flags, "segment": closed, "points": points,
                "traction": result["traction"] if "traction" in result else np.zeros(points.shape),
                "heat": result["heat"] if "heat" in result else np.zeros((len(points), 2))}
        for array in kept.values():
            array.setflags(write=False)
        self._results = {**kept, "residual": residual}
        self._matrix, self._energy = matrix, None
        self._state = _frozen(result["state_end"])
        self._pending, self._nodes_at, self._ahead = (segment, self.tree.positions.copy()), self._pairs.now, True
        # A closed point is followed; an open one is searched anew, for it may move over another flank.
        self._searched = result["segment"], result["xi"]
        self._hint, self._xi = closed, result["xi"]

    @property
    def tangent(self) -> scipy.sparse.csr_matrix:
        """csr_matrix [rows][rows] [F/L] of the last update()."""
        import scipy.sparse as sparse
        if self._matrix is None:
            return sparse.csr_matrix((self.rows, self.rows))
        if isinstance(self._matrix, tuple):
            data, columns, begin = self._matrix
            self._matrix = sparse.csr_matrix((data, columns.copy(), begin.copy()), (self.rows, self.rows))
            self._matrix.has_canonical_format = True
        return self._matrix

    def _more(self) -> dict[str, np.ndarray]:
        """Results of the last update() that few callers want: of the points that are assembled."""
        if self._energy is None:
            numbers = self._assembly[0]
            of = lambda array: None if array is None else np.ascontiguousarray(array[numbers])
            self._energy = self.model.iterate(of(self.points), self.tree, self.reach, of(self._searched[0]), of(self._searched[1]),
                                              "energy normal" + (" dissipation friction_energy" if self.model.layout.friction else ""),
                                              positions_begin=None if self.rigid else self._tree_begin, area=of(self._carried), state=of(self._state_begin),
                                              slave_values=of(self._slave_values), permitted=Flag.LEFT | Flag.BEHIND_EDGE, **self._pairs.left_out(numbers))
        return self._energy

    @property
    def energy(self) -> float:
        """[F L] of the normal law in the last update(): its derivative by u is the residual where there is no friction; a line search may use it."""
        return 0.0 if self._pending is None else float(self._more()["energy"].sum())

    @property
    def energies(self) -> dict[str, float]:
        """[F L] in the last update(): "normal", stored in the normal law; "elastic_slip", stored in friction; "dissipated" by friction since the last
        commit() (the force of the end on the slip of the increment, backward Euler)."""
        if self._pending is None:
            return {"normal": 0.0, "elastic_slip": 0.0, "dissipated": 0.0}
        found = self._more()
        return {name: float(found[of].sum()) if of in found else 0.0
                for name, of in (("normal", "energy"), ("elastic_slip", "friction_energy"), ("dissipated", "dissipation"))}

    def resultants(self, about: Any = None) -> dict[str, Any]:
        """What the pair carries in the last update(), as it acts on the slave side: see Library.contact_resultants. about [d]: point of the moment."""
        if self._both is not None and self._both.one_surface:
            raise Error(Status.BAD_VALUE, "resultants: what a surface carries in contact with itself adds up to zero; take pressure * areas of the points of one part")
        numbers = np.arange(len(self.areas)) if self._pending is None else self._assembly[0]
        of = lambda array: np.ascontiguousarray(array[numbers])
        normal = np.zeros((len(numbers), self._positions.shape[1])) if self._pending is None else self._more()["normal"]
        sign = np.ones((len(numbers), 1)) if self._both is None else 1.0 - 2.0 * self._both.of_points[numbers, None]  # as it acts on the slave's side
        return self.model.library.contact_resultants(of(self.points), sign * normal, of(self.pressure), of(self._carried), of(self.flags),
                                                     sign * of(self.traction) if self.model.layout.friction else None, about)

    def contact_area(self, modulus: float = 0.0, thickness: float = 1.0) -> dict[str, float]:
        """Area in contact and peak pressure with estimates of their errors, see Library.contact_area; modulus: E / (1 - nu^2). For slave points
        that are nodes of line2, tri3 or quad4 facets of one shape; of points inside the facets take areas[pressure > 0].sum()."""
        if self._both is not None:
            raise Error(Status.BAD_VALUE, "contact_area: both sides have slave points here; take areas[pressure > 0].sum() of one side")
        if self.nodes is None or len(self._slave.groups) > 1:
            raise Error(Status.BAD_VALUE, "contact_area: it is for slave points that are nodes of facets of one shape; here take areas[pressure > 0].sum()")
        gap, pressure = np.full(len(self.positions), np.nan), np.zeros(len(self.positions))
        gap[self.nodes], pressure[self.nodes] = self.gap, self.pressure
        shape, nodes, _ = self._slave.groups[0]
        return self.model.library.contact_area(shape, nodes, self.positions, gap, pressure, modulus, thickness)

    @property
    def state(self) -> np.ndarray:
        """[points][state_size] of the end of the last update(); cannot be written to. `contact.state = saved` makes saved states those of the begin
        of the increment: then update(u) with the displacements at which they were saved, and commit(). save() and load() keep all that belongs to
        a state."""
        return self._state

    @state.setter
    def state(self, value: Any) -> None:
        state = _array("state", value, self._state.shape).copy()
        if not np.isfinite(state).all():
            raise Error(Status.NON_FINITE, "state: it holds numbers that are not finite")
        self._state_begin = self._state = _frozen(state)
        if self._points_begin is None:
            self._measure(self.points)
        self._points_begin, self._nodes_begin, self._ahead = self.points, None, False
        segments = state[:, -1] - 1  # a state knows its segment
        whole = (segments >= 0) & (segments < len(self.tree.connectivity)) & (segments == np.floor(segments))
        self._segment_begin, self._pending = np.where(whole, segments, -1).astype(np.int64), None

    def _history(self) -> dict[str, np.ndarray]:
        """All that the next increment depends on, at the last commit()."""
        own = np.zeros(0) if self._own is None else self._own
        nothing = np.zeros((0, 0))
        thickness = np.zeros(0) if self._both is None else self._both.thickness
        return {"thickness": thickness, "state": self._state_begin, "segment_begin": self._segment_begin, "tree_begin": self._tree_begin, "hint": self._committed[0],
                "xi": self._committed[1], "own": own, "points_begin": nothing if self._points_begin is None else self._points_begin,
                "nodes_begin": nothing if self._nodes_begin is None else self._nodes_begin, **self._saved_fields()}

    def _restore(self, history: dict[str, np.ndarray]) -> None:
        now = self._history()
        for name in SAVED:
            if name not in history or np.shape(history[name]) != now[name].shape:
                raise Error(Status.BAD_STATE, f"load: {name} is not that of this contact: the surfaces or the model are others")
        fields = self._fields_of(history)
        self._state_begin = self._state = _frozen(np.array(history["state"]))
        self._segment_begin, self._tree_begin = np.array(history["segment_begin"]), np.array(history["tree_begin"])
        self._committed = self._hint, self._xi = np.array(history["hint"]), np.array(history["xi"])
        self._own = None if self._own is None else np.array(history["own"])
        self._pending, self._ahead = None, False
        if self._both is not None:
            self._both.thickness = np.array(history["thickness"])
        self._points_begin = np.array(history["points_begin"]) if history["points_begin"].size else None
        self._nodes_begin = np.array(history["nodes_begin"]) if np.size(history.get("nodes_begin", ())) else None
        if fields:
            for block, saved in fields:
                block[:] = saved
            self._take_fields()

    def _name(self) -> str:
        """A fingerprint of the surfaces."""
        parts = (self.positions, self.tree.connectivity, self._slave.matrix.indices, self._slave.matrix.data, self.areas)
        return hashlib.sha256(b"".join(np.ascontiguousarray(part).tobytes() for part in parts)).hexdigest()

    def save(self, file: Union[str, os.PathLike]) -> None:
        """Write the history at the last commit() to a file (NumPy's .npz), for `load` in another run of the same program. With wear it has the blocks of the
        fields of both heights, and load() writes them into those that are bound."""
        with open(file, "wb") as stream:
            np.savez(stream, surfaces=self._name(), segment=self.model.segment, **self._history())

    def load(self, file: Union[str, os.PathLike]) -> None:
        """Take the history of `save`: what follows has the bits that it would have had there. The surfaces have to be the same."""
        with np.load(file, allow_pickle=False) as saved:
            history = {name: saved[name] for name in saved.files}
        if str(history.get("surfaces")) != self._name() or str(history.get("segment")) != self.model.segment:
            raise Error(Status.BAD_STATE, f"load: {os.fspath(file)} was saved with other surfaces: make the contact with the same positions, facets and model first")
        self._restore(history)

    def __getstate__(self) -> dict[str, Any]:
        last = {name: getattr(self, name, None) for name in ("_results", "_matrix", "_state", "_pending", "_hint", "_xi", "_searched", "_energy", "_reach", "_nodes_at", "_ahead")}
        height = {} if self._arguments["slave_height"] is None else {"slave_height": self._slave.surface}
        return {"arguments": {**self._arguments, "model": self.model, **height}, "history": self._history(), "last": last, "tree": self.tree.positions}

    def __setstate__(self, saved: dict[str, Any]) -> None:
        self.__init__(**saved["arguments"])  # type: ignore[misc]
        self._restore(saved["history"])
        self.tree.move(saved["tree"])
        self.__dict__.update(saved["last"])
        for array in (*self._results.values(), self._state):
            array.setflags(write=False)
        self._results["residual"] = self._results["residual"].copy()

    def plot(self, axes: Any = None) -> Any:
        """The contact pressure on the slave points with matplotlib, and in 2D the enriched master and the points. Returns the axes."""
        from ._picture import plot
        return plot(self, axes)
