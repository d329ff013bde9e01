#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""GetFEM solves block.json: a block is pressed into a textured one. Bulk and its tangent are GetFEM's, contact is ents.Contact.

usage: getfem_block.py [SCENE] [--variant NAME] [--compare RESULT] [--refine N]

SCENE      a scene of ents-lab with two blocks, quad4 or tri3, "neo_hooke" or "st_venant_kirchhoff" materials and "line2", "catmull_rom4" or
           "bspline4" segments, with friction or without; default: block.json beside this script
--variant  one of the scene's variants
--compare  result.json that `ents-lab run SCENE --out DIR` left in DIR: the forces have to be the same
--refine   N times as many elements in each direction (not with --compare)

exit status: 0 done; 1 no convergence, or other forces; 2 wrong command line; 3 GetFEM, NumPy or SciPy is missing (Debian: python3-getfem++ python3-scipy)"""
import pathlib
import sys

import block

ARGUMENTS = block.arguments(__doc__) if __name__ == "__main__" else None  # before the imports: --help needs none of them
try:
    import getfem as gf
    import numpy as np
    import scipy.sparse as sparse
    from scipy.sparse.linalg import spsolve
except ModuleNotFoundError as error:
    print(f"{pathlib.Path(sys.argv[0]).name}: {error}; Debian has it in python3-getfem++, python3-numpy, python3-scipy, for /usr/bin/python3")
    sys.exit(3)
import ents

ITERATIONS = 25


class Block:
    """A structured block of `part`: its GetFEM mesh, and how its nodes are found among the dofs."""

    def __init__(self, part, refine):
        axes = []
        for axis in (part["x"], part["y"]):
            piece, = axis["pieces"]
            axes.append(np.linspace(axis["from"], piece["to"], piece["divisions"] * refine + 1))
        self.name, self.material = part["name"], part["material"]
        self.mesh, rule = gf.Mesh("cartesian", *axes), "IM_GAUSS_PARALLELEPIPED(2,3)"  # 2 x 2 points
        if part.get("element") == "tri3":
            self.mesh, rule = gf.Mesh("empty", 2), "IM_TRIANGLE(1)"
            x, y = np.meshgrid(*axes)
            corners = [np.stack([grid[j:j - 1 or None, i:i - 1 or None].ravel() for grid in (x, y)]) for j, i in ((0, 0), (0, 1), (1, 1), (1, 0))]
            for triangle in ((0, 1, 2), (0, 2, 3)):  # ents-lab cuts its cells along this diagonal
                self.mesh.add_convex(gf.GeoTrans("GT_PK(2,1)"), np.stack([corners[c] for c in triangle], axis=1))
        self.fem = gf.MeshFem(self.mesh, 2)
        self.fem.set_classical_fem(1)
        self.integration = gf.MeshIm(self.mesh, gf.Integ(rule))
        self.nodes = self.fem.basic_dof_nodes()[:, ::2].T  # [node][2]; dofs of a node: 2 node, 2 node + 1
        self.first = None  # of its dofs among the model's

    def side(self, which):
        """Nodes of "x_min" ... "y_max", along the side."""
        axis = "xy".index(which[0])
        at = self.nodes[:, axis].min() if which.endswith("min") else self.nodes[:, axis].max()
        on = np.flatnonzero(np.abs(self.nodes[:, axis] - at) < 1e-9)
        return on[np.argsort(self.nodes[on, 1 - axis])]

    def dofs(self, nodes):
        return self.first + 2 * np.asarray(nodes)[:, None] + [0, 1]


def add_bulk(md, b, material):
    """The block's displacements, "u_" and its name, and their internal forces."""
    young, nu = material["young"], material["poisson"]
    u = "u_" + b.name
    md.add_fem_variable(u, b.fem)
    md.add_initialized_data("mu_" + b.name, [young / (2 * (1 + nu))])
    md.add_initialized_data("la_" + b.name, [young * nu / ((1 + nu) * (1 - 2 * nu))])
    f = f"(Id(2)+Grad_{u})"
    mu, la = "mu_" + b.name, "la_" + b.name
    if material.get("law") == "st_venant_kirchhoff":
        e = f"(0.5*({f}'*{f}-Id(2)))"
        stress = f"{f}*({la}*Trace({e})*Id(2)+2*{mu}*{e})"
    else:  # Bonet and Wood's neo-Hooke: P = mu (F - F^-T) + lambda ln J F^-T
        stress = f"{mu}*({f}-Inv({f})')+{la}*log(Det({f}))*Inv({f})'"
    md.add_nonlinear_term(b.integration, f"({stress}):Grad_Test_{u}")


def solve(scene, refine=1, report=print):
    """Forces [step][2] on the support of the lower block, and iterations [step]."""
    blocks = {part["name"]: Block(part, refine) for part in scene["parts"]}
    gf.util_trace_level(0)
    md = gf.Model("real")
    for b in blocks.values():
        add_bulk(md, b, scene["materials"][b.material])
    for b in blocks.values():
        b.first = int(md.interval_of_variable("u_" + b.name)[0])
    size = int(sum(md.interval_of_variable("u_" + name)[1] for name in blocks))

    contact = scene["contact"]
    slave_block, slave_side = contact["slave"].split(".")
    master_block, master_side = contact["master"]["faces"].split(".")
    slaves, masters = blocks[slave_block].side(slave_side), blocks[master_block].side(master_side)
    chain = lambda first, n: first + np.column_stack([np.arange(n - 1), np.arange(1, n)])  # left to right: the normal points up, out of the lower block
    surfaces = ents.Contact(
        contact["model"], np.vstack([blocks[slave_block].nodes[slaves], blocks[master_block].nodes[masters]]), chain(0, len(slaves))[:, ::-1],
        chain(len(slaves), len(masters)), dofs=np.vstack([blocks[slave_block].dofs(slaves), blocks[master_block].dofs(masters)]), rows=size, reach=0.25,
        surface_coordinates="x" if "surface_coordinates" in contact["master"] else None, ends=ents.ENDS_REPEATED)  # as ents-lab has them

    prescribed = np.zeros(size)
    fixed = np.zeros(size, bool)
    for support in scene["supports"]:
        name, side = support["nodes"].split(".")
        for axis in "xy":
            if axis in support:
                at = blocks[name].dofs(blocks[name].side(side))[:, "xy".index(axis)]
                fixed[at], prescribed[at] = True, support[axis]
    free = np.flatnonzero(~fixed)
    bottom = blocks[master_block].dofs(blocks[master_block].side("y_min"))

    steps, tolerance = scene["steps"]["values"][0]["count"], scene.get("solver", {}).get("tolerance", 1e-12)
    u = np.zeros(size)
    forces, iterations = [], []
    for step in range(1, steps + 1):
        increment = prescribed * step / steps - np.where(fixed, u, 0)
        for iteration in range(ITERATIONS + 1):
            md.to_variables(u)
            md.assembly("build_all")
            k = md.tangent_matrix()
            k = sparse.csc_matrix((k.csc_val(), k.csc_ind()[1], k.csc_ind()[0]), (size, size))
            residual = -md.rhs()
            try:
                r, tangent = surfaces.update(u)
            except ents.CutStep as cut:
                raise SystemExit(f"step {step}: {cut}") from None
            residual = residual + r
            k = k + tangent
            scale = max(np.linalg.norm(residual[fixed]), np.linalg.norm(r))
            error = np.linalg.norm(residual[free]) / scale if scale else 1
            if not increment.any() and error <= tolerance:
                break
            if iteration == ITERATIONS:
                raise SystemExit(f"step {step}: no convergence in {ITERATIONS} iterations, |r| = {error:.1e}")
            du = increment.copy()
            du[free] = spsolve(k[free][:, free], -residual[free] - k[free] @ increment)
            u += du
            if not np.isfinite(u).all():
                raise SystemExit(f"step {step}: the displacements are not finite after {iteration + 1} iterations; smaller steps?")
            increment = np.zeros(size)
        surfaces.commit()
        forces.append(residual[bottom].sum(axis=0))
        iterations.append(iteration)
        report(f"step {step}/{steps}  iterations {iteration:2d}  |r| {error:.0e}  force on the support {forces[-1][0]:+.12f} {forces[-1][1]:+.12f}")
    return np.array(forces), iterations


def main(arguments):
    forces, iterations = solve(block.variant_of(arguments.scene, arguments.variant), arguments.refine)
    if arguments.compare:
        block.compare(forces, iterations, arguments.compare)


if __name__ == "__main__":
    main(ARGUMENTS)
