# SPDX-License-Identifier: BSD-3-Clause
"""The two surfaces of a contact: slave points with their areas, segments with their nodes, each as combinations of the program's nodes."""
from __future__ import annotations

from typing import Any, Optional, Sequence

import numpy as np

from ._arrays import Error, Raised, _array, _count
from ._model import Model
from ._sides import INSIDE, area_vectors, longest_edge, read_facets, refuse_crossed, reversed_pair, without_area
from ._structs import Status

SMOOTHED = {"catmull_rom4": (1, 2), "bspline4": (1, 2), "catmull_rom16": (5, 6, 10, 9), "bspline16": (5, 6, 10, 9), "bezier15": (0, 1, 2)}
"""Smoothed bases, and the points of a segment near the corners of its facet."""


def slave_model(model: Model, height: Any) -> Optional[Model]:
    """The model with the height of a slave surface from the argument slave_height: a dict, or a Model."""
    if height is None:
        return None
    d = model.layout.dimension
    if isinstance(height, Model):
        surface = height
    else:
        surface = Model({"segment": "line2" if d == 2 else "quad4", "height": height}, model._data, model._directory, model.library)
        if surface.layout.fields:  # nothing is lost yet
            surface.bind({name: surface.field_init(name) for name in surface._field_points})
    if surface.layout.dimension != d:
        raise Error(Status.BAD_VALUE, f"slave_height: it is of a surface in {surface.layout.dimension}D, the model is in {d}D")
    return surface


def axes_of(name: str, axes: str, positions: np.ndarray) -> np.ndarray:
    """[nodes][d-1] components of the positions, as surface coordinates."""
    d = positions.shape[1]
    if len(axes) != d - 1 or not set(axes) <= set("xyz"[:d]):
        raise Error(Status.BAD_VALUE, f'{name}: "{axes}"; wanted are {d - 1} of {", ".join("xyz"[:d])}')
    return positions[:, ["xyz".index(axis) for axis in axes]]


class SlavePoints:
    """Slave points: nodes (`nodes` [points]), or points inside the facets (`nodes` None). `matrix` [points][nodes] makes them of the nodes; `raised`:
    they lie above their facets."""

    raised: Optional[Raised] = None
    surface: Optional[Model] = None
    """of the height"""
    coordinates: Optional[np.ndarray] = None
    """[entries of matrix][d-1] of the height; None: natural ones"""

    def __init__(self, model: Model, positions: np.ndarray, slave: Any, sampling: Optional[int], thickness: float, order: str) -> None:
        import scipy.sparse as sparse
        d, library, count = positions.shape[1], model.library, len(positions)
        groups = read_facets("slave", slave, count, d, order)
        refuse_crossed("slave", positions, groups)
        self.groups = groups = without_area("slave", positions, groups, refuse=False)
        if not (isinstance(thickness, (int, float, np.number)) and 0 <= thickness < 1e100):
            raise Error(Status.BAD_VALUE, f"thickness is {thickness!r}: give a length, or 0 for axisymmetric bodies")
        inside = [group.shape for group in groups if group.shape in INSIDE]
        default = sampling is None
        self.sampling = sampling = _count("sampling", (2 if inside else 0) if default else sampling, 0, 64)
        if not sampling and inside:
            raise Error(Status.BAD_VALUE, f"sampling: 0 puts the slave points on the nodes of {inside[0]} facets, and no positive areas of nodes give the forces of a "
                        "constant pressure there (at the corners they are 0 or point outwards): pressure 0 to 1.2 for 1. Leave it out, or write sampling=2")
        self.longest_edge = longest_edge(positions, groups)
        if sampling:
            parts, self.nodes = [], None
            for shape, nodes, numbers in groups:
                (begin, of, weights), areas = _three_points(nodes, positions) if default and shape == "tri6" else library.sampling_points(
                    shape, sampling, nodes, positions, thickness)
                parts.append((sparse.csr_matrix((weights, of, begin), (len(areas), count)), areas, np.repeat(numbers, len(areas) // len(nodes))))
            numbers = np.concatenate([part[2] for part in parts])
            place = np.argsort(numbers, kind="stable")  # the caller's order of facets
            self.matrix, self.areas = sparse.vstack([part[0] for part in parts], "csr")[place], np.concatenate([part[1] for part in parts])[place]
            of_facet = np.searchsorted(self._numbers(), numbers[place]), np.arange(len(numbers))
        else:
            self.nodes = np.unique(np.concatenate([group.nodes.ravel() for group in groups]))
            self.areas = sum(library.tributary_areas(shape, nodes, positions, thickness) for shape, nodes, _ in groups)[self.nodes]
            self.matrix = sparse.csr_matrix((np.ones(len(self.nodes)), (np.arange(len(self.nodes)), self.nodes)), (len(self.nodes), count))
            facet = [np.repeat(np.searchsorted(self._numbers(), group.numbers), group.nodes.shape[1]) for group in groups]
            of_facet = np.concatenate(facet), np.searchsorted(self.nodes, np.concatenate([group.nodes.ravel() for group in groups]))
        self._facets_of = sparse.csr_matrix((np.ones(len(of_facet[0])), of_facet[::-1]), (len(self.areas), len(self._numbers())))

    def _numbers(self) -> np.ndarray:
        return np.sort(np.concatenate([group.numbers for group in self.groups]))

    def raise_by(self, surface: Optional[Model], given: Any, positions: np.ndarray) -> None:
        """The points lie above their facets by the height of the model `surface`, in surface coordinates as MasterSurface.coordinates takes them, or
        [nodes][d-1]; without a model they do not."""
        if surface is None:
            if given is not None:
                raise Error(Status.BAD_VALUE, "slave_surface_coordinates is given, but slave_height is not")
            return
        d = positions.shape[1]
        if isinstance(given, str):
            given = axes_of("slave_surface_coordinates", given, positions)
        if given is not None:
            given = _array("slave_surface_coordinates", given, (len(positions), d - 1))[self.matrix.indices]
        self.surface, self.coordinates = surface, given
        self.raise_again()

    def raise_again(self) -> None:
        """The height has changed."""
        self.raised = self.surface.library.raise_points(self.surface, self.flat(), self.coordinates)

    def flat(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The points in their facets, as combinations of the nodes."""
        return self.matrix.indptr, self.matrix.indices, self.matrix.data

    def parts(self, numbers: np.ndarray) -> Any:
        """These points as a combination of the nodes."""
        matrix = self.matrix[numbers]
        if self.raised is None:
            return matrix.indptr, matrix.indices, matrix.data
        first = self.matrix.indptr[numbers]
        entries = np.arange(matrix.nnz) + np.repeat(first - matrix.indptr[:-1], np.diff(matrix.indptr))
        return Raised(matrix.indptr, matrix.indices, matrix.data, self.raised.heights[numbers], self.raised.slopes[entries])

    def facet_of_points(self) -> np.ndarray:
        """[points] a facet (place in the caller's list) on which each point lies."""
        return self._numbers()[self._facets_of.indices[self._facets_of.indptr[:-1]]]

    def at(self, now: np.ndarray) -> np.ndarray:
        """[points][d] at the positions `now` [nodes][d]."""
        if self.raised is not None:
            return self.surface.library.combine(self.raised, now)
        return now[self.nodes] if self.nodes is not None else self.matrix @ now

    def normals(self, now: np.ndarray, points: np.ndarray) -> np.ndarray:
        """[points][d] outward unit normals, as the order of the facets says."""
        vectors, places = np.zeros((self._facets_of.shape[1], now.shape[1])), self._numbers()
        for group in self.groups:
            vectors[np.searchsorted(places, group.numbers)] = area_vectors(now, group)
        return _unit(self._facets_of[points] @ vectors)


def _three_points(nodes: np.ndarray, positions: np.ndarray) -> tuple[tuple, np.ndarray]:
    """Points inside tri6 facets that give all nodes their exact shares of a constant pressure: Gauss's rule of three points. The
    centroids of library.sampling_points integrate linear functions exactly, and tri6 has quadratic ones."""
    corner = np.where(np.eye(3) > 0, 2 / 3, 1 / 6)  # lambda at the points
    shape = np.hstack([corner * (2 * corner - 1), 4 * corner * np.roll(corner, -1, axis=1)])
    slope = np.zeros((3, 6, 3))  # by lambda
    for i in range(3):
        slope[:, i, i] = 4 * corner[:, i] - 1
        slope[:, 3 + i, i], slope[:, 3 + i, (i + 1) % 3] = 4 * corner[:, (i + 1) % 3], 4 * corner[:, i]
    tangents = np.einsum("pna,fnk->fpak", slope[:, :, 1:] - slope[:, :, :1], positions[nodes])
    areas = np.linalg.norm(np.cross(tangents[:, :, 0], tangents[:, :, 1]), axis=2) / 6
    begin = np.arange(3 * len(nodes) + 1) * 6
    return (begin, np.repeat(nodes, 3, axis=0).ravel(), np.tile(shape, (len(nodes), 1)).ravel()), areas.ravel()


class MasterSurface:
    """Segments [facets][m] over points that are combinations `matrix` of the nodes; of the nodes and their mirror images with planes of symmetry."""

    def __init__(self, model: Model, positions: np.ndarray, master: Any, ends: int, mirror: Sequence, order: str,
                 kept: Optional[int] = None) -> None:
        """kept: the first facets, which become segments; the others are there for smoothing alone. Default: all."""
        import scipy.sparse as sparse
        self.smoothed, self.segment, count, d = model.segment in SMOOTHED, model.segment, *positions.shape
        groups = read_facets("master", master, count, d, order)
        refuse_crossed("master", positions, groups)
        self.groups = groups = without_area("master", positions, groups, refuse=True)
        pair = reversed_pair(groups)
        if pair is not None:
            raise Error(Status.BAD_VALUE, f"master: the neighbours {pair[0]} and {pair[1]} are not oriented alike: reverse the nodes of the one whose normal points "
                        "into the body", pair[1])
        self.longest_edge = longest_edge(positions, groups)
        nodes, shape = self._one_shape(model, groups)
        self._images = _Images(positions, nodes, mirror if self.smoothed else _none(mirror))
        if self.smoothed:
            all_nodes = count + len(self._images.source)
            segments, (begin, of, weights) = model.library.smooth(shape, model.segment, self._images.facets(nodes), all_nodes, ends)
            self.segments, self.matrix = segments[:len(nodes)][:kept], sparse.csr_matrix((weights, of, begin), (len(begin) - 1, all_nodes))
        else:
            self.segments, self.matrix = nodes, sparse.identity(count, format="csr")
            # The library takes the motion of a surface from all of its nodes: other nodes of the program's stand where some of the surface are.
            used = np.unique(nodes)
            self._others = np.setdiff1d(np.arange(count), used)
            self._instead = np.resize(used, len(self._others))
        self.start = self.at(positions)

    @staticmethod
    def _one_shape(model: Model, groups: list) -> tuple[np.ndarray, str]:
        """The facets in the caller's order, as the model's segments take them."""
        shapes = {group.shape for group in groups}
        if shapes <= {"tri3", "quad4"} and model.segment == "quad4" and shapes != {"quad4"}:
            numbers = np.concatenate([group.numbers for group in groups])
            nodes = np.concatenate([group.nodes if group.shape == "quad4" else group.nodes[:, [0, 1, 2, 2]] for group in groups])
            return np.ascontiguousarray(nodes[np.argsort(numbers)]), "quad4"
        if len(shapes) > 1:
            raise Error(Status.BAD_VALUE, f'model: "segment" is {model.segment}, the master has facets {" and ".join(sorted(shapes))}: write "quad4", which takes triangles and '
                        "quadrilaterals of four nodes")
        shape = groups[0].shape
        if model.segment not in SMOOTHED and model.segment != shape:
            raise Error(Status.BAD_VALUE, f'model: "segment" is {model.segment}, the master facets are {shape}: write {shape}, or {" or ".join(SMOOTHED)} over facets '
                        "of two, three or four nodes")
        return groups[0].nodes, shape

    def at(self, now: np.ndarray) -> np.ndarray:
        """[points][d] of the segments at the positions `now` [nodes][d]."""
        if self.smoothed:
            return self.matrix @ self._images.with_images(now)
        now = now.copy()
        now[self._others] = now[self._instead]
        return now

    def scalars(self, of_nodes: np.ndarray) -> np.ndarray:
        """[points] of numbers [nodes] that have no direction."""
        return self.matrix @ np.r_[of_nodes, of_nodes[self._images.source]] if self.smoothed else of_nodes

    def beside(self) -> np.ndarray:
        """[segments][2] the next segments along a line, -1: none. Of surfaces none: they would make matrices three times as large."""
        groups = self.groups
        if not groups[0].shape.startswith("line"):
            return np.zeros((len(self.segments), 0), np.int64)
        ends = groups[0].nodes[:, :2]
        at = np.full((ends.max() + 1, 2), -1, np.int64)  # the segments that begin and end in a node
        at[ends[:, 0], 0] = at[ends[:, 1], 1] = np.arange(len(ends))
        beside = np.column_stack([at[ends[:, 0], 1], at[ends[:, 1], 0]])[:len(self.segments)]
        return np.where(beside < len(self.segments), beside, -1)

    def coordinates(self, given: Any) -> Any:
        """Surface coordinates [segments][m][d-1] from the argument surface_coordinates."""
        if isinstance(given, str):
            return axes_of("surface_coordinates", given, self.start)[self.segments]
        if given is not None and self.smoothed:
            raise Error(Status.BAD_VALUE, 'surface_coordinates: of a smoothed master they are undeformed coordinates; give "x", say')
        return given

    def normals(self, points: np.ndarray, segments: np.ndarray) -> np.ndarray:
        """[n][d] outward unit normals in the middle of these segments, whose points are at `points`."""
        corners = self.segments[segments]
        if self.smoothed:
            corners = corners[:, SMOOTHED[self.segment]]
        x = points[corners[:, :4]]
        if x.shape[2] == 2:
            along = x[:, 1] - x[:, 0]
            return _unit(np.column_stack([-along[:, 1], along[:, 0]]))
        triangle = x.shape[1] == 3 or self.segment == "tri6"
        return _unit(np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]) if triangle else np.cross(x[:, 2] - x[:, 0], x[:, 3] - x[:, 1]))

    # What mirror images add to the equations; nothing without them.
    def equations(self, dofs: np.ndarray, rows: int) -> tuple[np.ndarray, int]:
        """Equations of the nodes and images, and their number: components across a plane are unknowns of their own until `condensed`."""
        return self._images.equations(dofs, rows)

    def widened(self, slave: Any) -> Any:
        """The matrix of slave points with columns for images."""
        slave = slave.copy()
        slave.resize((slave.shape[0], slave.shape[1] + len(self._images.source)))
        return slave

    def condensed(self, residual: np.ndarray, matrix: Optional[tuple]) -> tuple[np.ndarray, Optional[tuple]]:
        """Residual and tangent in the program's equations."""
        return self._images.condensed(residual, matrix)


class _Images:
    """Mirror images of nodes beyond planes of symmetry: image = sign * source + shift."""

    def __init__(self, positions: np.ndarray, facets: np.ndarray, planes: Sequence) -> None:
        d = positions.shape[1]
        self.source, self._sign, self._shift = np.zeros(0, np.int64), np.zeros((0, d)), np.zeros((0, d))
        self._copies: list[np.ndarray] = []
        self._condense, nodes = None, len(positions)
        tolerance, all_facets = 1e-9 * np.ptp(positions[facets.ravel()], axis=0).max(), facets
        for plane in planes:
            try:
                (axis, place), axis = plane, "xyz"[:d].index(plane[0])
                place = float(place)
            except (TypeError, ValueError):
                raise Error(Status.BAD_VALUE, f'mirror: {plane!r}; write planes as [("x", 0.0), ...], with an axis of {", ".join("xyz"[:d])}') from None
            x = self.with_images(positions)
            used = np.unique(all_facets)
            distance = x[used, axis] - place
            if np.abs(distance).min() > tolerance or distance.min() < -tolerance and distance.max() > tolerance:
                raise Error(Status.BAD_VALUE, f"mirror: the plane {'xyz'[axis]} = {place:g} is no border of the master, which lies from {x[used, axis].min():g} to {x[used, axis].max():g}")
            image = np.arange(len(x))
            beyond = used[np.abs(distance) > tolerance]
            image[beyond] = len(x) + np.arange(len(beyond))
            source = np.r_[np.arange(nodes), self.source][beyond]
            sign, shift = (np.vstack([first, then])[beyond] for first, then in ((np.ones((nodes, d)), self._sign), (np.zeros((nodes, d)), self._shift)))
            sign[:, axis] *= -1
            shift[:, axis] = 2 * place - shift[:, axis]
            self.source, self._sign, self._shift = np.r_[self.source, source], np.vstack([self._sign, sign]), np.vstack([self._shift, shift])
            mirrored = image[all_facets]
            self._copies.append(mirrored[:, ::-1] if d == 2 else np.roll(mirrored[:, ::-1], 1, axis=1))
            all_facets = np.vstack([all_facets, self._copies[-1]])

    def with_images(self, now: np.ndarray) -> np.ndarray:
        return np.vstack([now, self._sign * now[self.source] + self._shift]) if len(self.source) else now

    def facets(self, own: np.ndarray) -> np.ndarray:
        return np.vstack([own, *self._copies]) if self._copies else own

    def equations(self, dofs: np.ndarray, rows: int) -> tuple[np.ndarray, int]:
        if not len(self.source):
            return dofs, rows
        import scipy.sparse as sparse
        images = dofs[self.source].copy()
        sign = np.hstack([self._sign, np.ones((len(images), images.shape[1] - self._sign.shape[1]))])  # a temperature has none
        across = (sign < 0) & (images >= 0)
        turned = images[across]
        images[across] = rows + np.arange(len(turned))
        self._condense = sparse.vstack([sparse.identity(rows), sparse.csr_matrix((-np.ones(len(turned)), (np.arange(len(turned)), turned)), (len(turned), rows))], "csr")
        return np.vstack([dofs, images]), rows + len(turned)

    def condensed(self, residual: np.ndarray, matrix: Optional[tuple]) -> tuple[np.ndarray, Optional[tuple]]:
        if self._condense is None:
            return residual, matrix
        import scipy.sparse as sparse
        full = None if matrix is None else (self._condense.T @ sparse.csr_matrix(matrix, (len(residual),) * 2) @ self._condense).tocsr()
        if full is not None:
            full.sort_indices()
        return self._condense.T @ residual, None if full is None else (full.data, full.indices, full.indptr)


def _none(mirror: Sequence) -> Sequence:
    if len(mirror):
        raise Error(Status.BAD_VALUE, "mirror: it is for smoothed masters; plain facets need no neighbours beyond a plane of symmetry")
    return ()


def _unit(vectors: np.ndarray) -> np.ndarray:
    with np.errstate(over="ignore"):  # of an iterate beyond all bounds, whose step is cut
        return vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-300)
