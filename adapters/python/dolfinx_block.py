#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""dolfinx and PETSc's SNES solve block.json, on any number of processes: bulk, matrix and Newton's iteration are theirs, contact is ents.Contact.

usage: dolfinx_block.py [SCENE] [--variant NAME] [--compare RESULT] [--refine N]
       mpirun -n 2 python3 -m mpi4py dolfinx_block.py ...

SCENE      a scene of ents-lab with two blocks, quad4 or tri3, "neo_hooke" or "st_venant_kirchhoff" materials and "line2", "catmull_rom4" or
           "bspline4" segments, with friction or without; default: block.json beside this script
--variant  one of the scene's variants
--compare  result.json that `ents-lab run SCENE --out DIR` left in DIR: the forces have to be the same
--refine   N times as many elements in each direction (not with --compare)

A contact element belongs to the process that owns its slave node; a process knows the parts of the surfaces near its own ones.
exit status: 0 done; 1 no convergence, or other forces; 2 wrong command line; 3 a package is missing (Debian: python3-dolfinx-real python3-scipy)"""
import pathlib
import sys

import block

ARGUMENTS = block.arguments(__doc__) if __name__ == "__main__" else None  # before the imports: --help needs none of them
try:
    import dolfinx
    import numpy as np
    import scipy  # noqa: F401
    import ufl
    from dolfinx import fem
    from dolfinx.fem import petsc as fem_petsc
    from mpi4py import MPI
    from petsc4py import PETSc
except ModuleNotFoundError as error:
    print(f"{pathlib.Path(sys.argv[0]).name}: {error}; Debian has it in python3-dolfinx-real, python3-scipy, for /usr/bin/python3")
    sys.exit(3)
import ents

# SNES stops when |r| <= 1e-10, which is 3e-13 of a force of 329: stricter than block.SAME_FORCE takes it to be.
FORCE_TOLERANCE = 1e-10


class Parts:
    """The scene's blocks as one mesh: nodes [n][2], cells [c][3 or 4] in dolfinx's order, part of each."""

    def __init__(self, scene, refine):
        nodes, cells, self.names, self.part = [], [], [], []
        self.sides = {}
        for part in scene["parts"]:
            (px,), (py,) = part["x"]["pieces"], part["y"]["pieces"]
            x = np.linspace(part["x"]["from"], px["to"], px["divisions"] * refine + 1)
            y = np.linspace(part["y"]["from"], py["to"], py["divisions"] * refine + 1)
            number = sum(map(len, nodes)) + np.arange(len(x) * len(y)).reshape(len(y), len(x))
            nodes.append(np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2))
            corners = number[:-1, :-1], number[:-1, 1:], number[1:, :-1], number[1:, 1:]
            self.triangles = part["element"] == "tri3"  # ents-lab cuts its cells along the diagonal of corners 0 and 3
            for cell in ((0, 1, 3), (0, 3, 2)) if self.triangles else (range(4),):
                cells.append(np.stack([corners[c] for c in cell], axis=-1).reshape(-1, len(cell)))
                self.part += [len(self.names)] * len(cells[-1])
            self.names.append(part["name"])
            for side, on in (("x_min", number[:, 0]), ("x_max", number[:, -1]), ("y_min", number[0]), ("y_max", number[-1])):
                self.sides[f"{part['name']}.{side}"] = on
        self.nodes, self.cells, self.part = np.concatenate(nodes), np.concatenate(cells), np.array(self.part)


class Host:
    """dolfinx: F and J of SNES."""

    def __init__(self, scene, refine):
        self.comm = comm = MPI.COMM_WORLD
        parts = Parts(scene, refine)
        first = comm.rank == 0
        shape = "triangle" if parts.triangles else "quadrilateral"
        mesh = dolfinx.mesh.create_mesh(comm, parts.cells if first else np.zeros((0, parts.cells.shape[1]), np.int64),
                                        parts.nodes if first else np.zeros((0, 2)), ufl.Mesh(ufl.VectorElement("Lagrange", shape, 1)))
        space = fem.VectorFunctionSpace(mesh, ("Lagrange", 1))
        constant = fem.FunctionSpace(mesh, ("DG", 0))
        self.u = u = fem.Function(space)
        mu, la = fem.Function(constant), fem.Function(constant)

        # Input node -> dof: dofs are in the order of the cell's nodes.
        index = space.dofmap.index_map
        self.local = np.full(len(parts.nodes), -1, np.int32)
        cells = mesh.topology.index_map(2)
        of_node = np.zeros(len(parts.nodes), int)
        of_node[parts.cells] = parts.part[:, None]
        law, = {scene["materials"][part["material"]]["law"] for part in scene["parts"]}
        for c in range(cells.size_local + cells.num_ghosts):
            nodes = np.array(mesh.geometry.input_global_indices)[mesh.geometry.dofmap.links(c)]
            self.local[nodes] = space.dofmap.cell_dofs(c)
            part = scene["parts"][of_node[nodes[0]]]
            material = scene["materials"][part["material"]]
            young, nu = material["young"], material["poisson"]
            mu.x.array[constant.dofmap.cell_dofs(c)] = young / (2 * (1 + nu))
            la.x.array[constant.dofmap.cell_dofs(c)] = young * nu / ((1 + nu) * (1 - 2 * nu))
        self.owned = (self.local >= 0) & (self.local < index.size_local)
        local = np.arange(index.size_local + index.num_ghosts, dtype=np.int32)
        self.dofs = (2 * index.local_to_global(local)[:, None] + [0, 1]).astype(PETSc.IntType)  # [local node][2] numbers among all processes
        self.input = np.zeros(len(local), np.int64)  # input node of each
        self.input[self.local[self.local >= 0]] = np.flatnonzero(self.local >= 0)
        self.owners = np.r_[np.full(index.size_local, comm.rank), index.owners]

        f = ufl.Identity(2) + ufl.grad(u)
        if law == "st_venant_kirchhoff":
            e = (f.T * f - ufl.Identity(2)) / 2
            p = f * (la * ufl.tr(e) * ufl.Identity(2) + 2 * mu * e)
        else:  # Bonet and Wood's neo-Hooke
            p = mu * (f - ufl.inv(f).T) + la * ufl.ln(ufl.det(f)) * ufl.inv(f).T
        weak = ufl.inner(p, ufl.grad(ufl.TestFunction(space))) * ufl.dx(metadata={"quadrature_degree": 1 if parts.triangles else 3})
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
        self.contact = self.surfaces(scene, parts, mesh)
        bottom = parts.sides[scene["contact"]["master"]["faces"].split(".")[0] + ".y_min"]
        self.bottom = self.dofs[self.local[bottom[self.owned[bottom]]]]
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

    def surfaces(self, scene, parts, mesh):
        """ents.Contact of the two sides: each process gives the facets of its own cells, and all its nodes."""
        own = np.isin(np.arange(len(parts.cells)), mesh.topology.original_cell_index[:mesh.topology.index_map(2).size_local])
        contact = scene["contact"]

        def facets(name):  # left to right: the normal points up, out of the lower block
            side = parts.sides[name]
            of = np.isin(parts.cells[own], side)
            mine = {tuple(sorted(cell[on])) for cell, on in zip(parts.cells[own], of) if on.sum() == 2}
            chain = [pair for pair in zip(side, side[1:]) if tuple(sorted(pair)) in mine]
            return self.local[np.array(chain, np.int64).reshape(-1, 2)]
        return ents.Contact(
            contact["model"], parts.nodes[self.input], facets(contact["slave"])[:, ::-1], facets(contact["master"]["faces"]), dofs=self.dofs, numbers=self.input,
            owners=self.owners, comm=self.comm, reach=0.25, surface_coordinates="x" if "surface_coordinates" in contact["master"] else None,
            ends=ents.ENDS_REPEATED)  # as ents-host has them

    def contact_part(self):
        """Of this process: (equations, forces) and the tangent."""
        return self.contact.update(self.u.x.array)

    def forces(self, b):
        """Bulk and contact, without the conditions."""
        with b.localForm() as local:
            local.set(0)
        fem_petsc.assemble_vector(b, self.residual)

    def add_contact(self, b):
        b.ghostUpdate(PETSc.InsertMode.ADD, PETSc.ScatterMode.REVERSE)
        (equations, r), _ = self.contact_part()
        b.setValues(equations, r, PETSc.InsertMode.ADD)
        b.assemble()

    def function(self, snes, x, b):
        x.copy(self.u.vector)
        self.u.x.scatter_forward()
        self.forces(b)
        fem_petsc.apply_lifting(b, [self.jacobian], [self.bcs], [self.u.vector], -1.0)  # SNES's x has no values of other processes
        self.add_contact(b)
        fem_petsc.set_bc(b, self.bcs, x, -1.0)

    def derivative(self, snes, x, j, p):
        p.zeroEntries()
        fem_petsc.assemble_matrix(p, self.jacobian, self.bcs)
        p.assemble(PETSc.Mat.AssemblyType.FLUSH)
        _, k = self.contact_part()
        p.setValuesIJV(k.begin, k.columns, k.values, PETSc.InsertMode.ADD, rowmap=k.rows)
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
            self.contact.commit()
            mine = np.array([b.getValues(self.bottom[:, i]).sum() for i in (0, 1)]) if len(self.bottom) else np.zeros(2)
            force = np.empty(2)
            self.comm.Allreduce(mine, force, MPI.SUM)
            forces.append(force)
            iterations.append(self.snes.getIterationNumber())
            if self.comm.rank == 0:
                print(f"step {step}/{steps}  iterations {iterations[-1]:2d}  |r| {self.snes.getFunctionNorm():.0e}  "
                      f"force on the support {force[0]:+.12f} {force[1]:+.12f}", flush=True)
        return np.array(forces), iterations


def main(arguments):
    scene = block.variant_of(arguments.scene, arguments.variant)
    host = Host(scene, arguments.refine)
    forces, iterations = host.solve(scene["steps"]["values"][0]["count"])
    if arguments.compare:
        block.compare(forces, iterations, arguments.compare, print if host.comm.rank == 0 else lambda text: None)


if __name__ == "__main__":
    main(ARGUMENTS)
