# SPDX-License-Identifier: BSD-3-Clause
"""A picture of a contact with matplotlib."""
from __future__ import annotations

from typing import Any

import numpy as np


def plot(contact: Any, axes: Any = None) -> Any:
    """The contact pressure on the slave points, and in 2D the enriched master and the points. Returns the axes."""
    import matplotlib.pyplot as plt
    axes = axes or plt.figure().add_subplot()
    points, pressure, tree = contact.points, contact.pressure, contact.tree
    if points.shape[1] == 3:
        drawn = axes.scatter(*points[:, :2].T, c=np.where(pressure > 0, pressure, np.nan), s=12)
        axes.figure.colorbar(drawn, label="contact pressure")
        axes.set(xlabel="x", ylabel="y", aspect="equal")
        return axes
    xi = np.linspace(-1, 1, max(9, 800 // len(tree.connectivity)))[:, None]
    for number, nodes in enumerate(tree.connectivity):
        s = tree.surface_coordinates
        line = contact.model.surface(tree.positions[nodes], xi, None if s is None else s[number])["point"]
        axes.plot(*line.T, "k-", lw=1, label=None if number else "enriched master")
    axes.plot(*points.T, ".", label="slave points")
    axes.set(xlabel="x", ylabel="y")
    right = axes.twinx()
    order = np.argsort(points[:, 0])
    right.plot(points[order, 0], pressure[order], "C3-", lw=1, label="contact pressure")
    right.set_ylabel("contact pressure", color="C3")
    axes.legend(loc="best")
    return axes
