// SPDX-License-Identifier: BSD-3-Clause
// Owner of a height function: the nodes and tables that evaluate_height reads, and what is known of h
// without evaluating it.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/height.hpp"

namespace ents {

struct HeightMap;

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
  static Height constant(std::int32_t dimension, double value);
  static Height sine(double amplitude, const std::vector<double>& wave_vector, double phase);
  static Height polynomial(std::vector<double> coefficients); // [power of s]
  static Height
  bivariate_polynomial(const std::vector<std::vector<double>>& coefficients); // [of s_1][of s_2], ragged
  static Height gaussian(double amplitude, const std::vector<double>& center, double width);
  static Height map(const HeightMap& map);
  // The cubic B-spline with these coefficients, at equal distances over one turn of wave_vector . s + phase; phase in turns.
  static Height profile(std::vector<double> coefficients, const std::vector<double>& wave_vector, double phase);
  // At least one term, all of one dimension, depth below max_height_depth; else std::invalid_argument.
  static Height sum(std::vector<Height> terms);
  static Height product(std::vector<Height> factors);

  Height(Height&&) noexcept = default;
  Height& operator=(Height&&) noexcept = default;
  Height(const Height&) = delete;
  Height& operator=(const Height&) = delete;

  const HeightNode& root() const { return nodes_.front(); }
  bool none() const { return root().kind == HeightKind::none; }
  std::int32_t dimension() const { return dimension_; }
  // Levels of nesting; 1 for a single function.
  std::int32_t depth() const { return depth_; }
  // h is C^continuity; `smooth` when it has all derivatives.
  std::int32_t continuity() const { return continuity_; }
  // |h(s)| <= bound for every s; infinite for a polynomial that is not constant.
  double bound() const { return bound_; }
  // Differs between heights that differ (fingerprint.hpp).
  double fingerprint() const;
  // Length along s_a over which h is close to a cubic: a quarter of a wavelength, a knot spacing, a width.
  // One or two samples per feature length show everything. Infinite when nothing limits it.
  double feature_length(std::int32_t a) const { return feature_length_[a]; }

private:
  static Height spline(HeightMap coefficients);
  static Height combine(HeightKind kind, std::vector<Height> parts);

  std::int32_t dimension_ = 1;
  std::int32_t depth_ = 1;
  std::int32_t continuity_ = smooth;
  double bound_ = 0.0;
  double feature_length_[largest_dimension] = {unbounded, unbounded};
  std::vector<HeightNode> nodes_;
  std::vector<std::vector<double>> tables_;
};

} // namespace ents
