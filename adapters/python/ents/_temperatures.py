# SPDX-License-Identifier: BSD-3-Clause
"""The temperatures of a contact whose model has "heat"."""
from __future__ import annotations

from typing import Any, Callable, Optional

import numpy as np

from ._arrays import Error, _array
from ._model import Model
from ._structs import Status
from ._surface import Tree
from ._surfaces import MasterSurface, SlavePoints


class Temperatures:
    """Temperatures of the program's nodes, and of a master that is no part of the mesh. Without "heat" there are none.

    start, of_master   a number or one for each node: those at u = 0
    """

    def __init__(self, model: Model, nodes: int, start: Any, master_nodes: Optional[int], of_master: Any) -> None:
        self.on = bool(model.layout.heat)
        self._rubs = self.on and bool(model.layout.friction)
        for name, value in (("temperature", start), ("master_temperature", of_master)):
            if value is not None and not self.on:
                raise Error(Status.BAD_VALUE, f'{name} is given, but the model has no "heat" in its "contact"')
        if of_master is not None and master_nodes is None:
            raise Error(Status.BAD_VALUE, "master_temperature: this master is a part of the mesh, its temperatures are those of its nodes")
        self._start = self._of_nodes("temperature", start, nodes)
        self._of_master = None if master_nodes is None else self._of_nodes("master_temperature", of_master, master_nodes)
        self._now, self._increment = self._start, 0.0

    @staticmethod
    def _of_nodes(name: str, value: Any, nodes: int) -> np.ndarray:
        array = _array(name, np.full(nodes, 0.0 if value is None else value) if np.ndim(value) == 0 else value, (nodes,)).copy()
        if not np.isfinite(array).all():
            raise Error(Status.NON_FINITE, f"{name}{np.argwhere(~np.isfinite(array))[0].tolist()} is not finite")
        return array

    def take(self, time_increment: Optional[float]) -> None:
        if time_increment is not None and not (isinstance(time_increment, (int, float, np.number)) and 0 < time_increment < 1e100):
            raise Error(Status.BAD_VALUE, f"time_increment is {time_increment!r}: give a time above 0")
        self._increment = 0.0 if time_increment is None else float(time_increment)

    def move(self, change: np.ndarray, master: MasterSurface, tree: Tree) -> None:
        """change [nodes]: of the temperatures at u = 0."""
        if self.on:
            self._now = self._start + change
            tree.set_temperature(master.scalars(self._now if self._of_master is None else self._of_master))

    def inputs(self, slave: SlavePoints, of: Callable) -> dict[str, Any]:
        """What Model.iterate takes."""
        if not self.on:
            return {"time_increment": self._increment}  # friction may depend on the slip rate
        return {"slave_temperature": of(np.ascontiguousarray(slave.matrix @ self._now)), "time_increment": self._increment or (1.0 if not self._rubs else 0.0)}
