#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""dolfinx and PETSc's SNES solve block.json, on any number of processes: bulk, matrix and Newton's iteration are theirs, contact comes from ents.py.

usage: dolfinx_block.py [SCENE] [--compare RESULT]
       mpirun -n 2 python3 -m mpi4py dolfinx_block.py ...

SCENE      a scene of ents-host with two blocks, "neo_hooke" materials and "line2", "catmull_rom4" or "bspline4" segments; default: block.json
           beside this script
--compare  result.json that `ents-host run SCENE --out DIR` left in DIR: the forces have to be the same

A contact element belongs to the process that owns its slave node. Positions of the two surfaces are known to all.
exit status: 0 done; 1 no convergence, or other forces; 3 a package is missing (Debian: python3-dolfinx-real python3-scipy)"""
import argparse
import json
import pathlib
import sys
import traceback

try:
    import dolfinx
    import numpy as np
    import scipy.sparse as sparse
    import ufl
    from dolfinx import fem
    from dolfinx.fem import petsc as fem_petsc
    from mpi4py import MPI
    from petsc4py import PETSc
except ModuleNotFoundError as error:
    print(f"dolfinx_block.py: {error}; Debian has it in python3-dolfinx-real, python3-scipy, for /usr/bin/python3")
    sys.exit(3)
import ents

# SNES stops when |r| <= 1e-10, a load that by statics the two supports share: sqrt(132 dofs) * 1e-10 of a force of 329 is 3.5e-12; ents-host: 1.2e-11.
FORCE_TOLERANCE, SAME_FORCE = 1e-10, 1.6e-11


class Parts:
    """The scene's blocks as one mesh of quadrilaterals: nodes [n][2], cells [c][4] in dolfinx's order, part of each."""

    def __init__(self, scene):
        nodes, cells, self.names, self.part = [], [], [], []
        self.sides = {}
        for part in scene["parts"]:
            (px,), (py,) = part["x"]["pieces"], part["y"]["pieces"]
            x = np.linspace(part["x"]["from"], px["to"], px["divisions"] + 1)
            y = np.linspace(part["y"]["from"], py["to"], py["divisions"] + 1)
            number = sum(map(len, nodes)) + np.arange(len(x) * len(y)).reshape(len(y), len(x))
            nodes.append(np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2))
            cells.append(np.stack([number[:-1, :-1], number[:-1, 1:], number[1:, :-1], number[1:, 1:]], axis=-1).reshape(-1, 4))
            self.part += [len(self.names)] * len(cells[-1])
            self.names.append(part["name"])
            for side, on in (("x_min", number[:, 0]), ("x_max", number[:, -1]), ("y_min", number[0]), ("y_max", number[-1])):
                self.sides[f"{part['name']}.{side}"] = on
        self.nodes, self.cells = np.concatenate(nodes), np.concatenate(cells)


class Contact:
    """Forces and stiffness of the contact elements that this process owns, in dofs of the two surfaces (slave nodes, then master nodes)."""

    def __init__(self, scene, parts, owned):
        contact = scene["contact"]
        self.slaves, masters = parts.sides[contact["slave"]], parts.sides[contact["master"]["faces"]]
        self.nodes = np.concatenate([self.slaves, masters])
        self.start = parts.nodes[self.nodes]
        chain = lambda n: np.column_stack([np.arange(n - 1), np.arange(1, n)])  # left to right: the normal points out of the lower block
        self.model = ents.Model(contact["model"])
        segments, points, basis = chain(len(masters)), sparse.identity(len(masters), format="csr"), contact["model"]["segment"]
        if basis != "line2":  # ents-host repeats the nodes at the ends
            segments, (begin, of, weights) = self.model.library.smooth("line2", basis, segments, len(masters), ents.ENDS_REPEATED)
            points = sparse.csr_matrix((weights, of, begin), (len(begin) - 1, len(masters)))
        self.points = points
        start = points @ parts.nodes[masters]
        surface = start[segments][:, :, :1] if "surface_coordinates" in contact["master"] else None  # s is the reference x
        self.tree = ents.Tree(self.model, segments, start, surface)
        self.area = self.model.library.tributary_areas("line2", chain(len(self.slaves)), parts.nodes[self.slaves])
        ns = 2 * len(self.slaves)
        self.slave_dofs = np.arange(ns).reshape(-1, 2)
        self.point_dofs = ns + np.arange(2 * points.shape[0]).reshape(-1, 2)
        # control points of the smoothed surface -> nodes
        self.spread = sparse.block_diag([sparse.identity(ns), sparse.kron(points, sparse.identity(2))]).T.tocsr()
        self.segment, self.xi = np.full(len(self.slaves), -1, np.int64), np.zeros((len(self.slaves), 1))
        self.mine = owned[self.slaves]

    def evaluate(self, displacement):
        """displacement [nodes][2]: R, and K as a sparse matrix."""
        now = self.start + displacement
        slave = now[:len(self.slaves)]
        self.tree.move(self.points @ now[len(self.slaves):])
        found = self.tree.detect(slave, 0.25, self.segment, self.xi)
        self.segment, self.xi = found["segment"], found["xi"]
        size = self.spread.shape[1]
        r, (values, places), result = self.model.blocks(
            slave, self.tree, np.where(self.mine, self.segment, -1), self.slave_dofs, self.point_dofs, size, area=self.area, start=self.xi)
        if result["status"].any():
            raise SystemExit(result["message"])
        return self.spread @ r, (self.spread @ sparse.coo_matrix((values, places), (size, size)) @ self.spread.T).tocoo()


class Host:
    """dolfinx: F and J of SNES."""

    def __init__(self, scene):
        self.comm = comm = MPI.COMM_WORLD
        parts = Parts(scene)
        first = comm.rank == 0
        mesh = dolfinx.mesh.create_mesh(comm, parts.cells if first else np.zeros((0, 4), np.int64), parts.nodes if first else np.zeros((0, 2)),
                                        ufl.Mesh(ufl.VectorElement("Lagrange", "quadrilateral", 1)))
        space = fem.VectorFunctionSpace(mesh, ("Lagrange", 1))
        constant = fem.FunctionSpace(mesh, ("DG", 0))
        self.u = u = fem.Function(space)
        mu, la = fem.Function(constant), fem.Function(constant)

        # Input node -> dof: dofs of Q1 are in the order of the cell's nodes.
        index = space.dofmap.index_map
        self.local = np.full(len(parts.nodes), -1, np.int32)
        cells = mesh.topology.index_map(2)
        for c in range(cells.size_local + cells.num_ghosts):
            nodes = np.array(mesh.geometry.input_global_indices)[mesh.geometry.dofmap.links(c)]
            self.local[nodes] = space.dofmap.cell_dofs(c)
            part = scene["parts"][np.flatnonzero([np.isin(nodes, parts.cells[np.array(parts.part) == p]).all() for p in range(len(parts.names))])[0]]
            material = scene["materials"][part["material"]]
            young, nu = material["young"], material["poisson"]
            mu.x.array[constant.dofmap.cell_dofs(c)] = young / (2 * (1 + nu))
            la.x.array[constant.dofmap.cell_dofs(c)] = young * nu / ((1 + nu) * (1 - 2 * nu))
        self.owned = (self.local >= 0) & (self.local < index.size_local)
        mine = np.where(self.owned, index.local_range[0] + self.local, -1).astype(np.int64)
        node = np.empty_like(mine)
        comm.Allreduce(mine, node, MPI.MAX)
        self.dofs = (2 * node[:, None] + [0, 1]).astype(PETSc.IntType)  # [input node][2] numbers among all processes

        f = ufl.Identity(2) + ufl.grad(u)
        # Bonet and Wood's neo-Hooke; 2 x 2 points
        p = mu * (f - ufl.inv(f).T) + la * ufl.ln(ufl.det(f)) * ufl.inv(f).T
        weak = ufl.inner(p, ufl.grad(ufl.TestFunction(space))) * ufl.dx(metadata={"quadrature_degree": 3})
        self.residual, self.jacobian = fem.form(weak), fem.form(ufl.derivative(weak, u))

        self.bcs, self.loads = [], []
        for support in scene["supports"]:
            for i, axis in enumerate("xy"):
                if axis in support:
                    nodes = self.local[parts.sides[support["nodes"]]]
                    value = fem.Constant(mesh, 0.0)
                    self.loads.append((value, support[axis]))
                    dofs = np.sort(2 * nodes[nodes >= 0] + i).astype(np.int32)
                    self.bcs.append(fem.dirichletbc(value, dofs, space.sub(i)))
        self.contact = Contact(scene, parts, self.owned)
        bottom = parts.sides[scene["contact"]["master"]["faces"].split(".")[0] + ".y_min"]
        self.bottom = self.dofs[bottom][self.owned[bottom]]
        self.vector = fem_petsc.create_vector(self.residual)
        self.matrix = fem_petsc.create_matrix(self.jacobian)
        self.matrix.setOption(PETSc.Mat.Option.NEW_NONZERO_ALLOCATION_ERR, False)  # couplings by contact are outside the pattern
        self.snes = snes = PETSc.SNES().create(comm)
        snes.setFunction(self.function, self.vector)
        snes.setJacobian(self.derivative, self.matrix)
        snes.setTolerances(rtol=0, atol=FORCE_TOLERANCE, stol=0, max_it=25)
        PETSc.Options()["snes_linesearch_type"] = "basic"
        snes.setFromOptions()
        snes.getKSP().setType("preonly")
        snes.getKSP().getPC().setType("lu")
        snes.getKSP().getPC().setFactorSolverType("mumps")

    def contact_part(self):
        nodes = self.contact.nodes
        mine = np.zeros((len(nodes), 2))
        own = self.owned[nodes]
        mine[own] = self.u.x.array.reshape(-1, 2)[self.local[nodes[own]]]
        everywhere = np.empty_like(mine)
        self.comm.Allreduce(mine, everywhere, MPI.SUM)
        try:
            return self.dofs[nodes].ravel(), *self.contact.evaluate(everywhere)
        except BaseException:
            if self.comm.size > 1:  # the other processes would wait for this one
                traceback.print_exc()
                sys.stderr.flush()
                self.comm.Abort(1)
            raise

    def forces(self, b):
        """Bulk and contact, without the conditions."""
        with b.localForm() as local:
            local.set(0)
        fem_petsc.assemble_vector(b, self.residual)

    def add_contact(self, b):
        b.ghostUpdate(PETSc.InsertMode.ADD, PETSc.ScatterMode.REVERSE)
        dofs, r, _ = self.contact_part()
        b.setValues(dofs, r, PETSc.InsertMode.ADD)
        b.assemble()

    def function(self, snes, x, b):
        x.copy(self.u.vector)
        self.u.x.scatter_forward()
        self.forces(b)
        fem_petsc.apply_lifting(b, [self.jacobian], [self.bcs], [x], -1.0)
        self.add_contact(b)
        fem_petsc.set_bc(b, self.bcs, x, -1.0)

    def derivative(self, snes, x, j, p):
        p.zeroEntries()
        fem_petsc.assemble_matrix(p, self.jacobian, self.bcs)
        p.assemble(PETSc.Mat.AssemblyType.FLUSH)
        dofs, _, k = self.contact_part()
        for i, jj, value in zip(k.row, k.col, k.data):
            p.setValue(dofs[i], dofs[jj], value, PETSc.InsertMode.ADD)
        p.assemble()

    def solve(self, steps):
        """Forces [step][2] on the support of the lower block, and iterations [step]."""
        x = self.u.vector.copy()
        forces, iterations = [], []
        for step in range(1, steps + 1):
            for value, full in self.loads:
                value.value = full * step / steps
            self.snes.solve(None, x)
            if self.snes.getConvergedReason() <= 0:
                raise SystemExit(f"step {step}: no convergence, SNES says {self.snes.getConvergedReason()}")
            x.copy(self.u.vector)
            self.u.x.scatter_forward()
            b = fem_petsc.create_vector(self.residual)
            self.forces(b)
            self.add_contact(b)
            mine = np.array([b.getValues(self.bottom[:, i]).sum() for i in (0, 1)]) if len(self.bottom) else np.zeros(2)
            force = np.empty(2)
            self.comm.Allreduce(mine, force, MPI.SUM)
            forces.append(force)
            iterations.append(self.snes.getIterationNumber())
            if self.comm.rank == 0:
                print(f"step {step}/{steps}  iterations {iterations[-1]:2d}  |r| {self.snes.getFunctionNorm():.0e}  "
                      f"force on the support {force[0]:+.12f} {force[1]:+.12f}", flush=True)
        return np.array(forces), iterations


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", nargs="?", default=pathlib.Path(__file__).with_name("block.json"), type=pathlib.Path)
    parser.add_argument("--compare", type=pathlib.Path)
    arguments = parser.parse_args()
    scene = json.loads(arguments.scene.read_text())
    host = Host(scene)
    forces, iterations = host.solve(scene["steps"]["values"][0]["count"])
    if arguments.compare:
        steps = json.loads(arguments.compare.read_text())["steps"]
        theirs = np.array([step["contact_force"] for step in steps])
        # The force on the slave: by balance, on the support as well, up to the sign.
        difference = min(np.abs(forces - sign * theirs).max() for sign in (1, -1)) / np.abs(theirs).max()
        if host.comm.rank == 0:
            print(f"largest difference from {arguments.compare}: {difference:.1e} of the largest force, bound {SAME_FORCE:.1e}; "
                  f"iterations {sum(iterations)}, there {sum(step['iterations'] for step in steps)}")
        if not difference <= SAME_FORCE:
            raise SystemExit("the forces differ")


if __name__ == "__main__":
    main()
