// SPDX-License-Identifier: BSD-3-Clause
// Slave points above their facets: place, residual and tangent against definition, balance and differences.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "measured.hpp"
#include "mesh_surface.hpp"
#include "sample_count.hpp"
#include "worst.hpp"

namespace mechanics::raised_points_test {
namespace {

constexpr const char* lines[] = {"line2", "line3"};
constexpr const char* faces[] = {"tri3", "tri6", "quad4", "quad8", "quad9"};

constexpr double two_pi = 6.283185307179586;

// Waves along one direction: of a length of 0.9, 0.8 in space.
std::string slave_text(int d) {
  return d == 2
             ? R"({"segment": "line2", "height": {"type": "sine", "amplitude": 0.07, "wave_vector": [1.1], "phase": 0.4}})"
             : R"({"segment": "quad4", "height": {"type": "sine", "amplitude": 0.07, "wave_vector": [1.0, 0.7], "phase": 0.4}})";
}

std::string master_text(int d, const std::string& contact) {
  return std::string(R"({"segment": ")") + (d == 2 ? "line2" : "quad4") +
         R"(", "border": 0.2, "height": {"type": "sine", "amplitude": 0.05, "wave_vector": )" +
         (d == 2 ? "[0.6]" : "[0.5, 0.3]") + R"(}, "contact": )" + contact + "}";
}

// One slave facet over a master of 3 or 3 x 3 segments; nodes of the master first. Every pair of dofs has a place.
struct Pair {
  const Basis* facet;
  MeshSurface master;
  std::vector<std::int64_t> begin, nodes;
  std::vector<double> weights, areas, heights, slopes;
  std::vector<double> positions; // [nodes][d], all
  std::int64_t slave_first = 0;

  int d() const { return facet->dimension; }
  std::int64_t points() const { return static_cast<std::int64_t>(areas.size()); }
  ents_combination combination() const {
    auto c = ents::make<ents_combination>();
    c.points = points(), c.begin = begin.data(), c.nodes = nodes.data(), c.weights = weights.data();
    if (!heights.empty()) c.heights = heights.data(), c.slopes = slopes.data();
    return c;
  }
};

void raise(Pair& pair, const ents::Model& surface) {
  std::vector<double> heights(pair.areas.size()),
      slopes(pair.weights.size() * static_cast<std::size_t>(pair.d() - 1));
  pair.heights.clear();
  const ents_combination c = pair.combination();
  // surface coordinates: places of the nodes
  std::vector<double> coordinates;
  for (const std::int64_t node : pair.nodes)
    for (int k = 0; k + 1 < pair.d(); ++k)
      coordinates.push_back(pair.positions[static_cast<std::size_t>(node * pair.d() + k)]);
  ents::call(ents_raise_points, surface.get(), &c, coordinates.data(), heights.data(), slopes.data());
  pair.heights = heights, pair.slopes = slopes;
}

// The slave's facet looks down on the master: first node and last, or the corners, go round the other way.
Pair draw_pair(Random& random, const std::string& facet, int per_direction) {
  Pair pair;
  pair.facet = &basis_named(facet);
  const int d = pair.d();
  pair.master = draw_mesh(random, basis_named(d == 2 ? "line2" : "quad4"), 3, 0.1);
  pair.positions = pair.master.positions;
  pair.slave_first = pair.master.nodes();
  std::vector<std::int64_t> connectivity;
  for (std::size_t i = 0; i < pair.facet->nodes.size(); ++i) {
    const auto& xi = pair.facet->nodes[i];
    connectivity.push_back(pair.slave_first + static_cast<std::int64_t>(i));
    const double scale = pair.facet->simplex ? 1.5 : 0.8, from = pair.facet->simplex ? 2.2 : 3.0;
    if (d == 2) {
      pair.positions.push_back(from - scale * xi[0] + random.uniform(-0.05, 0.05));
    } else { // mirrored: the normal points to -z
      pair.positions.push_back(from + scale * xi[1] + random.uniform(-0.05, 0.05));
      pair.positions.push_back(from + scale * xi[0] + random.uniform(-0.05, 0.05));
    }
    pair.positions.push_back(random.uniform(-0.06, 0.06));
  }
  const std::int64_t points = d == 2 || per_direction == 1 ? per_direction : per_direction * per_direction;
  const std::size_t m = connectivity.size();
  pair.begin.resize(static_cast<std::size_t>(points + 1));
  pair.nodes.resize(static_cast<std::size_t>(points) * m), pair.weights.resize(pair.nodes.size());
  pair.areas.resize(static_cast<std::size_t>(points));
  ents::call(ents_sampling_points, facet.c_str(), per_direction, std::int64_t{1}, connectivity.data(),
             static_cast<std::int64_t>(pair.positions.size()) / d, pair.positions.data(), 1.0,
             pair.begin.data(), pair.nodes.data(), pair.weights.data(), pair.areas.data());
  return pair;
}

struct Assembled {
  std::vector<double> residual, tangent; // [n], [n][n] rows
  std::vector<double> state;
  double energy = 0.0;
  std::int32_t status = 0;
  int closed = 0;
};

// Dofs: those of the nodes, `own` per node.
Assembled assemble(const ents::Model& model, const Pair& pair, const std::vector<double>& at,
                   const std::vector<double>& begin_positions, const std::vector<double>& state,
                   std::vector<std::int64_t>& segment, std::vector<double>& xi,
                   const std::vector<double>& temperature = {}) {
  const auto d = static_cast<std::size_t>(pair.d());
  const std::size_t own = static_cast<std::size_t>(model.layout().node_dofs), all = at.size() / d,
                    n = own * all, points = pair.areas.size();
  Assembled out;
  out.residual.resize(n), out.tangent.resize(n * n),
      out.state.resize(points * static_cast<std::size_t>(model.layout().state_size));
  const ents_combination combination = pair.combination();
  std::vector<double> slave(points * d), slave_begin(points * d);
  ents::call(ents_combine, &combination, pair.d(), static_cast<std::int64_t>(all), at.data(), slave.data());
  ents::call(ents_combine, &combination, pair.d(), static_cast<std::int64_t>(all), begin_positions.data(),
             slave_begin.data());
  MeshSurface moved = pair.master;
  moved.positions.assign(at.begin(), at.begin() + static_cast<std::ptrdiff_t>(pair.master.positions.size()));
  ents_master_mesh mesh = moved.mesh();
  if (!temperature.empty()) mesh.temperature = temperature.data();
  std::int64_t size = 0;
  ents::call(ents_tree_size, model.get(), moved.segments(), &size);
  std::vector<double> tree(static_cast<std::size_t>(size));
  ents::call(ents_tree_build, model.get(), &mesh, tree.data(), size);
  std::vector<std::int64_t> equations(n), row_begin(n + 1), columns(n * n);
  for (std::size_t i = 0; i < n; ++i) equations[i] = static_cast<std::int64_t>(i);
  for (std::size_t i = 0; i <= n; ++i) row_begin[i] = static_cast<std::int64_t>(i * n);
  for (std::size_t i = 0; i < n * n; ++i) columns[i] = static_cast<std::int64_t>(i % n);
  std::vector<double> gap(points), energy(points);
  std::vector<std::int32_t> flags(points), detected(points), status(points);
  auto detection = ents::make<ents_detection>();
  detection.slave = slave.data(), detection.reach = 0.5, detection.segment = segment.data();
  detection.xi = xi.data(), detection.gap = gap.data(), detection.flags = detected.data();
  auto input = ents::make<ents_input>();
  input.area = pair.areas.data(), input.area_stride = 1;
  input.state_begin = state.data(), input.state_begin_stride = model.layout().state_size;
  input.positions_begin = begin_positions.data();
  input.slave_begin = slave_begin.data();
  std::vector<double> slave_temperature(points);
  if (!temperature.empty()) {
    for (std::size_t i = 0; i < points; ++i)
      for (auto j = pair.begin[i]; j < pair.begin[i + 1]; ++j)
        slave_temperature[i] +=
            pair.weights[static_cast<std::size_t>(j)] *
            temperature[static_cast<std::size_t>(pair.nodes[static_cast<std::size_t>(j)])];
    input.slave_temperature = slave_temperature.data(), input.slave_temperature_stride = 1;
  }
  auto output = ents::make<ents_output>();
  output.wanted = ENTS_ENERGY | ENTS_FLAGS | ENTS_STATE;
  output.energy = energy.data(), output.energy_stride = 1, output.flags = flags.data(),
  output.flags_stride = 1;
  output.state_end = out.state.data(), output.state_end_stride = model.layout().state_size;
  output.status = status.data(), output.status_stride = 1;
  auto system = ents::make<ents_system>();
  system.index_size = 8, system.slave = &combination, system.slave_nodes = static_cast<std::int64_t>(all);
  system.slave_equations = system.master_equations = equations.data();
  system.master_nodes = pair.master.nodes(), system.rows = static_cast<std::int64_t>(n);
  system.residual = out.residual.data(), system.values = out.tangent.data();
  system.row_begin = row_begin.data(), system.columns = columns.data();
  system.slave_positions = at.data();
  const ents::Result result =
      ents::call(ents_iterate, model.get(), &mesh, tree.data(), size, std::int64_t{0},
                 static_cast<std::int64_t>(points), &detection, &input, &output, &system);
  out.status = result.report.status;
  for (std::size_t i = 0; i < points; ++i) {
    out.energy += energy[i];
    out.closed += (flags[i] & ENTS_FLAG_CONTACT) != 0;
  }
  return out;
}

double largest(const std::vector<double>& v) {
  double m = 0.0;
  for (const double x : v) test::raise(m, std::fabs(x));
  return m;
}

// x = sum N_i x_i + h n with h at the place between the nodes, written out.
TEST(RaisedPoints, AreAboveTheirFacets) {
  Random random(7);
  for (int trial = 0; trial < 200; ++trial) {
    const bool plane = random.coin();
    const std::string facet = plane ? lines[random.below(2)] : faces[random.below(5)];
    Pair pair = draw_pair(random, facet, 2 + random.below(2));
    const auto d = static_cast<std::size_t>(pair.d());
    const ents::Model surface(slave_text(pair.d()));
    const std::vector<double> flat = [&] {
      std::vector<double> x(pair.areas.size() * d);
      const ents_combination c = pair.combination();
      ents::call(ents_combine, &c, pair.d(), static_cast<std::int64_t>(pair.positions.size() / d),
                 pair.positions.data(), x.data());
      return x;
    }();
    raise(pair, surface);
    std::vector<double> raised(flat.size());
    const ents_combination c = pair.combination();
    ents::call(ents_combine, &c, pair.d(), static_cast<std::int64_t>(pair.positions.size() / d),
               pair.positions.data(), raised.data());
    for (std::size_t i = 0; i < pair.areas.size(); ++i) {
      const double* x = &flat[i * d];
      const double waves = d == 2 ? 1.1 * x[0] : x[0] + 0.7 * x[1], h = 0.07 * std::sin(two_pi * waves + 0.4);
      EXPECT_NEAR(pair.heights[i], h, 1e-13);
      double off = 0.0; // straight: |x - flat| = |h|, downwards for h > 0
      for (std::size_t k = 0; k < d; ++k) off += std::pow(raised[i * d + k] - x[k], 2);
      EXPECT_NEAR(std::sqrt(off), std::fabs(h), 1e-14);
      if (std::fabs(h) > 1e-3) {
        EXPECT_LT((raised[i * d + d - 1] - x[d - 1]) * h, 0.0) << facet;
      }
    }
  }
}

// Residual = derivative of the energy; tangent = derivative of the residual, symmetric without friction; forces
// and moments of both bodies balance.
TEST(RaisedPoints, HaveExactTangents) {
  Random random(11);
  const struct {
    const char* contact;
    bool friction, heat;
  } laws[] = {
      {R"({"normal": {"type": "penalty", "stiffness": 50}})", false, false},
      {R"({"normal": {"type": "power", "coefficient": 500, "exponent": 2}})", false, false},
      {R"({"normal": {"type": "penalty", "stiffness": 50}, "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 20}})",
       true, false},
      {R"({"normal": {"type": "penalty", "stiffness": 50}, "heat": {"conductance": 3}})", false, true}};
  double worst_force = 0.0, worst_tangent = 0.0, worst_symmetry = 0.0, worst_balance = 0.0,
         worst_moment = 0.0;
  int contacts = 0;
  for (std::int64_t trial = 0; trial < test::samples(120); ++trial) {
    const bool plane = random.coin();
    const auto& law = laws[random.below(4)];
    Pair pair = draw_pair(random, plane ? lines[random.below(2)] : faces[random.below(5)], 2);
    const int d = pair.d();
    raise(pair, ents::Model(slave_text(d)));
    const ents::Model model(master_text(d, law.contact));
    const auto points = pair.areas.size(), all = pair.positions.size() / static_cast<std::size_t>(d);
    const auto own = static_cast<std::size_t>(model.layout().node_dofs), n = own * all;
    std::vector<double> state(points * static_cast<std::size_t>(model.layout().state_size)), temperature;
    if (model.layout().state_size > 0)
      ents::call(ents_state_init, model.get(), pair.points(), state.data(),
                 std::int64_t{model.layout().state_size});
    if (law.heat)
      for (std::size_t i = 0; i < all; ++i) temperature.push_back(random.uniform(-1.0, 1.0));
    std::vector<std::int64_t> segment(points, -1);
    std::vector<double> xi(points * static_cast<std::size_t>(d - 1));
    std::vector<double> at = pair.positions, begin = at;
    if (law.friction) { // touches at the begin, then moves
      state = assemble(model, pair, at, begin, state, segment, xi).state;
      for (double& x : at) x += random.uniform(-0.01, 0.01);
    }
    const auto start_segment = segment;
    const auto start_xi = xi;
    const Assembled centre = assemble(model, pair, at, begin, state, segment, xi, temperature);
    ASSERT_EQ(centre.status, ENTS_OK);
    contacts += centre.closed;
    if (centre.closed == 0) continue;
    // one random direction
    std::vector<double> direction(n);
    for (double& v : direction) v = random.uniform(-1.0, 1.0);
    constexpr double t = 2e-5;
    std::array<Assembled, 4> beside;
    const double offsets[4] = {-2 * t, -t, t, 2 * t};
    bool same = true;
    for (std::size_t k = 0; k < 4; ++k) {
      std::vector<double> moved = at, warmed = temperature;
      for (std::size_t node = 0; node < all; ++node) {
        for (std::size_t c = 0; c < static_cast<std::size_t>(d); ++c)
          moved[node * static_cast<std::size_t>(d) + c] += offsets[k] * direction[own * node + c];
        if (law.heat) warmed[node] += offsets[k] * direction[own * node + own - 1];
      }
      auto s = start_segment;
      auto x = start_xi;
      beside[k] = assemble(model, pair, moved, begin, state, s, x, warmed);
      same = same && beside[k].status == ENTS_OK && beside[k].closed == centre.closed && s == segment;
    }
    if (!same) continue;
    const double scale = largest(centre.tangent);
    for (std::size_t i = 0; i < n; ++i) {
      double expected = 0.0;
      for (std::size_t j = 0; j < n; ++j) expected += centre.tangent[i * n + j] * direction[j];
      const double difference = (8 * (beside[2].residual[i] - beside[1].residual[i]) -
                                 (beside[3].residual[i] - beside[0].residual[i])) /
                                (12 * t);
      test::raise(worst_tangent, std::fabs(difference - expected) / scale);
    }
    if (law.friction || law.heat) continue;
    double work = 0.0;
    for (std::size_t i = 0; i < n; ++i) work += centre.residual[i] * direction[i];
    const double slope =
        (8 * (beside[2].energy - beside[1].energy) - (beside[3].energy - beside[0].energy)) / (12 * t);
    test::raise(worst_force, std::fabs(work - slope) / largest(centre.residual));
    std::array<double, 3> sum{};
    double moment = 0.0;
    for (std::size_t node = 0; node < all; ++node) {
      const double* r = &centre.residual[own * node];
      const double* x = &at[static_cast<std::size_t>(d) * node];
      for (std::size_t c = 0; c < static_cast<std::size_t>(d); ++c) sum[c] += r[c];
      moment += x[0] * r[1] - x[1] * r[0];
    }
    for (const double s : sum) test::raise(worst_balance, std::fabs(s) / largest(centre.residual));
    test::raise(worst_moment, std::fabs(moment) / largest(centre.residual));
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < i; ++j)
        test::raise(worst_symmetry, std::fabs(centre.tangent[i * n + j] - centre.tangent[j * n + i]) / scale);
  }
  EXPECT_GT(contacts, test::sample_divisor == 1 ? 100 : 0);
  // The stencil's error is t^4 times a fifth derivative (waves of 0.9: (2 pi / 0.9)^5 = 2e4), its rounding 1e-16 / t.
  test::expect_measured("tangent against differences, of its largest entry", worst_tangent, 1e-9);
  test::expect_measured("forces against differences of the energy", worst_force, 1e-9);
  test::expect_measured("tangent without friction, asymmetry", worst_symmetry, 1e-14);
  test::expect_measured("sum of the forces of both sides", worst_balance, 1e-14);
  test::expect_measured("sum of their moments", worst_moment, 1e-13);
}

// What a caller may get wrong is said by the name of the argument.
TEST(RaisedPoints, SayWhatIsWrong) {
  Random random(3);
  Pair pair = draw_pair(random, "quad4", 2);
  const ents::Model surface(slave_text(3)),
      model(master_text(3, R"({"normal": {"type": "penalty", "stiffness": 50}})"));
  std::vector<double> heights(pair.areas.size()), slopes(2 * pair.weights.size());
  ents_combination c = pair.combination();
  ents_report report = new_report();
  const auto expect = [&](std::int32_t status, std::int32_t wanted, const char* words) {
    EXPECT_EQ(status, wanted) << report.message;
    EXPECT_NE(std::string(report.message).find(words), std::string::npos) << report.message;
  };
  const auto raised = [&] {
    return ents_raise_points(surface.get(), &c, nullptr, heights.data(), slopes.data(), &report);
  };
  ASSERT_EQ(raised(), ENTS_OK) << report.message;
  expect(ents_raise_points(surface.get(), &c, nullptr, nullptr, slopes.data(), &report), ENTS_NULL_ARGUMENT,
         "'heights'");
  expect(ents_raise_points(surface.get(), &c, nullptr, heights.data(), nullptr, &report), ENTS_NULL_ARGUMENT,
         "'slopes'");
  pair.weights[5] += 1e-6;
  expect(raised(), ENTS_BAD_VALUE, "point 1 are no shape functions");
  pair.weights[5] -= 1e-6;

  std::vector<double> place(3 * pair.areas.size());
  const auto all = static_cast<std::int64_t>(pair.positions.size()) / 3;
  const auto combined = [&](int d = 3) {
    return ents_combine(&c, d, all, pair.positions.data(), place.data(), &report);
  };
  c.heights = heights.data();
  expect(combined(), ENTS_NULL_ARGUMENT, "combination.slopes is null");
  c.slopes = slopes.data();
  ASSERT_EQ(combined(), ENTS_OK) << report.message;
  expect(combined(1), ENTS_BAD_VALUE, "'dimension'");
  const std::vector<std::int32_t> reflected(pair.nodes.size());
  c.reflected = reflected.data();
  expect(combined(), ENTS_BAD_VALUE, "heights and reflected");
  c.reflected = nullptr;
  heights[2] = std::nan("");
  expect(combined(), ENTS_NON_FINITE, "point 2");
  ASSERT_EQ(raised(), ENTS_OK);
  const std::vector<double> good = pair.positions;
  for (std::size_t i = static_cast<std::size_t>(3 * pair.slave_first); i < pair.positions.size(); ++i)
    pair.positions[i] = 0.0;
  expect(combined(), ENTS_DEGENERATE_SEGMENT, "point 0 has no normal");
  pair.positions = good;

  // The system's part of it: one element above the master's middle.
  pair.heights = heights, pair.slopes = slopes;
  ents_combination points = pair.combination(), of_master = points;
  const ents_master_mesh mesh = pair.master.mesh();
  std::vector<std::int64_t> equations(pair.positions.size(), -1), segment(pair.areas.size(), 4);
  ASSERT_EQ(combined(), ENTS_OK);
  auto input = ents::make<ents_input>();
  input.slave = place.data(), input.slave_stride = 3, input.area = pair.areas.data(), input.area_stride = 1;
  input.mesh = &mesh, input.segment = segment.data(), input.segment_stride = 1;
  auto system = ents::make<ents_system>();
  system.index_size = 8, system.slave = &points, system.slave_nodes = all;
  system.slave_equations = system.master_equations = equations.data(), system.master_nodes = all;
  double residual = 0.0;
  system.rows = 1, system.residual = &residual;
  const auto assembled = [&] {
    return ents_assemble(model.get(), 0, pair.points(), &input, nullptr, &system, &report);
  };
  expect(assembled(), ENTS_NULL_ARGUMENT, "system.slave_positions is null");
  std::vector<double> moved = pair.positions;
  for (std::size_t i = static_cast<std::size_t>(3 * pair.slave_first); i < moved.size(); ++i)
    moved[i] += 1e-3;
  system.slave_positions = moved.data();
  for (std::size_t i = 2; i < place.size(); i += 3) place[i] = -0.1; // all in contact
  expect(assembled(), ENTS_BAD_VALUE, "input.slave of element 0 is");
  system.slave_positions = pair.positions.data();
  of_master.points = all, system.master = &of_master;
  expect(assembled(), ENTS_BAD_VALUE, "system.master has heights");
}

} // namespace
} // namespace mechanics::raised_points_test
