// SPDX-License-Identifier: BSD-3-Clause
// Heights that are functions, where they have no value, or no finite derivatives.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "support/model.hpp"

namespace undefined_height_test {
namespace {

using namespace test;

// 0.05 sin(2 s), which fails beyond a limit, with any third derivative
struct Function {
  double limit, third;
  static int32_t height(void* user_data, int32_t order, int32_t count, const double* s, double* jet) {
    const Function& f = *static_cast<const Function*>(user_data);
    for (int32_t n = 0; n < count; ++n) {
      if (s[n] > f.limit) return 1;
      const double x = 2.0 * s[n],
                   of[] = {0.05 * std::sin(x), 0.1 * std::cos(x), -0.2 * std::sin(x), f.third};
      for (int32_t k = 0; k <= order; ++k) jet[k * count + n] = of[k];
    }
    return 0;
  }
  void enlist() {
    ASSERT_EQ(call::height_register("undefined", int32_t{1}, &height, static_cast<void*>(this),
                                    static_cast<ents_report*>(nullptr)),
              ENTS_OK);
  }
  ~Function() {
    call::height_register("undefined", int32_t{1}, static_cast<ents_height_function>(nullptr),
                          static_cast<void*>(nullptr), static_cast<ents_report*>(nullptr));
  }
};
const std::string callback =
    R"({"type": "callback", "name": "undefined", "bound": 0.06, "slope": 0.11, "curvature": 0.21})";

std::string with_height(const std::string& basis, const std::string& height, const std::string& more = "") {
  return R"({"segment": ")" + basis + R"(", "height": )" + height +
         R"(, "contact": {"normal": {"type": "penalty", "stiffness": 1000})" + more + "}}";
}
std::string expression(const std::string& text) { return R"({"type": "expression", "h": ")" + text + "\"}"; }

// Where a height has no value, or no finite derivatives, no projection is found, and the report says where.
// (It was taken for a collapsed segment.)
TEST(UndefinedHeight, IsNoDegenerateSegment) {
  Function function{-10.0, 0.0};
  function.enlist();
  const struct {
    std::string height;
    double x;
  } cases[] = {{expression("log(u)"), -0.5},
               {expression("sqrt(u)"), -0.5},
               {expression("0.1*sqrt(u)"), 0.0},
               {expression("sqrt(-1 - u^2)"), 0.3},
               {callback, 0.3}};
  for (const auto& c : cases) {
    const Model model(with_height("line2", c.height));
    const double slave[] = {c.x, -0.01}, master[] = {-1, 0, 1, 0};
    for (const bool with_start : {false, true})
      for (const int64_t count : {int64_t{1}, int64_t{3}}) {
        double gap[3];
        int32_t status[3];
        ents_input in{};
        in.struct_size = sizeof in;
        const double slaves[] = {slave[0], slave[1], slave[0], slave[1], slave[0], slave[1]},
                     starts[] = {c.x, c.x, c.x};
        std::vector<double> masters;
        for (int i = 0; i < 3; ++i) masters.insert(masters.end(), master, master + 4);
        in.slave = slaves, in.slave_stride = 2, in.master = masters.data(), in.master_stride = 4;
        if (with_start) in.start = starts, in.start_stride = 1;
        ents_output out{};
        out.struct_size = sizeof out;
        out.wanted = ENTS_GAP;
        out.gap = gap, out.gap_stride = 1, out.status = status, out.status_stride = 1;
        ents_report report = new_report();
        EXPECT_EQ(call::evaluate(model.get(), int64_t{0}, count, &in, &out, &report), ENTS_NO_PROJECTION)
            << c.height << " " << report.message;
        EXPECT_EQ(status[count - 1], ENTS_NO_PROJECTION);
        EXPECT_NE(std::string(report.message)
                      .find("element 0: the height has no value, or no finite derivatives, at s = ("),
                  std::string::npos)
            << c.height << " " << report.message;
      }
    double point[2];
    ents_surface surface{};
    surface.struct_size = sizeof surface;
    surface.master = master, surface.xi = &c.x, surface.point = point;
    EXPECT_EQ(call::surface_evaluate(model.get(), int64_t{1}, &surface, static_cast<ents_report*>(nullptr)),
              ENTS_NO_PROJECTION)
        << c.height;
  }
}

// Checks name a height that has no value anywhere; where it has one on a part, that part is checked, and the rest
// is a fold.
TEST(UndefinedHeight, IsNamedByTheChecks) {
  const double master[] = {-1, 0, 1, 0};
  const int64_t connectivity[] = {0, 1};
  ents_master_mesh mesh{};
  mesh.struct_size = sizeof mesh;
  mesh.segments = 1, mesh.nodes = 2, mesh.connectivity = connectivity, mesh.positions = master;
  const struct {
    const char* height;
    bool somewhere;
  } cases[] = {{"sqrt(-1 - u^2)", false}, {"log(u - 2)", false}, {"sqrt(u)", true}, {"log(u)", true}};
  for (const auto& c : cases) {
    const Model model(with_height("line2", expression(c.height)));
    const int32_t expected = c.somewhere ? ENTS_OK : ENTS_NO_PROJECTION;
    const auto is_named = [&](const ents_report& report) {
      EXPECT_EQ(c.somewhere, std::string(report.message).find("at s = (0)") == std::string::npos)
          << c.height << " " << report.message;
    };
    ents_admissibility of_segment{};
    of_segment.struct_size = sizeof of_segment;
    ents_report report = new_report();
    EXPECT_EQ(
        call::model_check(model.get(), master, static_cast<const double*>(nullptr), &of_segment, &report),
        expected)
        << c.height << " " << report.message;
    is_named(report);
    ents_surface_admissibility of_surface{};
    of_surface.struct_size = sizeof of_surface;
    report = new_report();
    EXPECT_EQ(call::surface_check(model.get(), &mesh, &of_surface, &report), expected)
        << c.height << " " << report.message;
    is_named(report);
    if (!c.somewhere) continue;
    EXPECT_NE(of_surface.violated & (1 << ENTS_CHECK_FOLD), 0) << c.height;
    EXPECT_LT(of_surface.height_min, of_surface.height_max) << c.height;
    EXPECT_TRUE(std::isfinite(of_surface.height_min) && std::isfinite(of_segment.height_max)) << c.height;
  }
}

// Tangents with friction have third derivatives. Where one is NaN or infinite, the element has no projection:
// nothing is written. (Its tangent was NaN, with status 0.)
TEST(UndefinedHeight, ThirdDerivativesDecideWhereTangentsHaveThem) {
  const std::string laws[] = {
      R"({"normal": {"type": "penalty", "stiffness": 1000}, "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 50}})",
      R"({"normal": {"type": "exponential", "pressure": 1, "clearance": 0.05}, "friction": {"type": "rough", "stiffness": 50}})",
      R"({"normal": {"type": "penalty", "stiffness": 1000}})"};
  for (const double third :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -0.4})
    for (const std::string& law : laws) {
      Function function{10.0, third};
      function.enlist();
      const Model model(R"({"segment": "line2", "height": )" + callback + R"(, "contact": )" + law + "}");
      const bool bad = !std::isfinite(third) && law.find("friction") != std::string::npos;
      for (const int64_t count : {int64_t{1}, int64_t{9}}) {
        const auto n = static_cast<std::size_t>(count),
                   size = static_cast<std::size_t>(model.layout.state_size);
        std::vector<double> slave, master, start(n, 0.1), state(n * size), end(n * size),
            tangent(36 * n, -7.0);
        std::vector<int32_t> status(n);
        ASSERT_EQ(ents_state_init(model.get(), count, state.data(), model.layout.state_size, nullptr),
                  ENTS_OK);
        for (std::size_t e = 0; e < n; ++e) {
          slave.insert(slave.end(), {0.1, -0.02});
          master.insert(master.end(), {-1, 0, 1, 0});
        }
        ents_input in{};
        in.struct_size = sizeof in;
        in.slave = slave.data(), in.slave_stride = 2, in.master = master.data(), in.master_stride = 4;
        in.start = start.data(), in.start_stride = 1;
        in.state_begin = state.data(), in.state_begin_stride = model.layout.state_size;
        ents_output out{};
        out.struct_size = sizeof out;
        out.wanted = ENTS_TANGENT | ENTS_STATE;
        out.tangent = tangent.data(), out.tangent_stride = 36;
        out.state_end = end.data(), out.state_end_stride = model.layout.state_size;
        out.status = status.data(), out.status_stride = 1;
        ents_report report = new_report();
        EXPECT_EQ(call::evaluate(model.get(), int64_t{0}, count, &in, &out, &report),
                  bad ? ENTS_NO_PROJECTION : ENTS_OK)
            << law << " " << report.message;
        for (const int32_t one : status) EXPECT_EQ(one, bad ? ENTS_NO_PROJECTION : ENTS_OK);
        for (const double k : tangent) EXPECT_TRUE(bad ? k == -7.0 : std::isfinite(k)) << law << " " << k;
        for (const double x : end) EXPECT_TRUE(bad ? x == 0.0 : std::isfinite(x));
      }
    }
}

} // namespace
} // namespace undefined_height_test
