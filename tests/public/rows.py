# SPDX-License-Identifier: BSD-3-Clause
"""Rows: what went wrong elsewhere, or a target that others publish; its source; the right value; and the function that computes ours."""
import numpy as np

class NotHere(Exception):
    """A program that a row needs is not built: the row is not run."""


ROWS = {}    # name -> Row, in the order in which they are defined


class Row:
    def __init__(self, kind, name, what, source, right, function):
        self.kind, self.name, self.group, self.function = kind, name, function.__module__, function
        self.cells = what, source, right  # of README.md


class Checks:
    """What a row's function compares. Each call keeps (quantity, right, ours, error, tolerance, good)."""

    def __init__(self, programs):
        self.programs, self.found, self.missing = programs, [], ""

    def near(self, quantity, right, ours, tolerance, own=None):
        """Every number of ours is right to `tolerance` (absolute). own: what ccx's own contact has, for the table alone."""
        right, ours = np.asarray(right, float), np.asarray(ours, float)
        error = np.abs(ours - right) if ours.size else np.array(np.nan)
        worst = int(np.argmax(np.where(np.isnan(error), np.inf, error)))
        pick = lambda values: np.broadcast_to(values, error.shape).ravel()[worst]
        self.found.append((quantity, _text(pick(right)), _text(pick(ours)) + ("" if own is None else f" (ccx's own contact: {own:.7g})"), error.ravel()[worst], tolerance, bool(error.ravel()[worst] <= tolerance)))

    def true(self, quantity, right, ours, good):
        """A statement instead of a number."""
        self.found.append((quantity, right, ours, None, None, bool(good)))


def _text(value):
    return f"{value:.7g}"


def row(name, *, wrong, source, right):
    """Decorator of a function of Checks: a mistake of another code. The row's group is its module."""
    return _kept("mistake", name, wrong, source, right)


def target(name, *, case, source, right):
    """The same: a value that others publish."""
    return _kept("target", name, case, source, right)


def _kept(kind, name, what, source, right):
    def keep(function):
        ROWS[name] = Row(kind, name, what, source, right, function)
        return function
    return keep
