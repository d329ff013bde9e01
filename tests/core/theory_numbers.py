# SPDX-License-Identifier: BSD-3-Clause
"""Numbers with exact derivatives: a sum over the subsets of e_1 .. e_G, whose squares are zero.

f(x + e_1 v + e_2 w) has the derivative of f along v as its part of e_1, and the second one along v and w as that of e_1 e_2:
the complex step of W. Squire and G. Trapp (SIAM Review 40, 1998), with a unit whose square is 0 in place of -1. There is
no difference, so no step and no truncation. Parts may be complex.

The functions here also take NumPy's arrays, so that a definition is written once for numbers of both kinds."""
import numpy as np


class Nil:
    """c[subset]: the part of a subset of the units, written as bits; each part is an array of any shape."""

    __array_priority__ = 100

    def __init__(self, c):
        self.c = np.asarray(c)

    def part(self, *units):
        return self.c[sum(1 << (unit - 1) for unit in units)]

    def without(self, unit):
        """(value, derivative along this unit) as numbers with the other units."""
        bit = 1 << (unit - 1)
        value, along = np.zeros_like(self.c), np.zeros_like(self.c)
        for subset in range(len(self.c)):
            if not subset & bit:
                value[subset], along[subset] = self.c[subset], self.c[subset | bit]
        return Nil(value), Nil(along)

    def __getitem__(self, key):
        return Nil(self.c[(slice(None), *(key if isinstance(key, tuple) else (key,)))])

    def sum(self, axis):
        return Nil(self.c.sum(axis))  # negative axes only: those of the parts

    def __add__(self, other):
        if isinstance(other, Nil):
            a, b = _aligned(self, other)
            return Nil(a + b)
        c = _with_axes(self.c, np.ndim(other)) + np.zeros(np.shape(other))
        c[0] = c[0] + other
        return Nil(c)

    __radd__ = __add__

    def __neg__(self):
        return Nil(-self.c)

    def __sub__(self, other):
        return self + -other

    def __rsub__(self, other):
        return -self + other

    def __mul__(self, other):
        if not isinstance(other, Nil):
            return Nil(_with_axes(self.c, np.ndim(other)) * other)
        a, b = _aligned(self, other)
        first, second, starts = PRODUCTS[len(a)]
        return Nil(np.add.reduceat(a[first] * b[second], starts, axis=0))

    __rmul__ = __mul__

    def __truediv__(self, other):
        return self * (_power(other, -1.0) if isinstance(other, Nil) else 1.0 / other)

    def __rtruediv__(self, other):
        return _power(self, -1.0) * other

    def __pow__(self, exponent):
        return _power(self, exponent)


def _products(parts):
    """Disjoint subsets i, j whose products are the parts of a product, and where those of each part begin."""
    pairs = sorted((i | j, i, j) for i in range(parts) for j in range(parts) if not i & j)
    return [i for _, i, _ in pairs], [j for _, _, j in pairs], [[k for k, _, _ in pairs].index(k) for k in range(parts)]


PRODUCTS = {1 << units: _products(1 << units) for units in range(5)}


def _with_axes(c, axes):
    """Parts with at least this many axes."""
    more = axes + 1 - c.ndim
    return c if more <= 0 else c.reshape(c.shape[0], *(1,) * more, *c.shape[1:])


def _aligned(x, y):
    """Parts of both for the same units, with as many axes."""
    a, b = _with_axes(x.c, y.c.ndim - 1), _with_axes(y.c, x.c.ndim - 1)
    size = max(len(a), len(b))
    a, b = (c if len(c) == size else np.concatenate([c, np.zeros((size - len(c), *c.shape[1:]))]) for c in (a, b))
    return a, b


def _series(x, derivatives):
    """f(x) from f, f', f'' ... at the value of x."""
    rest = Nil(x.c.copy())
    rest.c[0] = 0.0
    total, power, factorial = Nil(np.zeros_like(x.c)) + derivatives[0], rest, 1.0
    for k, derivative in enumerate(derivatives[1:], 1):
        factorial *= k
        total = total + power * (derivative / factorial)
        power = power * rest
    return total


def _order(x):
    return len(x.c).bit_length() - 1


def _power(x, exponent):
    value, factor, out = x.c[0], 1.0, []
    for k in range(_order(x) + 1):
        out.append(factor * value ** (exponent - k) if factor else 0.0 * value)
        factor *= exponent - k
    return _series(x, out)


def sqrt(x):
    return _power(x, 0.5) if isinstance(x, Nil) else np.sqrt(x)


def exp(x):
    return _series(x, [np.exp(x.c[0])] * (_order(x) + 1)) if isinstance(x, Nil) else np.exp(x)


def sin(x):
    if not isinstance(x, Nil):
        return np.sin(x)
    s, c = np.sin(x.c[0]), np.cos(x.c[0])
    return _series(x, [s, c, -s, -c, s][:_order(x) + 1])


def stack(parts):
    """Numbers side by side along a new last axis."""
    if not any(isinstance(p, Nil) for p in parts):
        return np.stack(np.broadcast_arrays(*parts), -1)
    parts = [p.c if isinstance(p, Nil) else np.asarray(p)[None] for p in parts]
    shape = (max(map(len, parts)), *np.broadcast_shapes(*(p.shape[1:] for p in parts)))
    c = np.zeros((*shape, len(parts)), dtype=np.result_type(*parts))
    for k, p in enumerate(parts):
        c[:len(p), ..., k] = p
    return Nil(c)


def value(x):
    return x.c[0] if isinstance(x, Nil) else x


def dot(a, b):
    return (a * b).sum(-1)


def cross(a, b):
    return stack([a[..., 1] * b[..., 2] - a[..., 2] * b[..., 1], a[..., 2] * b[..., 0] - a[..., 0] * b[..., 2],
                  a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]])


def moved(x, unit, direction, units):
    """x + e_unit direction, of numbers with `units` units."""
    x = x.c if isinstance(x, Nil) else np.asarray(x)[None]
    shape = np.broadcast_shapes(x.shape[1:], np.shape(direction))
    c = np.zeros((1 << units, *shape), dtype=np.result_type(x, direction))
    c[:len(x)] = x
    c[1 << (unit - 1)] += direction
    return Nil(c)
