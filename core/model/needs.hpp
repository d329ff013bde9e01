// SPDX-License-Identifier: BSD-3-Clause
// What the elements of a model need. The decisions are made elsewhere: once per model by make_plan(), by the
// kernels' templates, and by evaluate_height(), which does not evaluate what a constant does not have. Here
// they are stated.
#pragma once

#include "core/model/plan.hpp"
#include "core/surface/basis.hpp"

namespace ents {

// Bits, those of the C ABI.
namespace need {
enum : std::int32_t {
  height = 1 << 0,
  slope = 1 << 1,
  curved = 1 << 2,
  iteration = 1 << 3,
  master = 1 << 4,
  friction = 1 << 5,
  history = 1 << 6,
  multipliers = 1 << 7,
  one_by_one = 1 << 8,
  temperatures = 1 << 9,
  first_state = 1 << 10
};
}

// Segments whose normal is constant: is_flat, by name.
constexpr bool is_flat_basis(Basis basis) { return basis == Basis::line2 || basis == Basis::tri3; }
namespace ENTS_ISA {
#define ENTS_BASIS(name, type, ...) static_assert(is_flat<type> == is_flat_basis(Basis::name));
ENTS_BASES(ENTS_BASIS)
#undef ENTS_BASIS
} // namespace ENTS_ISA

// Does such a model have the faster kernel (fast_block.hpp)?
constexpr bool has_fast_kernel(const ContactLaw& law, ProjectionKind projection, TangentKind tangent) {
  return projection == ProjectionKind::normal && law.force_has_slope() && !law.coefficient_varies() &&
         tangent == TangentKind::consistent;
}

// Does the force depend on the state of the begin of the increment?
inline bool has_history(const Plan& plan) {
  return plan.state.anchor_at >= 0 || plan.state.multiplier_at >= 0 || plan.law.wear.on || plan.law.bonds;
}

// All but one_by_one.
inline std::int32_t needs_of(const ModelSpec& model, const Plan& plan) {
  const bool enriched = plan.height != nullptr, flat = is_flat_basis(model.basis);
  const ContactLaw& law = plan.law;
  const auto if_so = [](bool so, std::int32_t bit) { return so ? bit : 0; };
  return if_so(enriched, need::height) |
         if_so(enriched && plan.height->kind != HeightKind::constant, need::slope) |
         if_so(!flat, need::curved) |
         if_so(enriched || !flat, need::iteration) | // SurfaceAt::closed_form, and project()
         if_so(!model.rigid_master, need::master) | if_so(law.has_friction(), need::friction) |
         if_so(has_history(plan), need::history) | if_so(plan.multipliers > 0, need::multipliers) |
         if_so(plan.heat != nullptr, need::temperatures) | if_so(plan.law.bonds, need::first_state);
}

} // namespace ents
