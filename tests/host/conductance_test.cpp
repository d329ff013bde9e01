// SPDX-License-Identifier: BSD-3-Clause
// Conductance is incremental stiffness (J. R. Barber, Bounds on the electrical resistance between contacting
// elastic rough bodies, Proc. R. Soc. A 459, 2003): h_c / k_s = (dp / d gap) / E*.
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "program.hpp"
#include "program_fixture.hpp"

namespace host::conductance_test {
namespace {

class Conductance : public test::Program {
protected:
  Json steps_of(const Json& scene) {
    const test::ProgramOutput output = test::ents_host("run " + write("scene.json", scene) + " --json");
    if (output.exit_code != 0) throw std::runtime_error(output.text);
    return Json::parse(output.text).at("steps");
  }
};

Json scene_of(const std::string& name) {
  Json scene = parse_json_file(EXAMPLES "/" + name + "/scene.json");
  scene.erase("compare");
  return scene;
}

// The variant "conductance" on half as many cells, whose error at the border of contact is twice as large. Its
// slopes of 3e-5 matter: at those of the scene itself, 3e-3, points move along the sine by enough to change the
// conductance at a / lambda = 0.45 by 6 %.
TEST_F(Conductance, OfASineUpToNearlyFullContact) {
  Json scene = scene_of("westergaard");
  scene.merge_patch(scene.at("variants").at("conductance"));
  scene.erase("variants");
  Json& block = scene.at("parts")[0];
  block.at("x").at("pieces")[0].at("divisions") = 256;
  block.at("y").at("pieces")[0] = {{"to", 0}, {"divisions", 110}, {"growth", 0.97}};
  const Json& pressures = scene.at("steps").at("values");
  scene.at("steps").at("values") = Json::array({pressures[2], pressures[6], pressures[7]});
  const std::vector<double> right = {2.95599, 31.3021, 126.799}, cubed = {.131319, 4.97e-6, 5.2116e-9};
  const Json steps = steps_of(scene);
  ASSERT_EQ(steps.size(), right.size());
  for (std::size_t k = 0; k < right.size(); ++k) {
    const double h = test::value(steps[k], "h_c lambda / k_s"),
                 g = test::value(steps[k], "<g^3> / amplitude^3");
    std::printf("h_c lambda / k_s %.5g (%.5g), <g^3> %.5g (%.5g)\n", h, right[k], g, cubed[k]);
    EXPECT_NEAR(h, right[k], 0.01 * right[k]);
    EXPECT_NEAR(g, cubed[k], 0.02 * cubed[k]);
  }
}

// A spot of radius a has the conductance 2 k_s a (R. Holm, Electric Contacts, 1967), so dF / d approach is
// 2 E* a. Loads are raised and lowered by 10 %: contact grows by whole slave nodes.
TEST_F(Conductance, OfAHertzSpot) {
  Json scene = scene_of("hertz3d");
  const double modulus = 1000 / (1 - 0.3 * 0.3), radius = 10;
  const std::vector<double> loads = {0.3, 0.6, 1.2};
  Json& values = scene.at("steps").at("values") = Json::array();
  for (const double load : loads) values.push_back(0.9 * load), values.push_back(1.1 * load);
  const Json steps = steps_of(scene);
  ASSERT_EQ(steps.size(), 2 * loads.size());
  for (std::size_t k = 0; k < loads.size(); ++k) {
    const auto change = [&](const char* name) {
      return steps[2 * k + 1].at(name).get<double>() - steps[2 * k].at(name).get<double>();
    };
    const double stiffness = change("force") / change("approach"),
                 a = std::cbrt(0.75 * loads[k] * radius / modulus);
    std::printf("dF / d approach over 2 E* a: %.4f\n", stiffness / (2 * modulus * a));
    EXPECT_NEAR(stiffness, 2 * modulus * a, 0.01 * 2 * modulus * a);
  }
}

} // namespace
} // namespace host::conductance_test
