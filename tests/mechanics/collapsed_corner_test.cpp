// SPDX-License-Identifier: BSD-3-Clause
// Quadrilaterals with two nodes in one place, as meshers write triangles: a slave over the triangle is over
// the segment, next to the corner where the two nodes are, too.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "library.hpp"
#include "random.hpp"
#include "samples.hpp"

#include <nlohmann/json.hpp>

namespace mechanics::collapsed_corner_test {
namespace {

TEST(CollapsedCorner, SlavesOverTheTriangleAreOverTheSegment) {
  for (const bool enriched : {false, true})
    for (const double near : {1e-8, 1e-6, 1e-4, 1e-2, 0.5}) {
      Random random(7);
      nlohmann::json text{{"segment", "quad4"},
                          {"contact", {{"normal", {{"type", "penalty"}, {"stiffness", 100}}}}}};
      if (enriched)
        text["height"] = {{"type", "sine"},
                          {"amplitude", 0.05},
                          {"wave_vector", {0.0, 1.0}},
                          {"phase", 0.5 * std::acos(-1.0)}};
      const Model model(text.dump());
      std::int64_t outside = 0, refused = 0, wrong = 0;
      const std::int64_t count = samples(2000);
      for (std::int64_t n = 0; n < count; ++n) {
        double x[3][3];
        for (int i = 0; i < 3; ++i)
          for (int k = 0; k < 3; ++k)
            x[i][k] =
                (k < 2 ? 2.0 * ((i == 1) * (k == 0) + (i == 2) * (k == 1)) : 0.0) + random.uniform(-0.4, 0.4);
        const int twice = random.below(4); // of the four nodes, this one and the next
        double master[4][3];
        for (int i = 0, corner = 0; i < 4; ++i) {
          const int node = (twice + i) % 4;
          if (i == 2) corner = 1;
          if (i == 3) corner = 2;
          for (int k = 0; k < 3; ++k) master[node][k] = x[corner][k];
        }
        double normal[3], e[2][3];
        for (int k = 0; k < 3; ++k) e[0][k] = x[1][k] - x[0][k], e[1][k] = x[2][k] - x[0][k];
        for (int k = 0; k < 3; ++k)
          normal[k] = e[0][(k + 1) % 3] * e[1][(k + 2) % 3] - e[0][(k + 2) % 3] * e[1][(k + 1) % 3];
        const double length =
            std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
        const double u = near * random.uniform(0.02, 1.0), v = random.uniform(0.02, 0.98),
                     gap = random.uniform(-0.1, 0.1);
        double slave[3];
        for (int k = 0; k < 3; ++k)
          slave[k] = x[0][k] + u * ((1.0 - v) * e[0][k] + v * e[1][k]) +
                     (gap + (enriched ? 0.05 : 0.0)) * normal[k] / length;
        double found = 0.0;
        std::int32_t flags = 0;
        ents_input in{};
        in.struct_size = sizeof in;
        in.slave = slave, in.master = master[0];
        const double along = random.uniform(-2.0, 2.0); // the wave does not vary along the first coordinate
        double s[4][2];
        for (int i = 0, corner = 0; i < 4; ++i) {
          if (i == 2) corner = 1;
          if (i == 3) corner = 2;
          s[(twice + i) % 4][0] = along * corner, s[(twice + i) % 4][1] = 0.0;
        }
        in.surface_coordinates = s[0];
        ents_output out{};
        out.struct_size = sizeof out;
        out.wanted = ENTS_GAP | ENTS_FLAGS | ENTS_RESIDUAL;
        double residual[15];
        out.gap = &found, out.flags = &flags, out.residual = residual;
        const std::int32_t status = ents_evaluate(model.handle(), 0, 1, &in, &out, nullptr);
        if (status != ENTS_OK)
          ++refused;
        else if ((flags & ENTS_FLAG_OUTSIDE) != 0)
          ++outside;
        else if (std::fabs(found - gap) > 1e-9)
          ++wrong;
      }
      std::printf(
          "%-8s within %5g: %lld slaves, %lld taken for outside, %lld with a wrong gap, %lld refused\n",
          enriched ? "height" : "plain", near, static_cast<long long>(count), static_cast<long long>(outside),
          static_cast<long long>(wrong), static_cast<long long>(refused));
      EXPECT_EQ(outside, 0);
      EXPECT_EQ(wrong, 0);
      EXPECT_EQ(refused, 0);
    }
}

} // namespace
} // namespace mechanics::collapsed_corner_test
