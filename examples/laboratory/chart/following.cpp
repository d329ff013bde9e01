// SPDX-License-Identifier: BSD-3-Clause
#include "chart/following.hpp"

#include <algorithm>
#include <cmath>

namespace host::chart {
namespace {

constexpr std::size_t most = 1024;

/// Where place i of `fine` steps lies among n: the segment and how far along it, 0 .. 1.
struct Place {
  std::size_t segment;
  double along;
  Place(std::size_t i, std::size_t fine, std::size_t n)
      : segment(std::min(i * n / fine, n - 1)),
        along(static_cast<double>(i * n) / static_cast<double>(fine) - static_cast<double>(segment)) {}
};

/// Are n segments in each direction nowhere farther than `distance` from the points?
bool follow(const SurfaceSample& segments, std::size_t n, const SurfaceSample& points, std::size_t fine,
            std::size_t d, double distance) {
  for (std::size_t j = 0; j <= (d == 2 ? 0 : fine); ++j) {
    const Place y(j, fine, n);
    for (std::size_t i = 0; i <= fine; ++i) {
      const Place x(i, fine, n);
      double apart = 0;
      for (std::size_t c = 0; c < d; ++c) {
        const auto between = [&](std::size_t row) {
          const double* left = segments.point.data() + (row * (n + 1) + x.segment) * d + c;
          return (1 - x.along) * left[0] + x.along * left[d];
        };
        const double there =
            d == 2 ? between(0) : (1 - y.along) * between(y.segment) + y.along * between(y.segment + 1);
        apart += std::pow(there - points.point[(j * (fine + 1) + i) * d + c], 2);
      }
      if (apart > distance * distance) return false;
    }
  }
  return true;
}

} // namespace

std::size_t segments_that_follow(const EntsLibrary& library, const Scene& scene, double share) {
  const ContactSpec& contact = *scene.contact;
  if (contact.rigid.empty()) return 0;
  const EntsModel model(library, contact.model.dump(), scene.file.parent_path(), contact.model_where);
  const auto d = static_cast<std::size_t>(scene.dimension);
  const auto sample = [&](std::size_t n) {
    return sample_surface(model, contact.rigid, {}, even_grid(model.layout().parameters, n));
  };
  const std::size_t fine = d == 2 ? 8 * most : most;
  const SurfaceSample points = sample(fine);
  const auto [lowest, highest] = std::minmax_element(points.height.begin(), points.height.end());
  const double distance = share * 0.5 * (*highest - *lowest);
  if (!(distance > 0)) return 0;
  const auto enough = [&](std::size_t n) { return follow(sample(n), n, points, fine, d, distance); };
  std::size_t n = 1;
  while (!enough(n))
    if ((n *= 2) > most) return 0;
  for (std::size_t few = n / 2; n - few > 1;) {
    const std::size_t middle = (few + n) / 2;
    (enough(middle) ? n : few) = middle;
  }
  return d == 2 ? n : n * n;
}

} // namespace host::chart
