# SPDX-License-Identifier: BSD-3-Clause
"""The contact of the slave points of one process with the master facets that it has, own ones and ghosts; and the history that outlives these."""
from __future__ import annotations

import warnings
from typing import Any, NamedTuple, Optional

import numpy as np

from ._arrays import Error
from ._ghosts import Facets, Halo
from ._model import Model
from ._structs import Status
from .contact import LOST, Contact


class History(NamedTuple):
    """What the next update depends on, of the slave points of a process. Segments are named by their numbers among all processes, -1: none."""
    state: np.ndarray
    """[n][state_size] at the begin of the increment; the last entry is 1 + the segment"""
    segment: np.ndarray
    """[n] at the begin of the increment"""
    hint: np.ndarray
    xi: np.ndarray
    """[n][d-1] on `hint`: where the next search begins"""
    committed_hint: np.ndarray
    committed_xi: np.ndarray
    """the same at the begin of the increment"""
    points_begin: Optional[np.ndarray]
    """[n][d] slave points there; None before the first update"""

    @staticmethod
    def new(model: Model, count: int) -> History:
        none, xi = np.full(count, -1, np.int64), np.zeros((count, model.layout.dimension - 1))
        return History(model.state_init(count), none, none, xi, none, xi, None)

    def renamed(self, name: Any) -> History:
        """name: function of an array of segments."""
        state = self.state.copy()
        state[:, -1] = 1 + name(state[:, -1].astype(np.int64) - 1)
        return self._replace(state=state, segment=name(self.segment), hint=name(self.hint), committed_hint=name(self.committed_hint))

    def opened(self, model: Model, points: np.ndarray) -> History:
        """At the end of an increment in which nothing was near these points."""
        return History.new(model, len(points))._replace(state=model.state_opened(self.state), points_begin=points)

    def segments(self) -> np.ndarray:
        """All that are named."""
        every = np.unique(np.concatenate([self.segment, self.hint, self.committed_hint, self.state[:, -1].astype(np.int64) - 1]))
        return every[every >= 0]


class LocalContact(Contact):
    """An ents.Contact over the nodes of a halo.

    star    slave facets; mine [points] bool: the slave points that belong to this process
    table   master facets; the last column of its values: 1 for segments, 0 for facets that only smooth others
    .ids    [segments] their numbers among all processes; .equations [rows] those of the rows
    """

    def __init__(self, model: Model, halo: Halo, star: Facets, table: Facets, mine: np.ndarray, reach: float, surface_coordinates: Any, **options: Any) -> None:
        segment = table.values[:, -1] > 0
        self._kept = int(segment.sum())
        table = table.take(np.r_[np.flatnonzero(segment), np.flatnonzero(~segment)])
        self.ids = table.ids[:self._kept]
        self._by_id = np.argsort(self.ids)
        self.equations, dofs = np.unique(halo.dofs, return_inverse=True)
        if len(self.equations) and self.equations[0] < 0:
            self.equations, dofs = self.equations[1:], dofs - 1
        if table.values.shape[1] > 1:
            surface_coordinates = table.values[:self._kept, :-1].reshape(self._kept, table.nodes.shape[1], -1)
        with warnings.catch_warnings():  # given once, for the surfaces of the process
            warnings.simplefilter("ignore")
            super().__init__(model, halo.positions, halo.find(star.nodes), halo.find(table.nodes), dofs=dofs.reshape(halo.dofs.shape), rows=len(self.equations),
                             reach=reach, elements=mine, surface_coordinates=surface_coordinates, **options)
        self._pairs.judged = False

    tangent = property(lambda self: None, doc="see entries()")
    _takes_one_surface = False

    def _judge(self, points: np.ndarray) -> None:
        """All processes do this together: facing()."""

    def facing(self, u: np.ndarray) -> tuple[bool, bool]:
        """Do slave points of this process find a segment at these displacements; does one of them look at it?"""
        self._pairs.now = now = self._moved(u)
        self._move_tree(now)
        segment = np.where(self._elements, self.tree.detect(self._slave.at(now), self.reach, permitted=LOST)["segment"], -1)
        found = np.flatnonzero(segment >= 0)
        return len(found) > 0, bool((self._pairs._cosines(found, self.tree.positions, segment[found]) <= 0.1).any())

    def begin_at_rest(self) -> None:
        """The first increment begins in the undeformed configuration: a point that touches there has its friction from there on."""
        self._begin()

    def history(self) -> History:
        """With the numbers that segments have among all processes."""
        inner = History(self._state_begin, self._segment_begin, self._hint, self._xi, *self._committed, self._points_begin)
        return inner.renamed(lambda segment: np.where(segment >= 0, self.ids[segment], -1))

    def take(self, history: History, halo: Halo) -> None:
        """The history of another LocalContact of the same slave points."""
        known = self.ids[self._by_id]

        def place(number: np.ndarray) -> np.ndarray:
            at = self._by_id[np.minimum(np.searchsorted(known, number), len(known) - 1)]
            if (self.ids[at] != number)[number >= 0].any():
                raise Error(Status.INTERNAL, "a master facet with the history of a slave point is not among the ghosts of this process")
            return np.where(number >= 0, at, -1)
        mine = history.renamed(place)
        self._state_begin = self._state = mine.state
        self._segment_begin, self._points_begin = mine.segment, mine.points_begin
        self._committed, self._hint, self._xi = (mine.committed_hint, mine.committed_xi), mine.hint, mine.xi
        self._tree_begin = self._master.at(halo.positions + halo.begin)

    def of(self, name: str) -> np.ndarray:
        """A result of the slave points that belong to this process."""
        array = self._results[name][self._elements_given]
        return np.where(array >= 0, self.ids[array], -1) if name == "segment" else array

    @property
    def _elements_given(self) -> np.ndarray:
        return self._arguments["elements"]

    def pattern(self) -> np.ndarray:
        """The array of columns of the last tangent: another array where its places are others."""
        return self._matrix[1] if isinstance(self._matrix, tuple) else self._matrix.indices

    def entries(self) -> tuple:
        """The last tangent, (rows, begin, columns, values), in equations among all processes."""
        matrix = self._matrix
        data, columns, begin = matrix if isinstance(matrix, tuple) else (matrix.data, matrix.indices, matrix.indptr)
        kept = np.flatnonzero(np.diff(begin))
        return self.equations[kept], np.r_[begin[kept], begin[-1:]].astype(np.int64), self.equations[columns], data
