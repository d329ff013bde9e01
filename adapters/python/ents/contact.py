# SPDX-License-Identifier: BSD-3-Clause
"""Contact of two surfaces of a finite element program in Python: NumPy arrays in, a residual and a SciPy matrix out."""
import numpy as np

from ._arrays import CutStep, Error, _array
from ._model import Model
from ._structs import ENDS_STRAIGHT, Flag, Status
from ._surface import Tree

FACETS = {(2, 2): "line2", (2, 3): "line3", (3, 3): "tri3", (3, 4): "quad4", (3, 6): "tri6", (3, 8): "quad8", (3, 9): "quad9"}
SMOOTHED = ("catmull_rom4", "bspline4", "catmull_rom16", "bspline16", "bezier15")


class Contact:
    """Contact elements between slave facets and master facets, with search, areas, history and assembly.

        contact = ents.Contact(model, positions, slave, master)
        residual, tangent = contact.update(u)       # in each Newton iteration: add them to those of the bodies
        contact.commit()                            # once the step has converged

    model      ents.Model, dict, JSON text or file name. Its "segment" is the type of the master facets, or a smoothed one over them ("bspline4"
               over two-node facets, say). No "patch"; instead of multipliers as unknowns "augmented" with augment()
    positions  [nodes][d] undeformed positions [L] of the program's nodes
    slave      [facets][2 .. 9] nodes of the facets of the slave surface, in the order of ents.h
    master     [facets][2 .. 9] nodes of the master surface; its normal points at the slave surface ("Segments" in ents.h)
    master_positions     [nodes][d]: the master is no part of the mesh; `master` counts these nodes, and the model is "master": "rigid"
    dofs       [nodes][d] equation of each displacement, -1: none; default: d * node + component
    rows       number of equations; default: the largest of dofs and one
    reach      largest absolute gap [L] at which a slave point is searched for; default: the longest edge of both surfaces
    thickness  2D: area of a length [L]
    sampling   0: slave points are nodes, with their tributary areas; n: n points per direction inside each slave facet
    surface_coordinates  in which the height is given: "x" (3D: "xy", "xz" ...), undeformed coordinates; or an array
               [facets][nodes of a facet][d-1] (not smoothed); default: the model's own, else natural coordinates
    offset     length [L] that is added to the gap, a number or one for each slave point: > 0 a clearance, < 0 a coating; needs "offset": 0 in the
               model's "contact"
    elements   [slave points] bool: those that are assembled; the others belong to another process. Default: all
    ends       smoothed masters: ENDS_STRAIGHT or ENDS_REPEATED, see ents.h

    After update(), for each slave point: .gap [L] (nan: nothing within reach), .pressure [F/A], .traction (friction) [d], .flags (see Flag), .segment (-1: none),
    .points [d]; and .areas, .state (of the end of the increment). .residual [rows], .tangent (csr_matrix) are those of the last update.
    """

    def __init__(self, model, positions, slave, master, *, master_positions=None, dofs=None, rows=None, reach=None, thickness=1.0, sampling=0,
                 surface_coordinates=None, offset=None, elements=None, ends=ENDS_STRAIGHT):
        import scipy.sparse as sparse
        self._sparse = sparse
        self.model = model = model if isinstance(model, Model) else Model(model)
        d, library = model.layout.dimension, model.library
        if model.patch:
            raise Error(Status.BAD_VALUE, 'model: leave out "patch": ents.Contact finds the segment of each slave point among all master facets')
        if model.layout.multipliers:
            raise Error(Status.BAD_VALUE, 'model: ents.Contact has no multipliers as unknowns; write the normal law "augmented", which keeps them in '
                        'the state, and call augment() after each solve until the penetration is small enough')
        self.positions = _array("positions", positions, (None, d))
        nodes = len(self.positions)
        self.dofs = np.arange(d * nodes).reshape(nodes, d) if dofs is None else _array("dofs", dofs, (nodes, d), np.int64)
        self.rows = int(self.dofs.max()) + 1 if rows is None else rows
        slave, slave_type = _facets("slave", slave, nodes, d)
        moved = self.positions if master_positions is None else _array("master_positions", master_positions, (None, d)).copy()
        master, master_type = _facets("master", master, len(moved), d)
        self.rigid = model.layout.dofs == d
        if master_positions is not None and not self.rigid:
            raise Error(Status.BAD_VALUE, 'master_positions: a master that is no part of the mesh cannot deform; write "master": "rigid" in the model')
        self._own = moved if master_positions is not None else None

        # Slave points as combinations of nodes, and their areas.
        if sampling:
            (begin, of, weights), self.areas = library.sampling_points(slave_type, sampling, slave, self.positions, thickness)
            self._slave = sparse.csr_matrix((weights, of, begin), (len(begin) - 1, nodes))
        else:
            used = np.unique(slave)
            self.areas = library.tributary_areas(slave_type, slave, self.positions, thickness)[used]
            self._slave = sparse.csr_matrix((np.ones(len(used)), (np.arange(len(used)), used)), (len(used), nodes))
        # Nodes of the segments as combinations of nodes.
        self._master, segments, per_node = sparse.identity(len(moved), format="csr"), master, None
        if model.segment in SMOOTHED:
            segments, (begin, of, weights) = library.smooth(master_type, model.segment, master, len(moved), ends)
            self._master = sparse.csr_matrix((weights, of, begin), (len(begin) - 1, len(moved)))
        elif model.segment != master_type:
            raise Error(Status.BAD_VALUE, f'model: "segment" is {model.segment}, the master facets are {master_type} or {" or ".join(SMOOTHED)} over them')
        start = self._master @ moved
        if isinstance(surface_coordinates, str):
            if len(surface_coordinates) != d - 1 or not set(surface_coordinates) <= set("xyz"[:d]):
                raise Error(Status.BAD_VALUE, f'surface_coordinates: "{surface_coordinates}"; wanted are {d - 1} of {", ".join("xyz"[:d])}')
            per_node = start[:, ["xyz".index(axis) for axis in surface_coordinates]]
            surface_coordinates = per_node[segments]
        elif surface_coordinates is not None and model.segment in SMOOTHED:
            raise Error(Status.BAD_VALUE, 'surface_coordinates: of a smoothed master they are undeformed coordinates; give "x", say')
        self.tree = Tree(model, segments, start, surface_coordinates)
        self.reach = reach or max(_longest_edge(self.positions, slave), _longest_edge(moved, master))

        # Displacements of slave points and segment nodes from the vector of unknowns: also how forces go back.
        flat = np.flatnonzero(self.dofs.ravel() >= 0)
        unknowns = sparse.csr_matrix((np.ones(len(flat)), (flat, self.dofs.ravel()[flat])), (nodes * d, self.rows))
        wide = lambda points: sparse.kron(points, sparse.identity(d), "csr")
        parts = [wide(self._slave) @ unknowns] + ([] if self.rigid else [wide(self._master) @ unknowns])
        self._spread = sparse.vstack(parts, "csr")
        count = len(self.areas)
        self._elements = np.ones(count, bool) if elements is None else _array("elements", elements, (count,), bool)
        self._own_values = None
        if offset is not None:
            self._own_values = np.ones((count, model.layout.slave_values))
            self._own_values[:, 0] = _array("offset", np.broadcast_to(np.asarray(offset, float), (count,)), (count,))
        self._slave_rows = np.arange(count * d).reshape(count, d)
        self._master_rows = None if self.rigid else count * d + np.arange(len(start) * d).reshape(len(start), d)

        self.segment, self._xi = np.full(count, -1, np.int64), np.zeros((count, d - 1))
        self.state = self._state_begin = model.state_init(count)
        self._segment_begin, self._tree_begin, self._pending = self.segment, self.tree.positions.copy(), None
        self.residual, self.tangent = np.zeros(self.rows), sparse.csr_matrix((self.rows, self.rows))

    def move(self, master_positions):
        """New positions [nodes][d] of a master that is no part of the mesh; used by the next update()."""
        if self._own is None:
            raise Error(Status.BAD_VALUE, "move: this master is a part of the mesh, it moves with u")
        self._own = _array("master_positions", master_positions, self._own.shape).copy()

    def update(self, u):
        """Search and assemble at the displacements u: [rows], or [nodes][d] where some are no unknowns. Returns residual [rows] (internal force,
        to be added to that of the bodies) and tangent (csr_matrix). CutStep: take a smaller step; nothing has changed."""
        model, d = self.model, self.model.layout.dimension
        u = np.asarray(u, float)
        if u.shape == (self.rows,):
            u = np.where(self.dofs >= 0, u[self.dofs], 0.0)
        now = self.positions + _array("u", u, self.positions.shape)
        points = self._slave @ now
        self.tree.move(self._master @ (now if self._own is None else self._own))
        # A closed point is followed; an open one is searched anew, for it may have moved over another flank.
        found = self.tree.detect(points, self.reach, self.segment, self._xi, Flag.LEFT | Flag.BEHIND_EDGE)
        lost = np.flatnonzero(self._elements & (found["flags"] & Flag.BEHIND_EDGE != 0))
        if len(lost):
            raise CutStep(Status.NO_PROJECTION, f"slave point {lost[0]} lies behind a concave edge of the master: take a smaller step, widen "
                          '"border" in the model, or smooth the master', int(lost[0]), 0.5)
        # A point that was closed and is now nowhere within reach has opened, or it is too deep to be found.
        gone = np.flatnonzero(self._elements & (self.segment >= 0) & (found["segment"] < 0))
        if len(gone):
            gap = self.tree.detect(points[gone], 10 * self.reach)["gap"]
            if gap.min() < -self.reach:
                k = int(gap.argmin())
                raise CutStep(Status.DEEP_PENETRATION, f"slave point {gone[k]} penetrates by {-gap[k]:.6g}, more than reach = {self.reach:.6g}: take a "
                              "smaller step, or give a larger reach", int(gone[k]), min(0.5, self.reach / -gap[k]))
        left = np.flatnonzero(self._elements & (found["flags"] & Flag.LEFT != 0))
        if len(left):
            raise CutStep(Status.NO_PROJECTION, f"slave point {left[0]} was in contact and lies beside all segments of the master now: take a smaller "
                          "step, or let the master reach farther", int(left[0]), 0.5)
        segment = np.where(self._elements, found["segment"], -1)
        status, state = self.tree.state_transfer(self._state_begin, self._segment_begin, segment, self._tree_begin)
        want = "state_end gap pressure flags" + (" traction" if model.layout.friction else "")
        if status:
            raise CutStep(status, "the history of a slave point cannot move to its new segment: take a smaller step", -1, 0.5)
        r, (values, places), result = model.blocks(points, self.tree, segment, self._slave_rows, self._master_rows, self._spread.shape[0], want=want,
                                                   area=self.areas, start=found["xi"], state=state, slave_values=self._own_values)
        bad = np.flatnonzero(result["status"])
        if len(bad):
            raise CutStep(Status(result["status"][bad[0]]), result["message"], int(result["closed"][bad[0]]), result["step_factor"])
        self.residual = self._spread.T @ r
        matrix = self._sparse.coo_matrix((values, places), (len(r), len(r))).tocsr()
        self.tangent = (self._spread.T @ matrix @ self._spread).tocsr()
        count, on = len(points), result["closed"]
        self.points, self.gap, self.pressure, self.flags = points, np.full(count, np.nan), np.zeros(count), np.zeros(count, np.int32)
        self.traction = np.zeros((count, d))
        for name in ("gap", "pressure", "flags") + (("traction",) if model.layout.friction else ()):
            getattr(self, name)[on] = result[name]
        self.state = model.state_opened(state)
        self.state[on] = result["state_end"]
        self._pending = segment, self.tree.positions.copy()
        self.segment, self._xi = np.where(self.flags & Flag.CONTACT, segment, -1), found["xi"]
        return self.residual, self.tangent

    def commit(self):
        """The last update() is the end of the increment, and the begin of the next one."""
        if self._pending is None:
            raise Error(Status.BAD_STATE, "commit: update(u) comes first")
        self._segment_begin, self._tree_begin = self._pending
        self._state_begin = self.state.copy()

    def augment(self):
        """Uzawa's step of a model with "augmented": takes the multipliers of the last update() over; then solve the increment again."""
        if not self.model.layout.augmentable:
            raise Error(Status.BAD_VALUE, 'augment: the model\'s normal law is not "augmented"')
        status, begin = self.tree.state_transfer(self._state_begin, self._segment_begin, self._pending[0], self._tree_begin)
        if status:
            raise CutStep(status, "the history of a slave point cannot move to its new segment: take a smaller step", -1, 0.5)
        self.model.state_augment(begin, self.state)
        self._state_begin, self._segment_begin, self._tree_begin = begin, self._pending[0], self._tree_begin

    def plot(self, axes=None):
        """The contact pressure on the slave points with matplotlib, and in 2D the enriched master and the points. Returns the axes."""
        import matplotlib.pyplot as plt
        d = self.model.layout.dimension
        axes = axes or plt.figure().add_subplot()
        if d == 3:
            drawn = axes.scatter(*self.points[:, :2].T, c=np.where(self.pressure > 0, self.pressure, np.nan), s=12)
            axes.figure.colorbar(drawn, label="contact pressure")
            axes.set(xlabel="x", ylabel="y", aspect="equal")
            return axes
        xi = np.linspace(-1, 1, max(9, 800 // len(self.tree.connectivity)))[:, None]
        for number, nodes in enumerate(self.tree.connectivity):
            s = self.tree.surface_coordinates
            line = self.model.surface(self.tree.positions[nodes], xi, None if s is None else s[number])["point"]
            axes.plot(*line.T, "k-", lw=1, label=None if number else "enriched master")
        axes.plot(*self.points.T, ".", label="slave points")
        axes.set(xlabel="x", ylabel="y")
        right = axes.twinx()
        order = np.argsort(self.points[:, 0])
        right.plot(self.points[order, 0], self.pressure[order], "C3-", lw=1, label="contact pressure")
        right.set_ylabel("contact pressure", color="C3")
        axes.legend(loc="best")
        return axes


def _facets(name, facets, nodes, d):
    facets = _array(name, facets, (None, None), np.int64)
    if (d, facets.shape[1]) not in FACETS:
        raise Error(Status.BAD_COUNT, f"{name}: facets of {facets.shape[1]} nodes in {d}D; there are {', '.join(FACETS[key] for key in FACETS if key[0] == d)}")
    if facets.size and not (0 <= facets.min() and facets.max() < nodes):
        raise Error(Status.BAD_VALUE, f"{name}: node {facets.max() if facets.max() >= nodes else facets.min()} does not exist; there are {nodes}, from 0")
    return facets, FACETS[d, facets.shape[1]]


def _longest_edge(positions, facets):
    corners = facets[:, :2] if positions.shape[1] == 2 else facets[:, :3 if facets.shape[1] in (3, 6) else 4]
    return max(np.linalg.norm(positions[corners] - positions[np.roll(corners, 1, axis=1)], axis=2).max(), 0.0)
