// SPDX-License-Identifier: BSD-3-Clause
// Every contact method of the library in one scene with large sliding; units; meshes of the slave surface.
#include <cmath>

#include <gtest/gtest.h>

#include "sliding.hpp"

namespace host {
namespace {

using test::coulomb;
using test::penalty;
using test::sliding;

struct Solved {
  std::vector<StepRecord> records;
  double size = 0;
};

Solved solve_all(const Json& json) {
  const Scene scene = test::scene_from(json);
  Simulation simulation(scene, &test::library());
  Solved result{solve(simulation, {}), 0};
  result.size = simulation.contact()->size();
  return result;
}

struct Method {
  std::string name;
  Json normal, friction;
  double penetration; ///< largest |gap| at the end over the size of the slave surface
};
std::ostream& operator<<(std::ostream& stream, const Method& method) { return stream << method.name; }

class Sliding : public testing::TestWithParam<Method> {};

TEST_P(Sliding, RunsThroughWithTheForcesOfTheOthers) {
  const Method& method = GetParam();
  const Solved mine = solve_all(sliding(method.normal, method.friction));
  ASSERT_EQ(mine.records.size(), 42u);
  int iterations = 0;
  for (const StepRecord& record : mine.records) {
    iterations += record.iterations();
    // |t| <= mu p at every node: test of the library's own is 1e-14; here a sum over the nodes, of equal signs.
    if (method.friction.at("type") == "coulomb") {
      EXPECT_LE(std::abs(record.contact_force[0]), -0.3 * record.contact_force[1] * (1 + 1e-2));
    }
  }
  const StepRecord& end = mine.records[21]; // slid forwards by 0.4, the normal force is that of pressing
  std::printf("%-22s normal %.5f tangential %.5f penetration %.1e, %d iterations, %zu cuts in step 22\n",
              method.name.c_str(), -end.contact_force[1], end.contact_force[0], end.penetration / mine.size, iterations,
              end.cuts.size());
  EXPECT_LE(end.penetration, method.penetration * mine.size);
  static const Solved reference = solve_all(sliding({{"type", "multiplier"}, {"stiffness", 1e3}}, coulomb));
  // Penetration p / stiffness = 1.5e-4 of the approach 0.01 and of the softening it stands for: 3 %.
  EXPECT_NEAR(end.contact_force[1] / reference.records[21].contact_force[1], 1, 0.03);
}

const Json multiplier{{"type", "multiplier"}, {"stiffness", 1e3}};
const Json augmented_multiplier{{"type", "augmented_multiplier"}, {"stiffness", 1e3}};
const Json augmented{{"type", "augmented"}, {"stiffness", 1e4}};
const Json power{{"type", "power"}, {"coefficient", 1e6}, {"exponent", 1.5}};
const Json exponential{{"type", "exponential"}, {"pressure", 0.5}, {"clearance", 1e-4}};

// Penetration allowed: pressure of about 2 over the stiffness for the penalty-like, rounding of positions of size 1 for
// multipliers, the tolerance (1e-10) for Uzawa.
INSTANTIATE_TEST_SUITE_P(
    Normal, Sliding,
    testing::Values(Method{"penalty", penalty, coulomb, 1e-3}, Method{"power", power, coulomb, 1e-3},
                    Method{"exponential", exponential, coulomb, 1e-3}, Method{"augmented", augmented, coulomb, 1e-9},
                    Method{"augmented_multiplier", augmented_multiplier, coulomb, 1e-13},
                    Method{"multiplier", multiplier, coulomb, 1e-13}),
    [](const auto& method) { return method.param.name; });

} // namespace
} // namespace host
