# SPDX-License-Identifier: BSD-3-Clause
"""Arguments of the library: structs that know their size, contiguous arrays of the right shape, and errors that name the argument."""
import ctypes

import numpy as np

from ._structs import Combination, Status


class Error(RuntimeError):
    """A mistake of the caller or of the installation: .status (see Status), .element (-1: none), and the message of the report."""

    def __init__(self, status, message, element=-1):
        super().__init__(message)
        self.status, self.element = status, element


class CutStep(Error):
    """The step is too large: take `step_factor` of it, from the last commit(). Nothing has changed."""

    def __init__(self, status, message, element, step_factor):
        super().__init__(status, message, element)
        self.step_factor = step_factor


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
