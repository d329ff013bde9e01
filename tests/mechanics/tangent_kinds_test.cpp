// "tangent": consistent, small_gap, first_variation; and "master": rigid, a part of the deformable element.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "differences.hpp"
#include "samples.hpp"
#include "worst.hpp"

namespace mechanics::tangent_kinds_test {
namespace {

class TangentKinds : public testing::TestWithParam<std::string> {
protected:
  // Calls f(scene, elements) for scenes of every height and projection.
  template <class F> void for_every_scene(std::uint64_t seed, std::int64_t count, F&& f) {
    Random random(seed);
    for (const std::string& kind : height_kinds())
      for (const char* projection : projections) {
        const Scene scene = draw_scene(random, basis(), kind, projection);
        const Model model(scene.model().dump());
        f(scene, draw_elements(random, scene, model, count, -0.15, -0.02));
      }
  }

  const Basis& basis() const { return basis_named(GetParam()); }
  std::size_t dofs() const { return static_cast<std::size_t>(basis().dofs()); }

  static Model model_with(Scene scene, const char* tangent) {
    scene.tangent = tangent;
    return Model(scene.model().dump());
  }
};

constexpr std::int32_t everything = ENTS_XI | ENTS_GAP | ENTS_NORMAL | ENTS_POINT | ENTS_GAP_GRADIENT |
                                    ENTS_GAP_HESSIAN | ENTS_XI_GRADIENT | ENTS_XI_HESSIAN | ENTS_ENERGY |
                                    ENTS_PRESSURE | ENTS_RESIDUAL | ENTS_TANGENT | ENTS_FLAGS;

TEST_P(TangentKinds, ShareEveryBitOfAllButTheSecondVariationOfTheGap) {
  for_every_scene(1, samples(50), [&](const Scene& scene, const Elements& elements) {
    const Results reference = model_with(scene, "consistent").evaluate(elements, everything);
    for (const char* kind : {"small_gap", "first_variation"}) {
      const Results r = model_with(scene, kind).evaluate(elements, everything);
      EXPECT_EQ(r.statuses, reference.statuses);
      EXPECT_EQ(r.flags, reference.flags);
      EXPECT_EQ(r.energy, reference.energy);
      EXPECT_EQ(r.pressure, reference.pressure);
      EXPECT_EQ(r.residual, reference.residual);
      EXPECT_EQ(r.gap_gradient, reference.gap_gradient);
      EXPECT_EQ(r.xi_gradient, reference.xi_gradient) << "kinematic variations of xi stay exact";
      EXPECT_EQ(r.xi_hessian, reference.xi_hessian);
      // along a ray no term of the second variation depends on the size of the gap
      if (scene.projection != "normal" && std::string(kind) == "small_gap") {
        EXPECT_EQ(r.gap_hessian, reference.gap_hessian);
        EXPECT_EQ(r.tangent, reference.tangent);
      }
    }
  });
}

TEST_P(TangentKinds, FirstVariationIsTheStiffnessAlongTheGap) {
  // three products per entry, each rounded once on both sides
  constexpr double tolerance = 6 * 1.2e-16;
  for_every_scene(2, samples(50), [&](const Scene& scene, const Elements& elements) {
    const Results r = model_with(scene, "first_variation").evaluate(elements, everything);
    const std::size_t n = dofs();
    for (std::size_t e = 0; e < elements.area.size(); ++e) {
      ASSERT_TRUE(r.has_flag(static_cast<std::int64_t>(e), ENTS_FLAG_CONTACT));
      const double* dg = &r.gap_gradient[e * n];
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < n; ++i) {
          const double expected = scene.stiffness * elements.area[e] * dg[i] * dg[j];
          ASSERT_NEAR(r.tangent[(e * n + j) * n + i], expected, tolerance * std::fabs(expected));
          ASSERT_EQ(r.gap_hessian[(e * n + j) * n + i], 0.0);
        }
    }
  });
}

// K = eps A (dg dg^T + g d2g) with the gap_hessian that the same model reports
TEST_P(TangentKinds, TangentIsBuiltFromTheReportedVariations) {
  constexpr double tolerance = 1e-13; // sums of up to 9 products, in another order
  for (const char* kind : {"consistent", "small_gap", "first_variation"})
    for_every_scene(3, samples(20), [&](const Scene& scene, const Elements& elements) {
      const Results r = model_with(scene, kind).evaluate(elements, everything);
      const std::size_t n = dofs();
      for (std::size_t e = 0; e < elements.area.size(); ++e) {
        const double eps = scene.stiffness * elements.area[e], *dg = &r.gap_gradient[e * n];
        for (std::size_t j = 0; j < n; ++j) {
          ASSERT_NEAR(r.residual[e * n + j], eps * r.gap[e] * dg[j], tolerance * eps);
          for (std::size_t i = 0; i < n; ++i) {
            const std::size_t k = (e * n + j) * n + i;
            ASSERT_NEAR(r.tangent[k], eps * (dg[i] * dg[j] + r.gap[e] * r.gap_hessian[k]), tolerance * eps)
                << kind;
          }
        }
      }
    });
}

// The small-gap tangent is the limit g -> 0 of the consistent one: what it drops falls like g.
TEST_P(TangentKinds, SmallGapDropsTermsOfFirstOrderInTheGap) {
  const std::vector<double> gaps = {-1e-2, -1e-3, -1e-4, -1e-5};
  double smallest = 9.0, largest = -9.0;
  for_every_scene(4, samples(50), [&](const Scene& scene, Elements elements) {
    if (scene.projection != "normal") return;
    const Model consistent = model_with(scene, "consistent"), small_gap = model_with(scene, "small_gap");
    const Results at = consistent.evaluate(elements, ENTS_POINT | ENTS_NORMAL | ENTS_XI);
    elements.start = at.xi;
    const std::size_t count = static_cast<std::size_t>(elements.count), n2 = dofs() * dofs();
    std::vector<std::vector<double>> dropped;
    for (const double gap : gaps) {
      for (std::size_t i = 0; i < elements.slave.size(); ++i)
        elements.slave[i] = at.point[i] + gap * at.normal[i];
      const Results a = consistent.evaluate(elements, everything),
                    b = small_gap.evaluate(elements, everything);
      dropped.emplace_back();
      for (std::size_t e = 0; e < count; ++e) {
        double difference = 0.0;
        for (std::size_t k = e * n2; k < (e + 1) * n2; ++k)
          test::raise(difference, std::fabs(a.gap_hessian[k] - b.gap_hessian[k]));
        dropped.back().push_back(difference);
      }
    }
    for (std::size_t e = 0; e < count; ++e) {
      // over three decades; at g = 0.01 terms of second order may still show (0.01 / 0.1 radius of curvature:
      // 4 %)
      const double slope = std::log10(dropped.front()[e] / dropped.back()[e]) / 3.0;
      test::lower(smallest, slope);
      test::raise(largest, slope);
    }
  });
  EXPECT_GE(smallest, 0.95);
  EXPECT_LE(largest, 1.05);
  std::cout << GetParam() << ": slopes " << smallest << " to " << largest << "\n";
}

// At zero gap, d2g of the two agree to rounding.
TEST_P(TangentKinds, SmallGapIsExactAtZeroGap) {
  Worst worst;
  for_every_scene(5, samples(50), [&](const Scene& scene, Elements elements) {
    const Model consistent = model_with(scene, "consistent"), small_gap = model_with(scene, "small_gap");
    const Results at = consistent.evaluate(elements, ENTS_POINT | ENTS_XI);
    elements.start = at.xi;
    elements.slave = at.point;
    const Results a = consistent.evaluate(elements, everything), b = small_gap.evaluate(elements, everything);
    const std::size_t n2 = dofs() * dofs();
    for (std::size_t e = 0; e < static_cast<std::size_t>(elements.count); ++e) {
      double difference = 0.0;
      for (std::size_t k = e * n2; k < (e + 1) * n2; ++k)
        test::raise(difference, std::fabs(a.gap_hessian[k] - b.gap_hessian[k]));
      worst.see(difference / largest_entry(&a.gap_hessian[e * n2], n2), [&] { return scene.model().dump(); });
    }
  });
  // the gap is 1e-15 here; what is dropped is that times at most 1e3
  EXPECT_LE(worst.error, 1e-12) << worst.where;
}

// A rigid master leaves the slave's own rows and columns.
TEST_P(TangentKinds, RigidMasterIsTheSlavesPartOfTheElement) {
  constexpr double tolerance = 1e-13;
  for (const char* kind : {"consistent", "small_gap", "first_variation"})
    for_every_scene(6, samples(20), [&](const Scene& scene, const Elements& elements) {
      Scene with_kind = scene;
      with_kind.tangent = kind;
      nlohmann::json text = with_kind.model();
      const Results whole = Model(text.dump()).evaluate(elements, everything);
      text["master"] = "rigid";
      const Model rigid_model(text.dump());
      const Results rigid = rigid_model.evaluate(elements, everything);
      const std::size_t d = static_cast<std::size_t>(basis().dimension), n = dofs(), t = d - 1;
      ASSERT_EQ(rigid_model.dofs(), basis().dimension);
      EXPECT_EQ(rigid.statuses, whole.statuses);
      EXPECT_EQ(rigid.flags, whole.flags);
      // both projections are converged to rounding
      for (std::size_t e = 0; e < rigid.gap.size(); ++e) {
        ASSERT_NEAR(rigid.gap[e], whole.gap[e], 1e-15);
        ASSERT_NEAR(rigid.energy[e], whole.energy[e], tolerance * scene.stiffness);
        for (std::size_t a = e * t; a < (e + 1) * t; ++a) ASSERT_NEAR(rigid.xi[a], whole.xi[a], 1e-14);
      }
      // `parts` vectors (rank 1) or matrices (rank 2) of the dofs per element
      const auto compare = [&](const std::vector<double>& small, const std::vector<double>& large,
                               std::size_t parts, int rank, const char* name) {
        const std::size_t rows = rank == 2 ? d : 1, all_rows = rank == 2 ? n : 1;
        for (std::size_t p = 0; p < parts * static_cast<std::size_t>(elements.count); ++p) {
          const double* from = &large[p * all_rows * n];
          const double scale = largest_entry(from, all_rows * n);
          for (std::size_t j = 0; j < rows; ++j)
            for (std::size_t i = 0; i < d; ++i)
              ASSERT_NEAR(small[(p * rows + j) * d + i], from[j * n + i], tolerance * scale)
                  << name << " " << kind;
        }
      };
      compare(rigid.gap_gradient, whole.gap_gradient, 1, 1, "gap_gradient");
      compare(rigid.residual, whole.residual, 1, 1, "residual");
      compare(rigid.xi_gradient, whole.xi_gradient, t, 1, "xi_gradient");
      compare(rigid.gap_hessian, whole.gap_hessian, 1, 2, "gap_hessian");
      compare(rigid.tangent, whole.tangent, 1, 2, "tangent");
      compare(rigid.xi_hessian, whole.xi_hessian, t, 2, "xi_hessian");
    });
}

INSTANTIATE_TEST_SUITE_P(Basis, TangentKinds, testing::ValuesIn(all_basis_names()),
                         [](const auto& parameter) { return parameter.param; });

} // namespace
} // namespace mechanics::tangent_kinds_test
