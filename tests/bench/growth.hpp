// How a cost grows.
#pragma once

#include <cmath>
#include <vector>

namespace bench {

// Slope of log cost over log size, least squares.
inline double slope(const std::vector<double>& sizes, const std::vector<double>& costs) {
  const double n = static_cast<double>(sizes.size());
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    x += std::log(sizes[i]) / n;
    y += std::log(costs[i]) / n;
  }
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const double away = std::log(sizes[i]) - x;
    xx += away * away;
    xy += away * (std::log(costs[i]) - y);
  }
  return xy / xx;
}

} // namespace bench
