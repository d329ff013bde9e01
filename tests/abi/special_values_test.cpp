// SPDX-License-Identifier: BSD-3-Clause
// Numbers no host means to pass: NaN, infinities, numbers near the ends of double precision, denormals, -0.
// Whatever an input is, the outcome is finite results or a documented status and untouched outputs.
#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "sample_count.hpp"
#include "support/element.hpp"

namespace special_values_test {
namespace {

using namespace test;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const std::vector<double> special_values = {nan,   infinity, -infinity, 1e308,   -1e308, 1e155, -1e77, 1e40,
                                            1e-40, 1e-155,   5e-324,    -1e-310, -0.0,   1e300, 1e-300};

// What outputs hold before a call: a NaN no computation makes.
const double untouched = std::bit_cast<double>(std::uint64_t{0x7ff4dead'beef0001});
bool is_untouched(double v) {
  return std::bit_cast<std::uint64_t>(v) == std::bit_cast<std::uint64_t>(untouched);
}

void forget(Results& results) {
  for (auto& array : results.real) array.assign(array.size(), untouched);
  results.flags = results.iterations = results.status = -77;
}

// Empty if the outcome is one of the promised ones.
std::string complaint(const Element& element, int32_t status, int32_t wanted, const Results& results,
                      const ents_report& report) {
  bool finite = true, finite_state = all_finite(element[state_begin]);
  for (int i = 0; i < input_count; ++i) finite = finite && (i == state_begin || all_finite(element[i]));
  const bool negative_area = !element[area].empty() && element[area][0] < 0.0;
  if (results.status != status) return "the status array differs from the returned status";
  if (report.status != status) return "the report's status differs from the returned one";

  if (!finite && status != ENTS_NON_FINITE) return "a NaN or infinity was not reported";
  if (finite && negative_area && status != ENTS_BAD_VALUE) return "a negative area was not reported";
  if (finite && !negative_area && !finite_state && status != ENTS_BAD_STATE)
    return "a NaN in the state was not reported";
  if (finite && !negative_area && status < 0 && status != ENTS_BAD_STATE)
    return "a caller's mistake where there is none";
  if (status > ENTS_OUT_OF_RANGE) return "an unknown status";
  if (status > 0 && !(report.step_factor > 0.0 && report.step_factor < 1.0)) return "no step factor";

  for (int i = 0; i < output_count; ++i)
    for (const double v : results[i]) {
      const bool written = !is_untouched(v);
      if (written && (status != ENTS_OK || !(wanted & outputs[i].bit)))
        return std::string(outputs[i].name) + " was touched";
      if (status == ENTS_OK && (wanted & outputs[i].bit) && !std::isfinite(v))
        return std::string(outputs[i].name) + " is not finite";
    }
  return {};
}

std::string describe(const Model& model, const Element& element) {
  std::string text = model.text();
  for (int i = 0; i < input_count; ++i) {
    text += std::string("\n  ") + inputs[i].name + ":";
    for (const double v : element[i]) (text += " ") += number(v);
  }
  return text;
}

struct Tally {
  int calls = 0, ok = 0, failures = 0;
  void check(const Model& model, const Element& element, int32_t wanted, Results& results) {
    forget(results);
    ents_report report = new_report();
    const int32_t status = test::evaluate(model, element, wanted, results, &report);
    ++calls;
    ok += status == ENTS_OK;
    const std::string what = complaint(element, status, wanted, results, report);
    if (what.empty()) return;
    if (++failures <= 3)
      ADD_FAILURE() << what << " (status " << status << ", wanted " << wanted << ") with "
                    << describe(model, element);
  }
};

// Kinematics and element; without kinematics an element outside its segment is an open one.
constexpr int32_t masks[] = {want_all, want_element | want_values, want_values,
                             ENTS_GAP_GRADIENT | ENTS_GAP_HESSIAN};

TEST(SpecialValues, EachInputScalarInTurn) {
  Random random(20260101);
  Tally tally;
  for (const ModelKind& kind : some_kinds()) {
    const Model model(text(kind));
    Results results(model.layout);
    Element element = with_history(model, draw(model, basis(kind.basis), random), random);
    if (element[surface_coordinates].empty())
      for (const auto& node : basis(kind.basis).nodes)
        element[surface_coordinates].insert(element[surface_coordinates].end(), node.begin(), node.end());
    tally.check(model, element, want_all, results);
    for (int i = 0; i < input_count; ++i)
      for (double& scalar : element[i]) {
        const double good = scalar;
        for (const double value : special_values) {
          if (!is_long_taken(random)) continue;
          scalar = value;
          tally.check(model, element, masks[random.below(4)], results);
        }
        scalar = good;
      }
  }
  EXPECT_EQ(tally.failures, 0) << "of " << tally.calls;
  EXPECT_GT(tally.ok, tally.calls / 10) << "the test sees too few evaluations that succeed";
}

TEST(SpecialValues, RandomCorruptions) {
  Random random(20260102);
  Tally tally;
  const std::vector<ModelKind> kinds = all_kinds();
  while (tally.calls < long_samples(50000)) {
    const ModelKind& kind = kinds[static_cast<std::size_t>(random.below(static_cast<int>(kinds.size())))];
    const Model model(text(kind));
    Results results(model.layout);
    for (int repeat = 0; repeat < 50; ++repeat) {
      Element element = draw(model, basis(kind.basis), random);
      if (random.below(4) > 0) element = with_history(model, std::move(element), random);
      if (random.below(8) == 0) element[start].clear();
      const int corruptions = 1 + random.below(6);
      for (int k = 0; k < corruptions; ++k) {
        auto& array = element[random.below(input_count)];
        if (array.empty()) continue;
        double& scalar = array[static_cast<std::size_t>(random.below(static_cast<int>(array.size())))];
        switch (random.below(4)) {
        case 0:
          scalar =
              special_values[static_cast<std::size_t>(random.below(static_cast<int>(special_values.size())))];
          break;
        case 1:
          scalar *= std::pow(10.0, random(-300.0, 300.0));
          break; // any magnitude
        case 2:
          scalar *= std::pow(10.0, random(-15.0, 15.0));
          break;
        default:
          scalar = array[static_cast<std::size_t>(
              random.below(static_cast<int>(array.size())))]; // coincident nodes
        }
      }
      tally.check(model, element, masks[random.below(4)], results);
    }
  }
  EXPECT_EQ(tally.failures, 0) << "of " << tally.calls;
  EXPECT_GT(tally.ok, tally.calls / 10) << "the test sees too few evaluations that succeed";
}

// A segment scaled as a whole by any power of two: finite results, or a status, at every scale.
TEST(SpecialValues, EveryScaleOfLengths) {
  Random random(20260103);
  Tally tally;
  for (const ModelKind& kind : some_kinds()) {
    const Model model(text(kind));
    Results results(model.layout);
    const Element unit = draw(model, basis(kind.basis), random);
    for (int exponent = -1080; exponent <= 1020; exponent += 20) {
      if (!is_long_taken(random)) continue;
      Element element = unit;
      for (const int i : {slave, master})
        for (double& v : element[i]) v = std::ldexp(v, exponent);
      tally.check(model, element, want_all, results);
      element[start].clear();
      tally.check(model, element, want_element | want_values, results);
    }
  }
  EXPECT_EQ(tally.failures, 0) << "of " << tally.calls;
}

// Models may hold numbers up to 1e100 (and down to 1e-100 where they must be positive); segments may be
// stretched.
TEST(SpecialValues, ExtremeModelsOnStretchedSegments) {
  Random random(20260104);
  Tally tally;
  const std::vector<double> magnitudes = {1e-98, 1e-50, 1e-20, 1e-6, 1.0, 1e3, 1e9, 1e30, 1e60, 1e100};
  const auto any = [&] {
    const double size =
        magnitudes[static_cast<std::size_t>(random.below(static_cast<int>(magnitudes.size())))];
    return number(size * random(0.1, 1.0));
  };
  for (int repeat = 0; repeat < long_samples(1000); ++repeat) {
    const Basis& b = bases()[static_cast<std::size_t>(random.below(static_cast<int>(bases().size())))];
    const bool line = b.dimension == 2;
    const auto list = [](const std::vector<std::string>& entries) {
      std::string joined;
      for (const std::string& entry : entries) joined += (joined.empty() ? "[" : ", ") + entry;
      return joined + "]";
    };
    const std::string pair = line ? list({any()}) : list({any(), any()});
    const std::string triple = line ? list({any(), any()}) : list({any(), any(), any()});
    const std::string heights[] = {
        "null",
        R"({"type": "constant", "value": )" + any() + "}",
        R"({"type": "sine", "amplitude": )" + any() + R"(, "wave_vector": )" + pair + "}",
        R"({"type": "gaussian", "amplitude": )" + any() + R"(, "center": )" + pair + R"(, "width": )" +
            any() + "}",
        R"({"type": "polynomial", "coefficients": )" +
            (line ? list({any(), any(), any()}) : list({pair, pair})) + "}",
        R"({"type": "map", "boundary": "clamped", "size": )" + pair + R"(, "values": )" +
            (line ? list({any(), any()}) : list({pair, pair})) + "}",
        R"({"type": "thread", "flank_angles": [0.5, 60], "crest": 0, "root": 0, "pitch": )" + any() +
            R"(, "offset": )" + any() + "}",
    };
    const std::string projections[] = {R"({"type": "normal"})",
                                       R"({"type": "shadow_point", "emitter": )" + triple + "}",
                                       R"({"type": "shadow_direction", "direction": )" + triple + "}"};
    std::string height = heights[random.below(7)];
    if (random.below(4) == 0)
      height = R"({"type": "product", "of": [)" + heights[1 + random.below(6)] + ", " +
               heights[1 + random.below(6)] + "]}";
    const std::string with_stiffness[] = {"penalty", "augmented", "augmented_multiplier", "multiplier"};
    const std::string normals[] = {
        R"({"type": ")" + with_stiffness[random.below(4)] + R"(", "stiffness": )" + any() + "}",
        R"({"type": "power", "exponent": )" + number(0.5 * (2 + random.below(39))) + R"(, "coefficient": )" +
            any() + "}",
        R"({"type": "exponential", "pressure": )" + any() + R"(, "clearance": )" + any() + "}"};
    const std::string frictions[] = {"null", R"({"type": "rough", "stiffness": )" + any() + "}",
                                     R"({"type": "coulomb", "stiffness": )" + any() + R"(, "coefficient": )" +
                                         any() + R"(, "shear_limit": )" + any() + "}"};
    const Model model(R"({"segment": ")" + std::string(b.name) + R"(", "height": )" + height +
                      R"(, "projection": )" + projections[random.below(3)] + R"(, "contact": {"normal": )" +
                      normals[random.below(3)] + R"(, "friction": )" + frictions[random.below(3)] +
                      R"(}, "penetration_limit": )" + any() + "}");
    Results results(model.layout);
    for (int k = 0; k < 10; ++k) {
      Element element;
      element[master] = flat_master(b);
      element[slave] = std::vector<double>(static_cast<std::size_t>(b.dimension), 0.1);
      for (const int i : {slave, master})
        for (double& v : element[i]) v += random(-0.2, 0.2);
      const double stretch[3] = {std::pow(10.0, random(-70.0, 70.0)), std::pow(10.0, random(-70.0, 70.0)),
                                 std::pow(10.0, random(-70.0, 70.0))};
      const bool uniform = random.below(2) == 0;
      for (const int i : {slave, master})
        for (std::size_t c = 0; c < element[i].size(); ++c)
          element[i][c] *= stretch[uniform ? 0 : c % static_cast<std::size_t>(b.dimension)];
      if (random.below(2) == 0)
        for (const auto& node : b.nodes)
          for (const double x : node) element[surface_coordinates].push_back(x * stretch[1]);
      if (random.below(2) == 0) element[start] = centre(b);
      if (random.below(2) == 0) element[area] = {std::stod(any())};
      for (int i = 0; i < model.layout.multipliers; ++i) element[multiplier].push_back(std::stod(any()));
      if (random.below(2) == 0) element = with_history(model, std::move(element), random);
      tally.check(model, element, masks[random.below(4)], results);
    }
  }
  EXPECT_EQ(tally.failures, 0) << "of " << tally.calls;
  EXPECT_GT(tally.ok, tally.calls / 10) << "the test sees too few evaluations that succeed";
}

} // namespace
} // namespace special_values_test
