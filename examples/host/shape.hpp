// SPDX-License-Identifier: BSD-3-Clause
// Shape functions and quadrature of the bulk elements: tri3, quad4, tet4, hex8.
#pragma once

#include <array>
#include <cmath>
#include <string_view>

#include <Eigen/Core>

namespace host {

enum class ElementType { tri3, quad4, tet4, hex8 };

constexpr int node_count(ElementType type) {
  return type == ElementType::tri3 ? 3 : type == ElementType::hex8 ? 8 : 4;
}
constexpr int dimension(ElementType type) {
  return type == ElementType::tri3 || type == ElementType::quad4 ? 2 : 3;
}
constexpr std::string_view name(ElementType type) {
  constexpr std::array<std::string_view, 4> names{"tri3", "quad4", "tet4", "hex8"};
  return names[static_cast<std::size_t>(type)];
}

/// Call a generic lambda with the type as a constant: `with_type(type, []<ElementType Type>() { ... })`.
template <class Function> auto with_type(ElementType type, const Function& function) {
  switch (type) {
  case ElementType::tri3:
    return function.template operator()<ElementType::tri3>();
  case ElementType::quad4:
    return function.template operator()<ElementType::quad4>();
  case ElementType::tet4:
    return function.template operator()<ElementType::tet4>();
  case ElementType::hex8:
    break;
  }
  return function.template operator()<ElementType::hex8>();
}

/// Faces (edges in 2D) as local node numbers, -1 fills up; their normal points out of the element, where
/// normal = tangent turned by +90 degrees in 2D and rho_,1 x rho_,2 in 3D.
struct LocalFaces {
  int count = 0, nodes_per_face = 0;
  std::array<std::array<int, 4>, 6> nodes{};
};

constexpr LocalFaces faces(ElementType type) {
  switch (type) {
  case ElementType::tri3:
    return {3, 2, {{{1, 0, -1, -1}, {2, 1, -1, -1}, {0, 2, -1, -1}}}};
  case ElementType::quad4:
    return {4, 2, {{{1, 0, -1, -1}, {2, 1, -1, -1}, {3, 2, -1, -1}, {0, 3, -1, -1}}}};
  case ElementType::tet4:
    return {4, 3, {{{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {2, 0, 3, -1}}}};
  case ElementType::hex8:
    break;
  }
  return {6, 4, {{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}}};
}

/// One quadrature point: weight, N [nodes], dN/dxi [nodes][dimension].
template <int Nodes, int Dim> struct ShapePoint {
  double weight = 0;
  Eigen::Matrix<double, Nodes, 1> values;
  Eigen::Matrix<double, Nodes, Dim> derivatives;
};

namespace detail {

constexpr std::array<std::array<double, 3>, 8> corners{
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};

/// Multilinear functions on [-1, 1]^Dim at xi.
template <int Nodes, int Dim>
ShapePoint<Nodes, Dim> multilinear(const std::array<double, 3>& xi, double weight) {
  ShapePoint<Nodes, Dim> point;
  point.weight = weight;
  for (int a = 0; a < Nodes; ++a) {
    const auto& corner = corners[static_cast<std::size_t>(a)];
    std::array<double, 3> factor{};
    for (std::size_t i = 0; i < Dim; ++i) factor[i] = 0.5 * (1 + corner[i] * xi[i]);
    double value = 1;
    for (std::size_t i = 0; i < Dim; ++i) value *= factor[i];
    point.values[a] = value;
    for (std::size_t i = 0; i < Dim; ++i) {
      double derivative = 0.5 * corner[i];
      for (std::size_t j = 0; j < Dim; ++j)
        if (j != i) derivative *= factor[j];
      point.derivatives(a, static_cast<int>(i)) = derivative;
    }
  }
  return point;
}

/// Linear functions on the unit simplex at xi.
template <int Dim> ShapePoint<Dim + 1, Dim> linear(const std::array<double, 3>& xi, double weight) {
  ShapePoint<Dim + 1, Dim> point;
  point.weight = weight;
  point.values[0] = 1;
  point.derivatives.setZero();
  for (int i = 0; i < Dim; ++i) {
    point.values[0] -= xi[static_cast<std::size_t>(i)];
    point.values[i + 1] = xi[static_cast<std::size_t>(i)];
    point.derivatives(0, i) = -1;
    point.derivatives(i + 1, i) = 1;
  }
  return point;
}

} // namespace detail

template <ElementType Type> auto quadrature() {
  constexpr int nodes = node_count(Type), dim = dimension(Type);
  if constexpr (Type == ElementType::tri3) {
    // Three points: an axisymmetric element weighs with the radius, which one point would not integrate.
    std::array<ShapePoint<nodes, dim>, 3> points;
    for (std::size_t i = 0; i < 3; ++i) {
      std::array<double, 3> xi{1. / 6, 1. / 6, 0};
      if (i > 0) xi[i - 1] = 2. / 3;
      points[i] = detail::linear<dim>(xi, 1. / 6);
    }
    return points;
  } else if constexpr (Type == ElementType::tet4) {
    return std::array<ShapePoint<nodes, dim>, 1>{detail::linear<dim>({0.25, 0.25, 0.25}, 1. / 6)};
  } else {
    const double g = 1 / std::sqrt(3.);
    std::array<ShapePoint<nodes, dim>, static_cast<std::size_t>(nodes)> points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      std::array<double, 3> xi{};
      for (std::size_t j = 0; j < dim; ++j) xi[j] = g * detail::corners[i][j];
      points[i] = detail::multilinear<nodes, dim>(xi, 1);
    }
    return points;
  }
}

} // namespace host
