// SPDX-License-Identifier: BSD-3-Clause
// What ents_layout says that a model needs: model by model, and against what its elements do.
#include <gtest/gtest.h>

#include "support/element.hpp"

namespace needs_test {
namespace {

using namespace test;

constexpr int32_t all_bits = (1 << 11) - 1;

bool needs(const Model& model, int32_t bit) { return (model.layout.needs & bit) != 0; }

struct Case {
  const char* what;
  std::string text;
  int32_t needs;
};

const std::string sine = R"("height": {"type": "sine", "amplitude": 0.1, "wave_vector": [1]})";
const std::string unit_penalty = R"("normal": {"type": "penalty", "stiffness": 1})";
const std::string unit_coulomb = R"("friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 1})";

std::string line(const std::string& more) { return R"({"segment": "line2", )" + more + "}"; }
std::string law(const std::string& keys) { return R"("contact": {)" + keys + "}"; }

TEST(Needs, AreThoseOfTheModel) {
  constexpr int32_t plain = ENTS_NEEDS_MASTER;
  constexpr int32_t flat_enriched = plain | ENTS_NEEDS_HEIGHT | ENTS_NEEDS_SLOPE | ENTS_NEEDS_ITERATION;
  const auto height = [](const std::string& keys) {
    return line(R"("height": )" + keys + ", " + law(unit_penalty));
  };
  const auto normal = [](const std::string& keys) { return line(law(R"("normal": )" + keys)); };
  const Case cases[] = {
      {"plain", line(law(unit_penalty)), plain},
      {"power", normal(R"({"type": "power", "coefficient": 2, "exponent": 1.5})"), plain},
      {"sine", line(sine + ", " + law(unit_penalty)), flat_enriched},
      {"constant", height(R"({"type": "constant", "value": 0.1})"), flat_enriched & ~ENTS_NEEDS_SLOPE},
      {"constant zero", height(R"({"type": "constant", "value": 0})"), plain},
      {"sine without amplitude", height(R"({"type": "sine", "amplitude": 0, "wave_vector": [1]})"), plain},
      {"product with zero",
       height(
           R"({"type": "product", "of": [{"type": "polynomial", "coefficients": [1, 2]}, {"type": "constant", "value": 0}]})"),
       plain},
      {"friction", line(law(unit_penalty + ", " + unit_coulomb)),
       plain | ENTS_NEEDS_FRICTION | ENTS_NEEDS_HISTORY},
      {"symmetrised", line(law(unit_penalty + ", " + unit_coulomb + R"(, "symmetrised": true)")),
       plain | ENTS_NEEDS_FRICTION | ENTS_NEEDS_HISTORY},
      {"augmented", normal(R"({"type": "augmented", "stiffness": 1})"), plain | ENTS_NEEDS_HISTORY},
      {"multiplier", normal(R"({"type": "multiplier", "stiffness": 1})"), plain | ENTS_NEEDS_MULTIPLIERS},
      {"tied", normal(R"({"type": "tied", "stiffness": 1, "range": 0.01})"),
       plain | ENTS_NEEDS_HISTORY | ENTS_NEEDS_FIRST_STATE},
      {"exponential", normal(R"({"type": "exponential", "pressure": 1, "clearance": 0.01})"), plain},
      {"shadow",
       line(R"("projection": {"type": "shadow_direction", "direction": [0, 1]}, )" + law(unit_penalty)),
       plain},
      {"small gap", line(R"("tangent": "small_gap", )" + law(unit_penalty)), plain},
      {"first variation", line(R"("tangent": "first_variation", )" + law(unit_penalty)), plain},
      {"patch", line(R"("patch": [[0, 1], [1, 2]], )" + law(unit_penalty)), plain | ENTS_NEEDS_ONE_BY_ONE},
      {"kinematics", line(sine), flat_enriched},
  };
  for (const Case& c : cases) EXPECT_EQ(Model(c.text).layout.needs, c.needs) << c.what;
  // whether it goes one by one is not a matter of dofs
  const Model rigid(line(R"("master": "rigid", )" + law(unit_penalty)));
  EXPECT_EQ(rigid.layout.needs & ~ENTS_NEEDS_ONE_BY_ONE, 0);
}

TEST(Needs, TheInstructionSetIsThatOfTheProcessor) {
  const std::string ordinary = Model(line(law(unit_penalty))).layout.instruction_set;
  EXPECT_TRUE(ordinary == "avx512" || ordinary == "avx2" || ordinary == "portable" || ordinary == "none")
      << ordinary;
  for (const Model& model : make(all_kinds())) {
    EXPECT_EQ(model.layout.instruction_set, ordinary) << model.text();
    EXPECT_EQ(model.layout.needs & ~all_bits, 0) << model.text();
  }
}

// A caller who was built before there were needs has a shorter struct.
TEST(Needs, OlderCallersAreServed) {
  const Model model(line(law(unit_penalty)));
  ents_layout layout{};
  layout.struct_size = offsetof(ents_layout, instruction_set);
  ASSERT_EQ(call::model_layout(model.get(), &layout, nullptr), ENTS_OK);
  EXPECT_EQ(layout.needs, model.layout.needs);
  EXPECT_EQ(layout.instruction_set, nullptr);
}

TEST(Needs, AgreeWithTheRestOfTheLayout) {
  for (const Model& model : make(all_kinds())) {
    const ents_layout& l = model.layout;
    EXPECT_EQ(needs(model, ENTS_NEEDS_MASTER), l.dofs - l.multipliers == l.dimension * (l.nodes + 1))
        << model.text();
    EXPECT_EQ(needs(model, ENTS_NEEDS_FRICTION), l.friction == 1) << model.text();
    EXPECT_EQ(needs(model, ENTS_NEEDS_MULTIPLIERS), l.multipliers > 0) << model.text();
  }
}

class NeedsOfElements : public ::testing::Test {
protected:
  // Elements in contact.
  Element touching(const Model& model, const Basis& b) {
    Results results(model.layout);
    for (int attempt = 0; attempt < 100; ++attempt) {
      Element e = with_new_state(model, draw(model, b, random, -0.03, -0.02));
      if (test::evaluate(model, e, want_element | ENTS_FLAGS, results) == ENTS_OK &&
          (results.flags & ENTS_FLAG_CONTACT) != 0)
        return e;
    }
    throw std::runtime_error("no element in contact: " + model.text());
  }
  std::vector<double> base_normal(const Model& model, const Element& e, const std::vector<double>& xi,
                                  double& height) {
    std::vector<double> normal(static_cast<std::size_t>(model.layout.dimension));
    ents_surface surface{};
    surface.struct_size = sizeof surface;
    surface.master = e[master].data();
    surface.xi = xi.data();
    surface.base_normal = normal.data();
    surface.height = &height;
    EXPECT_EQ(call::surface_evaluate(model.get(), int64_t{1}, &surface, nullptr), ENTS_OK);
    return normal;
  }
  Random random{117};
};

// Heights and normals at two points of a distorted segment: they vary where the bits say so.
TEST_F(NeedsOfElements, HeightSlopeAndCurvatureAreThoseOfTheSurface) {
  for (const ModelKind& kind : all_kinds()) {
    const Model model(text(kind));
    const Basis& b = basis(kind.basis);
    const Element e = draw(model, b, random);
    double h[2];
    std::vector<double> n[2];
    for (int i = 0; i < 2; ++i) n[i] = base_normal(model, e, random_xi(b, random), h[i]);
    EXPECT_EQ(needs(model, ENTS_NEEDS_HEIGHT), h[0] != 0.0) << model.text();
    EXPECT_EQ(needs(model, ENTS_NEEDS_SLOPE), h[0] != h[1]) << model.text();
    double turn = 0.0;
    for (std::size_t c = 0; c < n[0].size(); ++c) turn += std::fabs(n[0][c] - n[1][c]);
    EXPECT_EQ(needs(model, ENTS_NEEDS_CURVED), turn > 1e-12)
        << model.text(); // rounding of a unit vector: 1e-15
  }
}

// From a start far off, a closed form looks at the surface once (along a ray once more, to end there);
// Newton's method, where the equations are not linear, at least three times.
TEST_F(NeedsOfElements, IterationIsCounted) {
  for (const ModelKind& kind : all_kinds()) {
    const Model model(text(kind));
    Element e = touching(model, basis(kind.basis));
    e[state_begin].clear();
    for (double& x : e[start]) x += 0.1;
    Results results(model.layout);
    ASSERT_EQ(test::evaluate(model, e, ENTS_ITERATIONS | ENTS_RESIDUAL, results), ENTS_OK) << model.text();
    if (!needs(model, ENTS_NEEDS_ITERATION)) {
      // along a ray the equations are linear as well, and are solved once more to see it
      const bool shadow = model.text().find("shadow") != std::string::npos;
      EXPECT_EQ(results.iterations, shadow ? 2 : 1) << model.text();
    } else if (needs(model, ENTS_NEEDS_SLOPE)) {
      EXPECT_GE(results.iterations, 3) << model.text();
    } else {
      EXPECT_GE(results.iterations, 2)
          << model.text(); // a constant height on a flat segment: one step and its end
    }
  }
}

// Without history a state is a start and nothing else: the start alone gives the same bits. With it, what
// follows the start in the state moves the force.
TEST_F(NeedsOfElements, HistoryMovesTheForce) {
  for (const ModelKind& kind : all_kinds()) {
    const Model model(text(kind));
    Element e = touching(model, basis(kind.basis));
    Results first(model.layout), with(model.layout), without(model.layout);
    if (model.text().find("cohesive") !=
        std::string::npos) { // damage is in the tension alone: within its range
      ASSERT_EQ(test::evaluate(model, e, ENTS_NORMAL | ENTS_NORMAL_GAP, first), ENTS_OK);
      for (std::size_t c = 0; c < e[slave].size(); ++c)
        e[slave][c] += (0.005 - first.of(ENTS_NORMAL_GAP)[0]) * first.of(ENTS_NORMAL)[c];
    }
    ASSERT_EQ(test::evaluate(model, e, ENTS_STATE, first), ENTS_OK);
    const auto xi_at = static_cast<std::size_t>(3), t = static_cast<std::size_t>(model.layout.parameters);
    e[state_begin] = first.of(ENTS_STATE);
    e[start].assign(&e[state_begin][xi_at], &e[state_begin][xi_at] + t);
    for (std::size_t i = xi_at + t; i < e[state_begin].size(); ++i) e[state_begin][i] += 0.01;
    ASSERT_EQ(test::evaluate(model, e, ENTS_RESIDUAL | ENTS_TANGENT, with), ENTS_OK) << model.text();
    e[state_begin].clear();
    ASSERT_EQ(test::evaluate(model, e, ENTS_RESIDUAL | ENTS_TANGENT, without), ENTS_OK) << model.text();
    EXPECT_EQ(needs(model, ENTS_NEEDS_HISTORY), !same_bits(with.of(ENTS_RESIDUAL), without.of(ENTS_RESIDUAL)))
        << model.text();
  }
}

} // namespace
} // namespace needs_test
