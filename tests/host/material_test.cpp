// SPDX-License-Identifier: BSD-3-Clause
// Stress is the derivative of the energy and the tangent that of the stress: the remainder of a Taylor
// expansion must fall at its order.
#include "material.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support.hpp"

namespace host::material_test {
namespace {

Matrix3 random_gradient(test::Random& random, double size) {
  Matrix3 gradient;
  for (int i = 0; i < 9; ++i) gradient(i / 3, i % 3) = random.uniform(-size, size);
  return gradient;
}

Eigen::Matrix<double, 9, 1> flat(const Matrix3& matrix) {
  Eigen::Matrix<double, 9, 1> vector;
  for (int i = 0; i < 9; ++i) vector[i] = matrix(i / 3, i % 3);
  return vector;
}

class FiniteStrain : public testing::TestWithParam<Material::Law> {};

TEST_P(FiniteStrain, StressAndTangentAreDerivatives) {
  test::Random random(1);
  const Material material{GetParam(), 210, 0.3};
  for (int sample = 0; sample < 50; ++sample) {
    const Matrix3 gradient = random_gradient(random, 0.3), direction = random_gradient(random, 1);
    MaterialPoint point, moved;
    if (!evaluate(material, gradient, true, point)) continue;
    std::array<double, 2> energy_remainder{}, stress_remainder{};
    for (std::size_t k = 0; k < 2; ++k) {
      const double h = k == 0 ? 1e-2 : 1e-3;
      ASSERT_TRUE(evaluate(material, gradient + h * direction, false, moved));
      const auto step = flat(direction);
      energy_remainder[k] = std::abs(moved.energy - point.energy - h * flat(point.stress).dot(step) -
                                     0.5 * h * h * step.dot(point.tangent * step));
      stress_remainder[k] = (flat(moved.stress) - flat(point.stress) - h * (point.tangent * step)).norm();
    }
    // A tenth of the step leaves a thousandth (hundredth) of a remainder of third (second) order; the next
    // order of the expansion changes that by less than the factor e^{1/2} allowed here.
    EXPECT_LT(energy_remainder[1], energy_remainder[0] * 1e-3 * 1.65);
    EXPECT_LT(stress_remainder[1], stress_remainder[0] * 1e-2 * 1.65);
  }
}

TEST_P(FiniteStrain, IsLinearElasticForSmallStrains) {
  test::Random random(2);
  const Material finite{GetParam(), 210, 0.3}, small{Material::Law::linear_elastic, 210, 0.3};
  const Matrix3 gradient = 1e-7 * random_gradient(random, 1);
  MaterialPoint a, b;
  ASSERT_TRUE(evaluate(finite, gradient, true, a));
  ASSERT_TRUE(evaluate(small, gradient, true, b));
  // The two differ in the second order of the gradient: 1e-7 relative.
  EXPECT_LT((a.stress - b.stress).norm(), 1e-6 * b.stress.norm());
  EXPECT_LT((a.tangent - b.tangent).norm(), 1e-6 * b.tangent.norm());
}

TEST_P(FiniteStrain, StressVanishesUnderRotation) {
  const Material material{GetParam(), 210, 0.3};
  const Matrix3 rotation = (Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized())).toRotationMatrix();
  MaterialPoint point;
  ASSERT_TRUE(evaluate(material, rotation - Matrix3::Identity(), false, point));
  // Rounding of F, F^-1 and ln J, each of size one, times mu and lambda of a few hundred.
  EXPECT_LT(point.stress.norm(), 1e-12 * material.young);
}

TEST(Material, PlaneStressHasNone) {
  test::Random random(3);
  for (const auto law :
       {Material::Law::linear_elastic, Material::Law::st_venant_kirchhoff, Material::Law::neo_hooke}) {
    const Material material{law, 210, 0.3};
    for (int sample = 0; sample < 20; ++sample) {
      Matrix3 gradient = random_gradient(random, 0.2);
      gradient.row(2).setZero();
      gradient.col(2).setZero();
      Matrix3 solved = gradient;
      MaterialPoint point, check;
      ASSERT_TRUE(evaluate_plane_stress(material, solved, true, point));
      ASSERT_TRUE(evaluate(material, solved, false, check));
      EXPECT_LT(std::abs(check.stress(2, 2)), 1e-12 * material.young);
      // The condensed tangent is the derivative of the in-plane stress along P_33 = 0: central difference,
      // error h^2 = 1e-10 times third derivatives of order one, rounding 1e-16 / h = 1e-11.
      const double h = 1e-5;
      for (const int entry : {0, 1, 3, 4}) {
        Matrix3 plus = gradient, minus = gradient;
        plus(entry / 3, entry % 3) += h;
        minus(entry / 3, entry % 3) -= h;
        MaterialPoint up, down;
        ASSERT_TRUE(evaluate_plane_stress(material, plus, false, up));
        ASSERT_TRUE(evaluate_plane_stress(material, minus, false, down));
        const auto slope = ((flat(up.stress) - flat(down.stress)) / (2 * h)).eval();
        for (const int row : {0, 1, 3, 4})
          EXPECT_NEAR(slope[row], point.tangent(row, entry), 1e-8 * material.young);
      }
    }
  }
}

TEST_P(FiniteStrain, InsideOutIsRefused) {
  const Material material{GetParam(), 210, 0.3};
  Matrix3 gradient = Matrix3::Zero();
  gradient(0, 0) = -1.5;
  MaterialPoint point;
  EXPECT_FALSE(evaluate(material, gradient, true, point));
}

INSTANTIATE_TEST_SUITE_P(Material, FiniteStrain,
                         testing::Values(Material::Law::st_venant_kirchhoff, Material::Law::neo_hooke),
                         [](const auto& test) {
                           return test.param == Material::Law::neo_hooke ? "neo_hooke"
                                                                         : "st_venant_kirchhoff";
                         });

} // namespace
} // namespace host::material_test
