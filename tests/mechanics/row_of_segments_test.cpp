// One segment against its parts: the surface, the gap and the forces do not know where a mesh cuts it.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "differences.hpp"
#include "samples.hpp"
#include "worst.hpp"

namespace mechanics::row_of_segments_test {
namespace {

using nlohmann::json;

// Bases whose functions on a part of the segment are functions of the same kind: all Lagrange and serendipity
// ones.
class PartsOfASegment : public testing::TestWithParam<std::string> {
protected:
  const Basis& basis() const { return basis_named(GetParam()); }

  // Natural coordinates xi = low + size xi' of the part
  struct Part {
    std::array<double, 2> low{};
    double size = 1.0;
  };

  // The part, one of `count` per direction, that xi lies in
  Part part_at(const double* xi, int count) const {
    Part part;
    part.size = 1.0 / count;
    const double first = basis().simplex ? 0.0 : -1.0, width = basis().simplex ? 1.0 : 2.0;
    for (std::size_t a = 0; a < static_cast<std::size_t>(basis().parameters()); ++a) {
      const double u = std::floor((xi[a] - first) / width * count);
      part.low[a] = first + width * u / count - part.size * first; // where xi' = 0 comes to lie
    }
    return part;
  }

  // [part node][whole node]: the whole segment's shape functions at the part's nodes
  std::vector<std::vector<double>> interpolation(const Part& part) const {
    std::vector<std::vector<double>> rows;
    for (const auto& natural : basis().nodes) {
      const double xi[2] = {part.low[0] + part.size * natural[0], part.low[1] + part.size * natural[1]};
      rows.push_back(shape_values(basis(), xi));
    }
    return rows;
  }

  static std::vector<double> interpolate(const std::vector<std::vector<double>>& rows,
                                         const std::vector<double>& values, std::size_t entries) {
    std::vector<double> out;
    for (const auto& row : rows)
      for (std::size_t c = 0; c < entries; ++c) {
        double sum = 0.0;
        for (std::size_t i = 0; i < row.size(); ++i) sum += row[i] * values[i * entries + c];
        out.push_back(sum);
      }
    return out;
  }

  // P^T v: forces on the part's nodes, slave first, as forces on the whole segment's nodes
  std::vector<double> gather(const std::vector<std::vector<double>>& rows, const double* v) const {
    const std::size_t d = static_cast<std::size_t>(basis().dimension);
    std::vector<double> out(static_cast<std::size_t>(basis().dofs()));
    std::copy(v, v + d, out.begin());
    for (std::size_t k = 0; k < rows.size(); ++k)
      for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t c = 0; c < d; ++c) out[d * (i + 1) + c] += rows[k][i] * v[d * (k + 1) + c];
    return out;
  }
};

// Segments cut into 3 per direction; the nodes of a part lie on the whole and carry its surface coordinates.
// Then the element of the part is the element of the whole: same gap, R = P^T R', K = P^T K' P with the
// interpolation P of the nodes. A straight row of line2 against one long line2, and a net of quad4 against a
// large one, are cases of it.
TEST_P(PartsOfASegment, AreTheWholeSegment) {
  constexpr int count = 3;
  constexpr double tolerance =
      1e-12; // rounding of positions and s, 1e-15, times slopes, curvatures and 1 / size of the part
  Random random(81);
  Worst worst;
  std::int64_t compared = 0;
  for (const std::string& kind : height_kinds())
    for (const char* projection : projections) {
      Scene scene = draw_scene(random, basis(), kind, projection);
      scene.with_coordinates = true;
      const Model model(scene.model().dump());
      const Elements elements = draw_elements(random, scene, model, samples(60), -0.15, -0.02);
      constexpr std::int32_t wanted = ENTS_XI | ENTS_GAP | ENTS_NORMAL | ENTS_POINT | ENTS_ENERGY |
                                      ENTS_RESIDUAL | ENTS_TANGENT | ENTS_FLAGS;
      const Results whole = model.evaluate(elements, wanted);
      const std::size_t d = static_cast<std::size_t>(basis().dimension), t = d - 1, m = basis().nodes.size();
      const std::size_t n = static_cast<std::size_t>(basis().dofs());
      for (std::size_t e = 0; e < elements.area.size(); ++e) {
        const double* xi = &whole.xi[e * t];
        const Part part = part_at(xi, count);
        std::array<double, 2> local{};
        for (std::size_t a = 0; a < t; ++a) local[a] = (xi[a] - part.low[a]) / part.size;
        if (basis().simplex && local[0] + local[1] > 1.0)
          continue; // one of the triangles that stand on their head
        const auto p = interpolation(part);
        const std::vector<double> u = dofs_of(elements, static_cast<std::int64_t>(e), basis());
        Elements one;
        one.count = 1;
        one.slave.assign(u.begin(), u.begin() + static_cast<std::ptrdiff_t>(d));
        one.master =
            interpolate(p, std::vector<double>(u.begin() + static_cast<std::ptrdiff_t>(d), u.end()), d);
        const double* s = &elements.surface_coordinates[e * m * t];
        one.surface_coordinates = interpolate(p, std::vector<double>(s, s + m * t), t);
        one.area = {elements.area[e]};
        for (std::size_t a = 0; a < t; ++a) one.start.push_back(local[a] + random.uniform(-0.02, 0.02));
        const Results r = model.evaluate(one, wanted);
        const auto where = [&] { return scene.model().dump() + " element " + std::to_string(e); };
        ASSERT_TRUE(r.ok(0) && r.has_flag(0, ENTS_FLAG_CONTACT)) << where();
        ++compared;
        const auto same = [&](const double* got, const double* expected, std::size_t entries, double scale) {
          for (std::size_t i = 0; i < entries; ++i) worst.see(std::fabs(got[i] - expected[i]) / scale, where);
        };
        same(r.xi.data(), local.data(), t, 1.0);
        same(r.gap.data(), &whole.gap[e], 1, 1.0);
        same(r.normal.data(), &whole.normal[e * d], d, 1.0);
        same(r.point.data(), &whole.point[e * d], d, 1.0);
        same(r.energy.data(), &whole.energy[e], 1, whole.energy[e]);
        same(gather(p, r.residual.data()).data(), &whole.residual[e * n], n,
             largest_entry(&whole.residual[e * n], n));
        std::vector<double> half(n * n);
        for (std::size_t j = 0; j < n; ++j) {
          const std::vector<double> column = gather(p, &r.tangent[j * n]);
          for (std::size_t i = 0; i < n; ++i) half[i * n + j] = column[i];
        }
        const double scale = largest_entry(&whole.tangent[e * n * n], n * n);
        for (std::size_t i = 0; i < n; ++i)
          same(gather(p, &half[i * n]).data(), &whole.tangent[(e * n + i) * n], n, scale);
      }
    }
  EXPECT_GE(compared, samples(24 * 20));
  EXPECT_LE(worst.error, tolerance) << worst.where;
  std::cout << GetParam() << ": " << compared << " compared, worst " << worst.error << "\n";
}

INSTANTIATE_TEST_SUITE_P(Basis, PartsOfASegment,
                         testing::Values("line2", "line3", "tri3", "tri6", "quad4", "quad8", "quad9"),
                         [](const auto& parameter) { return parameter.param; });

// Neighbouring smoothed segments with a height: the points of rho_e meet where rho has a common normal (C1),
// the normals n_e where it has a common curvature (C2). theory.md, section 10: C1 smoothing leaves kinks in n_e
// where h is not zero.
TEST(SmoothedSegments, MeetAtTheirEnds) {
  Random random(83);
  double largest_kink = 0.0;
  for (const char* name : {"catmull_rom4", "bspline4"})
    for (const bool enriched : {false, true}) {
      const bool kinked = enriched && std::string(name) == "catmull_rom4";
      json height;
      if (enriched) height = {{"type", "sine"}, {"amplitude", 0.05}, {"wave_vector", {0.3}}, {"phase", 0.4}};
      const Model model(
          json{{"segment", name}, {"height", height}, {"projection", {{"type", "normal"}}}}.dump());
      for (int sample = 0; sample < 50; ++sample) {
        std::vector<double> nodes, s;
        for (int i = 0; i < 5; ++i) {
          nodes.push_back(i + random.uniform(-0.1, 0.1));
          nodes.push_back(random.uniform(-0.3, 0.3));
          s.push_back(0.2 * i + random.uniform(-0.02, 0.02));
        }
        const SurfacePoints left = evaluate_surface(model, nodes.data(), s.data(), {1.0});
        const SurfacePoints right = evaluate_surface(model, nodes.data() + 2, s.data() + 1, {-1.0});
        const double kink = norm(vec3(left.normal.data(), 2) - vec3(right.normal.data(), 2));
        EXPECT_LE(norm(vec3(left.point.data(), 2) - vec3(right.point.data(), 2)), 1e-14) << name;
        if (kinked)
          test::raise(largest_kink, kink);
        else
          EXPECT_LE(kink, 1e-14) << name << (enriched ? " enriched" : "");
      }
    }
  EXPECT_GT(largest_kink, 1e-6); // random curvatures differ on the two sides
}

} // namespace
} // namespace mechanics::row_of_segments_test
