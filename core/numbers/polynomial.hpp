// SPDX-License-Identifier: BSD-3-Clause
// Polynomials of natural coordinates with vectors as coefficients, and their derivatives.
#pragma once

#include "core/numbers/vec.hpp"

namespace ents::ENTS_ISA {

// d[m]: the m-th derivative of p_0 + p_1 x + ... over m!, m <= Most and Degree (Horner; the divisions by x -
// x_0 go on).
template <int Degree, int Most, class V, class S>
ENTS_INLINE void divide_by_powers(const V* p, const S& x, V (&d)[Most + 1]) {
  const auto raised = [&x](V a, const V& b) ENTS_LAMBDA_INLINE { // a + x b
    add_scaled(a, x, b);
    return a;
  };
  d[0] = p[Degree];
  unroll<Degree>([&](auto step) ENTS_LAMBDA_INLINE {
    constexpr int done = step.value + 1, most = Most < done ? Most : done;
    unroll<most>([&](auto low) ENTS_LAMBDA_INLINE {
      constexpr int m = most - low.value;
      if constexpr (m == done)
        d[m] = d[m - 1];
      else
        d[m] = raised(d[m - 1], d[m]);
    });
    d[0] = raised(p[Degree - done], d[0]);
  });
}

// Derivatives of order m by xi_1 and n by xi_2, m + n <= Order, over m! n!
template <class S, int Order> struct SurfaceDerivatives { Vec<S, 3> of[Order + 1][Order + 1]; };

// sum c_kj xi_1^j xi_2^k: j and k <= Degree, of a triangle their sum
template <int Degree, bool Triangle, class S> struct SurfacePolynomial {
  using V = Vec<S, 3>;

  // Of the order by one coordinate: the highest by the other; -1: none
  static constexpr int highest(int other) { return other > Degree ? -1 : Triangle ? Degree - other : Degree; }
  // Is the derivative of order m by xi_1 and n by xi_2 not identically zero?
  static constexpr bool has(int m, int n) { return n <= highest(m); }

  template <int Order, int Width>
  static ENTS_INLINE void differentiate(const V (&c)[Width][Width], const S (&xi)[2],
                                        SurfaceDerivatives<S, Order>& d) {
    V at[Order + 1][Degree + 1]; // at xi_1, [by xi_1]: factors of the powers of xi_2
    unroll<Degree + 1>([&](auto k) ENTS_LAMBDA_INLINE {
      constexpr int most = highest(k) < Order ? highest(k) : Order;
      V row[most + 1];
      divide_by_powers<highest(k), most>(c[k], xi[0], row);
      for (int m = 0; m <= most; ++m) at[m][k] = row[m];
    });
    unroll<Order + 1>([&](auto m) ENTS_LAMBDA_INLINE {
      constexpr int left = Order - m.value, most = highest(m) < left ? highest(m) : left;
      if constexpr (most >= 0) {
        V column[most + 1];
        divide_by_powers<highest(m), most>(at[m], xi[1], column);
        for (int n = 0; n <= most; ++n) d.of[m][n] = column[n];
      }
      for (int n = most + 1; n <= left; ++n) d.of[m][n] = V::zero();
    });
  }
};

} // namespace ents::ENTS_ISA
