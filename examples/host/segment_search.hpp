// SPDX-License-Identifier: BSD-3-Clause
// Which master segments lie near a slave node: bounding boxes sorted into a grid of bins.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace host {

class SegmentSearch {
public:
  using Point = Eigen::Array3d; ///< third coordinate 0 in the plane

  /// @param corners  [segments][nodes] positions of each segment's nodes
  /// @param nodes    per segment
  SegmentSearch(std::span<const Point> corners, std::size_t nodes) {
    const std::size_t count = corners.size() / nodes;
    std::vector<Point> low(count), high(count);
    Point mean = Point::Zero();
    low_ = Point::Constant(INFINITY);
    Point top = Point::Constant(-INFINITY);
    for (std::size_t s = 0; s < count; ++s) {
      low[s] = high[s] = corners[s * nodes];
      for (std::size_t a = 1; a < nodes; ++a) {
        low[s] = low[s].min(corners[s * nodes + a]);
        high[s] = high[s].max(corners[s * nodes + a]);
      }
      mean += (high[s] - low[s]) / static_cast<double>(count);
      low_ = low_.min(low[s]);
      top = top.max(high[s]);
    }
    // A node as far outside a segment as half a segment is long still finds it.
    const double reach = 0.5 * mean.maxCoeff();
    low_ -= reach;
    top += reach;
    size_ = mean.max(2 * reach).max(1e-300);
    // Across a thin surface there is one bin: an iterate of Newton's may take a node through it by more than
    // a segment's length, and a node that finds no segment would count as open.
    const Point extent = top - low_;
    for (int i = 0; i < 3; ++i)
      if (extent[i] < thin * extent.maxCoeff()) size_[i] = extent[i];
    for (int i = 0; i < 3; ++i) {
      const double bins = std::floor((top[i] - low_[i]) / size_[i]);
      bins_[static_cast<std::size_t>(i)] = static_cast<int>(std::clamp(bins, 1., i == 2 ? 64. : 1024.));
      size_[i] = std::max(size_[i], (top[i] - low_[i]) / bins_[static_cast<std::size_t>(i)]);
    }
    lists_.resize(static_cast<std::size_t>(bins_[0]) * static_cast<std::size_t>(bins_[1]) *
                  static_cast<std::size_t>(bins_[2]));
    for (std::size_t s = 0; s < count; ++s) {
      const auto first = bin(low[s] - reach), last = bin(high[s] + reach);
      for (int k = first[2]; k <= last[2]; ++k)
        for (int j = first[1]; j <= last[1]; ++j)
          for (int i = first[0]; i <= last[0]; ++i) lists_[index({i, j, k})].push_back(static_cast<int>(s));
    }
  }

  /// Segments near a point, ascending. Empty: none is near.
  std::span<const int> near(const Point& point) const { return lists_[index(bin(point))]; }

private:
  std::array<int, 3> bin(const Point& point) const {
    std::array<int, 3> result{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      const double position = std::floor((point[axis] - low_[axis]) / size_[axis]);
      result[i] = static_cast<int>(std::clamp(position, 0., bins_[i] - 1.));
    }
    return result;
  }
  std::size_t index(const std::array<int, 3>& b) const {
    return static_cast<std::size_t>(b[0] + bins_[0] * (b[1] + bins_[1] * b[2]));
  }

  /// A surface is thin along an axis if its extent there is less than this share of its largest.
  static constexpr double thin = 0.125;

  Point low_, size_;
  std::array<int, 3> bins_{};
  std::vector<std::vector<int>> lists_;
};

} // namespace host
