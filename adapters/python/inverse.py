#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""An inverse problem: which amplitude and phase of a sinusoidal texture press the two halves of an elastic layer as wanted?

usage: inverse.py [MEAN PRESSURE OF THE LEFT HALF] [OF THE RIGHT HALF]

The texture is a height on ONE rigid segment; amplitude and phase are named parameters of the model. Newton's method on the two
numbers; the derivatives of the mean pressures come from one adjoint solution each and ents' lambda . dR/dtheta, without differences.
exit status: 0 found; 1 not found in 30 linear solutions; 2 the command line is wrong; 3 NumPy, SciPy or libents.so is missing"""
import sys

if sys.argv[1:] in (["-h"], ["--help"]):
    sys.exit(print(__doc__))
try:
    import numpy as np

    import ents
    ents.library()
except (ImportError, RuntimeError) as error:
    print(f"inverse.py: {error} (Debian: python3-numpy python3-scipy, for /usr/bin/python3)")
    sys.exit(3)
try:
    wanted = np.array([float(text) for text in sys.argv[1:]] or [5.0, 12.0])
    assert wanted.shape == (2,) and (wanted > 0).all() and wanted.sum() > 16
except (ValueError, AssertionError):
    print("inverse.py: give two mean pressures > 0 with a sum above 16 (a flat segment presses each half with 8), or nothing", file=sys.stderr)
    sys.exit(2)

# The layer: 128 surface nodes over a length of 1; a wave of wave number q has the stiffness E* |q| / 2, the mean one E* / depth.
n, modulus, depth = 128, 1000.0, 0.5
q = 2 * np.pi * np.abs(np.fft.fftfreq(n, 1 / n))
stiffness = np.fft.ifft(np.diag(np.maximum(modulus * q / 2, modulus / depth)) @ np.fft.fft(np.eye(n), axis=0), axis=0).real / n
nodes = np.column_stack([(np.arange(n) + 0.5) / n, np.zeros(n)])
dofs = np.column_stack([np.full(n, -1), np.arange(n)])  # it moves along y

model = {"segment": "line2", "master": "rigid", "surface_coordinates": [[1.1], [-0.1]], "parameters": {"amplitude": 0.002, "phase": 0.0},
         "height": {"type": "sine", "amplitude": "amplitude", "wave_vector": [1], "phase": "phase"},
         "contact": {"normal": {"type": "penalty", "stiffness": 1e6}}}
contact = ents.Contact(model, nodes, np.column_stack([np.arange(n - 1), np.arange(1, n)]), [[0, 1]],
                       master_positions=[[1.1, -0.004], [-0.1, -0.004]], dofs=dofs)
half = np.array([nodes[:, 0] < 0.5, nodes[:, 0] >= 0.5], float)  # which sums of nodal forces are wanted
area = half @ contact.areas
theta, u, solutions = np.array([0.006, 0.9 if wanted[0] > wanted[1] else np.pi - 0.9]), np.zeros(n), 0  # a crest in the half that is pressed more
print("solutions   amplitude      phase   mean pressures")
for attempt in range(12):
    contact.model.bind(amplitude=theta[0], phase=theta[1])
    for iteration in range(12):  # equilibrium
        residual, tangent = contact.update(u)
        r, K = stiffness @ u + residual, stiffness + tangent.toarray()
        if np.abs(r).max() < 1e-12 * np.abs(residual).max():
            break
        u, solutions = u - np.linalg.solve(K, r), solutions + 1
    pressures = half @ residual / area
    print(f"{solutions:9d} {theta[0]:11.6g} {theta[1]:10.6f}   {pressures[0]:.8f} {pressures[1]:.8f}")
    if np.abs(pressures / wanted - 1).max() < 1e-6 or solutions > 30:
        break
    # f = half . R(u, theta) / area, K du = - dR: df/dtheta = (half - lambda) . dR/dtheta / area, K^T lambda = (dR/du)^T half
    adjoints, solutions = half - np.linalg.solve(K.T, tangent.T @ half.T).T, solutions + 1  # one factorisation, two right sides
    jacobian = np.array([contact.model.derivatives(contact.points, tree=contact.tree, segment=np.zeros(n, np.int64), area=contact.areas,
                                                    adjoint=np.column_stack([np.zeros(n), adjoint]))["product"] for adjoint in adjoints]) / area[:, None]
    step = np.linalg.solve(jacobian, wanted - pressures)
    theta = theta + step * min(1, 0.5 / np.abs(step / [theta[0], 1]).max())  # half of the amplitude, half a radian at most
found = np.abs(pressures / wanted - 1).max() < 1e-6
print(f"{'found' if found else 'not found'} in {solutions} linear solutions")
sys.exit(not found or solutions > 30)
