// Taylor's theorem: R(u + t v) - R(u) - t K v falls like t^2. There is no tolerance in this: a wrong or
// missing term of K, how ever small, leaves a remainder that falls like t.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "differences.hpp"
#include "samples.hpp"
#include "worst.hpp"

namespace mechanics::taylor_test {
namespace {

constexpr double smallest_slope = 1.9;

// Three decades, equidistant in log t. Below, rounding comes into sight: R carries errors of 1e-15 max|K|
// from positions up to 4, the remainder is typically 0.1 t^2 max|K|.
std::vector<double> draw_steps() {
  std::vector<double> steps;
  for (int k = 0; k <= 6; ++k) steps.push_back(3e-3 * std::pow(10.0, -0.5 * k));
  return steps;
}
constexpr double rounding = 4e-15;

// Least squares
double slope_of(const std::vector<double>& steps, const std::vector<double>& remainders) {
  const double n = static_cast<double>(steps.size());
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const double a = std::log(steps[k]), b = std::log(remainders[k]);
    x += a;
    y += b;
    xx += a * a;
    xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

class Taylor : public testing::TestWithParam<std::string> {
protected:
  void check(const Scene& scene, const Model& model, const Elements& centres, Random& random) {
    const Basis& basis = *scene.basis;
    const std::size_t dofs = static_cast<std::size_t>(basis.dofs()), points = steps_.size();
    const Height height(scene.height, basis.parameters());
    const std::vector<double> v = draw_directions(random, centres.count, basis.dofs());
    constexpr std::int32_t wanted = ENTS_XI | ENTS_FLAGS | ENTS_RESIDUAL;
    const Results centre = model.evaluate(centres, wanted | ENTS_TANGENT);
    const Elements moved = displaced(centres, basis, v, steps_, centre.xi);
    const Results r = model.evaluate(moved, wanted);
    for (std::int64_t e = 0; e < centres.count; ++e) {
      const std::size_t i = static_cast<std::size_t>(e), first = i * points;
      bool usable = centre.ok(e) && centre.has_flag(e, ENTS_FLAG_CONTACT);
      for (std::size_t k = first; usable && k < first + points; ++k)
        usable =
            r.ok(static_cast<std::int64_t>(k)) && r.has_flag(static_cast<std::int64_t>(k), ENTS_FLAG_CONTACT);
      if (!usable || !in_one_cell(height, basis, moved, r, first, points)) {
        ++skipped_;
        continue;
      }
      const double* tangent = &centre.tangent[i * dofs * dofs];
      std::vector<double> remainders;
      for (std::size_t k = 0; k < points; ++k) {
        double largest = 0.0;
        for (std::size_t n = 0; n < dofs; ++n)
          test::raise(largest, std::fabs(r.residual[(first + k) * dofs + n] - centre.residual[i * dofs + n] -
                                         steps_[k] * times_direction(tangent, &v[i * dofs], dofs, n)));
        remainders.push_back(largest);
      }
      if (remainders.back() < 20.0 * rounding * largest_entry(tangent, dofs * dofs)) {
        ++straight_;
        continue;
      }
      ++checked_;
      const double slope = slope_of(steps_, remainders);
      if (slope >= smallest_ || std::isnan(smallest_)) continue;
      smallest_ = slope;
      where_ =
          basis.name + " " + scene.projection + " " + scene.height.dump() + " element " + std::to_string(e);
    }
  }

  const std::vector<double> steps_ = draw_steps();
  std::int64_t checked_ = 0, skipped_ = 0, straight_ = 0;
  double smallest_ = 9.0;
  std::string where_;
};

TEST_P(Taylor, RemainderOfTheResidualIsOfSecondOrder) {
  const Basis& basis = basis_named(GetParam());
  Random random(1715);
  for (const std::string& kind : height_kinds())
    for (int scene_number = 0; scene_number < 4; ++scene_number)
      for (const char* projection : projections) {
        const Scene scene = draw_scene(random, basis, kind, projection);
        const Model model(scene.model().dump());
        check(scene, model, draw_elements(random, scene, model, samples(100), -0.15, -0.02), random);
      }
  EXPECT_GE(checked_, samples(8 * 1000)) << "skipped " << skipped_ << ", nearly straight " << straight_;
  EXPECT_GE(smallest_, smallest_slope) << where_;
  std::cout << basis.name << ": " << checked_ << " checked, " << skipped_ << " skipped, " << straight_
            << " nearly straight, smallest slope " << smallest_ << "\n";
}

INSTANTIATE_TEST_SUITE_P(Basis, Taylor, testing::ValuesIn(all_basis_names()),
                         [](const auto& parameter) { return parameter.param; });

} // namespace
} // namespace mechanics::taylor_test
