// SPDX-License-Identifier: BSD-3-Clause
// Scenes of the reference host through adapters: same solution, same iterations.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <ostream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace {

nlohmann::json run(const std::string& scene, const std::string& adapter) {
  const std::string command = std::string(ENTS_HOST) + " run " + ENTS_EXAMPLES + "/" + scene +
                              "/scene.json --json --adapter " + adapter;
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  std::array<char, 4096> part;
  while (const std::size_t size = fread(part.data(), 1, part.size(), pipe.get()))
    text.append(part.data(), size);
  return nlohmann::json::parse(text);
}

struct Case {
  const char *scene, *adapter;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.scene << " through " << c.adapter; }

class Scenes : public testing::TestWithParam<Case> {};

TEST_P(Scenes, SolvedAsWithoutAdapter) {
  const auto [scene, adapter] = GetParam();
  static std::map<std::string, nlohmann::json> solved; // once for all adapters
  nlohmann::json& plain = solved[scene];
  if (plain.is_null()) plain = run(scene, "plain")["steps"];
  const nlohmann::json through = run(scene, adapter)["steps"];
  ASSERT_EQ(plain.size(), through.size());
  double force = 0, motion = 0;
  const auto keep = [](double& worst, double a, double b) {
    worst = std::max(worst, std::abs(a - b) / std::max(std::abs(a), 1e-300));
  };
  for (std::size_t k = 0; k < plain.size(); ++k) {
    EXPECT_EQ(plain[k]["iterations"], through[k]["iterations"]) << "step " << k + 1;
    for (const char* key : {"force", "mean_pressure", "peak_pressure"})
      keep(force, plain[k][key], through[k][key]);
    keep(motion, plain[k]["approach"], through[k]["approach"]);
  }
  // The last bits of a projection depend on where its iteration started, and the plain host starts where it
  // last was. Forces balance to the scenes' tolerance, 1e-10; motions, after one more quadratic step than
  // that takes, to the roundings.
  EXPECT_LE(force, 1e-10);
  EXPECT_LE(motion, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Adapters, Scenes,
                         testing::Values(Case{"hertz2d", "abaqus"}, Case{"hertz2d", "marc"},
                                         Case{"wavy3d", "abaqus"}, Case{"wavy3d", "calculix"},
                                         Case{"slope", "abaqus"}, Case{"slope", "marc"},
                                         Case{"cattaneo_mindlin", "abaqus"}),
                         [](const auto& test) {
                           return std::string(test.param.scene) + "_" + test.param.adapter;
                         });

} // namespace
