#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Hertz's line contact: a rigid cylinder, which is a height on ONE segment, is pressed on a block that is assembled here.

usage: hertz.py [PICTURE.png]

Prints force, peak pressure and half-width beside the exact ones for that force (K. L. Johnson, Contact Mechanics, 1985, section 4.2).
exit status: 0 done; 1 an error of more than 1 %; 3 NumPy, SciPy or libents.so is missing"""
import sys

if sys.argv[1:] in (["-h"], ["--help"]):
    sys.exit(print(__doc__))
try:
    import numpy as np
    import scipy.sparse as sparse
    from scipy.sparse.linalg import spsolve

    import ents
    ents.library()
except (ImportError, RuntimeError) as error:
    print(f"hertz.py: {error} (Debian: python3-numpy python3-scipy, for /usr/bin/python3)")
    sys.exit(3)

# The block: 10 x 10 mm, four-node elements in plane strain, fixed below.
young, poisson, radius = 1000.0, 0.3, 10.0
x, y = np.sinh(np.linspace(-5, 5, 121)) / np.sinh(5) * 5, np.sinh(np.linspace(-5, 0, 61)) / np.sinh(5) * 10
X = np.stack(np.meshgrid(x, y), -1).reshape(-1, 2)
n = np.arange(len(X)).reshape(len(y), len(x))
cells = np.stack([n[:-1, :-1], n[:-1, 1:], n[1:, 1:], n[1:, :-1]], -1).reshape(-1, 4)
C = young / (1 + poisson) / (1 - 2 * poisson) * np.array([[1 - poisson, poisson, 0], [poisson, 1 - poisson, 0], [0, 0, 0.5 - poisson]])
Ke = np.zeros((len(cells), 8, 8))
for s, t in np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) / np.sqrt(3):
    dN = np.array([[-1 + t, 1 - t, 1 + t, -1 - t], [-1 + s, -1 - s, 1 + s, 1 - s]]) / 4
    J = dN @ X[cells]
    B, g = np.zeros((len(cells), 3, 8)), np.linalg.solve(J, np.broadcast_to(dN, (len(cells), 2, 4)))
    B[:, 0, ::2] = B[:, 2, 1::2] = g[:, 0]
    B[:, 1, 1::2] = B[:, 2, ::2] = g[:, 1]
    Ke += np.linalg.det(J)[:, None, None] * (B.transpose(0, 2, 1) @ C @ B)
dofs = (2 * cells[:, :, None] + [0, 1]).reshape(-1, 8)
i, j = np.broadcast_arrays(dofs[:, :, None], dofs[:, None, :])
K = sparse.coo_matrix((Ke.ravel(), (i.ravel(), j.ravel()))).tocsr()

print("   force   peak pressure     exact    error   half-width     exact    error  iterations")
# The contact: the top of the block against a segment of 2 mm above it; its nodes go from right to left, so that its normal points down.
model = {"segment": "line2", "master": "rigid", "surface_coordinates": [[1], [-1]],
         "height": {"type": "polynomial", "coefficients": [0, 0, -1 / (2 * radius)]},
         "contact": {"normal": {"type": "penalty", "stiffness": 1e7}}}
top = np.column_stack([n[-1, :-1], n[-1, 1:]])
contact = ents.Contact(model, X, top, [[0, 1]], master_positions=[[1, 0], [-1, 0]])
free, u = np.setdiff1d(np.arange(X.size), 2 * n[0, :, None] + [0, 1]), np.zeros(X.size)
for approach in np.arange(1, 6) * 0.002:
    contact.move([[1, -approach], [-1, -approach]])
    for iteration in range(30):
        residual, tangent = contact.update(u)
        r = (K @ u + residual)[free]
        if iteration and np.abs(r).max() < 1e-10:
            break
        u[free] -= spsolve((K + tangent)[free][:, free], r)
    contact.commit()
    force = contact.pressure @ contact.areas
    a = np.sqrt(4 * force * radius * (1 - poisson**2) / (np.pi * young))
    # Hertz's pressure is half an ellipse: its square falls linearly with x^2 from the peak to zero at the half-width.
    p, at = contact.pressure, contact.points[:, 0]
    inside = p > 0.3 * p.max()
    slope, peak = np.polyfit(at[inside]**2, p[inside]**2, 1)
    peak, width = np.sqrt(peak), np.sqrt(-peak / slope)
    errors = peak / (2 * force / (np.pi * a)) - 1, width / a - 1
    print(f"{force:8.4f}  {peak:14.4f} {2 * force / (np.pi * a):9.4f} {errors[0]:8.2%} {width:12.5f} {a:9.5f} {errors[1]:8.2%} {iteration:7d}")
if len(sys.argv) > 1:
    import matplotlib
    matplotlib.use("Agg")
    contact.plot().figure.savefig(sys.argv[1], dpi=150)
sys.exit(max(map(abs, errors)) > 0.01 or iteration == 29)
