// SPDX-License-Identifier: BSD-3-Clause
// The derivative of a height by a named parameter, h_,theta, with its own first and second derivatives.
#pragma once

#include "core/height/height.hpp"

namespace ents::ENTS_ISA {

// A constant 1 or 0: is this number of the node that of the parameter? parameter: 1 + its index
ENTS_INLINE double is_bound(const HeightNode& node, int slot, std::int32_t parameter) {
  return node.bound_to[slot] == parameter ? 1.0 : 0.0;
}

template <int T> HeightJet<T, double> derivative_part(const HeightJet<T, Dual<double>>& jet) {
  HeightJet<T, double> part;
  part.h = jet.h.d;
  for (int a = 0; a < T; ++a) part.h1[a] = jet.h1[a].d;
  for (int k = 0; k < T * (T + 1) / 2; ++k) part.h2[k] = jet.h2[k].d;
  return part;
}

// Derivative of the height along the direction y of s
template <int T>
HeightJet<T, double> height_along(const HeightNode& node, const double (&s)[T], const double (&y)[T]) {
  Dual<double> moving[T];
  for (int a = 0; a < T; ++a) moving[a] = Dual<double>(s[a], y[a]);
  return derivative_part(evaluate_height(node, moving));
}

// Of a formula: its numbers are dual numbers
template <int T, template <class> class Formula>
HeightJet<T, double> formula_rate(const Formula<double>&, const HeightNode& node, std::int32_t parameter,
                                  const double (&s)[T]) {
  Dual<double> numbers[most_formula_numbers], at[T];
  int i = 0, slot = 0;
  for (const FormulaNumber& number : Formula<double>::table)
    for (int k = 0; k < number.count(); ++k, ++i)
      numbers[i] = {node.numbers[i], number.named ? is_bound(node, slot++, parameter) : 0.0};
  Formula<Dual<double>> moving;
  set_height(moving, numbers, T);
  for (int a = 0; a < T; ++a) at[a] = Dual<double>(s[a]);
  return derivative_part(height_jet<T>(moving, at));
}

template <int T>
HeightJet<T, double> height_rate(const HeightNode& node, std::int32_t parameter, const double (&s)[T]) {
  HeightJet<T, double> rate = constant_jet<T>(0.0);
  if (with_formula(node, [&](const auto& formula) { rate = formula_rate(formula, node, parameter, s); }))
    return rate;
  const HeightNode* child = &node + node.first_child;
  switch (node.kind) {
  case HeightKind::shift: {
    double moved[T], y[T];
    for (int a = 0; a < T; ++a) moved[a] = s[a] - node.shift.by[a], y[a] = -is_bound(node, a, parameter);
    rate = height_rate(*child, parameter, moved);
    add_height(rate, height_along(*child, moved, y));
    break;
  }
  case HeightKind::external:
    for (int slot = 0; slot < node.external.parameter_count; ++slot) {
      if (node.bound_to[slot] != parameter) continue;
      double numbers[ExternalHeight::most_numbers]; // h, h_,a, h_,ab
      node.external.rates(node.external, slot, s, numbers);
      rate.h = numbers[0];
      for (int a = 0; a < T; ++a) rate.h1[a] = numbers[1 + a];
      for (int i = 0; i < T * (T + 1) / 2; ++i) rate.h2[i] = numbers[1 + T + i];
    }
    break;
  case HeightKind::sum:
    for (std::int32_t i = 0; i < node.child_count; ++i) add_height(rate, height_rate(child[i], parameter, s));
    break;
  case HeightKind::product:
    for (std::int32_t i = 0; i < node.child_count; ++i) {
      HeightJet<T, double> term = height_rate(child[i], parameter, s);
      for (std::int32_t j = 0; j < node.child_count; ++j)
        if (j != i) multiply_height(term, evaluate_height(child[j], s));
      add_height(rate, term);
    }
    break;
  default:
    break;
  }
  return rate;
}

// The height at s, in `d` the derivative by the parameter along (s.d, 1); parameter 0: by s alone
template <int T>
HeightJet<T, Dual<double>> height_with_rate(const HeightNode& node, std::int32_t parameter,
                                            const Dual<double> (&s)[T]) {
  HeightJet<T, Dual<double>> jet = evaluate_height(node, s);
  if (parameter == 0) return jet;
  double at[T];
  for (int a = 0; a < T; ++a) at[a] = s[a].v;
  const HeightJet<T, double> rate = height_rate(node, parameter, at);
  jet.h.d += rate.h;
  for (int a = 0; a < T; ++a) jet.h1[a].d += rate.h1[a];
  for (int k = 0; k < T * (T + 1) / 2; ++k) jet.h2[k].d += rate.h2[k];
  return jet;
}

} // namespace ents::ENTS_ISA
