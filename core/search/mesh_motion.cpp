// SPDX-License-Identifier: BSD-3-Clause
#include "core/search/mesh_motion.hpp"

#include <algorithm>
#include <cmath>

namespace ents {

namespace {

// The eigenvector of the largest eigenvalue of a symmetric matrix: Jacobi's rotations.
void largest_eigenvector(double (&a)[4][4], double (&out)[4]) {
  double v[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  for (int sweep = 0; sweep < 20; ++sweep)
    for (int p = 0; p < 4; ++p)
      for (int q = p + 1; q < 4; ++q) {
        if (a[p][q] == 0.0) continue;
        const double angle = 0.5 * std::atan2(2.0 * a[p][q], a[q][q] - a[p][p]), c = std::cos(angle),
                     s = std::sin(angle);
        for (int k = 0; k < 4; ++k) {
          const double x = a[k][p], y = a[k][q];
          a[k][p] = c * x - s * y, a[k][q] = s * x + c * y;
        }
        for (int k = 0; k < 4; ++k) {
          const double x = a[p][k], y = a[q][k];
          a[p][k] = c * x - s * y, a[q][k] = s * x + c * y;
          const double w = v[k][p], z = v[k][q];
          v[k][p] = c * w - s * z, v[k][q] = s * w + c * z;
        }
      }
  int most = 0;
  for (int k = 1; k < 4; ++k)
    if (a[k][k] > a[most][most]) most = k;
  for (int k = 0; k < 4; ++k) out[k] = v[k][most];
}

} // namespace

MeshMotion::MeshMotion(const MasterMesh& mesh, const double* begin, int dimension) : d(dimension) {
  if (!begin || begin == mesh.positions || mesh.nodes == 0) return;
  for (std::int64_t k = 0; k < mesh.nodes * d; ++k)
    centre[k % d] += begin[k], centre_end[k % d] += mesh.positions[k] - begin[k];
  for (int i = 0; i < d; ++i) {
    centre[i] /= static_cast<double>(mesh.nodes);
    centre_end[i] = centre[i] + centre_end[i] / static_cast<double>(mesh.nodes);
  }
  rest = largest_rest(mesh, begin);
  if (!(rest > 0.0)) return;
  MeshMotion turned = *this;
  turned.fit_rotation(mesh, begin);
  turned.rest = turned.largest_rest(mesh, begin);
  if (turned.rest < rest) *this = turned;
}

// B. Horn, Journal of the Optical Society of America A 4, 1987: the quaternion of the best rotation is an eigenvector.
void MeshMotion::fit_rotation(const MasterMesh& mesh, const double* begin) {
  double s[3][3] = {};
  for (std::int64_t n = 0; n < mesh.nodes; ++n)
    for (int i = 0; i < d; ++i)
      for (int j = 0; j < d; ++j)
        s[i][j] += (begin[n * d + i] - centre[i]) * (mesh.positions[n * d + j] - centre_end[j]);
  double matrix[4][4] = {
      {s[0][0] + s[1][1] + s[2][2], s[1][2] - s[2][1], s[2][0] - s[0][2], s[0][1] - s[1][0]},
      {0.0, s[0][0] - s[1][1] - s[2][2], s[0][1] + s[1][0], s[2][0] + s[0][2]},
      {0.0, 0.0, s[1][1] - s[0][0] - s[2][2], s[1][2] + s[2][1]},
      {0.0, 0.0, 0.0, s[2][2] - s[0][0] - s[1][1]}};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < i; ++j) matrix[i][j] = matrix[j][i];
  double q[4];
  largest_eigenvector(matrix, q);
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  const double rotation[3][3] = {{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
                                 {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
                                 {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) turn[i][j] = rotation[i][j];
}

void MeshMotion::move(const double* x, double (&out)[3]) const {
  for (int i = 0; i < d; ++i) {
    out[i] = centre_end[i];
    for (int j = 0; j < d; ++j) out[i] += turn[i][j] * (x[j] - centre[j]);
  }
}

double MeshMotion::distance(const double* from, const double* to) const {
  double moved[3], sum = 0.0;
  move(from, moved);
  for (int i = 0; i < d; ++i) sum += (to[i] - moved[i]) * (to[i] - moved[i]);
  return std::sqrt(sum);
}

double MeshMotion::largest_rest(const MasterMesh& mesh, const double* begin) const {
  double most = 0.0;
  for (std::int64_t n = 0; n < mesh.nodes; ++n)
    most = std::max(most, distance(begin + n * d, mesh.positions + n * d));
  return most;
}

} // namespace ents
