// SPDX-License-Identifier: BSD-3-Clause
#include "check_picture.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace host {
namespace {

constexpr std::size_t most_segments = 2500;
constexpr double most_points_drawn = 40000; // of a whole picture

/// The segments that are drawn: all, or those closest to the first offence.
std::vector<std::size_t> shown(const MasterSurface& surface, const std::vector<pictures::Place>& places) {
  std::vector<std::size_t> segments(surface.segments());
  std::iota(segments.begin(), segments.end(), std::size_t{0});
  if (segments.size() <= most_segments) return segments;
  const pictures::Place place = places.empty() ? pictures::Place{} : places.front();
  std::vector<double> distance;
  for (const std::size_t s : segments) {
    const std::vector<double> nodes = surface.master(s);
    const double x[3] = {place.x, place.y, place.z};
    double sum = 0;
    for (std::size_t i = 0; i < surface.d; ++i) sum += (nodes[i] - x[i]) * (nodes[i] - x[i]);
    distance.push_back(sum);
  }
  std::nth_element(segments.begin(), segments.begin() + most_segments, segments.end(),
                   [&](std::size_t a, std::size_t b) { return distance[a] < distance[b]; });
  segments.resize(most_segments);
  std::sort(segments.begin(), segments.end());
  return segments;
}

} // namespace

std::string draw_check(const EntsModel& model, const MasterSurface& surface,
                       const std::vector<std::int64_t>& violations,
                       const std::vector<pictures::Place>& places, bool triangles,
                       const std::filesystem::path& folder) {
  const std::vector<std::size_t> segments = shown(surface, places);
  const double each = most_points_drawn / static_cast<double>(segments.size());
  pictures::Surface picture;
  picture.dimension = static_cast<int>(surface.d);
  picture.columns = surface.d == 2 ? static_cast<int>(std::clamp(each, 5., 801.))
                                   : static_cast<int>(std::clamp(std::sqrt(each), 3., 161.));
  picture.rows = surface.d == 2 ? 1 : picture.columns;
  picture.title = places.empty() ? "Enriched surface: admissible" : "Enriched surface and where it fails";
  picture.subtitle =
      std::to_string(surface.segments()) + (surface.segments() == 1 ? " segment" : " segments");
  if (segments.size() < surface.segments())
    picture.subtitle += ", " + std::to_string(segments.size()) + " of them drawn, around the first place";
  const std::vector<double> xi =
      even_grid(model.layout().parameters, static_cast<std::size_t>(picture.columns - 1), triangles);
  for (const std::size_t s : segments) {
    const SurfaceSample sample = sample_surface(model, surface.master(s), surface.coordinates(s), xi);
    picture.enriched.insert(picture.enriched.end(), sample.point.begin(), sample.point.end());
    picture.base.insert(picture.base.end(), sample.base_point.begin(), sample.base_point.end());
    picture.height.insert(picture.height.end(), sample.height.begin(), sample.height.end());
    picture.wrong.push_back(violations[s] != 0);
  }
  picture.places = places;
  pictures::Pictures drawn;
  drawn.add("check", picture);
  return drawn.draw(folder);
}

} // namespace host
