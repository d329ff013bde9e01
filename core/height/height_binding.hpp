// SPDX-License-Identifier: BSD-3-Clause
// Heights and laws that change between calls: a bound plan is a model's plan with the caller's numbers in the
// places of its named parameters, and with the caller's memory in the places of its fields. Nothing of an
// evaluation knows where a number came from.
//
// A field is a height map whose B-spline coefficients the caller owns: a block of numbers that begins with
//   [tag, fingerprint of the map, bound of |h|, count of its changes]
// followed by the coefficients with those beside the samples.
#pragma once

#include <span>
#include <vector>

#include "core/model/plan.hpp"

namespace ents {

inline constexpr std::int32_t most_parameters = 64, most_fields = 8;

namespace field_header {
enum : std::int32_t { tag, fingerprint, bound, changes, size };
}
inline constexpr double field_tag = 1717920867.0; // "fiec"

// Where the coefficients of a map lie, and how many there are.
struct FieldLayout {
  std::int64_t columns, rows;    // of samples; 2D: one row
  std::int64_t row_stride, size; // size: of the block, with its header
  std::int64_t first;            // of the coefficient of sample (0, 0), from the begin of the block
  bool periodic[2];
  double fingerprint;
};
FieldLayout layout_of_field(const MapHeight& map, std::int32_t dimension);
// The field's node; null: the height has none of this index.
const HeightNode* find_field(const Height& height, std::int32_t index);
// Is it a block of this field?
bool is_field(const FieldLayout& layout, std::span<const double> block);
// Coefficients from samples [rows][columns], or zero (null).
void set_field(const Model& model, std::int32_t index, const double* samples, std::span<double> block);
// h += volume per area, spread over the B-splines at s in proportion to their values there, each over its own
// integral: exactly `volume` / area_per_s is added to the integral of h over s. Clamped fields go on with
// their end coefficients.
void add_to_field(const MapHeight& map, const FieldLayout& layout, std::int32_t dimension, const double* s,
                  double volume_per_s, std::span<double> block);

// What a bound plan points into, beside its model.
struct BoundHeight {
  std::vector<HeightNode> nodes;
  std::vector<double> values; // of formulas and external heights with parameters, one after the other
};
BoundHeight make_bound_height(const Model& model);

// plan: `of`, a plan of the model, with the numbers of the caller. height: of make_bound_height().
// Statuses: non_finite, bad_value (a number that its law cannot have; `which`: the parameter), bad_state (the
// field).
Status bind(const Model& model, const Plan& of, const double* parameters, const double* const* fields,
            BoundHeight& height, Plan& plan, std::int32_t& which);

// Are h and its derivatives up to `order`, 2 or 3, finite at s [dimension]?
bool is_defined_at(const HeightNode& node, std::int32_t dimension, const double* s, int order);

// h at s [dimension].
double height_at(const HeightNode& node, std::int32_t dimension, const double* s);

// Largest |h| of a tree; infinite for a polynomial that is not constant.
double height_bound(const HeightNode& node);

} // namespace ents
