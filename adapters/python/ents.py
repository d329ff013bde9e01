# SPDX-License-Identifier: BSD-3-Clause
"""Contact elements of libents.so in Python: abi/ents.h through ctypes, with NumPy arrays. Nothing is compiled.

    import ents
    model = ents.Model({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 5e3}}})
    result = model.evaluate(slave, master, want="gap residual tangent")     # arrays by name

Conventions are those of ents.h: current positions, indices from 0, dofs node by node (slave, then master nodes, then multipliers), units of
the host. Matrices here are ordinary ones: tangent[e, i, j] = dR_i / du_j of element e. Arrays are converted to float64 / int64 and copied where they are
not so already; indices may be floating point numbers if they are whole. Calls release the interpreter's lock: threads that evaluate the same model run at the same time.

Mistakes raise ents.Error with the library's own message. What a cut of the step can cure (0 < status < 100) is no exception: "status" of
the result holds it for every element, "step_factor" and "message" say what to do.
"""
import ctypes
import ctypes.util
import enum
import json
import os

import numpy as np

CONTRACT_MAJOR, CONTRACT_MINOR = 1, 3
ENDS_STRAIGHT, ENDS_REPEATED = 0, 1


class Status(enum.IntEnum):
    """Statuses of ents.h. 1 .. 99: cut the step; negative: raised as Error."""
    OK = 0
    NO_PROJECTION, SINGULAR_PROJECTION, AMBIGUOUS_PROJECTION, DEGENERATE_SEGMENT, GRAZING_RAY, DEEP_PENETRATION, OUT_OF_RANGE = range(1, 8)
    NULL_ARGUMENT, STRUCT_SIZE, VERSION, NON_FINITE, JSON_SYNTAX, UNKNOWN_KEY = range(-1, -7, -1)
    BAD_VALUE, FILE, BAD_MASK, BAD_COUNT, BAD_HANDLE, BAD_STATE, BAD_PATTERN = range(-7, -14, -1)
    NO_MEMORY, INTERNAL = -100, -101


class Flag(enum.IntFlag):
    """Bits of result["flags"]."""
    CONTACT, OUTSIDE, FAR_SIDE, SEARCHED, STICK, SLIP, SHEAR_LIMIT, CHANGED, AMBIGUOUS, BEHIND_EDGE = (1 << i for i in range(10))


class Need(enum.IntFlag):
    """Bits of Model.layout.needs: what the elements of a model need. What they do not need is not computed."""
    HEIGHT, SLOPE, CURVED, ITERATION, MASTER, FRICTION, HISTORY, MULTIPLIERS, ONE_BY_ONE = (1 << i for i in range(9))


class Error(RuntimeError):
    """A mistake of the caller or of the installation: .status (see Status), .element (-1: none), and the message of the report."""

    def __init__(self, status, message, element=-1):
        super().__init__(message)
        self.status, self.element = status, element


# ---- structs of ents.h: kind and name of every field, in order ----------------------------------------------------------------
_KINDS = {"i": ctypes.c_int32, "l": ctypes.c_int64, "d": ctypes.c_double, "p": ctypes.c_void_p, "s": ctypes.c_char_p, "m": ctypes.c_char * 512,
          "l16": ctypes.c_int64 * 16, "d16": ctypes.c_double * 16, "d16x2": ctypes.c_double * 2 * 16, "d16x3": ctypes.c_double * 3 * 16}


def _struct(name, fields):
    pairs = [field.split(":") for field in ("i:struct_size " + fields).split()]
    return type(name, (ctypes.Structure,), {"_fields_": [(field, _KINDS[kind]) for kind, field in pairs]})


_STRIDED = [  # name of the quantity, kind of its numbers; in the order of the bits ENTS_XI, ENTS_GAP ... except `state_end`
    *((name, "d") for name in "xi gap normal_gap normal point gap_gradient gap_hessian xi_gradient xi_hessian energy pressure residual tangent "
      "state_end".split()), ("flags", "i"), ("iterations", "i"), *((name, "d") for name in "traction slip age".split())]
QUANTITIES = {name: 1 << bit for bit, (name, _) in enumerate(_STRIDED)}

Report = _struct("ents_report", "i:status l:element d:step_factor m:message")
Data = _struct("ents_data", "i:reserved p:name p:values l:rows l:columns")
Layout = _struct("ents_layout", "i:dimension i:nodes i:parameters i:dofs i:state_size i:symmetric_tangent i:own_surface_coordinates "
                 "i:multipliers i:friction i:augmentable i:needs s:instruction_set")
MasterMesh = _struct("ents_master_mesh", "i:reserved l:segments p:connectivity l:nodes p:positions p:surface_coordinates")
Detection = _struct("ents_detection", "i:reserved p:slave d:reach p:segment p:xi p:gap p:flags p:other")
Input = _struct("ents_input", "i:reserved " + " ".join(f"p:{name} l:{name}_stride" for name in (
    "slave", "master", "surface_coordinates", "start", "area", "state_begin", "multiplier")) + " p:mesh p:segment l:segment_stride")
Output = _struct("ents_output", "i:wanted p:status l:status_stride " + " ".join(
    f"p:{name} l:{name}_stride" + (" l:tangent_leading_dimension" if name == "tangent" else "") for name, _ in _STRIDED))
Surface = _struct("ents_surface", "i:reserved p:master p:surface_coordinates p:xi p:point p:normal p:height p:base_point p:base_normal")
Combination = _struct("ents_combination", "i:reserved l:points p:begin p:nodes p:weights")
SystemOfHost = _struct("ents_system", "i:index_size p:slave p:master l:slave_nodes p:slave_equations l:master_nodes p:master_equations "
                       "p:multiplier_equations l:rows p:residual p:row_begin p:columns p:values p:places l:places_size")
SurfaceCheck = _struct("ents_surface_admissibility", "i:samples d:reach d:kink p:violations l:judged l:violated d16:value d16:bound d16:missing "
                       "l16:segment d16x2:xi d16x3:point l16:other d16x2:other_xi d:height_min d:height_max")
STRUCTS = (Report, Data, Layout, MasterMesh, Detection, Input, Output, Surface, Combination, SystemOfHost, SurfaceCheck)
CONDITIONS = "continuity fold edge jump kink wedge projection shadow occlusion crossing".split()  # places in the arrays of SurfaceCheck


def _new(struct, **fields):
    return struct(struct_size=ctypes.sizeof(struct), **fields)


def _address(array):
    return None if array is None else array.ctypes.data


def _whole(name, value):
    """`value` as an array of whole numbers. 2.0 is one; 2.7 is a mistake, which a conversion to integers would hide."""
    array = np.asarray(value)
    if array.dtype.kind == "f":
        wrong = np.argwhere(~((np.abs(array) < 2.0 ** 63) & (array == np.floor(array))))
        if len(wrong):
            place = tuple(wrong[0])
            raise Error(Status.BAD_VALUE, f"{name}[{', '.join(map(str, place))}] is {array[place]}: give a whole number")
    return array


def _array(name, value, shape, dtype=np.float64):
    """`value` as a contiguous array; None in `shape` stands for any size."""
    if dtype is np.int64:
        value = _whole(name, value)
    array = np.ascontiguousarray(value, dtype)
    if array.ndim != len(shape) or any(want not in (None, have) for want, have in zip(shape, array.shape)):
        raise Error(Status.BAD_COUNT, f"{name}: the shape is {array.shape}, wanted is {tuple('n' if s is None else s for s in shape)}")
    return array


def _combination(combination):
    begin, of = (_array("combination: " + name, value, (None,), np.int64) for name, value in zip(("begin", "nodes"), combination))
    weights = _array("combination: weights", combination[2], of.shape)
    block = _new(Combination, points=len(begin) - 1, begin=begin.ctypes.data, nodes=of.ctypes.data, weights=weights.ctypes.data)
    block.arrays = begin, of, weights  # they live as long as the addresses
    return block


# ---- the library --------------------------------------------------------------------------------------------------------------
class Library:
    """libents.so: `path`, else what the environment's ENTS_LIBRARY names, else where the system's loader finds it."""

    def __init__(self, path=None):
        path = path or os.environ.get("ENTS_LIBRARY")
        try:
            self.c = ctypes.CDLL(os.fspath(path) if path else ctypes.util.find_library("ents") or "libents.so")
        except OSError as error:
            raise Error(Status.FILE, f"{error}: give Library(path), set ENTS_LIBRARY to the file libents.so, or install ents") from None
        self.c.ents_version.restype = ctypes.c_char_p
        self.call("check_contract", ctypes.c_int32(CONTRACT_MAJOR), ctypes.c_int32(CONTRACT_MINOR))

    def version(self):
        return self.c.ents_version().decode()

    def call(self, name, *arguments):
        """ents_`name`(arguments, report). Negative statuses raise; the report comes back. Plain integers are int64."""
        report = _new(Report)
        converted = [ctypes.c_int64(a) if isinstance(a, (int, np.integer)) else ctypes.byref(a) if isinstance(a, ctypes.Structure)
                     else ctypes.c_void_p(a.ctypes.data) if isinstance(a, np.ndarray) else a for a in arguments]
        status = getattr(self.c, "ents_" + name)(*converted, ctypes.byref(report))
        if status < 0:
            raise Error(Status(status) if status in Status._value2member_map_ else status, report.message.decode(), report.element)
        return report

    def tributary_areas(self, facet, connectivity, positions, thickness=1.0):
        """Areas [nodes] of the slave nodes of facets ("line2", "quad4" ...): connectivity [facets][nodes], positions [nodes][d]."""
        connectivity = _array("connectivity", connectivity, (None, None), np.int64)
        positions = _array("positions", positions, (None, 2 if facet.startswith("line") else 3))
        areas = np.zeros(len(positions))
        self.call("tributary_areas", facet.encode(), len(connectivity), connectivity, len(positions), positions,
                  ctypes.c_double(thickness), areas)
        return areas

    def sampling_points(self, facet, per_direction, connectivity, positions, thickness=1.0):
        """Points inside slave facets, that see a texture between the nodes: combinations of the nodes (begin [points + 1], nodes, weights), as of
        `smooth`, and their areas [points]. Lines have `per_direction` points, triangles and quadrilaterals its square."""
        connectivity = _array("connectivity", connectivity, (None, None), np.int64)
        line = facet.startswith("line")
        positions = _array("positions", positions, (None, 2 if line else 3))
        points = len(connectivity) * max(per_direction, 0) ** (1 if line else 2)
        begin, areas = np.zeros(points + 1, np.int64), np.zeros(points)
        of, weights = np.zeros(points * connectivity.shape[1], np.int64), np.zeros(points * connectivity.shape[1])
        self.call("sampling_points", facet.encode(), ctypes.c_int32(per_direction), len(connectivity), connectivity, len(positions), positions,
                  ctypes.c_double(thickness), begin, of, weights, areas)
        return (begin, of, weights), areas

    def smooth(self, facet, basis, connectivity, nodes, ends=ENDS_STRAIGHT):
        """A smoothed master surface over facets, "line2" with basis "bspline4", say (table in ents.h): segments [facets][m] of control points,
        and those as combinations of the `nodes` nodes: (begin [points + 1], nodes, weights), which is scipy.sparse.csr_matrix((weights, nodes, begin))."""
        connectivity = _array("connectivity", connectivity, (None, None), np.int64)
        head = (facet.encode(), basis.encode(), ctypes.c_int32(ends), len(connectivity), connectivity, *_array("nodes", [nodes], (1,), np.int64))
        points, terms = ctypes.c_int64(), ctypes.c_int64()
        self.call("smooth_size", *head, ctypes.byref(points), ctypes.byref(terms))
        digits = "".join(c for c in basis if c.isdigit())  # the basis's nodes: bspline4, bezier15
        segments = np.zeros((len(connectivity), int(digits)), np.int64)
        begin, of, weights = np.zeros(points.value + 1, np.int64), np.zeros(terms.value, np.int64), np.zeros(terms.value)
        self.call("smooth", *head, points, terms, segments, begin, of, weights)
        return segments, (begin, of, weights)

    def combine(self, combination, values):
        """What `smooth` gave, applied to values [nodes][1 .. 3] (positions, surface coordinates)."""
        begin = combination[0]
        values = _array("values", values, (None, None))
        points = np.zeros((len(begin) - 1, values.shape[1]))
        self.call("combine", _combination(combination), ctypes.c_int32(values.shape[1]), len(values), values, points)
        return points


_default = None


def library():
    """The library of models that are not told of one; loaded at the first call."""
    global _default
    _default = _default or Library()
    return _default


class Model:
    """A contact model, immutable.

    source     dict or JSON text (it begins with "{"), else the name of a JSON file; abi/model.schema.json says what it may hold
    data       {name: array}: height maps that the text refers to by name; copied
    directory  where relative names of height maps in a text start; a file's own folder if `source` is one
    """

    def __init__(self, source, data=None, directory=None, library=None):
        self.library = library or globals()["library"]()
        self._handle = ctypes.c_void_p()
        arrays = {name: np.atleast_2d(np.ascontiguousarray(values, np.float64)) for name, values in (data or {}).items()}
        names = [name.encode() for name in arrays]
        structs = (Data * len(arrays))(*(_new(Data, name=ctypes.cast(ctypes.c_char_p(name), ctypes.c_void_p), values=_address(values),
                                              rows=values.shape[0], columns=values.shape[1])
                                         for name, values in zip(names, arrays.values())))
        if isinstance(source, dict):
            source = json.dumps(source)
        elif not (isinstance(source, str) and source.lstrip().startswith("{")) and arrays:
            directory = directory or os.path.dirname(os.path.abspath(source))
            with open(source, encoding="utf-8") as file:
                source = file.read()
        if isinstance(source, str) and source.lstrip().startswith("{"):
            text = source.encode()
            folder = None if directory is None else os.fsencode(directory)
            self.library.call("model_create", text, len(text), folder, structs, len(arrays), ctypes.byref(self._handle))
        else:
            self.library.call("model_create_from_file", os.fsencode(source), ctypes.byref(self._handle))
        self.layout = _new(Layout)
        """Sizes: dimension, nodes, parameters, dofs, state_size, symmetric_tangent, multipliers, friction, augmentable; needs (see Need) and instruction_set."""
        self._call("model_layout", self.layout)

    def __del__(self):
        if getattr(self, "_handle", None):
            self.library.c.ents_model_destroy(ctypes.byref(self._handle), None)

    def _call(self, name, *arguments):
        return self.library.call(name, self._handle, *arguments)

    def state_init(self, count):
        """[count][state_size]: states of elements without history."""
        state = np.zeros((count, self.layout.state_size))
        self._call("state_init", count, state, self.layout.state_size)
        return state

    def state_augment(self, state_begin, state_end):
        """Uzawa's step: multipliers of `state_end` into `state_begin` (an array of state_init), in its place."""
        size = self.layout.state_size
        _array("state_begin", state_begin, (None, size))
        end = _array("state_end", state_end, (len(state_begin), size))
        if not (state_begin.flags.c_contiguous and state_begin.dtype == np.float64):
            raise Error(Status.BAD_VALUE, "state_begin: give the array that state_init made, it is changed in its place")
        self._call("state_augment", len(end), state_begin, size, end, size)

    def state_transfer(self, old_master, new_master, state, old_surface_coordinates=None, new_surface_coordinates=None):
        """A slave moves on to another segment: its `state` [state_size] as seen from there. Masters [m][d] at the begin of the increment, surface
        coordinates [m][d-1]. Returns (status, moved): status 0, or recoverable (cut the step)."""
        lay = self.layout
        segments = [_array(name, value, (lay.nodes, lay.dimension)) for name, value in (("old_master", old_master), ("new_master", new_master))]
        coordinates = [None if value is None else _array(name, value, (lay.nodes, lay.dimension - 1)) for name, value in (
            ("old_surface_coordinates", old_surface_coordinates), ("new_surface_coordinates", new_surface_coordinates))]
        state, moved = _array("state", state, (lay.state_size,)), np.zeros(lay.state_size)
        report = self._call("state_transfer", *(x for pair in zip(segments, coordinates) for x in pair), state, moved)
        return report.status, moved

    def evaluate(self, slave, master=None, want="residual tangent", *, tree=None, segment=None, surface_coordinates=None, start=None,
                 area=None, state=None, multiplier=None, first=0, count=None, out=None):
        """Contact elements, one slave node and one segment each.

        slave      [n][d]; master [n][m][d], or [m][d]: the same for all. Or `tree` (Tree) and `segment` [n] (never -1) of its detect
        want       names of QUANTITIES, as one string or a list
        surface_coordinates [m][d-1], start [d-1], area [], state [state_size] (begin of the increment), multiplier [multipliers]: one for
                   all, or with a leading [n]. A number for start, state or multiplier is that of all their entries
        first, count  evaluates a range of the n (threads that share `out`)
        out        the result of a former call with the same n and `want`, filled again; new arrays else

        Returns {name: array [n]...} and "status" [n] (0, or recoverable: nothing else is written for that element), "step_factor", "message": those
        of this call's range. Where ranges share `out`, the last call's are left in it: look at "status".
        """
        slave = _array("slave", slave, (None, self.layout.dimension))
        given, block = self._input(slave, tree, segment, master=master, surface_coordinates=surface_coordinates, start=start, area=area,
                                   state_begin=state, multiplier=multiplier)
        result, block_out = self._output(len(slave), want, out)
        report = self._call("evaluate", first, len(slave) - first if count is None else count, block, block_out)
        result.update(step_factor=report.step_factor, message=report.message.decode())
        return result

    def assemble(self, system, slave, tree, segment, want="", *, start=None, area=None, state=None, multiplier=None):
        """Residual and tangent are added to `system` (System), by the library. slave [n][d]: positions of the slave points; tree and segment [n]
        as detect gives them (-1: open); the rest as for evaluate. Returns what evaluate does, for all n elements. After an error or a
        recoverable status the system holds a part of the sum."""
        slave = _array("slave", slave, (None, self.layout.dimension))
        given, block = self._input(slave, tree, segment, start=start, area=area, state_begin=state, multiplier=multiplier)
        result, block_out = self._output(len(slave), want, None)
        report = self._call("assemble", 0, len(slave), block, block_out, system._struct(self, tree, len(slave)))
        result.update(step_factor=report.step_factor, message=report.message.decode())
        return result

    def _input(self, slave, tree, segment, **inputs):
        """ents_input, and the arrays that it points to."""
        lay = self.layout
        d, m, n = lay.dimension, lay.nodes, len(slave)
        given = {"slave": slave}
        block = _new(Input, slave=slave.ctypes.data, slave_stride=d)
        shapes = {"master": (m, d), "surface_coordinates": (m, d - 1), "start": (d - 1,), "area": (), "state_begin": (lay.state_size,),
                  "multiplier": (lay.multipliers,)}
        for name, value in inputs.items():
            if value is None:
                continue
            shape = shapes[name]
            number = np.ndim(value) == 0 and len(shape) < 2  # of all elements and all entries
            shared = number or np.ndim(value) == len(shape)
            given[name] = np.full(shape, value, np.float64) if number else _array(name, value, shape if shared else (n, *shape))
            setattr(block, name, given[name].ctypes.data)
            setattr(block, name + "_stride", 0 if shared else int(np.prod(shape)))
        if tree is not None:
            given["segment"] = _array("segment", segment, (n,), np.int64)
            block.mesh, block.segment, block.segment_stride = ctypes.addressof(tree.mesh), given["segment"].ctypes.data, 1
        return given, block

    def _output(self, n, want, out):
        """ents_output, and the arrays that it points to: new ones, or those of `out`."""
        lay = self.layout
        d, dofs, own = lay.dimension, lay.dofs, lay.dofs - lay.multipliers
        names = want.split() if isinstance(want, str) else list(want)
        unknown = [name for name in names if name not in QUANTITIES]
        if unknown:
            raise Error(Status.BAD_MASK, f"want: there is no {', '.join(unknown)}; take some of {', '.join(QUANTITIES)}")
        shapes = {"xi": (d - 1,), "normal": (d,), "point": (d,), "traction": (d,), "gap_gradient": (own,), "gap_hessian": (own, own),
                  "xi_gradient": (d - 1, own), "xi_hessian": (d - 1, own, own), "residual": (dofs,), "tangent": (dofs, dofs),
                  "state_end": (lay.state_size,)}
        result = {} if out is None else out

        def target(name, shape, dtype):
            """Address of the quantity's array, a new one or that of `out`. The library's matrices are column-major: seen from Python, transposed."""
            turned = name in ("tangent", "gap_hessian", "xi_hessian")
            if out is None:
                array = np.zeros((n, *shape), dtype)
                result[name] = np.swapaxes(array, -1, -2) if turned else array
            array = result.get(name)
            memory = np.swapaxes(array, -1, -2) if turned and np.ndim(array) > 1 else array
            if not isinstance(array, np.ndarray) or array.shape != (n, *shape) or array.dtype != dtype or not memory.flags.c_contiguous:
                raise Error(Status.BAD_COUNT, f"out: {name} is not that of a result for {n} elements and the same `want`")
            return array.ctypes.data

        block_out = _new(Output, wanted=sum(QUANTITIES[name] for name in set(names)), status=target("status", (), np.int32), status_stride=1)
        for name, kind in _STRIDED:
            if name in names:
                shape = shapes.get(name, ())
                setattr(block_out, name, target(name, shape, np.int32 if kind == "i" else np.float64))
                setattr(block_out, name + "_stride", int(np.prod(shape)))
        return result, block_out

    def blocks(self, slave, tree, segment, slave_equations, master_equations, rows, multiplier_equations=None, want="", **inputs):
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
        closed = np.flatnonzero(segment >= 0)
        if lay.multipliers and len(closed) < len(segment):
            raise Error(Status.BAD_VALUE, "segment: an element with multiplier dofs needs a segment, open ones too (their equation: multiplier = 0)")
        own = {name: np.asarray(value)[closed] if np.ndim(value) and len(value) == len(slave) else value for name, value in inputs.items()}
        result = self.evaluate(slave[closed], None, f"residual tangent {want}", tree=tree, segment=segment[closed], **own)
        parts = [_array("slave_equations", slave_equations, (len(slave), lay.dimension), np.int64)[closed]]
        if lay.dofs - lay.multipliers > lay.dimension:
            of_nodes = _array("master_equations", master_equations, (tree.mesh.nodes, lay.dimension), np.int64)
            parts.append(of_nodes[tree.connectivity[segment[closed]]].reshape(len(closed), lay.nodes * lay.dimension))
        if lay.multipliers:
            parts.append(_array("multiplier_equations", multiplier_equations, (len(slave), lay.multipliers), np.int64)[closed])
        equations = np.concatenate(parts, axis=1)
        residual = np.zeros(rows)
        kept = equations >= 0
        np.add.at(residual, equations[kept], result["residual"][kept])
        i, j = np.broadcast_arrays(equations[:, :, None], equations[:, None, :])
        kept = (i >= 0) & (j >= 0) & (result["tangent"] != 0)
        result["closed"] = closed
        return residual, (result["tangent"][kept], (i[kept], j[kept])), result

    def surface(self, master, xi, surface_coordinates=None):
        """Points of one enriched segment, for pictures: master [m][d], xi [n][d-1]. Returns dict: point, normal, height, base_point, base_normal."""
        d = self.layout.dimension
        master, xi = _array("master", master, (self.layout.nodes, d)), _array("xi", xi, (None, d - 1))
        if surface_coordinates is not None:
            surface_coordinates = _array("surface_coordinates", surface_coordinates, (self.layout.nodes, d - 1))
        out = {name: np.zeros(len(xi) if name == "height" else (len(xi), d)) for name in "point normal height base_point base_normal".split()}
        self._call("surface_evaluate", len(xi), _new(
            Surface, master=master.ctypes.data, surface_coordinates=_address(surface_coordinates), xi=xi.ctypes.data,
            **{name: array.ctypes.data for name, array in out.items()}))
        return out


class Tree:
    """A master surface of many segments, and detection on it.

    connectivity [segments][m], positions [nodes][d] (current), surface_coordinates [segments][m][d-1] or None (the model's own, else s = xi)
    """

    def __init__(self, model, connectivity, positions, surface_coordinates=None):
        lay = model.layout
        self.model = model
        self.connectivity = _array("connectivity", connectivity, (None, lay.nodes), np.int64).copy()
        self.positions = _array("positions", positions, (None, lay.dimension)).copy()
        self.surface_coordinates = None if surface_coordinates is None else _array(
            "surface_coordinates", surface_coordinates, (len(self.connectivity), lay.nodes, lay.dimension - 1)).copy()
        self.mesh = _new(MasterMesh, segments=len(self.connectivity), connectivity=self.connectivity.ctypes.data, nodes=len(self.positions),
                         positions=self.positions.ctypes.data, surface_coordinates=_address(self.surface_coordinates))
        size = ctypes.c_int64()
        model._call("tree_size", len(self.connectivity), ctypes.byref(size))
        self._tree = np.zeros(size.value)
        model._call("tree_build", self.mesh, self._tree, len(self._tree))

    def move(self, positions):
        """New current positions [nodes][d]. No other thread may be using the tree."""
        self.positions[:] = _array("positions", positions, self.positions.shape)
        self.model._call("tree_refit", self.mesh, self._tree, len(self._tree))

    def detect(self, slave, reach, segment=None, xi=None):
        """Which segment is each slave [n][d] projected on, with |gap| <= reach? segment [n], xi [n][d-1]: the answers of before, which
        are kept where they still hold. Returns new arrays: segment (-1: none), xi, gap, flags (Flag), other (an equally good one, or -1)."""
        lay = self.model.layout
        slave = _array("slave", slave, (None, lay.dimension))
        n = len(slave)
        out = {"segment": np.full(n, -1, np.int64) if segment is None else _array("segment", segment, (n,), np.int64).copy(),
               "xi": np.zeros((n, lay.dimension - 1)) if xi is None else _array("xi", xi, (n, lay.dimension - 1)).copy(),
               "gap": np.zeros(n), "flags": np.zeros(n, np.int32), "other": np.full(n, -1, np.int64)}
        self.model._call("detect", self.mesh, self._tree, len(self._tree), 0, n, _new(
            Detection, slave=slave.ctypes.data, reach=reach, **{name: array.ctypes.data for name, array in out.items()}))
        return out

    def state_transfer(self, state, old, new, positions=None):
        """States [n][state_size] of the begin of the increment, there on the segments `old` [n], as their slaves see them from the segments `new` [n].
        -1 on either side: no history. positions [nodes][d]: those at the begin of the increment (default: the present ones).
        Returns (status, states); status is the first that is not 0 (recoverable: cut the step)."""
        model = self.model
        state = _array("state", state, (None, model.layout.state_size))
        old, new = (_array(name, value, (len(state),), np.int64) for name, value in (("old", old), ("new", new)))
        positions = self.positions if positions is None else _array("positions", positions, self.positions.shape)
        moved = np.where(((old >= 0) & (new >= 0))[:, None], state, model.state_init(len(state)))
        first = 0
        for k in np.flatnonzero((old >= 0) & (new >= 0) & (old != new)):
            s = (None, None) if self.surface_coordinates is None else self.surface_coordinates[[old[k], new[k]]]
            status, one = model.state_transfer(positions[self.connectivity[old[k]]], positions[self.connectivity[new[k]]], state[k], *s)
            if status == 0:
                moved[k] = one
            first = first or status
        return first, moved

    def check(self, reach=0.0, kink=0.0, samples=0):
        """Is the enrichment admissible on this surface? (ents_surface_check; reach [L] and kink [rad] are bounds that only the caller knows.)
        Returns dict: "admissible"; for each of CONDITIONS a dict with "judged", "violated", "value", "bound", "missing", and where: "segment", "xi", "point",
        "other", "other_xi"; "violations" [segments]: bits 1 << place in CONDITIONS; "height_min", "height_max", "samples"."""
        d = self.model.layout.dimension
        violations = np.zeros(len(self.connectivity), np.int64)
        c = _new(SurfaceCheck, samples=samples, reach=reach, kink=kink, violations=violations.ctypes.data)
        report = self.model._call("surface_check", self.mesh, c)
        if report.status:
            raise Error(Status(report.status), report.message.decode(), report.element)
        result = {"admissible": c.violated == 0, "violations": violations, "height_min": c.height_min, "height_max": c.height_max, "samples": c.samples}
        for i, name in enumerate(CONDITIONS):
            result[name] = {"judged": bool(c.judged >> i & 1), "violated": bool(c.violated >> i & 1), "value": c.value[i], "bound": c.bound[i],
                            "missing": c.missing[i], "segment": c.segment[i], "xi": list(c.xi[i])[:d - 1], "point": list(c.point[i])[:d],
                            "other": c.other[i], "other_xi": list(c.other_xi[i])[:d - 1]}
        return result


class System:
    """The equations of a host, which Model.assemble adds to.

    slave_equations  [nodes][d] row of each dof, -1: prescribed, left out; master_equations the same of the master's nodes (None: a rigid master)
    matrix           compressed rows with sorted columns that has a place for every entry: scipy.sparse.csr_matrix, or what has its indptr,
                     indices and data; None: no tangent is wanted
    rows             number of rows, if there is no matrix
    slave, master    combinations (begin, nodes, weights) if slave points or master nodes are not the host's nodes: sampling_points, smooth
    multiplier_equations [n][multipliers]

    .residual [rows] and .matrix.data are added to: set them to zero before each assembly. Where the entries of each element lie is remembered: assign
    another matrix, other indptr and indices or other equations, instead of writing into those that are there (equations are copied and
    cannot be written to).
    """

    def __init__(self, slave_equations, master_equations, matrix=None, rows=None, slave=None, master=None, multiplier_equations=None):
        self.slave_equations, self.master_equations, self.multiplier_equations = slave_equations, master_equations, multiplier_equations
        self.matrix = matrix
        if matrix is None and rows is None:
            raise Error(Status.NULL_ARGUMENT, "rows: say how many there are, or give a matrix")
        self.residual = np.zeros(len(matrix.indptr) - 1 if matrix is not None else rows)
        self._combinations = [None if points is None else _combination(points) for points in (slave, master)]
        self._places, self._places_of = None, ()

    def __setattr__(self, name, value):
        if name.endswith("_equations") and value is not None:
            value = _array(name, value, (None, None), np.int64).copy()
            value.setflags(write=False)
        super().__setattr__(name, value)

    def _struct(self, model, tree, elements):
        lay = model.layout
        slave, master = (None if points is None else ctypes.addressof(points) for points in self._combinations)
        out = _new(SystemOfHost, slave=slave, master=master, slave_nodes=len(self.slave_equations), slave_equations=self.slave_equations.ctypes.data,
                   rows=len(self.residual), residual=self.residual.ctypes.data, index_size=8)
        if self.slave_equations.shape[1] != lay.dimension:
            raise Error(Status.BAD_COUNT, f"slave_equations: wanted are {lay.dimension} of each node")
        if self.master_equations is not None:
            if self.master_equations.shape[1] != lay.dimension:
                raise Error(Status.BAD_COUNT, f"master_equations: wanted are {lay.dimension} of each node")
            out.master_nodes, out.master_equations = len(self.master_equations), self.master_equations.ctypes.data
        if lay.multipliers and self.multiplier_equations is not None:
            _array("multiplier_equations", self.multiplier_equations, (elements, lay.multipliers), np.int64)
            out.multiplier_equations = self.multiplier_equations.ctypes.data
        if not (isinstance(self.residual, np.ndarray) and self.residual.dtype == np.float64 and self.residual.flags.c_contiguous):
            raise Error(Status.BAD_VALUE, "residual: wanted is a contiguous array of float64")
        if self.matrix is None:
            return out
        begin, columns, values = self.matrix.indptr, self.matrix.indices, self.matrix.data
        if begin.dtype != columns.dtype or begin.dtype not in (np.int32, np.int64) or values.dtype != np.float64 or len(columns) != len(values):
            raise Error(Status.BAD_VALUE, "matrix: wanted are indptr and indices of one integer type and data of float64")
        if not all(array.flags.c_contiguous for array in (begin, columns, values)):
            raise Error(Status.BAD_VALUE, "matrix: indptr, indices and data must be contiguous")
        if len(begin) != len(self.residual) + 1 or begin[-1] > len(columns):
            raise Error(Status.BAD_COUNT, f"matrix: indptr and indices are not those of {len(self.residual)} rows, which the residual has")
        if slave is None and master is None:  # remembers where the entries of each element are
            size = lay.dimension * (lay.nodes + 1) ** 2 + 1
            of = begin, columns, tree, self.slave_equations, self.master_equations  # kept: another object is never at the same address
            if self._places is None or self._places.shape != (elements, size) or any(a is not b for a, b in zip(of, self._places_of)):
                self._places, self._places_of = np.zeros((elements, size), np.int64), of
            out.places, out.places_size = self._places.ctypes.data, size
        out.index_size, out.row_begin, out.columns, out.values = begin.itemsize, begin.ctypes.data, columns.ctypes.data, values.ctypes.data
        return out
