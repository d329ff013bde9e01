# SPDX-License-Identifier: BSD-3-Clause
"""A contact model, and what its elements return."""
from __future__ import annotations

import ctypes
import json
import os
import pathlib
import warnings
import weakref
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np

from . import _library
from ._arrays import CutStep, Error, _address, _array, _count, _new, _plain
from ._heights import warn_of_heights
from ._surface import left_out_arrays
from ._structs import INPUTS, QUANTITIES, RESULTS, Data, Detection, Input, Layout, Output, Shared, Status, Surface
from ._varying import Varying

if TYPE_CHECKING:
    from ._surface import Tree
    from ._system import System

SHARED = {"area": Shared.AREA, "state_begin": Shared.STATE, "multiplier": Shared.MULTIPLIER,
          "slave_values": Shared.SLAVE_VALUES, "slave_temperature": Shared.TEMPERATURE}


def _json(model):
    """Text of a dict in which arrays and numbers of NumPy may stand."""
    def plain(value):
        if isinstance(value, (np.ndarray, np.generic)):
            return _plain("model: an array in it", value).tolist()
        raise TypeError(f"{value!r} is a {type(value).__name__}; a model holds texts, numbers, lists, dicts and NumPy arrays")
    try:
        return json.dumps(model, default=plain, allow_nan=False)
    except (TypeError, ValueError) as error:
        raise Error(Status.BAD_VALUE, f"model: {error}") from None


def _fields(height):
    """{name: number of samples} of the fields in a height."""
    if not isinstance(height, dict):
        return {}
    own = {height["name"]: int(np.prod(height["points"]))} if height.get("type") == "field" else {}
    parts = height.get("of", [])
    for part in parts if isinstance(parts, list) else [parts]:
        own.update(_fields(part))
    return own


class Model(Varying):
    """A contact model; only `bind` changes it.

    source     dict (whose lists and numbers may be NumPy's) or JSON text (it begins with "{"), else the name of a JSON file;
               abi/model.schema.json says what it may hold
    data       {name: array}: height maps that the text refers to by name; copied
    directory  where relative names of height maps in a text start; a file's own folder if `source` is one
    """

    def __init__(self, source: Union[dict, str, os.PathLike], data: Optional[dict[str, Any]] = None, directory: Union[str, os.PathLike, None] = None,
                 library: Optional[_library.Library] = None) -> None:
        self.library = library or _library.library()
        self._handle = ctypes.c_void_p()
        if isinstance(source, dict):
            text = _json(source)
        elif isinstance(source, str) and source.lstrip().startswith("{"):
            text = source
        elif isinstance(source, (str, os.PathLike)):
            if not pathlib.Path(source).is_file():
                raise Error(Status.FILE, f"model: there is no file {os.fspath(source)}; a text begins with {{")
            directory = directory or os.path.dirname(os.path.abspath(source))
            text = pathlib.Path(source).read_text(encoding="utf-8")
        else:
            raise Error(Status.BAD_VALUE, f"model: wanted is a dict, JSON text or the name of a file, not {type(source).__name__}")
        self._text, self._directory = text, directory
        self._data = {name: np.atleast_2d(_array(f"data[{name!r}]", values, (None,) * np.ndim(values))) for name, values in (data or {}).items()}
        names = [name.encode() for name in self._data]
        structs = (Data * len(names))(*(_new(Data, name=name, values=_address(values), rows=values.shape[0], columns=values.shape[1])
                                        for name, values in zip(names, self._data.values())))
        encoded = text.encode()
        folder = None if directory is None else os.fsencode(directory)
        try:
            self.library.call("model_create", encoded, len(encoded), folder, structs, len(names), ctypes.byref(self._handle), positive=Error)
        except Error as error:
            raise error if text is source or isinstance(source, dict) else Error(error.status, f"{os.fspath(source)}: {error}", error.element) from None
        parsed = json.loads(text)
        self.segment: str = parsed["segment"]
        self.patch, self.border = parsed.get("patch"), parsed.get("border")
        self.parameters: dict[str, Any] = {name: parsed["parameters"][name] for name in sorted(parsed.get("parameters", {}), key=str.encode)}
        """Named parameters and their values in the text, in the library's order."""
        self._field_points, self._has_law = _fields(parsed.get("height")), parsed.get("contact") is not None
        self._of_text, self._bound = self._handle, ctypes.c_void_p()
        self._values, self._blocks = None, {}
        self._same: Any = weakref.WeakSet()  # models that are bound with this one
        self.layout = _new(Layout)
        """Sizes: dimension, nodes, parameters, dofs, state_size, symmetric_tangent, multipliers, friction, augmentable; needs (see Need) and instruction_set."""
        self._call("model_layout", self.layout)
        warn_of_heights(parsed.get("height"), self._data, directory)

    def __repr__(self) -> str:
        law = "contact" if self._has_law else "no contact law"
        return f"<ents.Model: {self.segment}, {self.layout.dimension}D, {law}{', friction' if self.layout.friction else ''}>"

    def with_border(self, border: float) -> Model:
        """The model, with this "border" where its text has none. What is bound to this model is bound to that one, too."""
        if self.border is not None:
            return self
        with warnings.catch_warnings():  # this model has given them
            warnings.simplefilter("ignore")
            same = Model({**json.loads(self._text), "border": border}, self._data, self._directory, self.library)
        if self._values is not None:
            same.bind(self._blocks, **self._values)
        self._same.add(same)
        return same

    def __getstate__(self) -> dict:
        return {"arguments": (self._text, self._data, self._directory, self.library), "bound": (self._values, self._blocks)}

    def __setstate__(self, saved: dict) -> None:
        self.__init__(*saved["arguments"])
        values, blocks = saved["bound"]
        if values is not None:
            self.bind(blocks, **values)

    def __del__(self) -> None:
        for handle in (getattr(self, "_bound", None), getattr(self, "_of_text", None) or getattr(self, "_handle", None)):
            if handle:
                self.library.c.ents_model_destroy(ctypes.byref(handle), None)

    def _call(self, name: str, *arguments: Any, positive: Optional[type] = CutStep):
        return self.library.call(name, self._handle, *arguments, positive=positive)

    def _own_tree(self, tree: Any) -> Tree:
        """The tree, if its segments have the nodes that this model reads."""
        nodes, d = getattr(tree, "connectivity", np.zeros((0, 0))).shape[1], getattr(tree, "positions", np.zeros((0, 0))).shape[1]
        if (nodes, d) != (self.layout.nodes, self.layout.dimension):
            raise Error(Status.BAD_VALUE, f"tree: it has segments of {nodes} nodes in {d}D, the model's {self.segment} has {self.layout.nodes} in "
                        f"{self.layout.dimension}D: make it with this model")
        return tree

    def _shape(self, extents):
        """Shape of an array of one element, from its extents in ents.h."""
        lay = self.layout
        sizes = {"d": lay.dimension, "d-1": lay.parameters, "m": lay.nodes, "n": lay.dimension * ((lay.dofs - lay.multipliers) // lay.node_dofs), "dofs": lay.dofs,
                 "tangent_leading_dimension": lay.dofs, "state_size": lay.state_size, "multipliers": lay.multipliers,
                 "slave_values": lay.slave_values}
        return tuple(sizes[extent] if extent in sizes else int(extent) for extent in extents)

    def state_init(self, count: int) -> np.ndarray:
        """[count][state_size]: states of elements without history."""
        count = _count("count", count)
        state = np.zeros((count, self.layout.state_size))
        self._call("state_init", count, state, self.layout.state_size)
        return state

    def state_augment(self, state_begin: np.ndarray, state_end: Any) -> None:
        """Uzawa's step: multipliers of `state_end` into `state_begin` (an array of state_init), in its place."""
        size = self.layout.state_size
        _array("state_begin", state_begin, (None, size))
        end = _array("state_end", state_end, (len(state_begin), size))
        if not (isinstance(state_begin, np.ndarray) and state_begin.flags.c_contiguous and state_begin.flags.writeable and state_begin.dtype == np.float64):
            raise Error(Status.BAD_VALUE, "state_begin: give the array that state_init made, it is changed in its place")
        self._call("state_augment", len(end), state_begin, size, end, size)

    def state_transfer(self, old_master: Any, new_master: Any, state: Any, old_surface_coordinates: Any = None,
                       new_surface_coordinates: Any = None) -> tuple[int, np.ndarray]:
        """A slave moves on to another segment: its `state` [state_size] as seen from there. Masters [m][d] at the begin of the increment, surface
        coordinates [m][d-1]. Returns (status, moved): status 0, or recoverable (cut the step)."""
        lay = self.layout
        segments = [_array(name, value, (lay.nodes, lay.dimension)) for name, value in (("old_master", old_master), ("new_master", new_master))]
        coordinates = [None if value is None else _array(name, value, (lay.nodes, lay.dimension - 1)) for name, value in (
            ("old_surface_coordinates", old_surface_coordinates), ("new_surface_coordinates", new_surface_coordinates))]
        state, moved = _array("state", state, (lay.state_size,)), np.zeros(lay.state_size)
        report = self._call("state_transfer", *(x for pair in zip(segments, coordinates) for x in pair), state, moved, positive=None)
        return report.status, moved

    def evaluate(self, slave: Any, master: Any = None, want: Union[str, list] = "residual tangent", *, tree: Optional[Tree] = None, segment: Any = None,
                 surface_coordinates: Any = None, start: Any = None, area: Any = None, state: Any = None, multiplier: Any = None,
                 slave_values: Any = None, slave_temperature: Any = None, master_temperature: Any = None, time_increment: float = 0.0, first: int = 0,
                 count: Optional[int] = None, out: Optional[dict] = None) -> dict[str, Any]:
        """Contact elements, one slave node and one segment each.

        slave      [n][d]; master [n][m][d], or [m][d]: the same for all. Or `tree` (Tree) and `segment` [n] (never -1) of its detect
        want       names of QUANTITIES, as one string or a list
        surface_coordinates [m][d-1], start [d-1], area [], state [state_size] (begin of the increment), multiplier [multipliers],
        slave_values [3] (gap offset [L], factors of the wear coefficient and of "sliding"; with a normal law "table" [4], the last one its scale): one for all, or with a leading [n]. A number for start, state or multiplier is that of all their entries
        slave_temperature [], master_temperature [m] (with `tree`: tree.set_temperature), time_increment: of a model with "heat"
        first, count  evaluates a range of the n (threads that share `out`)
        out        the result of a former call with the same n and `want`, filled again; new arrays else

        Returns {name: array [n]...} and "status" [n] (0, or recoverable: nothing else is written for that element), "step_factor", "message": those
        of this call's range. Where ranges share `out`, the last call's are left in it: look at "status".
        """
        slave = _array("slave", slave, (None, self.layout.dimension))
        given, block = self._input(slave, tree, segment, master=master, surface_coordinates=surface_coordinates, start=start, area=area,
                                   state_begin=state, multiplier=multiplier, slave_values=slave_values, slave_temperature=slave_temperature,
                                   master_temperature=master_temperature)
        block.time_increment = time_increment
        result, block_out = self._output(len(slave), want, out)
        first = _count("first", first, 0, len(slave))
        count = len(slave) - first if count is None else _count("count", count, 0, len(slave) - first)
        report = self._call("evaluate", first, count, block, block_out, positive=None)
        result.update(step_factor=report.step_factor, message=report.message.decode())
        return result

    def assemble(self, system: System, slave: Any, tree: Tree, segment: Any, want: Union[str, list] = "", *, start: Any = None, area: Any = None,
                 state: Any = None, multiplier: Any = None, slave_values: Any = None, slave_temperature: Any = None,
                 time_increment: float = 0.0) -> dict[str, Any]:
        """Residual and tangent are added to `system` (System), by the library. slave [n][d]: positions of the slave points; tree and segment [n]
        as detect gives them (-1: open); the rest as for evaluate. Returns what evaluate does, for all n elements. After an error or a
        recoverable status the system holds a part of the sum."""
        slave = _array("slave", slave, (None, self.layout.dimension))
        given, block = self._input(slave, tree, segment, start=start, area=area, state_begin=state, multiplier=multiplier,
                                   slave_values=slave_values, slave_temperature=slave_temperature)
        block.time_increment = time_increment
        result, block_out = self._output(len(slave), want, None)
        report = self._call("assemble", 0, len(slave), block, block_out, system._struct(self, tree, len(slave)), positive=None)
        result.update(step_factor=report.step_factor, message=report.message.decode())
        return result

    def iterate(self, slave: Any, tree: Tree, reach: float, segment: Any = None, xi: Any = None, want: Union[str, list] = "", *,
                system: Optional[System] = None, positions_begin: Any = None, slave_begin: Any = None, area: Any = None, state: Any = None, multiplier: Any = None,
                slave_values: Any = None, slave_temperature: Any = None, time_increment: float = 0.0, slave_normal: Any = None,
                permitted: int = 0, **left_out: Any) -> dict[str, Any]:
        """Contact of one Newton iteration in one call: `tree.detect`, states moved to the segments that were found, and `assemble` into
        `system` (None: results only).

        slave, reach, segment, xi, slave_normal, permitted, left_out   as of Tree.detect: segment [n] (-1: open) and xi [n][d-1] of the last projection
        positions_begin                         [nodes][d] of the tree at the begin of the increment: needed with friction, if the master deforms
        slave_begin                             [n][d] slaves there: what was not within reach then has friction from the touch on, too
        want, area, state ...                   as of evaluate; state is that of the begin of the increment

        Returns what evaluate does, and segment, xi, detected ([n] flags of the detection), detected_gap, other. CutStep: a contact is lost that
        `permitted` does not name. After an error or a recoverable status the system holds a part of the sum."""
        slave = _array("slave", slave, (None, self.layout.dimension))
        n, d = len(slave), self.layout.dimension
        self._own_tree(tree)
        given, block = self._input(slave, None, None, area=area, state_begin=state, multiplier=multiplier, slave_values=slave_values,
                                   slave_temperature=slave_temperature)
        block.time_increment = time_increment
        block.slave, block.slave_stride = None, 0  # the detection has them
        if positions_begin is not None:
            given["begin"] = _array("positions_begin", positions_begin, tree.positions.shape)
            block.positions_begin = given["begin"].ctypes.data
        if slave_begin is not None:
            given["slave_begin"] = _array("slave_begin", slave_begin, (n, d))
            block.slave_begin = given["slave_begin"].ctypes.data
        result, block_out = self._output(n, want, None)
        found = {"segment": np.full(n, -1, np.int64) if segment is None else _array("segment", segment, (n,), np.int64).copy(),
                 "xi": np.zeros((n, d - 1)) if xi is None else _array("xi", xi, (n, d - 1)).copy(),
                 "gap": np.zeros(n), "flags": np.zeros(n, np.int32), "other": np.full(n, -1, np.int64)}
        normal = None if slave_normal is None else _array("slave_normal", slave_normal, (n, d))
        exclusions = left_out_arrays(n, len(tree.connectivity), left_out)
        detection = _new(Detection, slave=slave.ctypes.data, reach=float(reach), permitted=int(permitted), slave_normal=_address(normal),
                         **{name: array.ctypes.data for name, array in (*found.items(), *exclusions.items())})
        report = self._call("iterate", tree.mesh, tree._tree, len(tree._tree), 0, n, detection, block, block_out,
                            None if system is None else system._struct(self, tree, n), positive=None)
        if report.status and not result["status"].any():
            raise CutStep(Status(report.status), report.message.decode(), report.element, report.step_factor)
        result.update(segment=found["segment"], xi=found["xi"], detected=found["flags"], detected_gap=found["gap"], other=found["other"],
                      step_factor=report.step_factor, message=report.message.decode())
        return result

    def _input(self, slave, tree, segment, **inputs):
        """ents_input, and the arrays that it points to."""
        n = len(slave)
        given = {"slave": slave}
        block = _new(Input, slave=slave.ctypes.data, slave_stride=self.layout.dimension)
        for name, value in inputs.items():
            if value is None:
                continue
            shape = self._shape(INPUTS[name])
            number = np.ndim(value) == 0 and len(shape) < 2  # of all elements and all entries
            shared = number or np.ndim(value) == len(shape)
            given[name] = np.full(shape, value, np.float64) if number else _array(name, value, shape if shared else (n, *shape))
            setattr(block, name, given[name].ctypes.data)
            setattr(block, name + "_stride", 0 if shared else int(np.prod(shape)))
            block.shared |= SHARED.get(name, 0) if shared else 0
        if tree is not None:
            self._own_tree(tree)
            given["segment"] = _array("segment", segment, (n,), np.int64)
            block.mesh, block.segment, block.segment_stride = ctypes.addressof(tree.mesh), given["segment"].ctypes.data, 1
        return given, block

    def _output(self, n, want, out):
        """ents_output, and the arrays that it points to: new ones, or those of `out`."""
        names = want.split() if isinstance(want, str) else [str(name) for name in want]
        unknown = [name for name in names if name not in QUANTITIES]
        if unknown:
            raise Error(Status.BAD_MASK, f"want: there is no {', '.join(unknown)}; take some of {', '.join(QUANTITIES)}")
        result = {} if out is None else out

        def target(name, shape, dtype):
            """Address of the quantity's array, a new one or that of `out`. The library's matrices are column-major: seen from Python, transposed."""
            turned = name in ("tangent", "gap_hessian", "xi_hessian")
            if out is None:
                array = np.zeros((n, *shape), dtype)
                result[name] = np.swapaxes(array, -1, -2) if turned else array
            array = result.get(name)
            memory = np.swapaxes(array, -1, -2) if turned and np.ndim(array) > 1 else array
            if not isinstance(array, np.ndarray) or array.shape != (n, *shape) or array.dtype != dtype or not memory.flags.c_contiguous \
                    or not memory.flags.writeable:
                raise Error(Status.BAD_COUNT, f"out: {name} is not that of a result for {n} elements and the same `want`")
            return array.ctypes.data

        block_out = _new(Output, wanted=sum(QUANTITIES[name] for name in set(names)), status=target("status", (), np.int32), status_stride=1)
        for name, (_, kind, extents) in RESULTS.items():
            if name in names:
                shape = self._shape(extents)
                setattr(block_out, name, target(name, shape, np.dtype(kind)))
                setattr(block_out, name + "_stride", int(np.prod(shape)))
        return result, block_out

    def blocks(self, slave: Any, tree: Tree, segment: Any, slave_equations: Any, master_equations: Any, rows: int, multiplier_equations: Any = None,
               want: str = "", **inputs: Any) -> tuple[np.ndarray, tuple, dict[str, Any]]:
        """Residual and tangent in the equations of the host.

        segment              [n] of tree.detect; -1: open
        slave_equations      [n][d] row of each dof of the slaves; master_equations [nodes][d] of the nodes of `tree` (None: rigid). -1:
                             prescribed, left out. multiplier_equations [n][multipliers]
        area, state ...      as for evaluate; with a leading [n]
        Returns R [rows], (values, (i, j)), result: scipy.sparse.coo_matrix(values_ij, (rows, rows)) adds up what falls on one place. `result`
        is that of evaluate for the elements result["closed"] (indices), the others are open (with multipliers: evaluate those yourself).
        """
        lay = self.layout
        slave = _array("slave", slave, (None, lay.dimension))
        segment = _array("segment", segment, (len(slave),), np.int64)
        self._own_tree(tree)
        closed = np.flatnonzero(segment >= 0)
        if lay.multipliers and len(closed) < len(segment):
            raise Error(Status.BAD_VALUE, "segment: an element with multiplier dofs needs a segment, open ones too (their equation: multiplier = 0)")
        per_element = lambda name, value: np.ndim(value) > len(self._shape(INPUTS[{"state": "state_begin"}.get(name, name)]))
        own = {name: np.asarray(value)[closed] if per_element(name, value) else value for name, value in inputs.items()}
        result = self.evaluate(slave[closed], None, f"residual tangent {want}", tree=tree, segment=segment[closed], **own)
        parts = [_array("slave_equations", slave_equations, (len(slave), lay.node_dofs), np.int64)[closed]]
        if lay.dofs - lay.multipliers > lay.node_dofs:
            of_nodes = _array("master_equations", master_equations, (tree.mesh.nodes, lay.node_dofs), np.int64)
            parts.append(of_nodes[tree.connectivity[segment[closed]]].reshape(len(closed), lay.nodes * lay.node_dofs))
        if lay.multipliers:
            parts.append(_array("multiplier_equations", multiplier_equations, (len(slave), lay.multipliers), np.int64)[closed])
        equations = np.concatenate(parts, axis=1)
        rows = _count("rows", rows)
        if equations.size and equations.max() >= rows:
            raise Error(Status.BAD_VALUE, f"slave_equations or master_equations: {equations.max()}; there are {rows} rows")
        residual = np.zeros(rows)
        kept = equations >= 0
        np.add.at(residual, equations[kept], result["residual"][kept])
        i, j = np.broadcast_arrays(equations[:, :, None], equations[:, None, :])
        kept = (i >= 0) & (j >= 0) & (result["tangent"] != 0)
        result["closed"] = closed
        return residual, (result["tangent"][kept], (i[kept], j[kept])), result

    def surface(self, master: Any, xi: Any, surface_coordinates: Any = None) -> dict[str, np.ndarray]:
        """Points of one enriched segment, for pictures: master [m][d], xi [n][d-1]. Returns dict: point, normal, height, base_point, base_normal.
        CutStep (.element: the point): the segment has no normal there."""
        d = self.layout.dimension
        master, xi = _array("master", master, (self.layout.nodes, d)), _array("xi", xi, (None, d - 1))
        if surface_coordinates is not None:
            surface_coordinates = _array("surface_coordinates", surface_coordinates, (self.layout.nodes, d - 1))
        out = {name: np.zeros(len(xi) if name == "height" else (len(xi), d)) for name in "point normal height base_point base_normal".split()}
        self._call("surface_evaluate", len(xi), _new(
            Surface, master=master.ctypes.data, surface_coordinates=_address(surface_coordinates), xi=xi.ctypes.data,
            **{name: array.ctypes.data for name, array in out.items()}))
        return out
