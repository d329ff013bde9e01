// SPDX-License-Identifier: BSD-3-Clause
#include "core/height/thread.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ents {

std::vector<double> thread_coefficients(const ThreadProfile& p) {
  const double rising = std::tan(p.rising), falling = std::tan(p.falling);
  const double depth = (p.pitch - p.crest - p.root) / (rising + falling);
  const double crest_height = (0.5 * p.pitch - p.crest) / (rising + falling); // above the pitch line
  const double count = std::ceil(2.0 * p.pitch / p.rounding); // a cubic B-spline reaches two spacings
  std::vector<double> coefficients(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    const double x =
        p.pitch * static_cast<double>(i) / count; // from the middle of a crest to that of the next
    const double down = std::max(x - 0.5 * p.crest, 0.0) / falling,
                 up = std::max(p.pitch - x - 0.5 * p.crest, 0.0) / rising;
    coefficients[i] = crest_height - std::min({down, up, depth});
  }
  return coefficients;
}

} // namespace ents
