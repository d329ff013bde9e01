// SPDX-License-Identifier: BSD-3-Clause
// Whole bodies without contact against exact solutions.
#include <cmath>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "half_space.hpp"
#include "support.hpp"

namespace host::solution_test {
namespace {

using test::axis;

struct Body {
  std::string element, formulation; ///< formulation empty in space
};

/// A unit block pulled to `stretch` along y, free to contract unless plane strain keeps it.
Json tension(const Body& body, double stretch) {
  const bool solid = body.formulation.empty();
  Json scene{{"dimension", solid ? 3 : 2},
             {"materials", {{"rubber", {{"law", "neo_hooke"}, {"young", 3}, {"poisson", 0.4}}}}}};
  if (!solid) scene["formulation"] = body.formulation;
  Json part{{"name", "b"}, {"material", "rubber"}, {"element", body.element}};
  for (const char* name : {"x", "y", "z"})
    if (solid || *name != 'z') part[name] = axis(0, 1, 2);
  scene["parts"] = {part};
  scene["supports"] = {{{"nodes", "b.x_min"}, {"x", 0}},
                       {{"nodes", "b.y_min"}, {"y", 0}},
                       {{"nodes", "b.y_max"}, {"y", stretch - 1}}};
  if (solid) scene["supports"].push_back({{"nodes", "b.z_min"}, {"z", 0}});
  scene["steps"] = {{"control", "load_factor"}, {"values", {0.5, 1}}};
  return scene;
}

class NeoHookeTension : public testing::TestWithParam<Body> {};

TEST_P(NeoHookeTension, IsExact) {
  const double stretch = 1.6;
  const Scene scene = test::scene_from(tension(GetParam(), stretch));
  Simulation simulation(scene, nullptr);
  const std::vector<StepRecord> records = solve(simulation, {});

  // Stretches (lateral, stretch, third): P_lateral = mu (l - 1/l) + lambda ln(J) / l = 0, solved by
  // bisection.
  const Material& material = scene.parts[0].setup.material;
  const bool strain = GetParam().formulation == "plane_strain";
  const auto log_jacobian = [&](double l) { return std::log(l * stretch * (strain ? 1 : l)); };
  double low = 0.3, high = 1;
  for (int i = 0; i < 100; ++i) {
    const double l = 0.5 * (low + high);
    (material.mu() * (l - 1 / l) + material.lambda() * log_jacobian(l) / l < 0 ? low : high) = l;
  }
  const double force =
      material.mu() * (stretch - 1 / stretch) + material.lambda() * log_jacobian(low) / stretch;
  const double area = GetParam().formulation == "axisymmetric" ? std::acos(-1.) : 1;

  // The residual is below 1e-10 of the forces; displacements follow it within the stiffness, of order one
  // here.
  const Mesh& mesh = simulation.mesh();
  const auto d = static_cast<std::size_t>(mesh.dimension);
  const std::vector<double> reactions = simulation.reactions();
  double pull = 0;
  for (const int node : mesh.node_sets.at("b.y_max"))
    pull += reactions[static_cast<std::size_t>(node) * d + 1];
  EXPECT_NEAR(pull, force * area, 1e-9 * force);
  for (const int node : mesh.node_sets.at("b.x_max"))
    EXPECT_NEAR(1 + simulation.now().displacement[static_cast<std::size_t>(node) * d], low, 1e-9);

  // Newton: r[n] <= C r[n-1]^2; C = 10 is generous for strains of order one, 1e-13 is rounding.
  for (const StepRecord& record : records) {
    std::vector<double> residuals = record.increments.back().residuals;
    EXPECT_TRUE(quadratic(residuals, 10, 1e-13));
    residuals.pop_back();
    EXPECT_TRUE(quadratic(residuals, 10, 1e-13));
  }
}

INSTANTIATE_TEST_SUITE_P(All, NeoHookeTension,
                         testing::Values(Body{"tri3", "plane_strain"}, Body{"quad4", "plane_strain"},
                                         Body{"tri3", "plane_stress"}, Body{"quad4", "plane_stress"},
                                         Body{"quad4", "axisymmetric"}, Body{"tet4", ""}, Body{"hex8", ""}));

/// Thick tube, inner radius 1, outer 2, under inner pressure 1, held at its ends: error of the inner
/// displacement.
double tube_error(const std::string& element, int divisions) {
  const Scene scene =
      test::scene_from({{"dimension", 2},
                        {"formulation", "axisymmetric"},
                        {"materials", {{"m", {{"law", "linear_elastic"}, {"young", 100}, {"poisson", 0.3}}}}},
                        {"parts",
                         {{{"name", "b"},
                           {"material", "m"},
                           {"element", element},
                           {"x", axis(1, 2, divisions)},
                           {"y", axis(0, 2. / divisions, 2)}}}},
                        {"supports", {{{"nodes", "b.y_min"}, {"y", 0}}, {{"nodes", "b.y_max"}, {"y", 0}}}},
                        {"tractions", {{{"faces", "b.x_min"}, {"value", {1, 0}}}}},
                        {"steps", {{"control", "load_factor"}, {"values", {1}}}}});
  Simulation simulation(scene, nullptr);
  solve(simulation, {});
  // Lame: u = (1 + nu)/E * p a^2 / (b^2 - a^2) * ((1 - 2 nu) r + b^2 / r) at r = a = 1, b = 2.
  const double exact = 1.3 / 100 * (1. / 3) * (0.4 + 4);
  const int node = simulation.mesh().node_sets.at("b.x_min")[1];
  return simulation.now().displacement[static_cast<std::size_t>(node) * 2] / exact - 1;
}

/// Two layers on each other, glued, whose sides cannot bulge.
Json layers(bool solid) {
  Json scene{{"dimension", solid ? 3 : 2},
             {"materials",
              {{"soft", {{"law", "linear_elastic"}, {"young", 10}, {"poisson", 0.3}}},
               {"hard", {{"law", "linear_elastic"}, {"young", 700}, {"poisson", 0.2}}}}},
             {"steps", {{"control", "load_factor"}, {"values", {1}}}}};
  if (!solid) scene["formulation"] = "plane_strain";
  const std::string up = solid ? "z" : "y";
  for (const bool above : {false, true}) {
    Json part{{"name", above ? "coat" : "base"},
              {"material", above ? "hard" : "soft"},
              {"element", solid ? "hex8" : "quad4"},
              {"x", axis(0, 0.7, 3)},
              {"y", axis(0, 1.1, 2)}};
    part[up] = above ? axis(2, 2.5, 1) : axis(0, 2, 2);
    scene["parts"].push_back(part);
    for (const std::string side : {"x", "y"})
      for (const std::string end : {"_min", "_max"})
        if (side != up)
          scene["supports"].push_back(
              {{"nodes", part["name"].get<std::string>() + "." + side + end}, {side, 0}});
  }
  scene["supports"].push_back({{"nodes", "base." + up + "_min"}, {up, 0}});
  scene["supports"].push_back({{"nodes", "coat." + up + "_max"}, {up, -0.01}});
  scene["tied"] = Json::array({Json::array({"base." + up + "_max", "coat." + up + "_min"})});
  return scene;
}

TEST(TiedBodies, ShareTheirDisplacementAsLayersDo) {
  for (const bool solid : {false, true}) {
    const Scene scene = test::scene_from(layers(solid));
    Simulation simulation(scene, nullptr);
    solve(simulation, {});
    const auto compliance = [&](std::size_t part, double height) {
      const Material& m = scene.parts[part].setup.material;
      return height / (m.lambda() + 2 * m.mu());
    };
    const double soft = compliance(0, 2), hard = compliance(1, 0.5), expected = -0.01 * soft / (soft + hard);
    const std::size_t d = solid ? 3 : 2;
    const Mesh& mesh = simulation.mesh();
    for (const char* side : {solid ? "base.z_max" : "base.y_max", solid ? "coat.z_min" : "coat.y_min"})
      for (const int node : mesh.node_sets.at(side))
        EXPECT_NEAR(simulation.now().displacement[static_cast<std::size_t>(node) * d + d - 1], expected,
                    1e-13);
  }
}

TEST(TiedBodies, HaveTheSameNodes) {
  for (const bool apart : {false, true}) {
    Json json = layers(false);
    json["parts"][1][apart ? "y" : "x"] = apart ? axis(2.001, 2.5, 1) : axis(0, 0.7, 4);
    const Scene scene = test::scene_from(json);
    try {
      Simulation simulation(scene, nullptr);
      FAIL() << "accepted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("/tied/0: sides that are tied have the same nodes"),
                std::string::npos)
          << error.what();
    }
  }
}

TEST(Tube, ConvergesAtSecondOrder) {
  for (const char* element : {"quad4", "tri3"}) {
    const double coarse = tube_error(element, 8), medium = tube_error(element, 16),
                 fine = tube_error(element, 32);
    EXPECT_NEAR(std::log2(coarse / medium), 2, 0.1) << element;
    EXPECT_NEAR(std::log2(medium / fine), 2, 0.05) << element;
  }
}

TEST(Cantilever, DeflectsLikeTimoshenkosBeam) {
  const double length = 10, height = 1, load = 1e-3, young = 100, poisson = 0.3;
  const Scene scene = test::scene_from(
      {{"dimension", 2},
       {"formulation", "plane_stress"},
       {"materials", {{"m", {{"law", "linear_elastic"}, {"young", young}, {"poisson", poisson}}}}},
       {"parts",
        {{{"name", "b"},
          {"material", "m"},
          {"element", "quad4"},
          {"x", axis(0, length, 160)},
          {"y", axis(0, height, 16)}}}},
       {"supports", {{{"nodes", "b.x_min"}, {"x", 0}, {"y", 0}}}},
       {"tractions", {{{"faces", "b.x_max"}, {"value", {0, -load}}}}},
       {"steps", {{"control", "load_factor"}, {"values", {1}}}}});
  Simulation simulation(scene, nullptr);
  solve(simulation, {});
  const double inertia = height * height * height / 12, shear = young / (2 * (1 + poisson));
  const double exact =
      load * length * length * length / (3 * young * inertia) + load * length / (5. / 6 * shear);
  const int node = simulation.mesh().node_sets.at("b.x_max").front();
  // 16 elements of full integration over the height are too stiff by about (1/16)^2 = 0.4 %; the clamped
  // end's restraint of the cross-section gives (height/length)^2 * nu = 0.3 %.
  EXPECT_NEAR(-simulation.now().displacement[static_cast<std::size_t>(node) * 2 + 1] / exact, 1, 0.01);
}

TEST(HalfSpace, BoussinesqsDisplacementIsInEquilibrium) {
  const Material material{Material::Law::linear_elastic, 210, 0.3};
  const std::array<double, 3> direction{0, 0, -1};
  const auto u = [&](double x, double y, double z) { return boussinesq(material, {x, y, z}, direction); };
  // On the surface: u_z = (1 - nu^2) / (pi E r) per unit force.
  EXPECT_NEAR(-u(2, 0, 0)[2], (1 - 0.09) / (std::acos(-1.) * 210 * 2), 1e-15);
  // Inside: (lambda + mu) grad div u + mu laplace u = 0, by central differences of error h^2 = 1e-6 relative.
  const double h = 1e-3;
  const Eigen::Vector3d at(0.7, -0.4, -0.9);
  const auto shifted = [&](int i, double a, int j, double b) {
    Eigen::Vector3d x = at;
    x[i] += a;
    x[j] += b;
    const auto value = u(x[0], x[1], x[2]);
    return Eigen::Vector3d(value[0], value[1], value[2]);
  };
  const auto second = [&](int i, int j) -> Eigen::Vector3d {
    if (i == j) return (shifted(i, h, j, 0) - 2 * shifted(i, 0, j, 0) + shifted(i, -h, j, 0)) / (h * h);
    return (shifted(i, h, j, h) - shifted(i, h, j, -h) - shifted(i, -h, j, h) + shifted(i, -h, j, -h)) /
           (4 * h * h);
  };
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  double size = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      force[i] += (material.lambda() + material.mu()) * second(i, j)[j] + material.mu() * second(j, j)[i];
      size = std::max(size, material.lambda() * std::abs(second(i, j)[j]));
    }
  EXPECT_LT(force.norm(), 1e-5 * size);
}

TEST(Newton, NamesTheReasonWhenAStepCannotBeCutAnyFurther) {
  Json json = tension({"quad4", "plane_strain"}, 1.6);
  json["supports"][2]["y"] = -1.5; // through itself
  json["solver"] = {{"min_step", 0.01}};
  const Scene scene = test::scene_from(json);
  Simulation simulation(scene, nullptr);
  try {
    solve(simulation, {});
    FAIL();
  } catch (const JobError& error) {
    EXPECT_NE(std::string(error.what()).find("step 2"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("min_step"), std::string::npos) << error.what();
  }
}

} // namespace
} // namespace host::solution_test
