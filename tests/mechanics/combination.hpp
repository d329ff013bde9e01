// SPDX-License-Identifier: BSD-3-Clause
// Points that are combinations of nodes, for tests.
#pragma once

#include <gtest/gtest.h>

#include "mesh_surface.hpp"

namespace mechanics {

// Points over nodes, as ents_sampling_points fills it or drawn at random.
struct Combination {
  std::vector<std::int64_t> begin{0}, nodes;
  std::vector<double> weights;

  void add(const std::vector<std::pair<std::int64_t, double>>& terms) {
    for (const auto& [node, weight] : terms) nodes.push_back(node), weights.push_back(weight);
    begin.push_back(static_cast<std::int64_t>(nodes.size()));
  }
  std::int64_t points() const { return static_cast<std::int64_t>(begin.size()) - 1; }
  ents_combination get() const {
    ents_combination c{};
    c.struct_size = sizeof c;
    c.points = points(), c.begin = begin.data(), c.nodes = nodes.data(), c.weights = weights.data();
    return c;
  }
  std::vector<double> positions(int d, const std::vector<double>& of_nodes) const {
    std::vector<double> out(static_cast<std::size_t>(points() * d));
    const ents_combination c = get();
    ents_report report = new_report();
    EXPECT_EQ(ents_combine(&c, d, static_cast<std::int64_t>(of_nodes.size()) / d, of_nodes.data(), out.data(),
                           &report),
              ENTS_OK)
        << report.message;
    return out;
  }
};

inline Combination sampling(const std::string& facet, int n, const MeshSurface& surface, double thickness,
                            std::vector<double>& areas) {
  const bool line = surface.basis->dimension == 2;
  const std::int64_t points = surface.segments() * (line ? n : n * n), m = surface.basis->node_count();
  Combination out;
  out.begin.resize(static_cast<std::size_t>(points + 1));
  out.nodes.resize(static_cast<std::size_t>(points * m)), out.weights.resize(out.nodes.size());
  areas.resize(static_cast<std::size_t>(points));
  ents_report report = new_report();
  EXPECT_EQ(ents_sampling_points(facet.c_str(), n, surface.segments(), surface.connectivity.data(),
                                 surface.nodes(), surface.positions.data(), thickness, out.begin.data(),
                                 out.nodes.data(), out.weights.data(), areas.data(), &report),
            ENTS_OK)
      << report.message;
  return out;
}

} // namespace mechanics
