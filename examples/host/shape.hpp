// SPDX-License-Identifier: BSD-3-Clause
// Shape functions and quadrature of the bulk elements: tri3, quad4, tet4, hex8.
#pragma once

#include <array>
#include <cmath>

#include <Eigen/Core>

#include "deck/element_types.hpp"

namespace host {

enum class ElementType { tri3, quad4, tet4, hex8 };

struct ElementTraits {
  const char* name; ///< in scenes
  int dimension, nodes;
  ents_deck::Shape shape; ///< of the reader of decks, which knows its faces and its number in VTK
};
inline constexpr std::array element_types{ElementTraits{"tri3", 2, 3, ents_deck::Shape::tri3},
                                          ElementTraits{"quad4", 2, 4, ents_deck::Shape::quad4},
                                          ElementTraits{"tet4", 3, 4, ents_deck::Shape::tet4},
                                          ElementTraits{"hex8", 3, 8, ents_deck::Shape::hex8}};

constexpr const ElementTraits& traits(ElementType type) {
  return element_types[static_cast<std::size_t>(type)];
}
constexpr int node_count(ElementType type) { return traits(type).nodes; }
constexpr int dimension(ElementType type) { return traits(type).dimension; }

/// Call a generic lambda with the type as a constant: `with_type(type, []<ElementType Type>() { ... })`.
template <std::size_t First = 0, class Function> auto with_type(ElementType type, const Function& function) {
  constexpr auto candidate = static_cast<ElementType>(First);
  if constexpr (First + 1 < element_types.size())
    if (type != candidate) return with_type<First + 1>(type, function);
  return function.template operator()<candidate>();
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
