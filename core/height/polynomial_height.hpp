// SPDX-License-Identifier: BSD-3-Clause
// Polynomials of s.
#pragma once

#include <cstdint>

#include "core/height/jet.hpp"

namespace ents {

struct PolynomialHeight {
  const double* coefficients; // [rows][columns]: s_1^row s_2^column; in 2D columns = 1
  std::int32_t rows;
  std::int32_t columns;
};

namespace ENTS_ISA {

template <class S> ENTS_INLINE HeightJet<1, S> polynomial_height(const PolynomialHeight& p, const S (&s)[1]) {
  S h(0.0), d1(0.0), d2(0.0); // Horner for p, p' and p''/2
  for (std::int32_t i = p.rows; i-- > 0;) {
    d2 = d2 * s[0] + d1;
    d1 = d1 * s[0] + h;
    h = h * s[0] + p.coefficients[i];
  }
  return {h, {d1}, {2.0 * d2}};
}

template <class S> ENTS_INLINE HeightJet<2, S> polynomial_height(const PolynomialHeight& p, const S (&s)[2]) {
  S h(0.0), h1(0.0), h11(0.0), h2(0.0), h12(0.0), h22(0.0); // Horner in s_1 of ...
  for (std::int32_t i = p.rows; i-- > 0;) {
    const double* c = p.coefficients + static_cast<std::int64_t>(i) * p.columns;
    S q(0.0), q2(0.0), q22(0.0); // ... Horner in s_2
    for (std::int32_t j = p.columns; j-- > 0;) {
      q22 = q22 * s[1] + q2;
      q2 = q2 * s[1] + q;
      q = q * s[1] + c[j];
    }
    h11 = h11 * s[0] + h1;
    h1 = h1 * s[0] + h;
    h = h * s[0] + q;
    h12 = h12 * s[0] + h2;
    h2 = h2 * s[0] + q2;
    h22 = h22 * s[0] + q22;
  }
  return {h, {h1, h2}, {2.0 * h11, h12, 2.0 * h22}};
}

} // namespace ENTS_ISA
} // namespace ents
