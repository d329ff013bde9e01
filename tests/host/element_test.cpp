// SPDX-License-Identifier: BSD-3-Clause
// Bulk elements: patch test, rigid motions, and the tangent as derivative of the residual.
#include "bulk.hpp"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support.hpp"

namespace host::element_test {
namespace {

struct Case {
  ElementType type;
  Formulation formulation;
  Material::Law law;
};

std::string case_name(const testing::TestParamInfo<Case>& info) {
  static const std::map<Formulation, std::string> formulations{{Formulation::plane_strain, "plane_strain"},
                                                               {Formulation::plane_stress, "plane_stress"},
                                                               {Formulation::axisymmetric, "axisymmetric"},
                                                               {Formulation::solid, "solid"}};
  return std::string(traits(info.param.type).name) + "_" + formulations.at(info.param.formulation) +
         (info.param.law == Material::Law::neo_hooke ? "_neo_hooke" : "_linear");
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const auto law : {Material::Law::linear_elastic, Material::Law::neo_hooke}) {
    for (const auto type : {ElementType::tri3, ElementType::quad4})
      for (const auto formulation :
           {Formulation::plane_strain, Formulation::plane_stress, Formulation::axisymmetric})
        cases.push_back({type, formulation, law});
    for (const auto type : {ElementType::tet4, ElementType::hex8})
      cases.push_back({type, Formulation::solid, law});
  }
  return cases;
}

/// A block of 3 cells per direction with its inner nodes moved about; it does not touch the axis x = 0.
class Elements : public testing::TestWithParam<Case> {
protected:
  Elements() : random_(7) {
    d_ = static_cast<std::size_t>(dimension(GetParam().type));
    mesh_.dimension = dimension(GetParam().type);
    const GridLines lines{1, 1.4, 1.7, 2};
    add_block(mesh_, "block", GetParam().type, std::vector<GridLines>(d_, lines), 0);
    for (int n = 0; n < mesh_.node_count(); ++n) {
      bool inner = true;
      for (const double x : mesh_.node(n)) inner = inner && x != 1 && x != 2;
      inner_.push_back(inner);
      if (!inner) continue;
      for (std::size_t i = 0; i < d_; ++i)
        mesh_.coordinates[static_cast<std::size_t>(n) * d_ + i] += random_.uniform(-0.05, 0.05);
    }
    ElementSetup setup;
    setup.formulation = GetParam().formulation;
    setup.material = {GetParam().law, 210, 0.3};
    setup.thickness = 0.7;
    bulk_.emplace(mesh_, std::vector<ElementSetup>{setup});
  }

  std::vector<double> residual(const std::vector<double>& displacement, double* energy = nullptr,
                               const std::vector<double>& direction = {}) {
    std::vector<double> result(displacement.size(), 0.0);
    EXPECT_TRUE(bulk_->assemble(displacement, direction, result, nullptr, energy));
    return result;
  }

  /// u = H X + c at all nodes.
  std::vector<double> linear_field(const Matrix3& H, double shift) const {
    std::vector<double> u;
    for (int n = 0; n < mesh_.node_count(); ++n) {
      const auto x = mesh_.node(n);
      for (std::size_t i = 0; i < d_; ++i) {
        double value = shift;
        for (std::size_t j = 0; j < d_; ++j) value += H(static_cast<int>(i), static_cast<int>(j)) * x[j];
        u.push_back(value);
      }
    }
    return u;
  }

  bool axisymmetric() const { return GetParam().formulation == Formulation::axisymmetric; }
  static double norm(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value * value;
    return std::sqrt(sum);
  }

  test::Random random_;
  Mesh mesh_;
  std::size_t d_ = 2;
  std::vector<bool> inner_;
  std::optional<Bulk> bulk_;
};

TEST_P(Elements, PatchTest) {
  // A homogeneous state is in equilibrium whatever the shape of the elements. Axisymmetric: u_r = a r, u_z =
  // b z.
  Matrix3 H = Matrix3::Zero();
  for (int i = 0; i < static_cast<int>(d_); ++i)
    for (int j = 0; j < static_cast<int>(d_); ++j)
      if (!axisymmetric() || i == j) H(i, j) = random_.uniform(-0.1, 0.1);
  const std::vector<double> forces = residual(linear_field(H, axisymmetric() ? 0 : 0.3));
  const double size = norm(forces);
  for (std::size_t dof = 0; dof < forces.size(); ++dof)
    if (inner_[dof / d_]) {
      EXPECT_LT(std::abs(forces[dof]), 1e-13 * size); // sums of some 30 terms, 1e-16 each
    }
}

TEST_P(Elements, RigidMotionsAreFree) {
  Matrix3 H = Matrix3::Zero(); // finite rotation for finite strains, infinitesimal for small ones
  if (!axisymmetric()) {
    const Eigen::Vector3d axis =
        d_ == 2 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d(1, -2, 0.5).normalized();
    if (GetParam().law == Material::Law::neo_hooke)
      H = Eigen::AngleAxisd(0.8, axis).toRotationMatrix() - Matrix3::Identity();
    else
      H << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  }
  std::vector<double> u = linear_field(H, 0);
  for (int n = 0; n < mesh_.node_count(); ++n) // a body of revolution can only move along its axis
    u[static_cast<std::size_t>(n) * d_ + 1] += 0.4;
  EXPECT_LT(norm(residual(u)),
            1e-11 * 210); // displacements of size 3 on elements of 0.3: rounding 1e-15 in H
}

TEST_P(Elements, ResidualAndTangentAreDerivatives) {
  const std::vector<double> u = random_.vector(mesh_.coordinates.size(), -0.03, 0.03);
  const std::vector<double> direction = random_.vector(mesh_.coordinates.size(), -1, 1);
  double energy = 0;
  const std::vector<double> R = residual(u, &energy);
  std::vector<double> K_direction = residual(u, nullptr, direction);
  for (std::size_t i = 0; i < R.size(); ++i) K_direction[i] -= R[i];
  std::array<double, 2> energy_remainder{}, residual_remainder{};
  for (std::size_t k = 0; k < 2; ++k) {
    const double h = k == 0 ? 1e-2 : 1e-3;
    std::vector<double> moved = u;
    for (std::size_t i = 0; i < u.size(); ++i) moved[i] += h * direction[i];
    double moved_energy = 0, first = 0, second = 0, squared = 0;
    const std::vector<double> moved_R = residual(moved, &moved_energy);
    for (std::size_t i = 0; i < u.size(); ++i) {
      first += R[i] * direction[i];
      second += direction[i] * K_direction[i];
      squared += std::pow(moved_R[i] - R[i] - h * K_direction[i], 2);
    }
    energy_remainder[k] = std::abs(moved_energy - energy - h * first - 0.5 * h * h * second);
    residual_remainder[k] = std::sqrt(squared);
  }
  if (GetParam().law == Material::Law::linear_elastic) { // nothing remains but rounding
    EXPECT_LT(energy_remainder[0], 1e-13 * energy);
    EXPECT_LT(residual_remainder[0], 1e-13 * norm(K_direction));
  } else { // a tenth of the step: remainders of third and second order, up to the next order (factor e^{1/2})
    EXPECT_LT(energy_remainder[1], energy_remainder[0] * 1e-3 * 1.65);
    EXPECT_LT(residual_remainder[1], residual_remainder[0] * 1e-2 * 1.65);
  }
}

TEST_P(Elements, TangentIsSymmetric) {
  const std::vector<double> u = random_.vector(mesh_.coordinates.size(), -0.03, 0.03);
  const std::vector<double> a = random_.vector(u.size(), -1, 1), b = random_.vector(u.size(), -1, 1);
  const std::vector<double> R = residual(u), Ka = residual(u, nullptr, a), Kb = residual(u, nullptr, b);
  double aKb = 0, bKa = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    aKb += a[i] * (Kb[i] - R[i]);
    bKa += b[i] * (Ka[i] - R[i]);
  }
  EXPECT_NEAR(aKb, bKa, 1e-12 * norm(Ka) * norm(b));
}

TEST_P(Elements, NodalStressOfAHomogeneousState) {
  Matrix3 H = Matrix3::Zero();
  for (int i = 0; i < static_cast<int>(d_); ++i) H(i, i) = 0.02 * (i + 1);
  const std::vector<double> stress = bulk_->nodal_stress(linear_field(H, 0));
  if (axisymmetric()) H(2, 2) = H(0, 0);
  MaterialPoint point;
  const Material& material = bulk_->setups()[0].material;
  ASSERT_TRUE(GetParam().formulation == Formulation::plane_stress
                  ? evaluate_plane_stress(material, H, false, point)
                  : evaluate(material, H, false, point));
  Matrix3 cauchy = point.stress;
  if (material.law == Material::Law::neo_hooke) {
    const Matrix3 F = Matrix3::Identity() + H;
    cauchy = point.stress * F.transpose() / F.determinant();
  }
  const std::size_t components = d_ == 3 ? 6 : 4;
  for (std::size_t n = 0; n < stress.size() / components; ++n)
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(stress[n * components + static_cast<std::size_t>(i)], cauchy(i, i), 1e-12 * material.young);
}

INSTANTIATE_TEST_SUITE_P(All, Elements, testing::ValuesIn(all_cases()), case_name);

} // namespace
} // namespace host::element_test
