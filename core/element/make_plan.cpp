// SPDX-License-Identifier: BSD-3-Clause
#include "core/element/make_plan.hpp"

#include "core/element/flattening.hpp"
#include "core/element/heated_element.hpp"
#include "core/element/kernel_table.hpp"
#include "core/element/parameter_kernels.hpp"
#include "core/model/needs.hpp"
#include "core/numbers/fingerprint.hpp"
#include "core/numbers/instruction_set.hpp"
#include "core/surface/counted_basis.hpp"

namespace ents {

namespace {

#define ENTS_BASIS(name, type, ...) portable::kernels_of<portable::KernelBasis<portable::type>>,
constexpr const KernelSet& (*kernels_of[])() = {ENTS_BASES(ENTS_BASIS)}; // [basis]
#undef ENTS_BASIS

} // namespace

void set_block_kernels(const ModelSpec& model, const BlockKernels& kernels, Plan& plan) {
  BlockKernel block = nullptr, without_friction = nullptr;
  plan.heat_block = nullptr;
  if (kernels.of_basis) {
    const bool enriched = plan.height != nullptr;
    const ContactLaw& law = model.law;
    const BlockKernelsOfBasis& of = kernels.of_basis[static_cast<std::int32_t>(model.basis)];
    block = of.general[enriched];
    if (has_fast_kernel(law, model.projection, model.tangent)) {
      block = of.of[enriched][law.has_friction()];
      if (law.friction == FrictionKind::coulomb) without_friction = of.of[enriched][false];
    }
    plan.heat_block = of.heat[enriched];
  }
  plan.block = block, plan.block_without_friction = without_friction;
  if (!model.law.heat.on) return;
  plan.unheated_block = block, plan.unheated_block_without_friction = without_friction;
  plan.block = block ? evaluate_heated_block : nullptr, plan.block_without_friction = nullptr;
}

const BlockKernels& best_block_kernels() {
  switch (best_instruction_set()) {
#ifdef ENTS_HAS_AVX512
  case InstructionSet::avx512:
    return avx512::block_kernels;
#endif
#ifdef ENTS_HAS_AVX2
  case InstructionSet::avx2:
    return avx2::block_kernels;
#endif
  default:
    return portable::block_kernels;
  }
}

namespace {

// What the boxes of a tree depend on, beside the positions.
double make_surface_stamp(const ModelSpec& model) {
  Fingerprint print;
  print.add(static_cast<double>(model.basis));
  print.add(model.border);
  print.add(model.height.fingerprint());
  for (const double s : model.surface_coordinates) print.add(s);
  return print.number();
}

Plan make(const ModelSpec& model, bool enriched) {
  const BasisEntry& basis = basis_entry(model.basis);
  const KernelSet& kernels = kernels_of[static_cast<std::int32_t>(model.basis)]();
  Plan plan{};
  plan.element = kernels.element[enriched];
  plan.finish = kernels.finish[enriched];
  plan.rest = kernels.rest[enriched];
  plan.surface = kernels.surface[enriched];
  plan.transfer = kernels.transfer[enriched];
  plan.project = kernels.project[enriched];
  plan.border_point = kernels.border_point[enriched];
  plan.box = kernels.box[enriched];
  plan.by_parameter = parameter_kernels(model.basis).rates;
  plan.coordinates = parameter_kernels(model.basis).coordinates;
  plan.height = enriched ? &model.height.root() : nullptr;
  set_block_kernels(model, best_block_kernels(), plan);
  plan.height_nodes = enriched ? static_cast<std::int32_t>(model.height.nodes().size()) : 0;
  plan.surface_coordinates = model.own_surface_coordinates ? model.surface_coordinates.data() : nullptr;
  for (std::int32_t a = 0; a < 2; ++a)
    plan.feature_length[a] = a < basis.parameters ? model.height.feature_length(a) : Height::unbounded;
  plan.height_bound = enriched ? model.height.bound() : 0.0;
  plan.surface_stamp = make_surface_stamp(model);
  plan.projection = model.projection;
  plan.tangent = model.tangent;
  for (int c = 0; c < 3; ++c) plan.ray[c] = model.ray[c];
  plan.law = model.law;
  plan.law.table = model.law_table.data();
  plan.law.table_points = static_cast<std::int32_t>(model.law_table.size());
  if (model.law.varying.kind == VaryingCoefficient::table) {
    VaryingCoefficient& of = plan.law.varying;
    of.pressure = model.friction_pressures.data(), of.rate = model.friction_rates.data();
    of.coefficient = model.friction_coefficients.data();
  }
  plan.penetration_limit = model.penetration_limit;
  plan.border = model.border;
  plan.hull_spread = kernels.hull_spread(model.basis, model.border);
  plan.basis = model.basis;
  plan.dimension = basis.parameters + 1;
  plan.nodes = basis.nodes;
  plan.parameters = basis.parameters;
  plan.simplex = basis.simplex;
  plan.multipliers = !model.law.multiplier_is_dof() ? 0 : model.law.has_friction() ? 1 + basis.parameters : 1;
  plan.rigid = model.rigid_master;
  plan.node_dofs = plan.dimension;
  plan.dofs = plan.dimension * (plan.rigid ? 1 : basis.nodes + 1) + plan.multipliers;
  plan.state = make_state_layout(model);
  if (enriched && model.law.flattening.parameter != 0) {
    plan.unflattened = plan.element;
    plan.element = evaluate_flattened;
    plan.block = plan.unheated_block = nullptr;
  }
  if (model.law.heat.on) {
    plan.law.heat.by_pressure = model.conductance_by_pressure.data();
    plan.law.heat.pressures = static_cast<std::int32_t>(model.conductance_by_pressure.size());
    plan.law.heat.by_gap = model.conductance_by_gap.data();
    plan.law.heat.gaps = static_cast<std::int32_t>(model.conductance_by_gap.size());
    plan.heat = kernels.heat[enriched];
    plan.unheated = plan.element;
    plan.element = evaluate_heated;
    plan.node_dofs = plan.dimension + 1;
    plan.dofs += temperatures_of(plan);
  }
  if (plan.block)
    plan.block_results = (want::block & (model.law.normal == NormalKind::none ? ~want::needs_law : ~0)) |
                         (plan.heat ? want::heat : 0);
  return plan;
}

} // namespace

// A height that is zero everywhere, and stays so, is none: the plain segment, to the last bit.
Plan make_plan(const ModelSpec& model) {
  return make(model, model.height.bound() > 0.0 || model.height.varies());
}
Plan make_base_plan(const ModelSpec& model) { return make(model, false); }

} // namespace ents
