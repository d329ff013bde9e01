// Energy -> residual -> tangent: R is the derivative of W and K that of R, along a random direction of all
// dofs, for 1e5 random elements in contact per basis and height.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "differences.hpp"
#include "samples.hpp"
#include "worst.hpp"

namespace mechanics::element_derivatives_test {
namespace {

struct Count {
  std::int64_t drawn = 0, checked = 0, flagged = 0, open = 0, on_knot = 0, repeated = 0;
};

struct Errors {
  double residual, tangent;
};

class ElementDerivatives : public testing::TestWithParam<std::string> {
protected:
  // Rounding: a gap is the difference of positions up to 4, so that W and R carry errors of about 1e-15 times
  // the force or the stiffness; the formula multiplies them by 1.5 / step: 4e-12. Truncation: step^4 / 30
  // over the fourth power of the length in which the element's response changes; 1e-15 for length 1 and 1e-8
  // for 0.02 (sharply bent segments, slave nodes near a centre of curvature). Where that length is smaller
  // still the error must fall with the step: those elements, a few in a million, are repeated with an eighth
  // of it and have to pass then.
  static constexpr double step = 4e-4, tolerance = 1e-7;

  enum class Outcome { checked, flagged, open, on_knot };

  // Relative to the largest entry of R and K.
  static Errors errors_of(const Results& centre, std::size_t e, const Results& points, std::size_t point,
                          const double* direction, std::size_t dofs, double t) {
    const double* residual = &centre.residual[e * dofs];
    const double* tangent = &centre.tangent[e * dofs * dofs];
    double work = 0.0, worst = 0.0;
    for (std::size_t i = 0; i < dofs; ++i) {
      work += residual[i] * direction[i];
      test::raise(worst, std::fabs(difference(&points.residual[point * dofs + i], dofs, t) -
                                   times_direction(tangent, direction, dofs, i)));
    }
    return {std::fabs(difference(&points.energy[point], 1, t) - work) / largest_entry(residual, dofs),
            worst / largest_entry(tangent, dofs * dofs)};
  }

  // Contact in the middle and all over the stencil, within one cell of a map?
  static Outcome usable(const Scene& scene, const Height& height, const Results& centre, std::int64_t e,
                        const Elements& points, const Results& at_points) {
    bool ok = centre.ok(e), contact = ok && centre.has_flag(e, ENTS_FLAG_CONTACT);
    for (std::int64_t k = stencil_points * e; k < stencil_points * (e + 1); ++k) {
      ok = ok && at_points.ok(k);
      contact = contact && at_points.has_flag(k, ENTS_FLAG_CONTACT);
    }
    if (!ok) return Outcome::flagged;
    if (!contact) return Outcome::open;
    const std::size_t first = static_cast<std::size_t>(stencil_points * e);
    return in_one_cell(height, *scene.basis, points, at_points, first, stencil_points) ? Outcome::checked
                                                                                       : Outcome::on_knot;
  }

  void check(const Scene& scene, const Model& model, const Elements& centres, Random& random) {
    const Basis& basis = *scene.basis;
    const std::size_t dofs = static_cast<std::size_t>(basis.dofs());
    const Height height(scene.height, basis.parameters());
    const std::vector<double> v = draw_directions(random, centres.count, basis.dofs());
    constexpr std::int32_t wanted = ENTS_XI | ENTS_FLAGS | ENTS_ENERGY | ENTS_RESIDUAL;
    model.evaluate(centres, wanted | ENTS_TANGENT, centre_);
    const Elements points = stencil(centres, basis, v, step, centre_.xi);
    model.evaluate(points, wanted, points_);
    for (std::int64_t e = 0; e < centres.count; ++e) {
      ++count_.drawn;
      const Outcome outcome = usable(scene, height, centre_, e, points, points_);
      count_.flagged += outcome == Outcome::flagged;
      count_.open += outcome == Outcome::open;
      count_.on_knot += outcome == Outcome::on_knot;
      if (outcome != Outcome::checked) continue;
      ++count_.checked;
      const std::size_t i = static_cast<std::size_t>(e);
      Errors errors = errors_of(centre_, i, points_, stencil_points * i, &v[i * dofs], dofs, step);
      if (!(errors.residual <= tolerance && errors.tangent <= tolerance)) {
        ++count_.repeated;
        const Results again = model.evaluate(stencil(centres, basis, v, step / 8.0, centre_.xi), wanted);
        errors = errors_of(centre_, i, again, stencil_points * i, &v[i * dofs], dofs, step / 8.0);
      }
      const auto where = [&] {
        return basis.name + " " + scene.projection + " " + scene.height.dump() + " element " +
               std::to_string(e);
      };
      residual_.see(errors.residual, where);
      tangent_.see(errors.tangent, where);
    }
  }

  Results centre_, points_;
  Count count_;
  Worst residual_, tangent_;
};

TEST_P(ElementDerivatives, OfEnergyAndResidual) {
  const Basis& basis = basis_named(GetParam());
  const std::int64_t goal = long_samples(100000);
  Random random(2011);
  for (const std::string& kind : height_kinds()) {
    count_ = {};
    residual_ = {};
    tangent_ = {};
    while (count_.checked < goal && count_.drawn < 2 * goal)
      for (const char* projection : projections) {
        const Scene scene = draw_scene(random, basis, kind, projection);
        const Model model(scene.model().dump());
        for (std::int64_t chunk = 0; chunk < samples(8); ++chunk)
          check(scene, model, draw_elements(random, scene, model, samples(256), -0.15, -0.005), random);
      }
    EXPECT_GE(count_.checked, goal) << basis.name << " " << kind;
    EXPECT_LE(count_.repeated, count_.checked / 1000) << basis.name << " " << kind;
    EXPECT_LE(residual_.error, tolerance) << residual_.where;
    EXPECT_LE(tangent_.error, tolerance) << tangent_.where;
    std::cout << basis.name << " " << kind << ": " << count_.checked
              << " checked (skipped: " << count_.flagged << " flagged, " << count_.open << " open, "
              << count_.on_knot << " on a knot), worst error of R " << residual_.error << ", of K "
              << tangent_.error << ", " << count_.repeated << " repeated\n";
  }
}

// Without bezier15, which random control points bend too sharply for these steps: taylor_test.cpp,
// tests/laws/tangent_test.cpp.
INSTANTIATE_TEST_SUITE_P(Basis, ElementDerivatives, testing::ValuesIn(basis_names()),
                         [](const auto& parameter) { return parameter.param; });

} // namespace
} // namespace mechanics::element_derivatives_test
