// SPDX-License-Identifier: BSD-3-Clause
#include "core/height_tree.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "core/fingerprint.hpp"
#include "core/height_map.hpp"

namespace ents {

namespace {

std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

std::int32_t dimension_of(const std::vector<double>& vector) {
  if (vector.empty() || vector.size() > 2)
    throw std::invalid_argument("a height has 1 or 2 surface coordinates");
  return static_cast<std::int32_t>(vector.size());
}

// Coefficients beside the samples: of the cells from three spacings before them to two behind the last
// (clamped), or to what rounding may make of 0 and n (periodic).
constexpr std::int64_t padding_before = 4;
constexpr std::int64_t padding_after = 5;
constexpr double cells_outside = 3.0;

std::int64_t row_length(std::int64_t columns) { return padding_before + columns + padding_after; }

// Place of sample (0, 0) in the padded table
std::int64_t first_coefficient(const HeightMap& map) {
  return (map.dimension == 2 ? padding_before * row_length(map.columns) : 0) + padding_before;
}

// The map with `values` amid coefficients that are still to be computed
HeightMap padded(const HeightMap& map) {
  HeightMap wide = map;
  const std::int64_t stride = row_length(map.columns);
  wide.values.assign(index(map.dimension == 2 ? row_length(map.rows) : 1) * index(stride), 0.0);
  double* first = wide.values.data() + first_coefficient(map);
  for (std::int64_t j = 0; j < map.rows; ++j)
    std::copy_n(map.values.data() + j * map.columns, map.columns, first + j * stride);
  return wide;
}

} // namespace

Height::Height(std::int32_t dimension) : dimension_(dimension), nodes_(1) {
  if (dimension < 1 || dimension > 2) throw std::invalid_argument("a height has 1 or 2 surface coordinates");
  nodes_[0].kind = HeightKind::none;
}

Height Height::constant(std::int32_t dimension, double value) {
  Height height(dimension);
  height.nodes_[0].kind = HeightKind::constant;
  height.nodes_[0].value = value;
  height.bound_ = std::fabs(value);
  return height;
}

Height Height::sine(double amplitude, const std::vector<double>& wave_vector, double phase) {
  Height height(dimension_of(wave_vector));
  const double turns = phase / (2.0 * 3.14159265358979323846);
  SineHeight sine{amplitude, {0.0, 0.0}, turns - std::round(turns)};
  for (std::size_t a = 0; a < wave_vector.size(); ++a) {
    sine.wave_vector[a] = wave_vector[a];
    if (wave_vector[a] != 0.0) height.feature_length_[a] = 0.25 / std::fabs(wave_vector[a]);
  }
  height.nodes_[0].kind = HeightKind::sine;
  height.nodes_[0].sine = sine;
  height.bound_ = std::fabs(amplitude);
  return height;
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
  bool varies = false;
  for (std::size_t i = 0; i < coefficients.size(); ++i)
    for (std::size_t j = 0; j < coefficients[i].size(); ++j) {
      table[i * columns + j] = coefficients[i][j];
      varies = varies || ((i > 0 || j > 0) && coefficients[i][j] != 0.0);
    }
  height.bound_ = varies ? unbounded : std::fabs(table[0]);
  height.tables_.push_back(std::move(table));
  height.nodes_[0].kind = HeightKind::polynomial;
  height.nodes_[0].polynomial = {height.tables_[0].data(), static_cast<std::int32_t>(coefficients.size()),
                                 static_cast<std::int32_t>(columns)};
  return height;
}

Height Height::gaussian(double amplitude, const std::vector<double>& center, double width) {
  Height height(dimension_of(center));
  GaussianHeight gaussian{amplitude, {0.0, 0.0}, 1.0 / width};
  for (std::size_t a = 0; a < center.size(); ++a) {
    gaussian.center[a] = center[a];
    height.feature_length_[a] = width;
  }
  height.nodes_[0].kind = HeightKind::gaussian;
  height.nodes_[0].gaussian = gaussian;
  height.bound_ = std::fabs(amplitude);
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

  // Rows, then the columns of all that is known of the rows.
  HeightMap coefficients = padded(map);
  const std::int64_t stride = row_length(map.columns);
  double* first = coefficients.values.data() + first_coefficient(map);
  const auto interpolate = [&](double* line, std::int64_t samples, std::int64_t apart) {
    solve_spline_coefficients(line, samples, apart, map.boundary);
    extend_spline_coefficients(line, samples, padding_before, padding_after, apart, map.boundary);
  };
  for (std::int64_t j = 0; j < map.rows; ++j) interpolate(first + j * stride, map.columns, 1);
  if (map.dimension == 2)
    for (std::int64_t i = -padding_before; i < map.columns + padding_after; ++i)
      interpolate(first + i, map.rows, stride);
  return spline(std::move(coefficients));
}

Height Height::profile(std::vector<double> coefficients, const std::vector<double>& wave_vector,
                       double phase) {
  Height height(dimension_of(wave_vector));
  HeightMap turn; // of size 1
  turn.rows = 1;
  turn.columns = static_cast<std::int64_t>(coefficients.size());
  turn.values = std::move(coefficients);
  HeightMap padded_turn = padded(turn);
  extend_spline_coefficients(padded_turn.values.data() + padding_before, turn.columns, padding_before,
                             padding_after, 1, turn.boundary);
  Height along = spline(std::move(padded_turn));
  ProfileHeight profile{along.nodes_[0].map, {0.0, 0.0}, phase - std::round(phase)};
  for (std::size_t a = 0; a < wave_vector.size(); ++a) {
    profile.wave_vector[a] = wave_vector[a];
    if (wave_vector[a] != 0.0)
      height.feature_length_[a] = along.feature_length_[0] / std::fabs(wave_vector[a]);
  }
  height.bound_ = along.bound_;
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
  const double outside = periodic ? 1.0 : cells_outside;
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
  view.row_stride = row_length(map.columns);
  // A B-spline is a mean of its coefficients.
  for (const double value : map.values) height.bound_ = std::max(height.bound_, std::fabs(value));
  view.bound = height.bound_;
  height.continuity_ = 2;
  height.tables_.push_back(std::move(map.values));
  view.coefficients = height.tables_[0].data() + first_coefficient(map);
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
    switch (node.kind) {
    case HeightKind::none:
      break;
    case HeightKind::constant:
      add(node.value);
      break;
    case HeightKind::sine:
      add(node.sine.amplitude, node.sine.wave_vector[0], node.sine.wave_vector[1], node.sine.phase);
      break;
    case HeightKind::polynomial:
      add(node.polynomial.rows, node.polynomial.columns);
      break;
    case HeightKind::gaussian:
      add(node.gaussian.amplitude, node.gaussian.center[0], node.gaussian.center[1],
          node.gaussian.inverse_width);
      break;
    case HeightKind::map:
      add_map(node.map);
      break;
    case HeightKind::profile:
      add_map(node.profile.of_turns);
      add(node.profile.wave_vector[0], node.profile.wave_vector[1], node.profile.phase);
      break;
    case HeightKind::sum:
    case HeightKind::product:
      add(node.child_count, node.first_child);
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
  height.bound_ = sum ? 0.0 : 1.0;
  double rate[largest_dimension] = {0.0, 0.0}; // of a product: frequencies add
  std::size_t node_count = 1;
  for (const Height& part : parts) {
    if (part.dimension_ != height.dimension_)
      throw std::invalid_argument("parts of a height have the same number of surface coordinates");
    height.depth_ = std::max(height.depth_, part.depth_ + 1);
    height.continuity_ = std::min(height.continuity_, part.continuity_);
    // 0 times an unbounded factor is 0
    if (sum)
      height.bound_ += part.bound_;
    else
      height.bound_ = height.bound_ == 0.0 || part.bound_ == 0.0 ? 0.0 : height.bound_ * part.bound_;
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

  // Children side by side, then the descendants of each. Distances within a part stay, except from its root.
  height.nodes_.reserve(node_count);
  height.nodes_[0].kind = kind;
  height.nodes_[0].first_child = 1;
  height.nodes_[0].child_count = static_cast<std::int32_t>(parts.size());
  for (const Height& part : parts) height.nodes_.push_back(part.root());
  for (std::size_t p = 0; p < parts.size(); ++p) {
    HeightNode& child = height.nodes_[1 + p];
    const std::size_t moved_by = height.nodes_.size() - 1; // of the part's node 1
    if (parts[p].nodes_.size() > 1) child.first_child += static_cast<std::int32_t>(moved_by - (1 + p));
    height.nodes_.insert(height.nodes_.end(), parts[p].nodes_.begin() + 1, parts[p].nodes_.end());
    for (auto& table : parts[p].tables_) height.tables_.push_back(std::move(table));
  }
  return height;
}

} // namespace ents
