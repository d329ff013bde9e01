// SPDX-License-Identifier: BSD-3-Clause
// Bulk elements: residual and tangent of one displacement element.
#pragma once

#include <numbers>
#include <span>

#include <Eigen/Core>

#include "material.hpp"
#include "shape.hpp"

namespace host {

/// What the two in-plane coordinates mean. In space: solid.
enum class Formulation { plane_strain, plane_stress, axisymmetric, solid };

/// What is common to the elements of a body.
struct ElementSetup {
  Formulation formulation = Formulation::solid;
  Material material;
  double thickness = 1; ///< [L], plane elements only

  /// Pressure of a body that is held while it is warmed by one unit of temperature.
  double thermal_stress() const {
    const double free = 1 - (formulation == Formulation::plane_stress ? 1 : 2) * material.poisson;
    return material.expansion * material.young / free;
  }
};

/// Residual and tangent of one element, node-major.
template <int Dofs> struct ElementResult {
  double energy = 0;
  Eigen::Matrix<double, Dofs, 1> residual;
  Eigen::Matrix<double, Dofs, Dofs> tangent;
};

/// @param reference     [nodes][dim] X
/// @param displacement  [nodes][dim] u
/// @return false if the element is turned inside out: the step must be cut
template <ElementType Type>
bool evaluate_element(const ElementSetup& setup, std::span<const double> reference,
                      std::span<const double> displacement, bool want_tangent,
                      ElementResult<node_count(Type) * dimension(Type)>& result) {
  constexpr int nodes = node_count(Type), dim = dimension(Type), dofs = nodes * dim;
  // Entries of H that can differ from zero, as 3 i + J: all in space, in-plane and 33 in the plane.
  constexpr int entries = dim == 3 ? 9 : 5;
  constexpr std::array<int, 9> space{0, 1, 2, 3, 4, 5, 6, 7, 8}, plane{0, 1, 3, 4, 8, 0, 0, 0, 0};
  constexpr std::array<int, 9> entry = dim == 3 ? space : plane;
  static const auto points = quadrature<Type>();

  using NodeMatrix = Eigen::Matrix<double, nodes, dim, Eigen::RowMajor>;
  const Eigen::Map<const NodeMatrix> X(reference.data()), u(displacement.data());
  result.energy = 0;
  result.residual.setZero();
  if (want_tangent) result.tangent.setZero();

  Eigen::Matrix<double, entries, dofs> G; // H = G u
  Eigen::Matrix<double, entries, 1> P;
  Eigen::Matrix<double, entries, entries> A = Eigen::Matrix<double, entries, entries>::Zero();
  MaterialPoint material_point;
  for (const auto& point : points) {
    const Eigen::Matrix<double, dim, dim> map = X.transpose() * point.derivatives; // dX/dxi
    const double jacobian = map.determinant();
    if (!(jacobian > 0)) return false;
    const Eigen::Matrix<double, nodes, dim> dN = point.derivatives * map.inverse(); // dN/dX
    double weight = point.weight * jacobian;
    double radius = 0;
    if (setup.formulation == Formulation::axisymmetric) {
      radius = X.col(0).dot(point.values);
      weight *= 2 * std::numbers::pi * radius;
    } else if (dim == 2) {
      weight *= setup.thickness;
    }
    G.setZero();
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < dim; ++i)
        for (int J = 0; J < dim; ++J) G(dim * i + J, dim * a + i) = dN(a, J);
    if (setup.formulation == Formulation::axisymmetric)
      for (int a = 0; a < nodes; ++a) G(4, dim * a) = point.values[a] / radius;

    Matrix3 H = Matrix3::Zero();
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < dim; ++i)
        for (int J = 0; J < dim; ++J) H(i, J) += u(a, i) * dN(a, J);
    if (setup.formulation == Formulation::axisymmetric) H(2, 2) = u.col(0).dot(point.values) / radius;
    const bool ok = setup.formulation == Formulation::plane_stress
                        ? evaluate_plane_stress(setup.material, H, want_tangent, material_point)
                        : evaluate(setup.material, H, want_tangent, material_point);
    if (!ok) return false;

    for (int e = 0; e < entries; ++e) {
      const int row = entry[static_cast<std::size_t>(e)];
      P[e] = material_point.stress(row / 3, row % 3);
      if (want_tangent)
        for (int f = 0; f < entries; ++f)
          A(e, f) = material_point.tangent(row, entry[static_cast<std::size_t>(f)]);
    }
    result.energy += weight * material_point.energy;
    result.residual.noalias() += weight * (G.transpose() * P);
    if (want_tangent) result.tangent.noalias() += G.transpose() * (weight * A) * G;
  }
  return true;
}

} // namespace host
