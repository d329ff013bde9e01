# SPDX-License-Identifier: BSD-3-Clause
"""Models whose numbers change: parameters, fields, wear."""
from __future__ import annotations

import ctypes
from typing import Any, Optional

import numpy as np

from ._arrays import Error, _address, _array, _combination, _new, _plain
from ._structs import Data, Derivatives, Status


class Varying:
    """What a Model with the key "parameters", with heights of type "field" or with "wear" can do besides."""

    def bind(self, fields: Optional[dict] = None, **parameters: float) -> None:
        """From now on the model has these values of its parameters, those of its text for the others, and these blocks of its fields,
        {name: array of field_init}. Bind again after a block has changed; refit trees (Tree.move) after the height has."""
        unknown = [name for name in parameters if name not in self.parameters]
        if unknown:
            raise Error(Status.BAD_VALUE, f"bind: the model has no parameter {', '.join(unknown)}; it has {', '.join(self.parameters) or 'none'}")
        strange = [name for name in fields or {} if name not in self._field_points]
        if strange:
            raise Error(Status.BAD_VALUE, f"bind: the model has no field {', '.join(strange)}; it has {', '.join(self._field_points) or 'none'}")
        values = np.array([float(parameters.get(name, default)) for name, default in self.parameters.items()])
        blocks = {name: _array(name, block, (None,)) for name, block in (fields or {}).items()}
        structs = (Data * len(blocks))(*(_new(Data, name=name.encode(), values=_address(block), rows=1, columns=len(block))
                                         for name, block in blocks.items()))
        bound = ctypes.c_void_p(self._bound.value)
        self.library.call("model_bind", self._of_text, values, structs, len(blocks), ctypes.byref(bound))
        self._bound = self._handle = bound
        self._blocks = blocks  # they live as long as the library reads them
        self._values = dict(zip(self.parameters, values.tolist()))
        for other in self._same:
            other.bind(fields, **self._values)

    def field_init(self, name: str, samples: Any = None) -> np.ndarray:
        """The block of a field: the spline through `samples`, [points_1] or [points_2][points_1], [L]; None: zero. An array to be given to bind,
        saved, and changed by wear_collect."""
        size = ctypes.c_int64()
        self._call("field_size", name.encode(), ctypes.byref(size))
        block = np.zeros(size.value)
        values = None if samples is None else np.ascontiguousarray(_plain("samples", samples), np.float64)
        if values is not None and values.size != self._field_points[name]:
            raise Error(Status.BAD_COUNT, f"samples: {values.size} numbers, the field \"{name}\" has {self._field_points[name]}")
        self._call("field_init", name.encode(), _address(values), block, size.value)
        return block

    def field_sample(self, name: str, block: Any, s: Any) -> np.ndarray:
        """[n]: heights of a field at the surface coordinates s [n][d-1]."""
        s, block = _array("s", s, (None, self.layout.parameters)), _array("block", block, (None,))
        height = np.zeros(len(s))
        self._call("field_sample", name.encode(), block, len(block), len(s), s, height)
        return height

    @property
    def fields(self) -> dict[str, np.ndarray]:
        """{name: block} of the fields that are bound: the arrays themselves where these were contiguous and of float64. A new dict."""
        return dict(self._blocks)

    def state_opened(self, state: Any) -> np.ndarray:
        """States [n][state_size] of points that were not evaluated: without history but for what has been worn off."""
        state = _array("state", state, (None, self.layout.state_size))
        opened, worn = self.state_init(len(state)), self.layout.worn
        if worn >= 0:
            opened[:, worn:worn + 2] = state[:, worn:worn + 2]
        return opened

    def wear_collect(self, name: str, block: np.ndarray, state: np.ndarray, slave: Any, master: Any = None, *, tree: Any = None, segment: Any = None,
                     surface_coordinates: Any = None, area: Any = None, thickness: float = 1.0) -> float:
        """What the master surface has lost goes from `state` [n][state_size] into the field `name`, `block`: both change in their place. Once
        per increment, with the states of its converged end. Other arguments as of evaluate. Returns the volume.
        CutStep: nothing has changed."""
        slave = _array("slave", slave, (None, self.layout.dimension))
        self._refuse_copies("wear_collect", state, len(slave), block)
        given, block_in = self._input(slave, tree, segment, master=master, surface_coordinates=surface_coordinates, area=area)
        volume = ctypes.c_double()
        self._call("wear_collect", 0, len(slave), block_in, float(thickness), state, self.layout.state_size, name.encode(), block, len(block),
                   ctypes.addressof(volume))
        return volume.value

    def wear_collect_slave(self, surface: Any, name: str, block: np.ndarray, state: np.ndarray, points: Any, coordinates: Any, positions: Any, areas: Any,
                           thickness: float = 1.0) -> float:
        """What the slave surface has lost goes from `state` [points][state_size] into `block`, the field `name` of the Model `surface` of its height: both
        change in their place. points, coordinates: as of Library.raise_points; positions [nodes][d] for which the areas [points] hold. Then bind
        the field and raise the points again. Returns the volume. CutStep: nothing has changed."""
        combination = _combination(points)
        d = self.layout.dimension
        positions, areas = _array("positions", positions, (None, d)), _array("areas", areas, (combination.points,))
        if coordinates is not None:
            coordinates = _array("coordinates", coordinates, (len(combination.arrays[1]), d - 1))
        self._refuse_copies("wear_collect_slave", state, combination.points, block)
        volume = ctypes.c_double()
        self._call("wear_collect_slave", surface._handle, combination, coordinates, len(positions), positions, float(thickness), areas, state,
                   self.layout.state_size, name.encode(), block, len(block), ctypes.addressof(volume))
        return volume.value

    def _refuse_copies(self, what: str, state: Any, count: int, block: Any) -> None:
        for array, shape in ((state, (count, self.layout.state_size)), (block, (np.size(block),))):
            if not (isinstance(array, np.ndarray) and array.flags.writeable and array.shape == shape and array.dtype == np.float64 and array.flags.c_contiguous):
                raise Error(Status.BAD_VALUE, f"{what}: state and block are changed in their place: give float64 arrays of state_init and field_init")

    def derivatives(self, slave: Any, master: Any = None, *, tree: Any = None, segment: Any = None, surface_coordinates: Any = None, start: Any = None,
                    area: Any = None, state: Any = None, slave_values: Any = None, adjoint: Any = None) -> dict[str, np.ndarray]:
        """Derivatives by the parameters, in the order of `parameters`: {"gap": [n][p], "energy": [n][p], "residual": [n][p][dofs]}; with `adjoint`
        [n][dofs] instead {"product": [p]}, the sum of adjoint . residual over all elements. Arguments as of evaluate. CutStep (.element):
        an element has no derivatives here, for the reason that `evaluate` has as its status."""
        slave = _array("slave", slave, (None, self.layout.dimension))
        given, block = self._input(slave, tree, segment, master=master, surface_coordinates=surface_coordinates, start=start, area=area,
                                   state_begin=state, slave_values=slave_values)
        n, p = len(slave), len(self.parameters)
        if adjoint is None:
            result = {"gap": np.zeros((n, p))}
            if self._has_law:
                result.update(energy=np.zeros((n, p)), residual=np.zeros((n, p, self.layout.dofs)))
        else:
            adjoint = _array("adjoint", adjoint, (n, self.layout.dofs))
            result = {"product": np.zeros(p)}
        self._call("parameter_derivatives", 0, n, block, _new(Derivatives, adjoint=_address(adjoint), **{name: _address(array) for name, array in result.items()}))
        return result
