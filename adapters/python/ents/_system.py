# SPDX-License-Identifier: BSD-3-Clause
"""The equations of a host."""
from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any, Optional

import numpy as np

from . import _structs
from ._arrays import Error, _array, _combination, _count, _new
from ._structs import Status

if TYPE_CHECKING:
    from ._pose import Pose


class System:
    """The equations of a host, which Model.assemble adds to.

    slave_equations  [nodes][node_dofs] row of each dof, -1: prescribed, left out; master_equations the same of the master's nodes (None: a rigid master)
    matrix           compressed rows with sorted columns that has a place for every entry: scipy.sparse.csr_matrix, or what has its indptr,
                     indices and data; None: no tangent is wanted
    rows             number of rows, if there is no matrix
    slave, master    combinations (begin, nodes, weights) if slave points or master nodes are not the host's nodes: sampling_points, smooth. Of a slave
                     surface that is enriched, too, what Library.raise_points returns; .slave_positions [nodes][d], current, has to be set then
    multiplier_equations [n][multipliers]
    pose, body_equations ents.Pose of a rigid master that moves, and the rows [2D: 3, 3D: 6] of its displacement and spin, -1: prescribed. The
                     slave points that are given to assemble are then pose.to_body(positions)

    .residual [rows] and .matrix.data are added to: set them to zero before each assembly. Where the entries of each element lie is remembered: assign
    another matrix, other indptr and indices or other equations, instead of writing into those that are there (equations are copied and
    cannot be written to).
    """

    def __init__(self, slave_equations: Any, master_equations: Any, matrix: Any = None, rows: Optional[int] = None, slave: Any = None, master: Any = None,
                 multiplier_equations: Any = None, pose: Optional[Pose] = None, body_equations: Any = None) -> None:
        self.pose, self._body_rows = pose, None if body_equations is None else _array("body_equations", body_equations, (None,), np.int64)
        self.slave_equations, self.master_equations, self.multiplier_equations = slave_equations, master_equations, multiplier_equations
        self.matrix = matrix
        if matrix is None and rows is None:
            raise Error(Status.NULL_ARGUMENT, "rows: say how many there are, or give a matrix")
        self.residual = np.zeros(len(matrix.indptr) - 1 if matrix is not None else _count("rows", rows))
        self._combinations = [None if points is None else _combination(points) for points in (slave, master)]
        self._places, self._places_of = None, ()
        self.slave_positions: Any = None

    def __repr__(self) -> str:
        entries = "no matrix" if self.matrix is None else f"a matrix of {len(self.matrix.data)} entries"
        return f"<ents.System: {len(self.residual)} rows, {entries}>"

    def __setattr__(self, name: str, value: Any) -> None:
        if name.endswith("_equations") and value is not None:
            value = _array(name, value, (None, None), np.int64).copy()
            value.setflags(write=False)
        super().__setattr__(name, value)

    def _struct(self, model, tree, elements):
        lay = model.layout
        slave, master = (None if points is None else ctypes.addressof(points) for points in self._combinations)
        out = _new(_structs.System, slave=slave, master=master, slave_nodes=len(self.slave_equations), slave_equations=self.slave_equations.ctypes.data,
                   rows=len(self.residual), residual=self.residual.ctypes.data, index_size=8)
        if self.slave_positions is not None:
            positions = _array("slave_positions", self.slave_positions, (len(self.slave_equations), lay.dimension))
            out.slave_positions, out.of_positions = positions.ctypes.data, positions  # lives as long as the struct
        if slave is None and len(self.slave_equations) < elements:
            raise Error(Status.BAD_COUNT, f"slave_equations: {len(self.slave_equations)} nodes; there are {elements} slave points")
        if self.slave_equations.shape[1] != lay.node_dofs:
            raise Error(Status.BAD_COUNT, f"slave_equations: wanted are {lay.node_dofs} of each node")
        if self.master_equations is not None:
            if self.master_equations.shape[1] != lay.node_dofs:
                raise Error(Status.BAD_COUNT, f"master_equations: wanted are {lay.node_dofs} of each node")
            out.master_nodes, out.master_equations = len(self.master_equations), self.master_equations.ctypes.data
        if lay.multipliers and self.multiplier_equations is not None:
            _array("multiplier_equations", self.multiplier_equations, (elements, lay.multipliers), np.int64)
            out.multiplier_equations = self.multiplier_equations.ctypes.data
        if not (isinstance(self.residual, np.ndarray) and self.residual.dtype == np.float64 and self.residual.flags.c_contiguous
                and self.residual.flags.writeable and self.residual.ndim == 1):
            raise Error(Status.BAD_VALUE, "residual: wanted is a contiguous array of float64 [rows]")
        if self.pose is not None:
            if self.pose.dimension != lay.dimension:
                raise Error(Status.BAD_VALUE, f"pose: it is one in {self.pose.dimension}D, the model is in {lay.dimension}D")
            wanted = 3 if self.pose.dimension == 2 else 6
            if self._body_rows is None or len(self._body_rows) != wanted:
                raise Error(Status.BAD_COUNT, f"body_equations: wanted are {wanted}, of the body's displacement and spin")
            out.pose, out.body_equations = self.pose._address(), self._body_rows.ctypes.data
        if self.matrix is None:
            return out
        begin, columns, values = self.matrix.indptr, self.matrix.indices, self.matrix.data
        if begin.dtype != columns.dtype or begin.dtype not in (np.int32, np.int64) or values.dtype != np.float64 or len(columns) != len(values) \
                or not values.flags.writeable:
            raise Error(Status.BAD_VALUE, "matrix: wanted are indptr and indices of one integer type and data of float64")
        if not all(array.flags.c_contiguous for array in (begin, columns, values)):
            raise Error(Status.BAD_VALUE, "matrix: indptr, indices and data must be contiguous")
        if len(begin) != len(self.residual) + 1 or begin[-1] > len(columns):
            raise Error(Status.BAD_COUNT, f"matrix: indptr and indices are not those of {len(self.residual)} rows, which the residual has")
        if slave is None and master is None:  # remembers where the entries of each element are
            size = lay.node_dofs * (lay.nodes + 1) ** 2 + 1
            of = begin, columns, tree, self.slave_equations, self.master_equations  # kept: another object is never at the same address
            if self._places is None or self._places.shape != (elements, size) or any(a is not b for a, b in zip(of, self._places_of)):
                self._places, self._places_of = np.zeros((elements, size), np.int64), of
            out.places, out.places_size = self._places.ctypes.data, size
        out.index_size, out.row_begin, out.columns, out.values = begin.itemsize, begin.ctypes.data, columns.ctypes.data, values.ctypes.data
        return out
