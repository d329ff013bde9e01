# SPDX-License-Identifier: BSD-3-Clause
"""libents.so, loaded, and its functions that need no model."""
import ctypes
import ctypes.util
import os
import pathlib

import numpy as np

from ._arrays import Error, _array, _combination, _new
from ._structs import CONTRACT_MAJOR, CONTRACT_MINOR, ENDS_STRAIGHT, FUNCTIONS, Report, Status


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

    def tributary_areas(self, facet, connectivity, positions, thickness=1.0):
        """Areas [nodes] of the slave nodes of facets ("line2", "quad4" ...): connectivity [facets][nodes], positions [nodes][d]."""
        connectivity = _array("connectivity", connectivity, (None, None), np.int64)
        positions = _array("positions", positions, (None, 2 if facet.startswith("line") else 3))
        areas = np.zeros(len(positions))
        self.call("tributary_areas", facet.encode(), len(connectivity), connectivity, len(positions), positions,
                  thickness, areas)
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
