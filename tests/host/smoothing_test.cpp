// SPDX-License-Identifier: BSD-3-Clause
// Smoothed masters at their borders: planes of symmetry, straight and repeated ends.
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "result.hpp"
#include "sample_count.hpp"
#include "support.hpp"

namespace host::smoothing_test {
namespace {

struct Pressed {
  std::string segment;
  bool solid = false, part = false; ///< in space; half, in space a quarter, with planes of symmetry
  bool friction = false;
};

/// A dome, which is a height on the lower block, pressed into the upper one; their meshes do not match.
Json scene(const Pressed& pressed) {
  const double from = pressed.part ? 0 : -1;
  const int n = pressed.part ? 1 : 2;
  const std::string up = pressed.solid ? "z" : "y", element = pressed.solid ? "hex8" : "quad4";
  const auto block = [&](const char* name, double low, double high, int across) {
    Json part{{"name", name}, {"material", "body"}, {"element", element}};
    part["x"] = test::axis(from, 1, across * n);
    if (pressed.solid) part["y"] = test::axis(from, 1, (across + 1) * n);
    part[up] = test::axis(low, high, 3);
    return part;
  };
  const int fine = pressed.solid ? 4 : 14, coarse = pressed.solid ? 3 : 10;
  Json json{{"dimension", pressed.solid ? 3 : 2},
            {"materials", {{"body", {{"law", "linear_elastic"}, {"young", 1000}, {"poisson", 0.3}}}}},
            {"parts", {block("lower", -1, 0, coarse), block("upper", 0, 1, fine)}},
            {"steps", {{"control", "load_factor"}}}};
  json["steps"]["values"] = pressed.solid ? Json{0.25, 0.5} : Json{0.25, 0.5, 0.75, 1};
  if (!pressed.solid) json["formulation"] = "plane_strain";
  const Json bent = {{0, 0, -0.1}, {0}, {-0.1}};
  const Json height = pressed.solid ? bent : Json{0, 0, -0.1};
  json["contact"] = {{"slave", "upper." + up + "_min"},
                     {"master",
                      {{"faces", "lower." + up + "_max"},
                       {"ends", "straight"},
                       {"surface_coordinates", pressed.solid ? Json{"x", "y"} : Json{"x"}}}},
                     {"model",
                      {{"segment", pressed.segment},
                       {"height", {{"type", "polynomial"}, {"coefficients", height}}},
                       {"contact", {{"normal", {{"type", "penalty"}, {"stiffness", 1e5}}}}}}}};
  if (pressed.friction)
    json["contact"]["model"]["contact"]["friction"] = {
        {"type", "coulomb"}, {"coefficient", 0.05}, {"stiffness", 1e5}};
  Json bottom{{"nodes", "lower." + up + "_min"}, {"x", 0}, {"y", 0}},
      top{{"nodes", "upper." + up + "_max"}, {"x", 0}, {"y", 0}};
  bottom[up] = 0, top[up] = -0.03;
  json["supports"] = {bottom, top};
  for (const char* axis : {"x", "y"}) {
    if (!pressed.part || (!pressed.solid && *axis == 'y')) continue;
    json["contact"]["master"]["mirror"][axis] = 0;
    for (const char* name : {"lower.", "upper."})
      json["supports"].push_back({{"nodes", name + std::string(axis) + "_min"}, {axis, 0}});
  }
  return json;
}

// What lies beyond a plane of symmetry is the other half: the half with the plane gives the bits of the whole
// but for rounding, and Newton's iteration, which sees the images in its tangent, as many steps.
TEST(SmoothedMaster, AHalfWithAPlaneOfSymmetryIsTheWhole) {
  for (const char* segment : {"bspline4", "catmull_rom4", "bspline16", "catmull_rom16"})
    for (const bool friction : {false, true})
      for (const Json& sampling : {Json(), Json(2), Json("cut")}) {
        const bool solid = std::string(segment).ends_with("16");
        // In space the runs are long where Newton's iteration fails on these coarse meshes and steps are cut,
        // and pieces are divided into triangles, which are not symmetric.
        if (solid && (sampling == "cut" || friction == sampling.is_number())) continue;
        if (segment == std::string("catmull_rom16") && (friction || ::test::long_divisor() > 1)) continue;
        const auto solve_it = [&](bool part) {
          Json json = scene({segment, solid, part, friction});
          if (!sampling.is_null()) json["contact"]["sampling"] = sampling;
          return test::last_step(json);
        };
        const StepRecord whole = solve_it(false), part = solve_it(true);
        const double copies = solid ? 4 : 2, force = std::abs(whole.contact_force.back());
        std::printf("%s%s, %s: peak %.6f, %+.1e; force %+.1e; iterations %d, %d\n", segment,
                    friction ? " with friction" : "", sampling.dump().c_str(), whole.peak_pressure,
                    part.peak_pressure / whole.peak_pressure - 1,
                    copies * std::abs(part.contact_force.back()) / force - 1, whole.iterations(),
                    part.iterations());
        // residuals are 1e-10 of the forces; the stiffest law, 1e5, is 1e2 times as stiff as the mesh
        EXPECT_NEAR(part.peak_pressure / whole.peak_pressure, 1, 1e-8);
        EXPECT_NEAR(copies * std::abs(part.contact_force.back()) / force, 1, 1e-9);
        EXPECT_EQ(part.iterations(), whole.iterations());
      }
}

/// A quarter of two blocks of the same width, pressed together evenly.
Json even(const char* segment, const char* ends, const char* element = "hex8") {
  Json json = scene({segment, true, true});
  json["steps"]["values"] = {0.1};
  for (Json& part : json["parts"]) part["element"] = element;
  json["contact"]["model"].erase("height");
  json["contact"]["model"]["border"] = 0.05; // the blocks bulge, not quite alike
  json["contact"]["master"]["ends"] = ends;
  return json;
}

// A spline whose ends are repeated is shorter than its nodes: the outermost slave nodes find nothing.
// With straight ends it ends where they do.
TEST(SmoothedMaster, StraightEndsReachTheBorder) {
  for (const char* segment : {"bspline16", "catmull_rom16"})
    EXPECT_EQ(test::last_step(even(segment, "straight")).contact_fraction, 1) << segment;
  for (const char* ends : {"quasi_cubic", "quasi_parabolic"})
    EXPECT_EQ(test::last_step(even("bspline16", ends)).contact_fraction, 1) << ends;
  EXPECT_EQ(test::last_step(even("bezier15", "straight", "tet4")).contact_fraction, 1);
  EXPECT_EQ(test::last_step(even("catmull_rom16", "repeated")).contact_fraction, 1);
  EXPECT_LT(test::last_step(even("bspline16", "repeated")).contact_fraction, 0.99);
}

// What ParaView shows is the surface that the slave nodes touch, with its height, where the body has moved.
TEST(SmoothedMaster, ItsPictureIsTheSurfaceOfTheContact) {
  for (const char* segment : {"bspline4", "catmull_rom4", "bspline16"}) {
    const bool solid = std::string(segment).ends_with("16");
    const Scene read = test::scene_from(scene({segment, solid, false}));
    Simulation simulation(read, &test::library());
    const ContactFields fields = solve(simulation, {}).back().fields;
    const std::vector<double> shown = master_grid(simulation).points;
    const std::size_t d = solid ? 3 : 2;
    int touching = 0;
    for (std::size_t k = 0; k < fields.closed.size(); ++k) {
      if (!fields.closed[k]) continue;
      double nearest = 1;
      for (std::size_t p = 0; p < shown.size(); p += d) {
        double squares = 0;
        for (std::size_t i = 0; i < d; ++i) squares += std::pow(shown[p + i] - fields.point[k * d + i], 2);
        nearest = std::min(nearest, std::sqrt(squares));
      }
      // half a diagonal of a cell: 2 / 20 / 200 along a line, 2 / 6 / 24 and 2 / 8 / 24 in space
      EXPECT_LT(nearest, solid ? 0.011 : 0.0006) << segment << ", slave " << k;
      ++touching;
    }
    EXPECT_GT(touching, 2) << segment;
  }
}

// A checkpoint goes on to the same bits: friction's anchors are on segments whose points are combinations.
TEST(SmoothedMaster, RestartGoesOnWithTheSameBits) {
  const Scene half = test::scene_from(scene({"bspline4", false, true, true}));
  Simulation whole(half, &test::library());
  ASSERT_TRUE(whole.advance({0.5, 0.5}).converged);
  const std::string checkpoint = whole.checkpoint().dump();
  ASSERT_TRUE(whole.advance({1, 1}).converged);
  Simulation again(half, &test::library());
  again.restore(Json::parse(checkpoint));
  ASSERT_TRUE(again.advance({1, 1}).converged);
  EXPECT_EQ(again.fingerprint(), whole.fingerprint());
}

TEST(SmoothedMaster, MistakesAreNamed) {
  const auto expect = [](const std::function<void(Json&)>& edit, const char* text,
                         const char* segment = "bspline4") {
    Json json = scene({segment, false, true});
    edit(json);
    try {
      test::last_step(json);
      FAIL() << text;
    } catch (const std::exception& error) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  };
  const auto master = [](const char* key, const Json& value) {
    return [=](Json& json) { json["contact"]["master"][key] = value; };
  };
  expect(master("ends", "round"), "/contact/master/ends");
  expect(master("mirror", Json::object()), "/contact/master/mirror: a plane of symmetry is expected");
  expect(master("mirror", {{"z", 0}}), "/contact/master/mirror");
  expect(master("mirror", {{"x", "left"}}), "/contact/master/mirror/x");
  expect(master("mirror", {{"x", -1}}), "have no node on this plane");
  expect(master("mirror", {{"x", 0.5}}), "lie on both sides of this plane");
  expect([](Json&) {}, "are for smoothed segments", "line2");
  expect([](Json& json) { json["supports"].erase(2); }, "has left its plane of symmetry");
}

} // namespace
} // namespace host::smoothing_test
