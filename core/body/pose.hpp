// SPDX-License-Identifier: BSD-3-Clause
// The pose of a rigid body: rotations, and the element of a slave point and the body's reference point
// (theory.md, section 6). A rotation is [d][d], row by row.
#pragma once

namespace ents {

// Dofs of the reference point: displacement and spin.
constexpr int body_dofs(int dimension) { return dimension == 2 ? 3 : 6; }
inline constexpr int largest_body_element = 9;

// exp([spin]x) (Rodrigues); spin: [1] or [3] angles
void rotation(int d, const double* spin, double (&r)[9]);
double rotation_determinant(int d, const double* q);
// How far Q is from orthonormal
double rotation_defect(int d, const double* q);
// Q (3 - Q^T Q) / 2: a Newton step to the nearest rotation, which takes a rounding to its square.
void make_orthonormal(int d, double (&q)[9]);

// q: the body's rotation; y: the slave in the body's frame; residual, tangent: of the rigid master there.
// matrix is written where there is a tangent, column-major.
void add_body(int dim, const double* q, const double* y, const double* residual, const double* tangent,
              double* out, double* matrix);

} // namespace ents
