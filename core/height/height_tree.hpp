// SPDX-License-Identifier: BSD-3-Clause
// Owner of a height function: the nodes and tables that evaluate_height reads, and what is known of h
// without evaluating it.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "core/height/height.hpp"

namespace ents {

struct HeightMap;

// A height that functions of its own evaluate, and what Height cannot find out about it.
struct ExternalSource {
  std::int32_t dimension = 1;
  ExternalHeight::Jets jets = nullptr;
  ExternalHeight::Ranges ranges = nullptr;
  ExternalHeight::Rates rates = nullptr;
  std::shared_ptr<const void> data; // ExternalHeight::data; kept as long as the height
  std::vector<double> values;       // ExternalHeight::values
  std::int32_t parameters = 0;      // how many of them are parameters
  double stamp = 0.0;               // differs between sources that differ in more than `values`
  double bound = 0.0;               // see Height::bound()
  double feature_length[2] = {std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::infinity()};
  std::int32_t continuity = 3;
};

// Movable, not copyable (nodes point into tables). Immutable once made.
class Height {
public:
  static constexpr std::int32_t smooth = 1000;
  static constexpr std::int32_t largest_dimension = 2;
  static constexpr double unbounded = std::numeric_limits<double>::infinity();

  Height() : Height(1) {}
  // h = 0; dimension: number of surface coordinates, 1 or 2.
  explicit Height(std::int32_t dimension);

  // Vectors have `dimension` entries; angles in radians.
  // kind: of a formula; numbers: those of its table, vectors with two
  static Height formula(HeightKind kind, std::int32_t dimension, std::vector<double> numbers);
  static Height constant(std::int32_t dimension, double value);
  static Height sine(double amplitude, const std::vector<double>& wave_vector, double phase);
  static Height gaussian(double amplitude, const std::vector<double>& center, double width);
  static Height polynomial(std::vector<double> coefficients); // [power of s]
  static Height
  bivariate_polynomial(const std::vector<std::vector<double>>& coefficients); // [of s_1][of s_2], ragged
  static Height map(const HeightMap& map);
  // The cubic B-spline with these coefficients, at equal distances over one turn of wave_vector . s + phase;
  // phase in turns.
  static Height profile(std::vector<double> coefficients, const std::vector<double>& wave_vector,
                        double phase);
  static Height external(ExternalSource source);
  // At least one term, all of one dimension, depth below max_height_depth; else std::invalid_argument.
  static Height sum(std::vector<Height> terms);
  static Height product(std::vector<Height> factors);
  // h(s - by)
  static Height shift(Height of, const std::vector<double>& by);
  // A map whose coefficients the caller owns: zero until it is bound to them. `map`: all but its values.
  static Height field(HeightMap map, std::int32_t index);
  // Number `slot` of the root is that of the named parameter `index`: see HeightNode::bound_to.
  void bind(std::int32_t slot, std::int32_t index) {
    nodes_.front().bound_to[slot] = static_cast<std::uint8_t>(index + 1);
  }

  Height(Height&&) noexcept = default;
  Height& operator=(Height&&) noexcept = default;
  Height(const Height&) = delete;
  Height& operator=(const Height&) = delete;

  const HeightNode& root() const { return nodes_.front(); }
  const std::vector<HeightNode>& nodes() const { return nodes_; }
  // Has it a number that a parameter gives, or a field?
  bool varies() const;
  bool none() const { return root().kind == HeightKind::none; }
  std::int32_t dimension() const { return dimension_; }
  // Levels of nesting; 1 for a single function.
  std::int32_t depth() const { return depth_; }
  // h is C^continuity; `smooth` when it has all derivatives.
  std::int32_t continuity() const { return continuity_; }
  // |h(s)| <= bound for every s; infinite for a polynomial that is not constant, and
  // where an external height has none.
  double bound() const;
  // Differs between heights that differ (fingerprint.hpp).
  double fingerprint() const;
  // Length along s_a over which h is close to a cubic: a quarter of a wavelength, a knot spacing, a width.
  // One or two samples per feature length show everything. Infinite when nothing limits it.
  double feature_length(std::int32_t a) const { return feature_length_[a]; }

private:
  static Height spline(HeightMap coefficients);
  static Height combine(HeightKind kind, std::vector<Height> parts);
  void append(std::vector<Height>& parts);

  std::int32_t dimension_ = 1;
  std::int32_t depth_ = 1;
  std::int32_t continuity_ = smooth;
  double feature_length_[largest_dimension] = {unbounded, unbounded};
  std::vector<HeightNode> nodes_;
  std::vector<std::vector<double>> tables_;
  std::vector<std::shared_ptr<const void>> owned_; // data of external heights
};

} // namespace ents
