// SPDX-License-Identifier: BSD-3-Clause
#include "core/height/height_value.hpp"

#include <cmath>

#include "core/height/height_tree.hpp"

namespace ents {

namespace {

template <int T> bool is_defined(const HeightNode& node, const double* s, int order) {
  using ENTS_ISA::Dual;
  double at[T], zero = 0.0;
  for (int a = 0; a < T; ++a) at[a] = s[a];
  const auto jet = ENTS_ISA::evaluate_height(node, at);
  zero += 0.0 * jet.h;
  for (const double slope : jet.h1) zero += 0.0 * slope;
  for (const double curvature : jet.h2) zero += 0.0 * curvature;
  for (int c = 0; c < T && order > 2; ++c) {
    Dual<double> moving[T];
    for (int a = 0; a < T; ++a) moving[a] = Dual<double>(s[a], a == c ? 1.0 : 0.0);
    for (const Dual<double>& second : ENTS_ISA::evaluate_height(node, moving).h2) zero += 0.0 * second.d;
  }
  return zero == 0.0;
}

} // namespace

bool is_defined_at(const HeightNode& node, std::int32_t dimension, const double* s, int order) {
  return dimension == 1 ? is_defined<1>(node, s, order) : is_defined<2>(node, s, order);
}

double height_at(const HeightNode& node, std::int32_t dimension, const double* s) {
  if (dimension == 1) {
    const double at[1] = {s[0]};
    return ENTS_ISA::evaluate_height(node, at).h;
  }
  const double at[2] = {s[0], s[1]};
  return ENTS_ISA::evaluate_height(node, at).h;
}

double height_bound(const HeightNode& node) {
  double of_formula = 0.0;
  if (with_formula(node, [&](const auto& formula) { of_formula = ENTS_ISA::largest_height(formula); }))
    return of_formula;
  const HeightNode* child = &node + node.first_child;
  switch (node.kind) {
  case HeightKind::none:
    return 0.0;
  case HeightKind::polynomial: {
    const PolynomialHeight& p = node.polynomial;
    for (std::int64_t i = 1; i < std::int64_t{p.rows} * p.columns; ++i)
      if (p.coefficients[i] != 0.0) return Height::unbounded;
    return std::fabs(p.coefficients[0]);
  }
  case HeightKind::map:
    return node.map.bound;
  case HeightKind::profile:
    return node.profile.of_turns.bound;
  case HeightKind::shift:
    return height_bound(*child);
  case HeightKind::external:
    return node.external.bound;
  default: // sum, product
    break;
  }
  const bool sum = node.kind == HeightKind::sum;
  double bound = sum ? 0.0 : 1.0;
  for (std::int32_t i = 0; i < node.child_count; ++i) {
    const double part = height_bound(child[i]);
    bound = sum                           ? bound + part
            : bound == 0.0 || part == 0.0 ? 0.0
                                          : bound * part; // 0 times an unbounded factor is 0
  }
  return bound;
}

} // namespace ents
