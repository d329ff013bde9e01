// SPDX-License-Identifier: BSD-3-Clause
// ents_surface_check with what holds for every answer; and small surfaces of the plane, extruded or flat.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "library.hpp"
#include "mesh_surface.hpp"
#include "sweep.hpp"

namespace mechanics {

using nlohmann::json;

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-12;   // of formulae with second derivatives
constexpr double search_step = 1e-8; // the last step in xi of the search for the worst place
constexpr std::int64_t bit(int condition) { return std::int64_t{1} << condition; }

inline Model model(const std::string& segment, const json& height, const json& more = json::object()) {
  json text = {{"segment", segment}, {"height", height}};
  text.update(more);
  return Model(text.dump());
}

struct Checked : ents_surface_admissibility {
  std::vector<std::int64_t> marks;
  bool violates(int condition) const { return (violated & bit(condition)) != 0; }
  bool judges(int condition) const { return (judged & bit(condition)) != 0; }
};

inline Checked check(const Model& m, const MeshSurface& surface, double reach = 0.0, int samples = 0,
                     double kink = 0.0) {
  Checked result{};
  result.marks.assign(static_cast<std::size_t>(surface.segments()), -1);
  result.struct_size = sizeof(ents_surface_admissibility);
  result.reach = reach, result.samples = samples, result.kink = kink;
  result.violations = result.marks.data();
  ents_report report{};
  report.struct_size = sizeof report;
  const ents_master_mesh mesh = surface.mesh();
  if (ents_surface_check(m.handle(), &mesh, &result, &report) != ENTS_OK)
    throw std::runtime_error(report.message);
  // what holds for every answer
  EXPECT_EQ(result.violated & ~result.judged, 0);
  std::int64_t marked = 0;
  for (const std::int64_t mark : result.marks) marked |= mark;
  EXPECT_EQ(marked, result.violated);
  for (int k = 0; k < 10; ++k) {
    EXPECT_EQ(result.missing[k] > 0.0 || (result.violates(k) && result.value[k] == result.bound[k]),
              result.violates(k));
    if (result.segment[k] < 0) continue;
    EXPECT_LT(result.segment[k], surface.segments());
    const std::vector<double> xi(result.xi[k], result.xi[k] + m.parameters());
    const SurfacePoints there = evaluate_surface(
        m, surface.master(result.segment[k]).data(),
        surface.surface_coordinates.empty() ? nullptr : surface.coordinates(result.segment[k]), xi);
    for (int a = 0; there.status == ENTS_OK && a < m.dimension(); ++a) {
      EXPECT_EQ(result.point[k][a], there.point[static_cast<std::size_t>(a)]) << k;
    }
  }
  // the two ends of a jump, and the deepest place with its foot on the other segment, are that far apart
  for (const int k : {ENTS_CHECK_JUMP, ENTS_CHECK_CROSSING}) {
    if (result.segment[k] < 0 || result.segment[k] == result.other[k]) continue;
    const std::vector<double> xi(result.other_xi[k], result.other_xi[k] + m.parameters());
    const SurfacePoints there = evaluate_surface(
        m, surface.master(result.other[k]).data(),
        surface.surface_coordinates.empty() ? nullptr : surface.coordinates(result.other[k]), xi);
    double distance2 = 0.0;
    for (int a = 0; a < m.dimension(); ++a)
      distance2 += std::pow(result.point[k][a] - there.point[static_cast<std::size_t>(a)], 2);
    EXPECT_NEAR(std::sqrt(distance2), result.value[k], 1e-9) << k; // as exact as a projection
  }
  return result;
}

// A polyline of plain segments through points of the plane.
inline MeshSurface polyline(const std::vector<double>& points, bool closed = false) {
  MeshSurface out;
  out.basis = &basis_named("line2");
  out.positions = points;
  const std::int64_t nodes = out.nodes();
  for (std::int64_t i = 0; i + 1 < nodes + closed; ++i)
    out.connectivity.insert(out.connectivity.end(), {i, (i + 1) % nodes});
  return out;
}

// The same extruded along z: quadrangles of unit depth. The outer side stays the outer side.
inline MeshSurface extruded(const MeshSurface& profile, const std::string& basis) {
  MeshSurface out;
  out.basis = &basis_named(basis);
  for (std::int64_t i = 0; i < profile.nodes(); ++i)
    for (const double z : {0.0, 1.0}) {
      const auto k = static_cast<std::size_t>(2 * i);
      out.positions.insert(out.positions.end(), {profile.positions[k], profile.positions[k + 1], z});
    }
  for (std::size_t s = 0; s + 1 < profile.connectivity.size(); s += 2) {
    const std::int64_t a = 2 * profile.connectivity[s], b = 2 * profile.connectivity[s + 1];
    if (basis == "quad4")
      out.connectivity.insert(out.connectivity.end(),
                              {b, a, a + 1, b + 1}); // rho_,1 x rho_,2: the turned tangent
    else
      out.connectivity.insert(out.connectivity.end(), {b, a, a + 1, b, a + 1, b + 1});
  }
  return out;
}

inline MeshSurface strip(int segments, double length) {
  std::vector<double> points;
  for (int i = 0; i <= segments; ++i) points.insert(points.end(), {length * i / segments, 0.0});
  MeshSurface out = polyline(points);
  for (int i = 0; i < segments; ++i)
    out.surface_coordinates.insert(out.surface_coordinates.end(),
                                   {length * i / segments, length * (i + 1) / segments});
  return out;
}

inline json waves(double amplitude, double per_length) {
  return {{"type", "sine"}, {"amplitude", amplitude}, {"wave_vector", {per_length}}};
}

} // namespace mechanics
