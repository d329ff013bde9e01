# SPDX-License-Identifier: BSD-3-Clause
"""Contact of two surfaces of a finite element program in Python: NumPy arrays in, a residual and a SciPy matrix out."""
from __future__ import annotations

import copy
import json
import os
from typing import TYPE_CHECKING, Any, Optional, Sequence, Union

import numpy as np

from ._arrays import CutStep, Error, _array, _count, _frozen
from ._both_sides import BothSides, is_one_surface, joined, of_one_surface, of_two_passes, refuse_one_sided
from ._contact_results import ContactResults
from ._heights import warn_of_size
from ._model import Model
from ._rows import Rows
from ._side_pairs import SidePairs, warn_of_deep
from ._structs import ENDS_STRAIGHT, Flag, Need, Status
from ._surface import Tree
from ._surfaces import MasterSurface, SlavePoints, slave_model
from ._temperatures import Temperatures
from ._worn_sides import WornSides

if TYPE_CHECKING:
    import scipy.sparse

BORDER = 0.1
LOST = Flag.LEFT | Flag.BEHIND_EDGE


class Contact(WornSides, ContactResults):
    """Contact elements between slave facets and master facets, with search, areas, history and assembly.

        contact = ents.Contact(model, positions, slave, master)
        residual, tangent = contact.update(u)       # in each Newton iteration: add them to those of the bodies
        contact.commit()                            # once the step has converged

    help(ents.Contact.__init__) explains the arguments.

    After update(), for each slave point: .gap [L] (nan: nothing within reach), .pressure [F/A] (per undeformed area), .traction [d] (friction, as it
    acts on the master), .flags (see Flag), .segment (-1: none), .points [d] (where it is); .state (of the end of the increment); .residual [rows],
    .tangent (csr_matrix) of the last update. Always: .nodes [points] (the node that each slave point is; None with points inside the facets),
    .areas [points], .positions, .dofs, .rows, .reach, .model, .tree.

    The first increment begins in the undeformed configuration (master_positions as they are given here): a point that touches there sticks or slips
    from there on. A point that passes through the master between the begin of an increment and an update() ends it with CutStep.

    Arrays that are given are copied; changing them afterwards has no effect. Arrays that come back are never written to again; those that are
    attributes cannot be written to. A Contact can be pickled, copied (copy.deepcopy) and saved (save, load).
    """

    _kept: Optional[int] = None  # master facets that become segments; all
    _takes_one_surface = True

    def __new__(cls, *arguments: Any, comm: Any = None, **options: Any) -> Any:
        if comm is None:
            return super().__new__(cls)
        if options.pop("two_pass", False):
            raise Error(Status.BAD_VALUE, "two_pass: distributed surfaces have one pass; leave out comm, or two_pass")
        from ._distributed import DistributedContact
        return DistributedContact(*arguments, comm=comm, **options)

    def __init__(self, model: Union[Model, dict, str, os.PathLike], positions: Any, slave: Any, master: Any, *, master_positions: Any = None,
                 dofs: Any = None, rows: Optional[int] = None, reach: Optional[float] = None, thickness: float = 1.0, sampling: Optional[int] = None,
                 surface_coordinates: Any = None, offset: Any = None, elements: Any = None, ends: int = ENDS_STRAIGHT, leave: bool = False,
                 mirror: Sequence = (), order: str = "ring", temperature: Any = None, master_temperature: Any = None, slave_height: Any = None,
                 slave_surface_coordinates: Any = None, two_pass: bool = False, comm: None = None) -> None:
        """Slave points on the facets `slave` against the facets `master`.

        model      dict, JSON text, file name, or ents.Model. Its "segment" is the type of the master facets, or a smoothed one over them ("bspline4"
                   over two-node facets, say). No "patch"; instead of multipliers as unknowns "augmented" with augment(). Where it has no "border",
                   facets reach beyond their edges by 0.1 in their natural coordinates: a point on the edge of flush bodies keeps its contact, and one
                   above a master node keeps its facet. What is bound to an ents.Model is bound here, too
        positions  [nodes][d] undeformed positions [L] of the program's nodes
        slave      [facets][2 .. 9] nodes of the facets of the slave surface, or a list of facets of 3 and 4 nodes. Order as "Segments" in ents.h:
                   in 2D the outside is on the left of the way from the first node to the second; in 3D corners go counter-clockwise, seen from outside
        master     the same of the master surface: its normal points out of its body, at the slave. Triangles among quadrilaterals are segments
                   "quad4" with a doubled node
        master_positions     [nodes][d]: the master is no part of the mesh; `master` counts these nodes, and the model is "master": "rigid". See move()
        dofs       [nodes][d] equation of each displacement, -1: none; default: d * node + component. A model with "heat" has a temperature beside them,
                   [nodes][d + 1]; default: (d + 1) * node + component
        rows       number of equations; default: the largest of dofs and one
        reach      [L] a slave point is searched for up to this distance from the master, on both sides; deeper points are errors.
                   Default: the longest edge of both surfaces
        thickness  2D: area of a length [L]; 0: axisymmetric, areas and forces of the full turn about the second axis. 3D: not read
        sampling   0: slave points are nodes, with their tributary areas; n = 1 .. 64: n points per direction inside each slave facet. Default: 0; where
                   a slave facet is quad8 or tri6, whose corner forces under a constant pressure are negative or 0: 2 (tri6: 3 points); 0 is refused there.
                   A surface in contact with itself: 2, since a node at a corner of a body has the areas of faces that do not touch, too
        surface_coordinates  in which the height is given: "x" (3D: "xy", "xz" ...), undeformed coordinates; or an array
                   [facets][nodes of a facet][d-1] (not smoothed); default: the model's own, else natural coordinates
        offset     [L] is added to the gap, a number or one for each slave point: > 0 a clearance, < 0 a coating; needs "offset": 0 in the
                   model's "contact"
        elements   [slave points] bool: those that are assembled; the others belong to another process. Default: all
        ends       smoothed masters: ENDS_STRAIGHT, ENDS_REPEATED, ENDS_QUASI_CUBIC or ENDS_QUASI_PARABOLIC, see ents.h; core/README.md: which when
        leave      True: a slave point in contact that is pushed over the end of the master is open from there on; False: CutStep
        mirror     smoothed masters: planes of symmetry, [("x", 0.0), ...], at which the surface goes on as its mirror image does
        temperature  of a model with "heat": a number or [nodes], the temperatures at u = 0, to which those of u are added; default: 0
        master_temperature   the same of the nodes of master_positions
        slave_height  the slave is rough, too: a height as a model's (dict; its fields begin with 0), or an ents.Model with that height (bound, say). Slave
                   points lie so much above their facets, along normals that turn with them. sampling is 2 or what is given; 0 is refused. With a height of
                   type "field" it wears: collect_wear()
        slave_surface_coordinates  in which slave_height is given: "x" (3D: "xy" ...), undeformed coordinates; or [nodes][d-1]; default: natural
                   coordinates of the facets
        two_pass   True: the points of the master's facets are slaves, too, and look for the slave's facets. Every point carries with half its area, both
                   points of a pressing pair with the whole pressure; friction and heat are halved in the same way. The points of both sides are
                   slave points of this Contact. Twice the cost; results do not depend on which side is the slave. With stiff penalties two passes
                   hold more points than can be held, and meshes that do not match lock: multipliers are refused. Both sides may have the same height, in the model and as slave_height. Same facets as slave and as master,
                   a surface in contact with itself: always in this way
        order      "ring": corners one after the other around a facet; "tensor": corners of quadrilaterals in rows, (0 1 / 2 3), as in dolfinx, basix, deal.II
        comm       an mpi4py communicator: the surfaces are distributed over its processes. What comes back is an ents.DistributedContact, with
                   further arguments: help(ents.DistributedContact.__init__)

        A surface in contact with itself: the same facets as slave and as master, all that may touch. A point finds facets that look against it, and not
        its own ones and those that share a node with them; the other side of a thin body is no contact, because a point penetrates by no more than
        half the thickness of the body below it (measured where an increment begins: .body_thickness). The undeformed surface must not overlap itself. With a
        height in the model its points lie on that height, too.

        Errors (ents.Error, with what to write): facets of which some are on both sides and some are not, that name a node twice, that do not exist, whose sides cross, or (master) without area or not oriented like their neighbours; slave and master that look the same way; every
        argument of another shape. A slave facet without area is left out with a warning.
        """
        self._arguments = {name: value if name == "model" else copy.deepcopy(value) for name, value in locals().items() if name not in ("self", "comm")}
        self.model = model = (model if isinstance(model, Model) else Model(model)).with_border(BORDER)
        d = model.layout.dimension
        self._positions = _frozen(_array("positions", positions, (None, d)).copy())
        nodes, own = len(self._positions), model.layout.node_dofs
        self._dofs = _frozen(np.arange(own * nodes).reshape(nodes, own) if dofs is None else _array("dofs", dofs, (nodes, own), np.int64).copy())
        self._rows = _count("rows", int(self._dofs.max(initial=-1)) + 1 if rows is None else rows)
        if self._dofs.max(initial=-1) >= self._rows or self._dofs.min(initial=-1) < -1:
            raise Error(Status.BAD_VALUE, f"dofs: from {self._dofs.min()} to {self._dofs.max()}; there are {self._rows} rows, from 0, and -1 for none")
        self._own = None if master_positions is None else _array("master_positions", master_positions, (None, d)).copy()
        self.rigid = model.layout.dofs == own
        if self._own is not None and not self.rigid:
            raise Error(Status.BAD_VALUE, 'master_positions: a master that is no part of the mesh cannot deform; write "master": "rigid" in the model')
        if order not in ("ring", "tensor"):
            raise Error(Status.BAD_VALUE, f'order: {order!r}; there are "ring" and "tensor"')
        for name, array in (("positions", self._positions), ("master_positions", self._own)):
            if array is not None and not np.isfinite(array).all():
                raise Error(Status.NON_FINITE, f"{name}{np.argwhere(~np.isfinite(array))[0].tolist()} is not finite")

        self._heat = Temperatures(model, nodes, temperature, None if self._own is None else len(self._own), master_temperature)
        self._both = None
        one_surface = not two_pass and self._own is None and is_one_surface(model, nodes, slave, master, order)
        if one_surface and not self._takes_one_surface:
            raise Error(Status.BAD_VALUE, "slave and master are the same facets: distributed surfaces are not searched for contact with themselves; leave out comm")
        sides = None
        if two_pass or one_surface:
            refuse_one_sided(model, one_surface, self.rigid)
            slave = master  # places in one list
        _refuse_models(model)
        if one_surface:
            slave_height, slave_surface_coordinates = of_one_surface(model, slave_height, surface_coordinates)
        if two_pass:
            slave_height, slave_surface_coordinates = of_two_passes(model, slave_height, slave_surface_coordinates, surface_coordinates, self._positions, self._arguments["slave"])
        rough = slave_model(model, slave_height)
        if sampling is None and (one_surface or rough is not None):
            sampling = 2  # nodes at the corners of a body have the areas of faces that do not touch
        if two_pass:
            slave, sides = joined(model, nodes, self._arguments["slave"], master, order)
            master = slave
        self._slave = points = SlavePoints(model, self._positions, slave, sampling, thickness, order)
        if rough is not None and not points.sampling:
            raise Error(Status.BAD_VALUE, "sampling: 0 puts the slave points on nodes, which have no facet of their own to be raised above; write 1 or more, or "
                        "leave out slave_height")
        points.raise_by(rough, slave_surface_coordinates, self._positions)
        self._master = MasterSurface(model, self._positions if self._own is None else self._own, master, ends, mirror, order, self._kept)
        if two_pass and slave_surface_coordinates is not None:
            surface_coordinates = slave_surface_coordinates[self._master.segments]
        if two_pass or one_surface:
            self._both = BothSides(points, self._master, sides)
        self._pairs = SidePairs(points, self._master, self._positions, self._own is None, self._both)
        self.tree = Tree(model, self._master.segments, self._master.start, self._master.coordinates(surface_coordinates))
        self.reach = max(points.longest_edge, self._master.longest_edge) if reach is None else reach
        warn_of_size(json.loads(model._text).get("height"), model._data, model._directory, float(np.ptp(self._master.start, axis=0).max()), self.reach)
        count = len(points.areas)
        self._carried = points.areas if self._both is None else self._both.share * points.areas
        self._elements = np.ones(count, bool) if elements is None else _array("elements", elements, (count,), bool).copy()
        self._elements &= ~self._pairs.joined
        self._leave = bool(leave)
        self._slave_values = None
        if offset is not None:
            offset = _array("offset", np.full(count, offset) if np.ndim(offset) == 0 else offset, (count,))
            self._slave_values = np.ones((count, model.layout.slave_values))
            self._slave_values[:, 0] = offset
        self._assembly = None  # (numbers of the points, Rows)
        self._start_results(count)
        self._hint, self._xi = np.full(count, -1, np.int64), np.zeros((count, d - 1))
        self._state_begin = self._state = _frozen(model.state_init(count))
        self._segment_begin, self._tree_begin, self._pending = self._hint, self.tree.positions.copy(), None
        self._points_begin: Optional[np.ndarray] = None  # of the increment, from the first update on

    @property
    def reach(self) -> float:
        """[L] largest distance from the master at which a slave point is searched for."""
        return self._reach

    @reach.setter
    def reach(self, value: float) -> None:
        if not (isinstance(value, (int, float, np.number)) and 0 < value < 1e100):
            raise Error(Status.BAD_VALUE, f"reach is {value!r}: give a length above 0")
        self._reach = float(value)

    def __repr__(self) -> str:
        closed = int((self.pressure > 0).sum())
        return (f"<ents.Contact: {len(self.areas)} slave points, {closed} in contact, {len(self.tree.connectivity)} {self.model.segment} segments, "
                f"{self.rows} rows>")

    def move(self, master_positions: Any) -> None:
        """New positions [nodes][d] of a master that is no part of the mesh; used by the next update()."""
        if self._own is None:
            raise Error(Status.BAD_VALUE, "move: this master is a part of the mesh, it moves with u")
        own = _array("master_positions", master_positions, self._own.shape)
        if not np.isfinite(own).all():
            raise Error(Status.NON_FINITE, f"master_positions{np.argwhere(~np.isfinite(own))[0].tolist()} is not finite")
        self._own = own.copy()

    def update(self, u: Any, tangent: bool = True, time_increment: Optional[float] = None) -> tuple[np.ndarray, Optional[scipy.sparse.csr_matrix]]:
        """Search and assemble at the displacements (and temperatures) u: [rows], or [nodes][d or d + 1] where some are no unknowns. Returns residual
        [rows] (internal force, and power that leaves the nodes, to be added to those of the bodies) and tangent (csr_matrix; None with
        tangent=False, as for the trial steps of a line search). time_increment: since the last commit(), where friction heats or depends on the slip rate.
        CutStep: take a smaller step from the last commit(); nothing has changed. Error: a mistake."""
        self._heat.take(time_increment)
        if self._points_begin is None:
            self._begin()
        try:
            now = self._moved(u)
            points = self._slave.at(now)
            self._move_tree(now)
            self._pairs.now = now
            result, residual, matrix = self._search_and_add(points, tangent)
        except CutStep:  # the next step knows nothing of these iterates
            self._hint, self._xi = self._committed
            raise
        self._keep(points, result, residual, matrix)
        return self.residual, self.tangent if tangent else None

    def _begin(self) -> None:
        """The first increment begins in the undeformed configuration: a point that touches there has its friction from there on."""
        self.tree.move(self._tree_begin)
        self._heat.move(np.zeros(len(self._positions)), self._master, self.tree)
        self._pairs.now = self._positions
        points = self._slave.at(self._positions)
        self._judge(points)
        self._measure(points)
        found, _, _ = self._add(points, False)
        segment, bad = found["segment"], found["status"] > 0
        if self._both is None or not self._both.one_surface:
            warn_of_deep(self.tree, self._pairs, points, np.flatnonzero(self._elements & (segment < 0)), self.reach)
        closed = (found["flags"] & Flag.CONTACT != 0) & ~bad
        kept = bad[:, None] | (not (self.model.layout.friction or self.model.layout.needs & Need.FIRST_STATE))
        state, worn = np.where(kept, self._state_begin, found["state_end"]), self.model.layout.worn
        if self.model.layout.augmentable:
            self.model.state_augment(state, self._state_begin)  # multipliers of 0
        if worn >= 0:
            state[:, worn:worn + 3] = self._state_begin[:, worn:worn + 3]  # nothing has slid yet
        self._state_begin, self._segment_begin = _frozen(state), np.where(bad, -1, segment)
        self._committed = self._hint, self._xi = np.where(closed, segment, -1), found["xi"]
        self._points_begin = points

    def _moved(self, u: Any) -> np.ndarray:
        """Positions [nodes][d] at the displacements u."""
        given = _array("u", u, (None,) * np.ndim(u))
        if given.shape not in ((self.rows,), self._dofs.shape):
            raise Error(Status.BAD_COUNT, f"u: the shape is {given.shape}, wanted is ({self.rows},) or {self._dofs.shape}")
        if not np.isfinite(given).all():
            place = np.argwhere(~np.isfinite(given))[0].tolist()
            raise CutStep(Status.NON_FINITE, f"u{place} is {given[tuple(place)]}: a singular matrix, or a step that was much too large?")
        if given.shape == (self.rows,) and given.shape != self._dofs.shape:
            given = np.where(self._dofs >= 0, given[self._dofs], 0.0) if self.rows else np.zeros(self._dofs.shape)
        d = self._positions.shape[1]
        self._heat.move(given[:, -1], self._master, self.tree)
        return self._positions + given[:, :d]

    def _move_tree(self, now: np.ndarray) -> None:
        try:
            self.tree.move(self._master.at(now if self._own is None else self._own))
        except Error as error:  # an iterate: facets that collapse, positions beyond all bounds
            if self._own is not None and error.status < 0:
                raise
            raise CutStep(error.status, f"the master at this u: {error}", error.element) from None

    def _judge(self, points: np.ndarray) -> None:
        """Until slave points have found a segment: do both sides look at each other?"""
        if not self._pairs.judged:
            self._pairs.judge(self.tree, np.where(self._elements, self.tree.detect(
                points, self.reach, permitted=LOST, **self._pairs.left_out(np.arange(len(points))))["segment"], -1))

    def _search_and_add(self, points: np.ndarray, tangent: bool) -> tuple[dict[str, Any], np.ndarray, Optional[tuple]]:
        """Result [points], residual and tangent. Facets that do not face the slave are no candidates."""
        self._judge(points)
        result, residual, matrix = self._add(points, tangent)
        self._refuse_lost(points, result)
        if (result["status"] > 0).any():
            k = int(np.flatnonzero(result["status"])[0])
            raise CutStep(Status(result["status"][k]), result["message"], k, result["step_factor"])
        return result, residual, matrix

    def _add(self, points: np.ndarray, tangent: bool) -> tuple[dict[str, Any], np.ndarray, Optional[tuple]]:
        """The library's search and assembly of the active points; the others are open."""
        numbers = np.flatnonzero(self._elements)
        if self._assembly is None or not np.array_equal(self._assembly[0], numbers):
            slave, of_nodes = self._slave.matrix[numbers], None if self._slave.nodes is None else self._slave.nodes[numbers]
            dofs, rows = self._master.equations(self._dofs, self.rows)
            self._assembly = numbers, Rows(self.model, self.tree, dofs, rows, self._master.widened(slave), self._slave.parts(numbers), of_nodes,
                                           None if self.rigid else self._master.matrix, self._master.smoothed, self._master.beside())
        if self._slave.raised is not None:
            self._assembly[1].place(self._pairs.now)
        of = lambda array: array if array is None or len(numbers) == len(array) else np.ascontiguousarray(array[numbers])
        found, residual, matrix = self._assembly[1].add(
            tangent, **self._heat.inputs(self._slave, of), slave=of(points), reach=self.reach, segment=of(self._hint), xi=of(self._xi),
            want="state_end gap pressure flags" + (" traction" if self.model.layout.friction else "") + (" heat" if self._heat.on else ""), positions_begin=self._tree_begin,
            slave_begin=None if self._points_begin is None else of(self._points_begin), area=of(self._carried),
            state=of(self._state_begin), slave_values=of(self._slave_values), slave_normal=of(self._pairs.normals()), permitted=LOST, **self._pairs.left_out(numbers))
        residual, matrix = self._master.condensed(residual, matrix)
        if len(numbers) == len(points):
            return found, residual, matrix
        result = {name: found[name] for name in ("message", "step_factor")}
        for name, array in found.items():
            if isinstance(array, np.ndarray):
                result[name] = np.full((len(points), *array.shape[1:]), -1 if name in ("segment", "other") else 0, array.dtype)
                result[name][numbers] = array
        rest = np.setdiff1d(np.arange(len(points)), numbers)
        result["state_end"][rest] = self.model.state_opened(self._state_begin[rest])
        return result, residual, matrix

    def _refuse_lost(self, points: np.ndarray, result: dict[str, Any]) -> None:
        """Points that were in contact, or are behind the surface, and have no segment: an increment that is too large."""
        behind = np.flatnonzero(result["detected"] & Flag.BEHIND_EDGE)
        if len(behind):
            raise CutStep(Status.NO_PROJECTION, f"slave point {behind[0]} lies behind a concave edge of the master: take a smaller step, widen "
                          '"border" in the model, or smooth the master', int(behind[0]))
        left = np.flatnonzero(result["detected"] & Flag.LEFT)
        if not len(left):
            return
        far = self.tree.detect(points[left], 1e90, **{**self._pairs.left_out(left), "depth": None})  # beside the master, or below it?
        gap = np.where(far["segment"] >= 0, far["gap"], 0.0)
        if gap.min() < -self.reach:
            k, depth = int(left[gap.argmin()]), -gap.min()
            raise CutStep(Status.DEEP_PENETRATION, f"slave point {k} penetrates by {depth:.6g}, more than reach = {self.reach:.6g}: take a "
                          "smaller step, or give a larger reach", k, min(0.5, self.reach / depth))
        if not self._leave:
            raise CutStep(Status.NO_PROJECTION, f"slave point {left[0]} was in contact and lies beside all segments of the master now: take a smaller "
                          'step, let the master reach farther (more facets, or "border" in the model), or write leave=True if it may go over the end',
                          int(left[0]))

    def commit(self) -> None:
        """The last update() is the end of the increment, and the begin of the next one."""
        if self._pending is None:
            raise Error(Status.BAD_STATE, "commit: update(u) comes first")
        self._segment_begin, self._tree_begin = self._pending
        self._state_begin = self._state
        self._committed = self._hint, self._xi
        self._points_begin, self._nodes_begin, self._ahead = self.points, self._nodes_at, False
        if self._both is not None:
            self.tree.move(self._tree_begin)
            self._measure(self.points)

    def _measure(self, points: np.ndarray) -> None:
        """Self-contact: an increment begins with the points there."""
        if self._both is not None:
            self._both.measure(self.tree, points, self._pairs.normals(), self.reach)

    def augment(self) -> None:
        """Uzawa's step of a model with "augmented": takes the multipliers of the last update() over; then solve the increment again."""
        if not self.model.layout.augmentable:
            raise Error(Status.BAD_VALUE, 'augment: the model\'s normal law is not "augmented"')
        if self._pending is None:
            raise Error(Status.BAD_STATE, "augment: update(u) comes first")
        old, new = self._segment_begin, self._pending[0]
        moves = np.flatnonzero((old >= 0) & (new >= 0) & (old != new))
        begin = self._state_begin.copy()
        if len(moves):
            status, moved = self.tree.state_transfer(begin[moves], old[moves], new[moves], self._tree_begin)
            if status:
                raise CutStep(status, "the history of a slave point cannot move to its new segment: take a smaller step")
            begin[moves] = moved
            begin[moves, -1] = new[moves] + 1  # a state knows its segment
        self.model.state_augment(begin, self._state)
        self._state_begin, self._segment_begin = _frozen(begin), np.where(new >= 0, new, old)


def _refuse_models(model: Model) -> None:
    if model.patch:
        raise Error(Status.BAD_VALUE, 'model: leave out "patch": ents.Contact finds the segment of each slave point among all master facets')
    if model.layout.multipliers:
        raise Error(Status.BAD_VALUE, 'model: ents.Contact has no multipliers as unknowns; write the normal law "augmented", which keeps them in '
                    'the state, and call augment() after each solve until the penetration is small enough')
    if not model._has_law:
        raise Error(Status.BAD_VALUE, 'model: it has no contact law; write "contact": {"normal": {"type": "penalty", "stiffness": ...}}')
