// SPDX-License-Identifier: BSD-3-Clause
// Closed surfaces that touch themselves: spirals, whose turns are pressed into each other, in the plane and in
// space. Every point of the surface is a slave, and has one right answer: it lies in another turn, and how deep,
// or in none. The reference looks at all facets: the point just outside the surface is inside the body where the
// body overlaps (the parity of the facets that a ray goes through), and the depth is the distance from the nearest
// facet of another turn that looks against it.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "flat_facets.hpp"
#include "mesh_surface.hpp"
#include "samples.hpp"

namespace mechanics::self_contact_test {
namespace {

constexpr double pi = 3.14159265358979323846;

// A strip that is wound up by more than a turn. Its flanks have nodes of their own.
struct Spiral {
  MeshSurface mesh;
  std::vector<double> turn; // [facets] angle
  double thickness, wave, phase;
  int waves;
  std::vector<std::array<double, 3>> place; // [nodes] angle, across (-1 or 1), height

  // Positions for a distance of the turns; the waves make it smaller and larger.
  void wind(double pitch, double amplitude) {
    const int d = mesh.basis->dimension;
    for (std::size_t i = 0; i < place.size(); ++i) {
      const auto& [angle, across, height] = place[i];
      // of the outer turn alone, else both move together
      const double outer = angle > 2.0 * pi ? amplitude * std::cos(waves * angle + phase) : 0.0;
      const double r = 1.0 + pitch * angle / (2.0 * pi) + outer + 0.5 * across * thickness;
      double* x = mesh.positions.data() + i * static_cast<std::size_t>(d);
      x[0] = r * std::cos(angle), x[1] = r * std::sin(angle);
      if (d == 3) x[2] = height;
    }
  }
  std::vector<std::vector<Point>> facets() const {
    std::vector<std::vector<Point>> out;
    const auto d = static_cast<std::size_t>(mesh.basis->dimension);
    for (std::int64_t s = 0; s < mesh.segments(); ++s) {
      const std::vector<double> nodes = mesh.master(s);
      out.emplace_back();
      for (std::size_t i = 0; i < nodes.size(); i += d)
        out.back().push_back({nodes[i], nodes[i + 1], d == 3 ? nodes[i + 2] : 0.0});
    }
    return out;
  }
};

// Angles from 0 to `last`, in steps of random lengths.
std::vector<double> angles(Random& random, double last, double step) {
  std::vector<double> out = {0.0};
  while (out.back() < last - 0.6 * step) out.push_back(out.back() + step * random.uniform(0.6, 1.4));
  for (double& angle : out) angle *= last / out.back();
  return out;
}

Spiral draw_spiral(Random& random, const char* basis) {
  Spiral out;
  out.mesh.basis = &basis_named(basis);
  const bool plane = out.mesh.basis->dimension == 2;
  out.thickness = random.uniform(0.05, 0.3);
  out.waves = 1 + random.below(4), out.phase = random.uniform(0.0, 2.0 * pi);
  const double last = 2.0 * pi + random.uniform(1.0, 4.0), step = random.uniform(0.08, 0.25);
  // In space both flanks have the same angles, since the faces at both ends of the height join them.
  const std::vector<double> inner = angles(random, last, step),
                            outer = plane ? angles(random, last, step) : inner;
  const int levels = plane ? 1 : 2 + random.below(3);
  const auto node = [&](bool outside, std::size_t k, int level) {
    return static_cast<std::int64_t>((outside ? inner.size() : 0) + k) +
           static_cast<std::int64_t>(inner.size() + outer.size()) * level;
  };
  for (int level = 0; level < levels; ++level) {
    for (const double angle : inner) out.place.push_back({angle, -1.0, 0.4 * level});
    for (const double angle : outer) out.place.push_back({angle, 1.0, 0.4 * level});
  }
  out.mesh.positions.resize(out.place.size() * (plane ? 2 : 3));
  const bool triangles = out.mesh.basis->simplex;
  const auto add = [&](std::vector<std::int64_t> of) {
    double angle = 0.0;
    for (const std::int64_t i : of)
      angle += out.place[static_cast<std::size_t>(i)][0] / static_cast<double>(of.size());
    const std::vector<std::vector<std::int64_t>> parts =
        triangles ? std::vector<std::vector<std::int64_t>>{{of[0], of[1], of[2]}, {of[0], of[2], of[3]}}
                  : std::vector<std::vector<std::int64_t>>{of};
    for (const auto& part : parts) {
      out.mesh.connectivity.insert(out.mesh.connectivity.end(), part.begin(), part.end());
      out.turn.push_back(angle);
    }
  };
  if (plane) { // the outside is on the left: inner flank forwards, outer flank backwards
    for (std::size_t k = 1; k < inner.size(); ++k) add({node(false, k - 1, 0), node(false, k, 0)});
    add({node(false, inner.size() - 1, 0), node(true, outer.size() - 1, 0)});
    for (std::size_t k = outer.size() - 1; k > 0; --k) add({node(true, k, 0), node(true, k - 1, 0)});
    add({node(true, 0, 0), node(false, 0, 0)});
    return out;
  }
  const std::size_t end = inner.size() - 1;
  for (int l = 1; l < levels; ++l) {
    for (std::size_t k = 1; k <= end; ++k) {
      add({node(true, k - 1, l - 1), node(true, k, l - 1), node(true, k, l), node(true, k - 1, l)});
      add({node(false, k, l - 1), node(false, k - 1, l - 1), node(false, k - 1, l), node(false, k, l)});
    }
    add({node(false, 0, l - 1), node(true, 0, l - 1), node(true, 0, l), node(false, 0, l)});
    add({node(true, end, l - 1), node(false, end, l - 1), node(false, end, l), node(true, end, l)});
  }
  for (std::size_t k = 1; k <= end; ++k) {
    add({node(false, k - 1, 0), node(false, k, 0), node(true, k, 0), node(true, k - 1, 0)});
    add({node(true, k - 1, levels - 1), node(true, k, levels - 1), node(false, k, levels - 1),
         node(false, k - 1, levels - 1)});
  }
  return out;
}

Point normal_of(const std::vector<Point>& p) {
  if (p.size() == 2) {
    const Point along = p[1] - p[0];
    const double size = std::sqrt(dot(along, along));
    return {-along[1] / size, along[0] / size, 0.0};
  }
  Point n = p.size() == 3 ? cross(p[1] - p[0], p[2] - p[0]) : cross(p[2] - p[0], p[3] - p[1]);
  const double size = std::sqrt(dot(n, n));
  for (double& x : n) x /= size;
  return n;
}

bool is_inside(const std::vector<std::vector<Point>>& facets, const Point& x, int d) {
  bool inside = false;
  const Point u = {0.5377, 0.3117, 0.7833};
  for (const auto& p : facets) {
    if (d == 2) {
      if ((p[0][1] > x[1]) != (p[1][1] > x[1]) &&
          x[0] < p[0][0] + (x[1] - p[0][1]) / (p[1][1] - p[0][1]) * (p[1][0] - p[0][0]))
        inside = !inside;
    } else {
      for (std::size_t i = 2; i < p.size(); ++i) inside = inside != goes_through(x, u, p[0], p[i - 1], p[i]);
    }
  }
  return inside;
}

// Random points of the surface, and the facet of each.
struct Slaves {
  std::vector<std::int64_t> facet;
  std::vector<double> weight; // [slaves][corners]
  Slaves(Random& random, const MeshSurface& mesh, int count) {
    const int m = mesh.basis->node_count();
    for (int i = 0; i < count; ++i) {
      facet.push_back(random.below(static_cast<int>(mesh.segments())));
      const bool near_edge = random.coin();
      const double far =
          near_edge ? 1.0 - std::pow(10.0, random.uniform(-5.0, -0.5)) : random.uniform(-1.0, 1.0);
      const double a = random.coin() ? far : -far, b = random.uniform(-1.0, 1.0);
      if (m == 2) {
        weight.insert(weight.end(), {0.5 * (1 - a), 0.5 * (1 + a)});
      } else if (m == 4) {
        weight.insert(weight.end(), {0.25 * (1 - a) * (1 - b), 0.25 * (1 + a) * (1 - b),
                                     0.25 * (1 + a) * (1 + b), 0.25 * (1 - a) * (1 + b)});
      } else {
        const double p = 0.5 * (1 + a), q = (1 - p) * 0.5 * (1 + b);
        weight.insert(weight.end(), {p, q, 1 - p - q});
      }
    }
  }
  Point at(std::size_t i, const std::vector<std::vector<Point>>& facets) const {
    const auto& p = facets[static_cast<std::size_t>(facet[i])];
    Point x = {0.0, 0.0, 0.0};
    for (std::size_t a = 0; a < p.size(); ++a)
      for (std::size_t k = 0; k < 3; ++k) x[k] += weight[i * p.size() + a] * p[a][k];
    return x;
  }
};

struct Counts {
  std::int64_t slaves = 0, pressed = 0, through_the_body = 0, silent = 0, farther = 0, flagged = 0,
               wrong_flag = 0, deeper = 0, beside = 0, beyond = 0;
};

void judge(const Spiral& spiral, const std::vector<std::vector<Point>>& facets, const Slaves& slaves,
           std::size_t i, const Point& x, const Detector::Found& found, double depth, Counts& all) {
  const int d = spiral.mesh.basis->dimension;
  const Point n = normal_of(facets[static_cast<std::size_t>(slaves.facet[i])]);
  const Point outside = {x[0] + 1e-7 * n[0], x[1] + 1e-7 * n[1], x[2] + 1e-7 * n[2]};
  const bool pressed = is_inside(facets, outside, d), none = found.segment[i] < 0,
             behind = (found.flags[i] & ENTS_FLAG_BEHIND_EDGE) != 0,
             flagged = behind || (found.flags[i] & ENTS_FLAG_AMBIGUOUS) != 0;
  ++all.slaves;
  all.flagged += flagged;
  double any = 1e300, facing = 1e300; // of other turns
  const auto turns_apart = [&](std::size_t s) {
    return std::fabs(spiral.turn[s] - spiral.turn[static_cast<std::size_t>(slaves.facet[i])]) > pi;
  };
  for (std::size_t s = 0; s < facets.size(); ++s) {
    if (!turns_apart(s)) continue;
    const double distance =
        d == 2 ? distance_to_edge(x, facets[s][0], facets[s][1]) : distance_to_facet(x, facets[s]);
    any = std::min(any, distance);
    if (dot(normal_of(facets[s]), n) < -0.5) facing = std::min(facing, distance);
  }
  if (!pressed) {
    const bool deep = !none && !flagged && found.gap[i] < -1e-6;
    // Outside the other turn through its end, which looks sideways and is left out, but still below its flank, whose
    // last facet is not at a right angle to the end (0.18 at most).
    if ((deep && turns_apart(static_cast<std::size_t>(found.segment[i])) && any < -0.2 * found.gap[i]) ||
        (behind && any < 0.1 * spiral.thickness))
      return void(++all.beyond);
    all.through_the_body += deep;
    all.wrong_flag += behind;
    return;
  }
  // the other turn's end, or its side, is nearer than what faces the slave: no contact of these two flanks
  if (any < facing - 1e-9) return void(++all.beside);
  if (facing > 0.999 * depth) return void(++all.deeper);
  ++all.pressed;
  if (flagged || facing < 1e-6) return;
  if (none || found.gap[i] > 0.0)
    ++all.silent;
  else
    all.farther += std::fabs(found.gap[i] + facing) > 1e-7;
}

std::int64_t slaves_of_each() {
  const char* text = std::getenv("ENTS_TEST_SLAVES");
  return text ? std::atoll(text) : samples(20000);
}

Counts count(const char* basis, std::uint64_t seed, bool with_depth) {
  Random random(seed);
  Counts all;
  while (all.slaves < slaves_of_each()) {
    Spiral spiral = draw_spiral(random, basis);
    const int d = spiral.mesh.basis->dimension;
    const double t = spiral.thickness;
    spiral.wind(1.3 * t, 0.0);
    const Model model(nlohmann::json{{"segment", basis}}.dump());
    Detector detector(model, spiral.mesh);
    const Slaves slaves(random, spiral.mesh, 400);
    std::vector<double> x, normals, thickness(slaves.facet.size());
    const auto place = [&](const std::vector<std::vector<Point>>& facets) {
      x.clear(), normals.clear();
      for (std::size_t i = 0; i < slaves.facet.size(); ++i) {
        const Point at = slaves.at(i, facets),
                    n = normal_of(facets[static_cast<std::size_t>(slaves.facet[i])]);
        x.insert(x.end(), at.begin(), at.begin() + d),
            normals.insert(normals.end(), n.begin(), n.begin() + d);
      }
    };
    const double reach = random.uniform(0.5, 3.0) * t;
    place(spiral.facets());
    detector.thickness(x, reach, normals, slaves.facet, thickness);
    spiral.wind(t * random.uniform(0.7, 1.05), t * random.uniform(0.0, 0.1));
    detector.refit();
    const std::vector<std::vector<Point>> facets = spiral.facets();
    place(facets);
    std::vector<double> depth = thickness;
    for (double& value : depth) value *= 0.5;
    Detector::Found found;
    detector.detect(x, reach, found, normals, slaves.facet, with_depth ? depth : std::vector<double>());
    for (std::size_t i = 0; i < slaves.facet.size(); ++i)
      judge(spiral, facets, slaves, i, slaves.at(i, facets), found, std::min(depth[i], reach), all);
  }
  std::printf(
      "%-6s %8lld slaves, %lld pressed, %lld through the body, %lld silent, %lld at a farther face; "
      "%lld flagged, %lld of them wrongly; %lld deeper than depth, %lld beside, %lld beyond the end\n",
      basis, static_cast<long long>(all.slaves), static_cast<long long>(all.pressed),
      static_cast<long long>(all.through_the_body), static_cast<long long>(all.silent),
      static_cast<long long>(all.farther), static_cast<long long>(all.flagged),
      static_cast<long long>(all.wrong_flag), static_cast<long long>(all.deeper),
      static_cast<long long>(all.beside), static_cast<long long>(all.beyond));
  return all;
}

class SelfContact : public testing::TestWithParam<const char*> {};

TEST_P(SelfContact, NoneIsSilentNoneIsSeenThroughTheBody) {
  const Counts all = count(GetParam(), 1, true);
  EXPECT_GT(all.pressed, all.slaves / 20);
  EXPECT_EQ(all.through_the_body, 0);
  EXPECT_EQ(all.silent, 0);
  EXPECT_EQ(all.farther, 0);
  EXPECT_LE(all.wrong_flag, all.slaves / 10000); // a step that is cut for nothing
  EXPECT_LT(all.deeper, all.pressed / 10);
  EXPECT_LT(all.beyond, all.slaves / 1000);
}

// The depth is what tells the other side of the own body from another turn.
TEST_P(SelfContact, WithoutTheDepthTheOtherSideOfTheBodyIsContact) {
  EXPECT_GT(count(GetParam(), 1, false).through_the_body, 0);
}

INSTANTIATE_TEST_SUITE_P(All, SelfContact, testing::Values("line2", "tri3", "quad4"));

// What is wrong in the arguments is named, and nothing is written.
TEST(SelfContactArguments, AreChecked) {
  MeshSurface line;
  line.basis = &basis_named("line2");
  line.positions = {0, 0, 1, 0, 2, 0}, line.connectivity = {0, 1, 1, 2};
  const ents_master_mesh mesh = line.mesh();
  const Model model(R"({"segment": "line2"})"),
      lit(R"({"segment": "line2", "projection": {"type": "shadow_direction", "direction": [0, 1]}})");
  ents_report report{};
  report.struct_size = sizeof report;
  std::vector<double> tree(100);
  const double slave[2] = {0.5, 0.1}, normal[2] = {0, -1};
  const auto status = [&](const Model& of, auto&& change, bool thickness) {
    EXPECT_EQ(ents_tree_build(of.handle(), &mesh, tree.data(), 100, &report), ENTS_OK) << report.message;
    std::int64_t segment = -1, own = 0;
    double xi = 0.0, depth = 0.2, thick = 0.0;
    const std::int32_t side = 0, sides[2] = {0, 1};
    ents_detection io{};
    io.struct_size = sizeof io;
    io.slave = slave, io.reach = 1.0, io.segment = &segment, io.xi = &xi, io.slave_normal = normal;
    io.slave_segment = &own, io.depth = &depth, io.slave_side = &side, io.segment_side = sides;
    change(io, own, depth, thick);
    const std::int32_t found =
        thickness ? ents_thickness(of.handle(), &mesh, tree.data(), 100, 0, 1, &io, &thick, &report)
                  : ents_detect(of.handle(), &mesh, tree.data(), 100, 0, 1, &io, &report);
    EXPECT_EQ(segment, -1);
    return found;
  };
  using Io = ents_detection;
  using Whole = std::int64_t;
  const auto says = [&](const char* words) {
    EXPECT_NE(std::strstr(report.message, words), nullptr) << report.message;
  };
  for (const bool thickness : {false, true}) {
    EXPECT_EQ(status(
                  model, [](Io&, Whole&, double&, double&) {}, thickness),
              ENTS_OK)
        << report.message;
    EXPECT_EQ(status(
                  model, [](Io&, Whole& own, double&, double&) { own = 2; }, thickness),
              ENTS_BAD_VALUE);
    says("slave_segment");
    EXPECT_EQ(status(
                  model, [](Io&, Whole&, double& depth, double&) { depth = 0.0; }, thickness),
              ENTS_BAD_VALUE);
    says("depth");
    EXPECT_EQ(status(
                  model, [](Io& io, Whole&, double&, double&) { io.slave_side = nullptr; }, thickness),
              ENTS_NULL_ARGUMENT);
    says("slave_side is null");
  }
  EXPECT_EQ(status(
                model, [](Io& io, Whole&, double&, double&) { io.slave_normal = nullptr; }, true),
            ENTS_NULL_ARGUMENT);
  EXPECT_EQ(status(
                model, [](Io&, Whole&, double&, double& before) { before = -1.0; }, true),
            ENTS_BAD_VALUE);
  EXPECT_EQ(status(
                lit, [](Io&, Whole&, double&, double&) {}, true),
            ENTS_BAD_VALUE);
  says("normal projection");
}

} // namespace
} // namespace mechanics::self_contact_test
