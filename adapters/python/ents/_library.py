# SPDX-License-Identifier: BSD-3-Clause
"""libents.so, loaded, and its functions that need no model."""
import ctypes
import ctypes.util
import os
import pathlib
import traceback

import numpy as np

from ._arrays import Error, _array, _combination, _new
from ._structs import CONTRACT_MAJOR, CONTRACT_MINOR, ENDS_STRAIGHT, FUNCTIONS, Area, Report, Status


HEIGHT_FUNCTION = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_void_p, ctypes.c_int32, ctypes.c_int32, ctypes.POINTER(ctypes.c_double),
                                   ctypes.POINTER(ctypes.c_double))
_heights = []  # registered functions: the library keeps their addresses


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

    def __init__(self, path=None):
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

    def version(self):
        return self.c.ents_version().decode()

    def call(self, name, *arguments):
        """ents_`name`(arguments, report). Negative statuses raise; the report comes back."""
        report = _new(Report)
        converted = [int(a) if isinstance(a, np.integer) else ctypes.byref(a) if isinstance(a, ctypes.Structure)
                     else a.ctypes.data if isinstance(a, np.ndarray) else a for a in arguments]
        status = getattr(self.c, "ents_" + name)(*converted, ctypes.byref(report))
        if status < 0:
            raise Error(Status(status) if status in Status._value2member_map_ else status, report.message.decode(), report.element)
        return report

    def register_height(self, name, dimension, function):
        """Register a height function, for models with {"type": "callback", "name": name}; None: forget the name. dimension: surface
        coordinates, 1 or 2. function(order, s): order is 2 or 3, s [dimension][count] are points; it returns h and its derivatives up to
        the order, [numbers][count], in the order h, h_1, h_11, h_111 or h, h_1, h_2, h_11, h_12, h_22, h_111, h_112, h_122, h_222, or
        None where it is not defined. An exception counts as not defined and is printed. The function is kept for good: models call it
        as long as they live. Threads that evaluate such a model take turns."""
        if function is None:
            self.call("height_register", name.encode(), dimension, None, None)
            return

        def called(_, order, count, s, jet):
            try:
                numbers = function(order, np.ctypeslib.as_array(s, (dimension, count)))
                if numbers is None:
                    return 1
                np.ctypeslib.as_array(jet, (order + 1 if dimension == 1 else (order + 1) * (order + 2) // 2, count))[:] = numbers
                return 0
            except Exception:  # noqa: B902: nothing may pass through the library
                traceback.print_exc()
                return 1

        kept = HEIGHT_FUNCTION(called)
        self.call("height_register", name.encode(), dimension, ctypes.cast(kept, ctypes.c_void_p), None)
        _heights.append(kept)

    def tributary_areas(self, facet, connectivity, positions, thickness=1.0):
        """Areas [nodes] of the slave nodes of facets ("line2", "quad4" ...): connectivity [facets][nodes], positions [nodes][d]."""
        connectivity = _array("connectivity", connectivity, (None, None), np.int64)
        positions = _array("positions", positions, (None, 2 if facet.startswith("line") else 3))
        areas = np.zeros(len(positions))
        self.call("tributary_areas", facet.encode(), len(connectivity), connectivity, len(positions), positions,
                  thickness, areas)
        return areas

    def contact_area(self, facet, connectivity, positions, gap, pressure, modulus=0.0, thickness=1.0):
        """Area in contact and peak pressure from gap and pressure [nodes] of slave facets ("line2", "tri3", "quad4"): a dict with surface, counted,
        border_corrected, zero_line, estimate, error, peak_pressure, peak_drop. `modulus` is E / (1 - nu^2); without it there is no zero_line."""
        connectivity = _array("connectivity", connectivity, (None, None), np.int64)
        positions = _array("positions", positions, (None, 2 if facet.startswith("line") else 3))
        gap, pressure = (_array(name, array, (len(positions),)) for name, array in (("gap", gap), ("pressure", pressure)))
        area = _new(Area)
        self.call("contact_area", facet.encode(), len(connectivity), connectivity, len(positions), positions, thickness, gap, pressure, modulus, area)
        return {name: getattr(area, name) for name, _ in Area._fields_[2:]}

    def sampling_points(self, facet, per_direction, connectivity, positions, thickness=1.0):
        """Points inside slave facets, that see a texture between the nodes: combinations of the nodes (begin [points + 1], nodes, weights), as of
        `smooth`, and their areas [points]. Lines have `per_direction` points, triangles and quadrilaterals its square."""
        connectivity = _array("connectivity", connectivity, (None, None), np.int64)
        line = facet.startswith("line")
        positions = _array("positions", positions, (None, 2 if line else 3))
        points = len(connectivity) * max(per_direction, 0) ** (1 if line else 2)
        begin, areas = np.zeros(points + 1, np.int64), np.zeros(points)
        of, weights = np.zeros(points * connectivity.shape[1], np.int64), np.zeros(points * connectivity.shape[1])
        self.call("sampling_points", facet.encode(), per_direction, len(connectivity), connectivity, len(positions), positions, thickness, begin,
                  of, weights, areas)
        return (begin, of, weights), areas

    def smooth(self, facet, basis, connectivity, nodes, ends=ENDS_STRAIGHT):
        """A smoothed master surface over facets, "line2" with basis "bspline4", say (table in ents.h): segments [facets][m] of control points,
        and those as combinations of the `nodes` nodes: (begin [points + 1], nodes, weights), which is scipy.sparse.csr_matrix((weights, nodes, begin))."""
        connectivity = _array("connectivity", connectivity, (None, None), np.int64)
        head = (facet.encode(), basis.encode(), ends, len(connectivity), connectivity, *_array("nodes", [nodes], (1,), np.int64))
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
        self.call("combine", _combination(combination), values.shape[1], len(values), values, points)
        return points


_default = None


def library():
    """The library of models that are not told of one; loaded at the first call."""
    global _default
    _default = _default or Library()
    return _default
