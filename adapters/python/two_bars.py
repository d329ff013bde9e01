#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Heat through two bars that are pressed together: elasticity and conduction are GetFEM's or dolfinx's, the contact is ents.Contact with temperatures.

usage: two_bars.py getfem|dolfinx [--conductance H] [--hot T] [--press U]

--conductance  of the gap, power per area and temperature; default 10
--hot          temperature of the upper end, the lower one has 0; default 7
--press        displacement of the upper end, downwards; default 0.01

The flow has a closed form, q = T / (L_1 / k_1 + 1 / H + L_2 / k_2), and the problem is linear: one solution, no iteration.

exit status: 0 the flow is that; 1 it is not; 2 wrong command line; 3 the host is missing (Debian: python3-getfem++, python3-dolfinx-real)"""
import argparse
import sys

PARSER = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
PARSER.add_argument("host", choices=("getfem", "dolfinx"))
for option, value in (("--conductance", 10.0), ("--hot", 7.0), ("--press", 0.01)):
    PARSER.add_argument(option, type=float, default=value)
ARGUMENTS = PARSER.parse_args()  # before the imports: --help needs none of them
try:
    import numpy as np
    import scipy.sparse as sparse
    from scipy.sparse.linalg import spsolve
    if ARGUMENTS.host == "getfem":
        import getfem as gf
    else:
        import dolfinx
        import ufl
        from dolfinx import fem
        from mpi4py import MPI
except ModuleNotFoundError as error:
    print(f"two_bars.py: {error}; Debian has it in python3-getfem++, python3-dolfinx-real, for /usr/bin/python3")
    sys.exit(3)
import ents

BARS = ((0.0, 1.0, 2.0), (1.0, 2.5, 5.0))  # from, to, conductivity
MODULUS, CELLS = 1e3, (4, 3)


def of_getfem(low, high, conductivity):
    """Positions of the nodes [n][2], stiffness of u [2n][2n], node by node, and conduction [n][n]."""
    mesh = gf.Mesh("cartesian", np.linspace(0, 1, CELLS[0] + 1), np.linspace(low, high, CELLS[1] + 1))
    vector, scalar = gf.MeshFem(mesh, 2), gf.MeshFem(mesh, 1)
    vector.set_classical_fem(1), scalar.set_classical_fem(1)
    rule = gf.MeshIm(mesh, gf.Integ("IM_GAUSS_PARALLELEPIPED(2,3)"))

    def matrix(fem, text):
        k = gf.asm_generic(rule, 2, text, -1, "u", 1, fem, np.zeros(fem.nbdof()))
        columns, rows = k.csc_ind()
        return sparse.csc_matrix((k.csc_val(), rows, columns), (fem.nbdof(), fem.nbdof()))
    gf.util_trace_level(0)
    stiffness = matrix(vector, f"{MODULUS}*Sym(Grad_u):Grad_Test_u")
    return scalar.basic_dof_nodes().T, stiffness, matrix(scalar, f"{conductivity}*Grad_u.Grad_Test_u")


def of_dolfinx(low, high, conductivity):
    mesh = dolfinx.mesh.create_rectangle(MPI.COMM_SELF, [[0, low], [1, high]], CELLS, dolfinx.mesh.CellType.quadrilateral)
    vector, scalar = fem.VectorFunctionSpace(mesh, ("Lagrange", 1)), fem.FunctionSpace(mesh, ("Lagrange", 1))

    def matrix(form):
        k = fem.petsc.assemble_matrix(fem.form(form))
        k.assemble()
        begin, columns, values = k.getValuesCSR()
        return sparse.csr_matrix((values, columns, begin))
    u, v, t, s = ufl.TrialFunction(vector), ufl.TestFunction(vector), ufl.TrialFunction(scalar), ufl.TestFunction(scalar)
    stiffness = matrix(MODULUS * ufl.inner(ufl.sym(ufl.grad(u)), ufl.grad(v)) * ufl.dx)
    return scalar.tabulate_dof_coordinates()[:, :2], stiffness, matrix(conductivity * ufl.inner(ufl.grad(t), ufl.grad(s)) * ufl.dx)


def main():
    parts = [globals()["of_" + ARGUMENTS.host](*bar) for bar in BARS]
    counts = [len(part[0]) for part in parts]
    x, nodes = np.vstack([part[0] for part in parts]), sum(counts)
    # The host's equations: all displacements, then all temperatures. What contact has to know is where each node has its own.
    bulk = sparse.block_diag([part[1] for part in parts] + [part[2] for part in parts], "csr")
    dofs = np.column_stack([2 * np.arange(nodes), 2 * np.arange(nodes) + 1, 2 * nodes + np.arange(nodes)])

    def row(bar, y):
        on = np.flatnonzero((np.abs(x[:, 1] - y) < 1e-9) & ((np.arange(nodes) < counts[0]) == (bar == 0)))
        return on[np.argsort(x[on, 0])]
    master, slave = row(0, 1.0), row(1, 1.0)
    contact = ents.Contact({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 1e5}, "heat": {"conductance": ARGUMENTS.conductance}}}, x,
                           np.column_stack([slave[1:], slave[:-1]]), np.column_stack([master[:-1], master[1:]]), dofs=dofs)
    u = np.zeros(3 * nodes)
    u[dofs[:counts[0], 1]] = 1e-7  # touching: the contact of the solution is that of the begin
    ends = row(0, 0.0), row(1, 2.5)
    for end, values in zip(ends, ((0, 0, 0), (0, -ARGUMENTS.press, ARGUMENTS.hot))):
        u[dofs[end]] = values
    free = np.setdiff1d(np.arange(3 * nodes), dofs[np.concatenate(ends)])
    for iteration in range(10):
        residual, tangent = contact.update(u)
        residual = residual + bulk @ u
        size = np.abs(residual[free]).max()
        print(f"iteration {iteration}: largest residual {size:.2e}")
        if size < 1e-11:
            break
        u[free] -= spsolve((tangent + bulk).tocsc()[free][:, free], residual[free])
    flow = residual[dofs[ends[1], 2]].sum()
    exact = ARGUMENTS.hot / (sum((high - low) / k for low, high, k in BARS) + 1 / ARGUMENTS.conductance)
    error = max(abs(flow / exact - 1), abs(contact.heat[:, 0].sum() / exact - 1))
    print(f"flow {flow:.12f}, exact {exact:.12f}; through the gap {contact.heat[:, 0].sum():.12f}; larger error {error:.1e}, bound 1e-10; "
          f"pressure {contact.pressure.min():.6g} to {contact.pressure.max():.6g}")
    if not (error < 1e-10 and size < 1e-11):
        sys.exit("the flow is another one")


if __name__ == "__main__":
    main()
