# SPDX-License-Identifier: BSD-3-Clause
"""What both surfaces of a Contact have lost by wear, given to the heights of both."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional

import numpy as np

from ._arrays import Error, _frozen
from ._model import Model
from ._structs import Status

if TYPE_CHECKING:
    from ._surface import Tree
    from ._surfaces import SlavePoints


class WornSides:
    """The wear of a Contact; it has no constructor of its own."""

    if TYPE_CHECKING:
        model: Model
        tree: Tree
        _slave: SlavePoints

    _nodes_begin: Optional[np.ndarray] = None  # positions of the program's nodes at the last commit()
    _ahead = False  # an update() has not been committed

    @property
    def slave_surface(self) -> Optional[Model]:
        """The Model of slave_height; None: the slave is plain. `.fields` are the blocks of its fields."""
        return self._slave.surface

    def collect_wear(self, slave: Optional[str] = None, master: Optional[str] = None) -> tuple[float, float]:
        """After commit(), once per increment: what both surfaces have lost becomes a part of their heights. The model's "wear" has the share of the
        slave, "slave" (1; 0.3: the master loses the other 0.7). Returns the volumes (slave, master) [L^3] that have been moved.

        slave, master  names of the heights of type "field", of slave_height and of the model; default: the only one. The blocks that are bound change in
                       their place (Model.fields); bind again what else reads them

        The slave's field lowers slave_height along the normals of the slave's facets, the master's the height of the model. A side without a field
        keeps what it has lost in the states of the slave points, where it opens the gap as before. Errors: a model without wear, neither side with a
        field, several fields and no name, blocks that cannot be written to, an update() that has not been committed."""
        if self.model.layout.worn < 0:
            raise Error(Status.BAD_VALUE, 'collect_wear: the model does not wear; write "wear": {"coefficient": ...} into its "contact"')
        surface = self._slave.surface
        ours = None if surface is None else _field("slave", "slave_height", surface, slave)
        theirs = _field("master", "the model", self.model, master)
        if surface is None and slave is not None:
            raise Error(Status.BAD_VALUE, f'collect_wear: slave="{slave}", but the slave has no height of its own; give slave_height')
        if ours is None and theirs is None:
            raise Error(Status.BAD_VALUE, "collect_wear: neither slave_height nor the height of the model has a \"field\" that could take it; what is lost stays in the states")
        if self._nodes_begin is None or self._ahead:
            raise Error(Status.BAD_STATE, "collect_wear: update(u) and commit() come first")
        state, thickness = self._state_begin.copy(), self._arguments["thickness"]
        volumes = [0.0, 0.0]
        blocks = {side: model.fields[name].copy() for side, model, name in (("slave", surface, ours), ("master", self.model, theirs)) if name is not None}
        if theirs is not None:
            found = np.flatnonzero(self._segment_begin >= 0)
            part = state[found]
            self.tree.move(self._tree_begin)
            volumes[1] = self.model.wear_collect(theirs, blocks["master"], part, self._points_begin[found], tree=self.tree, segment=self._segment_begin[found],
                                                 area=self._carried[found], thickness=thickness)
            state[found] = part
        if ours is not None:
            volumes[0] = self.model.wear_collect_slave(surface, ours, blocks["slave"], state, self._slave.flat(), self._slave.coordinates, self._positions,
                                                       self._carried, thickness)
        for side, model, name in (("slave", surface, ours), ("master", self.model, theirs)):  # nothing fails from here on
            if name is not None:
                model.fields[name][:] = blocks[side]
        self._take_fields()
        self._state_begin = self._state = _frozen(state)
        return volumes[0], volumes[1]

    def _take_fields(self) -> None:
        """Both heights and what is made of them, from blocks that have changed."""
        given = self._arguments["model"]
        for model in (given if isinstance(given, Model) else None, self.model, self._slave.surface):
            if model is not None and model.fields:
                model.bind(model.fields, **model._values)
        if self.model.fields:
            self.tree.move(self.tree.positions)
        if self._slave.surface is not None and self._slave.surface.fields:
            self._slave.raise_again()
            self._assembly = None
            if self._nodes_begin is not None:
                self._points_begin = self._slave.at(self._nodes_begin)

    def _saved_fields(self) -> dict[str, np.ndarray]:
        """Blocks of both sides, by "side name"."""
        if self.model.layout.worn < 0:
            return {}
        sides = (("field of the slave ", self._slave.surface), ("field of the master ", self.model))
        return {side + name: block for side, model in sides if model is not None for name, block in model.fields.items()}

    def _fields_of(self, history: dict[str, Any]) -> list[tuple[np.ndarray, np.ndarray]]:
        """(block, saved one) of the fields of both sides."""
        ours = self._saved_fields()
        for name, block in ours.items():
            if np.shape(history.get(name)) != block.shape:
                raise Error(Status.BAD_STATE, f"load: there is no {name} of {len(block)} numbers: the heights are others")
        return [(block, history[name]) for name, block in ours.items()]


def _field(side: str, where: str, model: Model, name: Optional[str]) -> Optional[str]:
    """The name of the field that gets what this side has lost; None: it has none."""
    fields = model.fields
    if name is None:
        if len(fields) > 1:
            raise Error(Status.BAD_VALUE, f"collect_wear: {where} has the fields {', '.join(fields)}; write {side}= and the name of the one that wears")
        name = next(iter(fields), None)
    elif name not in fields:
        raise Error(Status.BAD_VALUE, f'collect_wear: {side}="{name}", but {where} has {", ".join(fields) or "no field"} (bound ones)')
    if name is not None and not (fields[name].flags.writeable and fields[name].flags.c_contiguous):
        raise Error(Status.BAD_VALUE, f'collect_wear: the block of the field "{name}" that {where} is bound to cannot be written to; bind an array of field_init')
    return name
