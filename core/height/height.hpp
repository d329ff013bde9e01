// SPDX-License-Identifier: BSD-3-Clause
// The height function h(s) and its first and second derivatives, evaluated from a tree of plain data.
//
//   formulas         of a few numbers: formulas.hpp
//   polynomial       sum c[i] s_1^i   or   sum c[i][j] s_1^i s_2^j
//   map              (bi)cubic B-spline through regular samples, see height_map.hpp
//   profile          periodic cubic B-spline of wave_vector . s + phase, see thread.hpp
//   sum, product     of other heights
//   shift            another height at s - by
//   external         functions: an expression (expression.hpp), a function of the host
//   none             0
//
// With S = Dual<double> every derivative carries, in its `d`, its exact derivative along s.d, so that h2.d
// holds third derivatives of h. Branches depend on the model only, never on s.
#pragma once

#include <cstdint>

#include "core/height/external_height.hpp"
#include "core/height/formulas.hpp"
#include "core/height/polynomial_height.hpp"
#include "core/height/spline_height.hpp"

namespace ents {

#define ENTS_NAME(member, Formula) member,
enum class HeightKind : std::int32_t {
  none,
  ENTS_FORMULA_HEIGHTS(ENTS_NAME) // the formulas
  polynomial,
  map,
  profile,
  sum,
  product,
  shift,
  external
};
#undef ENTS_NAME

// Deepest nesting of sums and products: bounds the recursion of evaluate_height.
inline constexpr std::int32_t max_height_depth = 8;

struct ShiftHeight {
  double by[2];
};

struct HeightNode {
  HeightKind kind;
  std::int32_t child_count; // sum, product, shift
  std::int32_t first_child; // distance in nodes from this node to its first child; children are contiguous
  // Numbers that a named parameter gives (binding.hpp): 1 + its index, 0 for a number of the model's
  // own.
  //   formulas: the numbers of the table that are `named`; shift: by; map: 1 + the index of its field;
  //   external: its parameters
  std::uint8_t bound_to[4];
  const double* numbers; // of a formula, those of its table
  union {
#define ENTS_MEMBER(member, Formula) Formula<double> member;
    ENTS_FORMULA_HEIGHTS(ENTS_MEMBER)
#undef ENTS_MEMBER
    ShiftHeight shift;
    PolynomialHeight polynomial;
    MapHeight map;
    ProfileHeight profile;
    ExternalHeight external;
  };
};

// f(formula) of a node that is one; false: it is none.
template <class Node, class F> bool with_formula(Node& node, F&& f) {
  switch (node.kind) {
#define ENTS_CASE(member, Formula)                                                                           \
  case HeightKind::member:                                                                                   \
    f(node.member);                                                                                          \
    return true;
    ENTS_FORMULA_HEIGHTS(ENTS_CASE)
#undef ENTS_CASE
  default:
    return false;
  }
}

namespace ENTS_ISA {

// h and its derivatives at s. T: number of surface coordinates, as the tree was built for.
template <int T, class S> HeightJet<T, S> evaluate_height(const HeightNode& node, const S (&s)[T]) {
  switch (node.kind) {
  case HeightKind::none:
    break;
#define ENTS_CASE(member, Formula)                                                                           \
  case HeightKind::member:                                                                                   \
    return height_jet<T>(node.member, s);
    ENTS_FORMULA_HEIGHTS(ENTS_CASE)
#undef ENTS_CASE
  case HeightKind::polynomial:
    return polynomial_height(node.polynomial, s);
  case HeightKind::map:
    return map_height(node.map, s);
  case HeightKind::profile:
    return profile_height(node.profile, s);
  case HeightKind::external:
    return external_height(node.external, s);
  case HeightKind::sum:
  case HeightKind::product: {
    const HeightNode* child = &node + node.first_child;
    HeightJet<T, S> total = evaluate_height(child[0], s);
    for (std::int32_t i = 1; i < node.child_count; ++i) {
      const HeightJet<T, S> term = evaluate_height(child[i], s);
      if (node.kind == HeightKind::sum)
        add_height(total, term);
      else
        multiply_height(total, term);
    }
    return total;
  }
  case HeightKind::shift: {
    S moved[T];
    for (int a = 0; a < T; ++a) moved[a] = s[a] - node.shift.by[a];
    return evaluate_height(*(&node + node.first_child), moved);
  }
  }
  return constant_jet<T>(S(0.0));
}

// The jet at s, in `d` its derivative along y.
template <int T, class S>
ENTS_INLINE HeightJet<T, Dual<S>> jet_along(const HeightNode& node, const S (&s)[T], const S (&y)[T],
                                            const HeightJet<T, S>& at) {
  if (node.kind == HeightKind::sine) return sine_along(node.sine, y, at);
  Dual<S> moving[T];
  for (int a = 0; a < T; ++a) moving[a] = Dual<S>(s[a], y[a]);
  return evaluate_height(node, moving);
}

} // namespace ENTS_ISA
} // namespace ents
