// ents_model_check against what goes wrong in the four panels of Fig. 4 of the paper: each number is compared
// with its exact value, and each limit with the surface itself on both sides of it. The intersection of
// neighbouring segments (panel d, second case) takes two segments; ents_model_check sees one.
#include <gtest/gtest.h>

#include "checked_surface.hpp"
#include "ray_casting.hpp"

namespace mechanics::admissibility_test {
namespace {

Model projected_model(const std::string& segment, const json& height,
                      const json& projection = {{"type", "normal"}}) {
  return Model(json{
      {"segment", segment},
      {"height", height},
      {"projection", projection},
      {"contact", {{"normal", {{"type", "penalty"}, {"stiffness", 1.0}}}}},
      {"penetration_limit",
       10.0}}.dump());
}

const std::vector<double> straight_line = {-1.0, 0.0, 1.0, 0.0};
const std::vector<double> square = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};

// Panel a: within the reach of rho_e, its smallest radius of curvature, there is one normal projection;
// beyond, several.
TEST(Admissibility, BeyondTheReachThereAreSeveralProjections) {
  const double amplitude = 0.05, k = 2.0 * pi * 1.0;
  const json height = waves(amplitude, 1.0);
  const Model m = projected_model("line2", height);
  // 801 points: crests and valleys, at odd multiples of 1/4, are among them
  const ents_admissibility a = check_admissibility(m, straight_line, {}, 801);
  const double radius = 1.0 / (amplitude * k * k);
  EXPECT_NEAR(a.reach, radius, rounding * radius);
  EXPECT_NEAR(std::fabs(std::fmod(a.reach_xi[0] + 2.0, 0.5)), 0.25, 1e-12);
  EXPECT_EQ(a.samples, 801);
  EXPECT_EQ(a.continuity, 1000);

  // from the crest at x = 1/4 down into the body: its centre of curvature lies at the depth `radius`
  const Basis& basis = basis_named("line2");
  const Grid grid(basis, 2001);
  const Height oracle(height, 1);
  const Surface surface(basis, oracle, straight_line.data(), nullptr);
  for (const double depth : {0.8 * radius, 0.99 * radius, 1.01 * radius, 1.3 * radius}) {
    Elements e;
    e.count = 1;
    e.master = straight_line;
    e.slave = {0.25, amplitude - depth};
    const std::vector<Minimum> minima = sweep_minima(grid, basis, surface, vec3(e.slave.data(), 2), 9);
    std::size_t near = 0; // of this crest
    for (const Minimum& minimum : minima) near += minimum.distance < minima[0].distance + 1e-6;
    EXPECT_EQ(near, depth < radius ? 1u : 2u) << depth / radius;
    const Results searched = m.evaluate(e, ENTS_RESIDUAL | ENTS_GAP | ENTS_FLAGS);
    EXPECT_EQ(searched.status, depth < radius ? ENTS_OK : ENTS_AMBIGUOUS_PROJECTION) << depth / radius;
    e.start = {0.25};
    const Results from_crest = m.evaluate(e, ENTS_RESIDUAL | ENTS_GAP | ENTS_FLAGS);
    EXPECT_EQ(from_crest.status, depth < radius ? ENTS_OK : ENTS_SINGULAR_PROJECTION) << depth / radius;
  }
}

// The same number in 3D: the top of a bump, radius width^2 / amplitude
TEST(Admissibility, ReachOfABump) {
  const double amplitude = 0.1, width = 0.5;
  const json bump = {
      {"type", "gaussian"}, {"amplitude", amplitude}, {"center", {0.25, -0.5}}, {"width", width}};
  const ents_admissibility a =
      check_admissibility(projected_model("quad4", bump), square, {}, 41); // step 1/20: the top is a sample
  EXPECT_NEAR(a.reach, width * width / amplitude, rounding);
  EXPECT_NEAR(a.reach_xi[0], 0.25, 1e-12);
  EXPECT_NEAR(a.reach_xi[1], -0.5, 1e-12);
  EXPECT_NEAR(a.height_max, amplitude, 1e-15);
  EXPECT_EQ(a.fold, 0.0);
  EXPECT_EQ(a.shadow, 1.0);
}

// Panel b: where n_e . e <= 0 the surface stands in its own shadow: rays meet it more than once.
TEST(Admissibility, SelfShadowMeansSeveralIntersections) {
  const double amplitude = 0.08, slope = amplitude * 2.0 * pi;
  const json height = waves(amplitude, 1.0);
  const Basis& basis = basis_named("line2");
  const Grid grid(basis, 2001);
  const RayCasting casting(grid, basis);
  const Height oracle(height, 1);
  const Surface surface(basis, oracle, straight_line.data(), nullptr);
  const double limit = std::atan(1.0 / slope); // the ray parallel to the steepest flank
  for (const double angle : {0.0, 0.5 * limit, 0.99 * limit, 1.01 * limit, 1.2 * limit}) {
    const Vec3 ray = {std::sin(angle), std::cos(angle), 0.0};
    const Model m =
        projected_model("line2", height, {{"type", "shadow_direction"}, {"direction", {ray[0], ray[1]}}});
    const ents_admissibility a = check_admissibility(m, straight_line, {}, 801);
    const double exact = (std::cos(angle) - slope * std::sin(angle)) / std::sqrt(1.0 + slope * slope);
    // at angle 0 both flanks are equally steep
    EXPECT_NEAR(a.shadow, exact, rounding);
    std::size_t most = 0;
    for (int i = 0; i <= 1000; ++i) { // slave nodes under the middle wave
      const Vec3 slave = {-0.5 + 1e-3 * i, -0.1, 0.0};
      most = std::max(most, casting.gaps(surface, slave, ray).size());
    }
    EXPECT_EQ(most, angle < limit ? 1u : 3u) << angle / limit;
  }
}

TEST(Admissibility, ShadowOfAnEmitterIsTheSmallestCosine) {
  const Vec3 emitter = {0.3, 2.0, 0.0};
  const json height = waves(0.08, 1.5);
  const Model m =
      projected_model("line2", height, {{"type", "shadow_point"}, {"emitter", {emitter[0], emitter[1]}}});
  const ents_admissibility a = check_admissibility(m, straight_line, {}, 501);
  std::vector<double> xi;
  for (int i = 0; i <= 500; ++i) xi.push_back(2.0 * (i / 500.0) - 1.0);
  const SurfacePoints p = evaluate_surface(m, straight_line.data(), nullptr, xi);
  double smallest = 2.0, at = 0.0;
  for (std::size_t i = 0; i < xi.size(); ++i) {
    const Vec3 towards = emitter - vec3(&p.point[2 * i], 2);
    const double cosine = dot(towards, vec3(&p.normal[2 * i], 2)) / norm(towards);
    if (cosine < smallest) {
      smallest = cosine;
      at = xi[i];
    }
  }
  EXPECT_NEAR(a.shadow, smallest, rounding);
  EXPECT_EQ(a.shadow_xi[0], at);
}

// Panel c: a local enrichment (s = xi) that does not vanish on the edges tears the surface open where
// segments meet at an angle.
TEST(Admissibility, HeightOnTheEdgeIsAJumpBetweenSegments) {
  for (const double edge : {0.0, 0.03}) {
    const json height = {{"type", "polynomial"},
                         {"coefficients", {0.1 + edge, 0.0, -0.1}}}; // 0.1 (1 - s^2) + edge
    const Model m = projected_model("line2", height);
    const double angle = 0.4;
    const std::vector<double> left = {-2.0, 0.0, 0.0, 0.0},
                              right = {0.0, 0.0, 2.0 * std::cos(angle), 2.0 * std::sin(angle)};
    EXPECT_NEAR(check_admissibility(m, left, {}, 0).edge_height, edge, 1e-16);
    const SurfacePoints end = evaluate_surface(m, left.data(), nullptr, {1.0}),
                        begin = evaluate_surface(m, right.data(), nullptr, {-1.0});
    const double jump = norm(vec3(end.point.data(), 2) - vec3(begin.point.data(), 2));
    EXPECT_NEAR(jump, edge * 2.0 * std::sin(0.5 * angle), 1e-15);
  }
}

TEST(Admissibility, EdgeHeightOfQuadranglesAndTriangles) {
  const auto polynomial = [](const json& c) { return json{{"type", "polynomial"}, {"coefficients", c}}; };
  // (1 - s1^2)(1 - s2^2) and s1 s2 (1 - s1 - s2): zero on every edge, not inside
  const json on_square = polynomial({{1.0, 0.0, -1.0}, {0.0}, {-1.0, 0.0, 1.0}});
  const json on_triangle = polynomial({{0.0}, {0.0, 1.0, -1.0}, {0.0, -1.0}});
  EXPECT_EQ(check_admissibility(projected_model("quad4", on_square), square, {}, 33).edge_height, 0.0);
  const std::vector<double> triangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const ents_admissibility t = check_admissibility(projected_model("tri3", on_triangle), triangle, {}, 31);
  EXPECT_LE(t.edge_height, 1e-16);
  EXPECT_NEAR(t.height_max, 1.0 / 27.0, 1e-15); // at the centre, a sample
  // the plane s1: largest on the far corner or edge
  const json plane = polynomial({{0.0}, {0.3}});
  const ents_admissibility q = check_admissibility(projected_model("quad4", plane), square, {}, 9);
  EXPECT_NEAR(q.edge_height, 0.3, 1e-16);
  EXPECT_EQ(std::fabs(q.edge_height_xi[0]), 1.0);
  EXPECT_NEAR(check_admissibility(projected_model("tri3", plane), triangle, {}, 9).edge_height, 0.3, 1e-16);
}

// Panel d: |h| kappa >= 1 folds rho_e over itself. A parabola y = c (1 - x^2): kappa = 2 c at its top, centre
// of curvature below.
TEST(Admissibility, AFoldedSurfaceRunsBackwards) {
  const double c = 0.4;
  const std::vector<double> parabola = {-1.0, 0.0, 1.0, 0.0, 0.0, c};
  for (const double part : {0.5, 0.99, 1.01, 1.5}) { // of the radius of curvature
    const double height = -part / (2.0 * c);
    const Model m = projected_model("line3", {{"type", "constant"}, {"value", height}});
    const ents_admissibility a = check_admissibility(m, parabola, {}, 101);
    EXPECT_NEAR(a.fold, part, rounding);
    EXPECT_NEAR(a.fold_xi[0], 0.0, 1e-15);
    const SurfacePoints p = evaluate_surface(m, parabola.data(), nullptr, {-1e-3, 1e-3});
    EXPECT_EQ(p.point[2] > p.point[0], part < 1.0) << part;
    // an offset curve has the radius of the curve plus the offset
    if (part < 1.0) {
      EXPECT_NEAR(a.reach, (1.0 - part) / (2.0 * c), 1e-10);
    }
  }
  // without a height, and on a flat segment, nothing folds
  EXPECT_EQ(check_admissibility(projected_model("line3", nullptr), parabola, {}, 101).fold, 0.0);
  EXPECT_EQ(check_admissibility(projected_model("line2", {{"type", "constant"}, {"value", 5.0}}),
                                straight_line, {}, 101)
                .fold,
            0.0);
}

// A segment without a normal of its own is degenerate, and no height can mend that; nor is it the height's
// fault.
TEST(Admissibility, ADegenerateSegmentIsNoFold) {
  const std::vector<double> point = {1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3},
                            bow_tie = {-1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0};
  for (const json& height : {json(), waves(0.1, 0.5)}) {
    json sheet = height;
    if (!sheet.is_null()) sheet["wave_vector"] = {0.5, 0.5};
    const Model m = projected_model("quad4", sheet);
    for (const auto& nodes : {point, bow_tie}) {
      ents_admissibility result{};
      result.struct_size = sizeof result;
      EXPECT_EQ(ents_model_check(m.handle(), nodes.data(), nullptr, &result, nullptr),
                ENTS_DEGENERATE_SEGMENT)
          << sheet;
    }
  }
}

// samples = 0: as fine as the height asks for. On 40 waves, the reach is found within the error of four
// samples per feature (a quarter of a wave): a crest is missed by at most 1/32 of a wave, where the curvature
// is down by 1 - cos(2 pi / 32) = 2 %, and the slope adds 1.5 h'^2 = 4 %.
TEST(Admissibility, SamplesFollowTheHeight) {
  const double amplitude = 1e-3, waves_per_unit = 20.3;
  const double k = 2.0 * pi * waves_per_unit, radius = 1.0 / (amplitude * k * k);
  const ents_admissibility a =
      check_admissibility(projected_model("line2", waves(amplitude, waves_per_unit)), straight_line, {}, 0);
  EXPECT_GE(a.samples, 40 * 16);
  EXPECT_GE(a.reach, radius * (1.0 - rounding));
  EXPECT_LE(a.reach, radius * 1.06);
  // surface coordinates stretch the texture: with s = 0.5 xi half the waves, half the samples
  const ents_admissibility b = check_admissibility(projected_model("line2", waves(amplitude, waves_per_unit)),
                                                   straight_line, {-0.5, 0.5}, 0);
  EXPECT_NEAR(b.samples, 0.5 * a.samples, 2.0);
  EXPECT_NEAR(b.reach, 4.0 * radius, 0.06 * 4.0 * radius);
}

} // namespace
} // namespace mechanics::admissibility_test
