// SPDX-License-Identifier: BSD-3-Clause
// Where a case turns into another: on a node, on an edge, gap exactly zero, just outside, two equally close
// points, as deep as allowed, no slip. Each has one verdict, at three sizes and three rotations.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "support/pose.hpp"
#include "worst.hpp"

namespace borderline_test {
namespace {

using namespace test;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

double largest(const std::vector<double>& v) {
  double m = 0.0;
  for (const double x : v) ::test::raise(m, std::abs(x));
  return m;
}

// Corners and the middles of the edges, in natural coordinates.
std::vector<std::vector<double>> border(const Basis& b) {
  if (b.dimension == 2) return {{-1.0}, {1.0}};
  if (b.simplex) return {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
  return {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}};
}

// The rule for the sides: what projects on the border, within 1e-9 of the natural coordinates, belongs to the
// segment. So a slave on the common node or edge of two segments never falls between them.
TEST(Borderline, OnANodeEdgeOrCornerIsOnTheSegment) {
  everywhere([](const Basis& b, const std::string& h, const std::string& p, const Pose& pose) {
    const Model model = model_in(pose, b, h, p);
    Results results(model.layout);
    Element e;
    e[master] = flat_master(b);
    e = posed(e, pose, b.dimension);
    for (const std::vector<double>& xi : border(b)) {
      const SurfacePoint at = surface_point(model, e, xi);
      e[slave] = at.point;
      for (const bool searched : {false, true}) {
        e[start] = searched ? std::vector<double>() : xi;
        ASSERT_EQ(test::evaluate(model, e, want_all, results), ENTS_OK);
        EXPECT_EQ(results.flags & ENTS_FLAG_OUTSIDE, 0);
        // rounding of a point some 4 sizes from the origin, seen under a slope of at most 1
        EXPECT_LE(std::abs(results.gap()), 32 * epsilon * pose.size);
        for (std::size_t a = 0; a < xi.size(); ++a) EXPECT_NEAR(results.of(ENTS_XI)[a], xi[a], 1e-13);
      }
      if (p != "normal") continue; // a ray from below ends elsewhere
      const double depth = 0.01 * pose.size;
      for (std::size_t c = 0; c < at.point.size(); ++c) e[slave][c] = at.point[c] - depth * at.normal[c];
      e[start] = xi;
      ASSERT_EQ(test::evaluate(model, e, want_all, results), ENTS_OK);
      EXPECT_EQ(results.flags & (ENTS_FLAG_OUTSIDE | ENTS_FLAG_CONTACT), ENTS_FLAG_CONTACT);
      EXPECT_NEAR(results.gap(), -depth, 32 * epsilon * pose.size);
    }
  });
}

TEST(Borderline, JustOutsideIsOpen) {
  everywhere([](const Basis& b, const std::string& h, const std::string& p, const Pose& pose) {
    if (b.simplex) return; // below: the same border in other coordinates
    const Model model = model_in(pose, b, h, p);
    Results results(model.layout);
    Element e;
    e[master] = flat_master(b);
    e = posed(e, pose, b.dimension);
    for (const double beyond : {1e-12, 1e-7, 1e-3, 0.2}) {
      std::vector<double> xi = centre(b);
      xi[0] = 1.0 + beyond;
      const SurfacePoint at = surface_point(model, e, xi);
      e[slave] = at.point;
      if (p == "normal")
        for (std::size_t c = 0; c < at.point.size(); ++c) e[slave][c] -= 0.01 * pose.size * at.normal[c];
      e[start] = xi;
      ASSERT_EQ(test::evaluate(model, e, want_element | want_values, results), ENTS_OK) << beyond;
      const bool outside = beyond > 1e-9;
      EXPECT_EQ((results.flags & ENTS_FLAG_OUTSIDE) != 0, outside) << beyond;
      if (!outside) continue;
      EXPECT_EQ(results.flags & ENTS_FLAG_CONTACT, 0);
      EXPECT_TRUE(all_zero(results.of(ENTS_RESIDUAL)) && all_zero(results.of(ENTS_TANGENT)));
      EXPECT_TRUE(all_zero(results.of(ENTS_PRESSURE)) && all_zero(results.of(ENTS_ENERGY)));
    }
  });
}

// Far outside: the projection leaves the segment for good. Open, whatever the start; the state says so.
TEST(Borderline, FarOutsideIsOpen) {
  everywhere([](const Basis& b, const std::string& h, const std::string& p, const Pose& pose) {
    if (p == "shadow_point") return; // beside the emitter a ray turns back
    const Model model = model_in(pose, b, h, p);
    Results results(model.layout);
    Element e;
    e[master] = flat_master(b);
    e[slave] = above_centre(b, -0.1);
    e[slave][0] += 30.0;
    e = posed(e, pose, b.dimension);
    for (const bool searched : {false, true}) {
      if (!searched) e[start] = centre(b);
      const int32_t status = test::evaluate(model, e, want_element | want_values, results);
      ASSERT_EQ(status, ENTS_OK);
      EXPECT_NE(results.flags & ENTS_FLAG_OUTSIDE, 0);
      EXPECT_TRUE(all_zero(results.of(ENTS_RESIDUAL)) && all_zero(results.of(ENTS_TANGENT)));
      e[start].clear();
    }
  });
}

// Gap exactly zero belongs to the closed side, so that bodies that touch are held: no force, and the stiffness of contact.
// Turned, it is zero but for rounding, and so are the forces.
TEST(Borderline, GapZeroIsClosed) {
  for (const Basis& b : bases())
    for (const std::string& p : projection_kinds())
      for (const Pose& pose : poses(b.dimension)) {
        SCOPED_TRACE(std::string(b.name) + " " + p + " size " + number(pose.size));
        const Model model = model_in(pose, b, "none", p);
        Results results(model.layout);
        Element e;
        e[master] = flat_master(b);
        e[slave] = above_centre(b, 0.0);
        e[start] = centre(b);
        e = posed(e, pose, b.dimension);
        ASSERT_EQ(test::evaluate(model, e, want_all, results), ENTS_OK);
        if (pose.turn.r[0][0] == 1.0) {
          EXPECT_EQ(results.gap(), 0.0);
          EXPECT_NE(results.flags & ENTS_FLAG_CONTACT, 0);
          EXPECT_TRUE(all_zero(results.of(ENTS_RESIDUAL)) && !all_zero(results.of(ENTS_TANGENT)));
          EXPECT_TRUE(all_zero(results.of(ENTS_PRESSURE)) && all_zero(results.of(ENTS_ENERGY)));
        }
        const double rounding = 32 * epsilon * pose.size; // coordinates up to 3 sizes
        EXPECT_LE(std::abs(results.gap()), rounding);
        EXPECT_LE(largest(results.of(ENTS_RESIDUAL)), 1000.0 * rounding);
      }
}

// Under the top of an arch y = 1 - x^2, deeper than its radius of curvature 1/2, both flanks are equally
// close. A search says so; a start value on one side decides, and the same way every time.
TEST(Borderline, TwoEquallyClosePointsAreAmbiguousOrDecidedByTheStart) {
  const Basis& b = basis("line3");
  for (const Pose& pose : poses(2)) {
    SCOPED_TRACE("size " + number(pose.size));
    const Model model = model_in(pose, b, "none", "normal");
    Results results(model.layout), again(model.layout);
    Element e;
    e[master] = {-1, 0, 1, 0, 0, 1};
    e[slave] = {0.0, 0.1};
    e = posed(e, pose, 2);
    EXPECT_EQ(test::evaluate(model, e, want_element, results), ENTS_AMBIGUOUS_PROJECTION);
    // 1 - x^2 = y, d/dx |.|^2 = 0: x^2 = 0.9 - 1/2
    for (const double side : {-1.0, 1.0}) {
      e[start] = {side * 0.8};
      ASSERT_EQ(test::evaluate(model, e, want_element | want_values, results), ENTS_OK);
      EXPECT_NEAR(results.of(ENTS_XI)[0], side * std::sqrt(0.4), 1e-12);
      ASSERT_EQ(test::evaluate(model, e, want_element | want_values, again), ENTS_OK);
      EXPECT_TRUE(same_bits(results, again));
    }
    // on the symmetry line the start is no better than either side: what comes is the same every time
    e[start] = {0.0};
    const int32_t status = test::evaluate(model, e, want_element | want_values, results);
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(test::evaluate(model, e, want_element | want_values, again), status);
      EXPECT_TRUE(same_bits(results, again));
    }
  }
}

// A ray above the top of an arch and across it meets nothing: recoverable, from any start.
TEST(Borderline, ARayThatMissesIsRecoverable) {
  for (const Pose& pose : poses(2)) {
    SCOPED_TRACE("size " + number(pose.size));
    std::vector<double> ray = {1.0, 0.0};
    pose.turn.apply(ray.data(), 2);
    const Model model(R"({"segment": "line3", "projection": {"type": "shadow_direction", "direction": )" +
                      vector_text(ray) + R"(}, "contact": {"normal": {"type": "penalty", "stiffness": 1}}})");
    Element e;
    e[master] = {-1, 0, 1, 0, 0, 1};
    e[slave] = {0.3, 1.2};
    e = posed(e, pose, 2);
    for (const double x : {-1.0, -0.3, 0.2, 0.9, 2.0}) {
      e[start] = x > 1.0 ? std::vector<double>() : std::vector<double>{x};
      Results results(model.layout);
      for (auto& array : results.real) array.assign(array.size(), -7.0);
      ents_report report = new_report();
      const int32_t status = test::evaluate(model, e, want_all, results, &report);
      EXPECT_TRUE(status == ENTS_NO_PROJECTION || status == ENTS_GRAZING_RAY) << status;
      EXPECT_TRUE(report.step_factor > 0.0 && report.step_factor < 1.0);
      for (const auto& array : results.real)
        for (const double v : array) EXPECT_EQ(v, -7.0);
    }
  }
}

// Deeper than the limit - the model's, else the size of the segment - is recoverable, not a huge force.
TEST(Borderline, DeepPenetrationIsRecoverable) {
  for (const Basis& b : bases())
    for (const std::string& p : projection_kinds())
      for (const Pose& pose : poses(b.dimension)) {
        SCOPED_TRACE(std::string(b.name) + " " + p + " size " + number(pose.size));
        Results results(Model(text({b.name})).layout);
        ents_report report = new_report();
        Element unit;
        unit[master] = flat_master(b);
        unit[start] = centre(b);
        const auto status_at = [&](const Model& model, double depth) {
          Element e = unit;
          e[slave] = above_centre(b, -depth);
          return test::evaluate(model, posed(e, pose, b.dimension), want_element, results, &report);
        };
        const Model own = model_in(pose, b, "none", p),
                    limited =
                        model_in(pose, b, "none", p, R"(, "penetration_limit": )" + number(0.05 * pose.size));
        EXPECT_EQ(status_at(limited, 0.045), ENTS_OK);
        EXPECT_EQ(status_at(limited, 0.055), ENTS_DEEP_PENETRATION);
        EXPECT_GT(report.step_factor, 0.0);
        EXPECT_LT(report.step_factor, 1.0);
        EXPECT_NE(std::string(report.message).find("penetration_limit"), std::string::npos) << report.message;
        const char* gap = std::strstr(report.message, "gap = ");
        ASSERT_NE(gap, nullptr) << report.message;
        if (p == "normal") {
          EXPECT_NEAR(std::strtod(gap + 6, nullptr), -0.055 * pose.size,
                      1e-6 * pose.size); // six digits are shown
        }
        EXPECT_EQ(status_at(own, 0.5), ENTS_OK);
        // flat segments are at most 2 sqrt 2 large; a ray that is not vertical ends beside the segment
        if (p == "normal") {
          EXPECT_EQ(status_at(own, 3.0), ENTS_DEEP_PENETRATION);
          EXPECT_NE(std::strstr(report.message, "deeper than the segment is long"), nullptr)
              << report.message;
          EXPECT_EQ(status_at(own, -3.0), ENTS_OK) << "open by the same distance";
        }
      }
}

// The energy of an open element with a multiplier dof is the potential of its row, beside the segment as well
// as above it. It is a parabola: the central difference is exact.
TEST(Borderline, MultipliersOfOpenElementsHaveAPotential) {
  for (const char* law : {"augmented_multiplier", "multiplier"})
    for (const double x : {0.1, 1.7})
      for (const double lambda : {-3.0, -1.5}) {
        const Model model(std::string(R"({"segment": "line2", "contact": {"normal": {"type": ")") + law +
                          R"(", "stiffness": 100}}})");
        Results results(model.layout);
        Element e;
        e[master] = {-1, 0, 1, 0}, e[slave] = {x, 0.01};
        const auto energy = [&](double at) {
          e[multiplier] = {at};
          EXPECT_EQ(test::evaluate(model, e, want_element | ENTS_FLAGS, results), ENTS_OK);
          EXPECT_FALSE(results.flags & ENTS_FLAG_CONTACT);
          return results.of(ENTS_ENERGY)[0];
        };
        const double slope = energy(lambda + 0.5) - energy(lambda - 0.5);
        energy(lambda);
        EXPECT_NEAR(results.of(ENTS_RESIDUAL)[6], slope, 1e-15) << law << " " << x;
        EXPECT_DOUBLE_EQ(slope, -lambda / 100);
      }
}

// Friction and no slip: the direction of the traction is 0/0, the branch is stick, the tangent is that of
// stick.
TEST(Borderline, NoSlipSticks) {
  const std::size_t laws[] = {6, 7, 8, 9,
                              10}; // of contact_kinds(), with friction and a normal force from the gap
  for (const Basis& b : bases())
    for (const char* h : {"none", "sine"})
      for (const std::size_t law : laws)
        for (const Pose& pose : poses(b.dimension)) {
          SCOPED_TRACE(std::string(b.name) + " " + h + " size " + number(pose.size) + " " +
                       contact_kinds()[law]);
          const Model model = model_in(pose, b, h, "normal", "", contact_kinds()[law]);
          Results first(model.layout), results(model.layout);
          Element e;
          e[master] = flat_master(b);
          e = posed(e, pose, b.dimension);
          const SurfacePoint at = surface_point(model, e, centre(b));
          for (std::size_t c = 0; c < at.point.size(); ++c)
            e[slave].push_back(at.point[c] - 0.01 * pose.size * at.normal[c]);
          e[multiplier].assign(static_cast<std::size_t>(model.layout.multipliers), 0.0);
          e = with_new_state(model, e);
          ASSERT_EQ(test::evaluate(model, e, want_all, first), ENTS_OK);
          e[state_begin] = first.of(ENTS_STATE);
          ASSERT_EQ(test::evaluate(model, e, want_all, results), ENTS_OK);
          EXPECT_EQ(results.flags & (ENTS_FLAG_STICK | ENTS_FLAG_SLIP), ENTS_FLAG_STICK);
          // the projection, found again, moves by rounding: stiffness 500 times that
          EXPECT_LE(largest(results.of(ENTS_TRACTION)), 500.0 * 32 * epsilon * pose.size);
          EXPECT_EQ(results.of(ENTS_SLIP)[0], 0.0);
          EXPECT_TRUE(all_finite(results.of(ENTS_TANGENT)));
          // no traction: the tangent of stick is normal stiffness + positive elastic stiffness, symmetric
          // (but for the traction's own rounding times second variations, and the sums of the products)
          const auto n = static_cast<std::size_t>(model.layout.dofs);
          const std::vector<double>& k = results.of(ENTS_TANGENT);
          if (model.layout.multipliers > 0) continue; // Alart and Curnier: not symmetric with friction
          const double tolerance = 1e-12 * largest(k);
          for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < i; ++j) ASSERT_NEAR(k[i * n + j], k[j * n + i], tolerance);
          for (std::size_t i = 0; i < static_cast<std::size_t>(b.dimension); ++i)
            EXPECT_GT(k[i * n + i], 0.0);
        }
}

// Pressure exactly zero on the cone's tip: no traction, whatever the slip.
TEST(Borderline, NoPressureNoTraction) {
  const Model model(text({"quad4", "none", "normal", "", 6}));
  Results results(model.layout);
  Element e;
  e[master] = flat_master(basis("quad4"));
  e[slave] = {0.1, 0.2, -0.01};
  e = with_new_state(model, e);
  ASSERT_EQ(test::evaluate(model, e, want_all, results), ENTS_OK);
  e[state_begin] = results.of(ENTS_STATE);
  for (const double gap : {0.0, -5e-324, -1e-300}) {
    e[slave] = {0.4, 0.1, gap};
    ASSERT_EQ(test::evaluate(model, e, want_all, results), ENTS_OK) << gap;
    EXPECT_LE(largest(results.of(ENTS_TRACTION)), 0.3 * 1000.0 * -gap * (1 + 8 * epsilon));
    EXPECT_TRUE(all_finite(results.of(ENTS_TANGENT)) && all_finite(results.of(ENTS_RESIDUAL)));
  }
}

} // namespace
} // namespace borderline_test
