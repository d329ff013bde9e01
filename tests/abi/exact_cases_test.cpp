// SPDX-License-Identifier: BSD-3-Clause
// Cases with the same answer as another, to the last bit: a height that is zero and none, a segment far from
// the origin and near it.
#include <gtest/gtest.h>

#include <limits>

#include "support/pose.hpp"

namespace exact_cases_test {
namespace {

using namespace test;

// Every way to write a height that is zero everywhere.
std::vector<std::string> zero_heights(int d) {
  const bool line = d == 2;
  const std::string sine =
      std::string(R"({"type": "sine", "amplitude": 0, "wave_vector": )") + (line ? "[3]" : "[3, 2]") + "}";
  return {
      R"({"type": "constant", "value": 0})",
      R"({"type": "constant", "value": -0.0})",
      sine,
      std::string(R"({"type": "gaussian", "amplitude": 0, "width": 0.3, "center": )") +
          (line ? "[0]" : "[0, 0]") + "}",
      std::string(R"({"type": "polynomial", "coefficients": )") + (line ? "[0, 0, 0, 0]" : "[[0, 0], [0]]") +
          "}",
      std::string(R"({"type": "map", "boundary": "periodic", "size": )") +
          (line ? R"([1], "values": [0, 0, 0])" : R"([1, 1], "values": [[0, 0], [0, 0]])") + "}",
      R"({"type": "sum", "of": [)" + sine + R"(, {"type": "constant", "value": 0}]})",
      R"({"type": "product", "of": [)" + height("sine", d) + R"(, {"type": "constant", "value": 0}]})",
  };
}

TEST(ExactCases, AHeightThatIsZeroIsNone) {
  Random random(151);
  for (const Basis& b : bases())
    for (const std::string& p : projection_kinds())
      for (std::size_t law = 0; law < contact_kinds().size(); ++law) {
        const auto with_height = [&](const std::string& h) {
          return Model(R"({"segment": ")" + std::string(b.name) + R"(", "height": )" + h +
                       R"(, "projection": )" + projection(p, b.dimension) + R"(, "contact": )" +
                       contact_kinds()[law] + "}");
        };
        const Model plain = with_height("null");
        Element e = with_history(plain, draw(plain, b, random), random);
        if (law % 3 == 0) e[start].clear();
        Results expected(plain.layout);
        const int32_t status = test::evaluate(plain, e, want_all, expected);
        for (const std::string& h : zero_heights(b.dimension)) {
          const Model zero = with_height(h);
          Results results(zero.layout);
          ASSERT_EQ(test::evaluate(zero, e, want_all, results), status) << zero.text();
          ASSERT_TRUE(same_bits(results, expected)) << zero.text();
        }
      }
}

// Coordinates of 1e8 sizes and gaps of 1e-6 sizes. Only differences of coordinates are used. Here they are
// exact: the coordinates are multiples of 2^-26 sizes (the spacing of doubles near 1e8), so that all bits
// agree with those near the origin - whose gap, in turn, is that of the segment as given. What is lost is
// what the caller's own rounding loses, at most 1e8 epsilon sizes.
TEST(ExactCases, FarFromTheOriginIsAsNearIt) {
  Random random(152);
  int compared = 0;
  for (const Basis& b : bases())
    for (const char* h : {"none", "sine"})
      for (const std::string& p : {std::string("normal"), std::string("shadow_direction")})
        for (Pose pose : poses(b.dimension)) {
          pose.size = std::exp2(std::round(std::log2(pose.size))); // 2^-20, 1, 2^20: scaling is exact, too
          SCOPED_TRACE(std::string(b.name) + " " + h + " " + p + " size " + number(pose.size));
          const double grid = 0x1p-26 * pose.size;
          const auto rounded = [&](double x) { return std::round(x / grid) * grid; };
          const Model model = model_in(pose, b, h, p);
          Element near;
          near[master] = flat_master(b);
          for (double& x : near[master]) x += random(-0.05, 0.05);
          near = posed(near, pose, b.dimension);
          for (double& x : near[master]) x = rounded(x);
          const SurfacePoint at = surface_point(model, near, centre(b));
          for (const double gap : {-1e-6, 1e-6}) {
            near[slave].clear();
            for (std::size_t c = 0; c < at.point.size(); ++c)
              near[slave].push_back(rounded(at.point[c] + gap * pose.size * at.normal[c]));
            Element far = near;
            for (const int i : {slave, master})
              for (std::size_t k = 0; k < far[i].size(); ++k)
                far[i][k] += (k % static_cast<std::size_t>(b.dimension) == 1 ? -7e7 : 1e8) * pose.size;
            for (const bool searched : {false, true}) {
              near[start] = far[start] = searched ? std::vector<double>() : centre(b);
              Results expected(model.layout), results(model.layout);
              ASSERT_EQ(test::evaluate(model, near, want_all, expected), ENTS_OK);
              ASSERT_EQ(test::evaluate(model, far, want_all, results), ENTS_OK);
              for (int i = 0; i < output_count; ++i)
                EXPECT_TRUE(outputs[i].bit == ENTS_POINT || same_bits(results[i], expected[i]))
                    << outputs[i].name;
              EXPECT_EQ(results.flags, expected.flags);
              // the gap asked for, but for the rounding of the slave to the grid (half a step per coordinate)
              EXPECT_NEAR(results.of(ENTS_NORMAL_GAP)[0], gap * pose.size,
                          0.5 * std::sqrt(b.dimension) * grid * (1 + 1e-6));
              ++compared;
            }
          }
        }
  EXPECT_EQ(compared, 11 * 2 * 2 * static_cast<int>(poses(2).size()) * 2 * 2);
}

} // namespace
} // namespace exact_cases_test
