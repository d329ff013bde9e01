// SPDX-License-Identifier: BSD-3-Clause
// A belt over a turning drum: full steps of Newton's iteration drag it along until projections fail or
// elements turn inside out; a line search solves the same increments without a cut.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "support.hpp"

namespace host::line_search_test {
namespace {

/// Of the decks, as long as the program runs.
struct Folder {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("ents-belt-" + std::to_string(std::random_device{}()));
  Folder() { std::filesystem::create_directory(path); }
  ~Folder() { std::filesystem::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
};

/// Half a ring of inner radius 1 with a straight end on both sides, INNER its face on the drum.
std::string write_belt(double thickness, int layers) {
  static const Folder folder;
  const std::filesystem::path file = folder.path / ("belt-" + std::to_string(layers) + ".inp");
  std::ofstream deck(file);
  deck.precision(17);
  constexpr int around = 40, straight = 5, columns = around + 2 * straight;
  constexpr double pitch = std::numbers::pi / around;
  const auto number = [layers](int i, int j) { return 1 + j + (layers + 1) * i; };
  deck << "*NODE\n";
  for (int i = 0; i <= columns; ++i)
    for (int j = 0; j <= layers; ++j) {
      const int bent = std::min(std::max(i - straight, 0), around);
      const double angle = pitch * bent, radius = 1 + thickness * j / layers;
      deck << number(i, j) << ", " << radius * std::cos(angle) << ", "
           << radius * std::sin(angle) - pitch * std::abs(i - straight - bent) << "\n";
    }
  deck << "*ELEMENT, TYPE=CPE4, ELSET=BELT\n";
  std::string inner;
  for (int i = 0, element = 0; i < columns; ++i)
    for (int j = 0; j < layers; ++j) {
      deck << ++element << ", " << number(i, j) << ", " << number(i, j + 1) << ", " << number(i + 1, j + 1)
           << ", " << number(i + 1, j) << "\n";
      if (j == 0) inner += std::to_string(element) + ", S4\n";
    }
  for (const auto& [name, column] : {std::pair{"RIGHT", 0}, {"LEFT", columns}})
    deck << "*NSET, NSET=" << name << ", GENERATE\n"
         << number(column, 0) << ", " << number(column, layers) << ", 1\n";
  deck << "*SURFACE, NAME=INNER\n" << inner;
  return file.string();
}

/// Both ends are pulled by 0.02, then the drum turns by .126 rad in each of four steps.
Json belt(double thickness, int layers, double young, double stiffness, const char* line_search) {
  constexpr int segments = 24, turns = 4;
  const double step = 2 * std::numbers::pi / segments,
               radius = 3 / (2 + std::cos(step)); // of a spline about 1
  Json json{{"dimension", 2},
            {"formulation", "plane_strain"},
            {"materials", {{"belt", {{"law", "st_venant_kirchhoff"}, {"young", young}, {"poisson", 0.3}}}}},
            {"parts", {{{"name", "belt"}, {"material", "belt"}, {"deck", write_belt(thickness, layers)}}}},
            {"steps", {{"control", "load_factor"}, {"values", {1, 2, 3, 4, 5}}}},
            {"solver", {{"line_search", line_search}}}};
  const Json pull{{0, 0}, {1, 1}};
  for (const char* end : {"belt.RIGHT", "belt.LEFT"})
    json["supports"].push_back({{"nodes", end}, {"x", 0}, {"y", -0.02}, {"path", pull}});
  Json body{{"prescribed", {{{"turn", 0.126 * turns}, {"path", {{1, 0}, {1 + turns, 1}}}}}}};
  for (int i = 0; i < segments; ++i) {
    body["nodes"].push_back({radius * std::cos(-step * i), radius * std::sin(-step * i)});
    Json segment;
    for (const int k : {-1, 0, 1, 2}) segment.push_back((i + k + segments) % segments);
    body["segments"].push_back(segment);
  }
  json["contact"] = {
      {"slave", "belt.INNER"},
      {"master", {{"rigid_body", body}}},
      {"model",
       {{"segment", "bspline4"},
        {"contact",
         {{"normal", {{"type", "penalty"}, {"stiffness", stiffness}}},
          {"friction", {{"type", "coulomb"}, {"coefficient", 0.3}, {"stiffness", stiffness}}}}}}}};
  return json;
}

struct Totals {
  std::size_t cuts = 0;
  int iterations = 0, halvings = 0;
  double moment = 0;
};
Totals totals_of(const Json& json) {
  const Scene scene = test::scene_from(json);
  Simulation simulation(scene, &test::library());
  Totals sum;
  for (const StepRecord& record : solve(simulation, {})) {
    sum.cuts += record.cuts.size();
    sum.iterations += record.iterations();
    for (const IncrementRecord& increment : record.increments) sum.halvings += increment.halvings;
    sum.moment = record.moment.front();
  }
  return sum;
}

TEST(LineSearch, ABeltOverATurningDrumNeedsNoCut) {
  const Totals without = totals_of(belt(0.05, 2, 100, 1000, "never")),
               with = totals_of(belt(0.05, 2, 100, 1000, "when_needed")),
               always = totals_of(belt(0.05, 2, 100, 1000, "always"));
  std::printf("never: %zu cuts, %d iterations; when needed: %zu, %d; always: %zu, %d, %d halvings\n",
              without.cuts, without.iterations, with.cuts, with.iterations, always.cuts, always.iterations,
              always.halvings);
  EXPECT_GT(without.cuts, 0u);
  EXPECT_EQ(without.halvings, 0);
  EXPECT_EQ(with.cuts, 0u);
  EXPECT_EQ(always.cuts, 0u);
  EXPECT_LT(with.iterations, without.iterations);
  // All of it slips at the end: the way there does not matter.
  EXPECT_NEAR(with.moment / without.moment, 1, 1e-8);
  EXPECT_NEAR(always.moment / without.moment, 1, 1e-8);
}

// Five times as slender, where no cut helps.
TEST(LineSearch, SolvesWhatCutsDoNot) {
  EXPECT_THROW(totals_of(belt(0.01, 1, 1000, 1e5, "never")), JobError);
  const Totals with = totals_of(belt(0.01, 1, 1000, 1e5, "when_needed"));
  EXPECT_GT(with.halvings, 0);
  EXPECT_LE(with.cuts, 1u);
}

TEST(LineSearch, IsOneOfThreeWords) {
  EXPECT_NE(test::refusal(belt(0.05, 2, 100, 1000, "yes")).find("/solver/line_search"), std::string::npos);
}

TEST(Messages, SayTheStatusOnce) {
  auto report = ents_struct<ents_report>();
  const std::string text = test::library().status_text(ENTS_NO_PROJECTION), message = "element 7: " + text;
  message.copy(report.message, message.size());
  EXPECT_EQ(describe(test::library(), ENTS_NO_PROJECTION, report), message);
}

} // namespace
} // namespace host::line_search_test
