// SPDX-License-Identifier: BSD-3-Clause
#include "smoothing.hpp"

#include <algorithm>

#include "error.hpp"

namespace host {

bool is_smoothed(const std::string& segment) {
  return segment.starts_with("catmull_rom") || segment.starts_with("bspline");
}

std::vector<std::int64_t> smoothed_nodes(const EntsLibrary& library, const std::string& segment,
                                         const std::vector<Face>& faces, const std::string& where) {
  const bool line = segment.ends_with("4");
  const int corners = line ? 2 : 4;
  const char* facet = line ? "line2" : "quad4";
  std::vector<int64_t> connectivity;
  int64_t nodes = 0;
  for (const Face& face : faces) {
    if (face.count != corners)
      throw InputError(where + ": the model's segment " + segment + " lies on faces of " +
                       std::to_string(corners) + " nodes, here is one of " + std::to_string(face.count));
    for (int k = 0; k < corners; ++k) {
      connectivity.push_back(face.nodes[static_cast<std::size_t>(k)]);
      nodes = std::max(nodes, connectivity.back() + 1);
    }
  }
  auto report = ents_struct<ents_report>();
  const auto check = [&](int32_t status) {
    if (status != ENTS_OK) throw InputError(where + ": " + describe(library, status, report));
  };
  const auto count = static_cast<int64_t>(faces.size());
  int64_t points = 0, terms = 0;
  check(library.smooth_size(facet, segment.c_str(), ENTS_ENDS_REPEATED, count, connectivity.data(), nodes,
                            &points, &terms, &report));
  std::vector<int64_t> segment_points(faces.size() * (line ? 4 : 16)),
      begin(static_cast<std::size_t>(points + 1)), point_nodes(static_cast<std::size_t>(terms));
  std::vector<double> weights(point_nodes.size());
  check(library.smooth(facet, segment.c_str(), ENTS_ENDS_REPEATED, count, connectivity.data(), nodes, points,
                       terms, segment_points.data(), begin.data(), point_nodes.data(), weights.data(),
                       &report));
  std::vector<std::int64_t> result;
  for (const int64_t point : segment_points) {
    const auto i = static_cast<std::size_t>(point);
    if (begin[i + 1] != begin[i] + 1)
      throw InputError(
          where +
          ": the faces are irregular, so that control points are no nodes of the mesh; this program takes "
          "regular ones only (ents_assemble takes both)");
    result.push_back(point_nodes[static_cast<std::size_t>(begin[i])]);
  }
  return result;
}

} // namespace host
