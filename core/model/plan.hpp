// SPDX-License-Identifier: BSD-3-Clause
// What an element kernel reads: plain data only, laid out once per model.
#pragma once

#include <cstdint>

#include "core/height/height.hpp"
#include "core/model/model.hpp"
#include "core/model/results.hpp"

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

namespace flag {
enum : std::int32_t {
  contact = 1,
  outside = 2,
  far_side = 4,
  searched = 8,
  stick = 16,
  slip = 32,
  shear_limit = 64,
  changed = 128,
  no_begin = 2048
};
}

struct SurfacePoint {
  double *point, *normal, *height, *base_point, *base_normal; // each or null
  double *curvature, *base_curvature; // largest |kappa| of rho_e and of rho; each or null
};

// State block of an element: where its parts are; -1: not part of it.
enum class History : std::int32_t { none = 0, open = 1, stick = 2, slip = 3 }; // stick: also without friction
// Is the element what it was? One without a history is open.
constexpr bool same_status(double before, double now) {
  return before == now || (before <= 1.0 && now <= 1.0);
}
struct StateLayout {
  static constexpr std::int32_t version = 3;
  static constexpr std::int32_t tag_at = 0, history_at = 1;
  static constexpr std::int32_t age_at = 2; // increments since the last change of status
  static constexpr std::int32_t xi_at = 3;  // [T]
  std::int32_t anchor_at;                   // [T], friction; of an open element see clearance_at
  std::int32_t slip_at;                     // accumulated slip [L], friction
  std::int32_t multiplier_at;               // [1] or, with friction, [1 + T]: augmented Lagrangian
  std::int32_t wear_at;      // [worn_slave, worn_master, pressure, anchor [T]], see below; wear
  std::int32_t clearance_at; // of an open element: how far from contact it was [L], in place of an anchor
  std::int32_t size;
  double tag; // "ents", version, basis and kinds of law in one exactly representable number
  // From wear_at on: depth that the slave surface has lost [L]; depth that the master surface has lost here
  // and that no field has yet [L]; pressure [F/L^2] and projection at the end of the increment before
  static constexpr std::int32_t worn_slave = 0, worn_master = 1, worn_pressure = 2, worn_anchor = 3;
};
StateLayout make_state_layout(const Model& model);
// A block of this layout, with finite numbers and a known history?
inline bool is_state(const StateLayout& layout, const double* state) {
  double zero = 0.0;
  for (int i = 0; i < layout.size; ++i) zero += 0.0 * state[i];
  const double history = state[StateLayout::history_at];
  return zero == 0.0 && state[StateLayout::tag_at] == layout.tag &&
         (history == 0.0 || history == 1.0 || history == 2.0 || history == 3.0);
}

// The numbers that an open element without a segment keeps of the state `before` (or null): the worn depths.
inline void keep_worn_depths(const StateLayout& layout, const double* before, double* state) {
  if (layout.wear_at < 0 || !before) return;
  for (const std::int32_t i : {StateLayout::worn_slave, StateLayout::worn_master})
    state[layout.wear_at + i] = before[layout.wear_at + i];
}

// The best projection of a slave on a segment.
struct SegmentProjection {
  double xi[2];
  double point[3]; // rho_e
  double gap;      // along n_e (normal), along the ray (shadow)
  double rank; // distance (normal), gap (shadow), plus the length by which xi lies beyond the segment's edges
  double tie;  // ranks closer than this are equal
  double beyond; // the length by which xi lies beyond the segment's edges
  bool ambiguous;
};

// The point of a segment's border that is closest to a given one.
struct BorderPoint {
  double xi[2];
  double distance;
  bool corner; // of a segment in space
};

// A projection that has been found, and how.
struct FoundProjection {
  double xi[2];
  double f2[3]; // F_,xixi there: next to a collapsed corner it is what the search has made of it
  std::int32_t evaluations;
  bool searched;  // the whole segment was
  bool ambiguous; // a second point is as good
  bool escaped;   // the iteration left the segment for good; xi: where
};
inline constexpr int largest_state = 24;

struct Plan;
using ElementKernel = Status (*)(const Plan&, const ElementInput&, const ElementOutput&);
using SurfaceKernel = Status (*)(const Plan&, const double* master, const double* surface_coordinates,
                                 const double* xi, const SurfacePoint&);

using TransferKernel = Status (*)(const Plan&, const double* old_master, const double* old_coordinates,
                                  const double* new_master, const double* new_coordinates,
                                  const double* state, double* moved);

// A projection whose rank is smaller than `limit`: the one next to `start`; the best of the segment where
// start is null, in at most `budget` evaluations of the surface. False: there is none.
using ProjectKernel = bool (*)(const Plan&, const double* slave, const double* master,
                               const double* surface_coordinates, const double* start, double limit,
                               int budget, SegmentProjection&);
// False: no point of the border is closer than `limit`.
using BorderKernel = bool (*)(const Plan&, const double* from, const double* master,
                              const double* surface_coordinates, double limit, BorderPoint&);
// A box [d] around all of the enriched segment.
using BoxKernel = void (*)(const Plan&, const double* master, const double* surface_coordinates, double* low,
                           double* high);

// Elements first .. first + count - 1, count <= PairBlock::most. Bit k: element first + k is written; the
// others are left to the element kernel.
using PairKernel = std::uint64_t (*)(const Plan&, const PairBlock&, std::int32_t count);

// Derivatives of an element's results by a named parameter: see parameter_rates.hpp.
struct ParameterRates {
  double gap, energy, pressure;
  double stiffness; // W'' itself
  double* residual; // [dofs] or null
};
using ParameterKernel = Status (*)(const Plan&, const ElementInput&, const double* xi, std::int32_t parameter,
                                   ParameterRates&);
// s(xi) [d - 1] of a segment, and the area (2D: length) of the segment without its height per unit of s.
using CoordinatesKernel = Status (*)(const Plan&, const double* master, const double* surface_coordinates,
                                     const double* xi, double* s, double& area_per_s);

// All results of an element at a projection.
using FinishKernel = Status (*)(const Plan&, const ElementInput&, const ElementOutput&,
                                const FoundProjection&);

// Where a block kernel has projected an element.
struct ProjectedElement {
  double xi[2], sine[3],
      area; // sine: where the height was looked up last, its value and its slope there (SineAt)
};
// Gradients and Hessians there. False: one of them leaves the range of numbers, and the element is left to
// the element kernel.
using RestKernel = bool (*)(const Plan&, const ElementInput&, const ElementOutput&, const ProjectedElement&);

struct Plan {
  ElementKernel element;
  FinishKernel finish;
  RestKernel rest;
  ElementKernel unflattened;         // of a model with flattening: `element` at given numbers of the height
  PairKernel pairs;                  // null: this model has no block kernel
  PairKernel pairs_without_friction; // of the forces where the coefficient is 0; null: `pairs` computes them
  std::int32_t block_results;        // of `pairs`, bits of `want`
  SurfaceKernel surface;
  TransferKernel transfer;
  ProjectKernel project;
  BorderKernel border_point;
  BoxKernel box;
  ParameterKernel by_parameter;
  CoordinatesKernel coordinates;
  const Plan* base;         // the same segments without their height; this plan itself if it has none
  const HeightNode* height; // null: plain
  std::int32_t height_nodes;
  Basis basis;
  const double* surface_coordinates; // the model's own, or null
  double feature_length[2];          // of the height, in s
  double height_bound;               // |h| <= height_bound
  double surface_stamp; // the same for models of the same basis, height, coordinates and border; > 0
  ProjectionKind projection;
  TangentKind tangent;
  double ray[3];
  ContactLaw law;
  double penetration_limit; // 0: the size of the segment
  double border;            // natural coordinates by which the segment reaches beyond its edges
  double hull_spread;       // of a segment over its nodes: see segment_box
  std::int32_t dimension, nodes, parameters;
  bool simplex;             // xi >= 0, sum xi <= 1
  std::int32_t multipliers; // dofs after those of the nodes
  std::int32_t dofs;        // with multipliers
  StateLayout state;
};

namespace ENTS_ISA {
// Numbers that a slave node has of its own; null: none
ENTS_INLINE Status check_slave_values(const ContactLaw& law, const double* values) {
  if (!values) return Status::ok;
  double zero = 0.0;
  for (int i = 0; i < law.slave_values(); ++i) zero += 0.0 * values[i];
  if (!(zero == 0.0)) return Status::non_finite;
  constexpr double smallest_scale = 1e-30, largest_scale = 1e30;
  if (law.normal == NormalKind::table &&
      !(values[slave_value::scale] >= smallest_scale && values[slave_value::scale] <= largest_scale))
    return Status::bad_value;
  return values[slave_value::wear] >= 0.0 && values[slave_value::sliding] >= 0.0 ? Status::ok
                                                                                 : Status::bad_value;
}
} // namespace ENTS_ISA

// The plan of a model; the model must outlive it. `base` is null.
Plan make_plan(const Model& model);
// The same, whatever the model's height, without one.
Plan make_base_plan(const Model& model);

} // namespace ents
