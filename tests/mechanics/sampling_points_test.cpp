// SPDX-License-Identifier: BSD-3-Clause
// Sampling points share a pressure as the integrals of the shape functions do.
#include <gtest/gtest.h>

#include <cmath>

#include "combination.hpp"
#include "worst.hpp"

namespace mechanics::sampling_points_test {
namespace {

// A constant pressure: every node gets the integral of its shape function, as tributary areas of linear
// facets are defined.
TEST(SamplingPoints, ShareAConstantPressureExactly) {
  Random random(3);
  for (const char* name : {"line2", "tri3", "quad4"}) {
    MeshSurface surface = draw_mesh(random, basis_named(name), 3, 0.2);
    if (surface.basis->dimension == 3) // plane: the area of a warped quadrilateral is no polynomial
      for (std::size_t i = 2; i < surface.positions.size(); i += 3)
        surface.positions[i] = 0.1 * surface.positions[i - 2];
    std::vector<double> expected(static_cast<std::size_t>(surface.nodes()));
    ents_report report = new_report();
    ASSERT_EQ(ents_tributary_areas(name, surface.segments(), surface.connectivity.data(), surface.nodes(),
                                   surface.positions.data(), 0.7, expected.data(), &report),
              ENTS_OK);
    for (const int n : {2, 3, 5, 64}) {
      std::vector<double> areas, share(expected.size(), 0.0);
      const Combination points = sampling(name, n, surface, 0.7, areas);
      for (std::size_t i = 0; i < areas.size(); ++i) {
        double sum = 0.0;
        for (auto j = points.begin[i]; j < points.begin[i + 1]; ++j) {
          const auto at = static_cast<std::size_t>(j);
          share[static_cast<std::size_t>(points.nodes[at])] += areas[i] * points.weights[at];
          sum += points.weights[at];
        }
        EXPECT_NEAR(sum, 1.0, 1e-15);
      }
      // 64^2 roundings of weights of order one
      for (std::size_t i = 0; i < share.size(); ++i)
        EXPECT_NEAR(share[i], expected[i], 1e-13 * (1.0 + expected[i])) << name << n;
    }
  }
}

// Of quadratic facets with straight sides, too: the integrals of their shape functions are known.
TEST(SamplingPoints, ShareAConstantPressureExactlyOnQuadraticFacets) {
  const std::vector<double> triangle = {0, 0, 0, 2, 0, 0.5, 0.6, 1.5, 0.1},
                            square = {0, 0, 0, 2, 0, 0.5, 2.5, 1.5, 0.6, 0.5, 1.5, 0.1};
  const struct {
    const char* name;
    std::vector<double> corners;
    double corner, side, middle; // shares of the area
  } facets[] = {{"tri6", triangle, 0.0, 1.0 / 3.0, 0.0},
                {"quad8", square, -1.0 / 12.0, 1.0 / 3.0, 0.0},
                {"quad9", square, 1.0 / 36.0, 1.0 / 9.0, 4.0 / 9.0}};
  for (const auto& facet : facets) {
    MeshSurface one;
    one.basis = &basis_named(facet.name);
    one.positions = facet.corners;
    const std::size_t corners = facet.corners.size() / 3,
                      nodes = static_cast<std::size_t>(one.basis->node_count());
    for (std::size_t i = 0; i < corners; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        one.positions.push_back(0.5 *
                                (facet.corners[3 * i + k] + facet.corners[3 * ((i + 1) % corners) + k]));
    for (std::size_t k = 0; k < 3 && nodes == 9; ++k)
      one.positions.push_back(0.5 * (facet.corners[k] + facet.corners[6 + k]));
    for (std::size_t i = 0; i < nodes; ++i) one.connectivity.push_back(static_cast<std::int64_t>(i));
    for (const int n : {2, 3, 5, 64}) {
      std::vector<double> areas, share(nodes, 0.0);
      const Combination points = sampling(facet.name, n, one, 1.0, areas);
      double area = 0.0;
      for (std::size_t i = 0; i < areas.size(); ++i) {
        area += areas[i];
        for (auto j = points.begin[i]; j < points.begin[i + 1]; ++j) {
          const auto at = static_cast<std::size_t>(j);
          share[static_cast<std::size_t>(points.nodes[at])] += areas[i] * points.weights[at];
        }
      }
      for (std::size_t i = 0; i < nodes; ++i) // 64^2 roundings of weights of order one
        EXPECT_NEAR(share[i] / area,
                    i < corners       ? facet.corner
                    : i < 2 * corners ? facet.side
                                      : facet.middle,
                    1e-13)
            << facet.name << " " << n << " node " << i;
    }
  }
}

// n points of Gauss and Legendre integrate x^(2 n - 1) exactly, and x^(2 n) not.
TEST(SamplingPoints, AreThoseOfGaussAndLegendre) {
  MeshSurface line;
  line.basis = &basis_named("line2");
  line.connectivity = {0, 1};
  line.positions = {0.0, 0.0, 1.0, 0.0};
  for (const int n : {1, 2, 3, 7, 20, 64}) {
    std::vector<double> areas;
    const std::vector<double> x = sampling("line2", n, line, 1.0, areas).positions(2, line.positions);
    const auto integral = [&](int power) {
      double sum = 0.0;
      for (std::size_t i = 0; i < areas.size(); ++i) sum += areas[i] * std::pow(x[2 * i], power);
      return sum * (power + 1);
    };
    for (int power = 0; power < 2 * n; ++power) EXPECT_NEAR(integral(power), 1.0, 1e-13) << n << " " << power;
    if (n < 8) {
      EXPECT_GT(std::fabs(integral(2 * n) - 1.0), 1e-10) << n;
    }
  }
}

} // namespace
} // namespace mechanics::sampling_points_test
