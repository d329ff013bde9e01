# SPDX-License-Identifier: BSD-3-Clause
"""Contact of two surfaces that are distributed over the processes of a communicator: no process knows one as a whole."""
from __future__ import annotations

import os
import zlib
from typing import Any, NamedTuple, Optional, Union

import numpy as np

from ._arrays import CutStep, Error, _array
from ._exchange import Exchange, Guard
from ._ghosts import Facets, Given, Halo
from ._model import Model
from ._process_contact import History, LocalContact
from ._process_surfaces import ProcessSurfaces, merged
from ._side_pairs import SAME_WAY
from ._sides import FACETS
from ._structs import ENDS_STRAIGHT, Status
from .contact import BORDER, _refuse_models

NO_OWNERS = "owners: say for each node which process owns it (in dolfinx: index_map.owners for ghosts, comm.rank for the others)"


RESULTS = ("gap", "pressure", "traction", "flags", "segment", "points")


class Tangent(NamedTuple):
    """Compressed rows of a matrix, for some of its rows: PETSc's setValuesIJV(begin, columns, values, addv=True, rowmap=rows)."""
    rows: np.ndarray
    """[n] equations among all processes, each once"""
    begin: np.ndarray
    """[n + 1]"""
    columns: np.ndarray
    """[begin[n]] equations among all processes"""
    values: np.ndarray
    """[begin[n]] [F/L]"""

    def triplets(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(rows, columns, values) of all entries, as MatSetPreallocationCOO and MatSetValuesCOO take them."""
        return np.repeat(self.rows, np.diff(self.begin)), self.columns, self.values


class DistributedContact:
    """ents.Contact(..., comm=comm): each process gives the parts of the surfaces that it owns.

        contact = ents.Contact(model, x, slave, master, dofs=dofs, numbers=numbers, owners=owners, comm=comm)
        (equations, forces), tangent = contact.update(u)        # on all processes: add them to those of the bodies
        contact.commit()

    The constructor, update, augment and search are collective. If one process fails, all raise: the error names the process.

    A slave point belongs to the owner of its node; with points inside the facets to the process that gives the facet. After update(), for the slave
    points of this process: .gap, .pressure, .traction, .flags, .points, .state as of ents.Contact; .segment (a number of the master facet among all
    processes; -1: open). Always: .nodes [points] (places in `positions`; None with points inside the facets), .areas, .reach, .margin, .sizes (what
    this process holds and has sent). .pattern_changed: the last tangent has other places than the one before, on some process.
    """

    def __init__(self, model: Union[Model, dict, str, os.PathLike], positions: Any, slave: Any, master: Any, *, comm: Any, numbers: Any, owners: Any,
                 dofs: Any = None, reach: Optional[float] = None, margin: Optional[float] = None, thickness: float = 1.0, sampling: Optional[int] = None,
                 surface_coordinates: Any = None, offset: Optional[float] = None, ends: int = ENDS_STRAIGHT, leave: bool = False, order: str = "ring") -> None:
        """What is not listed here is as in help(ents.Contact.__init__). The model may be "master": "rigid"; the master's nodes are among `positions`.

        positions  [nodes][d] undeformed positions of nodes that this process knows: at least those of its facets, and every node of the surfaces
                   that it owns. A whole local mesh with its ghosts is fine
        slave, master  [facets][k] places in `positions`; each facet is given by one process. None: []. A triangle among quadrilaterals
                   names its last node twice
        numbers    [nodes] number of each node among all processes. Facets are put in the order of these numbers: where they do not depend on the
                   number of processes, results agree to rounding
        owners     [nodes] the process that owns each node. Displacements are taken from there
        dofs       [nodes][d] equation of each displacement among all processes, -1: none; default: d * number + component. Equations come back in
                   the same type of integer (PETSc.IntType, say)
        margin     [L] ghosts are taken within reach + margin, and searched again when the surfaces may have moved towards each other by that. Default:
                   reach. Give the same on all processes
        offset     a number

        Not here: master_positions (give the nodes among `positions`, with dofs of -1), rows, elements (points belong to the owners of nodes), mirror.
        """
        self._exchange = exchange = Exchange(comm)
        guard, width = Guard(), [0, 0]
        with guard:
            self.model = model = (model if isinstance(model, Model) else Model(model)).with_border(BORDER)
            _refuse_models(model)
            if model.layout.heat:
                raise Error(Status.BAD_VALUE, 'model: "heat": distributed surfaces have no temperatures yet; leave out comm, or "heat"')
            if model.segment == "catmull_rom16":
                raise Error(Status.BAD_VALUE, 'model: "segment": "catmull_rom16" takes regular meshes alone, and the ghosts of a process have ragged borders: write '
                            '"bspline16"')
            if order not in ("ring", "tensor"):
                raise Error(Status.BAD_VALUE, f'order: {order!r}; there are "ring" and "tensor"')
            self._given = given = _given(model.layout.dimension, positions, dofs, numbers, owners, exchange)
            self._index = np.asarray(dofs).dtype if np.asarray(dofs).dtype.kind == "i" else np.dtype(np.int64)
            parts = [_places(name, facets, len(given.positions)) for name, facets in (("slave", slave), ("master", master))]
            width = [part.shape[1] for part in parts]
        width = exchange.agree(guard.failure, width).astype(int)
        firsts = np.cumsum(exchange.gather([len(part) for part in parts]), axis=0).astype(np.int64)
        with guard:
            coordinates = None if isinstance(surface_coordinates, str) else surface_coordinates
            sides = [_facets(name, parts[k], width[k], int(firsts[exchange.rank, k]) - len(parts[k]), given, order, coordinates if k else None)
                     for k, name in enumerate(("slave", "master"))]
            offset = None if offset is None else float(offset)
        exchange.agree(guard.failure)
        same = zlib.crc32(repr((model._text, surface_coordinates if isinstance(surface_coordinates, str) else None, thickness, sampling, offset, ends, leave)).encode())
        low, high = -exchange.largest([-same]), exchange.largest([same])
        if low[0] != high[0]:
            raise Error(Status.BAD_VALUE, "model, surface_coordinates, thickness, sampling, offset, ends and leave: they differ between processes, give the same on all")
        self._own = ProcessSurfaces(exchange, model, given, *sides, thickness, sampling, ends)
        self._options = {"surface_coordinates": surface_coordinates if isinstance(surface_coordinates, str) else None, "thickness": thickness,
                         "sampling": sampling, "ends": ends, "leave": leave, "offset": offset}
        self.reach = self._own.longest_edge if reach is None else float(reach)
        self.margin = self.reach if margin is None else float(margin)
        with guard:
            for name, value in (("reach", self.reach), ("margin", self.margin)):
                if not 0 < value < 1e100:
                    raise Error(Status.BAD_VALUE, f"{name} is {value!r}: give a length above 0")
        low, high = -exchange.agree(guard.failure, [-self.reach, -self.margin]), exchange.largest([self.reach, self.margin])
        with guard:
            if (low != high).any():
                raise Error(Status.BAD_VALUE, f"reach and margin: from {low.tolist()} to {high.tolist()}: give the same on all processes")
        exchange.agree(guard.failure)
        self._u = self._u_begin = np.zeros(given.positions.shape)
        self._halo, self._table, self._local = self._own.halo, self._own.kind(), None  # type: Halo, Facets, Optional[LocalContact]
        self._history = History.new(model, len(self._own.mine))
        self._searched: Optional[np.ndarray] = None  # displacements of the nodes of this process's surfaces at the last search
        self._begun = self._pending = self._judged = self.pattern_changed = False
        self._state, self._pattern, self.searches = self._history.state, None, 0
        self._results = self._open_results()

    # What an update is made of.
    def update(self, u: Any, tangent: bool = True) -> tuple[tuple[np.ndarray, np.ndarray], Optional[Tangent]]:
        """Search and assemble at the displacements u [nodes][d] (or flat), of the given nodes; those of nodes of other processes are not read. Returns
        the residual, (equations, forces), and the Tangent (None with tangent=False): parts of sums, which this process adds to equations of all
        processes. CutStep, on all processes: take a smaller step from the last commit(). Error: a mistake."""
        if not self._begun:
            self._begin()
        guard = Guard()
        with guard:
            self._u = self._displacements(u)
        self._halo.update(self._u)
        moved = (np.inf, np.inf) if self._searched is None else self._own.moved(self._searched, self._own_nodes(self._halo.u))
        slave, master = self._agree(guard, moved)
        if slave + 2 * master > self.margin:  # 2: facets that turn move their heights, and some bases leave the hull of their nodes
            self._search()
        self._judge()
        result = None
        with guard:
            result = self._evaluate(tangent)
        changed = result is not None and tangent and result[2] is not self._pattern
        self.pattern_changed = bool(self._agree(guard, [changed])[0])
        (residual, matrix, self._pattern), self._pending = result if tangent else (*result[:2], self._pattern), True
        return residual, matrix

    def _agree(self, guard: Guard, values: Any = ()) -> np.ndarray:
        try:
            return self._exchange.agree(guard.failure, values)
        except Error:
            self._pending = False
            raise

    def _begin(self) -> None:
        """The first increment begins in the undeformed configuration."""
        self._u = np.zeros(self._given.positions.shape)
        self._history = History.new(self.model, len(self._own.mine))
        self._halo.update(self._u)
        self._local = None
        self._search()
        self._judge()
        guard = Guard()
        with guard:
            if self._local is not None:
                self._local.begin_at_rest()
            else:
                self._history = self._history._replace(points_begin=self._own.points(self._own_nodes(self._halo.positions)))
        self._agree(guard)
        self._begun = True

    def _displacements(self, u: Any) -> np.ndarray:
        given = _array("u", u, (None,) * np.ndim(u))
        if given.size != self._u.size:
            raise Error(Status.BAD_COUNT, f"u: the shape is {given.shape}, wanted is {self._u.shape}: the displacements of the given nodes")
        given = given.reshape(self._u.shape)
        needed = self._halo.needed()
        if not np.isfinite(given[needed]).all():
            node = int(needed[np.argwhere(~np.isfinite(given[needed]))[0][0]])
            raise CutStep(Status.NON_FINITE, f"u[{node}] is {given[node].tolist()}: a singular matrix, or a step that was much too large?", node)
        return given

    def _own_nodes(self, array: np.ndarray) -> np.ndarray:
        """Of an array of all nodes of the halo: those of this process's own surfaces."""
        return array[self._halo.find(self._own.numbers)]

    def search(self) -> None:
        """Search for ghosts anew in the next update: after Model.bind, if heights have grown."""
        self._searched = None

    def _search(self) -> None:
        guard, own, halo = Guard(), self._own, self._halo
        if self._local is not None:
            self._history = self._local.history()
        begin, now = (self._own_nodes(halo.positions + u) for u in (halo.begin, halo.u))
        near = own.near(guard, begin, now, self.reach + self.margin)
        used = np.isin(self._table.ids, self._history.segments())
        before = self._table.take(self._table.touching(used, own.layers))
        before.values[:, -1] = np.isin(before.ids, self._table.ids[used])
        table = merged(own.kind(), [near, before])
        numbers, owners = (np.concatenate([own_part, getattr(table, name).ravel()]) for name, own_part in (("nodes", own.numbers), ("owners", own.owners)))
        self._halo = halo = Halo(self._exchange, guard, self._given, numbers, owners, self._u_begin, self._u)
        self._local, self._pending = None, False
        with guard:
            if (table.values[:, -1] > 0).any() and own.mine.any():
                self._local = LocalContact(self.model, halo, own.star, table, own.mine, self.reach, **self._options)
                self._local.take(self._history, halo)
                self._local._pairs.judged = self._judged
        self._agree(guard)
        self._table, self._searched, self.searches = table, self._own_nodes(halo.u), self.searches + 1

    def _judge(self) -> None:
        """Until slave points have found a segment: do both sides look at each other?"""
        if self._judged:
            return
        guard, facing = Guard(), (False, False)
        with guard:
            if self._local is not None:
                facing = self._local.facing(self._halo.u)
        found, looks = self._agree(guard, facing) > 0
        if found and not looks:
            guard.failure = Error(Status.BAD_VALUE, SAME_WAY)
            self._agree(guard)
        self._judged = bool(found)
        if self._local is not None:
            self._local._pairs.judged = self._judged

    def _evaluate(self, tangent: bool) -> tuple:
        """Residual, tangent, and what tells its pattern from others."""
        local, index = self._local, self._index
        if local is None:
            none = np.zeros(0, index)
            self._results, self._state = self._open_results(), self.model.state_opened(self._history.state)
            return (none, np.zeros(0)), Tangent(none, np.zeros(1, index), none, np.zeros(0)) if tangent else None, None
        residual, _ = local.update(self._halo.u, tangent)
        self._results, self._state = {name: local.of(name) for name in RESULTS}, local.state
        kept = np.flatnonzero(residual)
        forces = local.equations[kept].astype(index), residual[kept]
        if not tangent:
            return forces, None, None
        *places, values = local.entries()
        return forces, Tangent(*(array.astype(index) for array in places), values), local.pattern()

    def _open_results(self) -> dict[str, np.ndarray]:
        """Where no master facet is near."""
        n, d, halo = int(self._own.mine.sum()), self.model.layout.dimension, self._halo
        return {"gap": np.full(n, np.nan), "pressure": np.zeros(n), "traction": np.zeros((n, d)), "flags": np.zeros(n, np.int32), "segment": np.full(n, -1, np.int64),
                "points": self._own.points(self._own_nodes(halo.positions + halo.u))[self._own.mine]}

    def commit(self) -> None:
        """The last update() is the end of the increment, and the begin of the next one. No messages."""
        if not self._pending:
            raise Error(Status.BAD_STATE, "commit: update(u) comes first")
        self._u_begin, self._halo.begin = self._u.copy(), self._halo.u.copy()
        if self._local is not None:
            self._local.commit()
        else:
            self._history = self._history.opened(self.model, self._own.points(self._own_nodes(self._halo.positions + self._halo.u)))

    def augment(self) -> None:
        """Uzawa's step, see ents.Contact.augment. Collective."""
        guard = Guard()
        with guard:
            if not self._pending:
                raise Error(Status.BAD_STATE, "augment: update(u) comes first")
            if not self.model.layout.augmentable:
                raise Error(Status.BAD_VALUE, 'augment: the model\'s normal law is not "augmented"')
            if self._local is not None:
                self._local.augment()
        self._agree(guard)

    def save(self, file: Union[str, os.PathLike], **more: Any) -> None:
        """Write this process's part of the history at the last commit() to a file (NumPy's .npz) of its own, and what else is given. No messages."""
        history = self._history if self._local is None else self._local.history()
        with open(file, "wb") as stream:
            np.savez(stream, numbers=self._own.numbers, u_begin=self._u_begin, judged=self._judged, facets=self._table.packed(),
                     **{name: array for name, array in history._asdict().items() if array is not None}, **more)

    def load(self, file: Union[str, os.PathLike]) -> None:
        """Take the history of `save` of the same process, of as many processes. Collective."""
        guard = Guard()
        with guard, np.load(file, allow_pickle=False) as saved:
            if not np.array_equal(saved["numbers"], self._own.numbers) or saved["u_begin"].shape != self._u.shape:
                raise Error(Status.BAD_STATE, f"load: {os.fspath(file)} was saved by a process with other parts of the surfaces")
            self._history = History(*(saved[name] if name in saved else None for name in History._fields))
            self._u = self._u_begin = saved["u_begin"]
            self._table, self._judged = self._own.kind().unpacked(saved["facets"]), bool(saved["judged"])
        self._agree(guard)
        self._halo = self._own.halo
        self._halo.update(self._u)
        self._halo.begin = self._halo.u.copy()
        self._local, self._searched, self._begun, self._pending = None, None, self._history.points_begin is not None, False

    gap, pressure, traction, flags, segment, points = (property(lambda self, name=name: self._results[name]) for name in RESULTS)
    state = property(lambda self: self._state[self._own.mine], doc="[points][state_size] of the end of the last update(); the last entry counts segments of this process")

    @property
    def areas(self) -> np.ndarray:
        """[points] [A] tributary areas of the undeformed surface."""
        return np.zeros(0) if self._own.slave is None else self._own.slave.areas[self._own.mine]

    @property
    def nodes(self) -> Optional[np.ndarray]:
        """[points] places in `positions` of the nodes that the slave points are; None with points inside the facets."""
        slave = self._own.slave
        if slave is None:
            return np.zeros(0, np.int64)
        return None if slave.nodes is None else self._given.find(self._own.numbers[slave.nodes[self._own.mine]])

    @property
    def sizes(self) -> dict[str, int]:
        """What this process holds: slave_points, master_facets, ghost_facets (of other processes), ghost_nodes; bytes of both parts (positions, displacements
        at the begin and now, equations, numbers and owners of nodes; nodes of facets); neighbours; searches, messages and bytes that it has sent."""
        own, table, halo, each = self._own, self._table, self._halo, 8 * (4 * self.model.layout.dimension + 2)
        foreign = ~np.isin(table.ids, own.own.ids)
        return {"slave_points": int(own.mine.sum()), "master_facets": len(own.own.ids), "ghost_facets": int(foreign.sum()), "ghost_nodes": halo.ghosts,
                "bytes_own": each * (len(halo.numbers) - halo.ghosts) + own.star.packed().nbytes + own.own.packed().nbytes,
                "bytes_ghosts": each * halo.ghosts + table.take(foreign).packed().nbytes, "neighbours": own.neighbours, "searches": self.searches,
                "messages": self._exchange.messages, "bytes_sent": self._exchange.bytes}

    def __repr__(self) -> str:
        return (f"<ents.DistributedContact: process {self._exchange.rank} of {self._exchange.size}, {int(self._own.mine.sum())} slave points, "
                f"{int((self.pressure > 0).sum())} in contact>")


def _places(name: str, facets: Any, nodes: int) -> np.ndarray:
    """[facets][k] places of nodes; [0][0] without facets."""
    if len(facets) == 0:
        return np.zeros((0, 0), np.int64)
    places = _array(name, facets, (None, None), np.int64)
    if not 0 <= places.min() <= places.max() < nodes:
        raise Error(Status.BAD_VALUE, f"{name}: node {places.max() if places.max() >= nodes else places.min()} does not exist; there are {nodes}, from 0")
    return places


def _given(d: int, positions: Any, dofs: Any, numbers: Any, owners: Any, exchange: Exchange) -> Given:
    x = _array("positions", positions, (None, d)).copy()
    if not np.isfinite(x).all():
        raise Error(Status.NON_FINITE, f"positions{np.argwhere(~np.isfinite(x))[0].tolist()} is not finite")
    if numbers is None or owners is None:
        raise Error(Status.NULL_ARGUMENT, f"numbers: give the number of each node among all processes. {NO_OWNERS}" if numbers is None else NO_OWNERS)
    n = _array("numbers", numbers, (len(x),), np.int64).copy()
    who = _array("owners", owners, (len(x),), np.int64).copy()
    if len(x) and not 0 <= who.min() <= who.max() < exchange.size:
        raise Error(Status.BAD_VALUE, f"owners: from {who.min()} to {who.max()}; processes are 0 .. {exchange.size - 1}")
    equations = d * n[:, None] + np.arange(d) if dofs is None else _array("dofs", dofs, (len(x), d), np.int64).copy()
    own = np.flatnonzero(who == exchange.rank)
    place = own[np.argsort(n[own], kind="stable")]
    twice = np.flatnonzero(np.diff(n[place]) == 0)
    if len(twice):
        raise Error(Status.BAD_VALUE, f"numbers: {n[place][twice[0]]} is there twice among the own nodes of this process")
    return Given(x, equations, n, who, place)


def _facets(name: str, places: np.ndarray, width: int, first: int, given: Given, order: str, coordinates: Any) -> Facets:
    d = given.positions.shape[1]
    if width == 0:
        raise Error(Status.BAD_COUNT, f"{name}: there are no facets on any process")
    if len(places) and places.shape[1] != width:
        raise Error(Status.BAD_COUNT, f"{name}: facets of {places.shape[1]} nodes here, of {width} on another process: give rows of one length; a triangle among "
                    "quadrilaterals names its last node twice")
    if (d, width) not in FACETS:
        raise Error(Status.BAD_COUNT, f"{name}: facets of {width} nodes in {d}D; there are {', '.join(FACETS[key] for key in FACETS if key[0] == d)}")
    values = np.zeros((len(places), 0))
    if coordinates is not None:
        values = _array("surface_coordinates", coordinates, (len(places), width, d - 1))
    places = places.reshape(-1, width)
    if order == "tensor" and width == 4:
        places = places[:, [0, 1, 3, 2]]
        values = values[:, [0, 1, 3, 2]] if coordinates is not None else values
    values = values.reshape(len(places), (d - 1) * width if coordinates is not None else 0)
    return Facets(first + np.arange(len(places)), given.numbers[places], given.owners[places], values)
