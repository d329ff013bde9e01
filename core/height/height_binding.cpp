// SPDX-License-Identifier: BSD-3-Clause
#include "core/height/height_binding.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "core/height/height_map.hpp"
#include "core/model/fingerprint.hpp"

namespace ents {

namespace {

// The samples of a map along s_(a + 1)
std::int64_t samples_of(const MapHeight& map, std::int32_t a) {
  const double n = map.period[a] > 0.0 ? map.period[a] : map.last_cell[a] + 1.0 - spline_cells_outside;
  return static_cast<std::int64_t>(n);
}

double bound_of(const double* coefficients, std::int64_t count) {
  double bound = 0.0;
  for (std::int64_t i = 0; i < count; ++i) bound = std::max(bound, std::fabs(coefficients[i]));
  return bound;
}

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
Status block_of_field(const Model& model, const double* const* fields, const HeightNode& node,
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
void bind_node(const Model& model, const double* parameters, const double* block, HeightNode& node,
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

// Shares of the B-splines at a place along a line: index and share of four of them, and the integral of each,
// in spacings.
struct Shares {
  std::int64_t index[4];
  double share[4], integral[4];
};
Shares shares_at(const MapHeight& map, std::int32_t a, std::int64_t count, double s) {
  double cell, f;
  ENTS_ISA::locate(map, a, s, cell, f);
  const double g = 1.0 - f;
  Shares out{{}, {g * g * g / 6.0, (4.0 - 6.0 * f * f + 3.0 * f * f * f) / 6.0, 0.0, f * f * f / 6.0}, {}};
  out.share[2] = 1.0 - out.share[0] - out.share[1] - out.share[3];
  const bool periodic = map.period[a] > 0.0;
  for (int k = 0; k < 4; ++k) {
    std::int64_t i = static_cast<std::int64_t>(cell) - 1 + k;
    if (periodic) {
      i = (i % count + count) % count;
      out.integral[k] = 1.0;
    } else { // the end coefficients stand for those beyond them: over 0 .. count - 1
      i = std::clamp<std::int64_t>(i, 0, count - 1);
      const std::int64_t from_end = std::min(i, count - 1 - i);
      out.integral[k] = from_end > 1 ? 1.0 : from_end == 1 ? 23.0 / 24.0 : 13.0 / 24.0;
      if (count == 2) out.integral[k] = 0.5;
      if (count == 3) out.integral[k] = i == 1 ? 22.0 / 24.0 : 13.0 / 24.0;
    }
    out.index[k] = i;
  }
  return out;
}

} // namespace

FieldLayout layout_of_field(const MapHeight& map, std::int32_t dimension) {
  FieldLayout layout{};
  layout.columns = samples_of(map, 0);
  layout.rows = dimension == 2 ? samples_of(map, 1) : 1;
  layout.row_stride = map.row_stride;
  layout.first = field_header::size + first_spline_coefficient(dimension, layout.columns);
  layout.size = field_header::size + map.row_stride * (dimension == 2 ? spline_row_length(layout.rows) : 1);
  for (int a = 0; a < 2; ++a) layout.periodic[a] = map.period[a] > 0.0;
  Fingerprint print;
  for (int a = 0; a < dimension; ++a)
    for (const double x : {map.origin[a], map.inverse_spacing[a], map.period[a], map.high[a]}) print.add(x);
  layout.fingerprint = print.number();
  return layout;
}

const HeightNode* find_field(const Height& height, std::int32_t index) {
  for (const HeightNode& node : height.nodes())
    if (node.kind == HeightKind::map && node.bound_to[0] == index + 1) return &node;
  return nullptr;
}

bool is_field(const FieldLayout& layout, std::span<const double> block) {
  return block[field_header::tag] == field_tag && block[field_header::fingerprint] == layout.fingerprint &&
         block[field_header::bound] >= 0.0 && block[field_header::bound] < 1e100 &&
         block[field_header::changes] >= 0.0;
}

void set_field(const Model& model, std::int32_t index, const double* samples, std::span<double> block) {
  const MapHeight& node = find_field(model.height, index)->map;
  const FieldLayout layout = layout_of_field(node, model.height.dimension());
  const bool again = is_field(layout, block);
  HeightMap map;
  map.dimension = model.height.dimension();
  map.columns = layout.columns, map.rows = layout.rows;
  map.boundary = layout.periodic[0] ? MapBoundary::periodic : MapBoundary::clamped;
  map.values.assign(static_cast<std::size_t>(map.rows * map.columns), 0.0);
  if (samples) std::copy_n(samples, map.rows * map.columns, map.values.begin());
  const std::vector<double> table = spline_coefficients(map);
  std::copy(table.begin(), table.end(), block.begin() + field_header::size);
  block[field_header::tag] = field_tag;
  block[field_header::fingerprint] = layout.fingerprint;
  block[field_header::bound] = bound_of(table.data(), static_cast<std::int64_t>(table.size()));
  block[field_header::changes] = again ? block[field_header::changes] + 1.0 : 0.0;
}

void add_to_field(const MapHeight& map, const FieldLayout& layout, std::int32_t dimension, const double* s,
                  double volume_per_s, std::span<double> block) {
  const std::int64_t count[2] = {layout.columns, layout.rows};
  Shares along[2];
  double density = volume_per_s;
  for (std::int32_t a = 0; a < dimension; ++a) {
    along[a] = shares_at(map, a, count[a], s[a]);
    density *= map.inverse_spacing[a];
  }
  double* first = block.data() + layout.first;
  double& bound = block[field_header::bound];
  // The images of a coefficient: those of its period, or those beyond the end where it is the end's
  const auto for_each_image = [&](std::int32_t a, std::int64_t i, auto&& f) {
    const std::int64_t n = count[a], low = -spline_padding_before, high = n + spline_padding_after;
    if (layout.periodic[a]) {
      for (std::int64_t k = i - (i - low) / n * n; k < high; k += n) f(k);
      return;
    }
    f(i);
    for (std::int64_t k = low; i == 0 && k < 0; ++k) f(k);
    for (std::int64_t k = n; i == n - 1 && k < high; ++k) f(k);
  };
  const auto add = [&](std::int64_t at, double amount) {
    first[at] += amount;
    bound = std::max(bound, std::fabs(first[at]));
  };
  for (int k = 0; k < 4; ++k) {
    const double of_column = density * along[0].share[k] / along[0].integral[k];
    for_each_image(0, along[0].index[k], [&](std::int64_t i) {
      if (dimension == 1) return add(i, of_column);
      for (int l = 0; l < 4; ++l)
        for_each_image(1, along[1].index[l], [&](std::int64_t j) {
          add(j * layout.row_stride + i, of_column * along[1].share[l] / along[1].integral[l]);
        });
    });
  }
}

BoundHeight make_bound_height(const Model& model) {
  std::size_t count = 0;
  for (const HeightNode& node : model.height.nodes()) count += static_cast<std::size_t>(count_values(node));
  return {model.height.nodes(), std::vector<double>(count)};
}

Status bind(const Model& model, const Plan& of, const double* parameters, const double* const* fields,
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
  double& normal = law.normal == NormalKind::exponential ? law.pressure : law.stiffness;
  if (!number(model.law_binding.normal, normal, smallest) ||
      !number(model.law_binding.friction, law.friction_coefficient, 0.0) ||
      !number(model.law_binding.wear, law.wear.coefficient, 0.0) ||
      !number(model.law_binding.sliding, law.wear.sliding, 0.0) ||
      !number(model.law_binding.offset, law.offset, -1e100))
    return Status::bad_value;
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
  plan.law = law;
  if (plan.height) plan.height = nodes.data();
  plan.height_bound = plan.height ? height_bound(nodes.front()) : 0.0;
  plan.surface_stamp = is_model_own ? of.surface_stamp : stamp.number();
  return Status::ok;
}

namespace {

template <int T> bool is_defined(const HeightNode& node, const double* s, int order) {
  using ENTS_ISA::Dual;
  double at[T], zero = 0.0;
  for (int a = 0; a < T; ++a) at[a] = s[a];
  const auto jet = ENTS_ISA::evaluate_height(node, at);
  zero += 0.0 * jet.h;
  for (const double slope : jet.h1) zero += 0.0 * slope;
  for (const double curvature : jet.h2) zero += 0.0 * curvature;
  for (int c = 0; c < T && order > 2; ++c) {
    Dual<double> moving[T];
    for (int a = 0; a < T; ++a) moving[a] = Dual<double>(s[a], a == c ? 1.0 : 0.0);
    for (const Dual<double>& second : ENTS_ISA::evaluate_height(node, moving).h2) zero += 0.0 * second.d;
  }
  return zero == 0.0;
}

} // namespace

bool is_defined_at(const HeightNode& node, std::int32_t dimension, const double* s, int order) {
  return dimension == 1 ? is_defined<1>(node, s, order) : is_defined<2>(node, s, order);
}

double height_at(const HeightNode& node, std::int32_t dimension, const double* s) {
  if (dimension == 1) {
    const double at[1] = {s[0]};
    return ENTS_ISA::evaluate_height(node, at).h;
  }
  const double at[2] = {s[0], s[1]};
  return ENTS_ISA::evaluate_height(node, at).h;
}

double height_bound(const HeightNode& node) {
  double of_formula = 0.0;
  if (with_formula(node, [&](const auto& formula) { of_formula = ENTS_ISA::largest_height(formula); }))
    return of_formula;
  const HeightNode* child = &node + node.first_child;
  switch (node.kind) {
  case HeightKind::none:
    return 0.0;
  case HeightKind::polynomial: {
    const PolynomialHeight& p = node.polynomial;
    for (std::int64_t i = 1; i < std::int64_t{p.rows} * p.columns; ++i)
      if (p.coefficients[i] != 0.0) return Height::unbounded;
    return std::fabs(p.coefficients[0]);
  }
  case HeightKind::map:
    return node.map.bound;
  case HeightKind::profile:
    return node.profile.of_turns.bound;
  case HeightKind::shift:
    return height_bound(*child);
  case HeightKind::external:
    return node.external.bound;
  default: // sum, product
    break;
  }
  const bool sum = node.kind == HeightKind::sum;
  double bound = sum ? 0.0 : 1.0;
  for (std::int32_t i = 0; i < node.child_count; ++i) {
    const double part = height_bound(child[i]);
    bound = sum                           ? bound + part
            : bound == 0.0 || part == 0.0 ? 0.0
                                          : bound * part; // 0 times an unbounded factor is 0
  }
  return bound;
}

} // namespace ents
