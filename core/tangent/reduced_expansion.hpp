// SPDX-License-Identifier: BSD-3-Clause
// Tangents that are summed in the reduced space of forms.hpp and expanded to the dofs once: first the
// columns, then the rows. A form has a vector on each field, 0: delta X, 1 ..: delta a_k, d ..: delta a_kl
// where the basis bends. Faster than the sum of products of numbers of dofs where those are many and the
// nodes few, so that what lies between the two expansions stays in the fastest cache.
#pragma once

#include "core/tangent/projection_forms.hpp"
#include "core/tangent/write_tangent.hpp"

namespace ents::ENTS_ISA {

template <class Basis, bool Rigid, int Parts>
inline constexpr int fields_of = Rigid                         ? 1
                                 : (Parts& on_curvatures) != 0 ? Basis::dim + OnCurvatures<Basis, int>::count
                                 : (Parts& on_tangents) != 0   ? Basis::dim
                                                               : 1;

template <int Field, class Basis, class Scalar> ENTS_INLINE auto& on_field(Form<Basis, Scalar>& f) {
  constexpr int D = Basis::dim;
  if constexpr (Field == 0)
    return f.x;
  else if constexpr (Field < D)
    return f.a[Field - 1];
  else
    return f.a2.of[Field - D];
}
template <int Field, class Basis, class Scalar>
ENTS_INLINE const auto& on_field(const Form<Basis, Scalar>& f) {
  return on_field<Field>(const_cast<Form<Basis, Scalar>&>(f));
}

// What is on the fields, at the slave and at the nodes of the master: 1 and 0 or - N_i, N_i,k and N_i,kl of
// it.
template <class Basis> struct ReducedExpansion;

template <> struct ReducedExpansion<Tri3> {
  template <class Scalar, class V>
  static ENTS_INLINE void expand(const Scalar (&xi)[2], const V (&field)[3], V (&at)[4]) {
    at[0] = field[0];
    at[2] = field[1] - xi[0] * field[0];
    at[3] = field[2] - xi[1] * field[0];
    at[1] = -(field[0] + at[2] + at[3]);
  }
};
template <> struct ReducedExpansion<Quad4> {
  // as factors of 1, xi_1, xi_2 and xi_1 xi_2 at the corners, over 4
  template <class Scalar, class V>
  static ENTS_INLINE void expand(const Scalar (&xi)[2], const V (&field)[4], V (&at)[5]) {
    const Scalar quarter(0.25);
    const V even = Scalar(-0.25) * field[0];
    V one = quarter * field[1], two = quarter * field[2], twist = quarter * field[3];
    add_scaled(twist, xi[0], two);
    add_scaled(one, xi[0], even);
    add_scaled(two, xi[1], even);
    add_scaled(twist, xi[1], one);
    const V low = even - two, high = even + two, less = one - twist, more = one + twist;
    at[0] = field[0];
    at[1] = low - less;
    at[2] = low + less;
    at[3] = high + more;
    at[4] = high - more;
  }
};

// of the fields to the nodes
template <class Tangent, class V, int Fields, int M>
ENTS_INLINE void expand_fields(const Tangent& t, const V (&field)[Fields], V (&at)[M]) {
  if constexpr (M == 1)
    at[0] = field[0];
  else
    Tangent::Expansion::expand(t.xi, field, at);
}

// f(a) of each natural coordinate. Code for eight elements, written once for each coordinate, would not fit
// into the cache of instructions.
template <int T, class Scalar, class F> ENTS_INLINE void for_each_coordinate(F&& f) {
  if constexpr (std::is_same_v<Scalar, double> || register_width < 8) {
    for (int a = 0; a < T; ++a) f(a);
  } else {
    ENTS_ROLLED
    for (int a = 0; a < T; ++a) f(a);
  }
}

template <class Tangent>
concept Reduced = requires {
  typename Tangent::Expansion;
};

// component c of v += x
template <class Scalar, int D> ENTS_INLINE void add_to_component(Vec<Scalar, D>& v, int c, const Scalar& x) {
  for (int i = 0; i < D; ++i) v[i] = i == c ? v[i] + x : v[i];
}
#if defined(__AVX__) && defined(__GNUC__) && !defined(__clang__)
inline constexpr long long component_masks[5] = {0, 0, -1, 0, 0};
// -0 to the other components, which leaves a zero its sign
ENTS_INLINE void add_to_component(Vec<double, 3>& v, int c, double x) {
  using V = Vec<double, 3>::Numbers;
  using I = Vec<double, 3>::Integers;
  const I mask = {component_masks[2 - c], component_masks[3 - c], component_masks[4 - c], 0};
  v.v = v.v + (V)(((I)V{x, x, x, x} & mask) | ((I)V{-0.0, -0.0, -0.0, -0.0} & ~mask));
}
#endif

// K's columns of component c, from t.entries<row, column>(c): what is on field `row`, of component c of field
// `column`. block(m, n, v): what is at node m, of node n; node 0 is the slave. between() is called now and
// then.
template <Reduced Tangent, class Between, class Block>
ENTS_INLINE void expand_columns(const Tangent& t, int c, Between&& between, Block&& block) {
  constexpr int fields = Tangent::fields, M = Tangent::M;
  using V = typename Tangent::V;
  V along[M][fields];
  unroll<fields>([&](auto column) ENTS_LAMBDA_INLINE {
    V of[fields], at[M];
    unroll<fields>([&](auto row)
                       ENTS_LAMBDA_INLINE { of[row] = t.template entries<row.value, column.value>(c); });
    expand_fields(t, of, at);
    for (int m = 0; m < M; ++m) along[m][column] = at[m];
    between();
  });
  for (int m = 0; m < M; ++m) {
    V at[M];
    expand_fields(t, along[m], at);
    for (int n = 0; n < M; ++n) block(m, n, at[n]);
  }
}

// + g g^T
template <int D, Reduced Tangent>
ENTS_NOINLINE void add_curved_law(const Tangent& t, double* out, std::int64_t leading) {
  for (int n = 0; n < Tangent::M; ++n)
    for (int c = 0; c < D; ++c)
      for (int m = 0; m < Tangent::M; ++m)
        for (int i = 0; i < D; ++i)
          out[(D * n + c) * leading + std::int64_t{D} * m + i] += t.g[n][c] * t.g[m][i];
}

template <int D, Reduced Tangent>
ENTS_INLINE void write_tangent(const Tangent& t, double* out, std::int64_t leading) {
  for (int c = 0; c < D; ++c)
    expand_columns(
        t, c, []() ENTS_LAMBDA_INLINE {},
        [&](int m, int n, const auto& v)
            ENTS_LAMBDA_INLINE { store(v, out + (D * n + c) * leading + std::int64_t{D} * m); });
  if (t.curved_law) add_curved_law<D>(t, out, leading);
}
#if defined(ENTS_HAS_LANES) && defined(__AVX__)
// A vector of each lane to an element of its own: to(lane)
template <class To> ENTS_INLINE void scatter_vector(const Vec<Lanes<4>, 3>& v, To&& to) {
  typename VectorOf<4>::Numbers r[4] = {v[0].v, v[1].v, v[2].v, v[2].v};
  transpose<4, 2>(r);
  for (int k = 0; k < 4; ++k) to(k).v = r[k];
}
#endif
#if defined(ENTS_HAS_LANES)
template <int D, Reduced Tangent, int W>
ENTS_NOINLINE void write_tangent(const Tangent& t, double* const (&out)[W], std::int64_t leading,
                                 std::uint32_t used, DeferredCopy* last) {
  constexpr int N = Tangent::N, steps = D * Tangent::fields;
  using Scalar = Lanes<W>;
  const auto between = [&]() ENTS_LAMBDA_INLINE { interleave_copy(last, (W * N * N + steps - 1) / steps); };
  Scalar entries[N * N];
  // rolled as in for_each_coordinate()
  ENTS_ROLLED
  for (int c = 0; c < D; ++c)
    expand_columns(t, c, between, [&](int m, int n, auto& v) ENTS_LAMBDA_INLINE {
      if (t.curved_law) add_scaled(v, t.g[n][c], t.g[m]);
      store(v, entries + (D * n + c) * N + D * m);
    });
  write_columns<N>(out, leading, used, [&](int i) ENTS_LAMBDA_INLINE -> const Scalar& { return entries[i]; });
}
#endif

} // namespace ents::ENTS_ISA
