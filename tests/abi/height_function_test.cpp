// SPDX-License-Identifier: BSD-3-Clause
// Heights that are functions, through the library: those of the host (ents_height_register) and expressions.
// They are the built-in heights again, their tangents are those of differences, blocks of elements have the
// bits of single ones, and searches find what a sweep finds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sample_count.hpp"
#include "support/element.hpp"

namespace height_function_test {
namespace {

using namespace test;

constexpr double pi = 3.14159265358979323846;

// a sin(2 pi (k_1 s_1 + k_2 s_2)); undefined above `limit`
struct Wave {
  int32_t dimension;
  double amplitude, k[2], limit = 1e300;
};
int32_t wave_height(void* user_data, int32_t order, int32_t count, const double* s, double* jet) {
  const Wave& w = *static_cast<const Wave*>(user_data);
  for (int32_t n = 0; n < count; ++n) {
    double x = 0.0;
    for (int a = 0; a < w.dimension; ++a) x += 2.0 * pi * w.k[a] * s[a * count + n];
    if (s[n] > w.limit) return 1;
    const double f[4] = {w.amplitude * std::sin(x), w.amplitude * std::cos(x), -w.amplitude * std::sin(x),
                         -w.amplitude * std::cos(x)};
    int at = 0;
    for (int d = 0; d <= order; ++d)
      for (int j = 0; j <= (w.dimension == 1 ? 0 : d); ++j)
        jet[at++ * count + n] = f[d] * std::pow(2.0 * pi * w.k[0], d - j) * std::pow(2.0 * pi * w.k[1], j);
  }
  return 0;
}

const char* const contact = R"(, "contact": {"normal": {"type": "penalty", "stiffness": 1000}}})";
std::string with_height(const std::string& basis, const std::string& height) {
  return R"({"segment": ")" + basis + R"(", "height": )" + height + contact;
}

std::string expression(const std::string& text, const std::string& more = "") {
  return R"({"type": "expression", "h": ")" + text + "\"" + more + "}";
}

int32_t register_wave(const char* name, Wave& wave) {
  return call::height_register(name, wave.dimension, &wave_height, static_cast<void*>(&wave),
                               static_cast<ents_report*>(nullptr));
}

class HeightFunction : public ::testing::Test {
protected:
  // Registered for the time of a test: names live as long as the process.
  void SetUp() override {
    ASSERT_EQ(register_wave("wave", line_), ENTS_OK);
    ASSERT_EQ(register_wave("wave", surface_), ENTS_OK);
  }
  void TearDown() override {
    for (const int32_t dimension : {1, 2})
      call::height_register("wave", dimension, static_cast<ents_height_function>(nullptr),
                            static_cast<void*>(nullptr), static_cast<ents_report*>(nullptr));
  }
  Wave line_{1, 0.03, {0.8, 0.0}}, surface_{2, 0.03, {0.8, 0.5}};

  static std::string built_in(bool line) {
    return std::string(R"({"type": "sine", "amplitude": 0.03, "wave_vector": )") +
           (line ? "[0.8]}" : "[0.8, 0.5]}");
  }
  static std::string
  callback(const std::string& more = R"(, "bound": 0.03, "slope": 0.16, "curvature": 0.8)") {
    return R"({"type": "callback", "name": "wave")" + more + "}";
  }
  static std::string written(bool line) {
    return expression(std::string("a*sin(2*pi*(0.8*u") + (line ? "" : " + 0.5*v") + "))",
                      R"(, "constants": {"a": 0.03})");
  }
};

TEST_F(HeightFunction, IsTheBuiltInHeight) {
  Random random(1);
  for (const char* name : {"line2", "line3", "tri3", "quad4", "quad9", "bspline16"}) {
    const bool line = basis(name).dimension == 2;
    const Model sine(with_height(name, built_in(line)));
    for (const std::string& height : {callback(), written(line)}) {
      const Model model(with_height(name, height));
      EXPECT_EQ(model.layout.needs, sine.layout.needs);
      for (int n = 0; n < 50; ++n) {
        Element e = draw(sine, basis(name), random);
        if (n % 2) e[start].clear(); // a search
        Results a(sine.layout), b(model.layout);
        ents_report report = new_report();
        ASSERT_EQ(test::evaluate(sine, e, want_all, a, &report), ENTS_OK) << report.message;
        ASSERT_EQ(test::evaluate(model, e, want_all, b, &report), ENTS_OK) << report.message << "\n"
                                                                           << height;
        EXPECT_EQ(a.flags, b.flags);
        for (int i = 0; i < output_count; ++i) {
          double size = 0.0;
          for (const double x : a[i]) size = std::max(size, std::fabs(x));
          for (std::size_t k = 0; k < a[i].size(); ++k)
            EXPECT_NEAR(a[i][k], b[i][k], 1e-9 * size + 1e-13)
                << outputs[i].name << " with " << height; // projections converge to 1e-13
        }
      }
    }
  }
}

TEST_F(HeightFunction, TangentsAreThoseOfDifferences) {
  Random random(2);
  for (const char* name : {"line2", "line3", "tri3", "quad4", "quad8"}) {
    const bool line = basis(name).dimension == 2;
    for (const std::string& height :
         {callback(), test::height("expression", line ? 2 : 3), test::height("window", line ? 2 : 3)}) {
      const Model model(with_height(name, height));
      const auto dofs = static_cast<std::size_t>(model.layout.dofs),
                 d = static_cast<std::size_t>(model.layout.dimension);
      for (int n = 0; n < 10; ++n) {
        Element e = draw(model, basis(name), random, -0.05, -0.01);
        Results at(model.layout);
        ASSERT_EQ(test::evaluate(model, e, want_all, at), ENTS_OK);
        double worst[2] = {};
        for (std::size_t j = 0; j < dofs; ++j) {
          double& x = j < d ? e[slave][j] : e[master][j - d];
          const double kept = x;
          for (const int half : {0, 1}) {
            const double step = half ? 5e-4 : 1e-3;
            Results low(model.layout), high(model.layout);
            x = kept - step;
            ASSERT_EQ(test::evaluate(model, e, want_element, low), ENTS_OK);
            x = kept + step;
            ASSERT_EQ(test::evaluate(model, e, want_element, high), ENTS_OK);
            x = kept;
            for (std::size_t i = 0; i < dofs; ++i)
              worst[half] =
                  std::max(worst[half],
                           std::fabs((high.of(ENTS_RESIDUAL)[i] - low.of(ENTS_RESIDUAL)[i]) / (2.0 * step) -
                                     at.of(ENTS_TANGENT)[j * dofs + i]));
          }
        }
        // central differences: a quarter of the error with half of the step, down to what rounding leaves
        EXPECT_TRUE(worst[1] < 0.3 * worst[0] || worst[1] < 1e-7)
            << name << " " << height << ": " << worst[0] << " -> " << worst[1];
      }
    }
  }
}

TEST_F(HeightFunction, BlocksHaveTheBitsOfSingleElements) {
  constexpr std::size_t count = 64;
  Random random(3);
  for (const char* name : {"line2", "line3", "tri3", "quad4", "quad9"}) {
    const bool line = basis(name).dimension == 2;
    for (const std::string& height : {callback(), written(line), test::height("expression", line ? 2 : 3)}) {
      const Model model(with_height(name, height));
      const auto dofs = static_cast<std::size_t>(model.layout.dofs);
      Element all;
      std::vector<Element> elements;
      for (std::size_t n = 0; n < count; ++n) {
        elements.push_back(draw(model, basis(name), random));
        elements[n][area] = {random(0.5, 2.0)}, elements[n][surface_coordinates].clear();
        for (int i = 0; i < input_count; ++i)
          all[i].insert(all[i].end(), elements[n][i].begin(), elements[n][i].end());
      }
      ents_input input = input_of(all);
      for (int i = 0; i < input_count; ++i)
        input.*inputs[i].stride = static_cast<int64_t>(elements[0][i].size());
      std::vector<double> residual(count * dofs), tangent(count * dofs * dofs);
      ents_output output{};
      output.struct_size = sizeof output;
      output.wanted = ENTS_RESIDUAL | ENTS_TANGENT;
      output.residual = residual.data(), output.residual_stride = static_cast<int64_t>(dofs);
      output.tangent = tangent.data(), output.tangent_stride = static_cast<int64_t>(dofs * dofs);
      ASSERT_EQ(call::evaluate(model.get(), int64_t{0}, static_cast<int64_t>(count), &input, &output,
                               static_cast<ents_report*>(nullptr)),
                ENTS_OK);
      for (std::size_t n = 0; n < count; ++n) {
        Results single(model.layout);
        ASSERT_EQ(test::evaluate(model, elements[n], ENTS_RESIDUAL | ENTS_TANGENT, single), ENTS_OK);
        ASSERT_EQ(std::memcmp(single.of(ENTS_RESIDUAL).data(), &residual[n * dofs], dofs * sizeof(double)), 0)
            << name << " " << height;
        ASSERT_EQ(std::memcmp(single.of(ENTS_TANGENT).data(), &tangent[n * dofs * dofs],
                              dofs * dofs * sizeof(double)),
                  0)
            << name;
      }
    }
  }
}

// Distance from the slave node to the closest of many points of the surface
double swept_distance(const Model& model, const Element& e, int per_line) {
  double least = 1e300;
  const int lines = model.layout.parameters == 1 ? 0 : per_line;
  for (int j = 0; j <= lines; ++j)
    for (int i = 0; i <= per_line; ++i) {
      const SurfacePoint p =
          surface_point(model, e, {2.0 * i / per_line - 1.0, lines ? 2.0 * j / lines - 1.0 : 0.0});
      double squared = 0.0;
      for (std::size_t k = 0; k < p.point.size(); ++k)
        squared += (p.point[k] - e[slave][k]) * (p.point[k] - e[slave][k]);
      least = std::min(least, squared);
    }
  return std::sqrt(least);
}

TEST_F(HeightFunction, SearchesFindWhatASweepFinds) {
  Random random(4);
  const std::pair<const char*, const char*> cases[] = {{"line2", "0.1*sin(9*u)*exp(-u^2)"},
                                                       {"line3", "0.05*cos(12*u)/(1 + 4*u^2)"},
                                                       {"line2", "0.2*tanh(5*sin(3*u))"},
                                                       {"quad4", "0.08*sin(5*u + 3*v)*cos(4*v)"},
                                                       {"quad8", "0.1*exp(-8*(u^2 + v^2)) + 0.03*sin(6*u)"},
                                                       {"quad4", "0.05*bump(u)*bump(v)*cos(9*u)"}};
  int searched = 0, certain = 0;
  for (const auto& [name, text] : cases) {
    const Model model(with_height(name, expression(text)));
    const int per_line = model.layout.parameters == 1 ? 4000 : 250,
              elements = static_cast<int>(samples(model.layout.parameters == 1 ? 60 : 12));
    for (int n = 0; n < elements; ++n) {
      Element e = draw(model, basis(name), random, -0.1, 0.3);
      e[start].clear();
      Results r(model.layout);
      const int32_t status = test::evaluate(model, e, ENTS_GAP | ENTS_XI | ENTS_POINT | ENTS_FLAGS, r);
      ++searched;
      if (status != ENTS_OK) continue; // said so: ambiguous, or no projection
      bool inside = true;
      for (const double xi : r.of(ENTS_XI)) inside = inside && std::fabs(xi) <= 1.0;
      if (!inside) continue;
      ++certain;
      double found = 0.0;
      for (std::size_t k = 0; k < r.of(ENTS_POINT).size(); ++k)
        found += std::pow(r.of(ENTS_POINT)[k] - e[slave][k], 2);
      const double swept = swept_distance(model, e, per_line);
      // The sweep's best point may lie on the border, where no projection is.
      if (swept < std::sqrt(found) - 1e-9) {
        Element near = e;
        double best = 1e300;
        for (int j = 0; j <= (model.layout.parameters == 1 ? 0 : 100); ++j)
          for (int i = 0; i <= 100; ++i) { // inside only
            std::vector<double> xi = {0.98 * (i / 50.0 - 1.0)};
            if (model.layout.parameters == 2) xi.push_back(0.98 * (j / 50.0 - 1.0));
            near[start] = xi;
            Results p(model.layout);
            if (test::evaluate(model, near, ENTS_POINT | ENTS_XI | ENTS_GAP, p) != ENTS_OK) continue;
            bool on = true;
            for (const double x : p.of(ENTS_XI)) on = on && std::fabs(x) <= 1.0;
            if (on) best = std::min(best, std::fabs(p.gap()));
          }
        EXPECT_LE(std::sqrt(found), best + 1e-9)
            << text << ": a projection from somewhere is closer than that of the search";
      }
    }
  }
  EXPECT_GT(certain, searched / 2) << "of " << searched;
}

TEST_F(HeightFunction, WithoutBoundsSearchesAreFlaggedAndStartsWork) {
  Random random(5);
  const Model sine(with_height("line2", built_in(true))), unknown(with_height("line2", callback("")));
  const Model slope_only(with_height("line2", callback(R"(, "bound": 0.03, "slope": 0.16)")));
  for (int n = 0; n < 20; ++n) {
    Element e = draw(sine, basis("line2"), random, -0.05, -0.01); // in contact: open ones are not refused
    for (const Model* model : {&unknown, &slope_only}) {
      Results expected(sine.layout), r(model->layout);
      ASSERT_EQ(test::evaluate(sine, e, want_all, expected), ENTS_OK);
      ASSERT_EQ(test::evaluate(*model, e, want_all, r), ENTS_OK);
      EXPECT_NEAR(r.gap(), expected.gap(), 1e-12);
      Element from_nowhere = e;
      from_nowhere[start].clear();
      ents_report report = new_report();
      const int32_t status = test::evaluate(*model, from_nowhere, want_all, r, &report);
      // with slopes alone a search can be proved where the other projections are far enough
      if (model == &unknown || status != ENTS_OK) {
        EXPECT_EQ(status, ENTS_AMBIGUOUS_PROJECTION) << report.message;
      } else {
        EXPECT_NEAR(r.gap(), expected.gap(), 1e-9);
      }
    }
  }
}

// A bound of |h| that does not hold, while the other bounds do: refused, or the answer of the right bound.
TEST_F(HeightFunction, WrongBoundsAreNoticedBySearches) {
  Random random(6);
  const Model wrong(with_height("line2", callback(R"(, "bound": 0.001, "slope": 0.16, "curvature": 0.8)")));
  const Model sine(with_height("line2", built_in(true)));
  int refused = 0;
  for (int n = 0; n < 40; ++n) {
    Element e = draw(sine, basis("line2"), random, -0.05, -0.01);
    e[start].clear();
    Results expected(sine.layout), r(wrong.layout);
    ASSERT_EQ(test::evaluate(sine, e, want_all, expected), ENTS_OK);
    const int32_t status = test::evaluate(wrong, e, want_all, r);
    refused += status == ENTS_AMBIGUOUS_PROJECTION;
    if (status != ENTS_AMBIGUOUS_PROJECTION) {
      EXPECT_NEAR(r.gap(), expected.gap(), 1e-12);
    }
  }
  EXPECT_GT(refused, 10);
}

TEST_F(HeightFunction, WhereItIsNotDefinedThereIsNoProjection) {
  Random random(7);
  Wave broken = line_;
  broken.limit = -2.0; // nowhere
  ASSERT_EQ(register_wave("broken", broken), ENTS_OK);
  const Model sine(with_height("line2", built_in(true)));
  for (const std::string& height :
       {std::string(
            R"({"type": "callback", "name": "broken", "bound": 0.03, "slope": 0.16, "curvature": 0.8})"),
        expression("log(u - 5)"), expression("0.1*sqrt(u - 3)")})
    for (const char* projection :
         {"", R"(, "projection": {"type": "shadow_direction", "direction": [0.1, 1]})"})
      for (const bool from_start : {true, false}) {
        const Model model(R"({"segment": "line2", "height": )" + height + projection + contact);
        Element e = draw(sine, basis("line2"), random);
        if (!from_start) e[start].clear();
        Results r(model.layout);
        ents_report report = new_report();
        const int32_t status = test::evaluate(model, e, want_all, r, &report);
        EXPECT_GT(status, 0) << height << projection << from_start;
      }
  call::height_register("broken", 1, static_cast<ents_height_function>(nullptr), static_cast<void*>(nullptr),
                        static_cast<ents_report*>(nullptr));
}

// A pole in the middle of the segment: whatever is found in contact, a search says that it is not certain.
TEST_F(HeightFunction, SearchesOfHeightsWithPolesAreFlagged) {
  Random random(8);
  const Model plain(with_height("line2", "null")), model(with_height("line2", expression("0.001/u")));
  for (int n = 0; n < 20; ++n) {
    Element e = draw(plain, basis("line2"), random, -0.05, -0.02);
    e[start].clear();
    Results r(model.layout);
    EXPECT_GT(test::evaluate(model, e, want_all, r), 0);
  }
}

TEST_F(HeightFunction, AWindowLeavesTheEdgesAsTheyAre) {
  const Model model(with_height(
      "quad4",
      R"({"type": "window", "of": {"type": "constant", "value": 0.1}, "low": [-1, -1], "high": [1, 1]})"));
  Element e;
  e[master] = flat_master(basis("quad4"));
  for (const std::vector<double>& xi :
       std::vector<std::vector<double>>{{-1, 0.3}, {1, -0.2}, {0.5, 1}, {0, -1}, {1, 1}}) {
    const SurfacePoint p = surface_point(model, e, xi);
    EXPECT_EQ(p.point[2], 0.0);
    EXPECT_EQ(p.normal[2], 1.0);
  }
  EXPECT_NEAR(surface_point(model, e, {0.0, 0.0}).point[2], 0.1, 1e-16);
  EXPECT_NEAR(surface_point(model, e, {0.5, 0.0}).point[2], 0.1 * std::pow(0.75, 4), 1e-16);
}

TEST_F(HeightFunction, NamesAreCheckedAndModelsKeepTheirFunction) {
  ents_report report = new_report();
  void* const data = &line_;
  EXPECT_EQ(call::height_register(static_cast<const char*>(nullptr), 1, &wave_height, data, &report),
            ENTS_NULL_ARGUMENT);
  EXPECT_EQ(call::height_register("", 1, &wave_height, data, &report), ENTS_BAD_VALUE);
  EXPECT_EQ(call::height_register(std::string(65, 'x').c_str(), 1, &wave_height, data, &report),
            ENTS_BAD_VALUE);
  for (const int32_t dimension : {0, 3, -1})
    EXPECT_EQ(call::height_register("wave", dimension, &wave_height, data, &report), ENTS_BAD_VALUE);
  EXPECT_NE(std::string(report.message).find("dimension = -1"), std::string::npos);

  const Model before(with_height("line2", callback()));
  EXPECT_EQ(call::height_register("wave", 1, static_cast<ents_height_function>(nullptr), data, &report),
            ENTS_OK);
  try {
    const Model after(with_height("line2", callback()));
    ADD_FAILURE() << "the name is forgotten";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(
        std::string(error.what())
            .find("/height/name: no height function called \"wave\" of 1 surface coordinate is registered"),
        std::string::npos)
        << error.what();
  }
  Random random(9);
  const Element e = draw(before, basis("line2"), random);
  Results r(before.layout);
  EXPECT_EQ(test::evaluate(before, e, want_all, r), ENTS_OK);
}

} // namespace
} // namespace height_function_test
