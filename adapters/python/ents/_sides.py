# SPDX-License-Identifier: BSD-3-Clause
"""The facets of a slave or a master surface as a mesh has them: shapes, order of nodes, orientation, normals."""
from __future__ import annotations

import warnings
from typing import Any, NamedTuple

import numpy as np

from ._arrays import Error, _array
from ._structs import Status

FACETS = {(2, 2): "line2", (2, 3): "line3", (3, 3): "tri3", (3, 4): "quad4", (3, 6): "tri6", (3, 8): "quad8", (3, 9): "quad9"}
CORNERS = {"line2": 2, "line3": 2, "tri3": 3, "tri6": 3, "quad4": 4, "quad8": 4, "quad9": 4}
INSIDE = ("quad8", "tri6")  # nodal forces of a constant pressure are not all positive: points inside the facets


class Facets(NamedTuple):
    """Facets of one shape among those of a surface."""
    shape: str
    nodes: np.ndarray
    """[facets][nodes]"""
    numbers: np.ndarray
    """[facets] their places in the caller's list"""


def read_facets(name: str, facets: Any, nodes: int, d: int, order: str) -> list[Facets]:
    """The caller's facets by shape. A quadrilateral that names one node twice is a triangle."""
    by_length: dict[int, list] = {}
    if isinstance(facets, np.ndarray) and facets.dtype != object:
        array = _array(name, facets, (None, None), np.int64)
        by_length[array.shape[1]] = [array, np.arange(len(array))]
    else:
        try:
            lengths = np.array([len(facet) for facet in facets], int)
        except TypeError:
            raise Error(Status.BAD_COUNT, f"{name}: wanted is a list of facets, each a list of its nodes") from None
        for length in np.unique(lengths):
            numbers = np.flatnonzero(lengths == length)
            try:
                array = _array(name, [facets[k] for k in numbers], (None, length), np.int64)
            except Error as error:
                raise error if len(numbers) == len(lengths) else Error(error.status, f"{error} (among the facets of {length} nodes)") from None
            by_length[int(length)] = [array, numbers]
    if not sum(len(numbers) for _, numbers in by_length.values()):
        raise Error(Status.BAD_COUNT, f"{name}: there are no facets")
    groups = []
    for length, (array, numbers) in by_length.items():
        if (d, length) not in FACETS:
            raise Error(Status.BAD_COUNT, f"{name}: facets of {length} nodes in {d}D; there are {', '.join(FACETS[key] for key in FACETS if key[0] == d)}")
        if not (0 <= array.min() and array.max() < nodes):
            raise Error(Status.BAD_VALUE, f"{name}: node {array.max() if array.max() >= nodes else array.min()} does not exist; there are {nodes}, from 0")
        if order == "tensor":
            if length not in (2, 3, 4) or (d, length) == (2, 3):
                raise Error(Status.BAD_VALUE, f'{name}: order="tensor" is for facets of 2, 3 and 4 nodes, these have {length}: put them into the order of ents.h')
            array = array[:, [0, 1, 3, 2]] if length == 4 else array
        groups += _without_doubles(name, Facets(FACETS[d, length], array, numbers))
    return groups


def _without_doubles(name: str, facets: Facets) -> list[Facets]:
    """Quadrilaterals with a doubled corner are triangles; every other doubled node is a mistake."""
    shape, nodes, numbers = facets
    ordered = np.sort(nodes, axis=1)
    doubles = (ordered[:, 1:] == ordered[:, :-1]).sum(axis=1)
    if not doubles.any():
        return [facets]
    beside = nodes == np.roll(nodes, -1, axis=1)
    triangle = (doubles == 1) & (beside.sum(axis=1) == 1) if shape == "quad4" else np.zeros(len(nodes), bool)
    wrong = np.flatnonzero((doubles > 0) & ~triangle)
    if len(wrong):
        raise Error(Status.DEGENERATE_SEGMENT, f"{name}: facet {numbers[wrong[0]]} is {nodes[wrong[0]].tolist()}: it names a node twice", int(numbers[wrong[0]]))
    three = nodes[triangle][~beside[triangle]].reshape(-1, 3)
    parts = [Facets(shape, nodes[~triangle], numbers[~triangle]), Facets("tri3", three, numbers[triangle])]
    return [part for part in parts if len(part.nodes)]


def area_vectors(positions: np.ndarray, facets: Facets) -> np.ndarray:
    """[facets][d]: normal times area (of the polygon of the corners); in 2D times length."""
    x = positions[facets.nodes[:, :CORNERS[facets.shape]]]
    if x.shape[2] == 2:
        along = x[:, 1] - x[:, 0]
        return np.column_stack([-along[:, 1], along[:, 0]])
    return 0.5 * np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]) if x.shape[1] == 3 else 0.5 * np.cross(x[:, 2] - x[:, 0], x[:, 3] - x[:, 1])


def longest_edge(positions: np.ndarray, groups: list[Facets]) -> float:
    """[L]"""
    longest = 0.0
    for shape, nodes, _ in groups:
        corners = nodes[:, :CORNERS[shape]]
        longest = max(longest, np.linalg.norm(positions[corners] - positions[np.roll(corners, 1, axis=1)], axis=2).max())
    return longest


def refuse_crossed(name: str, positions: np.ndarray, groups: list[Facets]) -> None:
    """Quadrilaterals whose sides cross: corners in rows instead of around the facet."""
    for shape, nodes, numbers in groups:
        if CORNERS[shape] != 4:
            continue
        x = positions[nodes[:, :4]]
        normal = np.cross(np.roll(x, -1, axis=1) - x, np.roll(x, 1, axis=1) - x)  # at each corner
        crossed = np.flatnonzero((np.einsum("fci,fi->fc", normal, normal[:, 0]) < 0).sum(axis=1) == 2)
        if len(crossed):
            k = crossed[0]
            a, b, c, e = nodes[k, :4].tolist()
            raise Error(Status.DEGENERATE_SEGMENT, f"{name}: the sides of facet {numbers[k]}, [{a}, {b}, {c}, {e}], cross ({len(crossed)} such facets): corners "
                        f'are wanted around the facet, [{a}, {b}, {e}, {c}]. For corners in rows, as dolfinx, basix and deal.II have them, write order="tensor"',
                        int(numbers[k]))


def without_area(name: str, positions: np.ndarray, groups: list[Facets], refuse: bool) -> list[Facets]:
    """Facets without area are named: of a master refused, of a slave left out (they carry nothing)."""
    kept = []
    for facets in groups:
        corners = positions[facets.nodes[:, :CORNERS[facets.shape]]]
        size = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
        flat = np.linalg.norm(area_vectors(positions, facets), axis=1) <= 1e-13 * size ** (positions.shape[1] - 1) + 1e-300
        if flat.any():
            number = int(facets.numbers[flat][0])
            text = f"{name}: facet {number}, {facets.nodes[flat][0].tolist()}, has no area ({flat.sum()} such facets)"
            if refuse or flat.all() and len(groups) == 1:
                raise Error(Status.DEGENERATE_SEGMENT, f"{text}: leave it out", number)
            warnings.warn(f"{text}: left out, it carries no force", UserWarning, stacklevel=4)
            facets = Facets(facets.shape, facets.nodes[~flat], facets.numbers[~flat])
        if len(facets.nodes):
            kept.append(facets)
    return kept


def reversed_pair(groups: list[Facets]) -> tuple[int, int] | None:
    """Two neighbouring facets that are not oriented alike, or None. Neighbours share an end (2D) or an edge (3D) that no third facet has."""
    ends, facet = [], []
    for shape, nodes, numbers in groups:
        corners = CORNERS[shape]
        if corners == 2:
            ends.append(np.column_stack([nodes[:, :2].ravel(), np.tile([0, 1], len(nodes)), np.zeros(2 * len(nodes), int)]))
            facet.append(np.repeat(numbers, 2))
            continue
        a, b = nodes[:, :corners], np.roll(nodes[:, :corners], -1, axis=1)
        ends.append(np.column_stack([np.minimum(a, b).ravel(), np.maximum(a, b).ravel(), (a < b).ravel()]))
        facet.append(np.repeat(numbers, corners))
    ends, facet = np.concatenate(ends), np.concatenate(facet)
    if groups[0].shape.startswith("line"):
        key, side = ends[:, 0], ends[:, 1]
    else:
        key, side = ends[:, 0] * (ends[:, 1].max() + 1) + ends[:, 1], ends[:, 2]
    order = np.argsort(key, kind="stable")
    key, side, facet = key[order], side[order], facet[order]
    begin = np.flatnonzero(np.r_[True, key[1:] != key[:-1]])
    pairs = begin[np.diff(np.r_[begin, len(key)]) == 2]
    wrong = pairs[side[pairs] == side[pairs + 1]]
    return (int(facet[wrong[0]]), int(facet[wrong[0] + 1])) if len(wrong) else None


def _sorted_corners(side: list[Facets]) -> tuple[np.ndarray, np.ndarray]:
    corners = [np.sort(group.nodes[:, :CORNERS[group.shape]], axis=1) for group in side]
    return (np.concatenate([np.pad(rows, ((0, 0), (0, 4 - rows.shape[1])), constant_values=-1) for rows in corners]),
            np.concatenate([group.numbers for group in side]))


def same_facets(slave: list[Facets], master: list[Facets]) -> bool:
    """Are the facets of both sides the same, in any order?"""
    (ours, _), (theirs, _) = _sorted_corners(slave), _sorted_corners(master)
    rows = lambda array: array[np.lexsort(array.T)]
    return ours.shape == theirs.shape and bool((rows(ours) == rows(theirs)).all())


def refuse_shared(slave: list[Facets], master: list[Facets]) -> None:
    """Some facets that are on both sides, and some that are not."""
    (ours, numbers), (theirs, _) = _sorted_corners(slave), _sorted_corners(master)
    candidates = np.isin(ours, theirs).all(axis=1)  # most slave facets have no node of the master
    known = set(map(tuple, theirs[np.isin(theirs, ours[candidates]).all(axis=1)].tolist())) if candidates.any() else set()
    shared = [int(k) for facet, k in zip(ours[candidates].tolist(), numbers[candidates]) if tuple(facet) in known]
    if shared:
        raise Error(Status.BAD_VALUE, f"slave: {len(shared)} of the facets are master facets, too (slave facet {min(shared)} first), and others are not. For a surface in "
                    "contact with itself give the same facets as slave and as master, all of them (without comm); else a facet belongs to one side", min(shared))
