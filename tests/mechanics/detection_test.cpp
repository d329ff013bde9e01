// Detection on whole surfaces: against a dense sweep of all segments, on textures with many candidates.
// ENTS_TEST_SEED=n draws other surfaces.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "mesh_surface.hpp"
#include "ray_casting.hpp"
#include "samples.hpp"
#include "sweep.hpp"

namespace mechanics::detection_test {
namespace {

constexpr double reach = 0.5;

std::uint64_t seed() {
  const char* text = std::getenv("ENTS_TEST_SEED");
  return text ? static_cast<std::uint64_t>(std::atoll(text)) : 0;
}

nlohmann::json model_of(const Basis& basis, const nlohmann::json& height,
                        const nlohmann::json& more = nlohmann::json::object()) {
  nlohmann::json model{{"segment", basis.name}, {"height", height}};
  model.update(more);
  return model;
}

// Points of a surface, sampled once for many slaves.
class Samples {
public:
  Samples(const MeshSurface& mesh, const Height& height)
      : grid_(*mesh.basis, mesh.basis->dimension == 2 ? 401 : 41) {
    masters_.reserve(static_cast<std::size_t>(mesh.segments()));
    for (std::int64_t s = 0; s < mesh.segments(); ++s) {
      masters_.push_back(mesh.master(s));
      surfaces_.emplace_back(*mesh.basis, height, masters_.back().data(), mesh.coordinates(s));
      for (std::size_t k = 0; k < grid_.xi.size(); ++k)
        if (grid_.inside[k])
          points_.push_back({surfaces_.back().at(grid_.xi[k].data(), grid_.shape[k]).point, s});
    }
  }
  const Surface& surface(std::int64_t segment) const { return surfaces_[static_cast<std::size_t>(segment)]; }

  // The gaps of all points of the surface on the ray.
  std::vector<double> gaps(const Basis& basis, const Vec3& slave, const Vec3& ray) const {
    const RayCasting casting(grid_, basis);
    std::vector<double> all;
    for (const Surface& surface : surfaces_)
      for (const double gap : casting.gaps(surface, slave, ray)) all.push_back(gap);
    std::sort(all.begin(), all.end());
    return all;
  }

  struct Closest {
    Minimum at;
    std::int64_t segment = -1;
  };
  // Each segment with a sample about as close as the closest one is swept.
  Closest closest(const Basis& basis, const Vec3& slave) const {
    std::vector<double> best(surfaces_.size(), 1e300);
    double least = 1e300;
    for (const auto& [point, segment] : points_) {
      const Vec3 d = slave - point;
      const double square = dot(d, d);
      best[static_cast<std::size_t>(segment)] = std::min(best[static_cast<std::size_t>(segment)], square);
      least = std::min(least, square);
    }
    Closest out;
    const double margin = 2.0 * grid_.spacing(); // between a sample and the surface: slopes are below 2
    for (std::size_t s = 0; s < surfaces_.size(); ++s)
      if (std::sqrt(best[s]) < std::sqrt(least) + margin) {
        const Minimum m = sweep_minima(grid_, basis, surfaces_[s], slave, 4).front();
        if (m.distance < out.at.distance) out = {m, static_cast<std::int64_t>(s)};
      }
    return out;
  }

private:
  struct Point {
    Vec3 point;
    std::int64_t segment;
  };
  Grid grid_;
  std::vector<std::vector<double>> masters_;
  std::vector<Surface> surfaces_;
  std::vector<Point> points_;
};

// Slaves over random points of the surface.
std::vector<double> draw_slaves(Random& random, const MeshSurface& mesh, const Samples& samples,
                                std::int64_t count) {
  std::vector<double> out;
  const int d = mesh.basis->dimension;
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t segment = random.below(static_cast<int>(mesh.segments()));
    std::array<double, 2> xi = {random.uniform(-1.0, 1.0), d == 3 ? random.uniform(-1.0, 1.0) : 0.0};
    if (mesh.basis->simplex) {
      xi = {0.5 + 0.5 * xi[0], 0.5 + 0.5 * xi[1]};
      if (xi[0] + xi[1] > 1.0) xi = {1.0 - xi[0], 1.0 - xi[1]};
    }
    const Surface::Point p = samples.surface(segment).at(xi.data());
    const Vec3 x = p.point + random.uniform(-0.2, 0.4) * p.normal;
    for (int k = 0; k < d; ++k) out.push_back(x[static_cast<std::size_t>(k)]);
  }
  return out;
}

class Detection : public testing::TestWithParam<std::string> {
protected:
  // The segments' size is 2, the sweep knows distances to 1e-12.
  static constexpr double tolerance = 1e-10;
};

TEST_P(Detection, FindsTheClosestPointOfTheSurface) {
  const Basis& basis = basis_named(GetParam());
  const int d = basis.dimension, t = basis.parameters();
  const std::int64_t per_surface = samples(100), surfaces = samples(d == 2 ? 60 : 12);
  Random random(71 + 1000 * seed());
  Worst farther, off;
  std::int64_t compared = 0, on_border = 0, flagged = 0, missed = 0, missed_by_sweep = 0, beyond_reach = 0;
  for (std::int64_t number = 0; number < surfaces; ++number) {
    const MeshSurface mesh = draw_mesh(random, basis, d == 2 ? 8 : 3, 0.1);
    nlohmann::json texture = draw_texture(random, t);
    while (texture.dump().find("polynomial") != std::string::npos)
      texture = draw_texture(random, t); // no bounds
    const Model model(model_of(basis, texture).dump());
    const Height height(texture, t);
    const Samples sampled(mesh, height);
    Detector detector(model, mesh);
    Detector::Found found;
    const std::vector<double> slaves = draw_slaves(random, mesh, sampled, per_surface);
    detector.detect(slaves, reach, found);
    for (std::int64_t e = 0; e < per_surface; ++e) {
      const std::size_t i = static_cast<std::size_t>(e);
      const Vec3 slave = vec3(slaves.data() + e * d, d);
      const Samples::Closest closest = sampled.closest(basis, slave);
      const auto where = [&] { return basis.name + " " + texture.dump() + " slave " + std::to_string(e); };
      EXPECT_TRUE(found.flags[i] & ENTS_FLAG_SEARCHED);
      const bool ambiguous = found.flags[i] & ENTS_FLAG_AMBIGUOUS;
      flagged += ambiguous;
      if (found.segment[i] >= 0) {
        const std::array<double, 2> xi = {found.xi[i * static_cast<std::size_t>(t)],
                                          t == 2 ? found.xi[i * static_cast<std::size_t>(t) + 1] : 0.0};
        const double distance = norm(slave - sampled.surface(found.segment[i]).at(xi.data()).point);
        off.see(std::fabs(distance - std::fabs(found.gap[i])), where);
        missed_by_sweep += distance < closest.at.distance - tolerance;
        if (is_on_border(basis, closest.at.xi)) { // no projection there: another one may be the answer
          ++on_border;
          continue;
        }
        ++compared;
        if (!ambiguous) farther.see(distance - closest.at.distance, where);
      } else if (is_on_border(basis, closest.at.xi)) {
        ++on_border;
      } else if (closest.at.distance > reach) {
        ++beyond_reach;
      } else {
        ++compared;
        if (!ambiguous && ++missed <= 3) ADD_FAILURE() << "missed " << closest.at.distance << ": " << where();
      }
    }
  }
  EXPECT_LE(farther.error, tolerance) << farther.where;
  EXPECT_LE(off.error, tolerance) << off.where;
  EXPECT_EQ(missed, 0);
  EXPECT_LE(flagged, compared / 100);
  EXPECT_GT(compared, 2 * on_border);
  std::cout << basis.name << ": " << compared << " compared, farther than the sweep by at most "
            << farther.error << "; " << missed << " missed (" << missed_by_sweep << " by the sweep), "
            << flagged << " flagged, " << on_border << " next to an edge, " << beyond_reach
            << " beyond reach\n";
}

// Shadow projection: the first point of the whole surface that the light meets.
TEST_P(Detection, FindsTheLitPointOfTheSurface) {
  const Basis& basis = basis_named(GetParam());
  const int d = basis.dimension, t = basis.parameters();
  const std::int64_t per_surface = samples(d == 2 ? 100 : 30), surfaces = samples(d == 2 ? 20 : 6);
  Random random(73 + 1000 * seed());
  Worst behind, off_ray;
  std::int64_t compared = 0, several = 0, flagged = 0, missed = 0, missed_by_casting = 0;
  for (std::int64_t number = 0; number < surfaces; ++number) {
    const MeshSurface mesh = draw_mesh(random, basis, d == 2 ? 8 : 3, 0.1);
    nlohmann::json texture = draw_texture(random, t);
    while (texture.dump().find("polynomial") != std::string::npos)
      texture = draw_texture(random, t); // no bounds
    const bool emitter = number % 2 == 0;
    const double high = number % 3 == 0 ? 1.0 : 0.25; // low light: waves cast shadows on each other
    const Vec3 light = d == 2 ? Vec3{random.uniform(-1.5, 1.5), high, 0.0}
                              : Vec3{random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), high};
    const Vec3 at = 12.0 * light + Vec3{d == 2 ? 8.0 : 3.0, d == 2 ? 0.0 : 3.0, 0.0};
    std::vector<double> numbers(emitter ? at.begin() : light.begin(),
                                (emitter ? at.begin() : light.begin()) + d);
    const Model model(model_of(basis, texture,
                               {{"projection",
                                 {{"type", emitter ? "shadow_point" : "shadow_direction"},
                                  {emitter ? "emitter" : "direction", numbers}}}})
                          .dump());
    const Height height(texture, t);
    const Samples sampled(mesh, height);
    Detector detector(model, mesh);
    Detector::Found found;
    const std::vector<double> slaves = draw_slaves(random, mesh, sampled, per_surface);
    constexpr double far = 10.0; // so that the lit point is within reach
    detector.detect(slaves, far, found);
    for (std::int64_t e = 0; e < per_surface; ++e) {
      const std::size_t i = static_cast<std::size_t>(e);
      const Vec3 slave = vec3(slaves.data() + e * d, d);
      const Vec3 towards = emitter ? at - slave : light, ray = (1.0 / norm(towards)) * towards;
      const std::vector<double> gaps = sampled.gaps(basis, slave, ray);
      const auto where = [&] { return basis.name + " " + texture.dump() + " slave " + std::to_string(e); };
      const bool ambiguous = found.flags[i] & ENTS_FLAG_AMBIGUOUS;
      flagged += ambiguous;
      if (gaps.empty() || gaps.front() < -far) continue;
      ++compared;
      several += gaps.back() > gaps.front() + 1e-6;
      if (found.segment[i] < 0) {
        if (!ambiguous && ++missed <= 3) ADD_FAILURE() << "missed " << gaps.front() << ": " << where();
        continue;
      }
      const double* xi = found.xi.data() + e * t;
      const std::array<double, 2> natural = {xi[0], t == 2 ? xi[1] : 0.0};
      const Vec3 offset = slave - sampled.surface(found.segment[i]).at(natural.data()).point;
      off_ray.see(norm(offset - found.gap[i] * ray), where);
      missed_by_casting += found.gap[i] < gaps.front() - tolerance;
      if (!ambiguous) behind.see(found.gap[i] - gaps.front(), where);
    }
  }
  EXPECT_LE(behind.error, tolerance) << behind.where;
  EXPECT_LE(off_ray.error, tolerance) << off_ray.where;
  EXPECT_EQ(missed, 0);
  EXPECT_LE(flagged, compared / 100 + 1);
  EXPECT_GT(compared, per_surface * surfaces / 2);
  std::cout << basis.name << ": " << compared << " rays, " << several
            << " with several points, behind the casting's by at most " << behind.error << "; " << missed
            << " missed (" << missed_by_casting << " by the casting), " << flagged << " flagged\n";
}

INSTANTIATE_TEST_SUITE_P(Basis, Detection, testing::ValuesIn(basis_names()),
                         [](const auto& parameter) { return parameter.param; });

// Straight segments in the plane.
MeshSurface lines(std::vector<double> positions, std::vector<std::int64_t> connectivity) {
  MeshSurface mesh;
  mesh.basis = &basis_named("line2");
  mesh.positions = std::move(positions);
  mesh.connectivity = std::move(connectivity);
  return mesh;
}
const std::vector<double> two_walls = {0, 0, 4, 0, 4, 1, 0, 1}; // one over the other, facing each other

// Once found, a projection is followed: its own branch is kept while it exists, although another point has
// come closer.
TEST(DetectionFollows, TheBranchItIsOn) {
  const MeshSurface mesh = lines(two_walls, {0, 1, 2, 3});
  const Model model(R"({"segment": "line2"})");
  Detector detector(model, mesh);
  Detector::Found found;
  detector.detect({1.0, 0.4}, 2.0, found);
  EXPECT_EQ(found.segment[0], 0);
  EXPECT_DOUBLE_EQ(found.gap[0], 0.4);
  EXPECT_EQ(found.flags[0], ENTS_FLAG_SEARCHED);
  detector.detect({1.0, 0.7}, 2.0, found); // the upper wall is closer now
  EXPECT_EQ(found.segment[0], 0);
  EXPECT_EQ(found.flags[0], 0);
  found.segment[0] = -1;
  detector.detect({1.0, 0.7}, 2.0, found);
  EXPECT_EQ(found.segment[0], 1);
  EXPECT_DOUBLE_EQ(found.gap[0], 0.3);
  found.segment[0] = 0;
  detector.detect({1.0, 0.7}, 0.5, found); // out of reach of its own: searched
  EXPECT_EQ(found.segment[0], 1);
}

TEST(DetectionTies, AreFlaggedAndNamed) {
  const MeshSurface mesh = lines(two_walls, {0, 1, 2, 3});
  const Model model(R"({"segment": "line2"})");
  Detector detector(model, mesh);
  Detector::Found found;
  detector.detect({1.0, 0.5}, 2.0, found);
  EXPECT_EQ(found.segment[0], 0);
  EXPECT_EQ(found.other[0], 1);
  EXPECT_EQ(found.flags[0], ENTS_FLAG_SEARCHED | ENTS_FLAG_AMBIGUOUS);
}

// On a common node or edge two segments give the same point: no tie, and the one with the smaller number.
TEST(DetectionTies, ACommonNodeIsNone) {
  const MeshSurface mesh = lines({0, 0, 1, 0, 2, 0}, {1, 2, 0, 1});
  const Model model(R"({"segment": "line2"})");
  Detector detector(model, mesh);
  Detector::Found found;
  detector.detect({1.0, 0.25}, 2.0, found);
  EXPECT_EQ(found.segment[0], 0);
  EXPECT_EQ(found.other[0], -1);
  EXPECT_EQ(found.flags[0], ENTS_FLAG_SEARCHED);
}

// Over a valley, below its bottom, no segment has a projection: with a border one has, without it the node
// slips through.
TEST(DetectionBorder, ClosesTheWedgeOfAValley) {
  const double slope =
      std::tan(10.0 * std::acos(-1.0) / 180.0); // a valley of 2 x 10 degrees; the slave comes from above
  const MeshSurface mesh = lines({-1, slope, 0, 0, 1, slope}, {0, 1, 1, 2});
  const std::vector<double> below = {0.0, -0.01};
  Detector::Found found;
  const Model without(R"({"segment": "line2"})");
  Detector(without, mesh).detect(below, 0.1, found);
  EXPECT_EQ(found.segment[0], -1);
  const Model with(R"({"segment": "line2", "border": 0.01})");
  Detector(with, mesh).detect(below, 0.1, found);
  EXPECT_EQ(found.segment[0], 0); // both are equally good, and their points next to each other: one of them
  EXPECT_NEAR(found.gap[0], -0.01 * std::cos(std::atan(slope)), 1e-15);
  EXPECT_GT(found.xi[0], 1.0);
  EXPECT_LT(found.xi[0], 1.01);
  // where a segment has the node for itself it has it, border or not
  Detector::Found beside;
  Detector(with, mesh).detect({0.3, 0.0}, 0.2, beside);
  EXPECT_EQ(beside.segment[0], 1);
}

// After a motion that keeps neighbours neighbours, a refit finds what a new tree finds.
TEST(DetectionRefit, FindsWhatANewTreeFinds) {
  for (const char* name : {"bspline4", "tri3", "quad9"}) {
    const Basis& basis = basis_named(name);
    const int d = basis.dimension;
    Random random(72);
    MeshSurface mesh = draw_mesh(random, basis, d == 2 ? 40 : 7, 0.1);
    const nlohmann::json texture = draw_height(random, "sine", basis.parameters());
    const Model model(model_of(basis, texture).dump());
    Detector refitted(model, mesh);
    for (int step = 0; step < 3; ++step) {
      for (std::size_t i = 0; i < mesh.positions.size(); i += static_cast<std::size_t>(d)) { // bend and turn
        const double x = mesh.positions[i];
        mesh.positions[i] =
            std::cos(0.3) * x - std::sin(0.3) * mesh.positions[i + static_cast<std::size_t>(d) - 1];
        mesh.positions[i + static_cast<std::size_t>(d) - 1] += std::sin(0.3) * x + 0.01 * x * x;
      }
      refitted.refit();
      Detector made_new(model, mesh);
      const Height height(texture, basis.parameters());
      const Samples sampled(mesh, height);
      const std::vector<double> slaves = draw_slaves(random, mesh, sampled, samples(200));
      Detector::Found a, b;
      refitted.detect(slaves, reach, a);
      made_new.detect(slaves, reach, b);
      EXPECT_EQ(a.segment, b.segment) << name;
      EXPECT_EQ(a.xi, b.xi) << name;
      EXPECT_GT(std::count_if(a.segment.begin(), a.segment.end(), [](std::int64_t s) { return s >= 0; }),
                static_cast<std::ptrdiff_t>(a.segment.size() / 2));
    }
  }
}

} // namespace
} // namespace mechanics::detection_test
