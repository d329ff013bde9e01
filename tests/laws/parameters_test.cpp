// Models bound to values of their parameters: the same bits as a model whose text has these numbers, and
// derivatives of gap, energy and residual by every parameter.
#include <gtest/gtest.h>

#include <array>
#include <iostream>
#include <limits>

#include "law_elements.hpp"
#include "model_handle.hpp"
#include "samples.hpp"
#include "worst.hpp"

namespace laws::parameters_test {
namespace {

// In alphabetical order, as the library numbers them; values, and lengths over which results change.
struct Value {
  const char* name;
  double value, step;
};
constexpr Value values[] = {{"amplitude", 0.012, 0.02}, {"eps", 100.0, 100.0},  {"factor", 0.9, 1.0},
                            {"k", 0.05, 0.05},          {"level", 0.004, 0.02}, {"mu", 0.3, 0.3},
                            {"offset", 0.003, 0.02},    {"phase", 0.7, 1.0},    {"sliding", 0.02, 0.02},
                            {"top", 0.01, 0.02},        {"u", 0.15, 0.5},       {"v", -0.1, 0.5},
                            {"work", 0.02, 0.02}};
constexpr std::size_t parameters = std::size(values);

json height_with_names(int t) {
  const json vector = t == 1 ? json{0.4} : json{0.3, 0.2}, center = t == 1 ? json{"u"} : json{"u", "v"},
             origin = t == 1 ? json{0} : json{0, 0};
  const json sine = {
      {"type", "sine"}, {"amplitude", "amplitude"}, {"wave_vector", vector}, {"phase", "phase"}};
  const json bump = {{"type", "gaussian"}, {"amplitude", "top"}, {"center", origin}, {"width", 0.6}};
  const json other = {{"type", "gaussian"}, {"amplitude", 0.01}, {"center", center}, {"width", 0.7}};
  return {{"type", "sum"},
          {"of",
           {{{"type", "scale"}, {"by", "factor"}, {"of", sine}},
            {{"type", "shift"}, {"by", center}, {"of", bump}},
            {{"type", "product"}, {"of", {other, {{"type", "scale"}, {"by", "factor"}, {"of", sine}}}}},
            {{"type", "constant"}, {"value", "level"}}}}};
}
json law_with_names(Method method) {
  json& normal = method.normal;
  if (normal.contains("work"))
    normal["work"] = "work";
  else if (normal["type"] != "table")
    normal[normal["type"] == "power"         ? "coefficient"
           : normal["type"] == "exponential" ? "pressure"
                                             : "stiffness"] = "eps";
  if (!method.friction.is_null() && !method.friction.value("coefficient", json()).is_object())
    method.friction["coefficient"] = "mu";
  if (!method.wear.is_null()) method.wear["coefficient"] = "k", method.wear["sliding"] = "sliding";
  if (!method.offset.is_null()) method.offset = "offset";
  return {
      {"normal", normal}, {"friction", method.friction}, {"wear", method.wear}, {"offset", method.offset}};
}
// Every name replaced by its number
void put_numbers(json& text, const std::array<double, parameters>& theta) {
  if (text.is_structured())
    for (auto& [key, value] : text.items())
      if (key != "type" && key != "scheme" && key != "segment") put_numbers(value, theta);
  for (std::size_t i = 0; i < parameters && text.is_string(); ++i)
    if (text == values[i].name) text = theta[i];
}
std::array<double, parameters> defaults() {
  std::array<double, parameters> theta{};
  for (std::size_t i = 0; i < parameters; ++i) theta[i] = values[i].value;
  return theta;
}

void bind_values(const Handle& model, const std::array<double, parameters>& theta, Handle& bound) {
  ents_model* to = bound.release();
  ents_report report{};
  report.struct_size = sizeof report;
  const std::int32_t status = ents_model_bind(model.get(), theta.data(), nullptr, 0, &to, &report);
  bound.reset(to);
  if (status != ENTS_OK) throw std::runtime_error(report.message);
}

std::vector<Method> tried_methods() {
  std::vector<Method> all;
  for (const Method& method : all_methods())
    if (method.flattening.is_null() && !method.name.ends_with("rough") &&
        !method.name.ends_with("shear_limit") && !std::string(method.normal["type"]).ends_with("multiplier"))
      all.push_back(method);
  return all;
}

class Parameters : public testing::TestWithParam<Method> {
protected:
  // A model with names, its elements at their default values, and the model's text
  struct Setting {
    json text;
    Handle model;
    LawElements elements;
  };
  static Setting draw_setting(Random& random, const Basis& basis, const char* projection) {
    mechanics::Scene scene = draw_scene(random, basis, "sine", projection);
    scene.height = height_with_names(basis.parameters());
    put_numbers(scene.height, defaults());
    // as the independent surface of the tests writes it
    for (json& part : scene.height["of"]) {
      if (part["type"] == "scale")
        part = {{"type", "product"}, {"of", {{{"type", "constant"}, {"value", part["by"]}}, part["of"]}}};
      if (part["type"] == "shift") {
        json moved = part["of"];
        moved["center"] = part["by"];
        part = moved;
      }
      if (part["type"] == "product" && part["of"][1]["type"] == "scale")
        part["of"][1] = {
            {"type", "product"},
            {"of", {{{"type", "constant"}, {"value", part["of"][1]["by"]}}, part["of"][1]["of"]}}};
    }
    Setting s;
    s.text = scene.model();
    const mechanics::Model plain = model_of(scene, GetParam());
    s.elements = draw(random, scene, plain, mechanics::long_samples(80), 0.05);
    s.text["height"] = height_with_names(basis.parameters());
    s.text["contact"] = law_with_names(GetParam());
    for (const Value& v : values) s.text["parameters"][v.name] = v.value;
    s.model = make(s.text);
    return s;
  }
};

TEST_P(Parameters, BoundModelsHaveTheBitsOfModelsWithNumbers) {
  Random random(11);
  Handle bound;
  for (const Basis& basis : mechanics::all_bases()) {
    const Setting s = draw_setting(random, basis, "normal");
    bound.reset();
    for (int round = 0; round < 3; ++round) {
      std::array<double, parameters> theta = defaults();
      for (double& x : theta) x *= random.uniform(0.8, 1.2);
      bind_values(s.model, theta, bound);
      json numbers = s.text;
      numbers.erase("parameters");
      put_numbers(numbers, theta);
      LawResults a, b;
      evaluate_near(bound.get(), s.elements,
                    ENTS_RESIDUAL | ENTS_TANGENT | ENTS_GAP | ENTS_STATE | ENTS_FLAGS, a);
      evaluate_near(make(numbers).get(), s.elements,
                    ENTS_RESIDUAL | ENTS_TANGENT | ENTS_GAP | ENTS_STATE | ENTS_FLAGS, b);
      EXPECT_EQ(a.status, b.status) << basis.name;
      EXPECT_EQ(a.residual, b.residual) << basis.name;
      EXPECT_EQ(a.tangent, b.tangent) << basis.name;
      EXPECT_EQ(a.state, b.state) << basis.name;
    }
  }
}

// Central differences of sixth order: rounding 1e-16 / step of the results' size, truncation step^6 of the
// seventh derivative. A power law's derivatives grow towards the end of contact: there a smaller step is
// right. The smallest error of four steps counts.
TEST_P(Parameters, DerivativesAreThoseOfTheResults) {
  constexpr double steps[4] = {2e-3, 2e-4, 2e-5, 2e-6}, tolerance = 1e-9;
  constexpr double offsets[6] = {-3, -2, -1, 1, 2, 3},
                   weights[6] = {-1.0 / 60, 9.0 / 60, -45.0 / 60, 45.0 / 60, -9.0 / 60, 1.0 / 60};
  constexpr std::int32_t branch = ENTS_FLAG_CONTACT | ENTS_FLAG_STICK | ENTS_FLAG_SLIP | ENTS_FLAG_OUTSIDE;
  Random random(12);
  mechanics::Worst worst;
  std::int64_t checked = 0, contact = 0;
  for (const Basis& basis : mechanics::all_bases())
    for (const char* projection : mechanics::projections) {
      const Setting s = draw_setting(random, basis, projection);
      const auto n = static_cast<std::size_t>(s.elements.layout.dofs),
                 count = static_cast<std::size_t>(s.elements.at.count);
      std::vector<double> gap(count * parameters), residual(count * parameters * n), adjoint(count * n),
          product(parameters);
      for (double& x : adjoint) x = random.uniform(-1.0, 1.0);
      ents_derivatives derivatives{};
      derivatives.struct_size = sizeof derivatives;
      derivatives.gap = gap.data(), derivatives.residual = residual.data();
      derivatives.adjoint = adjoint.data(), derivatives.product = product.data();
      const ents_input in = input_of(s.elements, s.elements.at.start);
      ents_report report{};
      report.struct_size = sizeof report;
      ASSERT_GE(ents_parameter_derivatives(s.model.get(), 0, s.elements.at.count, &in, &derivatives, &report),
                0)
          << report.message;
      LawResults centre;
      evaluate_near(s.model.get(), s.elements, ENTS_RESIDUAL | ENTS_GAP | ENTS_FLAGS, centre);
      Handle bound;
      for (std::size_t p = 0; p < parameters; ++p) {
        std::vector<double> error(count, std::numeric_limits<double>::infinity());
        std::vector<char> tried(count, 0);
        for (const double step : steps) {
          std::array<LawResults, 6> points;
          const double h = step * values[p].step;
          for (std::size_t k = 0; k < 6; ++k) {
            std::array<double, parameters> theta = defaults();
            theta[p] += offsets[k] * h;
            bind_values(s.model, theta, bound);
            evaluate_near(bound.get(), s.elements, ENTS_RESIDUAL | ENTS_GAP | ENTS_FLAGS, points[k]);
          }
          for (std::size_t e = 0; e < count; ++e) {
            bool same = centre.status[e] == ENTS_OK && !(centre.flags[e] & ENTS_FLAG_OUTSIDE);
            for (const LawResults& r : points)
              same = same && r.status[e] == ENTS_OK && (r.flags[e] & branch) == (centre.flags[e] & branch);
            if (!same) continue;
            tried[e] = 1;
            const auto miss = [&](auto&& value, double own) {
              double rate = 0.0;
              for (std::size_t k = 0; k < 6; ++k) rate += weights[k] / h * value(points[k]);
              return std::fabs(rate - own) * values[p].step;
            };
            double largest = miss([&](const LawResults&r) { return r.gap[e]; }, gap[e * parameters + p]),
                   size = 0.1;
            for (std::size_t i = 0; i < n; ++i)
              size = std::max({size, std::fabs(residual[(e * parameters + p) * n + i]) * values[p].step,
                               std::fabs(centre.residual[e * n + i])});
            for (std::size_t i = 0; i < n; ++i)
              largest = std::max(largest, miss([&](const LawResults& r) { return r.residual[e * n + i]; },
                                               residual[(e * parameters + p) * n + i]) /
                                              size);
            error[e] = std::min(error[e], largest);
          }
        }
        double sum = 0.0;
        for (std::size_t e = 0; e < count; ++e) {
          if (centre.status[e] == ENTS_OK)
            for (std::size_t i = 0; i < n; ++i)
              sum += adjoint[e * n + i] * residual[(e * parameters + p) * n + i];
          if (tried[e] == 0) continue;
          ++checked;
          contact += (centre.flags[e] & ENTS_FLAG_CONTACT) != 0;
          worst.see(error[e], [&] {
            return std::string("by ") + values[p].name + " " + basis.name + " " + projection + " element " +
                   std::to_string(e);
          });
        }
        EXPECT_NEAR(product[p], sum, 1e-12 * (1.0 + std::fabs(sum)) * static_cast<double>(count))
            << values[p].name;
      }
    }
  EXPECT_GT(checked, mechanics::long_samples(10000));
  EXPECT_GT(contact, checked / 4);
  EXPECT_LE(worst.error, tolerance) << worst.where;
  std::cout << GetParam().name << ": " << checked << " derivatives, worst error " << worst.error << " ("
            << worst.where << ")\n";
}

INSTANTIATE_TEST_SUITE_P(Method, Parameters, testing::ValuesIn(tried_methods()),
                         [](const auto& parameter) { return parameter.param.name; });

std::string refused(const Handle& model, const double* theta, const ents_data* fields, std::int64_t count,
                    ents_model** bound, std::int32_t status) {
  ents_report report{};
  report.struct_size = sizeof report;
  EXPECT_EQ(ents_model_bind(model.get(), theta, fields, count, bound, &report), status);
  return report.message;
}

TEST(Binding, MistakesAreNamed) {
  const Handle model = make(json::parse(
      R"({"segment": "line2", "parameters": {"a": 0.1, "eps": 100}, "height": {"type": "sum", "of": [
    {"type": "constant", "value": "a"}, {"type": "field", "name": "worn", "points": [8], "boundary": "periodic", "size": [2]}]},
    "contact": {"normal": {"type": "penalty", "stiffness": "eps"}}})"));
  const double slave[2] = {0, 0.1}, master[4] = {-1, 0, 1, 0};
  double gap;
  ents_input in{};
  in.struct_size = sizeof in, in.slave = slave, in.master = master;
  ents_output out{};
  out.struct_size = sizeof out, out.wanted = ENTS_GAP, out.gap = &gap;
  ents_report report{};
  report.struct_size = sizeof report;
  EXPECT_EQ(ents_evaluate(model.get(), 0, 1, &in, &out, &report), ENTS_BAD_STATE);
  EXPECT_NE(std::string(report.message).find("has a field, \"worn\", without memory"), std::string::npos)
      << report.message;

  std::int64_t size = 0, place = -1;
  ASSERT_EQ(ents_field_size(model.get(), "worn", &size, nullptr), ENTS_OK);
  ASSERT_EQ(ents_parameter_place(model.get(), "eps", &place, nullptr), ENTS_OK);
  EXPECT_EQ(place, 1);
  EXPECT_EQ(ents_parameter_place(model.get(), "b", &place, &report), ENTS_BAD_VALUE);
  EXPECT_NE(std::string(report.message).find("it has \"a\", \"eps\""), std::string::npos) << report.message;
  std::vector<double> block(static_cast<std::size_t>(size));
  ents_data field{};
  field.struct_size = sizeof field, field.name = "worn", field.values = block.data(), field.rows = 1,
  field.columns = size;
  ents_model* bound = nullptr;
  EXPECT_NE(refused(model, nullptr, &field, 1, &bound, ENTS_BAD_STATE).find("not made by ents_field_init"),
            std::string::npos);
  ASSERT_EQ(ents_field_init(model.get(), "worn", nullptr, block.data(), size, nullptr), ENTS_OK);
  EXPECT_NE(refused(model, nullptr, nullptr, 0, &bound, ENTS_BAD_STATE).find("field \"worn\" is not among"),
            std::string::npos);
  const double bad[2] = {0.1, -1.0}, not_finite[2] = {std::nan(""), 1.0};
  EXPECT_NE(refused(model, bad, &field, 1, &bound, ENTS_BAD_VALUE).find("parameters[1] (\"eps\")"),
            std::string::npos);
  EXPECT_NE(refused(model, not_finite, &field, 1, &bound, ENTS_NON_FINITE).find("parameters[0] (\"a\")"),
            std::string::npos);
  EXPECT_EQ(bound, nullptr);
  ASSERT_EQ(ents_model_bind(model.get(), nullptr, &field, 1, &bound, nullptr), ENTS_OK);
  ASSERT_EQ(ents_evaluate(bound, 0, 1, &in, &out, nullptr), ENTS_OK);
  EXPECT_EQ(gap, 0.0);
  ents_model* own = model.get();
  EXPECT_NE(refused(model, nullptr, &field, 1, &own, ENTS_BAD_HANDLE).find("neither null nor a model"),
            std::string::npos);
  const double other[2] = {0.05, 100.0};
  ASSERT_EQ(ents_model_bind(model.get(), other, &field, 1, &bound, nullptr), ENTS_OK);
  ASSERT_EQ(ents_evaluate(bound, 0, 1, &in, &out, nullptr), ENTS_OK);
  EXPECT_EQ(gap, 0.05);
  ents_model_destroy(&bound, nullptr);
}

// A tree of the values before is noticed; refitted it finds again.
TEST(Binding, ATreeOfOtherValuesIsRefused) {
  const Handle model = make(json::parse(
      R"({"segment": "line2", "parameters": {"a": 0.1, "k": 1}, "height": {"type": "constant", "value": "a"},
    "contact": {"normal": {"type": "penalty", "stiffness": "k"}}})"));
  const std::int64_t connectivity[2] = {0, 1};
  const double positions[4] = {-1, 0, 1, 0}, slave[2] = {0, 0.3};
  ents_master_mesh mesh{};
  mesh.struct_size = sizeof mesh, mesh.segments = 1, mesh.connectivity = connectivity, mesh.nodes = 2,
  mesh.positions = positions;
  ents_model* bound = nullptr;
  ASSERT_EQ(ents_model_bind(model.get(), nullptr, nullptr, 0, &bound, nullptr), ENTS_OK);
  std::int64_t size = 0;
  ASSERT_EQ(ents_tree_size(bound, 1, &size, nullptr), ENTS_OK);
  std::vector<double> tree(static_cast<std::size_t>(size));
  ASSERT_EQ(ents_tree_build(bound, &mesh, tree.data(), size, nullptr), ENTS_OK);
  std::int64_t segment = -1;
  double xi = 0.0, gap = 0.0;
  ents_detection detection{};
  detection.struct_size = sizeof detection, detection.slave = slave, detection.reach = 1,
  detection.segment = &segment, detection.xi = &xi, detection.gap = &gap;
  ASSERT_EQ(ents_detect(bound, &mesh, tree.data(), size, 0, 1, &detection, nullptr), ENTS_OK);
  EXPECT_NEAR(gap, 0.2, 1e-15);
  const double stiffer[2] = {0.1, 2.0}, higher[2] = {0.4, 2.0};
  ASSERT_EQ(ents_model_bind(model.get(), stiffer, nullptr, 0, &bound, nullptr), ENTS_OK);
  ASSERT_EQ(ents_detect(bound, &mesh, tree.data(), size, 0, 1, &detection, nullptr), ENTS_OK)
      << "the law is no part of the surface";
  ASSERT_EQ(ents_model_bind(model.get(), higher, nullptr, 0, &bound, nullptr), ENTS_OK);
  segment = -1;
  EXPECT_EQ(ents_detect(bound, &mesh, tree.data(), size, 0, 1, &detection, nullptr), ENTS_BAD_STATE);
  ASSERT_EQ(ents_tree_refit(bound, &mesh, tree.data(), size, nullptr), ENTS_OK);
  ASSERT_EQ(ents_detect(bound, &mesh, tree.data(), size, 0, 1, &detection, nullptr), ENTS_OK);
  EXPECT_NEAR(gap, -0.1, 1e-15);
  ents_model_destroy(&bound, nullptr);
}

} // namespace
} // namespace laws::parameters_test
