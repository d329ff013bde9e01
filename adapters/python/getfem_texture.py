#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A soft block on a stiff textured one, twice in GetFEM: with GetFEM's own contact on a fine mesh that has the texture in its nodes, and with ents on
a coarse flat mesh, where the texture is a height on the segments.

usage: getfem_texture.py

GetFEM's contact is the large sliding brick with ray tracing and an augmented Lagrangian; ents has a penalty. The slave's mesh, the bulk (neo-Hooke at finite
strain), supports and Newton's iteration are the same. Prints unknowns, segments of the master, time, iterations and forces for two meshes of the slave,
and checks that both find the same forces within what the second mesh changes in them.
exit status: 0 done; 1 no convergence, or other forces; 2 wrong command line; 3 GetFEM, NumPy or SciPy is missing (Debian: python3-getfem++ python3-scipy)"""
import argparse
import time

if __name__ == "__main__":  # before the imports: --help needs none of them
    argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter).parse_args()
import getfem_block
from getfem_block import gf, np, sparse, spsolve

AMPLITUDE, WAVE, PHASE = 0.02, 1.6, 0.4
STEPS, PUSH = 5, 0.1
SLAVE, FLAT, TEXTURED = (24, 20), (8, 4), (96, 8)  # divisions in x, y; TEXTURED: 15 segments a wave


def scene(slave, master):
    """slave, master: divisions [x, y]."""
    axis = lambda a, b, n: {"from": a, "pieces": [{"to": b, "divisions": n}]}
    return {
        "materials": {"soft": {"young": 1000.0, "poisson": 0.3}, "stiff": {"young": 1e5, "poisson": 0.3}},
        "parts": [{"name": "lower", "material": "stiff", "x": axis(0, 4, master[0]), "y": axis(0, 2, master[1])},
                  {"name": "upper", "material": "soft", "x": axis(1.1, 2.95, slave[0]), "y": axis(2 + AMPLITUDE, 3.5 + AMPLITUDE, slave[1])}],
        "supports": [{"nodes": "lower.y_min", "x": 0, "y": 0}, {"nodes": "upper.y_max", "x": 0, "y": -PUSH}],
        "contact": {"slave": "upper.y_min", "master": {"faces": "lower.y_max", "surface_coordinates": ["x"]},
                    "model": {"segment": "bspline4", "height": {"type": "sine", "amplitude": AMPLITUDE, "wave_vector": [WAVE], "phase": PHASE},
                              "contact": {"normal": {"type": "penalty", "stiffness": 3e5}}}},
        # a relative residual of 1e-12 is below the roundings of the stiff block's forces
        "steps": {"values": [{"count": STEPS}]}, "solver": {"tolerance": 1e-10}}


def unknowns(problem):
    axes = [[part[axis]["pieces"][0]["divisions"] + 1 for axis in "xy"] for part in problem["parts"]]
    return sum(2 * nx * ny for nx, ny in axes)


def own_contact(problem):
    """The same with GetFEM's contact; nodes of the master's mesh are where the texture is. Returns forces and iterations as getfem_block.solve, and unknowns."""
    gf.util_trace_level(0)
    blocks = {part["name"]: getfem_block.Block(part, 1) for part in problem["parts"]}
    lower, upper = blocks["lower"], blocks["upper"]
    supported = [(blocks[name], blocks[name].side(side), support) for support in problem["supports"] for name, side in [support["nodes"].split(".")]]
    points = lower.mesh.pts()
    # all of the height at the top, none at the middle and below
    points[1] += np.clip(points[1] - 1, 0, 1) * AMPLITUDE * np.sin(2 * np.pi * WAVE * points[0] + PHASE)
    lower.mesh.set_pts(points)
    slave, master = 1, 2  # regions
    upper.mesh.set_region(slave, upper.mesh.outer_faces_with_direction([0, -1], 0.1))
    lower.mesh.set_region(master, lower.mesh.outer_faces_with_direction([0, 1], 0.5))

    md = gf.Model("real")
    for b in blocks.values():
        getfem_block.add_bulk(md, b, problem["materials"][b.material])
    of_pressure = gf.MeshFem(upper.mesh, 2)
    of_pressure.set_classical_fem(1)
    md.add_filtered_fem_variable("lambda", of_pressure, slave)
    for name, value in (("r", 10 * problem["materials"]["soft"]["young"]), ("f", 0.0), ("alpha", 1.0)):
        md.add_initialized_data(name, [value])
    brick = md.add_integral_large_sliding_contact_brick_raytracing("r", 0.3, "f", "alpha", 0)  # rays of 0.3 at most
    points_of_contact = gf.MeshIm(upper.mesh, gf.Integ("IM_GAUSS_PARALLELEPIPED(2,4)"))
    md.add_slave_contact_boundary_to_large_sliding_contact_brick(brick, points_of_contact, slave, "u_upper", "lambda")
    md.add_master_contact_boundary_to_large_sliding_contact_brick(brick, lower.integration, master, "u_lower")
    for b in blocks.values():
        b.first = int(md.interval_of_variable("u_" + b.name)[0])
    size = len(md.from_variables())
    prescribed, fixed = np.zeros(size), np.zeros(size, bool)
    for b, nodes, support in supported:
        at = b.dofs(nodes)
        fixed[at], prescribed[at] = True, [support["x"], support["y"]]
    free, bottom = np.flatnonzero(~fixed), lower.dofs(supported[0][1])

    u = np.zeros(size)
    forces, iterations = [], []
    for step in range(1, STEPS + 1):
        increment = prescribed * step / STEPS - np.where(fixed, u, 0)
        for iteration in range(getfem_block.ITERATIONS + 1):
            md.to_variables(u)
            md.assembly("build_all")
            k = md.tangent_matrix()
            k = sparse.csc_matrix((k.csc_val(), k.csc_ind()[1], k.csc_ind()[0]), (size, size))
            residual = -md.rhs()
            scale = np.linalg.norm(residual[fixed])
            error = np.linalg.norm(residual[free]) / scale if scale else 1
            if not increment.any() and error <= problem["solver"]["tolerance"]:
                break
            if iteration == getfem_block.ITERATIONS:
                raise SystemExit(f"GetFEM's contact, step {step}: no convergence in {iteration} iterations, |r| = {error:.1e}")
            du = increment.copy()
            du[free] = spsolve(k[free][:, free], -residual[free] - k[free] @ increment)
            u += du
            increment = np.zeros(size)
        forces.append(residual[bottom].sum(axis=0))
        iterations.append(iteration)
    return np.array(forces), iterations, size


def main():
    print("contact       slave  master   master's  unknowns  time [s]  iterations  force on the support, all steps")
    print("              cells  cells    segments")
    found = {}
    for n in (1, 2):
        slave = [n * d for d in SLAVE]
        for name in ("ents, flat", "GetFEM's own"):
            start = time.perf_counter()
            if name == "ents, flat":
                master = FLAT
                problem = scene(slave, master)
                forces, iterations = getfem_block.solve(problem, report=lambda text: None)
                size = unknowns(problem)
            else:
                master = [n * d for d in TEXTURED]
                forces, iterations, size = own_contact(scene(slave, master))
            seconds = time.perf_counter() - start
            found[name, n] = forces
            print(f"{name:12}  {slave[0]}x{slave[1]}  {master[0]:3}x{master[1]:<2} {master[0]:8}  {size:8}  {seconds:8.2f}  {' '.join(map(str, iterations)):10}  "
                  f"{' '.join(f'{y:.3f}' for y in forces[:, 1])}", flush=True)
    of = lambda a, b: np.abs(a - b).max()
    meshes = sum(of(found[name, 1], found[name, 2]) for name in ("ents, flat", "GetFEM's own"))
    difference, size = of(found["ents, flat", 2], found["GetFEM's own", 2]), np.abs(found["GetFEM's own", 2]).max()
    print(f"largest difference {difference / size:.1e} of the largest force; what the second mesh changed in the two {meshes / size:.1e}")
    if not difference <= meshes:
        raise SystemExit("the forces differ by more than the meshes explain")


if __name__ == "__main__":
    main()
