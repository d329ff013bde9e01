# SPDX-License-Identifier: BSD-3-Clause
"""The parts of a slave and a master surface that belong to one process, and the search for the master facets of others that it needs."""
from __future__ import annotations

from typing import Any

import numpy as np

from ._arrays import Error
from ._exchange import Exchange, Guard
from ._ghosts import Facets, Given, Halo, to_owners, widened
from ._model import Model
from ._sides import FACETS, INSIDE, reversed_pair
from ._structs import ENDS_REPEATED, ENDS_STRAIGHT, Status
from ._surface import Tree
from ._surfaces import SMOOTHED, MasterSurface, SlavePoints

MOST_BOXES = 64  # of the slave points of a process: the finer, the fewer ghosts
FEWEST_POINTS = 16  # in a box


def layers_around(model: Model, ends: int) -> int:
    """Facets that a segment depends on, in layers around its own one."""
    if model.segment not in SMOOTHED:
        return 0
    if ends not in (ENDS_STRAIGHT, ENDS_REPEATED):
        return 4  # three nodes for a control point; up to four nodes at an end
    return 1 if model.layout.dimension == 2 else 2


class ProcessSurfaces:
    """Slave points and master facets of this process. Slave points belong to the owner of their node, or, inside facets, to the process that
    gives the facet.

    star     slave facets around the slave points, those of other processes among them
    own      master facets of this process; region: with the layers around them that smoothing needs
    slave    SlavePoints over the nodes of `halo`; mine [points] bool: those that belong here
    """

    def __init__(self, exchange: Exchange, model: Model, given: Given, slave: Facets, master: Facets, thickness: float, sampling: Any, ends: int) -> None:
        self._exchange, self._model, guard = exchange, model, Guard()
        d = given.positions.shape[1]
        inside = sampling or sampling is None and FACETS.get((d, slave.nodes.shape[1])) in INSIDE
        self.star = slave if inside else to_owners(exchange, slave)
        self.own = self.region = master.joined([])
        self.layers = layers_around(model, ends)
        if self.layers:
            stars = to_owners(exchange, master)
            for _ in range(self.layers):
                self.region = widened(exchange, self.region, stars)
        self.numbers, first = np.unique(np.concatenate([self.star.nodes.ravel(), self.region.nodes.ravel()]), return_index=True)
        self.owners = np.concatenate([self.star.owners.ravel(), self.region.owners.ravel()])[first]
        zero = np.zeros(given.positions.shape)
        self.halo = halo = Halo(exchange, guard, given, self.numbers, self.owners, zero, zero)
        exchange.agree(guard.failure)
        self.neighbours = 0
        self.slave, self.tree, self.mine, self.longest_edge = None, None, np.zeros(0, bool), 0.0
        with guard:
            if len(self.star.ids):
                self._make_slave(halo, thickness, sampling)
            if len(self.own.ids):
                self._make_master(halo, ends)
        self.longest_edge = float(exchange.agree(guard.failure, [self.longest_edge])[0])

    def _make_slave(self, halo: Halo, thickness: float, sampling: Any) -> None:
        self.slave = points = SlavePoints(self._model, halo.positions, halo.find(self.star.nodes), sampling, thickness, "ring")
        pair = reversed_pair(points.groups)
        if pair is not None:
            raise Error(Status.BAD_VALUE, f"slave: the facets of nodes {self.star.nodes[pair[0]].tolist()} and {self.star.nodes[pair[1]].tolist()} are not oriented "
                        "alike: reverse the nodes of the one whose normal points into the body")
        self.mine = np.ones(len(points.areas), bool) if points.nodes is None else self.owners[points.nodes] == self._exchange.rank
        self.longest_edge = max(self.longest_edge, points.longest_edge)

    def _make_master(self, halo: Halo, ends: int) -> None:
        order = np.r_[np.flatnonzero(np.isin(self.region.ids, self.own.ids)), np.flatnonzero(~np.isin(self.region.ids, self.own.ids))]
        self._master = MasterSurface(self._model, halo.positions, halo.find(self.region.nodes[order]), ends, (), "ring", len(self.own.ids))
        self.tree = Tree(self._model, self._master.segments, self._master.start)
        self.longest_edge = max(self.longest_edge, self._master.longest_edge)

    def points(self, now: np.ndarray) -> np.ndarray:
        """[points][d] slave points at positions `now` [nodes of this halo][d]."""
        return np.zeros((0, now.shape[1])) if self.slave is None else self.slave.at(now)

    def moved(self, before: np.ndarray, now: np.ndarray) -> tuple[float, float]:
        """Largest displacement of a node of the slave, and of the master, between two states of this halo's nodes."""
        far = np.linalg.norm(now - before, axis=1)
        of = lambda facets: float(far[np.searchsorted(self.numbers, facets.nodes)].max(initial=0.0))
        return of(self.star), of(self.region)

    def near(self, guard: Guard, begin: np.ndarray, now: np.ndarray, distance: float) -> Facets:
        """Master facets, of this and of other processes, that slave points of this process may touch: boxes around the enriched facets and around
        the slave points, each from its place at the begin of the increment to the present one, are nearer to each other than `distance`. The last
        column of values is 1 for these, 0 for the layers around them. A process tells all others one box of each of its surfaces; the rest goes
        from neighbour to neighbour."""
        d, exchange = now.shape[1], self._exchange
        slave, master = np.zeros((0, 2 * d)), np.zeros((0, 2 * d))
        with guard:
            slave = _grouped(_hull([np.tile(self.points(x)[self.mine], 2) for x in (begin, now)]))
            if self.tree is not None:
                master = _hull([self._boxes(x) for x in (begin, now)])
        every = exchange.gather(np.concatenate([_around(slave, d), _around(master, d)])).reshape(-1, 2, 2 * d)
        masters = np.flatnonzero(_close(every[:, 1], every[exchange.rank, 0], distance)).tolist()
        slaves = np.flatnonzero(_close(every[:, 0], every[exchange.rank, 1], distance)).tolist()
        asked = exchange.swap({to: slave for to in masters}, slaves)
        kind = self.kind()
        answers = {to: kind.packed() for to in slaves}
        with guard:
            for to, boxes in asked.items():
                answers[to] = self._chosen(master, boxes.reshape(-1, 2 * d), distance).packed()
        received = exchange.swap(answers, masters)
        self.neighbours = len(set(masters) | set(slaves) - {exchange.rank})
        return merged(kind, [kind.unpacked(array) for array in received.values()])

    def kind(self) -> Facets:
        """No facets, of the kind that messages have."""
        none = self.own.take(slice(0, 0))
        return none._replace(values=np.zeros((0, none.values.shape[1] + 1)))

    def _boxes(self, now: np.ndarray) -> np.ndarray:
        self.tree.move(self._master.at(now))
        return self.tree.boxes()

    def _chosen(self, boxes: np.ndarray, slave: np.ndarray, distance: float) -> Facets:
        """Own facets with these boxes that are near those of a slave, and the layers around them."""
        near = np.zeros(len(boxes), bool)
        for box in slave:
            near |= _close(boxes, box, distance)
        region = np.isin(self.region.ids, self.own.ids[near])
        kept = self.region.touching(region, self.layers)
        return self.region.take(kept)._replace(values=np.column_stack([self.region.values[kept], region[kept]]))


def merged(kind: Facets, parts: list[Facets]) -> Facets:
    """Each facet once. It is one that may be touched if one of the parts says so."""
    every = Facets(*(np.concatenate(arrays) for arrays in zip(kind, *parts)))
    every = every.take(np.argsort(-every.values[:, -1], kind="stable"))
    return kind.joined([every])


def _hull(boxes: list[np.ndarray]) -> np.ndarray:
    """[n][2 d] around each of the n boxes of several lists."""
    d = boxes[0].shape[1] // 2
    stack = np.stack(boxes)
    return np.hstack([stack[:, :, :d].min(axis=0), stack[:, :, d:].max(axis=0)])


def _around(boxes: np.ndarray, d: int) -> np.ndarray:
    """[2 d] around all; without any: a box that is close to nothing."""
    return np.r_[boxes[:, :d].min(axis=0, initial=np.inf), boxes[:, d:].max(axis=0, initial=-np.inf)]


def _close(boxes: np.ndarray, box: np.ndarray, distance: float) -> np.ndarray:
    """[n] bool: which boxes are nearer than `distance` to `box`, by every axis?"""
    d = len(box) // 2
    return (np.maximum(boxes[:, :d] - box[d:], box[:d] - boxes[:, d:]) <= distance).all(axis=1)  # the same bits for both processes


def _grouped(boxes: np.ndarray) -> np.ndarray:
    """Boxes around groups of neighbours: halves of halves, by the widest direction."""
    d, groups = boxes.shape[1] // 2, [np.arange(len(boxes))]
    centre = boxes[:, :d] + boxes[:, d:]
    while len(groups) < MOST_BOXES and max(map(len, groups)) > FEWEST_POINTS:
        halves = []
        for group in groups:
            axis = int(np.ptp(centre[group], axis=0).argmax())
            order = group[np.argpartition(centre[group, axis], len(group) // 2)]
            halves += [order[:len(order) // 2], order[len(order) // 2:]]
        groups = halves
    return np.array([_around(boxes[group], d) for group in groups if len(group)]).reshape(-1, 2 * d)
