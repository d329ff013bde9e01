// SPDX-License-Identifier: BSD-3-Clause
// The contact patch test (Taylor and Papadopoulos 1991): a uniform pressure between blocks whose meshes do
// not match. Forces in slave nodes cannot transmit it to another mesh's nodes; points inside the faces can,
// the better the more there are.
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <tuple>

#include <gtest/gtest.h>

#include "support.hpp"

namespace host::patch_test {
namespace {

struct Pressures {
  double largest = 0, smallest = 0, scatter = 0;
};

Pressures pressures(const Scene& scene) {
  Simulation simulation(scene, &test::library());
  const StepRecord record = solve(simulation, {}).back();
  // Whatever the scatter, the whole force comes through: the traction of 1 on an area of 1.
  EXPECT_NEAR(record.contact_force.back(), -1, 1e-9);
  return {test::quantity(record, "largest pressure").value, test::quantity(record, "smallest pressure").value,
          test::quantity(record, "scatter of the pressure (rms)").value};
}

/// @param upper, lower  elements of the bodies in space
Scene with_slave(const std::function<void(Json&)>& edit, bool solid, const char* upper = "hex8",
                 const char* lower = "hex8") {
  return test::shipped_scene("patch_test", [&](Json& scene) {
    edit(scene["contact"]);
    scene.erase("variants");
    if (!solid) return;
    scene["dimension"] = 3;
    scene.erase("formulation");
    const auto spread = [](Json& part, const char* element, int divisions, double growth) {
      part["element"] = element;
      part["z"] = part["y"];
      part["y"] = {{"from", 0}, {"pieces", {{{"to", 1}, {"divisions", divisions}, {"growth", growth}}}}};
    };
    spread(scene["parts"][0], upper, 4, 0.9);
    spread(scene["parts"][1], lower, 3, 1);
    Json supports = Json::array();
    for (const char* part : {"upper", "lower"})
      for (const char* axis : {"x", "y"})
        for (const char* side : {"_min", "_max"})
          supports.push_back({{"nodes", std::string(part) + "." + axis + side}, {axis, 0}});
    supports.push_back({{"nodes", "lower.z_min"}, {"z", 0}});
    scene["supports"] = supports;
    scene["tractions"] = {{{"faces", "upper.z_max"}, {"value", {0, 0, -1}}}};
    scene["contact"]["slave"] = "upper.z_min";
    scene["contact"]["master"]["faces"] = "lower.z_max";
    scene["contact"]["model"]["segment"] = std::string(lower) == "tet4" ? "tri3" : "quad4";
  });
}

TEST(PatchTest, SamplingPointsRecoverWhatNodesCannotTransmit) {
  for (const bool solid : {false, true}) {
    const auto measure = [&](const char* what, const std::function<void(Json&)>& edit) {
      const Pressures p = pressures(with_slave(edit, solid));
      std::printf("%s, %-26s pressure %.5f to %.5f, scatter %.1e\n", solid ? "3D" : "2D", what, p.smallest,
                  p.largest, p.scatter);
      return p.scatter;
    };
    const auto sampling = [&](int n) {
      return measure(("sampling " + std::to_string(n)).c_str(),
                     [n](Json& contact) { contact["sampling"] = n; });
    };
    const double equal = measure("nodes of equal areas", [](Json& contact) { contact["areas"] = "equal"; });
    const double tributary = measure("nodes of tributary areas", [](Json&) {});
    EXPECT_GT(equal, 0.3);      // wrong by a third,
    EXPECT_GT(tributary, 0.01); // by some per cent,
    const double coarse = sampling(2), medium = sampling(8), fine = sampling(32);
    // and then with the order of a quadrature over kinks, which is between one and two
    EXPECT_LT(medium, coarse / 4);
    EXPECT_LT(fine, medium / 4);
    EXPECT_LT(fine, 2e-4);
  }
}

// On the pieces of the slave faces the shape functions of both bodies are polynomials, of degree 1 on
// triangles, of degree 2 on rectangles: a rule of that degree gives every node of both surfaces the exact
// integral of its shape function, which is its force under a uniform pressure. What is left is the residual,
// 1e-12 of the forces, over the smallest share of a node in them, some hundredths.
TEST(PatchTest, CutFacesPass) {
  const auto scatter = [](const Json& sampling, bool solid, const char* upper, const char* lower) {
    const Scene scene =
        with_slave([&](Json& contact) { contact["sampling"] = sampling; }, solid, upper, lower);
    Scene tight = scene;
    tight.solver.tolerance = 1e-12;
    const Pressures p = pressures(tight);
    std::printf("%s %s over %s: pressure 1 %+.1e %+.1e, scatter %.1e\n", sampling.dump().c_str(),
                solid ? upper : "quad4", solid ? lower : "quad4", p.smallest - 1, p.largest - 1, p.scatter);
    return std::max({p.scatter, p.largest - 1, 1 - p.smallest});
  };
  for (const Json& sampling : {Json("cut"), Json{{"cut", 1}}, Json{{"cut", 5}}})
    EXPECT_LT(scatter(sampling, false, "", ""), 1e-10);
  for (const Json& sampling : {Json("cut"), Json{{"cut", 5}}})
    for (const char* upper : {"hex8", "tet4"})
      for (const char* lower : {"hex8", "tet4"}) EXPECT_LT(scatter(sampling, true, upper, lower), 1e-10);
  EXPECT_LT(scatter({{"cut", 1}}, true, "tet4", "tet4"), 1e-10);
  EXPECT_GT(scatter({{"cut", 1}}, true, "hex8", "tet4"), 1e-3); // degree 1 is not enough there
}

// With matching meshes both are exact, up to the penalty's own unevenness: none, the pressure is uniform.
TEST(PatchTest, MatchingMeshesAreExact) {
  for (const int points : {0, 1, 3}) {
    const Scene matching = test::shipped_scene("patch_test", [points](Json& json) {
      json["parts"][0]["x"] = json["parts"][1]["x"];
      if (points > 0) json["contact"]["sampling"] = points;
      json.erase("variants");
    });
    EXPECT_LT(pressures(matching).scatter, 1e-8) << points; // the residual is below 1e-10 of the forces
  }
}

/// A deck of 4 x 4 x 2 cells of a block 1 x 1 x 0.5: bricks, and in every other row along x two wedges in each
/// cell.
std::filesystem::path bricks_and_wedges(const std::filesystem::path& file, double low) {
  constexpr int n = 4, layers = 2;
  std::ostringstream nodes, bricks, wedges;
  nodes.precision(17);
  const auto number = [](int i, int j, int k) { return 1 + i + (n + 1) * (j + (n + 1) * k); };
  std::map<std::string, std::string> sets;
  for (int k = 0; k <= layers; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        nodes << number(i, j, k) << ", " << double(i) / n << ", " << double(j) / n << ", "
              << low + 0.5 * k / layers << "\n";
        const std::string line = std::to_string(number(i, j, k)) + "\n";
        for (const auto& [at, end, axis] : {std::tuple(i, n, 'X'), {j, n, 'Y'}, {k, layers, 'Z'}}) {
          if (at == 0) sets[std::string(1, axis) + "MIN"] += line;
          if (at == end) sets[std::string(1, axis) + "MAX"] += line;
        }
      }
  int e = 1;
  for (int k = 0; k < layers; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        if (i % 2 == 1) {
          for (const int side : {0, 1}) {
            wedges << e++;
            for (int z = k; z <= k + 1; ++z)
              wedges << ", " << number(i, j, z) << ", " << number(i + 1, j + side, z) << ", "
                     << number(i + 1 - side, j + 1, z);
            wedges << "\n";
          }
          continue;
        }
        bricks << e++;
        for (int z = k; z <= k + 1; ++z)
          bricks << ", " << number(i, j, z) << ", " << number(i + 1, j, z) << ", " << number(i + 1, j + 1, z)
                 << ", " << number(i, j + 1, z);
        bricks << "\n";
      }
  std::ofstream out(file);
  out << "*NODE\n"
      << nodes.str() << "*ELEMENT, TYPE=C3D8\n"
      << bricks.str() << "*ELEMENT, TYPE=C3D6\n"
      << wedges.str();
  for (const auto& [set, members] : sets) out << "*NSET, NSET=" << set << "\n" << members;
  return file;
}

// Bodies whose common face has triangles and quadrilaterals: with one mesh on both sides nodes, points and
// pieces are exact.
TEST(PatchTest, SurfacesOfTrianglesAndQuadrilateralsPass) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("ents_mixed_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::filesystem::path upper = bricks_and_wedges(folder / "upper.inp", -1e-6),
                              lower = bricks_and_wedges(folder / "lower.inp", -0.5);
  for (const Json& sampling : {Json(0), Json(1), Json(2), Json("cut")}) {
    Scene scene = test::shipped_scene("patch_test", [&](Json& json) {
      json.erase("variants"), json.erase("formulation");
      json["dimension"] = 3;
      json["parts"] = {{{"name", "upper"}, {"material", "block"}, {"deck", upper.string()}},
                       {{"name", "lower"}, {"material", "block"}, {"deck", lower.string()}}};
      Json supports = Json::array({{{"nodes", "lower.ZMIN"}, {"z", 0}}});
      for (const char* part : {"upper", "lower"})
        for (const char* axis : {"x", "y"})
          for (const char* end : {"MIN", "MAX"})
            supports.push_back(
                {{"nodes", std::string(part) + "." + (*axis == 'x' ? "X" : "Y") + end}, {axis, 0}});
      json["supports"] = supports;
      json["tractions"] = {{{"faces", "upper.ZMAX"}, {"value", {0, 0, -1}}}};
      json["contact"]["slave"] = "upper.ZMIN";
      json["contact"]["master"]["faces"] = "lower.ZMAX";
      json["contact"]["model"]["segment"] = "quad4";
      if (sampling != 0) json["contact"]["sampling"] = sampling;
    });
    scene.solver.tolerance = 1e-12;
    const Pressures p = pressures(scene);
    std::printf("triangles and quadrilaterals, sampling %s: pressure 1 %+.1e %+.1e\n",
                sampling.dump().c_str(), p.smallest - 1, p.largest - 1);
    // the residual, 1e-12 of the forces, over the smallest share of a node in them, some hundredths
    EXPECT_LT(std::max(p.largest - 1, 1 - p.smallest), 1e-10) << sampling;
  }
  std::filesystem::remove_all(folder);
}

// Round an axis the forces are integrals of shape function times radius, of degree 2. Two points of Gauss and
// Legendre are exact; a single one is, if it lies at the centroid of the ring. (In the middle of the face it
// gave the node on the axis half of its share again: 32 % less pressure there.) On faces of another mesh,
// pieces are exact at the axis and at the edge, and points of whole faces wrong by up to half of the
// pressure.
TEST(PatchTest, AxisymmetricFacesPass) {
  const auto scatter = [](const Json& sampling, int upper, int lower) {
    Scene scene = test::shipped_scene("patch_test", [&](Json& json) {
      json["formulation"] = "axisymmetric";
      json["parts"][0]["x"] = test::axis(0, 1, upper), json["parts"][1]["x"] = test::axis(0, 1, lower);
      json["contact"]["sampling"] = sampling;
      json.erase("variants");
    });
    scene.solver.tolerance = 1e-12;
    Simulation simulation(scene, &test::library());
    const StepRecord record = solve(simulation, {}).back();
    const double smallest = test::quantity(record, "smallest pressure").value,
                 largest = test::quantity(record, "largest pressure").value;
    std::printf("axisymmetric, %d over %d, %s: pressure 1 %+.1e %+.1e\n", upper, lower,
                sampling.dump().c_str(), smallest - 1, largest - 1);
    return std::max(largest - 1, 1 - smallest);
  };
  for (const int n : {1, 2, 3}) EXPECT_LT(scatter(n, 6, 6), 1e-10);
  for (const Json& sampling : {Json("cut"), Json{{"cut", 1}}, Json{{"cut", 3}}})
    for (const auto& [upper, lower] : {std::pair(6, 6), std::pair(10, 7), std::pair(7, 10), std::pair(8, 16)})
      EXPECT_LT(scatter(sampling, upper, lower), 1e-10);
  EXPECT_GT(scatter(3, 8, 16), 0.3);
}

TEST(PatchTest, BadKeysAreNamed) {
  const auto expect = [](const char* key, const Json& value, const char* text) {
    try {
      with_slave([&](Json& contact) { contact["sampling"] = 2, contact[key] = value; }, false);
      FAIL() << key;
    } catch (const std::exception& error) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  };
  expect("areas", "equal", "/contact/areas");
  expect("sampling", 0, "/contact/sampling");
  expect("sampling", "many", "/contact/sampling");
  expect("sampling", {{"cut", 0}}, "/contact/sampling/cut");
  expect("sampling", {{"cut", 17}}, "/contact/sampling/cut");
  expect("sampling", {{"cut", 2}, {"points", 2}}, "/contact/sampling");
}

} // namespace
} // namespace host::patch_test
