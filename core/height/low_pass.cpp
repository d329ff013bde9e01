// SPDX-License-Identifier: BSD-3-Clause
#include "core/height/low_pass.hpp"

#include <cstddef>

#include "core/numbers/transcendental.hpp"

namespace ents {
namespace {

constexpr double rounding = 1e-12; // a wave of exactly the cut-off stays

// The waves along one coordinate that are long enough, orthogonal with the weights of the samples.
struct Waves {
  std::size_t samples = 1;
  std::vector<double> number;          // [waves] 1 / wavelength
  std::vector<double> value, weighted; // [waves][samples]; the second over the square of its norm
  std::size_t count() const { return number.size(); }
};

Waves waves_of(std::int64_t n, double size, MapBoundary boundary, double cut_off) {
  Waves w;
  w.samples = static_cast<std::size_t>(n);
  const bool periodic = boundary == MapBoundary::periodic;
  const double whole = periodic ? size : 2.0 * size; // of the wave of one period
  const std::int64_t turns = periodic ? n : 2 * (n - 1), last = turns / 2;
  for (std::int64_t k = 0; k <= last; ++k) {
    const double number = static_cast<double>(k) / whole;
    if (number * cut_off > 1.0 + rounding) break;
    for (const bool sine : {false, true}) {
      if (sine && (!periodic || k == 0 || 2 * k == turns)) continue;
      double squares = 0.0;
      const std::size_t first = w.value.size();
      for (std::int64_t i = 0; i < n; ++i) {
        double s, c;
        portable::sin_cos_turns(static_cast<double>(k * i % turns) / static_cast<double>(turns), 0.0, s, c);
        const double v = sine ? s : c, weight = !periodic && (i == 0 || i == n - 1) ? 0.5 : 1.0;
        w.value.push_back(v);
        w.weighted.push_back(weight * v);
        squares += weight * v * v;
      }
      for (std::size_t i = first; i < w.weighted.size(); ++i) w.weighted[i] /= squares;
      w.number.push_back(number);
    }
  }
  return w;
}

} // namespace

void leave_out_short_waves(HeightMap& map, double cut_off) {
  const Waves along = waves_of(map.columns, map.size[0], map.boundary, cut_off);
  const Waves across = map.dimension == 2 ? waves_of(map.rows, map.size[1], map.boundary, cut_off)
                                          : Waves{1, {0.0}, {1.0}, {1.0}};
  const std::size_t n = along.samples, rows = across.samples;
  std::vector<double> amplitude(across.count() * along.count(), 0.0), line(n);
  for (std::size_t q = 0; q < across.count(); ++q) {
    line.assign(n, 0.0);
    for (std::size_t j = 0; j < rows; ++j) {
      const double factor = across.weighted[q * rows + j];
      for (std::size_t i = 0; i < n; ++i) line[i] += factor * map.values[j * n + i];
    }
    for (std::size_t p = 0; p < along.count(); ++p) {
      const double k1 = along.number[p] * cut_off, k2 = across.number[q] * cut_off;
      if (k1 * k1 + k2 * k2 > 1.0 + 2.0 * rounding) continue;
      double sum = 0.0;
      for (std::size_t i = 0; i < n; ++i) sum += along.weighted[p * n + i] * line[i];
      amplitude[q * along.count() + p] = sum;
    }
  }
  map.values.assign(rows * n, 0.0);
  for (std::size_t q = 0; q < across.count(); ++q) {
    line.assign(n, 0.0);
    for (std::size_t p = 0; p < along.count(); ++p) {
      const double factor = amplitude[q * along.count() + p];
      if (factor == 0.0) continue;
      for (std::size_t i = 0; i < n; ++i) line[i] += factor * along.value[p * n + i];
    }
    for (std::size_t j = 0; j < rows; ++j) {
      const double factor = across.value[q * rows + j];
      for (std::size_t i = 0; i < n; ++i) map.values[j * n + i] += factor * line[i];
    }
  }
}

} // namespace ents
