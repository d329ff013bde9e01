# SPDX-License-Identifier: BSD-3-Clause
"""Arguments of the library: structs that know their size, contiguous arrays of the right shape, and errors that name the argument."""
from __future__ import annotations

import ctypes
import operator
from typing import Any, NamedTuple

import numpy as np

from ._structs import Combination, Status


class Error(RuntimeError):
    """A mistake of the caller or of the installation: .status (see Status), .element (-1: none), and the message of the report."""

    def __init__(self, status: int, message: str, element: int = -1) -> None:
        super().__init__(message)
        self.status, self.element = status, element

    def __reduce__(self) -> tuple:  # a process of a pool sends it to another one
        return type(self), (self.status, str(self), self.element)


class CutStep(Error):
    """The step is too large: take `step_factor` of it, from the last commit(). Nothing has changed."""

    def __init__(self, status: int, message: str, element: int = -1, step_factor: float = 0.5) -> None:
        super().__init__(status, message, element)
        self.step_factor = step_factor

    def __reduce__(self) -> tuple:
        return type(self), (self.status, str(self), self.element, self.step_factor)


def _new(struct, **fields):
    return struct(struct_size=ctypes.sizeof(struct), **fields)


def _address(array):
    return None if array is None else array.ctypes.data


def _place(place) -> str:
    return f"[{', '.join(map(str, place))}]" if len(place) else ""


def _whole(name: str, array: np.ndarray) -> np.ndarray:
    """An array of whole numbers. 2.0 is one; 2.7 is a mistake, which a conversion to integers would hide."""
    if array.dtype.kind in "fu":
        wrong = np.argwhere(~((array < 2.0 ** 63) & (array >= -2.0 ** 63) & (array == np.floor(array))))
        if len(wrong):
            place = tuple(wrong[0])
            raise Error(Status.BAD_VALUE, f"{name}{_place(place)} is {array[place]}: give a whole number")
    return array


def _plain(name: str, value: Any) -> np.ndarray:
    """`value` as an array of numbers: no masked entries, no complex numbers, no texts."""
    if isinstance(value, np.ma.MaskedArray):
        hidden = np.argwhere(np.ma.getmaskarray(value))
        if len(hidden):
            raise Error(Status.NON_FINITE, f"{name}{_place(hidden[0])} is masked ({len(hidden)} entries are): fill in what is not known")
        value = value.data
    try:
        array = np.asarray(value)
    except ValueError as error:  # rows of different lengths
        raise Error(Status.BAD_VALUE, f"{name}: {error}") from None
    if array.dtype.kind not in "fiub":
        try:
            array = array.astype(np.float64) if array.dtype.kind == "O" else None
        except (TypeError, ValueError):
            array = None
        if array is None:
            raise Error(Status.BAD_VALUE, f"{name}: wanted are real numbers, in an array or in lists of equal lengths")
    return array


def _array(name: str, value: Any, shape: tuple, dtype: type = np.float64) -> np.ndarray:
    """`value` as a contiguous array; None in `shape` stands for any size."""
    array = _plain(name, value)
    if dtype is np.int64:
        array = _whole(name, array)
    array = np.ascontiguousarray(array, dtype).reshape(array.shape)
    if array.ndim != len(shape) or any(want not in (None, have) for want, have in zip(shape, array.shape)):
        raise Error(Status.BAD_COUNT, f"{name}: the shape is {array.shape}, wanted is {tuple('n' if s is None else s for s in shape)}")
    return array


def _count(name: str, value: Any, low: int = 0, high: int = 2 ** 40) -> int:
    """`value` as a whole number from `low` to `high`."""
    try:
        number = operator.index(value)
    except TypeError:
        number = int(value) if isinstance(value, (float, np.floating)) and value == np.floor(value) and abs(value) < 2.0 ** 53 else None
    if number is None or not low <= number <= high:
        raise Error(Status.BAD_VALUE, f"{name} is {value!r}: give a whole number from {low} to {high}")
    return number


def _frozen(array: np.ndarray) -> np.ndarray:
    """The array, which nobody can write to from now on."""
    array.setflags(write=False)
    return array


class Raised(NamedTuple):
    """Slave points above their facets, as Library.raise_points makes them: begin [points + 1], nodes and weights of each, heights [points] [L], and
    slopes [len(nodes)][d-1] of the weights."""
    begin: np.ndarray
    nodes: np.ndarray
    weights: np.ndarray
    heights: np.ndarray
    slopes: np.ndarray


def _combination(combination):
    raised = combination if isinstance(combination, Raised) else None
    if raised is not None:
        combination = raised[:3]
    try:
        begin, of, weights, *mirrored = combination
        if len(mirrored) not in (0, 2):
            raise ValueError
    except (TypeError, ValueError):
        raise Error(Status.BAD_VALUE, "combination: wanted are three arrays (begin, nodes, weights), as of smooth and sampling_points, or five with "
                    "reflected and shifts") from None
    begin, of = (_array("combination: " + name, value, (None,), np.int64) for name, value in (("begin", begin), ("nodes", of)))
    weights = _array("combination: weights", weights, of.shape)
    if len(begin) == 0 or begin[0] != 0 or begin[-1] > len(of) or (np.diff(begin) < 0).any():
        raise Error(Status.BAD_VALUE, f"combination: begin goes from 0 to the {len(of)} nodes that there are, and never falls")
    block = _new(Combination, points=len(begin) - 1, begin=begin.ctypes.data, nodes=of.ctypes.data, weights=weights.ctypes.data)
    reflected = shifts = None
    if mirrored:
        reflected = _array("combination: reflected", mirrored[0], of.shape, np.int32)
        shifts = _array("combination: shifts", mirrored[1], (len(begin) - 1, None))
        block.reflected, block.shifts = reflected.ctypes.data, shifts.ctypes.data
    heights = slopes = None
    if raised is not None:
        heights = _array("combination: heights", raised.heights, (len(begin) - 1,))
        slopes = _array("combination: slopes", raised.slopes, (len(of), None))
        block.heights, block.slopes = heights.ctypes.data, slopes.ctypes.data
    block.arrays = begin, of, weights, reflected, shifts, heights, slopes  # they live as long as the addresses
    return block
