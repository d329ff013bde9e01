// SPDX-License-Identifier: BSD-3-Clause
#include "abi/call/rigid_body.hpp"

#include <cmath>

#include "abi/call/guard.hpp"

namespace ents {

namespace {

constexpr double largest_spin = 1e6; // [rad] the place of a rotation by more is not known to 1e-10

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
  if (!(rotation_defect(d, known->turn) < 1e-8)) {
    status = report_message(
        report, ENTS_BAD_STATE, -1,
        "%s.turn is no rotation: begin with ents_pose_init, or give [%d][%d] orthonormal rows", name, d, d);
    return nullptr;
  }
  if (rotation_determinant(d, known->turn) < 0.0) {
    status =
        report_message(report, ENTS_BAD_STATE, -1,
                       "%s.turn is a reflection (its determinant is -1), no rotation: turn one of the body's "
                       "axes round",
                       name);
    return nullptr;
  }
  return known;
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
    ents::add_body(dimension, known->turn, slave, residual, body_tangent ? tangent : nullptr, body_residual,
                   body_tangent);
    return ents::report_ok(report);
  });
}

} // extern "C"
