// SPDX-License-Identifier: BSD-3-Clause
// Two equal elastic spheres pressed together and sheared (R. D. Mindlin 1949; K. L. Johnson, Contact
// Mechanics, 1985, section 7.2(d)): half of them, with a plane of symmetry through a bspline16 master. With
// P, Q < mu P:
//   a^3 = 3 P R / (4 E*),  p0 = 3 P / (2 pi a^2),  stick for r <= c = a (1 - Q / (mu P))^(1/3).
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include <gtest/gtest.h>

#include "support.hpp"

namespace host {
namespace {

// Elements across the fine part of the surface, from the axis on: 4, with 3.4 spacings in the contact radius
int divisions() {
  const char* text = std::getenv("ENTS_TEST_SPACINGS");
  return text ? std::atoi(text) : 4;
}
constexpr double side = 1.3, fine = 0.26;

Json axis_of(bool half) {
  Json pieces = Json::array();
  if (!half) pieces.push_back({{"to", -fine}, {"divisions", 5}, {"growth", 0.625}});
  pieces.push_back({{"to", fine}, {"divisions", half ? divisions() : 2 * divisions()}});
  pieces.push_back({{"to", side}, {"divisions", 5}, {"growth", 1.6}});
  return {{"from", half ? 0 : -side}, {"pieces", pieces}};
}

Json block(const char* name, bool upper) {
  const Json coarse{{"to", upper ? side : -0.1}, {"divisions", 6}, {"growth", upper ? 1.6 : 0.625}};
  const Json dense{{"to", upper ? 0.1 : 0.}, {"divisions", (divisions() + 1) / 2}};
  Json z{{"from", upper ? 0 : -side}};
  z["pieces"] = upper ? Json::array({dense, coarse}) : Json::array({coarse, dense});
  return {{"name", name},        {"material", "body"}, {"element", "hex8"},
          {"x", axis_of(false)}, {"y", axis_of(true)}, {"z", z}};
}

TEST(Mindlin, StickRadiusOfSpheresOnASmoothedMasterWithAPlaneOfSymmetry) {
  Json json{{"dimension", 3},
            {"materials", {{"body", {{"law", "linear_elastic"}, {"young", 1000}, {"poisson", 0.3}}}}},
            {"parts", {block("lower", false), block("upper", true)}},
            {"steps", {{"control", "load_factor"}, {"values", {0.5, 1, 1.5, 2}}}},
            {"solver", {{"tolerance", 1e-8}}}};
  json["supports"] = {{{"nodes", "lower.z_min"}, {"x", 0}, {"y", 0}, {"z", 0}},
                      {{"nodes", "upper.z_max"}, {"y", 0}},
                      {{"nodes", "upper.z_max"}, {"z", -0.0044}, {"path", {{0, 0}, {1, 1}}}},
                      {{"nodes", "upper.z_max"}, {"x", 0.0007}, {"path", {{1, 0}, {2, 1}}}},
                      {{"nodes", "lower.y_min"}, {"y", 0}},
                      {{"nodes", "upper.y_min"}, {"y", 0}}};
  const Json coefficients = {{0, 0, -0.05}, {0}, {-0.05}};
  json["contact"] = {{"slave", "upper.z_min"},
                     {"master",
                      {{"faces", "lower.z_max"},
                       {"ends", "straight"},
                       {"mirror", {{"y", 0}}},
                       {"surface_coordinates", {"x", "y"}}}},
                     {"model",
                      {{"segment", "bspline16"},
                       {"height", {{"type", "polynomial"}, {"coefficients", coefficients}}},
                       {"contact",
                        {{"normal", {{"type", "penalty"}, {"stiffness", 2e5}}},
                         {"friction", {{"type", "coulomb"}, {"coefficient", 0.3}, {"stiffness", 1e6}}}}}}}};
  const Scene scene = test::scene_from(json);
  Simulation simulation(scene, &test::library());
  const StepRecord record = solve(simulation, {}).back();
  EXPECT_TRUE(record.cuts.empty());
  const double normal = -2 * record.contact_force[2], shear = 2 * std::abs(record.contact_force[0]);
  const double modulus = 1000 / (2 * 0.91), radius = std::cbrt(3 * normal * 10 / (4 * modulus)),
               peak = 3 * normal / (2 * std::numbers::pi * radius * radius),
               stick = radius * std::cbrt(1 - shear / (0.3 * normal));
  const double spacing = fine / divisions();
  double last_stick = 0, first_slip = side;
  double squares = 0, away = 0,
         exact = 0; // of the traction; away: without rings of a spacing round r = c and a
  for (std::size_t k = 0; k < record.areas.size(); ++k) {
    const double r = std::hypot(record.places[3 * k], record.places[3 * k + 1]);
    const auto dome = [&](double end) { return r < end ? std::sqrt(1 - r * r / (end * end)) : 0.0; };
    const double q = 0.3 * peak * (dome(radius) - stick / radius * dome(stick)),
                 error = std::abs(record.fields.traction[3 * k]) - q;
    squares += record.areas[k] * error * error, exact += record.areas[k] * q * q;
    if (std::abs(r - stick) > spacing && std::abs(r - radius) > spacing)
      away += record.areas[k] * error * error;
    if (!record.fields.closed[k]) continue;
    if ((record.fields.flags[k] & ENTS_FLAG_SLIP) != 0)
      first_slip = std::min(first_slip, r);
    else
      last_stick = std::max(last_stick, r);
  }
  std::printf("Q / (mu P) = %.3f: peak %+.2f %%; stick to %.3f, slip from %.3f, exact %.4f of %.4f\n",
              shear / (0.3 * normal), 100 * (record.peak_pressure / peak - 1), last_stick, first_slip, stick,
              radius);
  std::printf("%.1f spacings in the contact radius, traction off by %.1f %% rms, %.1f %% without the rings\n",
              radius / spacing, 100 * std::sqrt(squares / exact), 100 * std::sqrt(away / exact));
  if (divisions() == 4) {
    EXPECT_LT(std::sqrt(squares / exact), 0.22);
    EXPECT_LT(std::sqrt(away / exact), 0.08);
  }
  EXPECT_NEAR(record.peak_pressure / peak, 1, 0.02);
  EXPECT_LT(std::abs(last_stick - stick), spacing);
  EXPECT_LT(std::abs(first_slip - stick), spacing);
}

} // namespace
} // namespace host
