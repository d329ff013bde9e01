// SPDX-License-Identifier: BSD-3-Clause
// The model reader: every key ends in the right place.
#include "abi/read/model_json.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "model_errors.hpp"
#include "model_heights.hpp"

namespace model_json_test {
namespace {

using namespace ents;
using namespace ents::testing;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double pi = 3.14159265358979323846;

TEST(ModelJson, TheSegmentAloneIsAModel) {
  const ModelSpec model = read_model(R"({"segment": "quad4"})");
  EXPECT_EQ(model.basis, Basis::quad4);
  EXPECT_TRUE(model.height.none());
  EXPECT_EQ(model.height.dimension(), 2);
  EXPECT_FALSE(model.own_surface_coordinates);
  EXPECT_EQ(model.projection, ProjectionKind::normal);
  EXPECT_EQ(model.law.normal, NormalKind::none);
  EXPECT_EQ(model.law.friction, FrictionKind::none);
  EXPECT_FALSE(model.law.symmetrised);
  EXPECT_EQ(model.tangent, TangentKind::consistent);
  EXPECT_FALSE(model.rigid_master);
  EXPECT_EQ(model.penetration_limit, 0.0);
  EXPECT_EQ(model.border, 1e-7);
}

TEST(ModelJson, EveryBasisIsRead) {
  for (const BasisEntry& entry : basis_table) {
    const ModelSpec model =
        read_model(R"({"segment": ")" + std::string(entry.name) + R"(", "height": null})");
    EXPECT_EQ(model.basis, entry.basis);
    EXPECT_EQ(&basis_entry(model.basis), &entry);
    EXPECT_EQ(model.height.dimension(), entry.parameters);
  }
}

TEST(ModelJson, EveryKeyEndsInItsPlace) {
  const ModelSpec model = read_model(R"({
    "segment": "line3",
    "height": {"type": "constant", "value": -0.25},
    "surface_coordinates": [[-1.5], [2], [0.5]],
    "projection": {"type": "shadow_point", "emitter": [0.3, 6]},
    "contact": {"normal": {"type": "penalty", "stiffness": 1e5}},
    "tangent": "small_gap",
    "master": "rigid",
    "penetration_limit": 0.125,
    "border": 0.0625})");
  EXPECT_EQ(height_1(model, 0.4), -0.25);
  EXPECT_TRUE(model.own_surface_coordinates);
  EXPECT_EQ(model.surface_coordinates, (std::vector<double>{-1.5, 2.0, 0.5}));
  EXPECT_EQ(model.projection, ProjectionKind::shadow_point);
  EXPECT_EQ(model.ray[0], 0.3);
  EXPECT_EQ(model.ray[1], 6.0);
  EXPECT_EQ(model.ray[2], 0.0);
  EXPECT_EQ(model.law.normal, NormalKind::penalty);
  EXPECT_EQ(model.law.number[0], 1e5);
  EXPECT_EQ(model.tangent, TangentKind::small_gap);
  EXPECT_TRUE(model.rigid_master);
  EXPECT_EQ(model.penetration_limit, 0.125);
  EXPECT_EQ(model.border, 0.0625);

  const ModelSpec other =
      read_model(R"({"segment": "tri3", "tangent": "first_variation", "master": "deformable",
    "surface_coordinates": [[1, 2], [3, 4], [5, 6]]})");
  EXPECT_EQ(other.tangent, TangentKind::first_variation);
  EXPECT_FALSE(other.rigid_master);
  EXPECT_EQ(other.surface_coordinates, (std::vector<double>{1, 2, 3, 4, 5, 6}));
}

ContactLaw law_of(const std::string& contact) {
  return read_model(R"({"segment": "line2", "contact": )" + contact + "}").law;
}

TEST(ModelJson, EveryLawEndsInItsPlace) {
  const ContactLaw power = law_of(R"({"normal": {"type": "power", "coefficient": 2e5, "exponent": 2.5}})");
  EXPECT_EQ(power.normal, NormalKind::power);
  EXPECT_EQ(power.number[0], 2e5);
  EXPECT_EQ(power.twice_exponent, 5);
  const ContactLaw soft =
      law_of(R"({"normal": {"type": "exponential", "pressure": 3, "clearance": 0.01}, "symmetrised": true})");
  EXPECT_EQ(soft.normal, NormalKind::exponential);
  EXPECT_EQ(soft.number[0], 3.0);
  EXPECT_EQ(soft.number[1], 0.01);
  EXPECT_TRUE(soft.symmetrised);
  EXPECT_EQ(law_of(R"({"normal": {"type": "augmented", "stiffness": 1}})").normal, NormalKind::augmented);
  EXPECT_EQ(law_of(R"({"normal": {"type": "augmented_multiplier", "stiffness": 1}})").normal,
            NormalKind::augmented_multiplier);
  EXPECT_EQ(law_of(R"({"normal": {"type": "multiplier", "stiffness": 7}})").normal, NormalKind::multiplier);
  EXPECT_EQ(law_of(R"({"normal": {"type": "multiplier", "stiffness": 7}})").number[0], 7.0);

  EXPECT_EQ(law_of(R"({"normal": {"type": "table", "gap": [-1, 0], "pressure": [2, 0]}})").normal,
            NormalKind::table);

  const std::string start = R"({"normal": {"type": "penalty", "stiffness": 1}, "friction": )";
  const ContactLaw coulomb =
      law_of(start + R"({"type": "coulomb", "coefficient": 0.3, "stiffness": 4, "shear_limit": 5}})");
  EXPECT_EQ(coulomb.friction, FrictionKind::coulomb);
  EXPECT_EQ(coulomb.friction_coefficient, 0.3);
  EXPECT_EQ(coulomb.friction_stiffness, 4.0);
  EXPECT_EQ(coulomb.shear_limit, 5.0);
  EXPECT_EQ(law_of(start + R"({"type": "coulomb", "coefficient": 0.3, "stiffness": 4}})").shear_limit, 0.0);
  const ContactLaw rough = law_of(start + R"({"type": "rough", "stiffness": 6}})");
  EXPECT_EQ(rough.friction, FrictionKind::rough);
  EXPECT_EQ(rough.friction_stiffness, 6.0);
  EXPECT_EQ(law_of(start + "null}").friction, FrictionKind::none);
}

TEST(ModelJson, DirectionsOfAnyLengthBecomeUnitVectors) {
  for (const std::string length : {"1", "1e-200", "1e99", "7"}) {
    const ModelSpec model =
        read_model(R"({"segment": "tri3", "projection": {"type": "shadow_direction", "direction": [)" +
                   length + ", -" + length + ", 0]}}");
    // two divisions and a square root
    EXPECT_NEAR(model.ray[0], std::sqrt(0.5), 2 * eps);
    EXPECT_NEAR(model.ray[1], -std::sqrt(0.5), 2 * eps);
    EXPECT_EQ(model.ray[2], 0.0);
  }
}

// The spellings of the golden vectors, against the definitions; a dozen roundings of terms below 1.
TEST(ModelJson, HeightsIn2DFollowTheirDefinition) {
  const double s = 0.37, bound = 12 * eps;
  EXPECT_NEAR(
      height_1(
          read_model(with_height(
              "line2",
              R"({"type": "sine", "amplitude": 0.023908, "wave_vector": [0.898359], "phase": 2.97415})")),
          s),
      0.023908 * std::sin(2 * pi * 0.898359 * s + 2.97415), bound);
  EXPECT_EQ(
      height_1(read_model(with_height("line2", R"({"type": "sine", "amplitude": 1, "wave_vector": [0.25]})")),
               1.0),
      1.0);
  EXPECT_NEAR(
      height_1(read_model(with_height(
                   "line2",
                   R"({"type": "polynomial", "coefficients": [0.069462, -0.099891, -0.058057, 0.082054]})")),
               s),
      0.069462 - 0.099891 * s - 0.058057 * s * s + 0.082054 * s * s * s, bound);
  EXPECT_NEAR(
      height_1(
          read_model(with_height(
              "line2",
              R"({"type": "gaussian", "amplitude": -0.040578, "center": [-0.239372], "width": 0.376952})")),
          s),
      -0.040578 * std::exp(-(s + 0.239372) * (s + 0.239372) / (2 * 0.376952 * 0.376952)), bound);
  EXPECT_NEAR(height_1(read_model(with_height(
                           "line2", R"({"type": "product", "of": [{"type": "constant", "value": 0.5},
              {"type": "sum", "of": [{"type": "polynomial", "coefficients": [0, 1]}, {"type": "constant", "value": 2}]}]})")),
                       s),
              0.5 * (s + 2.0), bound);
}

TEST(ModelJson, HeightsIn3DFollowTheirDefinition) {
  const double s = 0.37, t = -0.81, bound = 12 * eps;
  EXPECT_NEAR(
      height_2(read_model(with_height(
                   "tri3",
                   R"({"type": "sine", "amplitude": 0.047, "wave_vector": [0.78, -0.25], "phase": -2.28})")),
               s, t),
      0.047 * std::sin(2 * pi * (0.78 * s - 0.25 * t) - 2.28), bound);
  EXPECT_NEAR(
      height_2(
          read_model(with_height(
              "tri3", R"({"type": "polynomial", "coefficients": [[0.1, 0.2, 0.3], [0.4], [0.5, 0.6]]})")),
          s, t),
      0.1 + 0.2 * t + 0.3 * t * t + 0.4 * s + s * s * (0.5 + 0.6 * t), bound);
  EXPECT_NEAR(
      height_2(
          read_model(with_height(
              "tri3", R"({"type": "gaussian", "amplitude": 0.05, "center": [-0.19, 0.03], "width": 0.38})")),
          s, t),
      0.05 * std::exp(-((s + 0.19) * (s + 0.19) + (t - 0.03) * (t - 0.03)) / (2 * 0.38 * 0.38)), bound);
}

// The basic profile of ISO 68-1 for a pitch of 1.5: H = 1.299, 3/8 H above the pitch line, H/4 below.
TEST(ModelJson, ThreadIsThatOfIso68) {
  const std::string iso = R"("pitch": 1.5, "flank_angles": [30, 30], "crest": 0.1875, "root": 0.375)";
  const double bound = 16 * eps, H = 1.5 * std::sqrt(0.75); // s is of order 6, flanks have slopes of 1.7
  const ModelSpec grooves =
      read_model(with_height("line2", R"({"type": "thread", )" + iso + R"(, "offset": 0.25})"));
  for (const double ridge : {-1.25, 0.25, 6.25}) {
    EXPECT_NEAR(height_1(grooves, ridge), 0.375 * H, bound);
    EXPECT_NEAR(height_1(grooves, ridge + 0.75), -0.25 * H, bound);
    EXPECT_NEAR(height_1(grooves, ridge + 0.375), 0.0, bound) << "pitch line";
    EXPECT_NEAR(height_1(grooves, ridge - 0.375), 0.0, bound) << "pitch line";
    EXPECT_NEAR(height_1(grooves, ridge + 0.275), 0.1 * std::sqrt(3.0), bound) << "flank of 30 degrees";
  }
  // it climbs by starts x pitch in a turn, to the left or to the right
  const std::string two = R"({"type": "thread", )" + iso + R"(, "starts": 2, )";
  const ModelSpec right = read_model(with_height("quad4", two + R"("turn": 360})"));
  const ModelSpec left = read_model(with_height("quad4", two + R"("hand": "left"})"));
  const ModelSpec rings =
      read_model(with_height("quad4", R"({"type": "thread", )" + iso + R"(, "starts": 0})"));
  for (const double axis : {-0.3, 0.1, 0.7})
    for (const double turns : {0.0, 0.3, 0.9}) {
      const double expected = height_1(grooves, axis + 0.25);
      EXPECT_NEAR(height_2(right, 360 * turns, axis + 3 * turns), expected, 4 * bound);
      EXPECT_NEAR(height_2(left, 2 * pi * turns, axis - 3 * turns), expected, 4 * bound);
      EXPECT_NEAR(height_2(rings, turns, axis), expected, 4 * bound);
    }
}

TEST(ModelJson, SmallAndLongNumbersAreNumbers) {
  const auto value = [](const std::string& number) {
    return height_1(read_model(with_height("line2", R"({"type":"constant","value":)" + number + "}")), 0.0);
  };
  EXPECT_EQ(value("1e-400"), 0.0);
  EXPECT_EQ(value("0.1"), 0.1);
  EXPECT_EQ(value("0.1000000000000000055511151231257827021181583404541015625"), 0.1);
  EXPECT_EQ(value("123456789012345678901234567890"), 123456789012345678901234567890.0);
  EXPECT_EQ(value("-9007199254740993"), -9007199254740992.0);
  EXPECT_EQ(value("1E2"), 100.0);
}

} // namespace
} // namespace model_json_test
