// SPDX-License-Identifier: BSD-3-Clause
// A field is a height map whose B-spline coefficients the caller owns: a block of numbers that begins with
//   [tag, fingerprint of the map, bound of |h|, count of its changes]
// followed by the coefficients with those beside the samples.
#pragma once

#include <span>

#include "core/height/height_tree.hpp"

namespace ents {

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
void set_field(const Height& height, std::int32_t index, const double* samples, std::span<double> block);
// h += volume per area, spread over the B-splines at s in proportion to their values there, each over its own
// integral: exactly `volume` / area_per_s is added to the integral of h over s. Clamped fields go on with
// their end coefficients.
void add_to_field(const MapHeight& map, const FieldLayout& layout, std::int32_t dimension, const double* s,
                  double volume_per_s, std::span<double> block);

} // namespace ents
