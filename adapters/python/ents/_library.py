# SPDX-License-Identifier: BSD-3-Clause
"""libents.so, loaded, and its functions that need no model."""
from __future__ import annotations

import ctypes
import ctypes.util
import math
import os
import pathlib
import threading
from typing import Any, Callable, Optional, Sequence, Tuple, Union

import numpy as np

from ._arrays import CutStep, Error, Raised, _array, _combination, _count, _new
from ._structs import CONTRACT_MAJOR, CONTRACT_MINOR, ENDS_STRAIGHT, FUNCTIONS, Area, Mirror, Report, Resultants, Status, Suggestion

Combined = Tuple[np.ndarray, ...]  # begin, nodes, weights; with planes of symmetry also reflected, shifts
FACET_NODES = {"line2": 2, "line3": 3, "tri3": 3, "tri6": 6, "quad4": 4, "quad8": 8, "quad9": 9}

HEIGHT_FUNCTION = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_void_p, ctypes.c_int32, ctypes.c_int32, ctypes.POINTER(ctypes.c_double),
                                   ctypes.POINTER(ctypes.c_double))
_heights = []  # registered functions: the library keeps their addresses
_raised = threading.local()  # .error: what a height function has raised in the present call of this thread; .undefined: how often it was not defined
MOST_UNDEFINED = 1000  # times that a height function may be undefined before it has been defined once in a call


def _installed():
    """The library of a wheel lies in this folder, that of PREFIX/share/ents/python in PREFIX/lib, that of the source tree in build/lib."""
    here = pathlib.Path(__file__).resolve().parent
    files = [here / "libents.so.1"]
    if here.parts[-4:-1] == ("share", "ents", "python"):
        files.append(here.parents[3] / "lib" / "libents.so.1")
    if here.parts[-3:-1] == ("adapters", "python"):
        files.append(here.parents[2] / "build" / "lib" / "libents.so.1")
    return next((file for file in files if file.exists()), None) or ctypes.util.find_library("ents") or "libents.so.1"


class Library:
    """libents.so: `path`, else what the environment's ENTS_LIBRARY names, else the one that is installed with this module, else where the
    system's loader finds it. .path: its file name."""

    def __init__(self, path: Union[str, os.PathLike, None] = None) -> None:
        self.path = os.fspath(path or os.environ.get("ENTS_LIBRARY") or _installed())
        try:
            self.c = ctypes.CDLL(self.path)
        except OSError as error:
            raise Error(Status.FILE, f"{error}: give Library(path), set ENTS_LIBRARY to the file libents.so, or install ents") from None
        self._declare("ents_check_contract")
        self.call("check_contract", CONTRACT_MAJOR, CONTRACT_MINOR)
        for name in FUNCTIONS:  # an older library may lack some
            self._declare(name)

    def _declare(self, name):
        function = getattr(self.c, name)
        function.restype, function.argtypes = FUNCTIONS[name]

    def __repr__(self) -> str:
        return f"<ents.Library {self.version()}: {self.path}>"

    def __reduce__(self) -> tuple:
        return (library, ()) if self is _default else (Library, (self.path,))

    def version(self) -> str:
        return self.c.ents_version().decode()

    def call(self, name: str, *arguments: Any, positive: Optional[type] = CutStep) -> Report:
        """ents_`name`(arguments, report). Negative statuses raise Error, positive ones `positive` (Error or CutStep; None: the caller reads the
        status of the report, which comes back). What a height function has raised during the call is raised."""
        report = _new(Report)
        converted = [int(a) if isinstance(a, np.integer) else ctypes.byref(a) if isinstance(a, ctypes.Structure)
                     else a.ctypes.data if isinstance(a, np.ndarray) else a for a in arguments]
        _raised.error, _raised.undefined = None, 0
        status = getattr(self.c, "ents_" + name)(*converted, ctypes.byref(report))
        error, _raised.error = _raised.error, None
        if error is not None:
            raise error
        if status < 0 or status > 0 and positive is not None:
            known = Status(status) if status in Status._value2member_map_ else status
            message, element = report.message.decode(), report.element
            raise CutStep(known, message, element, report.step_factor) if status > 0 and positive is CutStep else Error(known, message, element)
        return report

    def register_height(self, name: str, dimension: int, function: Optional[Callable[[int, np.ndarray], Any]]) -> None:
        """Register a height function, for models with {"type": "callback", "name": name}; None: forget the name. dimension: surface
        coordinates, 1 or 2. function(order, s): order is 2 or 3, s [dimension][count] are points; it returns h and its derivatives up to
        the order, [numbers][count], in the order h, h_1, h_11, h_111 or h, h_1, h_2, h_11, h_12, h_22, h_111, h_112, h_122, h_222, or
        None, or NaN, where it is not defined (a function that is not defined anywhere raises Error). The call of the library in which the function raises an exception raises that exception. The function
        is kept for good: models call it as long as they live. Threads that evaluate such a model take turns.
        In the model say "bound", "slope" and "curvature" (largest |h|, |h_1|, |h_11|): without them each search samples the whole segment,
        100 000 calls a slave point."""
        dimension = _count("dimension", dimension, 1, 2)
        if function is None:
            self.call("height_register", name.encode(), dimension, None, None)
            return

        def called(_, order, count, s, jet):
            numbers_of_jet = order + 1 if dimension == 1 else (order + 1) * (order + 2) // 2
            if _raised.error is None:
                try:
                    numbers = function(order, np.ctypeslib.as_array(s, (dimension, count)))
                    values = np.ctypeslib.as_array(jet, (numbers_of_jet, count))
                    if numbers is not None:
                        values[:] = numbers
                    if numbers is not None and not np.isnan(values[0]).all():
                        _raised.undefined = -math.inf
                        return 0
                    _raised.undefined += 1
                    if _raised.undefined > MOST_UNDEFINED:
                        raise Error(Status.NO_PROJECTION, f'the height function "{name}" has returned None or NaN, not defined, in its first {MOST_UNDEFINED} '
                                    "calls: does it return h and its derivatives?")
                    return 1
                except BaseException as error:  # noqa: B902: nothing may pass through the library; call() raises it
                    _raised.error = error
            # The results of this call are lost: it ends soonest on a flat surface.
            ctypes.memset(jet, 0, 8 * numbers_of_jet * count)
            return 0

        kept = HEIGHT_FUNCTION(called)
        self.call("height_register", name.encode(), dimension, ctypes.cast(kept, ctypes.c_void_p), None)
        _heights.append(kept)

    @staticmethod
    def _mesh(facet: str, connectivity: Any, positions: Any) -> tuple:
        """Facets and positions, of the shapes that the library reads."""
        if facet not in FACET_NODES:
            raise Error(Status.BAD_VALUE, f"facet: there is no {facet!r}; there are {', '.join(FACET_NODES)}")
        return (_array("connectivity", connectivity, (None, FACET_NODES[facet]), np.int64),
                _array("positions", positions, (None, 2 if facet.startswith("line") else 3)))

    def tributary_areas(self, facet: str, connectivity: Any, positions: Any, thickness: float = 1.0) -> np.ndarray:
        """Areas [nodes] of the slave nodes of facets ("line2", "quad4" ...): connectivity [facets][nodes], positions [nodes][d]. thickness
        (2D): area of a length [L]; 0: axisymmetric, the areas of the full turn about the second axis. A facet without area raises Error (.element)."""
        connectivity, positions = self._mesh(facet, connectivity, positions)
        areas = np.zeros(len(positions))
        self.call("tributary_areas", facet.encode(), len(connectivity), connectivity, len(positions), positions,
                  float(thickness), areas, positive=Error)
        return areas

    def contact_area(self, facet: str, connectivity: Any, positions: Any, gap: Any, pressure: Any, modulus: float = 0.0,
                     thickness: float = 1.0) -> dict[str, float]:
        """Area in contact and peak pressure from gap and pressure [nodes] of slave facets ("line2", "tri3", "quad4"): a dict with surface, counted,
        border_corrected, zero_line, estimate, error, peak_pressure, peak_drop. `modulus` is E / (1 - nu^2); without it there is no zero_line.
        A facet without area raises Error (.element)."""
        connectivity, positions = self._mesh(facet, connectivity, positions)
        gap, pressure = (_array(name, array, (len(positions),)) for name, array in (("gap", gap), ("pressure", pressure)))
        area = _new(Area)
        self.call("contact_area", facet.encode(), len(connectivity), connectivity, len(positions), positions, float(thickness), gap, pressure,
                  float(modulus), area, positive=Error)
        return {name: getattr(area, name) for name, _ in Area._fields_[2:]}

    def contact_resultants(self, points: Any, normal: Any, pressure: Any, areas: Any, flags: Any, traction: Any = None, about: Any = None) -> dict[str, Any]:
        """What a pair carries, as it acts on the slave side, from results of its points: points, normal, traction (on the master; None: no friction) [n][d],
        pressure, areas, flags [n]; about [d]: point of the moment, default the origin. A dict with normal, tangential, centre [d], moment (2D: a
        number, 3D: [3]), area, largest_pressure, deepest (the point that has it, -1: none), open, contact, stick, slip (points)."""
        points = _array("points", points, (None, None))
        n, d = points.shape
        normal = _array("normal", normal, (n, d))
        traction = None if traction is None else _array("traction", traction, (n, d))
        pressure, areas = (_array(name, array, (n,)) for name, array in (("pressure", pressure), ("areas", areas)))
        about = None if about is None else _array("about", about, (d,))
        flags = np.ascontiguousarray(_array("flags", flags, (n,), np.int64), np.int32)
        found = _new(Resultants)
        self.call("contact_resultants", d, n, points, normal, pressure, traction, areas, flags, about, found, positive=Error)
        result: dict[str, Any] = {name: getattr(found, name) for name, _ in Resultants._fields_[2:]}
        for name in ("normal", "tangential", "centre"):
            result[name] = np.array(result[name][:d])
        result["moment"] = result["moment"][0] if d == 2 else np.array(result["moment"])
        return result

    def suggest(self, modulus: float, spacing: float, area: float = 0.0, slave_mass: float = 0.0, master_mass: float = 0.0) -> dict[str, float]:
        """Numbers to begin with, from Young's modulus of the softer body and the distance of the slave points: normal_stiffness of a penalty,
        tangential_stiffness of friction; and time_step, the critical one of an explicit host, where area and masses are given (master_mass 0: rigid)."""
        found = _new(Suggestion)
        self.call("suggest", float(modulus), float(spacing), float(area), float(slave_mass), float(master_mass), found, positive=Error)
        return {name: getattr(found, name) for name, _ in Suggestion._fields_[2:]}

    def sampling_points(self, facet: str, per_direction: int, connectivity: Any, positions: Any, thickness: float = 1.0) -> tuple[Combined, np.ndarray]:
        """Points inside slave facets, that see a texture between the nodes: combinations of the nodes (begin [points + 1], nodes, weights), as of
        `smooth`, and their areas [points]. Lines have `per_direction` (1 .. 64) points, triangles and quadrilaterals its square. A facet
        without area raises Error (.element)."""
        connectivity, positions = self._mesh(facet, connectivity, positions)
        per_direction = _count("per_direction", per_direction, 1, 64)
        points = len(connectivity) * per_direction ** (1 if facet.startswith("line") else 2)
        begin, areas = np.zeros(points + 1, np.int64), np.zeros(points)
        of, weights = np.zeros(points * connectivity.shape[1], np.int64), np.zeros(points * connectivity.shape[1])
        self.call("sampling_points", facet.encode(), per_direction, len(connectivity), connectivity, len(positions), positions, float(thickness),
                  begin, of, weights, areas, positive=Error)
        return (begin, of, weights), areas

    def raise_points(self, surface: Any, points: Combined, coordinates: Any = None) -> Raised:
        """Slave points inside facets, as of `sampling_points`, above them by the "height" of the Model `surface`: x = sum N_i X_i + h n. coordinates
        [len(nodes)][d-1]: surface coordinates of the nodes of each point's facet; default: natural coordinates. The result takes the place
        of the combination in `combine` and System(slave=...)."""
        block = _combination(points)
        begin, of, weights = block.arrays[:3]
        d = surface.layout.dimension
        if coordinates is not None:
            coordinates = _array("coordinates", coordinates, (len(of), d - 1))
        heights, slopes = np.zeros(len(begin) - 1), np.zeros((len(of), d - 1))
        self.call("raise_points", surface._handle, block, coordinates, heights, slopes, positive=Error)
        return Raised(begin, of, weights, heights, slopes)

    def smooth(self, facet: str, basis: str, connectivity: Any, nodes: int, ends: int = ENDS_STRAIGHT, mirror: Sequence = (),
               positions: Any = None) -> tuple[np.ndarray, Combined]:
        """A smoothed master surface over facets, "line2" with basis "bspline4", say (table in ents.h): segments [facets][m] of control points,
        and those as combinations of the `nodes` nodes: (begin [points + 1], nodes, weights), which is scipy.sparse.csr_matrix((weights, nodes, begin)).

        ends    ENDS_STRAIGHT, ENDS_REPEATED; bspline4, bspline16 also ENDS_QUASI_CUBIC, ENDS_QUASI_PARABOLIC: the spline follows the nodes
        mirror  planes of symmetry on which the surface ends, [("x", 0.0), ...]: the axis that is normal to each, its place on it. Needs
                `positions` [nodes][d], undeformed. Combinations are then (begin, nodes, weights, reflected, shifts): bits 1, 2, 4 of
                reflected[j] reverse the components x, y, z of term j, and shifts [points][d] are added"""
        d, call, more = 2 if str(facet).startswith("line") else 3, "smooth", ()
        connectivity, _ = self._mesh(facet, connectivity, np.zeros((0, d)))
        nodes = _count("nodes", nodes)
        head = (facet.encode(), str(basis).encode(), _count("ends", ends, 0, 3), len(connectivity), connectivity, nodes)
        if len(mirror):
            try:
                axes = np.array([list("xyz"[:d]).index(axis) for axis, _ in mirror], np.int32)
                places = np.array([float(place) for _, place in mirror])
            except (TypeError, ValueError):
                raise Error(Status.BAD_VALUE, f'mirror: {mirror!r}; write planes as [("x", 0.0), ...], with an axis of {", ".join("xyz"[:d])}') from None
            if positions is None:
                raise Error(Status.BAD_VALUE, "mirror: needs positions=, the undeformed positions of the nodes, which say what lies on a plane")
            positions = _array("positions", positions, (nodes, d))
            call, head = "smooth_mirrored", (*head, _new(Mirror, planes=len(axes), axes=axes.ctypes.data, places=places.ctypes.data,
                                                         positions=positions.ctypes.data))
        points, terms = ctypes.c_int64(), ctypes.c_int64()
        self.call(call + "_size", *head, ctypes.byref(points), ctypes.byref(terms), positive=Error)
        digits = "".join(c for c in basis if c.isdigit())  # the basis's nodes: bspline4, bezier15
        segments = np.zeros((len(connectivity), int(digits)), np.int64)
        begin, of, weights = np.zeros(points.value + 1, np.int64), np.zeros(terms.value, np.int64), np.zeros(terms.value)
        if len(mirror):
            more = (np.zeros(terms.value, np.int32), np.zeros((points.value, d)))
        self.call(call, *head, points, terms, segments, begin, of, weights, *more, positive=Error)
        return segments, (begin, of, weights, *more)

    def combine(self, combination: Combined, values: Any) -> np.ndarray:
        """What `smooth`, `sampling_points` or `raise_points` gave, applied to values [nodes][1 .. 3] (positions; of the first two surface coordinates, too)."""
        values, block = _array("values", values, (None, None)), _combination(combination)
        if isinstance(combination, Raised):
            if values.shape[1] != combination.slopes.shape[1] + 1:
                raise Error(Status.BAD_COUNT, f"values: {values.shape[1]} numbers per node; points that are raised are made of positions "
                            f"[nodes][{combination.slopes.shape[1] + 1}]")
        elif len(combination) > 3 and values.shape[1] != np.shape(combination[4])[1]:
            raise Error(Status.BAD_COUNT, f"values: {values.shape[1]} numbers per node; images in planes of symmetry are those of positions "
                        f"[nodes][{np.shape(combination[4])[1]}]: take surface coordinates from the points' positions")
        points = np.zeros((block.points, values.shape[1]))
        self.call("combine", block, values.shape[1], len(values), values, points)
        return points


_default: Optional[Library] = None


def library() -> Library:
    """The library of models that are not told of one; loaded at the first call."""
    global _default
    _default = _default or Library()
    return _default
