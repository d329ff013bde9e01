// SPDX-License-Identifier: BSD-3-Clause
#include "chart/master_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace host::chart {
namespace {

/// Do the segments ab and cd cross?
bool cross(const double* a, const double* b, const double* c, const double* d) {
  const auto side = [](const double* p, const double* q, const double* r) {
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
  };
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

bool crosses_itself(const std::vector<double>& points) {
  const std::size_t count = points.size() / 2;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const double *a = points.data() + 2 * i, *b = a + 2;
    const double low = std::min(a[0], b[0]), high = std::max(a[0], b[0]);
    for (std::size_t j = i + 2; j + 1 < count; ++j) {
      const double *c = points.data() + 2 * j, *d = c + 2;
      if (std::max(c[0], d[0]) < low || std::min(c[0], d[0]) > high) continue;
      if (cross(a, b, c, d)) return true;
    }
  }
  return false;
}

} // namespace

std::string model_text(const Press& press, double penetration_limit) {
  Json model{{"segment", press.row.segment}, {"master", "rigid"}};
  if (!press.height.is_null()) model["height"] = press.height;
  if (press.method.projection == ProjectionKind::shadow) {
    Json up = Json::array();
    for (int i = 0; i < press.dimension; ++i) up.push_back(i + 1 == press.dimension ? 1 : 0);
    model["projection"] = {{"type", "shadow_direction"}, {"direction", up}};
  }
  model["contact"] = {{"normal", {{"type", "penalty"}, {"stiffness", press.penalty}}}};
  if (press.method.tangent == TangentKind::small_gap) model["tangent"] = "small_gap";
  if (std::isfinite(penetration_limit) && penetration_limit > 0)
    model["penetration_limit"] = penetration_limit;
  if (press.border > 0) model["border"] = press.border;
  return model.dump();
}

std::vector<double> segment_nodes(const Press& press, std::int64_t segment) {
  const SegmentRow& row = press.row;
  std::vector<double> nodes;
  for (int a = 0; a < row.nodes_per_segment; ++a) {
    const auto node = row.connectivity[static_cast<std::size_t>(segment * row.nodes_per_segment + a)];
    const auto first = row.positions.begin() + node * press.dimension;
    nodes.insert(nodes.end(), first, first + press.dimension);
  }
  return nodes;
}

std::vector<double> segment_coordinates(const Press& press, std::int64_t segment) {
  const SegmentRow& row = press.row;
  if (row.surface_coordinates.empty()) return {};
  const auto each = static_cast<std::int64_t>(row.nodes_per_segment) * (press.dimension - 1);
  const auto first = row.surface_coordinates.begin() + segment * each;
  return {first, first + each};
}

MasterPoints sample_master(const EntsModel& model, const Press& press, int per_segment) {
  MasterPoints out;
  const auto d = static_cast<std::size_t>(press.dimension);
  std::vector<double> xi;
  for (int j = 0; j <= (d == 3 ? per_segment : 0); ++j)
    for (int i = 0; i <= per_segment; ++i) {
      xi.push_back(2. * i / per_segment - 1);
      if (d == 3) xi.push_back(2. * j / per_segment - 1);
    }
  for (std::int64_t s = 0; s < press.row.segments(); ++s) {
    const SurfaceSample sample =
        sample_surface(model, segment_nodes(press, s), segment_coordinates(press, s), xi);
    out.point.insert(out.point.end(), sample.point.begin(), sample.point.end());
    out.normal.insert(out.normal.end(), sample.normal.begin(), sample.normal.end());
  }
  return out;
}

MasterCheck check_master(const EntsModel& model, const Press& press, const MasterPoints& points) {
  MasterCheck worst;
  worst.reach = INFINITY;
  const ents::Library& library = model.library();
  auto report = ents_struct<ents_report>();
  for (std::int64_t s = 0; s < press.row.segments(); ++s) {
    const std::vector<double> nodes = segment_nodes(press, s), coordinates = segment_coordinates(press, s);
    auto result = ents_struct<ents_admissibility>();
    const std::int32_t status = library.model_check(
        model.get(), nodes.data(), coordinates.empty() ? nullptr : coordinates.data(), &result, &report);
    if (status < 0) throw JobError("chart: " + describe(library, status, report));
    worst.degenerate = worst.degenerate || status > 0;
    worst.fold = std::max(worst.fold, result.fold);
    worst.edge_height = std::max(worst.edge_height, result.edge_height);
    worst.reach = std::min(worst.reach, result.reach);
    worst.shadow = std::min(worst.shadow, result.shadow);
  }
  if (press.dimension == 2) worst.crossing = crosses_itself(points.point);
  return worst;
}

} // namespace host::chart
