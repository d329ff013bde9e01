// SPDX-License-Identifier: BSD-3-Clause
#include "core/body/pose.hpp"

#include <cmath>

namespace ents {

namespace {

double cross(const double* a, const double* b, int i) {
  return a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

} // namespace

void rotation(int d, const double* spin, double (&r)[9]) {
  if (d == 2) {
    const double c = std::cos(spin[0]), s = std::sin(spin[0]);
    r[0] = c, r[1] = -s, r[2] = s, r[3] = c;
    return;
  }
  constexpr double small = 1e-100; // squares of angles below it leave the range of double precision
  const double angle = std::hypot(spin[0], spin[1], spin[2]);
  const double half = std::sin(0.5 * angle);
  const double a = angle > small ? std::sin(angle) / angle : 1.0,
               b = angle > small ? 2.0 * half * half / (angle * angle) : 0.5;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r[3 * i + j] = b * spin[i] * spin[j] + (i == j ? std::cos(angle) : 0.0);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    r[3 * k + j] += a * spin[i], r[3 * j + k] -= a * spin[i];
  }
}

double rotation_determinant(int d, const double* q) {
  if (d == 2) return q[0] * q[3] - q[1] * q[2];
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) sum += q[i] * cross(q + 3, q + 6, i);
  return sum;
}

double rotation_defect(int d, const double* q) {
  double largest = 0.0;
  for (int i = 0; i < d; ++i)
    for (int j = 0; j < d; ++j) {
      double sum = i == j ? -1.0 : 0.0;
      for (int k = 0; k < d; ++k) sum += q[d * k + i] * q[d * k + j];
      largest = std::fmax(largest, std::fabs(sum));
    }
  return largest;
}

void make_orthonormal(int d, double (&q)[9]) {
  double square[9], better[9];
  for (int i = 0; i < d; ++i)
    for (int j = 0; j < d; ++j) {
      square[d * i + j] = 0.0;
      for (int k = 0; k < d; ++k) square[d * i + j] += q[d * k + i] * q[d * k + j];
    }
  for (int i = 0; i < d; ++i)
    for (int j = 0; j < d; ++j) {
      double sum = 1.5 * q[d * i + j];
      for (int k = 0; k < d; ++k) sum -= 0.5 * q[d * i + k] * square[d * k + j];
      better[d * i + j] = sum;
    }
  for (int i = 0; i < d * d; ++i) q[i] = better[i];
}

// With d = x_s - x_r, D = [d]x, F = [f]x and delta theta the spatial spin (delta Q = [delta theta]x Q):
//   R = (f, -f, -d x f),  T = [K, -K, X; -K, K, -X; Y, -Y, -D X],  X = K D - F, Y = F - D K
// (delta y = Q^T (delta x_s - delta x_r + D delta theta)).
void add_body(int dim, const double* q, const double* y, const double* residual, const double* tangent,
              double* out, double* matrix) {
  const int spins = dim == 2 ? 1 : 3, n = 2 * dim + spins;
  double d[3] = {}, f[3] = {}, k[3][3] = {};
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) d[i] += q[dim * i + j] * y[j], f[i] += q[dim * i + j] * residual[j];
  const double m[3] = {-cross(d, f, 0), -cross(d, f, 1), -cross(d, f, 2)};
  for (int i = 0; i < dim; ++i) out[i] = f[i], out[dim + i] = -f[i];
  for (int i = 0; i < spins; ++i) out[2 * dim + i] = m[dim == 2 ? 2 : i];
  if (!tangent) return;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b) k[i][j] += q[dim * i + a] * tangent[b * dim + a] * q[dim * j + b];
  // [v]x e_j = v x e_j
  double x[3][3], along[3][3]; // X, Y; in the plane their third column and row count
  for (int j = 0; j < 3; ++j) {
    double unit[3] = {}, row[3];
    unit[j] = 1.0;
    const double turned[3] = {cross(d, unit, 0), cross(d, unit, 1), cross(d, unit, 2)};
    for (int i = 0; i < 3; ++i) {
      x[i][j] = -cross(f, unit, i);
      for (int a = 0; a < 3; ++a) x[i][j] += k[i][a] * turned[a];
    }
    const double column[3] = {k[0][j], k[1][j], k[2][j]};
    for (int i = 0; i < 3; ++i) row[i] = cross(f, unit, i) - cross(d, column, i);
    for (int i = 0; i < 3; ++i) along[i][j] = row[i];
  }
  const auto entry = [&](int i, int j) -> double& { return matrix[j * n + i]; };
  const int first = dim == 2 ? 2 : 0; // of the spins that are dofs
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) {
      entry(i, j) = entry(dim + i, dim + j) = k[i][j];
      entry(i, dim + j) = entry(dim + i, j) = -k[i][j];
    }
  for (int s = 0; s < spins; ++s) {
    for (int i = 0; i < dim; ++i) {
      entry(i, 2 * dim + s) = x[i][first + s], entry(dim + i, 2 * dim + s) = -x[i][first + s];
      entry(2 * dim + s, i) = along[first + s][i], entry(2 * dim + s, dim + i) = -along[first + s][i];
    }
    const double column[3] = {x[0][first + s], x[1][first + s], x[2][first + s]};
    for (int i = 0; i < spins; ++i) entry(2 * dim + i, 2 * dim + s) = -cross(d, column, first + i);
  }
}

} // namespace ents
