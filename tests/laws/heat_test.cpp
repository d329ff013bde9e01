// Heat through the gap and what friction dissipates: closed forms of single elements, sums of many, and what is
// refused. The tangent: tangent_test.cpp.
#include <gtest/gtest.h>

#include <cmath>

#include "law_elements.hpp"
#include "measured.hpp"
#include "model_handle.hpp"
#include "parts_of_calls.hpp"
#include "worst.hpp"

namespace laws::heat_test {
namespace {

constexpr double eps = 100.0, mu = 0.3, k_t = 80.0;
const json penalty = {{"type", "penalty"}, {"stiffness", eps}};
const json coulomb = {{"type", "coulomb"}, {"coefficient", mu}, {"stiffness", k_t}};

json text_of(const json& heat, const json& friction = nullptr, const json& more = json::object()) {
  json text = {{"segment", "line2"},
               {"contact", {{"normal", penalty}, {"friction", friction}, {"heat", heat}}}};
  text.update(more);
  return text;
}

// A slave node over a flat line from -1 to 1, which may be turned.
class Point {
public:
  explicit Point(const json& text) : model_(make(text)), layout_(layout_of(model_.get())) {
    begin_.resize(static_cast<std::size_t>(layout_.state_size));
    end_ = begin_;
    ents_state_init(model_.get(), 1, begin_.data(), layout_.state_size, nullptr);
  }

  std::int32_t evaluate(double x, double y, double angle = 0.0, ents_report* report = nullptr) {
    const double c = std::cos(angle), s = std::sin(angle);
    const double slave[2] = {c * x - s * y, s * x + c * y}, master[4] = {-c, -s, c, s}, start = x;
    ents_input in{};
    in.struct_size = sizeof in, in.slave = slave, in.master = master, in.start = &start, in.area = &area;
    in.state_begin = begin_.data();
    in.slave_temperature = &slave_temperature, in.master_temperature = master_temperature;
    in.time_increment = time_increment;
    ents_output out{};
    out.struct_size = sizeof out;
    out.wanted = ENTS_PRESSURE | ENTS_STATE | ENTS_FLAGS | ENTS_RESIDUAL | ENTS_TANGENT | ENTS_HEAT |
                 ENTS_DISSIPATION | ENTS_FRICTION_ENERGY | ENTS_ENERGY;
    out.pressure = &pressure, out.state_end = end_.data(), out.flags = &flags, out.residual = residual;
    out.tangent = tangent, out.heat = heat, out.dissipation = &dissipation, out.energy = &energy;
    out.friction_energy = &friction_energy;
    return ents_evaluate(model_.get(), 0, 1, &in, &out, report);
  }
  void commit() { begin_ = end_; }

  double area = 0.7, time_increment = 0.1, slave_temperature = 5.0, master_temperature[2] = {1.0, 2.0};
  double pressure = 0.0, residual[9], tangent[81], heat[2], dissipation = 0.0, energy = 0.0,
         friction_energy = 0.0;
  std::int32_t flags = 0;

private:
  Handle model_;
  ents_layout layout_;
  std::vector<double> begin_, end_;
};

// h A (T_s - T_m) of every part, and where there is none.
TEST(Heat, ConductanceIsTheSumOfItsParts) {
  const json parts[] = {{{"conductance", 3.0}},
                        {{"power", {{"coefficient", 2.0}, {"pressure", 5.0}, {"exponent", 0.95}}}},
                        {{"table", {{"pressures", {0, 1, 4}}, {"conductances", {1, 3, 2}}}}},
                        {{"clearance", {{"gaps", {0, 0.1, 0.3}}, {"conductances", {4, 1, 0}}}}},
                        {{"gas", {{"conductivity", 0.2}, {"jump", 0.05}}}}};
  const auto expected = [](int part, double gap) {
    const double p = gap < 0.0 ? -eps * gap : 0.0;
    switch (part) {
    case 0:
      return gap < 0.0 ? 3.0 : 0.0;
    case 1:
      return gap < 0.0 ? 2.0 * std::pow(p / 5.0, 0.95) : 0.0;
    case 2:
      return gap >= 0.0 ? 0.0 : p < 1.0 ? 1.0 + 2.0 * p : p < 4.0 ? 3.0 - (p - 1.0) / 3.0 : 2.0;
    case 3:
      return gap < 0.0 ? 0.0 : gap < 0.1 ? 4.0 - 30.0 * gap : gap < 0.3 ? 1.0 - 5.0 * (gap - 0.1) : 0.0;
    default:
      return 0.2 / ((gap > 0.0 ? gap : 0.0) + 0.05);
    }
  };
  json all = json::object();
  for (const json& part : parts) all.update(part);
  for (const double gap : {-0.2, -0.03, -0.005, 0.02, 0.2, 0.5}) {
    const double x = 0.4, difference = 5.0 - (0.3 * 1.0 + 0.7 * 2.0);
    double sum = 0.0;
    for (int i = 0; i < 5; ++i) {
      Point point(text_of(parts[i]));
      ASSERT_EQ(point.evaluate(x, gap), ENTS_OK);
      EXPECT_NEAR(point.heat[0], 0.7 * expected(i, gap) * difference, 1e-13) << i << " " << gap;
      sum += point.heat[0];
    }
    Point point(text_of(all));
    ASSERT_EQ(point.evaluate(x, gap), ENTS_OK);
    EXPECT_NEAR(point.heat[0], sum, 1e-12);
    EXPECT_NEAR(point.residual[2], sum, 1e-12);
    EXPECT_NEAR(point.residual[5], -0.3 * sum, 1e-12);
    EXPECT_NEAR(point.residual[8], -0.7 * sum, 1e-12);
  }
}

// mu N v, split as asked; the mechanics are those without heat, to the last bit.
TEST(Heat, FrictionHeatsWithTheWorkThatItDissipates) {
  double worst[3] = {};
  for (const double slave : {0.0, 0.3, 1.0}) {
    Point point(text_of({{"friction", {{"share", 0.9}, {"slave", slave}}}}, coulomb)),
        cold(text_of(nullptr, coulomb));
    const double depth = 0.02, step = 0.05, N = 0.7 * eps * depth;
    double x = -0.8;
    for (int i = 0; i < 20; ++i, x += step) {
      ASSERT_EQ(point.evaluate(x, -depth), ENTS_OK);
      if (i > 2) { // the elastic slip is full
        const double power = 0.9 * mu * N * step / 0.1;
        test::raise(worst[0], std::fabs(point.heat[1] / power - 1.0));
        test::raise(worst[1], std::fabs(point.dissipation / (mu * N * step) - 1.0));
        test::raise(worst[2], std::fabs(point.residual[2] + slave * power) / power);
        EXPECT_NEAR(point.friction_energy, 0.5 * mu * N * mu * N / (0.7 * k_t), 1e-12);
        EXPECT_NEAR(point.residual[2] + point.residual[5] + point.residual[8], -point.heat[1], 1e-14);
      }
      point.commit();
    }
  }
  test::expect_measured("power of a dragged point against mu N v", worst[0], 1e-10);
  test::expect_measured("dissipation against mu N times the way", worst[1], 1e-10);
  test::expect_measured("share of the slave", worst[2], 1e-10);
}

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

// A patch has the numbers of its segment, and a rigid master those of a deformable one in the slave's rows.
TEST(Heat, OfPatchesAndRigidMasters) {
  const json heat = {{"power", {{"coefficient", 2.0}, {"pressure", 5.0}, {"exponent", 0.95}}}};
  const Handle one = make(text_of(heat)), patch = make(text_of(heat, nullptr, {{"patch", {{0, 1}, {1, 2}}}})),
               rigid = make(text_of(heat, nullptr, {{"master", "rigid"}}));
  ASSERT_EQ(layout_of(one.get()).dofs, 9);
  ASSERT_EQ(layout_of(patch.get()).dofs, 12);
  ASSERT_EQ(layout_of(rigid.get()).dofs, 3);
  ASSERT_EQ(layout_of(rigid.get()).node_dofs, 3);
  const double slave[2] = {0.4, -0.02}, slave_temperature = 7.0;
  const double positions[6] = {-1, 0.1, 0, 0, 1, 0.05}, temperature[3] = {1, 2, 4};
  double r[3][12], k[3][144];
  const Handle* models[] = {&one, &patch, &rigid};
  for (int i = 0; i < 3; ++i) {
    const int skip = i == 1 ? 0 : 1;
    ents_input in{};
    in.struct_size = sizeof in, in.slave = slave, in.master = positions + 2 * skip;
    in.slave_temperature = &slave_temperature, in.master_temperature = temperature + skip;
    ents_output out{};
    out.struct_size = sizeof out, out.wanted = ENTS_RESIDUAL | ENTS_TANGENT, out.residual = r[i],
    out.tangent = k[i];
    ASSERT_EQ(ents_evaluate(models[i]->get(), 0, 1, &in, &out, nullptr), ENTS_OK);
  }
  const auto of_patch = [](int dof) { return dof < 3 ? dof : dof + 3; };
  EXPECT_GT(std::fabs(r[0][2]), 1.0);
  for (int i = 0; i < 9; ++i) {
    EXPECT_NEAR(r[0][i], r[1][of_patch(i)], 1e-13);
    for (int j = 0; j < 9; ++j)
      EXPECT_NEAR(k[0][9 * j + i], k[1][12 * of_patch(j) + of_patch(i)], 1e-11) << i << " " << j;
  }
  for (int i = 3; i < 6; ++i) EXPECT_EQ(r[1][i], 0.0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(r[0][i], r[2][i], 1e-14);
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(k[0][9 * j + i], k[2][3 * j + i], 1e-12);
  }
}

// Beside the segment nothing flows; a multiplier is held at zero there.
TEST(Heat, NothingFlowsBesideTheSegment) {
  for (const char* law : {"penalty", "augmented_multiplier"}) {
    const json normal = {{"type", law}, {"stiffness", eps}};
    const Handle model = make(
        {{"segment", "line2"},
         {"contact", {{"normal", normal}, {"heat", {{"gas", {{"conductivity", 1.0}, {"jump", 0.1}}}}}}}});
    const ents_layout layout = layout_of(model.get());
    const int n = layout.dofs, multipliers = layout.multipliers;
    const double slave[2] = {7.0, 0.1}, master[4] = {-1, 0, 1, 0}, temperature[2] = {1, 2}, start = 0.9,
                 lambda = 0.5;
    std::vector<double> residual(static_cast<std::size_t>(n), 9.0),
        tangent(static_cast<std::size_t>(n * n), 9.0);
    double heat[2] = {9.0, 9.0};
    ents_input in{};
    in.struct_size = sizeof in, in.slave = slave, in.master = master, in.start = &start;
    in.slave_temperature = temperature, in.master_temperature = temperature;
    if (multipliers) in.multiplier = &lambda;
    ents_output out{};
    out.struct_size = sizeof out, out.wanted = ENTS_RESIDUAL | ENTS_TANGENT | ENTS_HEAT;
    out.residual = residual.data(), out.tangent = tangent.data(), out.heat = heat;
    ASSERT_EQ(ents_evaluate(model.get(), 0, 1, &in, &out, nullptr), ENTS_OK);
    EXPECT_EQ(heat[0], 0.0);
    EXPECT_EQ(heat[1], 0.0);
    for (int i = 0; i < n; ++i) {
      const bool held = i == n - 1 && multipliers == 1;
      EXPECT_EQ(residual[static_cast<std::size_t>(i)], held ? -lambda / eps : 0.0) << i;
      for (int j = 0; j < n; ++j)
        EXPECT_EQ(tangent[static_cast<std::size_t>(j * n + i)], held && j == i ? -1.0 / eps : 0.0)
            << i << " " << j;
    }
  }
}

// Heat changes no bit of the mechanics.
TEST(Heat, LeavesTheMechanicsAlone) {
  Random random(5);
  for (const Basis& basis : mechanics::all_bases()) {
    const mechanics::Scene scene = draw_scene(random, basis, "sine", "normal");
    Method method = laws::coulomb;
    const mechanics::Model cold = model_of(scene, method);
    method.heat = {{"conductance", 1.0}, {"friction", json::object()}};
    const mechanics::Model warm = model_of(scene, method);
    LawElements e = draw(random, scene, warm, 40, 0.05);
    LawResults hot, plain;
    evaluate_near(warm.handle(), e, ENTS_RESIDUAL | ENTS_TANGENT | ENTS_FLAGS | ENTS_STATE | ENTS_GAP, hot);
    const ents_layout with = e.layout;
    e.layout = layout_of(cold.handle());
    const auto n = static_cast<std::size_t>(e.layout.dofs), all = static_cast<std::size_t>(with.dofs),
               d = static_cast<std::size_t>(with.dimension);
    for (std::size_t i = 0; i < 40; ++i) { // one by one, as elements with heat are
      const LawElements single = part(e, static_cast<std::int64_t>(i), 1);
      evaluate_near(cold.handle(), single, ENTS_RESIDUAL | ENTS_TANGENT | ENTS_FLAGS | ENTS_STATE | ENTS_GAP,
                    plain);
      const auto place = [d](std::size_t dof) { return dof / d * (d + 1) + dof % d; };
      for (std::size_t row = 0; row < n; ++row) {
        ASSERT_EQ(plain.residual[row], hot.residual[i * all + place(row)]) << basis.name;
        for (std::size_t column = 0; column < n; ++column)
          ASSERT_EQ(plain.tangent[column * n + row],
                    hot.tangent[(i * all + place(column)) * all + place(row)]);
      }
    }
  }
}

TEST(Heat, NamesWhatIsWrong) {
  const auto refused = [](const json& heat, const std::string& words, const json& friction = nullptr) {
    try {
      make(text_of(heat, friction));
      ADD_FAILURE() << heat << " is taken";
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  refused({{"conductance", -1.0}}, "/contact/heat/conductance");
  refused(json::object(), "/contact/heat: is empty");
  refused({{"gas", {{"conductivity", 1.0}, {"jump", 0.0}}}}, "/contact/heat/gas/jump");
  refused({{"table", {{"pressures", {0, 1, 1}}, {"conductances", {1, 2, 3}}}}},
          "/contact/heat/table/pressures/2");
  refused({{"table", {{"pressures", {1, 2}}, {"conductances", {1, 2}}}}}, "a table begins at 0");
  refused({{"clearance", {{"gaps", {0, 1}}, {"conductances", {2, 1}}}}}, "the last one is 0");
  refused({{"friction", json::object()}}, "needs friction");
  refused({{"friction", {{"slave", 1.5}}}}, "/contact/heat/friction/slave", coulomb);
  refused({{"radiation", 1.0}}, "/contact/heat/radiation");

  const Handle model = make(text_of({{"conductance", 1.0}, {"friction", json::object()}}, coulomb));
  const double slave[2] = {0.0, -0.01}, master[4] = {-1, 0, 1, 0}, temperature[2] = {1, 2},
               nan = std::nan("");
  double residual[9];
  ents_input in{};
  in.struct_size = sizeof in, in.slave = slave, in.master = master;
  ents_output out{};
  out.struct_size = sizeof out, out.wanted = ENTS_RESIDUAL, out.residual = residual;
  const auto says = [&](std::int32_t status, const std::string& words) {
    ents_report report = mechanics::new_report();
    EXPECT_EQ(ents_evaluate(model.get(), 0, 1, &in, &out, &report), status);
    EXPECT_NE(std::string(report.message).find(words), std::string::npos) << report.message;
  };
  says(ENTS_NULL_ARGUMENT, "input.slave_temperature");
  in.slave_temperature = temperature;
  says(ENTS_NULL_ARGUMENT, "input.master_temperature");
  in.master_temperature = temperature;
  says(ENTS_BAD_VALUE, "input.time_increment");
  in.time_increment = 0.1;
  says(ENTS_OK, "");
  in.slave_temperature = &nan;
  says(ENTS_NON_FINITE, "input.slave_temperature[0]");
  // A part of the whole, also where a parameter stands for it
  const Handle named =
      make(text_of({{"friction", {{"share", "k"}}}}, coulomb, {{"parameters", {{"k", 0.5}}}}));
  ents_model* bound = nullptr;
  for (const double share : {-0.1, 1.1})
    EXPECT_EQ(ents_model_bind(named.get(), &share, nullptr, 0, &bound, nullptr), ENTS_BAD_VALUE) << share;
  EXPECT_EQ(bound, nullptr);
  const double share = 0.25;
  EXPECT_EQ(ents_model_bind(named.get(), &share, nullptr, 0, &bound, nullptr), ENTS_OK);
  const Handle owned(bound);
  Point quarter(text_of({{"friction", {{"share", 0.25}}}}, coulomb)),
      whole(text_of({{"friction", json::object()}}, coulomb));
  for (Point* point : {&quarter, &whole})
    for (const double x : {0.0, 0.1}) {
      ASSERT_EQ(point->evaluate(x, -0.02), ENTS_OK);
      point->commit();
    }
  EXPECT_GT(whole.heat[1], 0.0);
  EXPECT_NEAR(quarter.heat[1], 0.25 * whole.heat[1], 1e-15);
  const Handle cold = make(text_of(nullptr, coulomb));
  ents_report report = mechanics::new_report();
  EXPECT_EQ(ents_evaluate(cold.get(), 0, 1, &in, &out, &report), ENTS_BAD_VALUE);
  EXPECT_NE(std::string(report.message).find("input.slave_temperature"), std::string::npos) << report.message;
  in.slave_temperature = in.master_temperature = nullptr;
  out.wanted = ENTS_HEAT;
  EXPECT_EQ(ents_evaluate(cold.get(), 0, 1, &in, &out, &report), ENTS_BAD_MASK);
}

} // namespace
} // namespace laws::heat_test
