// SPDX-License-Identifier: BSD-3-Clause
#include "core/model/binding.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "core/height/field.hpp"
#include "core/height/height_value.hpp"
#include "core/law/laws.hpp"
#include "core/numbers/fingerprint.hpp"

namespace ents {

namespace {

// Values of its own that a node has in a bound height
std::int32_t count_values(const HeightNode& node) {
  std::int32_t count = 0;
  if (with_formula(node, [&](const auto& formula) {
        count = count_numbers(std::remove_cvref_t<decltype(formula)>::table);
      })) {
    for (const std::uint8_t place : node.bound_to)
      if (place != 0) return count;
    return 0;
  }
  return node.kind == HeightKind::external && node.bound_to[0] != 0 ? node.external.value_count : 0;
}

// Bound of |h| over the whole surface
double bound_everywhere(const ExternalHeight& height) {
  constexpr double far = ExternalHeight::no_range;
  const double low[2] = {-far, -far}, high[2] = {far, far};
  double least[ExternalHeight::most_numbers], most[ExternalHeight::most_numbers];
  height.ranges(height, low, high, least, most);
  const double bound = std::max(std::fabs(least[0]), std::fabs(most[0]));
  return bound < far ? bound : Height::unbounded; // NaN, too
}

// The caller's block of a node that is a field; null: no field. bad_state: the block is not one of it.
Status block_of_field(const ModelSpec& model, const double* const* fields, const HeightNode& node,
                      const double*& block, std::int32_t& which) {
  block = nullptr;
  if (node.kind != HeightKind::map || node.bound_to[0] == 0) return Status::ok;
  which = node.bound_to[0] - 1;
  block = fields ? fields[which] : nullptr;
  return block && is_field(layout_of_field(node.map, model.height.dimension()),
                           {block, static_cast<std::size_t>(field_header::size)})
             ? Status::ok
             : Status::bad_state;
}

// Writes the caller's numbers into a node. block: of a node that is a field
void bind_node(const ModelSpec& model, const double* parameters, const double* block, HeightNode& node,
               double*& values) {
  const auto& to = node.bound_to;
  const auto number = [&](int slot, double& value) {
    if (to[slot] != 0) value = parameters[to[slot] - 1];
  };
  const std::int32_t own_values = count_values(node);
  if (with_formula(node, [&](auto& formula) {
        if (own_values == 0) return;
        std::copy_n(node.numbers, own_values, values);
        int slot = 0, i = 0;
        for (const FormulaNumber& of_table : std::remove_cvref_t<decltype(formula)>::table)
          for (int k = 0; k < of_table.count(); ++k, ++i)
            if (of_table.named) number(slot++, values[i]);
        node.numbers = values;
        ENTS_ISA::set_height(formula, node.numbers, model.height.dimension());
        values += own_values;
      }))
    return;
  switch (node.kind) {
  case HeightKind::shift:
    number(0, node.shift.by[0]);
    number(1, node.shift.by[1]);
    break;
  case HeightKind::map:
    if (block) {
      node.map.coefficients = block + layout_of_field(node.map, model.height.dimension()).first;
      node.map.bound = block[field_header::bound];
    }
    break;
  case HeightKind::external:
    if (own_values > 0) {
      ExternalHeight& own = node.external;
      std::copy_n(own.values, own.value_count, values);
      own.values = values;
      for (std::int32_t i = 0; i < own.parameter_count; ++i) number(i, values[i]);
      values += own.value_count;
      own.bound = bound_everywhere(own);
    }
    break;
  default:
    break;
  }
}

} // namespace

BoundHeight make_bound_height(const ModelSpec& model) {
  std::size_t count = 0;
  for (const HeightNode& node : model.height.nodes()) count += static_cast<std::size_t>(count_values(node));
  return {model.height.nodes(), std::vector<double>(count)};
}

Status bind(const ModelSpec& model, const Plan& of, const double* parameters, const double* const* fields,
            BoundHeight& height, Plan& plan, std::int32_t& which) {
  std::vector<HeightNode>& nodes = height.nodes;
  double values[most_parameters];
  const auto count = static_cast<std::int32_t>(model.parameters.size());
  for (std::int32_t i = 0; i < count; ++i) {
    values[i] = parameters ? parameters[i] : model.parameters[static_cast<std::size_t>(i)].value;
    which = i;
    if (!std::isfinite(values[i])) return Status::non_finite;
    if (!(std::fabs(values[i]) <= 1e100)) return Status::bad_value;
  }
  ContactLaw law = model.law;
  const auto number = [&](std::uint8_t index, double& value, double least) {
    if (index == 0) return true;
    value = values[which = index - 1];
    return value >= least;
  };
  constexpr double smallest = 1e-100; // as Range::positive
  if (!number(model.law_binding.normal, law.number[0], smallest) ||
      !number(model.law_binding.friction, law.friction_coefficient, 0.0) ||
      !number(model.law_binding.wear, law.wear.coefficient, 0.0) ||
      !number(model.law_binding.sliding, law.wear.sliding, 0.0) ||
      !number(model.law_binding.offset, law.offset, -1e100) ||
      !number(model.law_binding.heat_constant, law.heat.constant, 0.0) ||
      !number(model.law_binding.heat_coefficient, law.heat.coefficient, 0.0) ||
      !number(model.law_binding.heat_conductivity, law.heat.conductivity, 0.0) ||
      !number(model.law_binding.heat_share, law.heat.share, 0.0) || law.heat.share > 1.0)
    return Status::bad_value;
  if (model.law_binding.normal != 0 && mistake_of(law)) {
    which = model.law_binding.normal - 1;
    return Status::bad_value;
  }
  if (const std::uint8_t scale = law.flattening.parameter; scale != 0 && values[which = scale - 1] != 1.0)
    return Status::bad_value;

  // What is refused is refused before anything is written: `height` may be that of a model in use.
  const double* block = nullptr;
  for (const HeightNode& node : model.height.nodes())
    if (const Status status = block_of_field(model, fields, node, block, which); status != Status::ok)
      return status;

  Fingerprint stamp;
  stamp.add(of.surface_stamp);
  bool is_model_own = true; // the height has the numbers of the text, and no field
  double* own_values = height.values.data();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    HeightNode node = model.height.nodes()[i];
    block_of_field(model, fields, node, block, which);
    bind_node(model, values, block, node, own_values);
    nodes[i] = node;
    if (block) {
      is_model_own = false;
      stamp.add(block[field_header::changes]);
      stamp.add(node.map.bound);
      continue;
    }
    for (const std::uint8_t place : node.bound_to)
      if (place != 0) {
        stamp.add(values[place - 1]);
        is_model_own =
            is_model_own && values[place - 1] == model.parameters[static_cast<std::size_t>(place - 1)].value;
      }
  }
  plan = of;
  law.table = of.law.table, law.table_points = of.law.table_points;
  law.varying = of.law.varying;
  law.heat.by_pressure = of.law.heat.by_pressure, law.heat.pressures = of.law.heat.pressures;
  law.heat.by_gap = of.law.heat.by_gap, law.heat.gaps = of.law.heat.gaps;
  plan.law = law;
  if (plan.height) plan.height = nodes.data();
  plan.height_bound = plan.height ? height_bound(nodes.front()) : 0.0;
  plan.surface_stamp = is_model_own ? of.surface_stamp : stamp.number();
  return Status::ok;
}

} // namespace ents
