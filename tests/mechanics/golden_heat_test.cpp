// Golden vectors of elements with heat (golden/heat/heat.py): powers and all their derivatives.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "library.hpp"

namespace mechanics::golden_heat_test {
namespace {

using nlohmann::json;

json text_of(const json& c) {
  const json& law = c["law"];
  json contact = {{"normal", {{"type", "penalty"}, {"stiffness", law["stiffness"]}}}};
  contact["heat"] = {
      {"conductance", law["constant"]},
      {"power",
       {{"coefficient", law["coefficient"]}, {"pressure", law["pressure"]}, {"exponent", law["exponent"]}}},
      {"gas", {{"conductivity", law["conductivity"]}, {"jump", law["jump"]}}}};
  if (!c["anchor"].is_null()) {
    contact["friction"] = {{"type", "coulomb"}, {"coefficient", law["mu"]}, {"stiffness", law["tangential"]}};
    contact["heat"]["friction"] = {{"share", law["share"]}, {"slave", law["slave"]}};
  }
  return {{"segment", c["segment"]}, {"height", c["height"]}, {"contact", contact}};
}

std::vector<double> numbers(const json& nested) {
  std::vector<double> flat;
  for (const json& entry : nested)
    for (const double x : entry.is_array() ? numbers(entry) : std::vector<double>{entry.get<double>()})
      flat.push_back(x);
  return flat;
}

TEST(GoldenHeat, PowersAndTheirDerivatives) {
  constexpr double tolerance = 1e-12; // the reference has 16 digits; the projection's condition is up to 10
  std::ifstream file(std::string(ENTS_GOLDEN_DIRECTORY) + "/heat/heat.json");
  const json cases = json::parse(file);
  double worst = 0.0;
  int rubbing = 0, open = 0;
  for (const json& c : cases) {
    const Model model(text_of(c).dump());
    ents_layout layout{};
    layout.struct_size = sizeof layout;
    ASSERT_EQ(ents_model_layout(model.handle(), &layout, nullptr), ENTS_OK);
    const std::vector<double> slave = numbers(c["slave"]), master = numbers(c["master"]),
                              start = numbers(c["start"]), temperature = numbers(c["temperature"]),
                              expected = numbers(c["residual"]);
    std::vector<double> state(static_cast<std::size_t>(layout.state_size));
    ents_state_init(model.handle(), 1, state.data(), layout.state_size, nullptr);
    if (!c["anchor"].is_null()) { // in contact at the begin of the increment, from there on
      state[1] = 2.0;
      for (std::size_t a = 0; a < start.size(); ++a)
        state[3 + a] = start[a], state[3 + start.size() + a] = c["anchor"][a].get<double>();
    }
    const auto n = static_cast<std::size_t>(layout.dofs), own = static_cast<std::size_t>(layout.node_dofs);
    std::vector<double> residual(n), tangent(n * n);
    const double area = c["area"];
    double heat[2];
    ents_input in{};
    in.struct_size = sizeof in, in.slave = slave.data(), in.master = master.data(), in.start = start.data();
    in.area = &area, in.state_begin = state.data(), in.slave_temperature = temperature.data();
    in.master_temperature = temperature.data() + 1, in.time_increment = c["law"]["time"];
    ents_output out{};
    out.struct_size = sizeof out, out.wanted = ENTS_RESIDUAL | ENTS_TANGENT | ENTS_HEAT,
    out.residual = residual.data();
    out.tangent = tangent.data(), out.heat = heat;
    ents_report report = new_report();
    ASSERT_EQ(ents_evaluate(model.handle(), 0, 1, &in, &out, &report), ENTS_OK) << report.message;
    double size = 0.0, largest = 0.0;
    for (const double r : expected) size = std::max(size, std::fabs(r));
    for (const json& column : c["tangent"])
      for (const double k : numbers(column)) largest = std::max(largest, std::fabs(k));
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const std::size_t row = own * i + own - 1;
      worst = std::max(worst, std::fabs(residual[row] - expected[i]) / size);
      for (std::size_t j = 0; j < n; ++j)
        worst = std::max(worst, std::fabs(tangent[j * n + row] - c["tangent"][j][i].get<double>()) / largest);
    }
    rubbing += heat[1] > 0.0;
    open += c["residual"][0] != 0.0 && heat[1] == 0.0;
    EXPECT_LE(worst, tolerance) << c.dump();
  }
  EXPECT_GE(rubbing, 6);
  EXPECT_GE(open, 6);
  std::cout << cases.size() << " cases, " << rubbing << " with the heat of friction; largest difference "
            << worst << " of the largest entry\n";
}

} // namespace
} // namespace mechanics::golden_heat_test
