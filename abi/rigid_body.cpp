// SPDX-License-Identifier: BSD-3-Clause
#include "abi/rigid_body.hpp"

#include <cmath>

#include "abi/guard.hpp"

namespace ents {

namespace {

double cross(const double* a, const double* b, int i) {
  return a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

constexpr double largest_spin = 1e6; // [rad] the place of a rotation by more is not known to 1e-10

// exp([spin]x), row by row (Rodrigues)
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

double determinant(int d, const double* q) {
  if (d == 2) return q[0] * q[3] - q[1] * q[2];
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) sum += q[i] * cross(q + 3, q + 6, i);
  return sum;
}

// How far Q is from orthonormal
double defect(int d, const double* q) {
  double largest = 0.0;
  for (int i = 0; i < d; ++i)
    for (int j = 0; j < d; ++j) {
      double sum = i == j ? -1.0 : 0.0;
      for (int k = 0; k < d; ++k) sum += q[d * k + i] * q[d * k + j];
      largest = std::fmax(largest, std::fabs(sum));
    }
  return largest;
}

// Q (3 - Q^T Q) / 2: a Newton step to the nearest rotation, which takes a rounding to its square.
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

std::int32_t check_dimension(int dimension, ents_report* report) {
  if (dimension == 2 || dimension == 3) return ENTS_OK;
  return report_message(report, ENTS_BAD_VALUE, -1, "dimension is %d; it must be 2 or 3", dimension);
}

std::int32_t check_array(const char* name, const void* array, ents_report* report) {
  if (array) return ENTS_OK;
  return report_message(report, ENTS_NULL_ARGUMENT, -1, "argument '%s' is null", name);
}

std::int32_t move(int d, const double* translation, const double* spin, ents_pose* pose,
                  ents_report* report) {
  std::int32_t status = check_dimension(d, report);
  ents_pose copy;
  const ents_pose* known = status == ENTS_OK ? checked_pose(d, pose, copy, "pose", status, report) : nullptr;
  if (!known) return status;
  for (int i = 0; i < d; ++i)
    if (translation && !std::isfinite(translation[i]))
      return report_message(report, ENTS_NON_FINITE, -1, "translation[%d] is NaN or infinite", i);
  for (int i = 0; spin && i < (d == 2 ? 1 : 3); ++i)
    if (!std::isfinite(spin[i]))
      return report_message(report, ENTS_NON_FINITE, -1, "spin[%d] is NaN or infinite", i);
  for (int i = 0; spin && i < (d == 2 ? 1 : 3); ++i)
    if (!(std::fabs(spin[i]) <= largest_spin))
      return report_message(report, ENTS_BAD_VALUE, -1,
                            "spin[%d] is %g; it is an angle in radians, at most %g", i, spin[i],
                            largest_spin);
  ents_pose moved = *known;
  for (int i = 0; translation && i < d; ++i) moved.point[i] += translation[i];
  if (spin) {
    double r[9];
    rotation(d, spin, r);
    for (int i = 0; i < d; ++i)
      for (int j = 0; j < d; ++j) {
        moved.turn[d * i + j] = 0.0;
        for (int k = 0; k < d; ++k) moved.turn[d * i + j] += r[d * i + k] * known->turn[d * k + j];
      }
    make_orthonormal(d, moved.turn);
  }
  copy_to_caller(moved, pose);
  return report_ok(report);
}

// out = Q^T (v - point), or Q v
std::int32_t change_frame(int d, const ents_pose* pose, std::int64_t count, const double* in,
                          const char* name, double* out, const char* out_name, bool into_body,
                          ents_report* report) {
  std::int32_t status = check_dimension(d, report);
  ents_pose copy;
  const ents_pose* known = status == ENTS_OK ? checked_pose(d, pose, copy, "pose", status, report) : nullptr;
  if (!known) return status;
  if (count < 0 || count > std::int64_t{1} << 50)
    return report_message(report, ENTS_BAD_COUNT, -1, "count = %lld must be 0 .. 2^50",
                          static_cast<long long>(count));
  if (count > 0 && ((status = check_array(name, in, report)) != ENTS_OK ||
                    (status = check_array(out_name, out, report)) != ENTS_OK))
    return status;
  for (std::int64_t n = 0; n < count; ++n, in += d, out += d) {
    double from[3], to[3] = {};
    for (int i = 0; i < d; ++i) from[i] = into_body ? in[i] - known->point[i] : in[i];
    for (int i = 0; i < d; ++i)
      for (int j = 0; j < d; ++j) to[i] += known->turn[into_body ? d * j + i : d * i + j] * from[j];
    for (int i = 0; i < d; ++i) out[i] = to[i];
  }
  return report_ok(report);
}

} // namespace

const ents_pose* checked_pose(int d, const ents_pose* pose, ents_pose& copy, const char* name,
                              std::int32_t& status, ents_report* report) {
  const ents_pose* known = known_struct(pose, copy, name, status, report);
  if (!known || (status = check_reserved(known->reserved, name, report)) != ENTS_OK) return nullptr;
  double sum = 0.0;
  for (int i = 0; i < d; ++i) sum += 0.0 * known->point[i];
  for (int i = 0; i < d * d; ++i) sum += 0.0 * known->turn[i];
  if (!(sum == 0.0)) {
    status = report_message(report, ENTS_NON_FINITE, -1, "%s has a number that is NaN or infinite", name);
    return nullptr;
  }
  if (!(defect(d, known->turn) < 1e-8)) {
    status = report_message(
        report, ENTS_BAD_STATE, -1,
        "%s.turn is no rotation: begin with ents_pose_init, or give [%d][%d] orthonormal rows", name, d, d);
    return nullptr;
  }
  if (determinant(d, known->turn) < 0.0) {
    status =
        report_message(report, ENTS_BAD_STATE, -1,
                       "%s.turn is a reflection (its determinant is -1), no rotation: turn one of the body's "
                       "axes round",
                       name);
    return nullptr;
  }
  return known;
}

// With d = x_s - x_r, D = [d]x, F = [f]x and delta theta the spatial spin (delta Q = [delta theta]x Q):
//   R = (f, -f, -d x f),  T = [K, -K, X; -K, K, -X; Y, -Y, -D X],  X = K D - F, Y = F - D K
// (delta y = Q^T (delta x_s - delta x_r + D delta theta)).
void add_body(int dim, const ents_pose& pose, const double* y, const double* residual, const double* tangent,
              double* out, double* matrix) {
  const int spins = dim == 2 ? 1 : 3, n = 2 * dim + spins;
  const double* q = pose.turn;
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

extern "C" {

int32_t ents_pose_init(int32_t dimension, ents_pose* pose, ents_report* report) {
  return ents::entry_point(report, [&] {
    std::int32_t status = ents::check_dimension(dimension, report);
    if (status != ENTS_OK) return status;
    ents_pose copy;
    const ents_pose* known = ents::known_struct(pose, copy, "pose", status, report);
    if (!known) return status;
    ents_pose made{};
    for (int i = 0; i < dimension; ++i) made.turn[dimension * i + i] = 1.0;
    ents::copy_to_caller(made, pose);
    return ents::report_ok(report);
  });
}

int32_t ents_pose_move(int32_t dimension, const double* translation, const double* spin, ents_pose* pose,
                       ents_report* report) {
  return ents::entry_point(report, [&] {
    const ents::FloatingPointGuard guard;
    return ents::move(dimension, translation, spin, pose, report);
  });
}

int32_t ents_pose_to_body(int32_t dimension, const ents_pose* pose, int64_t count, const double* positions,
                          double* in_body, ents_report* report) {
  return ents::entry_point(report, [&] {
    const ents::FloatingPointGuard guard;
    return ents::change_frame(dimension, pose, count, positions, "positions", in_body, "in_body", true,
                              report);
  });
}

int32_t ents_pose_to_space(int32_t dimension, const ents_pose* pose, int64_t count, const double* in_body,
                           double* vectors, ents_report* report) {
  return ents::entry_point(report, [&] {
    const ents::FloatingPointGuard guard;
    return ents::change_frame(dimension, pose, count, in_body, "in_body", vectors, "vectors", false, report);
  });
}

int32_t ents_pose_element(int32_t dimension, const ents_pose* pose, const double* slave,
                          const double* residual, const double* tangent, double* body_residual,
                          double* body_tangent, ents_report* report) {
  return ents::entry_point(report, [&] {
    std::int32_t status = ents::check_dimension(dimension, report);
    ents_pose copy;
    const ents_pose* known =
        status == ENTS_OK ? ents::checked_pose(dimension, pose, copy, "pose", status, report) : nullptr;
    if (!known) return status;
    if ((status = ents::check_array("slave", slave, report)) != ENTS_OK ||
        (status = ents::check_array("residual", residual, report)) != ENTS_OK ||
        (status = ents::check_array("body_residual", body_residual, report)) != ENTS_OK)
      return status;
    if (body_tangent && (status = ents::check_array("tangent", tangent, report)) != ENTS_OK) return status;
    const ents::FloatingPointGuard guard;
    ents::add_body(dimension, *known, slave, residual, body_tangent ? tangent : nullptr, body_residual,
                   body_tangent);
    return ents::report_ok(report);
  });
}

} // extern "C"
