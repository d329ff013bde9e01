# SPDX-License-Identifier: BSD-3-Clause
"""Warnings of heights that can be read and are hardly meant: a header among the numbers, a list of points, absolute heights, another unit."""
from __future__ import annotations

import pathlib
import re
import warnings
from typing import Any, Iterator

import numpy as np

from ._arrays import Error, _plain

LARGEST_FILE = 2 ** 24  # bytes that are read a second time to be looked at


def _parts(height: Any) -> Iterator[dict]:
    """The heights of a height, itself among them."""
    if isinstance(height, dict):
        yield height
        below = height.get("of", [])
        for part in below if isinstance(below, list) else [below]:
            yield from _parts(part)


def _of_file(name: str, directory: Any) -> Any:
    """The numbers of a file, in any of the separators that the library takes; None where they are not read here."""
    path = pathlib.Path(directory or ".") / name
    try:
        if path.stat().st_size > LARGEST_FILE:
            return None
        return np.loadtxt(re.sub("[;,]", " ", path.read_text(encoding="utf-8")).splitlines(), ndmin=2)
    except (OSError, ValueError):
        return None


def _map(part: dict, data: dict, directory: Any) -> Any:
    """Name and values [rows][columns] of a height map, or None."""
    name, file = part.get("data"), part.get("file")
    values = data.get(name) if isinstance(name, str) else part.get("values")
    try:
        values = None if values is None else np.asarray(_plain("values", values), float)
    except Error:
        return None
    if isinstance(file, str):
        name, values = file, _of_file(file, directory)
    return None if values is None or not values.size else (f'height map "{name}"' if name else "height map", np.atleast_2d(values))


def _warn(text: str) -> None:
    warnings.warn(text, UserWarning, stacklevel=4)


def warn_of_heights(height: Any, data: dict, directory: Any = None) -> None:
    """What can be seen without a mesh."""
    for part in _parts(height):
        missing = [key for key in ("bound", "slope", "curvature") if key not in part]
        if part.get("type") == "callback" and missing:
            _warn(f'the height function "{part.get("name")}" comes without {", ".join(missing)}: each search then samples the whole segment, 100 000 '
                  "calls a slave point instead of some ten. Give the largest |h|, |h_1| and |h_11| as these keys")
        found = _map(part, data, directory)
        if part.get("type") != "map" or found is None:
            continue
        name, values = found
        rows, columns = values.shape
        spread, mean = np.ptp(values), values.mean()
        if rows > 2 and columns > 3 and any((values[0] == first + np.arange(columns)).all() for first in (0, 1)):
            _warn(f"{name}: the first row is {values[0, 0]:g}, {values[0, 1]:g}, {values[0, 2]:g} ...: the numbers of columns, not heights? Leave it out")
        elif columns == 3 and rows > 15 and abs(len(np.unique(values[:, 0])) * len(np.unique(values[:, 1])) / rows - 1) < 0.2:
            _warn(f"{name}: {rows} rows of 3 numbers that look like x, y, z of a grid: give the heights z alone, [samples along s_2][samples along s_1]")
        elif 0 < 10 * spread < abs(mean):
            _warn(f"{name}: heights from {values.min():g} to {values.max():g} lift the whole surface: subtract their mean or their largest one")


def warn_of_size(height: Any, data: dict, directory: Any, size: float, reach: float) -> None:
    """What the mesh tells: `size` is that of the master surface [L]."""
    for part in _parts(height):
        found = _map(part, data, directory)
        if part.get("type") != "map" or found is None or part.get("scale") not in (None, 1) or "length_unit" in part:
            continue
        name, values = found
        if np.ptp(values) > size:
            _warn(f"{name}: heights from {values.min():g} to {values.max():g} on a surface of size {size:g}: are they in the mesh's unit of length? "
                  'Give "scale"')
        elif np.abs(values).min() > reach:
            _warn(f"{name}: heights from {values.min():g} to {values.max():g} are all farther than reach = {reach:g} from the facets: no slave point "
                  "that touches the facets will find the surface")
