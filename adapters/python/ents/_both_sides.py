# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces whose points are slaves and whose facets are master: one surface in contact with itself, and two passes over two surfaces."""
from __future__ import annotations

import json
from typing import Any, Optional

import numpy as np

from ._arrays import Error, _array
from ._model import Model
from ._sides import Facets, read_facets, refuse_shared, same_facets
from ._structs import Status
from ._surface import Tree
from ._surfaces import SMOOTHED, MasterSurface, SlavePoints, axes_of


class BothSides:
    """What a slave point must not find: its own side (two passes), or its own facets and the other side of its own body (self-contact).

    one_surface  self-contact
    sides        [facets] 0, 1: of the slave and of the master that were given (two passes)
    """

    share = 0.5
    """Part of its area with which a slave point carries. Each pressing pair of places is seen from both of them, with the whole pressure."""

    def __init__(self, slave: SlavePoints, master: MasterSurface, sides: Optional[np.ndarray]) -> None:
        facet = slave.facet_of_points()
        self.one_surface, self.sides = sides is None, sides
        self.thickness = np.zeros(len(slave.areas))  # of the body below the points, at the begin of the increment; 0: not yet known
        self._segment_side = None if sides is None else np.ascontiguousarray(sides, np.int32)
        self._by_point: dict[str, np.ndarray] = {}
        if sides is not None:
            self._by_point["slave_side"] = self._segment_side[facet]
        elif slave.nodes is not None and not master.smoothed:
            self._by_point["slave_node"] = slave.nodes
        else:
            self._by_point["slave_segment"] = facet

    @property
    def of_points(self) -> Optional[np.ndarray]:
        """[points] 0, 1: the side of each point; None: self-contact."""
        return self._by_point.get("slave_side")

    def left_out(self, points: Any) -> dict[str, np.ndarray]:
        """Arguments of the search for these points (numbers)."""
        found = {name: array[points] for name, array in self._by_point.items()}
        if self.sides is not None:
            found["segment_side"] = self._segment_side
        elif self.thickness.any():
            found["depth"] = 0.5 * self.thickness[points]
        return found

    def measure(self, tree: Tree, points: np.ndarray, normals: Optional[np.ndarray], reach: float) -> None:
        """The thickness of the body below the points [points][d], where an increment begins."""
        if self.one_surface and normals is not None:
            self.thickness = tree.thickness(points, reach, normals, self.thickness, **self._by_point)


def joined(model: Model, nodes: int, slave: Any, master: Any, order: str) -> tuple[list, np.ndarray]:
    """Facets of two passes: those of the slave, then those of the master; and the side [facets] of each."""
    d = model.layout.dimension
    refuse_shared(read_facets("slave", slave, nodes, d, order), read_facets("master", master, nodes, d, order))
    facets = [[int(node) for node in facet] for side in (slave, master) for facet in side]
    return facets, np.repeat([0, 1], [len(slave), len(master)])


def is_one_surface(model: Model, nodes: int, slave: Any, master: Any, order: str) -> bool:
    """Are the slave facets the master facets?"""
    try:
        if len(slave) != len(master):
            return False
    except TypeError:
        return False
    d = model.layout.dimension
    return same_facets(read_facets("slave", slave, nodes, d, order), read_facets("master", master, nodes, d, order))


def refuse_one_sided(model: Model, one_surface: bool, rigid: bool) -> None:
    """What needs one slave and one master."""
    what = "a surface in contact with itself" if one_surface else "two_pass"
    text: dict = json.loads(model._text)
    contact = text.get("contact") or {}
    if rigid:
        raise Error(Status.BAD_VALUE, f"{what}: the master has to be a part of the mesh that deforms; with a rigid master leave two_pass out, and give it as master")
    if model.layout.augmentable or model.layout.multipliers:
        raise Error(Status.BAD_VALUE, f"{what}: two multipliers, one from each side, would hold one gap (over-constraint), and grow without bound; write the normal law "
                    '"penalty"' + ("" if one_surface else ", or leave two_pass out"))
    if contact.get("wear") is not None:
        raise Error(Status.BAD_VALUE, f'{what}: each pass would see the wear of one side alone; leave "wear" out' + ("" if one_surface else ", or two_pass"))
    if (text.get("projection") or {}).get("type", "normal") != "normal":
        raise Error(Status.BAD_VALUE, f'{what}: the two sides look against each other, and one ray cannot light both; leave "projection" out')


def of_one_surface(model: Model, slave_height: Any, surface_coordinates: Any) -> tuple[Any, Any]:
    """Arguments slave_height and slave_surface_coordinates: the points of a surface in contact with itself lie on its own height."""
    if slave_height is not None:
        raise Error(Status.BAD_VALUE, 'slave_height: slave and master are one surface, whose height is that of the model; leave it out, or write it into the model ("height")')
    height = json.loads(model._text).get("height")
    if height is None:
        return None, None
    _refuse_varying("a surface in contact with itself", model, height)
    if model.layout.own_surface_coordinates and surface_coordinates is None:
        raise Error(Status.BAD_VALUE, "a surface in contact with itself: its points have no surface coordinates of the model; give surface_coordinates here")
    return model, surface_coordinates


def of_two_passes(model: Model, slave_height: Any, of_slave: Any, of_master: Any, positions: np.ndarray, slave: Any) -> tuple[Optional[Model], Optional[np.ndarray]]:
    """The model of the height of both sides, one height for all segments of a Model; and the surface coordinates [nodes][d-1] of the nodes of both. None:
    both are plain; natural coordinates."""
    height = json.loads(model._text).get("height")
    if height is None:
        if slave_height is not None or of_slave is not None:
            raise Error(Status.BAD_VALUE, 'slave_height is of one side, and two_pass makes slaves of both: write the same height into the model ("height"), or leave one of them out')
        return None, None
    same = slave_height
    if not isinstance(slave_height, Model):
        same = None if slave_height is None else Model({"segment": model.segment, "height": slave_height}, model._data, model._directory, model.library)
    if same is None or json.loads(same._text).get("height") != height or not _same_data(same, model):
        raise Error(Status.BAD_VALUE, 'two_pass: the "height" of the model is that of both sides, since every facet is slave and master: give the same one as slave_height. '
                    "Two different ones stand side by side in one map, and the surface coordinates say which part of it a side has")
    _refuse_varying("two_pass", model, height)
    if model.segment in SMOOTHED or model.layout.own_surface_coordinates:
        raise Error(Status.BAD_VALUE, "two_pass: with a height the segments are plain, and surface_coordinates are given here, not in the model")
    if of_slave is None and of_master is None:
        return model, None
    d = positions.shape[1]
    if not isinstance(of_master, str) or of_slave is None:
        raise Error(Status.BAD_VALUE, f'two_pass: with a height give surface_coordinates as {d - 1} of {", ".join("xyz"[:d])}, and slave_surface_coordinates of the same kind or '
                    "[nodes][d-1]; or none of them")
    coordinates = axes_of("surface_coordinates", of_master, positions).copy()
    ours = axes_of("slave_surface_coordinates", of_slave, positions) if isinstance(of_slave, str) else _array("slave_surface_coordinates", of_slave, coordinates.shape)
    nodes = np.unique([node for facet in slave for node in facet])
    coordinates[nodes] = ours[nodes]
    return model, coordinates


def _same_data(one: Model, other: Model) -> bool:
    return one._data.keys() == other._data.keys() and all(np.array_equal(one._data[name], other._data[name]) for name in one._data)


def _refuse_varying(what: str, model: Model, height: Any) -> None:
    varying = [name for name in model.parameters if json.dumps(name) in json.dumps(height)]
    if varying or model.layout.fields:
        raise Error(Status.BAD_VALUE, f"{what}: its height varies ({', '.join(varying) or 'a field'}), and its points keep the height with which they were made; write "
                    "numbers into the height")
