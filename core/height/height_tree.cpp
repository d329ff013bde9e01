// SPDX-License-Identifier: BSD-3-Clause
#include "core/height/height_tree.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "core/height/height_map.hpp"
#include "core/height/height_value.hpp"
#include "core/numbers/fingerprint.hpp"

namespace ents {

namespace {

std::int32_t dimension_of(const std::vector<double>& vector) {
  if (vector.empty() || vector.size() > 2)
    throw std::invalid_argument("a height has 1 or 2 surface coordinates");
  return static_cast<std::int32_t>(vector.size());
}

} // namespace

Height::Height(std::int32_t dimension) : dimension_(dimension), nodes_(1) {
  if (dimension < 1 || dimension > 2) throw std::invalid_argument("a height has 1 or 2 surface coordinates");
  nodes_[0].kind = HeightKind::none;
}

// numbers: of the formula's table
Height Height::formula(HeightKind kind, std::int32_t dimension, std::vector<double> numbers) {
  Height height(dimension);
  HeightNode& node = height.nodes_[0];
  node.kind = kind;
  height.tables_.push_back(std::move(numbers));
  node.numbers = height.tables_[0].data();
  with_formula(node, [&](auto& formula) {
    ENTS_ISA::set_height(formula, node.numbers, dimension);
    for (int a = 0; a < dimension; ++a) height.feature_length_[a] = ENTS_ISA::feature_length(formula, a);
  });
  return height;
}

Height Height::constant(std::int32_t dimension, double value) {
  return formula(HeightKind::constant, dimension, {value});
}

Height Height::sine(double amplitude, const std::vector<double>& wave_vector, double phase) {
  const std::int32_t dimension = dimension_of(wave_vector);
  return formula(HeightKind::sine, dimension,
                 {amplitude, wave_vector[0], dimension == 2 ? wave_vector[1] : 0.0, phase});
}

Height Height::gaussian(double amplitude, const std::vector<double>& center, double width) {
  const std::int32_t dimension = dimension_of(center);
  return formula(HeightKind::gaussian, dimension,
                 {amplitude, center[0], dimension == 2 ? center[1] : 0.0, width});
}

Height Height::polynomial(std::vector<double> coefficients) {
  std::vector<std::vector<double>> rows;
  for (const double c : coefficients) rows.push_back({c});
  Height height = bivariate_polynomial(rows);
  height.dimension_ = 1;
  return height;
}

Height Height::bivariate_polynomial(const std::vector<std::vector<double>>& coefficients) {
  std::size_t columns = 0;
  for (const auto& row : coefficients) columns = std::max(columns, row.size());
  if (columns == 0) throw std::invalid_argument("a polynomial has at least one coefficient");

  Height height(2);
  std::vector<double> table(coefficients.size() * columns, 0.0);
  for (std::size_t i = 0; i < coefficients.size(); ++i)
    for (std::size_t j = 0; j < coefficients[i].size(); ++j) table[i * columns + j] = coefficients[i][j];
  height.tables_.push_back(std::move(table));
  height.nodes_[0].kind = HeightKind::polynomial;
  height.nodes_[0].polynomial = {height.tables_[0].data(), static_cast<std::int32_t>(coefficients.size()),
                                 static_cast<std::int32_t>(columns)};
  return height;
}

Height Height::external(ExternalSource source) {
  Height height(source.dimension);
  for (std::int32_t a = 0; a < source.dimension; ++a) height.feature_length_[a] = source.feature_length[a];
  height.continuity_ = source.continuity;
  const auto count = static_cast<std::int32_t>(source.values.size());
  source.values.push_back(source.stamp); // fingerprint() reads the tables
  height.tables_.push_back(std::move(source.values));
  height.owned_.push_back(std::move(source.data));
  height.nodes_[0].kind = HeightKind::external;
  height.nodes_[0].external = {
      source.jets, source.ranges,     source.rates, height.owned_[0].get(), height.tables_[0].data(),
      count,       source.parameters, source.bound};
  return height;
}

Height Height::map(const HeightMap& map) {
  const std::int64_t smallest = map.boundary == MapBoundary::clamped ? 2 : 1;
  const std::int64_t count[2] = {map.columns, map.rows};
  for (std::int32_t a = 0; a < map.dimension; ++a)
    if (count[a] < smallest) throw std::invalid_argument("too few samples in a height map");
  if (map.dimension == 1 && map.rows != 1) throw std::invalid_argument("one surface coordinate, one row");
  if (map.values.size() != index(map.rows) * index(map.columns))
    throw std::invalid_argument("values of a height map: rows times columns");

  HeightMap coefficients = map;
  coefficients.values = spline_coefficients(map);
  return spline(std::move(coefficients));
}

Height Height::profile(std::vector<double> coefficients, const std::vector<double>& wave_vector,
                       double phase) {
  Height height(dimension_of(wave_vector));
  HeightMap turn; // of size 1
  turn.rows = 1;
  turn.columns = static_cast<std::int64_t>(coefficients.size());
  turn.values = std::move(coefficients);
  HeightMap padded_turn = turn;
  padded_turn.values = padded_coefficients(turn);
  extend_spline_coefficients(padded_turn.values.data() + spline_padding_before, turn.columns,
                             spline_padding_before, spline_padding_after, 1, turn.boundary);
  Height along = spline(std::move(padded_turn));
  ProfileHeight profile{along.nodes_[0].map, {0.0, 0.0}, phase - std::round(phase)};
  for (std::size_t a = 0; a < wave_vector.size(); ++a) {
    profile.wave_vector[a] = wave_vector[a];
    if (wave_vector[a] != 0.0)
      height.feature_length_[a] = along.feature_length_[0] / std::fabs(wave_vector[a]);
  }
  height.continuity_ = along.continuity_;
  height.tables_ = std::move(along.tables_);
  height.nodes_[0].kind = HeightKind::profile;
  height.nodes_[0].profile = profile;
  return height;
}

// values: the coefficients, with those beside the samples
Height Height::spline(HeightMap map) {
  Height height(map.dimension);
  const std::int64_t count[2] = {map.columns, map.rows};
  const bool periodic = map.boundary == MapBoundary::periodic;
  const double outside = periodic ? 1.0 : spline_cells_outside;
  MapHeight view{};
  for (std::int32_t a = 0; a < map.dimension; ++a) {
    const double n = static_cast<double>(count[a]);
    const double spacing = map.size[a] / (periodic ? n : n - 1.0);
    view.origin[a] = map.origin[a];
    view.inverse_spacing[a] = 1.0 / spacing;
    view.period[a] = periodic ? n : 0.0;
    view.inverse_period[a] = periodic ? 1.0 / n : 0.0;
    view.low[a] = view.first_cell[a] = -outside; // periodic: what rounding may make of 0 and n
    view.high[a] = view.last_cell[a] = n - 1.0 + outside;
    height.feature_length_[a] = spacing;
  }
  view.row_stride = spline_row_length(map.columns);
  // A B-spline is a mean of its coefficients.
  for (const double value : map.values) view.bound = std::max(view.bound, std::fabs(value));
  height.continuity_ = 2;
  height.tables_.push_back(std::move(map.values));
  view.coefficients = height.tables_[0].data() + first_spline_coefficient(map.dimension, map.columns);
  height.nodes_[0].kind = HeightKind::map;
  height.nodes_[0].map = view;
  return height;
}

double Height::fingerprint() const {
  Fingerprint print;
  for (const std::vector<double>& table : tables_)
    for (const double value : table) print.add(value);
  const auto add = [&](const auto&... values) { (print.add(static_cast<double>(values)), ...); };
  const auto add_map = [&](const MapHeight& m) {
    add(m.row_stride);
    for (int a = 0; a < 2; ++a) add(m.origin[a], m.inverse_spacing[a], m.period[a], m.low[a], m.high[a]);
  };
  for (const HeightNode& node : nodes_) {
    add(static_cast<std::int32_t>(node.kind));
    for (const std::uint8_t index : node.bound_to) add(index);
    switch (node.kind) {
    case HeightKind::polynomial:
      add(node.polynomial.rows, node.polynomial.columns);
      break;
    case HeightKind::map:
      add_map(node.map);
      break;
    case HeightKind::profile:
      add_map(node.profile.of_turns);
      add(node.profile.wave_vector[0], node.profile.wave_vector[1], node.profile.phase);
      break;
    case HeightKind::shift:
      add(node.shift.by[0], node.shift.by[1]);
      break;
    case HeightKind::sum:
    case HeightKind::product:
      add(node.child_count, node.first_child);
      break;
    default: // of formulas and external heights the table has all of it
      break;
    }
  }
  return print.number();
}

Height Height::sum(std::vector<Height> terms) { return combine(HeightKind::sum, std::move(terms)); }

Height Height::product(std::vector<Height> factors) {
  return combine(HeightKind::product, std::move(factors));
}

Height Height::combine(HeightKind kind, std::vector<Height> parts) {
  if (parts.empty()) throw std::invalid_argument("a sum or product has at least one part");
  Height height(parts.front().dimension_);
  const bool sum = kind == HeightKind::sum;
  double rate[largest_dimension] = {0.0, 0.0}; // of a product: frequencies add
  std::size_t node_count = 1;
  for (const Height& part : parts) {
    if (part.dimension_ != height.dimension_)
      throw std::invalid_argument("parts of a height have the same number of surface coordinates");
    height.depth_ = std::max(height.depth_, part.depth_ + 1);
    height.continuity_ = std::min(height.continuity_, part.continuity_);
    for (std::int32_t a = 0; a < height.dimension_; ++a) {
      rate[a] += 1.0 / part.feature_length_[a];
      if (sum)
        height.feature_length_[a] = std::min(height.feature_length_[a], part.feature_length_[a]);
      else if (rate[a] > 0.0)
        height.feature_length_[a] = 1.0 / rate[a];
    }
    node_count += part.nodes_.size();
  }
  if (height.depth_ > max_height_depth) throw std::invalid_argument("height nested too deeply");

  height.nodes_.reserve(node_count);
  height.nodes_[0].kind = kind;
  height.append(parts);
  return height;
}

// Children side by side, then the descendants of each. Distances within a part stay, except from its root.
void Height::append(std::vector<Height>& parts) {
  nodes_[0].first_child = 1;
  nodes_[0].child_count = static_cast<std::int32_t>(parts.size());
  for (const Height& part : parts) nodes_.push_back(part.root());
  for (std::size_t p = 0; p < parts.size(); ++p) {
    HeightNode& child = nodes_[1 + p];
    const std::size_t moved_by = nodes_.size() - 1; // of the part's node 1
    if (parts[p].nodes_.size() > 1) child.first_child += static_cast<std::int32_t>(moved_by - (1 + p));
    nodes_.insert(nodes_.end(), parts[p].nodes_.begin() + 1, parts[p].nodes_.end());
    for (auto& table : parts[p].tables_) tables_.push_back(std::move(table));
    for (auto& data : parts[p].owned_) owned_.push_back(std::move(data));
  }
}

Height Height::shift(Height of, const std::vector<double>& by) {
  if (of.depth_ >= max_height_depth) throw std::invalid_argument("height nested too deeply");
  Height height(dimension_of(by));
  height.depth_ = of.depth_ + 1;
  height.continuity_ = of.continuity_;
  std::copy_n(of.feature_length_, largest_dimension, height.feature_length_);
  height.nodes_[0].kind = HeightKind::shift;
  height.nodes_[0].shift = {{by[0], by.size() > 1 ? by[1] : 0.0}};
  std::vector<Height> parts;
  parts.push_back(std::move(of));
  height.append(parts);
  return height;
}

Height Height::field(HeightMap map, std::int32_t index) {
  map.values.assign(static_cast<std::size_t>(map.rows * map.columns), 0.0);
  Height height = Height::map(map);
  height.nodes_[0].bound_to[0] = static_cast<std::uint8_t>(index + 1);
  return height;
}

double Height::bound() const { return height_bound(root()); }

bool Height::varies() const {
  for (const HeightNode& node : nodes_)
    for (const std::uint8_t index : node.bound_to)
      if (index != 0) return true;
  return false;
}

} // namespace ents
