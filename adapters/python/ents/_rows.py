# SPDX-License-Identifier: BSD-3-Clause
"""Residual and tangent of many slave points in the program's equations: rows that are kept from one iteration to the next, filled by the library."""
from __future__ import annotations

from types import SimpleNamespace
from typing import Any, Optional

import numpy as np

from ._arrays import Error
from ._model import Model
from ._structs import Flag, Status
from ._surface import Tree
from ._system import System


class Rows:
    """Compressed rows with a place for every pair of a slave point and a segment that has been in contact. They grow when another pair closes.

    dofs    [nodes][node_dofs] equation of each displacement (and temperature), -1: none
    slave   csr_matrix [points][nodes]: slave points as combinations of nodes; `of_nodes` [points] where each is a node, else None; `parts`: the
            combination as System takes it
    master  csr_matrix [nodes of segments][nodes], or None: a rigid master; `smoothed`: its rows are no unit vectors
    beside  [segments][k] neighbours of each segment, -1: none; they get places, too, before a point slides there
    """

    def __init__(self, model: Model, tree: Tree, dofs: np.ndarray, rows: int, slave: Any, parts: Any, of_nodes: Optional[np.ndarray], master: Any, smoothed: bool,
                 beside: np.ndarray) -> None:
        self.model, self.tree, self.count = model, tree, rows
        self._dofs, self._slave, self._master, self._beside = dofs, slave, master, beside
        self._system = System(dofs if of_nodes is None else dofs[of_nodes], None if master is None else dofs, rows=rows, slave=parts if of_nodes is None else None,
                              master=(master.indptr, master.indices, master.data) if smoothed and master is not None else None)
        self._keys = np.zeros(0, np.int64)
        self._begin, self._columns = np.zeros(rows + 1, np.int32), np.zeros(0, np.int32)

    def place(self, positions: np.ndarray) -> None:
        """The current positions [nodes][d], for slave points above their facets."""
        images = np.zeros((len(self._dofs) - len(positions), positions.shape[1]))  # of nodes of the master
        self._system.slave_positions = np.vstack([positions, images])

    def add(self, wants_tangent: bool, **inputs: Any) -> tuple[dict[str, Any], np.ndarray, Optional[tuple]]:
        """Model.iterate with these inputs. Returns its result, the residual [rows], and the tangent (data, indices, indptr)."""
        if wants_tangent and len(self._keys):
            try:
                return self._iterate(True, **inputs)
            except Error as error:
                if error.status != Status.BAD_PATTERN:
                    raise
        found = self._iterate(False, **inputs)
        if not wants_tangent:
            return found
        result = found[0]
        adds = result["segment"] >= 0 if self.model.layout.heat else result["flags"] & Flag.CONTACT != 0  # open gaps conduct
        closed = np.flatnonzero(adds & (result["status"] == 0))
        if not len(closed) or result["status"].any():
            return (*found[:2], (np.zeros(len(self._columns)), self._columns, self._begin))
        self._grow(closed, result["segment"][closed])
        return self._iterate(True, **inputs)

    def _iterate(self, wants_tangent: bool, **inputs: Any) -> tuple[dict[str, Any], np.ndarray, Optional[tuple]]:
        system = self._system
        system.residual = np.zeros(self.count)
        system.matrix = SimpleNamespace(indptr=self._begin, indices=self._columns, data=np.zeros(len(self._columns))) if wants_tangent else None
        result = self.model.iterate(tree=self.tree, system=system, **inputs)
        return result, system.residual, (system.matrix.data, self._columns, self._begin) if wants_tangent else None

    def _grow(self, points: np.ndarray, segments: np.ndarray) -> None:
        """Places for these pairs, and for those of before while they are not much more."""
        import scipy.sparse as sparse
        around = np.column_stack([segments, self._beside[segments]])
        keys = (points[:, None] * len(self.tree.connectivity) + around)[around >= 0]
        kept = np.union1d(self._keys, keys)
        self._keys = keys = kept if len(kept) <= 3 * len(keys) + 64 else np.unique(keys)
        points, segments = np.divmod(keys, len(self.tree.connectivity))
        ones = lambda matrix: sparse.csr_matrix((np.ones(len(matrix.indices), np.float32), matrix.indices, matrix.indptr), matrix.shape)
        nodes = ones(self._slave[points])  # [pairs][nodes]: those that a pair couples
        if self._master is not None:
            of = self.tree.connectivity[segments]
            of = sparse.csr_matrix((np.ones(of.size, np.float32), of.ravel(), np.arange(len(of) + 1) * of.shape[1]), (len(of), self._master.shape[0]))
            nodes = nodes + of @ ones(self._master)
        coupled = (nodes.T @ nodes).tocsr()
        # Equations that each node is coupled with; then each equation has those of its node.
        columns = self._dofs[coupled.indices]
        known = columns >= 0
        counts = np.r_[0, np.cumsum(known.sum(axis=1))]
        of_node = sparse.csr_matrix((np.ones(counts[-1], np.int8), columns[known], counts[coupled.indptr]), (len(self._dofs), self.count))
        of_node.sum_duplicates()
        place = np.flatnonzero(self._dofs.ravel() >= 0)
        equation, node = self._dofs.ravel()[place], place // self._dofs.shape[1]
        if len(np.unique(equation)) == len(equation):
            none = len(self._dofs)
            own = np.full(self.count, none)
            own[equation] = node
            pattern = sparse.vstack([of_node, sparse.csr_matrix((1, self.count), dtype=np.int8)], "csr")[own]
        else:  # nodes that share an equation
            pattern = sparse.csr_matrix((np.ones(len(node), np.float32), (equation, node)), (self.count, len(self._dofs))) @ of_node.astype(np.float32)
        pattern.sort_indices()
        self._begin, self._columns = pattern.indptr, pattern.indices
