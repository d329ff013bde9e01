// SPDX-License-Identifier: BSD-3-Clause
// What friction dissipates: closed forms of a cycle, a rotation and a slide over many segments.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "heated_point.hpp"
#include "measured.hpp"
#include "worst.hpp"

namespace laws::dissipation_test {
namespace {

using heated::coulomb, heated::eps, heated::k_t, heated::mu, heated::Point, heated::text_of;

// A cycle of amplitude d: 4 mu N (d - mu N / k_t), on each reversal the elastic slip mu N / k_t springs back.
TEST(Dissipation, OfACycleIsItsClosedForm) {
  for (const int steps : {40, 400}) {
    Point point(text_of({{"conductance", 1.0}}, coulomb));
    const double depth = 0.02, d = 0.3, N = 0.7 * eps * depth, k = 0.7 * k_t;
    double sum = 0.0, own = 0.0, stored = 0.0, work = 0.0, x = d;
    ASSERT_EQ(point.evaluate(x, -depth), ENTS_OK);
    point.commit();
    for (int cycle = 0; cycle < 2; ++cycle) {
      sum = own = work = 0.0;
      for (int i = 1; i <= 2 * steps; ++i) {
        const double next = i <= steps ? d - 2.0 * d * i / steps : -d + 2.0 * d * (i - steps) / steps;
        ASSERT_EQ(point.evaluate(next, -depth), ENTS_OK);
        work += point.residual[0] * (next - x);
        sum += point.dissipation;
        // what backward Euler dissipates beside it
        const double elastic = next - x - (next > x ? 1.0 : -1.0) * point.dissipation / (mu * N);
        own += 0.5 * k * elastic * elastic;
        work -= point.friction_energy - stored;
        stored = point.friction_energy;
        x = next;
        point.commit();
      }
    }
    std::cout << steps << " increments each way\n";
    test::expect_measured("dissipation of a cycle against 4 mu N (d - mu N / k_t)",
                          std::fabs(sum / (4.0 * mu * N * (d - mu * N / k)) - 1.0), 1e-10);
    test::expect_measured("work less what is stored against what is dissipated",
                          std::fabs(work / (sum + own) - 1.0), 1e-10);
  }
}

// A rigid rotation of slave and master dissipates nothing and keeps what is stored.
TEST(Dissipation, DoesNotSeeARotation) {
  Point point(text_of({{"conductance", 1.0}}, coulomb));
  ASSERT_EQ(point.evaluate(0.0, -0.02), ENTS_OK);
  point.commit();
  ASSERT_EQ(point.evaluate(0.004, -0.02), ENTS_OK);
  const double stored = point.friction_energy;
  EXPECT_NEAR(stored, 0.5 * 0.7 * k_t * 0.004 * 0.004, 1e-15);
  point.commit();
  for (int i = 1; i <= 12; ++i) {
    ASSERT_EQ(point.evaluate(0.004, -0.02, i * 0.5), ENTS_OK);
    EXPECT_EQ(point.dissipation, 0.0);
    EXPECT_NEAR(point.friction_energy, stored, 1e-13 * stored + 1e-16);
    point.commit();
  }
}

// A row of segments in the plane with a slave that slides over all of them, by ents_iterate into rows of (u, v, T).
TEST(Dissipation, IsKeptOverSegments) {
  const Handle model = make(text_of({{"conductance", 2.0}, {"friction", json::object()}}, coulomb));
  const ents_layout layout = layout_of(model.get());
  constexpr int segments = 8;
  double positions[2 * (segments + 1)], temperature[segments + 1];
  std::int64_t connectivity[2 * segments], master_equations[3 * (segments + 1)],
      slave_equations[3] = {0, 1, 2};
  for (int i = 0; i <= segments; ++i)
    positions[2 * i] = 0.5 * i, positions[2 * i + 1] = 0.0, temperature[i] = i;
  for (int i = 0; i < segments; ++i) connectivity[2 * i] = i, connectivity[2 * i + 1] = i + 1;
  constexpr int rows = 3 * (segments + 2);
  for (int i = 0; i < 3 * (segments + 1); ++i) master_equations[i] = 3 + i;
  std::int64_t row_begin[rows + 1], columns[rows * rows];
  for (int i = 0; i <= rows; ++i) row_begin[i] = i * rows;
  for (int i = 0; i < rows * rows; ++i) columns[i] = i % rows;
  ents_master_mesh mesh{};
  mesh.struct_size = sizeof mesh, mesh.segments = segments, mesh.connectivity = connectivity;
  mesh.nodes = segments + 1, mesh.positions = positions, mesh.temperature = temperature;
  std::int64_t size = 0;
  ASSERT_EQ(ents_tree_size(model.get(), segments, &size, nullptr), ENTS_OK);
  std::vector<double> tree(static_cast<std::size_t>(size));
  ASSERT_EQ(ents_tree_build(model.get(), &mesh, tree.data(), size, nullptr), ENTS_OK);
  std::vector<double> begin(static_cast<std::size_t>(layout.state_size)), end = begin;
  ents_state_init(model.get(), 1, begin.data(), layout.state_size, nullptr);

  const double depth = 0.02, area = 1.0, N = eps * depth, step = 0.03, slave_temperature = 20.0;
  std::int64_t segment = -1, places[3 * 9 + 1] = {};
  double x = 0.3, xi = 0.0, sum = 0.0, worst = 0.0;
  for (int i = 0; i < 100; ++i, x += step) {
    const double slave[2] = {x, -depth};
    double dissipation = 0.0, heat[2], residual[rows] = {};
    std::vector<double> values(rows * rows);
    ents_detection detection{};
    detection.struct_size = sizeof detection, detection.slave = slave, detection.reach = 1.0;
    detection.segment = &segment, detection.xi = &xi;
    ents_input in{};
    in.struct_size = sizeof in, in.area = &area, in.state_begin = begin.data(),
    in.positions_begin = positions;
    in.slave_temperature = &slave_temperature, in.time_increment = 0.5;
    ents_output out{};
    out.struct_size = sizeof out, out.wanted = ENTS_STATE | ENTS_DISSIPATION | ENTS_HEAT;
    out.state_end = end.data(), out.dissipation = &dissipation, out.heat = heat;
    ents_system system{};
    system.struct_size = sizeof system, system.index_size = 8, system.slave_nodes = 1;
    system.slave_equations = slave_equations, system.master_nodes = segments + 1;
    system.master_equations = master_equations, system.rows = rows, system.residual = residual;
    system.row_begin = row_begin, system.columns = columns, system.values = values.data();
    system.places = places, system.places_size = 3 * 9 + 1;
    ents_report report = mechanics::new_report();
    ASSERT_EQ(
        ents_iterate(model.get(), &mesh, tree.data(), size, 0, 1, &detection, &in, &out, &system, &report),
        ENTS_OK)
        << report.message;
    const double flow = 2.0 * (slave_temperature - x / 0.5);
    EXPECT_NEAR(heat[0], flow, 1e-12);
    EXPECT_NEAR(residual[2], flow - 0.5 * heat[1], 1e-12);
    double all = 0.0;
    for (int row = 2; row < rows; row += 3) all += residual[row];
    EXPECT_NEAR(all, -heat[1], 1e-13);
    EXPECT_NEAR(values[2 * rows + 2], 2.0, 1e-14);
    EXPECT_NEAR(values[2 * rows], -4.0 - (dissipation > 0.0 ? 0.5 * mu * N / 0.5 : 0.0),
                1e-11); // through T_m, of friction
    if (i > 2) {
      test::raise(worst, std::fabs(dissipation / (mu * N * step) - 1.0));
      EXPECT_NEAR(heat[1], mu * N * step / 0.5, 1e-12);
    }
    sum += dissipation;
    begin = end;
  }
  test::expect_measured("dissipation of an increment over 8 segments against mu N times the way", worst,
                        1e-10);
  test::expect_measured("its sum, the elastic slip left out", // the first increment has no history
                        std::fabs(sum / (mu * N * (99 * step - mu * N / k_t)) - 1.0), 1e-10);
}

} // namespace
} // namespace laws::dissipation_test
