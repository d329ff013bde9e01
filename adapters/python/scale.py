#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A large contact problem in dolfinx and PETSc, on any number of processes: a neo-Hookean block slides with friction over a larger one, whose surface has a
texture that no mesh resolves. Contact is ents.Contact(..., comm=comm): no process knows a surface as a whole.

usage: scale.py [-n N] [--cells KIND] [--steps N] [--waves N] [--solver PC] [--out FOLDER] [--checkpoint NAME] [--restart] [--write FILE] [--compare FILE]
       mpirun -n P python3 -m mpi4py scale.py ...

-n            cells of the lower block along x and y (half as many along z); the upper one has cells of 0.8 of that size. Default 10
--cells       hexahedra or tetrahedra (default)
--steps       load steps: the upper block is pressed by 0.2 % of its height, then slides by a quarter of a wave a step. Default 3
--waves       waves of the texture along x, and along y; default 120: 14400 bumps and as many hollows
--solver      preconditioner of GMRES: gamg (default) or hypre; PETSc's options stand in the environment's PETSC_OPTIONS
--out         writes displacements to FOLDER/scale.xdmf
--checkpoint  after each step each process writes NAME.P.npz; --restart goes on from there, with the same number of processes
--write       forces and iterations as JSON; --compare: the forces have to be those of such a file, to 1e-8

exit status: 0 done; 1 no convergence, or other forces; 2 wrong command line; 3 a package is missing (Debian: python3-dolfinx-real python3-scipy)"""
import argparse
import contextlib
import json
import pathlib
import resource
import sys
import time

YOUNG, POISSON, GAP, PRESS, AMPLITUDE = 1000.0, 0.3, 2e-4, 1e-3, 1e-4
LOWER, UPPER = ((0, 0, 0), (1, 1, 0.5)), ((0.2, 0.2, 0.5 + GAP), (0.7, 0.8, 1.0 + GAP))
CUBE = (0, 1, 2, 3, 4, 5, 6, 7)
TETRAHEDRA = ((0, 1, 3, 7), (0, 1, 5, 7), (0, 2, 3, 7), (0, 2, 6, 7), (0, 4, 5, 7), (0, 4, 6, 7))


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-n", type=int, default=10)
    parser.add_argument("--cells", choices=("hexahedra", "tetrahedra"), default="tetrahedra")
    parser.add_argument("--steps", type=int, default=3)
    parser.add_argument("--waves", type=int, default=120)
    parser.add_argument("--solver", choices=("gamg", "hypre"), default="gamg")
    for name in ("--out", "--checkpoint", "--write", "--compare"):
        parser.add_argument(name, type=pathlib.Path)
    parser.add_argument("--restart", action="store_true")
    given = parser.parse_args()
    if given.n < 2 or given.steps < 1:
        parser.error("-n is at least 2, --steps at least 1")
    if given.restart and not given.checkpoint:
        parser.error("--restart needs --checkpoint NAME")
    return given


ARGUMENTS = arguments() if __name__ == "__main__" else None  # before the imports: --help needs none of them
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
    print(f"scale.py: skipped: {error}; Debian has it in python3-dolfinx-real, python3-scipy, for /usr/bin/python3")
    sys.exit(3)
import ents


class Times(dict):
    """Seconds by phase, [wall clock, processor]: with times("name"): ... Phases within others count in both. On a machine with other work the
    processor's are those that say something."""

    @staticmethod
    def now():
        return np.array([time.perf_counter(), time.process_time()])

    @contextlib.contextmanager
    def __call__(self, name):
        begin = self.now()
        try:
            yield
        finally:
            self[name] = self.get(name, 0.0) + self.now() - begin


class Blocks:
    """Both blocks as one mesh; each process makes a part of the nodes and of the cells. Numbers of nodes do not depend on the processes."""

    def __init__(self, n):
        size = lambda box, cell: [max(2, round((box[1][i] - box[0][i]) / cell)) for i in range(3)]
        self.boxes, self.cells = (LOWER, UPPER), (size(LOWER, 1 / n), size(UPPER, 0.8 / n))
        self.first = np.cumsum([0, *(np.prod(np.add(cells, 1)) for cells in self.cells)])

    def place(self, numbers):
        """Block [n] and indices (i, j, k) [n][3] of nodes."""
        block = (numbers >= self.first[1]).astype(int)
        nx, ny, _ = (np.array(self.cells).T[i][block] + 1 for i in range(3))
        rest = numbers - self.first[block]
        return block, np.column_stack([rest % nx, rest // nx % ny, rest // (nx * ny)])

    def part(self, comm, kind):
        """Nodes [n][3] and cells that this process gives."""
        mine = lambda count: np.arange(count * comm.rank // comm.size, count * (comm.rank + 1) // comm.size)
        block, index = self.place(mine(int(self.first[-1])))
        low, high = (np.array([box[k] for box in self.boxes], float) for k in (0, 1))
        x = low[block] + (high - low)[block] * index / np.array(self.cells)[block]
        cells = []
        for b, (nx, ny, nz) in enumerate(self.cells):
            c = mine(nx * ny * nz)
            corner = self.first[b] + c % nx + (nx + 1) * (c // nx % ny + (ny + 1) * (c // (nx * ny)))
            cube = corner[:, None] + [i + (nx + 1) * (j + (ny + 1) * k) for k in (0, 1) for j in (0, 1) for i in (0, 1)]
            cells += [cube[:, pick] for pick in ((CUBE,) if kind == "hexahedra" else TETRAHEDRA)]
        return x, np.concatenate(cells)

    def side(self, numbers, block, top):
        """[n] bool: nodes of the upper or lower side of a block."""
        of, index = self.place(numbers)
        return (of == block) & (index[:, 2] == (self.cells[block][2] if top else 0))


class Host:
    def __init__(self, given, times):
        self.comm, self.given, self.times = MPI.COMM_WORLD, given, times
        blocks, hexahedra = Blocks(given.n), given.cells == "hexahedra"
        with times("mesh"):
            x, cells = blocks.part(self.comm, given.cells)
            shape = "hexahedron" if hexahedra else "tetrahedron"
            self.mesh = mesh = dolfinx.mesh.create_mesh(self.comm, cells, x, ufl.Mesh(ufl.VectorElement("Lagrange", shape, 1)))
            self.space = space = fem.VectorFunctionSpace(mesh, ("Lagrange", 1))
        self.u, index = fem.Function(space), space.dofmap.index_map
        count, local = mesh.topology.index_map(3).size_local, index.size_local + index.num_ghosts
        of_cell = lambda array: array.reshape(-1, 8 if hexahedra else 4)
        dofs, nodes = of_cell(space.dofmap.list.array), of_cell(mesh.geometry.dofmap.array)
        numbers = np.zeros(local, np.int64)
        numbers[dofs] = np.array(mesh.geometry.input_global_indices)[nodes]
        self.numbers = numbers
        self.bulk(3 if hexahedra else 1)
        self.conditions(blocks)
        with times("contact, set-up"):
            own, position = dofs[:count], space.tabulate_dof_coordinates()[:local]
            slave, master = (self.facets(own, position, blocks.side(numbers, b, b == 0), 1 - 2 * b) for b in (1, 0))
            owners = np.r_[np.full(index.size_local, self.comm.rank), index.owners]
            self.contact = ents.Contact(self.model(), position, slave, master, dofs=(3 * index.local_to_global(np.arange(local, dtype=np.int32))[:, None] + np.arange(3)
                                                                                     ).astype(PETSc.IntType),
                                        numbers=numbers, owners=owners, comm=self.comm, surface_coordinates="xy", order="tensor" if hexahedra else "ring")
        self.solver(position[:index.size_local])
        self.matrix, self.stale, self.rebuilt, self.evaluations = None, True, 0, 0

    def model(self):
        wave = lambda i, amplitude: {"type": "sine", "amplitude": amplitude, "wave_vector": [float(self.given.waves) * (i == k) for k in (0, 1)]}
        stiffness = 5 * YOUNG * self.given.n
        return {"segment": "quad4" if self.given.cells == "hexahedra" else "tri3", "border": 1e-5, "height": {"type": "product", "of": [wave(0, AMPLITUDE), wave(1, 1.0)]},
                "contact": {"normal": {"type": "penalty", "stiffness": stiffness}, "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": stiffness / 5}}}

    @staticmethod
    def facets(cells, position, side, up):
        """Facets of cells whose nodes are on one side; `up` is the direction of the normal."""
        on = side[cells]
        width = 4 if cells.shape[1] == 8 else 3
        found = on.sum(axis=1) == width
        facets = cells[found][on[found]].reshape(-1, width)
        edge = position[facets[:, 1:3]] - position[facets[:, :1]]
        wrong = np.cross(edge[:, 0], edge[:, 1])[:, 2] * up < 0
        facets[wrong, 1], facets[wrong, 2] = facets[wrong, 2], facets[wrong, 1].copy()
        return facets

    def bulk(self, degree):
        mu, la = YOUNG / (2 * (1 + POISSON)), YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
        f = ufl.Identity(3) + ufl.grad(self.u)
        p = mu * (f - ufl.inv(f).T) + la * ufl.ln(ufl.det(f)) * ufl.inv(f).T  # Bonet and Wood's neo-Hooke
        weak = ufl.inner(p, ufl.grad(ufl.TestFunction(self.space))) * ufl.dx(metadata={"quadrature_degree": degree})
        with self.times("forms"):
            self.residual, self.jacobian = fem.form(weak), fem.form(ufl.derivative(weak, self.u))

    def conditions(self, blocks):
        self.bcs, self.values = [], []
        for block in (0, 1):
            nodes = np.flatnonzero(blocks.side(self.numbers, block, block == 1)).astype(np.int32)
            for i in range(3):
                value = fem.Constant(self.mesh, 0.0)
                self.bcs.append(fem.dirichletbc(value, 3 * nodes + i, self.space.sub(i)))
                self.values.append(value)
            if block == 0:
                self.support = nodes[nodes < self.space.dofmap.index_map.size_local]

    def solver(self, position):
        self.vector = fem_petsc.create_vector(self.residual)
        coordinates = self.vector.duplicate()
        coordinates.array[:] = position.ravel()
        coordinates.setBlockSize(3)
        self.rigid = PETSc.NullSpace().createRigidBody(coordinates)
        options = PETSc.Options()
        for name, value in (("pc_type", self.given.solver), ("ksp_type", "gmres"), ("ksp_rtol", 1e-8), ("ksp_gmres_restart", 60), ("ksp_max_it", 600),
                            ("pc_gamg_threshold", 0.01), ("pc_gamg_agg_nsmooths", 1), ("mg_levels_ksp_type", "chebyshev"), ("mg_levels_pc_type", "jacobi"),
                            ("pc_hypre_boomeramg_strong_threshold", 0.5), ("pc_hypre_boomeramg_nodal_coarsen", 4)):
            if not options.hasName(name):
                options.setValue(name, value)
        self.snes = None
        self.new_solver()

    def new_solver(self):
        """Without the memory of the one before: its matrix and its preconditioner."""
        if self.snes:
            self.snes.destroy()
        ksp = PETSc.KSP().create(self.comm)
        ksp.setFromOptions()
        self.snes = snes = PETSc.SNES().create(self.comm)
        snes.setKSP(ksp)
        snes.setFunction(self.function, self.vector)
        snes.setTolerances(rtol=0, atol=1e-9 * YOUNG * PRESS, stol=0, max_it=30)

    def function(self, snes, x, b):
        x.copy(self.u.vector)
        self.u.x.scatter_forward()
        with self.times("forces of the bodies"):
            with b.localForm() as local:
                local.set(0)
            fem_petsc.assemble_vector(b, self.residual)
            fem_petsc.apply_lifting(b, [self.jacobian], [self.bcs], [self.u.vector], -1.0)
            b.ghostUpdate(PETSc.InsertMode.ADD, PETSc.ScatterMode.REVERSE)
        try:
            with self.times("contact"):
                (equations, forces), self.tangent = self.contact.update(self.u.x.array)
        except ents.CutStep:
            if snes is None:
                raise
            b.set(np.inf)  # on all processes: the line search halves its step
            return
        self.stale, self.evaluations = self.stale or self.contact.pattern_changed, self.evaluations + 1
        b.setValues(equations, forces, PETSc.InsertMode.ADD)
        b.assemble()
        fem_petsc.set_bc(b, self.bcs, x, -1.0)

    def derivative(self, snes, x, j, p):
        """The tangent of the last function(): SNES asks for it where it has just evaluated that."""
        with self.times("matrix"):
            k = self.tangent
            j.zeroEntries()
            fem_petsc.assemble_matrix(j, self.jacobian, self.bcs)
            j.assemble(PETSc.Mat.AssemblyType.FLUSH)
            j.setValuesIJV(k.begin, k.columns, k.values, PETSc.InsertMode.ADD, rowmap=k.rows)
            j.assemble()

    def pattern(self):
        """A matrix with places for the bodies and for contact."""
        with self.times("pattern"):
            k = self.tangent
            self.matrix = None  # its memory first
            self.new_solver()
            bodies = fem_petsc.create_matrix(self.jacobian)
            fem_petsc.assemble_matrix(bodies, self.jacobian, self.bcs)
            bodies.assemble()
            maps = bodies.getLGMap()
            entries = self.vector.duplicate()  # of each row, an upper bound: processes may give the same ones
            entries.set(0)
            entries.setValues(k.rows, np.diff(k.begin).astype(float), PETSc.InsertMode.ADD)
            entries.assemble()
            most, (rows, columns) = entries.array.astype(PETSc.IntType), bodies.getSizes()
            contact = PETSc.Mat().createAIJ((rows, columns), nnz=(np.minimum(most, columns[0]), np.minimum(most, columns[1] - columns[0])), comm=self.comm)
            contact.setValuesIJV(k.begin, k.columns, np.zeros(len(k.values)), PETSc.InsertMode.ADD, rowmap=k.rows)
            contact.assemble()
            bodies.axpy(1.0, contact, PETSc.Mat.Structure.DIFFERENT_NONZERO_PATTERN)
            bodies.setLGMap(*maps)
            bodies.setNearNullSpace(self.rigid)
            self.matrix, self.stale, self.rebuilt = bodies, False, self.rebuilt + 1

    def newton(self, x):
        """SNES, one iteration at a time while the places of contact change. Returns iterations of Newton and GMRES."""
        newton = krylov = 0
        self.function(None, x, self.vector)
        while newton < 40:  # the vector holds the forces at x, which a line search has evaluated last
            if self.vector.norm() <= 1e-9 * YOUNG * PRESS:
                return newton, krylov
            if self.stale:
                self.pattern()
            self.snes.setJacobian(self.derivative, self.matrix)
            self.snes.setTolerances(max_it=1)
            with self.times("Newton, all"):
                self.snes.solve(None, x)
            if self.snes.getConvergedReason() not in (-5, 2, 3, 4):  # -5: the one iteration is done
                break
            newton, krylov = newton + self.snes.getIterationNumber(), krylov + self.snes.getLinearSolveIterations()
        raise ents.CutStep(ents.Status.NO_PROJECTION, f"no convergence in {newton} iterations: {self.snes.getConvergedReason()}")

    def solve(self):
        """Forces [step][3] on the support, iterations [step]."""
        x, results, first = self.u.vector.copy(), [], 0
        file = None if self.given.checkpoint is None else f"{self.given.checkpoint}.{self.comm.rank}.npz"
        if self.given.restart:
            self.contact.load(file)
            with np.load(file) as saved:
                first = int(saved["step"]) + 1
                x.array[:] = saved["x"]
        for step in range(first, self.given.steps):
            self.values[3].value, self.values[5].value = 0.25 / self.given.waves * step, -GAP - PRESS
            newton, krylov = self.newton(x)
            self.contact.commit()
            b = fem_petsc.create_vector(self.residual)
            fem_petsc.assemble_vector(b, self.residual)
            b.ghostUpdate(PETSc.InsertMode.ADD, PETSc.ScatterMode.REVERSE)
            force = self.comm.allreduce(b.array.reshape(-1, 3)[self.support].sum(axis=0))
            results.append({"force": force.tolist(), "newton": newton, "krylov": krylov})
            self.say(f"step {step + 1}/{self.given.steps}  Newton {newton:2d}  GMRES {krylov:4d}  force on the support "
                     + " ".join(f"{value:+.10f}" for value in force) + f"  in contact {self.comm.allreduce(int((self.contact.pressure > 0).sum()))}")
            if file:
                self.contact.save(file, step=step, x=x.array)
        return results

    def say(self, text):
        if self.comm.rank == 0:
            print(text, flush=True)

    def report(self, total):
        """Memory, times and sizes: the largest of all processes."""
        most = lambda value: self.comm.allreduce(value, op=MPI.MAX)
        sizes = {name: most(value) for name, value in self.contact.sizes.items()}
        points = self.comm.allreduce(self.contact.sizes["slave_points"])
        for k, clock in enumerate(("wall clock", "processor")):
            times = {name: most(float(value[k])) for name, value in sorted(self.times.items())}
            self.say(f"seconds, {clock}: " + ", ".join(f"{name} {value:.2f}" for name, value in times.items()) + f", in all {most(float(total[k])):.2f}")
        self.say(f"contact: {self.evaluations} evaluations, {1e6 * times['contact'] / (self.evaluations * sizes['slave_points']):.2f} us of the processor a slave point (on the "
                 f"process that has most); {100 * times['contact'] / most(float(total[1])):.1f} % of the time; {self.rebuilt} patterns")
        self.say("largest of a process: " + ", ".join(f"{name} {value}" for name, value in sizes.items()))


def main(given):
    begin = Times.now()
    host = Host(given, Times())
    host.say(f"{host.comm.size} processes, {3 * host.space.dofmap.index_map.size_global} unknowns, {given.cells}")
    results = host.solve()
    host.report(Times.now() - begin)
    if given.out:
        with dolfinx.io.XDMFFile(host.comm, str(given.out / "scale.xdmf"), "w") as file:
            file.write_mesh(host.mesh)
            host.u.name = "u"
            file.write_function(host.u)
    if given.write and host.comm.rank == 0:
        given.write.write_text(json.dumps(results))
    if given.compare:
        wanted = np.array([step["force"] for step in json.loads(given.compare.read_text())])
        worst = np.abs(np.array([step["force"] for step in results]) - wanted[-len(results):]).max() / np.abs(wanted).max()
        host.say(f"largest difference of a force from {given.compare.name}: {worst:.1e}")
        if not worst < 1e-8:
            sys.exit(1)


if __name__ == "__main__":
    main(ARGUMENTS)
