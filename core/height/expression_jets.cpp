// SPDX-License-Identifier: BSD-3-Clause
// Values and derivatives of expressions, several points at a time. Compiled once per instruction set.
#include "core/height/expression_steps.hpp"

namespace ents::ENTS_ISA {

namespace {

template <int N, class R>
void run(const ExternalHeight& height, int count, int first, const double* s, double* jet) {
  const Expression& expression = *static_cast<const Expression*>(height.data);
  constexpr int W = width_of<R>;
  R at[2] = {R(0.0), R(0.0)}, slots[Expression::most_slots][Expression::coefficients],
    out[Expression::coefficients];
  const bool whole = first + W <= count;
  for (int a = 0; a < expression.dimension; ++a) {
    double points[W];
    for (int k = 0; k < W && !whole; ++k)
      points[k] = s[a * count + (first + k < count ? first + k : count - 1)];
    load_numbers(whole ? s + a * count + first : points, at[a]);
  }
  run_expression<N>(expression, height.values, at, slots, [](const ExpressionStep&) {});
  derivatives_of<N>(expression, expression.steps.back().shape, slots[expression.result], out);
  const int numbers = expression.dimension == 1 ? N + 1 : coefficients_of<N>(3);
  for (int i = 0; i < numbers; ++i) {
    double values[W];
    store_numbers(out[i], whole ? jet + i * count + first : values);
    if (whole) continue;
    for (int k = 0; k < W && first + k < count; ++k) jet[i * count + first + k] = values[k];
  }
}

#if defined(__AVX512F__) && defined(ENTS_HAS_LANES)
using Several = Lanes<8>;
#elif defined(__AVX__) && defined(ENTS_HAS_LANES)
using Several = Lanes<4>;
#elif defined(ENTS_HAS_LANES)
using Several = Lanes<2>;
#else
using Several = double;
#endif

} // namespace

void expression_jets(const ExternalHeight& height, std::int32_t order, std::int32_t count, const double* s,
                     double* jet) {
  if (count == 1)
    return order > 2 ? run<3, double>(height, 1, 0, s, jet) : run<2, double>(height, 1, 0, s, jet);
  for (int first = 0; first < count; first += width_of<Several>)
    order > 2 ? run<3, Several>(height, count, first, s, jet) : run<2, Several>(height, count, first, s, jet);
}

} // namespace ents::ENTS_ISA
