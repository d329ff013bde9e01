// SPDX-License-Identifier: BSD-3-Clause
// Coulomb's law with a coefficient of 0, in the text or bound to a parameter: forces and tangents have the
// bits of the same model without friction, and elements that were in contact slip.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <iostream>

#include "model_handle.hpp"
#include "parts_of_calls.hpp"
#include "samples.hpp"

namespace laws::no_friction_test {
namespace {

struct Case {
  std::string basis, height;
  Method method;
  const char* projection = "normal";
  const char* tangent = "consistent";
  const char* master = "deformable";
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.basis << " " << c.height << " " << c.method.name << " " << c.projection << " " << c.tangent << " "
       << c.master;
}

std::vector<Case> cases() {
  std::vector<Case> all;
  std::vector<Method> with_coulomb;
  for (const Method& method : all_methods())
    if (!method.friction.is_null() && method.friction["type"] == "coulomb" &&
        method.friction["coefficient"].is_number() &&
        !method.friction.contains("kinetic")) // one number is all
      with_coulomb.push_back(method);
  std::size_t turn = 0, first = 0; // each basis begins at another height
  const auto add = [&](Case c) {
    for (const std::string& height : heights_in_turn(turn++)) all.push_back(c), all.back().height = height;
  };
  for (const std::string& basis : mechanics::all_basis_names()) {
    turn = first, first += 3;
    for (const Method& method : with_coulomb) add({basis, "", method});
    for (const char* projection : {"shadow_point", "shadow_direction"}) add({basis, "", coulomb, projection});
    for (const char* tangent : {"small_gap", "first_variation"}) add({basis, "", coulomb, "normal", tangent});
    add({basis, "", coulomb, "normal", "consistent", "rigid"});
  }
  return all;
}

json text_of(const mechanics::Scene& scene, const Case& c) {
  json text = scene.model();
  text["master"] = c.master;
  text["tangent"] = c.tangent;
  text["contact"] = {{"normal", c.method.normal},
                     {"friction", c.method.friction},
                     {"wear", c.method.wear},
                     {"offset", c.method.offset},
                     {"flattening", c.method.flattening}};
  if (!c.method.flattening.is_null()) {
    const json none = {{"type", "constant"}, {"value", 0.01}};
    text["height"] = {
        {"type", "scale"}, {"by", "flat"}, {"of", scene.height.is_null() ? none : scene.height}};
    text["parameters"] = {{"flat", 1.0}};
  }
  return text;
}

// The state and the multipliers without what friction has of them
LawElements without_friction(const LawElements& with, const ents_model* model, bool bonds) {
  LawElements e = with;
  e.layout = layout_of(model);
  const auto t = static_cast<std::size_t>(e.layout.parameters), n = static_cast<std::size_t>(e.at.count),
             from = static_cast<std::size_t>(with.layout.state_size);
  e.state.assign(n * static_cast<std::size_t>(e.layout.state_size), 0.0);
  ents_state_init(model, e.at.count, e.state.data(), e.layout.state_size, nullptr);
  e.multiplier.clear();
  for (std::size_t i = 0; i < n; ++i) {
    const double* before = &with.state[i * from];
    double* after = &e.state[i * static_cast<std::size_t>(e.layout.state_size)];
    for (std::size_t k = 1; k < 3 + t; ++k) after[k] = before[k];
    if (bonds) after[e.layout.state_size - 2] = before[from - 2]; // before the number of the segment
    if (e.layout.augmentable) after[3 + t] = before[3 + t + t + 1];
    for (std::size_t k = 0; e.layout.worn >= 0 && k < 3 + t; ++k)
      after[static_cast<std::size_t>(e.layout.worn) + k] =
          before[static_cast<std::size_t>(with.layout.worn) + k];
    if (e.layout.worn >= 0 &&
        before[1] == 1.0) // the clearance of an open element stands in place of an anchor
      after[static_cast<std::size_t>(e.layout.worn) + 3] = before[3 + t];
    if (e.layout.multipliers > 0)
      e.multiplier.push_back(with.multiplier[i * static_cast<std::size_t>(with.layout.multipliers)]);
  }
  return e;
}

// Residual and tangent of the nodes and of the normal multiplier, the first `n` dofs
bool same_forces(const LawResults& a, std::size_t of_a, const LawResults& b, std::size_t of_b, std::size_t n,
                 std::size_t e) {
  if (std::memcmp(&a.residual[e * of_a], &b.residual[e * of_b], n * sizeof(double)) != 0) return false;
  for (std::size_t j = 0; j < n; ++j)
    if (std::memcmp(&a.tangent[(e * of_a + j) * of_a], &b.tangent[(e * of_b + j) * of_b],
                    n * sizeof(double)) != 0)
      return false;
  return true;
}

constexpr std::int32_t wanted = call_results | ENTS_TRACTION;

void compare(const Case& c, const LawResults& none, const ents_layout& plain, const LawResults& zero,
             const LawElements& e, std::int64_t& slipping) {
  const ents_layout& l = e.layout;
  const auto n = static_cast<std::size_t>(l.dofs), m = static_cast<std::size_t>(plain.dofs),
             size = static_cast<std::size_t>(l.state_size), t = static_cast<std::size_t>(l.parameters);
  ASSERT_EQ(none.status, zero.status) << testing::PrintToString(c);
  for (std::size_t i = 0; i < none.status.size(); ++i) {
    if (none.status[i] != ENTS_OK) continue;
    const bool contact = none.flags[i] & ENTS_FLAG_CONTACT;
    // Unknown multipliers leave no depth that says when the touch was.
    const bool rubs = contact && (e.multiplier.empty() || e.state[i * size + 1] > 1.0);
    ASSERT_EQ(zero.flags[i],
              none.flags[i] |
                  (contact ? ENTS_FLAG_CHANGED | (rubs ? ENTS_FLAG_SLIP : ENTS_FLAG_NO_BEGIN) : 0))
        << testing::PrintToString(c) << " element " << i;
    ASSERT_EQ(none.gap[i], zero.gap[i]) << testing::PrintToString(c) << " element " << i;
    ASSERT_EQ(none.pressure[i], zero.pressure[i]) << testing::PrintToString(c) << " element " << i;
    ASSERT_TRUE(same_forces(none, m, zero, n, m, i)) << testing::PrintToString(c) << " element " << i;
    for (std::size_t a = m; a < n; ++a) { // multipliers of friction: lambda = 0, as where there is no contact
      ASSERT_EQ(zero.residual[i * n + a],
                (0.0 - e.at.area[i] * e.multiplier[i * (1 + t) + 1 + a - m]) / 80.0);
      for (std::size_t b = 0; b < n; ++b)
        if (a != b) {
          ASSERT_EQ(zero.tangent[(i * n + a) * n + b], 0.0) << testing::PrintToString(c);
          ASSERT_EQ(zero.tangent[(i * n + b) * n + a], 0.0) << testing::PrintToString(c);
        }
      ASSERT_LT(zero.tangent[(i * n + a) * n + a], 0.0) << testing::PrintToString(c);
    }
    for (std::size_t d = 0; d < static_cast<std::size_t>(l.dimension); ++d)
      ASSERT_EQ(zero.traction[i * static_cast<std::size_t>(l.dimension) + d], 0.0);
    const double *begin = &e.state[i * size], *end = &zero.state[i * size];
    ASSERT_TRUE(contact ? end[1] == (rubs ? 3.0 : 2.0) : end[1] <= 1.0)
        << testing::PrintToString(c) << " element " << i;
    for (std::size_t a = 0; contact && a < t; ++a) // an open element has no anchor
      ASSERT_EQ(end[3 + t + a], end[3 + a]) << testing::PrintToString(c);
    if (rubs) {
      ++slipping;
      // what touches within the increment has slipped only where it penetrates: augmented laws hold it above, too
      ASSERT_TRUE(end[3 + 2 * t] > begin[3 + 2 * t] || begin[1] == 1.0) << testing::PrintToString(c);
    }
    for (std::size_t a = 0; l.augmentable && a < t; ++a)
      ASSERT_EQ(end[3 + 2 * t + 2 + a], 0.0) << testing::PrintToString(c);
  }
}

TEST(NoFriction, HasTheBitsOfAModelWithoutFriction) {
  std::int64_t slipping = 0, elements = 0;
  Random half(7); // of the cases, all of them with ENTS_TEST_SAMPLES=all
  for (const Case& c : cases()) {
    if (half.coin() && mechanics::long_divisor() > 1) continue;
    Random random(std::hash<std::string>{}(c.basis + c.height + c.method.name));
    const mechanics::Scene scene =
        mechanics::draw_scene(random, mechanics::basis_named(c.basis), c.height, c.projection);
    Case without = c;
    without.method.friction = nullptr;
    json text = text_of(scene, c);
    const Handle none = make(text_of(scene, without));
    text["contact"]["friction"]["coefficient"] = 0;
    const Handle zero = make(text);
    text["contact"]["friction"]["coefficient"] = "mu";
    text["parameters"]["mu"] = 0.3;
    const Handle named = make(text);

    LawElements e = draw(random, scene, mechanics::Model(text.dump()), call_size, 0.05);
    for (std::size_t i = 0; i < static_cast<std::size_t>(call_size); i += 7) // some have to be searched for
      e.state[i * static_cast<std::size_t>(e.layout.state_size) + 3] += 0.7;
    const std::string type = c.method.normal["type"];
    const bool bonds = type == "tied" || type == "cohesive";
    const LawElements plain = without_friction(e, none.get(), bonds);
    LawResults of_none, of_zero, of_bound, of_positive;
    evaluate(none.get(), plain, wanted, of_none);
    evaluate(zero.get(), e, wanted, of_zero);
    compare(c, of_none, plain.layout, of_zero, e, slipping);
    if (testing::Test::HasFatalFailure()) return;
    elements += call_size;

    std::vector<double> values = {0.0};
    if (!c.method.flattening.is_null()) values.insert(values.begin(), 1.0); // "flat" before "mu"
    ents_model* to = nullptr;
    ASSERT_EQ(ents_model_bind(named.get(), values.data(), nullptr, 0, &to, nullptr), ENTS_OK);
    const Handle bound(to);
    evaluate(bound.get(), e, wanted, of_bound);
    ASSERT_TRUE(same(of_zero, of_bound, 0, e.layout)) << testing::PrintToString(c);
    for (const std::int64_t size : {1, 13})
      for (std::int64_t first = 0; first + size <= call_size; first += size) {
        LawResults some;
        evaluate(bound.get(), part(e, first, size), wanted, some);
        ASSERT_TRUE(same(of_zero, some, first, e.layout)) << testing::PrintToString(c) << " " << first;
      }
    values.back() = 0.3; // and up the ramp: the state goes on
    ASSERT_EQ(ents_model_bind(named.get(), values.data(), nullptr, 0, &to, nullptr), ENTS_OK);
    LawElements next = e;
    for (std::size_t i = 0; i < of_zero.status.size(); ++i)
      if (of_zero.status[i] == ENTS_OK)
        std::memcpy(&next.state[i * static_cast<std::size_t>(e.layout.state_size)],
                    &of_zero.state[i * static_cast<std::size_t>(e.layout.state_size)],
                    sizeof(double) * static_cast<std::size_t>(e.layout.state_size));
    evaluate(bound.get(), next, wanted, of_positive);
    // those that were in contact and penetrate: what closes now slides without friction, whose multipliers are
    // given is held by them, and what pulls may penetrate with hardly a pressure
    const bool pulls = bonds || type == "dugdale" || type == "separation" || type == "lennard_jones";
    for (std::size_t i = 0; i < of_positive.status.size(); ++i)
      if (of_zero.status[i] == ENTS_OK && e.layout.multipliers == 0 && of_positive.gap[i] < 0 && !pulls &&
          (of_zero.flags[i] & of_positive.flags[i] & ENTS_FLAG_CONTACT)) {
        ASSERT_TRUE(of_positive.flags[i] & ENTS_FLAG_STICK)
            << testing::PrintToString(c) << " " << i << ", flags " << of_positive.flags[i];
      }
  }
  EXPECT_GT(slipping, elements / 2);
  std::cout << elements << " elements, " << slipping << " of them in contact\n";
}

TEST(NoFriction, IsRefusedWhereTheCoefficientIsNegative) {
  json text = {{"segment", "line2"},
               {"contact", {{"normal", coulomb.normal}, {"friction", coulomb.friction}}},
               {"parameters", {{"mu", 0.0}}}};
  text["contact"]["friction"]["coefficient"] = "mu";
  const Handle model = make(text);
  ents_model* bound = nullptr;
  ents_report report = mechanics::new_report();
  for (const double mu : {-1e-300, -0.1}) {
    EXPECT_EQ(ents_model_bind(model.get(), &mu, nullptr, 0, &bound, &report), ENTS_BAD_VALUE);
    EXPECT_NE(std::strstr(report.message, "coefficient of friction and a number of wear are not negative"),
              nullptr)
        << report.message;
  }
  text["parameters"]["mu"] = -0.1;
  EXPECT_THROW(make(text), std::runtime_error);
}

} // namespace
} // namespace laws::no_friction_test
