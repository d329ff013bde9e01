// SPDX-License-Identifier: BSD-3-Clause
// Bulk elements: residual and tangent of one displacement element.
#pragma once

#include <numbers>
#include <span>
#include <vector>

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

  /// The thickness as the library takes it: 0 round an axis.
  double depth() const { return formulation == Formulation::axisymmetric ? 0 : thickness; }
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

/// An element at one of its quadrature points.
template <ElementType Type> struct ElementPoint {
  double jacobian = 0;                                         ///< of the map from the reference element
  double weight = 0;                                           ///< the volume that the point stands for [L^3]
  double radius = 0;                                           ///< axisymmetric, else 0
  Eigen::Matrix<double, node_count(Type), dimension(Type)> dN; ///< dN/dX
};

template <ElementType Type>
using NodeMatrix = Eigen::Matrix<double, node_count(Type), dimension(Type), Eigen::RowMajor>;

/// What an element's nodes have of a field of all nodes, [nodes][dim].
template <ElementType Type>
NodeMatrix<Type> gathered(std::span<const int> element, const std::vector<double>& field) {
  NodeMatrix<Type> values;
  for (int a = 0; a < node_count(Type); ++a)
    for (int i = 0; i < dimension(Type); ++i)
      values(a, i) =
          field[static_cast<std::size_t>(element[static_cast<std::size_t>(a)] * dimension(Type) + i)];
  return values;
}

/// @param X  [nodes][dim] in the undeformed body
template <ElementType Type, class Positions>
ElementPoint<Type> element_point(const ElementSetup& setup, const Positions& X,
                                 const ShapePoint<node_count(Type), dimension(Type)>& point) {
  ElementPoint<Type> at;
  const Eigen::Matrix<double, dimension(Type), dimension(Type)> map = X.transpose() * point.derivatives;
  at.jacobian = map.determinant();
  at.dN = point.derivatives * map.inverse();
  at.weight = point.weight * at.jacobian;
  if (setup.formulation == Formulation::axisymmetric) {
    at.radius = X.col(0).dot(point.values);
    at.weight *= 2 * std::numbers::pi * at.radius;
  } else if (dimension(Type) == 2) {
    at.weight *= setup.thickness;
  }
  return at;
}

/// The material of an element. @param gradient  its (3,3) entry becomes that of plane stress
/// @return false: the step must be cut
inline bool evaluate(const ElementSetup& setup, Matrix3& gradient, bool want_tangent, MaterialPoint& point) {
  return setup.formulation == Formulation::plane_stress
             ? evaluate_plane_stress(setup.material, gradient, want_tangent, point)
             : evaluate(setup.material, gradient, want_tangent, point);
}

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

  const Eigen::Map<const NodeMatrix<Type>> X(reference.data()), u(displacement.data());
  result.energy = 0;
  result.residual.setZero();
  if (want_tangent) result.tangent.setZero();

  Eigen::Matrix<double, entries, dofs> G; // H = G u
  Eigen::Matrix<double, entries, 1> P;
  Eigen::Matrix<double, entries, entries> A = Eigen::Matrix<double, entries, entries>::Zero();
  MaterialPoint material_point;
  for (const auto& point : points) {
    const auto [jacobian, weight, radius, dN] = element_point<Type>(setup, X, point);
    if (!(jacobian > 0)) return false;
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
    if (!evaluate(setup, H, want_tangent, material_point)) return false;

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
