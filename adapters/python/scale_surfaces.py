#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What distributed surfaces cost, without bodies: a slave surface slides over a wavy master, both cut into patches of processes. Positions are prescribed.
scale.py has the bodies; there the mesh decides which process gets which part, here each gets an equal one.

usage: scale_surfaces.py [-n N] [--margin M] [--slide EDGES] [--depth EDGES] [--evaluations N] [--write FILE] [--compare FILE]
       mpirun -n P python3 -m mpi4py scale_surfaces.py ...

-n             facets of the master along x and y; the slave's are 0.8 of that size and cover 0.5 x 0.6 of it. Default 100
--margin       of ents.Contact, in edges of a facet; default: that of ents.Contact
--slide        way of the slave surface in all, in edges; default 4
--depth        how far the slave surface is pressed in, in edges; with 0.3 every point is in contact; default 0.03
--evaluations  residuals and tangents in all; default 40
--write        the forces as JSON; --compare: they have to be those of such a file, to 1e-10

exit status: 0 done; 1 other forces; 2 wrong command line; 3 a package is missing (Debian: python3-scipy python3-mpi4py)"""
import argparse
import json
import pathlib
import sys
import time


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-n", type=int, default=100)
    parser.add_argument("--margin", type=float)
    parser.add_argument("--slide", type=float, default=4.0)
    parser.add_argument("--depth", type=float, default=0.03)
    parser.add_argument("--evaluations", type=int, default=40)
    for name in ("--write", "--compare"):
        parser.add_argument(name, type=pathlib.Path)
    given = parser.parse_args()
    if given.n < 5 or given.evaluations < 1 or not 0 <= given.slide <= 0.25 * given.n:
        parser.error("-n is at least 5, --evaluations at least 1, --slide 0 to N/4")
    return given


ARGUMENTS = arguments() if __name__ == "__main__" else None  # before the imports: --help needs none of them
try:
    import numpy as np
    import scipy  # noqa: F401
    from mpi4py import MPI
except ModuleNotFoundError as error:
    print(f"scale_surfaces.py: skipped: {error} (Debian: python3-scipy, python3-mpi4py)")
    sys.exit(3)
import ents


class Sheet:
    """A grid of nodes on [low, high], numbered from `first`, of which a process gets the patch in its place of rows x columns of processes."""

    def __init__(self, comm, low, high, z, edge, first, up):
        n = np.maximum(1, np.round((np.array(high) - low) / edge)).astype(int)
        rows = max(r for r in range(1, int(comm.size ** 0.5) + 1) if comm.size % r == 0)
        shape = np.array([comm.size // rows, rows])
        cut = lambda rank, axis, more: (n[axis] + more) * (np.array([rank // rows, rank % rows])[axis] + np.array([0, 1])) // shape[axis]
        cells = [np.arange(*cut(comm.rank, axis, 0)) for axis in (0, 1)]
        own = [np.arange(*cut(comm.rank, axis, 1)) for axis in (0, 1)]
        number = lambda i, j: first + i * (n[1] + 1) + j
        i, j = (a.ravel() for a in np.meshgrid(*cells, indexing="ij"))
        ring = ((0, 0), (1, 0), (1, 1), (0, 1))
        self.facets = np.column_stack([number(i + a, j + b) for a, b in (ring if up else ring[::-1])])
        self.numbers = np.unique(np.r_[self.facets.ravel(), number(*np.meshgrid(*own, indexing="ij")).ravel()])
        place = np.column_stack(np.divmod(self.numbers - first, n[1] + 1))
        self.positions = np.column_stack([low + (np.array(high) - low) * place / n, np.full(len(place), z)])
        of = [np.searchsorted([(n[axis] + 1) * k // shape[axis] for k in range(1, shape[axis])], place[:, axis], side="right") for axis in (0, 1)]
        self.owners, self.end = of[0] * rows + of[1], first + (n[0] + 1) * (n[1] + 1)


def main(given):
    comm, edge = MPI.COMM_WORLD, 1.0 / given.n
    master = Sheet(comm, (0, 0), (1, 1), 0.0, edge, 0, True)
    slave = Sheet(comm, (0.12, 0.2), (0.62, 0.8), 0.02 * edge, 0.8 * edge, master.end, False)
    wave = lambda amplitude, vector: {"type": "sine", "amplitude": amplitude, "wave_vector": vector}
    model = {"segment": "quad4", "border": 1e-5, "height": {"type": "product", "of": [wave(0.03 * edge, [1.3 / edge, 0]), wave(1.0, [0, 0.9 / edge])]},
             "contact": {"normal": {"type": "penalty", "stiffness": 1e3}, "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 300.0}}}
    numbers = np.r_[master.numbers, slave.numbers]
    place = np.argsort(numbers)
    find = lambda facets: place[np.searchsorted(numbers[place], facets)]
    contact = ents.Contact(model, np.vstack([master.positions, slave.positions]), find(slave.facets), find(master.facets), numbers=numbers,
                           owners=np.r_[master.owners, slave.owners], comm=comm, surface_coordinates="xy", margin=None if given.margin is None else given.margin * edge)
    forces, wall, processor = [], 0.0, 0.0
    for step in range(given.evaluations):
        u = np.zeros((len(numbers), 3))
        u[len(master.numbers):] = [given.slide * edge * (step + 1) / given.evaluations, 0, -given.depth * edge]
        begin = time.perf_counter(), time.process_time()
        (equations, values), _ = contact.update(u)
        contact.commit()
        wall, processor = wall + time.perf_counter() - begin[0], processor + time.process_time() - begin[1]
        upper = equations >= 3 * master.end
        forces.append(comm.allreduce(np.bincount(equations[upper] % 3, values[upper], 3)).tolist())
    most = lambda value: comm.allreduce(value, op=MPI.MAX)
    sizes = {name: most(value) for name, value in contact.sizes.items()}
    points = most(int(contact.sizes["slave_points"]))
    if comm.rank == 0:
        print(f"{comm.size} processes, {given.n} x {given.n} facets, margin {contact.margin / edge:.2f} edges; force {forces[-1][0]:+.10e} {forces[-1][2]:+.10e}")
    each = [1e6 * most(seconds) / (given.evaluations * points) for seconds in (wall, processor)]
    if comm.rank == 0:
        print("largest of a process: " + ", ".join(f"{name} {value}" for name, value in sizes.items()))
        print(f"a slave point, of the process that has most: {each[0]:.2f} us by the wall clock, {each[1]:.2f} us of the processor", flush=True)
    if given.write and comm.rank == 0:
        given.write.write_text(json.dumps(forces))
    if given.compare:
        wanted = np.array(json.loads(given.compare.read_text()))
        worst = np.abs(np.array(forces) - wanted).max() / np.abs(wanted).max()
        if comm.rank == 0:
            print(f"largest difference of a force from {given.compare.name}: {worst:.1e}")
        if not worst < 1e-10:
            sys.exit(1)


if __name__ == "__main__":
    main(ARGUMENTS)
