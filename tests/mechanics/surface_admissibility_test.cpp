// ents_surface_check on whole surfaces. The four panels of Fig. 4 of the paper, each on both sides of its
// limit and with the number and the place of the worst; then what a mesh adds: neighbours, both sides of a
// gap, self-shadow from afar.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "library.hpp"
#include "mesh_surface.hpp"
#include "sweep.hpp"

namespace mechanics {
namespace {

using nlohmann::json;

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-12;   // of formulae with second derivatives
constexpr double search_step = 1e-8; // the last step in xi of the search for the worst place
constexpr std::int64_t bit(int condition) { return std::int64_t{1} << condition; }

Model model(const std::string& segment, const json& height, const json& more = json::object()) {
  json text = {{"segment", segment}, {"height", height}};
  text.update(more);
  return Model(text.dump());
}

struct Checked : ents_surface_admissibility {
  std::vector<std::int64_t> marks;
  bool violates(int condition) const { return (violated & bit(condition)) != 0; }
  bool judges(int condition) const { return (judged & bit(condition)) != 0; }
};

Checked check(const Model& m, const MeshSurface& surface, double reach = 0.0, int samples = 0,
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
MeshSurface polyline(const std::vector<double>& points, bool closed = false) {
  MeshSurface out;
  out.basis = &basis_named("line2");
  out.positions = points;
  const std::int64_t nodes = out.nodes();
  for (std::int64_t i = 0; i + 1 < nodes + closed; ++i)
    out.connectivity.insert(out.connectivity.end(), {i, (i + 1) % nodes});
  return out;
}

// The same extruded along z: quadrangles of unit depth. The outer side stays the outer side.
MeshSurface extruded(const MeshSurface& profile, const std::string& basis) {
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

MeshSurface strip(int segments, double length) {
  std::vector<double> points;
  for (int i = 0; i <= segments; ++i) points.insert(points.end(), {length * i / segments, 0.0});
  MeshSurface out = polyline(points);
  for (int i = 0; i < segments; ++i)
    out.surface_coordinates.insert(out.surface_coordinates.end(),
                                   {length * i / segments, length * (i + 1) / segments});
  return out;
}

json waves(double amplitude, double per_length) {
  return {{"type", "sine"}, {"amplitude", amplitude}, {"wave_vector", {per_length}}};
}

// Panel a. A sine over four segments: its crests and valleys have the smallest radius, and a slave at that
// distance two projections. The reach decides.
TEST(SurfaceAdmissibility, PanelAReachAgainstTheCurvature) {
  const double amplitude = 0.05, k = 2.0 * pi, radius = 1.0 / (amplitude * k * k);
  const Model m = model("line2", waves(amplitude, 1.0));
  const MeshSurface surface = strip(4, 3.0);
  for (const double part : {0.5, 0.999, 1.001, 2.0}) {
    const Checked c = check(m, surface, part * radius);
    EXPECT_EQ(c.violated, part < 1.0 ? 0 : bit(ENTS_CHECK_PROJECTION)) << part;
    EXPECT_TRUE(c.judges(ENTS_CHECK_PROJECTION));
    EXPECT_EQ(c.bound[ENTS_CHECK_PROJECTION], part * radius);
    // No two balls touch more closely than the curvature lets them (the curve is flattest off its crests),
    // but those that a crest's two flanks touch, as their samples come closer to the crest, take its radius
    // from above.
    EXPECT_NEAR(c.value[ENTS_CHECK_PROJECTION], radius, 1e-10 * radius);
    if (part > 1.0) {
      EXPECT_NEAR(c.missing[ENTS_CHECK_PROJECTION], (part - 1.0) * radius, 1e-10 * radius);
    }
    const double x = c.point[ENTS_CHECK_PROJECTION][0];
    EXPECT_NEAR(std::fabs(std::remainder(x, 0.5)), 0.25, 1e-6) << x; // a crest or a valley
  }
  // nothing is judged without a reach; the model's own limit of penetration is one
  EXPECT_FALSE(check(m, surface).judges(ENTS_CHECK_PROJECTION));
  EXPECT_NEAR(check(m, surface).value[ENTS_CHECK_PROJECTION], radius, 1e-10 * radius);
  const Model limited = model("line2", waves(amplitude, 1.0), {{"penetration_limit", 1.1 * radius}});
  EXPECT_TRUE(check(limited, surface).violates(ENTS_CHECK_PROJECTION));
}

// The same from afar: two plates that face each other, far less curved than near. A slave in the middle has a
// projection on each. Sides and bases; the distance is that of the enriched plates.
TEST(SurfaceAdmissibility, PanelATwoSidesOfAGap) {
  const double width = 0.4, h = 0.03;
  MeshSurface profile = polyline({0.0, 0.0, 1.0, 0.0, 2.0, 0.0, 2.0, width, 1.0, width, 0.0, width});
  profile.connectivity = {0, 1, 1, 2, 3, 4, 4, 5}; // outer sides facing each other
  const json constant = {{"type", "constant"}, {"value", h}};
  for (const std::string basis : {"line2", "quad4", "tri3"}) {
    const Model m = model(basis, constant);
    MeshSurface surface = basis == "line2" ? profile : extruded(profile, basis);
    // surface coordinates make the height the surface's own: nothing is asked of the segments' edges
    surface.surface_coordinates.assign(surface.connectivity.size() * static_cast<std::size_t>(m.parameters()),
                                       0.0);
    for (std::size_t i = 0; i < surface.surface_coordinates.size(); ++i)
      surface.surface_coordinates[i] = 0.01 * static_cast<double>(i);
    const double half = 0.5 * width - h;
    EXPECT_EQ(check(m, surface, 0.999 * half).violated, 0) << basis;
    const Checked c = check(m, surface, 1.001 * half);
    EXPECT_EQ(c.violated, bit(ENTS_CHECK_PROJECTION)) << basis;
    EXPECT_NEAR(c.value[ENTS_CHECK_PROJECTION], half, rounding);
    EXPECT_NEAR(c.missing[ENTS_CHECK_PROJECTION], 0.001 * half, rounding);
    const auto upper = [&](std::int64_t s) { return s >= surface.segments() / 2; };
    EXPECT_NE(upper(c.segment[ENTS_CHECK_PROJECTION]), upper(c.other[ENTS_CHECK_PROJECTION])) << basis;
    for (const std::int64_t mark : c.marks) EXPECT_EQ(mark, bit(ENTS_CHECK_PROJECTION)) << basis; // all four
    EXPECT_NEAR(check(m, surface, 10.0).value[ENTS_CHECK_PROJECTION], half, rounding)
        << basis; // from a ball far too large
  }
}

// What the number of panel a claims, held against detection: a slave closer than it is projected on the point
// below it, wherever that is; beyond, at the worst place, on another one (at the border of the surface there
// may be none). 2 %: samples are a 16th of a wave apart.
TEST(SurfaceAdmissibility, PanelAAgainstDetection) {
  Random random(11);
  int inside = 0;
  for (int repeat = 0; repeat < 40; ++repeat) {
    const bool line = repeat % 4 != 0;
    const Basis& basis = basis_named(line ? "line2" : "quad4");
    MeshSurface surface = draw_mesh(random, basis, 3, 0.0);
    json height = {{"type", "sum"}, {"of", json::array()}};
    const double depth = random.uniform(0.05, repeat % 3 == 0 ? 1.2 : 0.3);
    for (int k = 0; k < 2; ++k) {
      json wave = {{"type", "sine"},
                   {"amplitude", depth / (k + 1)},
                   {"wave_vector", {random.uniform(0.1, 0.3 + 0.3 * k)}},
                   {"phase", random.uniform(0.0, 6.0)}};
      if (!line) wave["wave_vector"].push_back(random.uniform(-0.3, 0.3));
      height["of"].push_back(wave);
    }
    const Model m = model(basis.name, height);
    const Checked c = check(m, surface, 1e3);
    const double reach = c.value[ENTS_CHECK_PROJECTION];
    ASSERT_TRUE(c.violates(ENTS_CHECK_PROJECTION));
    Detector detector(m, surface);
    // its distance from the closest point, for a slave over this place
    const auto closest = [&](std::int64_t segment, const std::vector<double>& xi, double gap) {
      const SurfacePoints p =
          evaluate_surface(m, surface.master(segment).data(), surface.coordinates(segment), xi);
      std::vector<double> slave(p.point);
      for (std::size_t k = 0; k < slave.size(); ++k) slave[k] += gap * p.normal[k];
      Detector::Found found;
      detector.detect(slave, 2.0 * std::fabs(gap), found);
      return found.segment[0] < 0 ? 1e9 : std::fabs(found.gap[0]);
    };
    for (int i = 0; i < (line ? 200 : 60); ++i) {
      const std::int64_t segment =
          static_cast<std::int64_t>(random.uniform(0.0, 1.0) * static_cast<double>(surface.segments()));
      std::vector<double> xi(static_cast<std::size_t>(m.parameters()));
      for (double& x : xi) x = random.uniform(-0.99, 0.99);
      const double gap = random.uniform(-0.98, 0.98) * reach;
      EXPECT_NEAR(closest(segment, xi, gap), std::fabs(gap), 1e-9) << repeat << ": " << height;
    }
    const std::vector<double> worst(c.xi[ENTS_CHECK_PROJECTION],
                                    c.xi[ENTS_CHECK_PROJECTION] + m.parameters());
    const SurfacePoints place =
        evaluate_surface(m, surface.master(c.segment[ENTS_CHECK_PROJECTION]).data(),
                         surface.coordinates(c.segment[ENTS_CHECK_PROJECTION]), worst);
    bool border = false; // the surface is 6 long and wide
    for (int a = 0; a < m.parameters(); ++a)
      border =
          border || std::fabs(std::fabs(place.base_point[static_cast<std::size_t>(a)] - 3.0) - 3.0) < 1e-3;
    if (border) continue;
    ++inside;
    const double beyond = 1.02 * reach;
    double nearest = beyond;
    for (const double side : {-1.0, 1.0})
      nearest = std::min(nearest, closest(c.segment[ENTS_CHECK_PROJECTION], worst, side * beyond));
    EXPECT_LT(nearest, beyond * (1.0 - 1e-6)) << repeat << ": " << height;
  }
  EXPECT_GT(inside, 20);
}

// Segments that meet at almost no angle are one surface; what rounding leaves between them is no second
// sheet.
TEST(SurfaceAdmissibility, PanelANearlyFlatNeighbours) {
  for (const double bend : {0.0, 1e-12, 1e-9, 1e-7, 1e-5, 1e-3}) {
    MeshSurface surface = extruded(polyline({0.0, 0.0, 1.0, 0.0, 2.0, bend, 3.0, 0.0}), "quad4");
    surface.surface_coordinates.assign(surface.connectivity.size() * 2, 0.5);
    for (std::size_t i = 0; i < surface.surface_coordinates.size(); i += 3)
      surface.surface_coordinates[i] = 0.25;
    const Model m = model("quad4", {{"type", "constant"}, {"value", 0.02}});
    EXPECT_FALSE(check(m, surface, 0.5).violates(ENTS_CHECK_PROJECTION)) << bend;
  }
  MeshSurface step = polyline({0.0, 0.0, 1.0, 0.0, 2.0, 0.0}); // by less than what counts as a jump
  step.surface_coordinates = {0.0, 0.0, 1e-10, 1e-10};
  EXPECT_EQ(
      check(model("line2", {{"type", "polynomial"}, {"coefficients", {0.02, 1.0}}}), step, 0.01).violated, 0);
}

// Panel b. A sine under a slanted light: admissible up to the angle of its steepest flank; beyond, the number
// is the cosine there, and each crest keeps from the light a piece that starts where the ray touches it.
TEST(SurfaceAdmissibility, PanelBSelfShadow) {
  const double amplitude = 0.08, k = 2.0 * pi, slope = amplitude * k, limit = std::atan(1.0 / slope);
  const MeshSurface surface = strip(5, 4.0);
  for (const double part : {0.5, 0.999, 1.001, 1.2}) {
    const double angle = part * limit;
    const Model m = model(
        "line2", waves(amplitude, 1.0),
        {{"projection", {{"type", "shadow_direction"}, {"direction", {std::sin(angle), std::cos(angle)}}}}});
    const Checked c = check(m, surface, 0.0, 201);
    const double cosine = (std::cos(angle) - slope * std::sin(angle)) / std::sqrt(1.0 + slope * slope);
    EXPECT_NEAR(c.value[ENTS_CHECK_SHADOW], cosine, rounding);
    EXPECT_EQ(c.violates(ENTS_CHECK_SHADOW), part > 1.0);
    EXPECT_FALSE(c.judges(ENTS_CHECK_PROJECTION));
    if (part > 1.0) {
      EXPECT_NEAR(c.missing[ENTS_CHECK_SHADOW], -cosine, rounding);
    }
    if (part < 1.0) {
      EXPECT_EQ(c.violated, 0) << part;
      EXPECT_EQ(c.value[ENTS_CHECK_OCCLUSION], 0.0);
    } else if (part > 1.1) {
      // from every sample, the last place at which its ray leaves the surface
      const auto height = [&](double x) { return amplitude * std::sin(k * x); };
      double longest = 0.0;
      for (int i = 0; i <= 1000; ++i)
        for (int j = 0; j < 1000; ++j) {
          const double x = 0.004 * i, t = 1e-3 * j;
          const auto clear = [&](double d) {
            return height(x) + d * std::cos(angle) - height(x + d * std::sin(angle));
          };
          if (x + t * std::sin(angle) < 4.0 && clear(t) < -1e-9 && clear(t + 1e-3) > 0.0)
            longest = std::max(longest, t);
        }
      EXPECT_TRUE(c.violates(ENTS_CHECK_OCCLUSION));
      // the ray meets a facet, of 0.004, instead of the surface
      EXPECT_NEAR(c.value[ENTS_CHECK_OCCLUSION], longest, 3.0 * 0.004 / std::sin(angle));
    }
  }
}

// Panel b with no steep place at all: a roof over a plate.
TEST(SurfaceAdmissibility, PanelBAPartInTheLightOfAnother) {
  MeshSurface profile = polyline({0.0, 0.0, 1.0, 0.0, 2.0, 0.0, 0.5, 0.7, 1.2, 0.7});
  profile.connectivity = {1, 0, 2, 1, 4, 3}; // turned tangents point down; the light comes from below
  for (const std::string basis : {"line2", "quad4", "tri3"}) {
    const MeshSurface surface = basis == "line2" ? profile : extruded(profile, basis);
    const json down = basis == "line2" ? json{0.0, -1.0} : json{0.0, -1.0, 0.0};
    const json near = basis == "line2" ? json{1.0, -1.0} : json{1.0, -1.0, 0.5};
    const Checked far =
        check(model(basis, nullptr, {{"projection", {{"type", "shadow_direction"}, {"direction", down}}}}),
              surface, 0.0, 9);
    EXPECT_EQ(far.violated, bit(ENTS_CHECK_OCCLUSION)) << basis;
    EXPECT_NEAR(far.value[ENTS_CHECK_OCCLUSION], 0.7, rounding);
    EXPECT_EQ(far.segment[ENTS_CHECK_OCCLUSION] >= surface.segments() * 2 / 3, true) << basis;
    EXPECT_EQ(far.marks[0], 0);
    // from an emitter at the height of -1: the longest ray is that of the farthest end of the roof
    const Checked lamp =
        check(model(basis, nullptr, {{"projection", {{"type", "shadow_point"}, {"emitter", near}}}}), surface,
              0.0, 9);
    EXPECT_EQ(lamp.violated, bit(ENTS_CHECK_OCCLUSION)) << basis;
    const double along = basis == "line2" ? 0.0 : 0.5;
    EXPECT_NEAR(lamp.value[ENTS_CHECK_OCCLUSION], std::sqrt(0.25 + 1.7 * 1.7 + along * along) * 0.7 / 1.7,
                rounding);
    // from an emitter between the two, the roof is lit
    const json between = basis == "line2" ? json{1.0, 0.3} : json{1.0, 0.3, 0.5};
    EXPECT_FALSE(
        check(model(basis, nullptr, {{"projection", {{"type", "shadow_point"}, {"emitter", between}}}}),
              surface, 0.0, 9)
            .violates(ENTS_CHECK_OCCLUSION));
  }
}

// Every piece of a facet casts a shadow: a small triangle under the middle piece of a large one that is cut
// into four.
TEST(SurfaceAdmissibility, PanelBTheMiddleOfATriangle) {
  MeshSurface surface;
  surface.basis = &basis_named("tri3");
  surface.positions = {0, 0, 1, 4, 0, 1, 0, 4, 1, 1.2, 1.2, 0, 1.4, 1.2, 0, 1.2, 1.4, 0};
  surface.connectivity = {0, 1, 2, 3, 4, 5};
  const json light = {{"projection", {{"type", "shadow_direction"}, {"direction", {0, 0, 1}}}}};
  const Checked c = check(model("tri3", nullptr, light), surface, 0.0, 3);
  EXPECT_EQ(c.violated, bit(ENTS_CHECK_OCCLUSION));
  EXPECT_NEAR(c.value[ENTS_CHECK_OCCLUSION], 1.0, rounding);
  EXPECT_EQ(c.segment[ENTS_CHECK_OCCLUSION], 1);
  EXPECT_EQ(c.other[ENTS_CHECK_OCCLUSION], 0);
  for (int a = 0; a < 2; ++a)
    EXPECT_NEAR(c.other_xi[ENTS_CHECK_OCCLUSION][a], 0.25 * c.point[ENTS_CHECK_OCCLUSION][a], rounding);
}

// A textured square that no ray meets at less than 3 degrees lies in no shadow, not of its own facets
// either.
TEST(SurfaceAdmissibility, PanelBNoFalseShadows) {
  Random random(5);
  int lit = 0;
  for (int repeat = 0; repeat < 40; ++repeat) {
    const Basis& basis = basis_named(repeat % 2 ? "quad4" : "tri3");
    MeshSurface surface = draw_mesh(random, basis, 2, 0.0);
    const json height = {{"type", "sine"},
                         {"amplitude", random.uniform(0.05, 0.3)},
                         {"wave_vector", {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)}}};
    const json light = {{"type", "shadow_direction"},
                        {"direction", {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), 1.0}}};
    const Checked c = check(model(basis.name, height, {{"projection", light}}), surface, 0.0, 41);
    if (!(c.value[ENTS_CHECK_SHADOW] > 0.05)) continue;
    ++lit;
    EXPECT_EQ(c.violated, 0) << height << light;
  }
  EXPECT_GT(lit, 10);
}

// Panel c. A local height that does not vanish on the edges: the surface is torn by 2 h sin(angle / 2) where
// segments meet at an angle, and by nothing where they do not. The kink is the angle, turned by the slopes of
// h.
TEST(SurfaceAdmissibility, PanelCHeightOnTheEdges) {
  const double angle = 0.9, c = std::cos(angle), s = std::sin(angle);
  const MeshSurface profile = polyline({-2.0, 0.0, 0.0, 0.0, 2.0 * c, -2.0 * s}); // convex
  for (const std::string basis : {"line2", "quad4"}) {
    const MeshSurface surface = basis == "line2" ? profile : extruded(profile, basis);
    for (const double edge : {0.0, 0.03}) {
      // 0.1 (1 - s^2) + edge, along the profile (quad4: minus its xi_1, an even function)
      const json height = {{"type", "polynomial"},
                           {"coefficients", basis == "line2" ? json{0.1 + edge, 0.0, -0.1}
                                                             : json{{0.1 + edge}, {0.0}, {-0.1}}}};
      const Checked r = check(model(basis, height), surface, 0.0, 0);
      std::int64_t expected = edge > 0.0 ? bit(ENTS_CHECK_EDGE) | bit(ENTS_CHECK_JUMP) : 0;
      if (basis == "quad4") expected |= bit(ENTS_CHECK_EDGE); // on the sides of the strip, too
      EXPECT_EQ(r.violated, expected) << basis << " " << edge;
      EXPECT_NEAR(r.value[ENTS_CHECK_EDGE], basis == "quad4" ? 0.1 + edge : edge, 1e-15);
      EXPECT_NEAR(r.value[ENTS_CHECK_JUMP], 2.0 * edge * std::sin(0.5 * angle), 1e-15);
      EXPECT_NEAR(r.missing[ENTS_CHECK_JUMP], 2.0 * edge * std::sin(0.5 * angle),
                  r.bound[ENTS_CHECK_JUMP] + 1e-15);
      const double turn = 2.0 * std::atan(0.2); // down to the edge and up again: slopes of h, half-length 1
      EXPECT_NEAR(r.value[ENTS_CHECK_KINK], angle - turn, rounding);
      EXPECT_NEAR(r.value[ENTS_CHECK_WEDGE], pi + angle - turn, rounding);
      EXPECT_EQ(r.segment[ENTS_CHECK_JUMP], 0);
      EXPECT_EQ(r.other[ENTS_CHECK_JUMP], 1);
      EXPECT_NEAR(r.point[ENTS_CHECK_JUMP][1], edge, 1e-15);
      EXPECT_FALSE(r.judges(ENTS_CHECK_KINK));
      EXPECT_TRUE(check(model(basis, height), surface, 0.0, 0, 0.4).violates(ENTS_CHECK_KINK));
      EXPECT_FALSE(check(model(basis, height), surface, 0.0, 0, 0.6).violates(ENTS_CHECK_KINK));
    }
  }
}

// The same on smoothed surfaces: C1 (Catmull-Rom) leaves a kink where the height is not zero, C2 (B-spline)
// none. Neither is torn, and the height need not vanish anywhere.
TEST(SurfaceAdmissibility, SmoothedSurfacesAreNotTorn) {
  std::vector<double> points, s;
  for (int i = 0; i < 9; ++i) points.insert(points.end(), {0.5 * i, 0.2 * std::sin(0.9 * i)});
  for (const std::string basis : {"catmull_rom4", "bspline4"}) {
    MeshSurface surface;
    surface.basis = &basis_named(basis);
    surface.positions = points;
    for (std::int64_t i = -1; i < 7;
         ++i) // at the ends of the chain its last node stands in for the missing one
      for (std::int64_t a = 0; a < 4; ++a) {
        surface.connectivity.push_back(std::clamp<std::int64_t>(i + a, 0, 8));
        surface.surface_coordinates.push_back(0.5 * static_cast<double>(i + a));
      }
    const Checked c = check(model(basis, waves(0.02, 0.8)), surface, 0.0, 0, 1e-10);
    const bool smooth = basis == "bspline4";
    EXPECT_EQ(c.violated, smooth ? 0 : bit(ENTS_CHECK_KINK)) << basis;
    EXPECT_EQ(c.value[ENTS_CHECK_KINK] > 1e-4, !smooth) << c.value[ENTS_CHECK_KINK];
    EXPECT_LE(c.value[ENTS_CHECK_JUMP], 1e-15);
    EXPECT_NEAR(c.value[ENTS_CHECK_WEDGE], pi, smooth ? 1e-10 : 0.1);
    EXPECT_FALSE(c.judges(ENTS_CHECK_EDGE));
  }
}

// One flat patch; the height goes on into its neighbours, wherever they are.
TEST(SurfaceAdmissibility, SmoothedTrianglesMayHaveAHeightOnTheirSides) {
  MeshSurface surface;
  surface.basis = &basis_named("bezier15");
  const double points[15][2] = {{0, 0}, {4, 0}, {0, 4}, {1, 0}, {2, 0}, {3, 0}, {3, 1}, {2, 2},
                                {1, 3}, {0, 3}, {0, 2}, {0, 1}, {1, 1}, {2, 1}, {1, 2}};
  for (const auto& p : points) {
    surface.connectivity.push_back(static_cast<std::int64_t>(surface.positions.size() / 3));
    surface.positions.insert(surface.positions.end(), {p[0], p[1], 0.0});
  }
  const Checked c = check(model("bezier15", {{"type", "constant"}, {"value", 0.05}}), surface);
  EXPECT_FALSE(c.judges(ENTS_CHECK_EDGE));
  EXPECT_EQ(c.violated, 0);
}

// Panel d, first case. |h| against the radius of curvature over every segment: three parabolas side by side,
// of which the middle one is the most curved, at its top.
TEST(SurfaceAdmissibility, PanelDFolds) {
  MeshSurface surface;
  surface.basis = &basis_named("line3");
  const double bend[] = {0.1, 0.4, 0.2}; // y = bend (1 - x^2): kappa = 2 bend at the top
  for (int i = 0; i < 3; ++i) {
    const std::int64_t node = i == 0 ? 0 : 2 * i;
    if (i == 0) surface.positions = {-1.0, 0.0};
    surface.positions.insert(surface.positions.end(), {2.0 * i, bend[i], 2.0 * i + 1.0, 0.0});
    surface.connectivity.insert(surface.connectivity.end(), {node, node + 2, node + 1});
    surface.surface_coordinates.insert(surface.surface_coordinates.end(), {0.0, 2.0, 1.0});
  }
  for (const double part : {0.5, 0.999, 1.001, 1.2}) {
    const double height = -part / 0.8;
    // 10 samples: none at the top, where the worst is found all the same
    const Checked c = check(model("line3", {{"type", "constant"}, {"value", height}}), surface, 0.0, 10);
    EXPECT_NEAR(c.value[ENTS_CHECK_FOLD], part, rounding + search_step * search_step * 10.0);
    EXPECT_EQ(c.violates(ENTS_CHECK_FOLD), part > 1.0);
    EXPECT_EQ(c.segment[ENTS_CHECK_FOLD], 1);
    EXPECT_NEAR(c.xi[ENTS_CHECK_FOLD][0], 0.0, 1e-6);
    EXPECT_EQ((c.marks[1] & bit(ENTS_CHECK_FOLD)) != 0, part > 1.0);
    EXPECT_EQ((c.marks[0] | c.marks[2]) & bit(ENTS_CHECK_FOLD), 0);
    if (part > 1.0) {
      EXPECT_NEAR(c.missing[ENTS_CHECK_FOLD], part - 1.0, 1e-10);
    }
    // The folded arc crosses itself where x + h n_x = 0: sqrt(1 + 0.64 x^2) = part.
    if (part == 1.2) {
      const Checked fine =
          check(model("line3", {{"type", "constant"}, {"value", height}}), surface, 0.0, 101);
      EXPECT_TRUE(fine.marks[1] & bit(ENTS_CHECK_CROSSING));
      const double x = std::sqrt(part * part - 1.0) / 0.8;
      EXPECT_NEAR(std::fabs(fine.xi[ENTS_CHECK_CROSSING][0]), x, 0.02); // a sample
      EXPECT_EQ(fine.segment[ENTS_CHECK_CROSSING], 1);
      EXPECT_EQ(fine.other[ENTS_CHECK_CROSSING], 1);
      EXPECT_GT(fine.value[ENTS_CHECK_CROSSING], 0.0);
    }
  }
}

// Panel d, second case. Constant heights on two plates with a concave corner of the angle `corner`: the
// plates cross at the distance h / tan(corner / 2) from the corner; the end of each lies 2 h cos^2(corner /
// 2) ... behind the other: its height over the other plate's plane is h - h cos(corner') with the turned
// normal. Lines, quadrangles, triangles.
TEST(SurfaceAdmissibility, PanelDNeighboursCross) {
  const double h = 0.1;
  for (const double corner : {2.6, pi / 2, 1.0}) {
    const double c = std::cos(corner), s = std::sin(corner);
    const MeshSurface profile = polyline({-c, s, 0.0, 0.0, 1.0, 0.0});
    MeshSurface turned = profile;
    turned.positions = {c, s, 0.0, 0.0, 1.0, 0.0}; // the outer side is inside the corner
    for (const std::string basis : {"line2", "quad4", "tri3"}) {
      MeshSurface surface = basis == "line2" ? turned : extruded(turned, basis);
      const Model m = model(basis, {{"type", "constant"}, {"value", h}});
      surface.surface_coordinates.assign(
          surface.connectivity.size() * static_cast<std::size_t>(m.parameters()), 0.0);
      for (std::size_t i = 0; i < surface.surface_coordinates.size(); ++i)
        surface.surface_coordinates[i] = 0.01 * static_cast<double>(i);
      const Checked r = check(m, surface, 0.0, 33);
      EXPECT_EQ(r.violated, bit(ENTS_CHECK_CROSSING) | bit(ENTS_CHECK_JUMP)) << basis << " " << corner;
      // The end of one plate at (0, h), or turned. Behind the other it is h (1 - n . n'), n . n' = -
      // cos(corner), if its foot is on the other: at h sin(corner) from the corner, always. Deeper points
      // have their foot beyond the end.
      EXPECT_NEAR(r.value[ENTS_CHECK_CROSSING], h * (1.0 + c), 1e-12) << basis << " " << corner;
      EXPECT_NE(r.segment[ENTS_CHECK_CROSSING], r.other[ENTS_CHECK_CROSSING]);
      EXPECT_NEAR(r.value[ENTS_CHECK_JUMP], 2.0 * h * std::cos(0.5 * corner), 1e-12);
      EXPECT_NEAR(r.value[ENTS_CHECK_WEDGE], corner, 1e-12);
      // on the other side of the plates the corner is convex: torn, but not crossed
      const Model below = model(basis, {{"type", "constant"}, {"value", -h}});
      EXPECT_EQ(check(below, surface, 0.0, 33).violated, bit(ENTS_CHECK_JUMP)) << basis << " " << corner;
    }
  }
}

// A thread on two plates with a convex corner: where h > 0 they part, where h = -g < 0 they cross, and the
// end of a root lies g (1 / cos(corner) - 1) behind the other plate at most. A point of a ridge has a normal
// projection on the far side of the neighbour's ridge, from behind: it is no depth.
TEST(SurfaceAdmissibility, PanelDThreadsCrossAtTheirRoots) {
  const double corner = 0.4, root = 0.08;
  MeshSurface surface =
      extruded(polyline({-2.0 * std::cos(corner), -2.0 * std::sin(corner), 0.0, 0.0, 2.0, 0.0}), "quad4");
  for (std::size_t i = 2; i < surface.positions.size(); i += 3) surface.positions[i] *= 3.0;
  for (const double lead : {0.0, 0.1, 0.3}) {
    surface.surface_coordinates.clear(); // along z, and how far round
    for (const std::int64_t node : surface.connectivity) {
      const double* x = &surface.positions[static_cast<std::size_t>(3 * node)];
      surface.surface_coordinates.insert(surface.surface_coordinates.end(),
                                         {2.0 * double(node / 2 - 1), x[2]});
    }
    const Model m =
        model("quad4", {{"type", "sum"},
                        {"of",
                         {{{"type", "constant"}, {"value", 0.7 - root}},
                          {{"type", "sine"}, {"amplitude", 0.7}, {"wave_vector", {lead, 1.0}}}}}});
    const Checked r = check(m, surface, 0.0, 65);
    EXPECT_TRUE(r.violates(ENTS_CHECK_CROSSING)) << lead;
    const double exact = root * (1.0 / std::cos(corner) - 1.0);
    EXPECT_NEAR(r.value[ENTS_CHECK_CROSSING], exact, (0.3 + lead) * exact) << lead;
  }
}

// Heights that vanish on the edge and rise from it: neighbours overlap from the edge on where the slopes
// leave no angle between them, and meet again where the heights have come down. h = a (1 - s^2): slope 2 a.
TEST(SurfaceAdmissibility, PanelDNoAngleIsLeft) {
  const double corner = 0.6;
  MeshSurface surface = polyline({2.0 * std::cos(corner), 2.0 * std::sin(corner), 0.0, 0.0, 2.0, 0.0});
  for (const double part : {0.5, 0.99, 1.01, 1.5}) { // of the slope that closes the angle
    const double a = 0.5 * std::tan(0.5 * part * corner);
    const Checked r =
        check(model("line2", {{"type", "polynomial"}, {"coefficients", {a, 0.0, -a}}}), surface, 0.0, 129);
    EXPECT_NEAR(r.value[ENTS_CHECK_WEDGE], (1.0 - part) * corner, rounding);
    const std::int64_t crossing = bit(ENTS_CHECK_WEDGE) | bit(ENTS_CHECK_CROSSING);
    EXPECT_EQ(r.violated & bit(ENTS_CHECK_WEDGE), part < 1.0 ? 0 : bit(ENTS_CHECK_WEDGE)) << part;
    EXPECT_EQ(r.violated, part < 1.0 ? 0 : part > 1.1 ? crossing : r.violated & crossing) << part;
    EXPECT_EQ(r.value[ENTS_CHECK_JUMP], 0.0);
  }
}

// Any two segments, not only neighbours: a bump on one of two plates that reaches through the other.
TEST(SurfaceAdmissibility, PanelDFarSegmentsCross) {
  MeshSurface profile = polyline({0.0, 0.0, 1.0, 0.0, 2.0, 0.0, 2.0, 0.2, 1.0, 0.2, 0.0, 0.2});
  profile.connectivity = {0, 1, 1, 2, 3, 4, 4, 5};
  MeshSurface surface = profile;
  surface.surface_coordinates = {0.0, 1.0, 1.0, 2.0,
                                 5.0, 6.0, 6.0, 7.0}; // the bump is on the lower plate alone
  for (const double amplitude : {0.19, 0.23}) {
    const json bump = {{"type", "gaussian"}, {"amplitude", amplitude}, {"center", {1.4375}}, {"width", 0.1}};
    const Checked r = check(model("line2", bump), surface, 0.0, 257);
    const bool through = amplitude > 0.2;
    EXPECT_EQ(r.violated, through ? bit(ENTS_CHECK_CROSSING) : 0) << amplitude;
    if (!through) continue;
    EXPECT_NEAR(r.value[ENTS_CHECK_CROSSING], amplitude - 0.2, 1e-12); // its top is a sample
    EXPECT_EQ(r.segment[ENTS_CHECK_CROSSING], 1);
    EXPECT_EQ(r.other[ENTS_CHECK_CROSSING], 2);
    EXPECT_EQ(r.marks, (std::vector<std::int64_t>{0, r.violated, r.violated, 0}));
    EXPECT_NEAR(r.point[ENTS_CHECK_CROSSING][0], 1.4375, 1e-12);
  }
}

// C2 is enough, also with friction, though its exact tangent jumps then: a height map is a cubic spline.
TEST(SurfaceAdmissibility, ContinuityWithFriction) {
  const json map = {
      {"type", "map"}, {"values", {0.0, 0.01, 0.03, 0.02}}, {"size", {4.0}}, {"boundary", "periodic"}};
  const json normal = {{"type", "penalty"}, {"stiffness", 1.0}};
  const json friction = {{"type", "coulomb"}, {"coefficient", 0.3}, {"stiffness", 1.0}};
  const MeshSurface surface = strip(2, 2.0);
  for (const json& contact : {json{{"normal", normal}}, json{{"normal", normal}, {"friction", friction}}}) {
    const Checked of_map = check(model("line2", map, {{"contact", contact}}), surface);
    EXPECT_EQ(of_map.value[ENTS_CHECK_CONTINUITY], 2.0);
    EXPECT_EQ(of_map.bound[ENTS_CHECK_CONTINUITY], 2.0);
    EXPECT_EQ(of_map.violated, 0);
    EXPECT_EQ(
        check(model("line2", waves(0.01, 1.0), {{"contact", contact}}), surface).value[ENTS_CHECK_CONTINUITY],
        1000.0);
  }
}

// Random textures on distorted surfaces of all bases that are not smoothed, far below the bounds of single
// segments: only their neighbours are torn, or overlap, by the height on the edge times the angle between
// them.
TEST(SurfaceAdmissibility, RandomSurfacesBelowEveryBound) {
  Random random(4);
  for (const Basis& basis : bases()) {
    if (basis.family == Family::catmull_rom || basis.family == Family::bspline) continue;
    for (int repeat = 0; repeat < 5; ++repeat) {
      MeshSurface surface = draw_mesh(random, basis, 3, 0.02);
      json height = {{"type", "sine"}, {"amplitude", 0.01}, {"wave_vector", {0.2}}};
      if (basis.dimension == 3) height["wave_vector"] = {0.2, -0.15};
      const Model m = model(basis.name, height);
      const Checked c = check(m, surface, 0.1);
      EXPECT_EQ(c.violated & ~(bit(ENTS_CHECK_JUMP) | bit(ENTS_CHECK_CROSSING)), 0) << basis.name;
      EXPECT_LT(c.value[ENTS_CHECK_JUMP], 0.01 * c.value[ENTS_CHECK_KINK] * 1.5 + 1e-12) << basis.name;
      EXPECT_LT(c.value[ENTS_CHECK_CROSSING], 0.01 * c.value[ENTS_CHECK_KINK] * 1.5 + 1e-12) << basis.name;
      EXPECT_LT(c.value[ENTS_CHECK_KINK], 0.4);
    }
  }
}

} // namespace
} // namespace mechanics
