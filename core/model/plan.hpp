// SPDX-License-Identifier: BSD-3-Clause
// What an element kernel reads: plain data only, laid out once per model.
#pragma once

#include <cstdint>

#include "core/height/height.hpp"
#include "core/model/model.hpp"
#include "core/model/results.hpp"
#include "core/model/state.hpp"
#include "core/model/status.hpp"

namespace ents {

struct SurfacePoint {
  double *point, *normal, *height, *base_point, *base_normal; // each or null
  double *curvature, *base_curvature; // largest |kappa| of rho_e and of rho; each or null
};

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

// Elements first .. first + count - 1, count <= ElementBlock::most. Bit k: element first + k is written; the
// others are left to the element kernel.
using BlockKernel = std::uint64_t (*)(const Plan&, const ElementBlock&, std::int32_t count);

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

// What the heat of an element depends on, and its derivatives by the dofs of the mechanics: those of the nodes,
// then multipliers. See heat_ingredients.hpp.
struct HeatIngredients {
  static constexpr int most_nodes = 16, most_dofs = 3 * (1 + most_nodes) + 3;
  bool contact, outside;
  double area, gap, pressure;
  double dissipation;                                   // of friction in the increment, [F L]
  double shape[most_nodes], shape_slope[2][most_nodes]; // N_i, N_i,a
  double gap_by[most_dofs], xi_by[2][most_dofs], pressure_by[most_dofs], dissipation_by[most_dofs];
};
// xi: of the projection; plan: without the dofs of temperatures
using HeatKernel = Status (*)(const Plan&, const ElementInput&, const double* xi, HeatIngredients&);
// The same of elements first .. first + count - 1, whose places are block.start: out[k] of element first + k. Bit k: it is
// written; the others are left to the HeatKernel.
using HeatBlockKernel = std::uint64_t (*)(const Plan&, const ElementBlock&, std::int32_t count,
                                          HeatIngredients* out);

struct Plan {
  ElementKernel element;
  FinishKernel finish;
  RestKernel rest;
  ElementKernel unflattened; // of a model with flattening: `element` at given numbers of the height
  HeatKernel heat;           // null: the law has no heat
  ElementKernel unheated;    // of a model with heat: its mechanics, as `unheated_block`
  BlockKernel unheated_block;
  BlockKernel block;                  // null: this model has no block kernel
  BlockKernel block_without_friction; // of the forces where the coefficient is 0; null: `block` computes them
  std::int32_t block_results;         // of `block`, bits of `want`
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
  bool rigid;               // master: dofs of the slave alone
  std::int32_t node_dofs;   // of a node: displacements, then with heat its temperature
  std::int32_t multipliers; // dofs after those of the nodes
  std::int32_t dofs;        // with multipliers
  StateLayout state;
  HeatBlockKernel heat_block; // of `heat`; and as `unheated_block`
  BlockKernel unheated_block_without_friction;
};

} // namespace ents
