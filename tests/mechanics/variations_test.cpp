// Kinematics: gap_gradient and xi_gradient are the derivatives of gap and xi, gap_hessian and xi_hessian
// those of the gradients.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "differences.hpp"
#include "samples.hpp"
#include "worst.hpp"

namespace mechanics::variations_test {
namespace {

// A quantity, its derivative, and how many entries the quantity has.
struct Pair {
  const char* name;
  std::vector<double> Results::*quantity;
  std::vector<double> Results::*derivative; // [rows][dofs]
  std::size_t rows;
};

class Variations : public testing::TestWithParam<std::string> {
protected:
  // As for the element (element_derivatives_test.cpp): rounding 1e-15 of the differentiated quantity
  // times 1.5 / step, truncation step^4 / 30 over a length to the fourth. The gradient of xi changes faster
  // than that of the gap: lengths down to 0.02.
  static constexpr double step = 4e-4, tolerance = 1e-7;

  static std::vector<Pair> pairs_of(const Basis& basis) {
    const std::size_t n = static_cast<std::size_t>(basis.dofs()),
                      t = static_cast<std::size_t>(basis.parameters());
    return {{"gap_gradient", &Results::gap, &Results::gap_gradient, 1},
            {"xi_gradient", &Results::xi, &Results::xi_gradient, t},
            {"gap_hessian", &Results::gap_gradient, &Results::gap_hessian, n},
            {"xi_hessian", &Results::xi_gradient, &Results::xi_hessian, t * n}};
  }

  // Largest entry of derivative . v minus the difference, relative to the largest entry of the derivative
  static double error_of(const Pair& pair, const Results& centre, std::size_t e, const Results& points,
                         const double* v, std::size_t dofs, double t) {
    const double* derivative = (centre.*pair.derivative).data() + e * pair.rows * dofs;
    const double* quantity = (points.*pair.quantity).data() + e * stencil_points * pair.rows;
    double worst = 0.0;
    for (std::size_t i = 0; i < pair.rows; ++i)
      test::raise(
          worst, std::fabs(difference(quantity + i, pair.rows, t) - times_direction(derivative, v, dofs, i)));
    return worst / largest_entry(derivative, pair.rows * dofs);
  }

  void check(const Scene& scene, const Model& model, const Elements& centres, Random& random) {
    const Basis& basis = *scene.basis;
    const std::size_t dofs = static_cast<std::size_t>(basis.dofs());
    const std::vector<Pair> pairs = pairs_of(basis);
    const Height height(scene.height, basis.parameters());
    const std::vector<double> v = draw_directions(random, centres.count, basis.dofs());
    constexpr std::int32_t lower = ENTS_XI | ENTS_GAP | ENTS_GAP_GRADIENT | ENTS_XI_GRADIENT;
    const Results centre = model.evaluate(centres, lower | ENTS_GAP_HESSIAN | ENTS_XI_HESSIAN);
    const Elements near = stencil(centres, basis, v, step, centre.xi);
    const Results points = model.evaluate(near, lower);
    const Results nearer = model.evaluate(stencil(centres, basis, v, step / 8.0, centre.xi), lower);
    for (std::size_t e = 0; e < static_cast<std::size_t>(centres.count); ++e) {
      bool ok = centre.ok(static_cast<std::int64_t>(e));
      for (std::size_t k = stencil_points * e; k < stencil_points * (e + 1); ++k)
        ok = ok && points.ok(static_cast<std::int64_t>(k)) && nearer.ok(static_cast<std::int64_t>(k));
      if (!ok || !in_one_cell(height, basis, near, points, stencil_points * e, stencil_points)) {
        ++skipped_;
        continue;
      }
      ++checked_;
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        double error = error_of(pairs[k], centre, e, points, &v[e * dofs], dofs, step);
        if (!(error <= tolerance)) {
          ++repeated_;
          error = error_of(pairs[k], centre, e, nearer, &v[e * dofs], dofs, step / 8.0);
        }
        worst_[k].see(error, [&] {
          return std::string(pairs[k].name) + " " + basis.name + " " + scene.projection + " " +
                 scene.height.dump() + " element " + std::to_string(e);
        });
      }
    }
  }

  Worst worst_[4];
  std::int64_t checked_ = 0, skipped_ = 0, repeated_ = 0;
};

// Gaps of both signs: the kinematics know nothing of contact.
TEST_P(Variations, AreTheDerivativesOfGapAndProjectionPoint) {
  const Basis& basis = basis_named(GetParam());
  Random random(1993);
  for (const std::string& kind : height_kinds()) {
    const std::int64_t goal = checked_ + samples(1000);
    while (checked_ < goal && skipped_ < goal)
      for (const char* projection : projections) {
        const Scene scene = draw_scene(random, basis, kind, projection);
        const Model model(scene.model().dump());
        check(scene, model, draw_elements(random, scene, model, samples(60), -0.15, 0.15), random);
      }
    EXPECT_GE(checked_, goal) << kind;
  }
  EXPECT_LE(repeated_, checked_ / 100);
  std::cout << basis.name << ": " << checked_ << " checked, " << skipped_ << " skipped, " << repeated_
            << " repeated";
  const std::vector<Pair> pairs = pairs_of(basis);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    EXPECT_LE(worst_[k].error, tolerance) << worst_[k].where;
    std::cout << ", " << pairs[k].name << " " << worst_[k].error;
  }
  std::cout << "\n";
}

INSTANTIATE_TEST_SUITE_P(Basis, Variations, testing::ValuesIn(all_basis_names()),
                         [](const auto& parameter) { return parameter.param; });

} // namespace
} // namespace mechanics::variations_test
