// SPDX-License-Identifier: BSD-3-Clause
// Every contact method of the library in one scene with large sliding; units; meshes of the slave surface.
#include <cmath>

#include <gtest/gtest.h>

#include "sliding.hpp"
#include "worst.hpp"

namespace host::friction_methods_test {
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
  double force;       ///< relative difference of the force to that of Lagrange multipliers
};
std::ostream& operator<<(std::ostream& stream, const Method& method) { return stream << method.name; }

class Sliding : public testing::TestWithParam<Method> {};

TEST_P(Sliding, RunsThroughWithTheForcesOfTheOthers) {
  const Method& method = GetParam();
  const Solved mine = solve_all(sliding(method.normal, method.friction));
  ASSERT_EQ(mine.records.size(), 42u);
  int iterations = 0;
  for (const StepRecord& record : mine.records) iterations += record.iterations();
  const StepRecord& end = mine.records[21]; // slid forwards by 0.4, the normal force is that of pressing
  std::printf("%-22s normal %.8f tangential %.8f penetration / size %.1e, %d iterations\n",
              method.name.c_str(), -end.contact_force[1], end.contact_force[0], end.penetration / mine.size,
              iterations);
  EXPECT_LE(end.penetration, method.penetration * mine.size);
  static const Solved reference = solve_all(sliding({{"type", "multiplier"}, {"stiffness", 1e3}}, coulomb));
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(end.contact_force[i] / reference.records[21].contact_force[i], 1, method.force) << i;
  // Back again all nodes slip the other way: the force has turned round.
  EXPECT_NEAR(mine.records.back().contact_force[0] / -end.contact_force[0], 1, 0.02);
}

const Json multiplier{{"type", "multiplier"}, {"stiffness", 1e3}};
const Json augmented_multiplier{{"type", "augmented_multiplier"}, {"stiffness", 1e3}};
const Json augmented{{"type", "augmented"}, {"stiffness", 1e4}};
const Json power{{"type", "power"}, {"coefficient", 1e6}, {"exponent", 1.5}};
const Json exponential{{"type", "exponential"}, {"pressure", 0.5}, {"clearance", 1e-4}};

// Penetration allowed: the pressure, 2 at most, over the stiffness for penalty and its kin, and as much of
// the approach (0.01) is missing in the force; the tolerance of Uzawa's iteration (1e-10 of the size, 1e-8 of
// the approach); rounding of positions of size 1 for multipliers, and the solver's tolerance (1e-12 of the
// forces, times the condition of sliding).
INSTANTIATE_TEST_SUITE_P(Normal, Sliding,
                         testing::Values(Method{"penalty", penalty, coulomb, 2e-4, 0.02},
                                         Method{"power", power, coulomb, 2e-4, 0.02},
                                         Method{"exponential", exponential, coulomb, 2e-4, 0.02},
                                         Method{"augmented", augmented, coulomb, 1e-10, 1e-7},
                                         Method{"augmented_multiplier", augmented_multiplier, coulomb, 1e-15,
                                                1e-9},
                                         Method{"multiplier", multiplier, coulomb, 1e-15, 1e-9}),
                         [](const auto& method) { return method.param.name; });

// The same scene in millimetres and MPa and in metres and Pa: forces in newtons agree. What rounding does to
// positions and Newton's tolerance (1e-12) leave 1e-10.
TEST_P(Sliding, DoesNotDependOnTheUnits) {
  const Method& method = GetParam();
  const Solved mm = solve_all(sliding(method.normal, method.friction)),
               m = solve_all(sliding(method.normal, method.friction, "bspline4", 1e-3, 1e6));
  double worst = 0;
  for (std::size_t step = 0; step < mm.records.size(); ++step) {
    const StepRecord &a = mm.records[step], &b = m.records[step];
    const double scale = std::hypot(a.contact_force[0], a.contact_force[1]);
    for (std::size_t i = 0; i < 2; ++i)
      ::test::raise(worst, std::abs(a.contact_force[i] - b.contact_force[i]) / scale);
    for (std::size_t k = 0; k < a.fields.pressure.size(); ++k)
      ::test::raise(worst, std::abs(a.fields.pressure[k] - 1e-6 * b.fields.pressure[k]) / a.peak_pressure);
    for (std::size_t k = 0; k < a.fields.flags.size(); ++k)
      // Rounding decides on the border of the cone, and only there. (Changes are counted from the begin of the last
      // increment, and rounding may decide whether Newton's iteration needs a cut.)
      if (((a.fields.flags[k] ^ b.fields.flags[k]) & ~ENTS_FLAG_CHANGED) != 0)
        for (const StepRecord* record : {&a, &b}) {
          const double p = record->fields.pressure[k];
          const double shear = std::hypot(record->fields.traction[2 * k], record->fields.traction[2 * k + 1]);
          EXPECT_NEAR(shear, 0.3 * p, 1e-9 * p) << "step " << step << ", node " << k;
        }
  }
  std::printf("%s: forces and pressures agree to %.1e\n", method.name.c_str(), worst);
  EXPECT_LE(worst, 1e-10);
}

/// A scene with another way to go, here too short for all nodes to slip: what never slips is soon torn off.
Json dragged(Json json, double way) {
  json["supports"][2]["x"] = way;
  return json;
}

TEST(Friction, RoughNeverSlipsAndShearLimitCaps) {
  const Solved coulomb_too = solve_all(dragged(sliding(penalty, coulomb), 0.01));
  const Solved rough = solve_all(dragged(sliding(penalty, {{"type", "rough"}, {"stiffness", 2e3}}), 0.01));
  int slipping = 0;
  for (std::size_t step = 0; step < rough.records.size(); ++step) {
    for (const std::int32_t flags : rough.records[step].fields.flags) EXPECT_EQ(flags & ENTS_FLAG_SLIP, 0);
    for (const std::int32_t flags : coulomb_too.records[step].fields.flags)
      slipping += (flags & ENTS_FLAG_SLIP) != 0;
  }
  EXPECT_GT(slipping, 0); // where Coulomb's law lets go
  EXPECT_GT(rough.records[21].contact_force[0], 1.01 * coulomb_too.records[21].contact_force[0]);
  Json capped = coulomb;
  capped["shear_limit"] = 0.1;
  const Solved limit = solve_all(sliding(penalty, capped));
  const ContactFields& fields = limit.records[21].fields;
  int at_limit = 0;
  for (std::size_t k = 0; k < fields.flags.size(); ++k) {
    const double shear = std::hypot(fields.traction[2 * k], fields.traction[2 * k + 1]);
    EXPECT_LE(shear, std::min(0.1, 0.3 * fields.pressure[k]) * (1 + 1e-14));
    at_limit += (fields.flags[k] & ENTS_FLAG_SHEAR_LIMIT) != 0;
  }
  EXPECT_GT(at_limit, 3);
}

// The symmetrised tangent goes to Cholesky, takes more iterations, and ends at the same solution. It is a
// fixed-point iteration whose rate grows with mu: here it converges at mu = 0.05 and does not at 0.1 once all
// nodes slip.
TEST(Friction, SymmetrisedTangentEndsAtTheSameForces) {
  Json slippery = coulomb;
  slippery["coefficient"] = 0.05;
  Json json = sliding(penalty, slippery);
  const Solved exact = solve_all(json);
  json["contact"]["model"]["contact"]["symmetrised"] = true;
  json["solver"]["max_iterations"] = 200;
  const Scene scene = test::scene_from(json);
  Simulation simulation(scene, &test::library());
  EXPECT_NE(simulation.solver_name().find("Cholesky"), std::string::npos) << simulation.solver_name();
  const std::vector<StepRecord> records = solve(simulation, {});
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(records[21].contact_force[i], exact.records[21].contact_force[i], 1e-9);
}

/// A periodic strip pressed and sheared on a rigid plane: stress and traction are uniform, whatever the mesh.
Json strip(const std::vector<std::pair<double, int>>& pieces) {
  Json x{{"from", 0}, {"pieces", Json::array()}};
  for (const auto& [to, divisions] : pieces) x["pieces"].push_back({{"to", to}, {"divisions", divisions}});
  return {{"dimension", 2},
          {"formulation", "plane_strain"},
          {"materials", {{"m", {{"law", "linear_elastic"}, {"young", 100}, {"poisson", 0.3}}}}},
          {"parts",
           {{{"name", "b"}, {"material", "m"}, {"element", "quad4"}, {"x", x}, {"y", test::axis(0, 1, 3)}}}},
          {"periodic", Json::array({Json::array({"b.x_min", "b.x_max"})})},
          {"supports",
           {{{"nodes", "b.y_max"}, {"y", -0.01}, {"path", {{0, 0}, {1, 1}}}},
            {{"nodes", "b.y_max"}, {"x", 0.04}, {"path", {{1, 0}, {2, 1}}}}}},
          {"contact",
           {{"slave", "b.y_min"},
            {"master", {{"nodes", {{-1, 0}, {3, 0}}}, {"direction", {0, 1}}}},
            {"model",
             {{"segment", "line2"},
              {"contact",
               {{"normal", {{"type", "penalty"}, {"stiffness", 500}}},
                {"friction", {{"type", "coulomb"}, {"coefficient", 0.4}, {"stiffness", 300}}}}}}}}},
          {"solver", {{"tolerance", 1e-12}}},
          {"steps", {{"control", "load_factor"}, {"values", {1, 1.1, 1.2, 1.5, 2}}}}};
}

// Stiffness per area and tributary areas: 2, 9 and unequal slave elements carry the same force. Exact:
// springs in series, 1 / (H / M + 1 / eps) with M = E (1 - nu) / ((1 + nu) (1 - 2 nu)), sticking 1 / (H / G +
// 1 / eps_t), then mu p.
TEST(Friction, DoesNotDependOnTheSlaveMesh) {
  const double M = 100 * 0.7 / (1.3 * 0.4), G = 100 / 2.6;
  const double pressure = 0.01 / (1 / M + 1 / 500.);
  for (const auto& pieces :
       std::vector<std::vector<std::pair<double, int>>>{{{2, 2}}, {{2, 9}}, {{0.3, 5}, {1.7, 2}, {2, 1}}}) {
    const Solved result = solve_all(strip(pieces));
    for (const StepRecord& record : result.records) {
      const double shear = std::min(0.04 * (record.value - 1) / (1 / G + 1 / 300.), 0.4 * pressure);
      // Small strains; Newton's tolerance is 1e-12 of the forces.
      EXPECT_NEAR(-record.contact_force[1] / 2, pressure, 1e-11 * pressure) << record.value;
      EXPECT_NEAR(record.contact_force[0] / 2, shear, 1e-11 * pressure) << record.value;
      for (const double p : record.fields.pressure) EXPECT_NEAR(p, pressure, 1e-11 * pressure);
    }
  }
}

} // namespace
} // namespace host::friction_methods_test
