// SPDX-License-Identifier: BSD-3-Clause
// What an element kernel reads: plain data only, laid out once per model.
#pragma once

#include <cstdint>

#include "core/height.hpp"
#include "core/model.hpp"

namespace ents {

// Outcome of an evaluation; the values are those of the C ABI.
enum class Status : std::int32_t {
  ok = 0,
  no_projection = 1,
  singular_projection = 2,
  ambiguous_projection = 3,
  degenerate_segment = 4,
  grazing_ray = 5,
  deep_penetration = 6,
  out_of_range = 7,
  non_finite = -4,
  bad_value = -7,
  bad_state = -12,
};

// Bits of `wanted`, those of the C ABI.
namespace want {
enum : std::int32_t {
  xi = 1 << 0,
  gap = 1 << 1,
  normal_gap = 1 << 2,
  normal = 1 << 3,
  point = 1 << 4,
  gap_gradient = 1 << 5,
  gap_hessian = 1 << 6,
  xi_gradient = 1 << 7,
  xi_hessian = 1 << 8,
  energy = 1 << 9,
  pressure = 1 << 10,
  residual = 1 << 11,
  tangent = 1 << 12,
  state = 1 << 13,
  flags = 1 << 14,
  iterations = 1 << 15,
  all = (1 << 16) - 1,
  kinematics = gap_gradient | gap_hessian | xi_gradient | xi_hessian,
  element = energy | pressure | residual | tangent | state,
};
}

namespace flag {
enum : std::int32_t { contact = 1, outside = 2, far_side = 4, searched = 8 };
}

struct ElementInput {
  const double* slave;
  const double* master;
  const double* surface_coordinates;  // or null
  const double* start;                // or null
  const double* area;                 // or null: 1
  const double* state_begin;          // or null
};

struct ElementOutput {
  std::int32_t wanted;
  double *xi, *gap, *normal_gap, *normal, *point, *gap_gradient, *gap_hessian, *xi_gradient, *xi_hessian, *energy,
      *pressure, *residual, *tangent, *state_end;
  std::int64_t tangent_leading_dimension;
  std::int32_t *flags, *iterations;
};

struct SurfacePoint {
  double *point, *normal, *height, *base_point, *base_normal;  // each or null
  double *curvature, *base_curvature;                          // largest |kappa| of rho_e and of rho; each or null
};

struct Plan;
using ElementKernel = Status (*)(const Plan&, const ElementInput&, const ElementOutput&);
using SurfaceKernel = Status (*)(const Plan&, const double* master, const double* surface_coordinates,
                                 const double* xi, const SurfacePoint&);

struct Plan {
  ElementKernel element;
  SurfaceKernel surface;
  const HeightNode* height;           // null: plain
  const double* surface_coordinates;  // the model's own, or null
  double feature_length[2];           // of the height, in s
  double height_bound;                // |h| <= height_bound
  ProjectionKind projection;
  TangentKind tangent;
  double ray[3];
  double penalty_stiffness;
  double penetration_limit;  // 0: the size of the segment
  std::int32_t dimension, nodes, parameters, dofs, state_size;
};

// State block of an element: tag, history, xi[T].
inline constexpr std::int32_t state_version = 1;
constexpr std::int32_t state_size_of(std::int32_t parameters) { return 2 + parameters; }
// "ents", version and size in one exactly representable number
constexpr double state_tag(std::int32_t parameters) {
  return 1701737587.0 * 4096.0 + state_version * 64.0 + state_size_of(parameters);
}
enum class History : std::int32_t { none = 0, open = 1, contact = 2 };

// The plan of a model; the model must outlive it.
Plan make_plan(const Model& model);

}  // namespace ents
