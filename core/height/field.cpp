// SPDX-License-Identifier: BSD-3-Clause
#include "core/height/field.hpp"

#include <algorithm>
#include <cmath>

#include "core/height/height_map.hpp"
#include "core/numbers/fingerprint.hpp"

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

void set_field(const Height& height, std::int32_t index, const double* samples, std::span<double> block) {
  const MapHeight& node = find_field(height, index)->map;
  const FieldLayout layout = layout_of_field(node, height.dimension());
  const bool again = is_field(layout, block);
  HeightMap map;
  map.dimension = height.dimension();
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

} // namespace ents
