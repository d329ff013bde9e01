// SPDX-License-Identifier: BSD-3-Clause
// The work of an evaluation has a bound, whatever the input; its own counter shows it.
#include <gtest/gtest.h>

#include "sample_count.hpp"
#include "support/element.hpp"

namespace bounded_work_test {
namespace {

using namespace test;

// Evaluations of the surface by one iteration from a start value: at most 30, and one count beyond.
constexpr int per_iteration = 31;
// A search ends at the box or iteration with which it has spent 10000; before it the start value's own
// iteration.
constexpr int most = per_iteration + 10000 + 1 + per_iteration;

std::string fine_texture(const Basis& b) {
  return R"({"segment": ")" + std::string(b.name) +
         R"(", "height": {"type": "sine", "amplitude": 0.001, "wave_vector": )" +
         (b.dimension == 2 ? "[5e4]" : "[4e3, 7e3]") +
         R"(}, "contact": {"normal": {"type": "penalty", "stiffness": 1}}})";
}

TEST(BoundedWork, IterationsStayBelowTheirBound) {
  Random random(121);
  int worst = 0, worst_from_start = 0, evaluations = 0, ok = 0;
  std::vector<std::pair<ModelKind, std::string>> models;
  for (const ModelKind& kind : all_kinds()) models.push_back({kind, text(kind)});
  for (const Basis& b : bases()) models.push_back({{b.name, "sine"}, fine_texture(b)});
  for (const auto& [kind, model_text] : models) {
    const Model model(model_text);
    Results results(model.layout);
    for (int i = 0; i < long_samples(60); ++i) {
      Element e = draw(model, basis(kind.basis), random);
      const double spread = std::pow(10.0, random(-3.0, 4.0)); // near, far and very far slaves
      for (double& x : e[slave]) x += spread * random(-1.0, 1.0);
      if (i % 3 == 0) e[start].clear();
      if (i % 3 == 1)
        for (double& x : e[start]) x = random(-4.0, 4.0);
      if (i % 5 == 0) // nodes anywhere: folded, twisted, thin
        for (double& x : e[master]) x = random(-1.0, 1.0);
      ++evaluations;
      if (test::evaluate(model, e, want_element | want_values, results) != ENTS_OK) continue;
      ++ok;
      worst = std::max(worst, results.iterations);
      if (!(results.flags & ENTS_FLAG_SEARCHED))
        worst_from_start = std::max(worst_from_start, results.iterations);
      ASSERT_GE(results.iterations, 1);
    }
  }
  RecordProperty("worst", worst);
  RecordProperty("worst_from_start", worst_from_start);
  EXPECT_LE(worst, most);
  EXPECT_LE(worst_from_start, per_iteration);
  EXPECT_GT(worst, 100) << "the test does not reach a search";
  EXPECT_GT(ok, evaluations / 2);
}

// Near the solution the projection takes a few steps, not the bound.
TEST(BoundedWork, NearStartsTakeFewIterations) {
  Random random(122);
  double sum = 0.0;
  int count = 0, worst = 0;
  for (const ModelKind& kind : all_kinds()) {
    const Model model(text(kind));
    Results results(model.layout);
    for (int i = 0; i < 20; ++i) {
      const Element e = draw(model, basis(kind.basis), random); // starts 0.02 off
      if (test::evaluate(model, e, want_values, results) != ENTS_OK || (results.flags & ENTS_FLAG_SEARCHED))
        continue;
      sum += results.iterations;
      worst = std::max(worst, results.iterations);
      ++count;
    }
  }
  EXPECT_LE(sum / count, 5.0); // quadratic convergence: 0.02, 4e-4, 2e-7, 3e-14, and the last evaluation
  EXPECT_LE(worst, 12);
}

} // namespace
} // namespace bounded_work_test
