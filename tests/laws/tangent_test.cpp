// K is the derivative of R along a random direction of all dofs, multipliers included: open, stick, slip, at
// the shear limit, for every method, basis and projection, with and without height.
#include <gtest/gtest.h>

#include <array>
#include <iostream>

#include "law_elements.hpp"
#include "samples.hpp"
#include "worst.hpp"

namespace laws::tangent_test {
namespace {

// As in tests/mechanics/element_derivatives_test.cpp: rounding 1e-15 / step; truncation step^4 over the
// fourth power of the length in which the response changes: the elastic slip, the distance of the gap from
// the end of the law (0.005 here, but any smaller value occurs). An element that misses the tolerance is
// repeated with an eighth of the step, alone and extrapolated with the step before (Richardson 1911), at most
// three times. Then rounding is 5e-9, which is what the few may have that need the smallest step.
constexpr double step = 1e-4;
constexpr double tolerance = 1e-9, of_the_smallest_step = 1e-8;
constexpr std::int32_t branch =
    ENTS_FLAG_CONTACT | ENTS_FLAG_STICK | ENTS_FLAG_SLIP | ENTS_FLAG_SHEAR_LIMIT | ENTS_FLAG_OUTSIDE;

struct Count {
  std::int64_t checked = 0, open = 0, touching = 0, stick = 0, slip = 0, limit = 0, crossing = 0, flagged = 0,
               repeated = 0,
               missed = 0; // of the tolerance, with the smallest step
};

class LawTangent : public testing::TestWithParam<Method> {
protected:
  // The elements of the stencil: every dof moves along v.
  static LawElements moved(const LawElements& e, const Basis& basis, const std::vector<double>& v,
                           double way) {
    LawElements out = e;
    const std::size_t own = static_cast<std::size_t>(e.layout.node_dofs),
                      d = static_cast<std::size_t>(e.layout.dimension),
                      nodes = static_cast<std::size_t>(basis.node_count() + 1) * own,
                      m = static_cast<std::size_t>(e.layout.multipliers), points = mechanics::stencil_points,
                      count = static_cast<std::size_t>(e.at.count);
    const std::size_t size = static_cast<std::size_t>(e.layout.state_size);
    std::vector<double> node_directions;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t node = 0; node < nodes; node += own)
        node_directions.insert(node_directions.end(), &v[i * (nodes + m) + node],
                               &v[i * (nodes + m) + node] + d);
    out.at = mechanics::stencil(e.at, basis, node_directions, way, {});
    const std::size_t t = static_cast<std::size_t>(e.layout.parameters);
    out.state.resize(count * points * size);
    out.at.start.resize(count * points * t);
    out.multiplier.resize(count * points * m);
    out.slave_values.resize(e.slave_values.size() * points);
    out.slave_temperature.clear(), out.master_temperature.clear();
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < points; ++k) {
        std::copy_n(&e.state[i * size], size, &out.state[(i * points + k) * size]);
        std::copy_n(&e.at.start[i * t], t, &out.at.start[(i * points + k) * t]);
        if (!e.slave_values.empty())
          std::copy_n(&e.slave_values[i * 3], 3, &out.slave_values[(i * points + k) * 3]);
        for (std::size_t node = d; node < nodes && own > d; node += own)
          (node == d ? out.slave_temperature : out.master_temperature)
              .push_back((node == d ? e.slave_temperature[i]
                                    : e.master_temperature[i * (nodes / own - 1) + node / own - 1]) +
                         mechanics::stencil_offsets[k] * way * v[i * (nodes + m) + node]);
        for (std::size_t a = 0; a < m; ++a)
          out.multiplier[(i * points + k) * m + a] =
              e.multiplier[i * m + a] + mechanics::stencil_offsets[k] * way * v[i * (nodes + m) + nodes + a];
      }
    return out;
  }

  // Forces and powers apart, each over the largest entry of its rows. coarse: of eight times the step, or null
  static double error_of(const LawResults& centre, const LawResults& points, const LawResults* coarse,
                         std::size_t e, const double* v, const ents_layout& layout, double t) {
    const std::size_t n = static_cast<std::size_t>(layout.dofs),
                      nodes = n - static_cast<std::size_t>(layout.multipliers),
                      own = static_cast<std::size_t>(layout.node_dofs);
    double worst[2] = {}, largest[2] = {};
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t power = layout.heat && i < nodes && i % own == own - 1;
      double exact = 0.0;
      for (std::size_t j = 0; j < n; ++j) {
        exact += centre.tangent[(e * n + j) * n + i] * v[j];
        test::raise(largest[power], std::fabs(centre.tangent[(e * n + j) * n + i]));
      }
      const std::size_t first = mechanics::stencil_points * e * n + i;
      double slope = mechanics::difference(&points.residual[first], n, t);
      if (coarse) slope += (slope - mechanics::difference(&coarse->residual[first], n, 8.0 * t)) / 4095.0;
      test::raise(worst[power], std::fabs(slope - exact));
    }
    double error = 0.0;
    for (const std::size_t part : {0u, 1u}) // open: nothing, and its derivative nothing
      if (worst[part] != 0.0) test::raise(error, worst[part] / largest[part]);
    return error;
  }

  // Gaps beside which differences are not those of the law at one gap. An augmented law holds an element that touches
  // within the increment above the surface, too; its slip begins where it is not, with a kink. Dugdale's tension has a
  // rate that bends sharply where it begins, has risen, and begins to fall.
  static std::vector<double> bends(const LawElements& e, std::size_t element) {
    const auto& normal = GetParam().normal;
    if (normal["type"] == "augmented" &&
        e.state[element * static_cast<std::size_t>(e.layout.state_size) + 1] == 1.0)
      return {0.0};
    if (normal["type"] != "dugdale") return {};
    const double strength = normal["strength"], length = normal["work"].get<double>() / strength,
                 rise = 2.0 * strength / normal["stiffness"].get<double>();
    return {0.0, rise, length + rise / 3.0 - 0.125 * length};
  }

  static bool crosses_a_bend(const LawElements& e, const LawResults& centre, const LawResults& points,
                             std::size_t element) {
    const double offset = GetParam().offset.is_number() ? GetParam().offset.get<double>() : 0.0;
    for (const double bend : bends(e, element)) {
      const bool above = centre.gap[element] + offset > bend;
      for (std::size_t k = 0; k < mechanics::stencil_points; ++k)
        if ((points.gap[mechanics::stencil_points * element + k] + offset > bend) != above) return true;
    }
    return false;
  }

  static bool same_branch(const LawResults& centre, const LawResults& points, std::size_t e, bool& flagged) {
    flagged = centre.status[e] != ENTS_OK;
    bool same = true;
    for (std::size_t k = mechanics::stencil_points * e; k < mechanics::stencil_points * (e + 1); ++k) {
      flagged = flagged || points.status[k] != ENTS_OK;
      same = same && (points.flags[k] & branch) == (centre.flags[e] & branch);
    }
    return same;
  }

  // The slid length |xi - xi_n| of wear has a kink where the element has not slid.
  static bool starts_to_slide(const LawElements& e, const LawResults& centre, std::size_t element) {
    if (e.layout.worn < 0) return false;
    const std::size_t at = element * static_cast<std::size_t>(e.layout.state_size);
    // an open element counts its way from its projection
    const std::size_t from = e.state[at + 1] == 1.0 ? 3 : static_cast<std::size_t>(e.layout.worn) + 3;
    double slid = 0.0;
    for (std::size_t a = 0; a < static_cast<std::size_t>(e.layout.parameters); ++a)
      slid += std::fabs(centre.state[at + 3 + a] - e.state[at + from + a]);
    return slid < 20 * step;
  }

  // An element that its wear has opened may have a gap below 0, where the conductance of a gas is that of 0.
  static bool conducts_from_zero(const LawElements& e, const LawResults& centre, std::size_t element) {
    if (!e.layout.heat || e.layout.worn < 0 || (centre.flags[element] & ENTS_FLAG_CONTACT) != 0) return false;
    const double* worn = &e.state[element * static_cast<std::size_t>(e.layout.state_size) +
                                  static_cast<std::size_t>(e.layout.worn)];
    return std::fabs(centre.gap[element] + e.slave_values[3 * element] + worn[0] + worn[1]) < 20 * step;
  }

  void check(const mechanics::Scene& scene, const mechanics::Model& model, const LawElements& e,
             Random& random) {
    const std::size_t n = static_cast<std::size_t>(e.layout.dofs);
    const std::vector<double> v = mechanics::draw_directions(random, e.at.count, e.layout.dofs);
    LawResults centre, points;
    std::array<LawResults, 3> finer;
    evaluate_near(model.handle(), e, ENTS_RESIDUAL | ENTS_TANGENT | ENTS_FLAGS | ENTS_STATE | ENTS_GAP,
                  centre);
    evaluate_near(model.handle(), moved(e, *scene.basis, v, step), ENTS_RESIDUAL | ENTS_FLAGS | ENTS_GAP,
                  points);
    for (std::size_t i = 0; i < static_cast<std::size_t>(e.at.count); ++i) {
      bool flagged = false;
      const bool same = same_branch(centre, points, i, flagged) && !starts_to_slide(e, centre, i) &&
                        !crosses_a_bend(e, centre, points, i) && !conducts_from_zero(e, centre, i);
      count_.flagged += flagged;
      count_.crossing += !flagged && !same;
      if (flagged || !same) continue;
      double error = error_of(centre, points, nullptr, i, &v[i * n], e.layout, step);
      count_.repeated += !(error <= tolerance);
      double t = step;
      const LawResults* before = &points;
      for (LawResults& again : finer) {
        if (error <= tolerance) break;
        t /= 8.0;
        if (again.status.empty())
          evaluate_near(model.handle(), moved(e, *scene.basis, v, t), ENTS_RESIDUAL | ENTS_FLAGS, again);
        for (const LawResults* coarse : {static_cast<const LawResults*>(nullptr), before})
          error = std::min(error, error_of(centre, again, coarse, i, &v[i * n], e.layout, t));
        before = &again;
      }
      count_.missed += !(error <= tolerance);
      ++count_.checked;
      count_.open += (centre.flags[i] & ENTS_FLAG_CONTACT) == 0;
      count_.touching += (centre.flags[i] & ENTS_FLAG_CONTACT) != 0 &&
                         e.state[i * static_cast<std::size_t>(e.layout.state_size) + 1] == 1.0;
      count_.stick += (centre.flags[i] & ENTS_FLAG_STICK) != 0;
      count_.slip += (centre.flags[i] & ENTS_FLAG_SLIP) != 0;
      count_.limit += (centre.flags[i] & ENTS_FLAG_SHEAR_LIMIT) != 0;
      worst_.see(error, [&] {
        return scene.basis->name + " " + scene.projection + " " + scene.height.dump() + " element " +
               std::to_string(i);
      });
    }
  }

  Count count_;
  mechanics::Worst worst_;
};

TEST_P(LawTangent, IsTheDerivativeOfTheResidual) {
  // an element that flattens is ten evaluations, and one with heat is the same mechanics once more
  const bool some = !GetParam().flattening.is_null() || !GetParam().heat.is_null();
  const std::int64_t goal = mechanics::long_samples(some ? 20000 : 100000);
  Random random(1991);
  int round = 0;
  while (count_.checked < goal && round < 50) {
    ++round;
    for (const Basis& basis : mechanics::all_bases())
      for (const char* projection : mechanics::projections)
        for (const char* height : {"none", "sine", "gaussian"}) {
          const mechanics::Scene scene = draw_scene(random, basis, height, projection);
          const mechanics::Model model = model_of(scene, GetParam());
          // far and near the border of stick and slip
          check(scene, model,
                draw(random, scene, model, mechanics::long_samples(300), random.coin() ? 0.05 : 0.01),
                random);
        }
  }
  EXPECT_GE(count_.checked, goal);
  EXPECT_LE(worst_.error, of_the_smallest_step) << worst_.where;
  EXPECT_LE(count_.missed, count_.checked / 500) << worst_.where;
  const std::string type = GetParam().normal["type"];
  const bool reaches = !GetParam().offset.is_null() && (type == "dugdale" || type == "lennard_jones");
  if (type != "separation" && !reaches) { // of these all are in the range
    EXPECT_GT(count_.open, goal / 100);
  }
  EXPECT_TRUE((GetParam().friction.is_null() && GetParam().wear.is_null()) || count_.touching > goal / 20);
  if (!GetParam().friction.is_null()) {
    EXPECT_GT(count_.stick, goal / 100);
    const bool slips = GetParam().friction["type"] == "coulomb",
               limited = GetParam().friction.contains("shear_limit");
    EXPECT_TRUE(!slips || count_.slip > goal / 100);
    EXPECT_TRUE(!limited || count_.limit > goal / 100);
  }
  std::cout << GetParam().name << ": " << count_.checked << " checked (" << count_.open << " open, "
            << count_.touching << " touching within the increment, " << count_.stick << " stick, "
            << count_.slip << " slip, " << count_.limit << " at the shear limit; skipped: " << count_.flagged
            << " flagged, " << count_.crossing << " across a border), worst error " << worst_.error << ", "
            << count_.repeated << " repeated, " << count_.missed << " above " << tolerance << "\n";
}

std::vector<Method> methods_of_tangent() {
  std::vector<Method> all = all_methods();
  for (const Method& method : methods_with_heat()) all.push_back(method);
  return all;
}
INSTANTIATE_TEST_SUITE_P(Method, LawTangent, testing::ValuesIn(methods_of_tangent()),
                         [](const auto& parameter) { return parameter.param.name; });

} // namespace
} // namespace laws::tangent_test
