// Archard's wear within the element: closed forms of single points, order of the schemes, what open points
// keep, segments, and the volume that goes into fields. The tangent: tangent_test.cpp; bits:
// ordinary_elements_test.cpp.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>

#include "law_elements.hpp"
#include "worst.hpp"

namespace laws::wear_test {
namespace {

constexpr double eps = 100.0, k = 0.05;

json wear_of(const char* scheme, double slave = 1.0) {
  return {{"coefficient", k}, {"scheme", scheme}, {"slave", slave}, {"sliding", "s"}};
}

// A slave node above a flat line from -1 to 1, at a height that is given; slides by the named parameter "s"
// without moving.
class Point {
public:
  explicit Point(const json& normal, const json& wear, const json& height = nullptr,
                 const json& friction = nullptr) {
    const json text = {{"segment", "line2"},
                       {"parameters", {{"s", 0.0}}},
                       {"height", height},
                       {"contact", {{"normal", normal}, {"wear", wear}, {"friction", friction}}}};
    model_ = std::make_unique<mechanics::Model>(text.dump());
    layout_ = layout_of(model_->handle());
    slide(0.0);
    begin_.resize(static_cast<std::size_t>(layout_.state_size));
    end_ = begin_;
    ents_state_init(model_->handle(), 1, begin_.data(), layout_.state_size, nullptr);
  }
  ~Point() { ents_model_destroy(&bound_, nullptr); }
  Point(const Point&) = delete;

  // Sliding of the next increments
  void slide(double s) {
    ASSERT_EQ(ents_model_bind(model_->handle(), &s, nullptr, 0, &bound_, nullptr), ENTS_OK);
  }
  void evaluate(double x, double y) {
    const double slave[2] = {x, y}, master[4] = {-1, 0, 1, 0}, start = x;
    std::int32_t flags;
    ents_input in{};
    in.struct_size = sizeof in, in.slave = slave, in.master = master, in.start = &start,
    in.state_begin = begin_.data();
    ents_output out{};
    out.struct_size = sizeof out, out.wanted = ENTS_PRESSURE | ENTS_STATE | ENTS_FLAGS | ENTS_RESIDUAL;
    out.pressure = &pressure, out.state_end = end_.data(), out.flags = &flags, out.residual = residual;
    ASSERT_EQ(ents_evaluate(bound_, 0, 1, &in, &out, nullptr), ENTS_OK);
  }
  void commit() { begin_ = end_; }
  double worn(int side) const { return end_[static_cast<std::size_t>(layout_.worn + side)]; }

  double pressure = 0.0, residual[6];
  std::vector<double> begin_, end_;
  ents_layout layout_{};
  ents_model* bound_ = nullptr;

private:
  std::unique_ptr<mechanics::Model> model_;
};

const json penalty = {{"type", "penalty"}, {"stiffness", eps}};

// p = eps (-g - w_n) / (1 + eps k ds) and w = w_n + k p ds, to a few roundings.
TEST(Wear, ImplicitPenaltyHasItsClosedForm) {
  Point point(penalty, wear_of("implicit"));
  const double depth = 0.03;
  point.evaluate(0.2, -depth);
  EXPECT_NEAR(point.pressure, eps * depth, 1e-14);
  point.commit();
  double worn = 0.0;
  for (const double s : {0.01, 0.5, 3.0, 1000.0}) {
    point.slide(s);
    point.evaluate(0.2, -depth);
    const double p = eps * (depth - worn) / (1.0 + eps * k * s);
    worn += k * p * s;
    EXPECT_NEAR(point.pressure, p, 1e-13 * eps * depth);
    EXPECT_NEAR(point.worn(0), worn, 1e-15);
    EXPECT_NEAR(point.residual[1], -p, 1e-13 * eps * depth);
    point.commit();
  }
}

// The slave's own way along the segment counts: 0.3 to the right, then 0.1 to the left.
TEST(Wear, SlipOnTheSegmentWears) {
  Point point(penalty, wear_of("implicit"));
  point.evaluate(-0.2, -0.03);
  point.commit();
  double worn = 0.0, at = -0.2;
  for (const double x : {0.1, 0.0}) {
    point.evaluate(x, -0.03);
    const double s = std::fabs(x - at), p = eps * (0.03 - worn) / (1.0 + eps * k * s);
    worn += k * p * s, at = x;
    EXPECT_NEAR(point.worn(0), worn, 1e-15);
    point.commit();
  }
}

// At a constant place dp/ds = - eps k p: p = p_0 exp(- eps k s). Errors of a slid length of 1 / (eps k) in n
// increments.
TEST(Wear, SchemesHaveTheirOrder) {
  const double depth = 0.03, length = 1.0 / (eps * k), exact = eps * depth * std::exp(-1.0);
  for (const auto& [scheme, order] : {std::pair{"implicit", 1.0}, {"explicit", 1.0}, {"trapezoidal", 2.0}}) {
    double before = 0.0;
    for (const int n : {32, 64, 128}) {
      Point point(penalty, wear_of(scheme));
      point.evaluate(0.0, -depth);
      point.commit();
      point.slide(length / n);
      for (int i = 0; i < n; ++i) {
        point.evaluate(0.0, -depth);
        point.commit();
      }
      const double error = std::fabs(point.pressure / exact - 1.0);
      if (before > 0.0) {
        EXPECT_NEAR(std::log2(before / error), order, 0.03) << scheme << " " << n;
      }
      before = error;
    }
  }
}

// The other laws: p is the law's own pressure at g + w, whatever the slid length.
TEST(Wear, PressureIsThatOfTheLawAtTheWornGap) {
  const json laws[] = {{{"type", "power"}, {"coefficient", 400.0}, {"exponent", 1.5}},
                       {{"type", "power"}, {"coefficient", 1e7}, {"exponent", 4.5}},
                       {{"type", "exponential"}, {"pressure", 0.5}, {"clearance", 0.001}}};
  for (const json& law : laws)
    for (const double s : {1e-6, 0.01, 1.0, 100.0, 1e8}) {
      Point point(law, wear_of("implicit")), still(law, {{"coefficient", 0}, {"sliding", "s"}});
      for (int i = 0; i < 2; ++i, point.commit()) {
        point.evaluate(0.1, -0.03);
        point.slide(s);
      }
      point.evaluate(0.1, -0.03);
      still.evaluate(0.1, -0.03 + point.worn(0));
      EXPECT_NEAR(still.pressure, point.pressure, 1e-9 * (point.pressure + 1.0)) << law << " " << s;
      EXPECT_GT(point.pressure, 0.0);
    }
}

// The sides share the depth exactly, and its sum does not depend on the shares.
TEST(Wear, SidesShareTheDepth) {
  double whole = 0.0;
  for (const double slave : {1.0, 0.25, 0.0}) {
    Point point(penalty, wear_of("implicit", slave));
    point.evaluate(0.2, -0.03);
    point.slide(0.4);
    for (int i = 0; i < 5; ++i) {
      point.commit();
      point.evaluate(0.2, -0.03);
    }
    const double sum = point.worn(0) + point.worn(1);
    EXPECT_NEAR(point.worn(0), slave * sum, 1e-16);
    if (slave == 1.0) whole = sum;
    EXPECT_NEAR(sum, whole, 1e-15);
  }
}

// A node that lifts off, or has no segment, keeps what it has lost.
TEST(Wear, OpenPointsKeepTheirDepth) {
  Point point(penalty, wear_of("implicit", 0.5));
  point.evaluate(0.2, -0.03);
  point.commit();
  point.slide(0.4);
  point.evaluate(0.2, -0.03);
  point.commit();
  const double worn = point.worn(0);
  EXPECT_GT(worn, 0.005);
  point.evaluate(0.2, 0.5);
  EXPECT_EQ(point.worn(0), worn);
  point.evaluate(7.0, -0.03); // beside the segment
  EXPECT_EQ(point.worn(0), worn);
  const std::int64_t connectivity[2] = {0, 1}, none = -1;
  const double positions[4] = {-1, 0, 1, 0}, slave[2] = {0, 1};
  ents_master_mesh mesh{};
  mesh.struct_size = sizeof mesh, mesh.segments = 1, mesh.connectivity = connectivity, mesh.nodes = 2,
  mesh.positions = positions;
  std::vector<double> end(point.begin_.size());
  double residual[2] = {};
  const std::int64_t equations[4] = {-1, -1, -1, -1};
  ents_input in{};
  in.struct_size = sizeof in, in.slave = slave, in.mesh = &mesh, in.segment = &none,
  in.state_begin = point.begin_.data();
  ents_output out{};
  out.struct_size = sizeof out, out.wanted = ENTS_STATE, out.state_end = end.data();
  ents_system system{};
  system.struct_size = sizeof system, system.index_size = 8, system.slave_nodes = 1,
  system.slave_equations = equations;
  system.master_nodes = 2, system.master_equations = equations, system.rows = 0, system.residual = residual;
  ASSERT_EQ(ents_assemble(point.bound_, 0, 1, &in, &out, &system, nullptr), ENTS_OK);
  EXPECT_EQ(end[static_cast<std::size_t>(point.layout_.worn)], worn);
}

// With friction the force of the limit is that of the worn pressure, and wears by all of the slip.
TEST(Wear, FrictionFollowsTheWornPressure) {
  const json friction = {{"type", "coulomb"}, {"coefficient", 0.3}, {"stiffness", 1e6}};
  Point point(penalty, wear_of("implicit"), nullptr, friction);
  point.evaluate(0.0, -0.03);
  point.commit();
  point.evaluate(0.2, -0.03);
  const double p = eps * 0.03 / (1.0 + eps * k * 0.2);
  EXPECT_NEAR(point.pressure, p, 1e-13);
  EXPECT_NEAR(point.residual[0], 0.3 * p, 1e-9);
}

// Sliding over a row of n segments of one straight line: worn as on one segment.
TEST(Wear, DoesNotDependOnTheSegments) {
  const mechanics::Model model(
      json{{"segment", "line2"}, {"contact", {{"normal", penalty}, {"wear", {{"coefficient", k}}}}}}.dump());
  const ents_layout layout = layout_of(model.handle());
  double whole = 0.0;
  for (const int n : {1, 4, 16}) {
    const double length = 2.0 / n;
    std::vector<double> state(static_cast<std::size_t>(layout.state_size)), end(state.size());
    ents_state_init(model.handle(), 1, state.data(), layout.state_size, nullptr);
    int at = 0;
    for (int step = 0; step <= 40; ++step) {
      const double x = -0.97 + step * 0.0485, slave[2] = {x, -0.03};
      const int segment = std::min(n - 1, static_cast<int>((x + 1.0) / length));
      const auto nodes = [&](int i) {
        return std::array{-1.0 + i * length, 0.0, -1.0 + (i + 1) * length, 0.0};
      };
      const auto here = nodes(segment), before = nodes(at);
      if (segment != at) {
        ASSERT_EQ(ents_state_transfer(model.handle(), before.data(), nullptr, here.data(), nullptr,
                                      state.data(), end.data(), nullptr),
                  ENTS_OK);
        state = end;
      }
      at = segment;
      const double start = 2.0 * (x - here[0]) / length - 1.0;
      ents_input in{};
      in.struct_size = sizeof in, in.slave = slave, in.master = here.data(), in.start = &start,
      in.state_begin = state.data();
      ents_output out{};
      out.struct_size = sizeof out, out.wanted = ENTS_STATE, out.state_end = end.data();
      ASSERT_EQ(ents_evaluate(model.handle(), 0, 1, &in, &out, nullptr), ENTS_OK);
      state = end;
    }
    const double worn = state[static_cast<std::size_t>(layout.worn)];
    if (n == 1) whole = worn;
    EXPECT_NEAR(worn, whole, 1e-13) << n;
  }
  EXPECT_GT(whole, 0.02);
}

// What the states of the master side have lost is what the field loses: sum of depth x area, exactly; once.
TEST(Wear, FieldsLoseTheVolumeOfTheStates) {
  mechanics::Random random(21);
  for (const char* boundary : {"periodic", "clamped"})
    for (const bool space : {false, true}) {
      const json points = space ? json{16, 12} : json{16}, size = space ? json{2.0, 2.0} : json{2.0},
                 origin = space ? json{-1.0, -1.0} : json{-1.0};
      const json text = {{"segment", space ? "quad4" : "line2"},
                         {"height",
                          {{"type", "field"},
                           {"name", "worn"},
                           {"points", points},
                           {"boundary", boundary},
                           {"size", size},
                           {"origin", origin}}},
                         {"contact", {{"normal", penalty}, {"wear", {{"coefficient", k}, {"slave", 0.25}}}}}};
      const mechanics::Model model(text.dump());
      const ents_layout layout = layout_of(model.handle());
      const auto d = static_cast<std::size_t>(layout.dimension),
                 block_size = static_cast<std::size_t>(layout.state_size);
      const double lines[4] = {-1.5, 0, 1.5, 0}, quads[12] = {-1.5, -1, 0, 1.5, -1, 0, 1.5, 1, 0, -1.5, 1, 0};
      constexpr std::size_t count = 50;
      std::vector<double> slave(count * d), area(count), state(count * block_size);
      ents_state_init(model.handle(), count, state.data(), layout.state_size, nullptr);
      double lost = 0.0;
      for (std::size_t e = 0; e < count; ++e) {
        double* own = &state[e * block_size];
        own[1] = 2.0;
        for (std::size_t a = 0; a + 1 < d; ++a) own[3 + a] = random.uniform(-1.0, 1.0);
        own[layout.worn] = 0.01;
        lost += (own[layout.worn + 1] = random.uniform(0.0, 1e-3)) * (area[e] = random.uniform(0.1, 1.0));
      }
      std::int64_t length = 0;
      ASSERT_EQ(ents_field_size(model.handle(), "worn", &length, nullptr), ENTS_OK);
      std::vector<double> block(static_cast<std::size_t>(length));
      ASSERT_EQ(ents_field_init(model.handle(), "worn", nullptr, block.data(), length, nullptr), ENTS_OK);
      ents_data field{};
      field.struct_size = sizeof field, field.name = "worn", field.values = block.data(), field.rows = 1,
      field.columns = length;
      ents_model* bound = nullptr;
      ASSERT_EQ(ents_model_bind(model.handle(), nullptr, &field, 1, &bound, nullptr), ENTS_OK);
      ents_input in{};
      in.struct_size = sizeof in, in.slave = slave.data(), in.slave_stride = static_cast<std::int64_t>(d),
      in.master = space ? quads : lines;
      in.area = area.data(), in.area_stride = 1;
      const double thickness = 0.7;
      double volume = 0.0;
      const std::vector<double> before = state;
      ASSERT_EQ(ents_wear_collect(bound, 0, count, &in, thickness, state.data(), layout.state_size, "worn",
                                  block.data(), length, &volume, nullptr),
                ENTS_OK);
      EXPECT_NEAR(volume, lost, 1e-14);
      for (std::size_t e = 0; e < count; ++e)
        for (std::size_t i = 0; i < block_size; ++i)
          EXPECT_EQ(state[e * block_size + i],
                    i == static_cast<std::size_t>(layout.worn) + 1 ? 0.0 : before[e * block_size + i]);
      // the integral of the field over the segment, whose length is 1.5 per unit of s: Simpson's rule is
      // exact for cubics in each cell
      const int cells = std::string(boundary) == "periodic" ? 16 : 15,
                rows = std::string(boundary) == "periodic" ? 12 : 11;
      double integral = 0.0;
      const auto simpson = [](int i, int n) { return i == 0 || i == 2 * n ? 1.0 : i % 2 ? 4.0 : 2.0; };
      for (int j = 0; j <= (space ? 2 * rows : 0); ++j)
        for (int i = 0; i <= 2 * cells; ++i) {
          const double s[2] = {-1.0 + static_cast<double>(i) / cells, -1.0 + static_cast<double>(j) / rows};
          double h = 0.0;
          ASSERT_EQ(ents_field_sample(model.handle(), "worn", block.data(), length, 1, s, &h, nullptr),
                    ENTS_OK);
          integral += h * simpson(i, cells) * (space ? simpson(j, rows) / (6.0 * rows) * 2.0 : 1.0) /
                      (6.0 * cells) * 2.0;
        }
      EXPECT_NEAR(-integral * 1.5 * (space ? 1.0 : thickness), lost, 1e-12) << boundary << " " << space;
      const std::vector<double> once = block;
      ASSERT_EQ(ents_wear_collect(bound, 0, count, &in, thickness, state.data(), layout.state_size, "worn",
                                  block.data(), length, &volume, nullptr),
                ENTS_OK);
      EXPECT_EQ(volume, 0.0);
      for (std::size_t i = 4; i < block.size(); ++i) EXPECT_EQ(block[i], once[i]);
      ents_model_destroy(&bound, nullptr);
    }
}

} // namespace
} // namespace laws::wear_test
