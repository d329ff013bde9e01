// SPDX-License-Identifier: BSD-3-Clause
// Vectors and tangents of ordinary elements, from numbers in registers to the host's arrays.
//
// One element: the columns of K are computed along the rows, as many at a time as a register holds. One
// element per lane: the lower triangle is computed for all lanes, then transposed, so that each element is
// written in one go; or, where an entry is the sum of few products, these are handed out to the elements
// (Tangent::one_by_one): computing both triangles is faster than transposing. The entries are the same
// expressions in the same order, so the bits are the same.
#pragma once

#include "core/numbers/streaming.hpp"
#include "core/tangent/lane_arrays.hpp"

namespace ents::ENTS_ISA {

// x where the row belongs to component c of its node; 0 elsewhere.
template <int D> ENTS_INLINE double where_component(double x, int row, int c) {
  return row % D == c ? x : 0.0;
}
#if defined(ENTS_HAS_LANES)
template <int D> struct ComponentPattern {
  long long of[D + 8];  // -1 where a row belongs to component 0
  std::uint8_t mask[D]; // of eight rows, bits
  constexpr ComponentPattern() : of(), mask() {
    for (int i = 0; i < D + 8; ++i) of[i] = i % D == 0 ? -1 : 0;
    for (int i = 0; i < D; ++i)
      for (int k = 0; k < 8; ++k) mask[i] = static_cast<std::uint8_t>(mask[i] | ((i + k) % D == 0) << k);
  }
};
template <int D> inline constexpr ComponentPattern<D> component_pattern{};
template <int D, int W> ENTS_INLINE Lanes<W> where_component(const Lanes<W>& x, int row, int c) {
  const int at = (row + D - c) % D;
  LaneTruth<W> mine;
  if constexpr (has_masks<W>)
    mine.v = component_pattern<D>.mask[at];
  else
    mine.v = load<typename VectorOf<W>::Integers>(component_pattern<D>.of + at);
  return select(mine, x, Lanes<W>(0.0));
}
#endif

// s_i s_j, or s_i r_j + r_i s_j
template <class R, class Q> ENTS_INLINE R product_of_weights(const R (&i)[1], const Q (&j)[1]) {
  return i[0] * R(j[0]);
}
template <class R, class Q> ENTS_INLINE R product_of_weights(const R (&i)[2], const Q (&j)[2]) {
  return i[0] * R(j[1]) + i[1] * R(j[0]);
}

// Weights of the nodes that the dofs of a piece belong to
template <int D, int W, int At, int M> ENTS_INLINE auto row_of_weights(const double (&weights)[M]) {
  if constexpr (W == 1) {
    return weights[At / D];
  } else {
#if defined(ENTS_HAS_DOF_ROWS)
    return DofPiece<D, W, At>::template weights<1>(weights);
#else
    double of_dof[W];
    for (int k = 0; k < W; ++k) of_dof[k] = weights[(At + k) / D];
    return load<Lanes<W>>(of_dof);
#endif
  }
}

// All entries but g g^T of a basis that is counted, D pieces after D pieces in a loop, so that components of
// their rows are known. The last pieces overlap the ones before.
template <int D, class Tangent>
ENTS_INLINE void write_pieces(const Tangent& t, double* out, std::int64_t leading) {
  constexpr int weights = std::extent_v<decltype(t.weights)>,
                most = D * std::extent_v<decltype(t.weights), 1>, W = width_for(most);
  const int M = t.places(), N = D * M, last = D * W <= most ? N - N % (D * W) : 0;
  using R = typename Register<W>::type;
  double of_row[weights][most];
  for (int w = 0; w < weights; ++w)
    for (int m = 0; m < M; ++m)
      for (int c = 0; c < D; ++c) of_row[w][D * m + c] = t.weights[w][m];
  for (int n = 0; n < M; ++n) {
    double of_column[weights];
    for (int w = 0; w < weights; ++w) of_column[w] = t.weights[w][n];
    unroll<D>([&](auto c) ENTS_LAMBDA_INLINE {
      const int j = D * n + c;
      const auto write = [&](int i, int component) ENTS_LAMBDA_INLINE {
        R of_piece[weights];
        for (int w = 0; w < weights; ++w) of_piece[w] = load<R>(of_row[w] + i);
        const auto row = [i](const auto& numbers) ENTS_LAMBDA_INLINE { return load<R>(numbers + i); };
        const R k = where_component<D>(product_of_weights(of_piece, of_column), component, c.value);
        store(out + j * leading + i, t.template add_rest<R>(t.template add_products<R>(k, row, j), row, j));
      };
      if constexpr (D * W <= most) {
        ENTS_ROLLED
        for (int at = 0; at < last; at += D * W)
          unroll<D>([&](auto p) ENTS_LAMBDA_INLINE { write(at + p * W, p * W % D); });
      }
      ENTS_ROLLED
      for (int at = last; at < N; at += W) {
        const int i = at + W <= N ? at : N - W;
        write(i, i % D);
      }
    });
  }
}

template <int D, class Tangent>
ENTS_INLINE void write_tangent(const Tangent& t, double* out, std::int64_t leading) {
  constexpr int M = std::extent_v<decltype(t.weights), 1>, N = D * M, W = width_for(N), P = pieces(N, W);
  constexpr int weights = std::extent_v<decltype(t.weights)>;
  if constexpr (Tangent::counted) {
    write_pieces<D>(t, out, leading);
  } else {
    Pieces<N> of_row[weights];
    unroll<P>([&](auto piece) ENTS_LAMBDA_INLINE {
      constexpr int p = piece.value;
      for (int k = 0; k < weights; ++k)
        of_row[k].template at<p>() = row_of_weights<D, piece_width(N, W, p), piece_at(N, W, p)>(t.weights[k]);
    });
    for (int n = 0; n < M; ++n) {
      double of_column[weights];
      for (int k = 0; k < weights; ++k) of_column[k] = t.weights[k][n];
      unroll<D>([&](auto c) ENTS_LAMBDA_INLINE {
        const int j = D * n + c;
        // of many products, a column is stored when all of it is computed: what is read for one piece serves
        // the others
        constexpr bool whole = Tangent::products > 2;
        Pieces<N> column;
        const auto write = [&](auto piece) ENTS_LAMBDA_INLINE {
          store(out + j * leading + piece_at(N, W, piece.value), column.template at<piece.value>());
        };
        unroll<P>([&](auto piece) ENTS_LAMBDA_INLINE {
          constexpr int p = piece.value, i = piece_at(N, W, p);
          using R = PieceOf<N, p>;
          R of_piece[weights];
          for (int w = 0; w < weights; ++w) of_piece[w] = of_row[w].template at<p>();
          const R k = where_component<D>(product_of_weights(of_piece, of_column), i, c);
          const auto row = [](const auto& numbers) ENTS_LAMBDA_INLINE { return piece_of<p>(numbers); };
          column.template at<p>() = t.template add_rest<R>(t.template add_products<R>(k, row, j), row, j);
          if constexpr (!whole) write(piece);
        });
        if constexpr (whole) unroll<P>(write);
      });
    }
  }
  const int count = D * t.places();
  if (t.curved_law) // g g^T
    for (int j = 0; j < count; ++j)
      for (int i = 0; i < count; ++i) out[j * leading + i] += t.g[i] * t.g[j];
}

#if defined(ENTS_HAS_LANES)

// Where entry (i, j) of a symmetric matrix of n columns is kept: lower triangle, column by column.
constexpr int kept_at(int n, int i, int j) {
  const int low = i < j ? i : j, high = i < j ? j : i;
  return low * (2 * n - low + 1) / 2 + (high - low);
}
template <int N> struct KeptAt {
  std::int16_t of[N * N];
  constexpr KeptAt() : of() {
    for (int j = 0; j < N; ++j)
      for (int i = 0; i < N; ++i) of[j * N + i] = static_cast<std::int16_t>(kept_at(N, i, j));
  }
};
template <int N> inline constexpr KeptAt<N> kept_table{};

// Each lane's tangent to one of its own: its weights, g and the arrays that pick(tangent) names, one of each
// natural coordinate
template <class Tangent, class One, int W, class... Pick>
ENTS_INLINE void scatter_tangent(const Tangent& t, One (&one)[W], Pick... pick) {
  constexpr int M = std::extent_v<decltype(t.weights), 1>;
  for (std::size_t r = 0; r < std::extent_v<decltype(t.weights)>; ++r) {
    double* of_lane[W];
    for (int k = 0; k < W; ++k) of_lane[k] = one[k].weights[r];
    write_lanes<M>(
        of_lane, [&](int i) ENTS_LAMBDA_INLINE { return t.weights[r][i]; }, t.places());
  }
  const auto numbers = [&](const auto& array, auto to) ENTS_LAMBDA_INLINE {
    if constexpr (Tangent::counted)
      scatter_counted(Tangent::D * t.places(), array, to);
    else
      scatter(array, to);
  };
  const auto each = [&](auto of) ENTS_LAMBDA_INLINE {
    for (int a = 0; a < Tangent::T; ++a)
      numbers(
          of(t)[a], [&](int k) ENTS_LAMBDA_INLINE -> auto& { return of(one[k])[a]; });
  };
  (each(pick), ...);
  if (t.curved_law)
    numbers(
        t.g, [&](int k) ENTS_LAMBDA_INLINE -> auto& { return one[k].g; });
  for (int k = 0; k < W; ++k) one[k].basis = t.basis, one[k].curved_law = t.curved_law;
}

// Where column j of N begins. Lanes whose bit is not set write to out[lane][0 .. N * N - 1], wherever that
// is.
template <int W>
ENTS_INLINE void column_places(double* const (&out)[W], int N, int j, std::int64_t leading,
                               std::uint32_t used, double* (&column)[W]) {
  for (int k = 0; k < W; ++k) column[k] = out[k] + j * (used >> k & 1 ? leading : N);
}
// All columns; entry(N j + i), a reference
template <int N, int W, class Entry>
ENTS_INLINE void write_columns(double* const (&out)[W], std::int64_t leading, std::uint32_t used,
                               Entry&& entry) {
  if (leading == N) {
    write_lanes<N * N>(out, entry);
    return;
  }
  for (int j = 0; j < N; ++j) {
    double* column[W];
    column_places(out, N, j, leading, used, column);
    write_lanes<N>(column, [&](int i) ENTS_LAMBDA_INLINE -> const Lanes<W>& { return entry(N * j + i); });
  }
}

// `last` is copied beside.
template <int D, class Tangent, int W>
ENTS_INLINE void write_tangent(const Tangent& t, double* const (&out)[W], std::int64_t leading,
                               std::uint32_t used, DeferredCopy* last) {
  constexpr int most = D * std::extent_v<decltype(t.weights), 1>,
                weights = std::extent_v<decltype(t.weights)>;
  const int M = t.places(), N = D * M;
  using S = Lanes<W>;
  constexpr bool few = most < W; // columns: then all at once
  if constexpr (few) interleave_copy(last, W * N * N);
  S kept[Tangent::symmetric ? most * (most + 1) / 2 : most * most];
  S* entry = kept;
  for (int n = 0; n < M; ++n)
    unroll<D>([&](auto c) ENTS_LAMBDA_INLINE {
      const int j = D * n + c;
      if constexpr (!few) interleave_copy(last, W * N);
      S of_column[weights];
      for (int k = 0; k < weights; ++k) of_column[k] = t.weights[k][n];
      const auto add = [&](int m, auto r) ENTS_LAMBDA_INLINE {
        const int i = D * m + r;
        S k = S(0.0);
        if constexpr (r.value == c.value) {
          S of_row[weights];
          for (int w = 0; w < weights; ++w) of_row[w] = t.weights[w][m];
          k = product_of_weights(of_row, of_column);
        }
        const auto row = [i](const auto& array) ENTS_LAMBDA_INLINE { return array[i]; };
        *entry++ = t.template add_products<S>(k, row, j);
      };
      if constexpr (Tangent::symmetric)
        unroll<D>([&](auto r) ENTS_LAMBDA_INLINE {
          if constexpr (r.value >= c.value) add(n, r);
        });
      for (int m = Tangent::symmetric ? n + 1 : 0; m < M; ++m)
        unroll<D>([&](auto r) ENTS_LAMBDA_INLINE { add(m, r); });
    });
  if (!Tangent::has_rest && t.curved_law) {
    entry = kept;
    for (int j = 0; j < N; ++j)
      for (int i = Tangent::symmetric ? j : 0; i < N; ++i, ++entry) *entry = *entry + t.g[i] * t.g[j];
  }
  int column_at[Tangent::counted && Tangent::symmetric ? most : 1]; // kept_at(N, i, j) is this plus i, i >= j
  if constexpr (Tangent::counted && Tangent::symmetric)
    for (int j = 0; j < N; ++j) column_at[j] = kept_at(N, j, j) - j;
  const auto entry_at = [&](int i, int j) ENTS_LAMBDA_INLINE -> const S& {
    if constexpr (!Tangent::symmetric)
      return kept[N * j + i];
    else if constexpr (Tangent::counted)
      return i < j ? kept[column_at[i] + j] : kept[column_at[j] + i];
    else
      return kept[kept_table<most>.of[N * j + i]];
  };
  if constexpr (!Tangent::has_rest && !Tangent::counted) {
    write_columns<most>(out, leading, used,
                        [&](int i) ENTS_LAMBDA_INLINE -> const S& { return entry_at(i, 0); });
  } else {
    for (int j = 0; j < N; ++j) {
      double* column[W];
      column_places(out, N, j, leading, used, column);
      const auto at_row = [&](int i) ENTS_LAMBDA_INLINE {
        return t.template add_rest<S>(
            entry_at(i, j), [i](const auto& array) ENTS_LAMBDA_INLINE { return array[i]; }, j);
      };
      if constexpr (!Tangent::has_rest)
        write_lanes<most>(
            column, [&](int i) ENTS_LAMBDA_INLINE -> const S& { return entry_at(i, j); }, N);
      else if (t.curved_law)
        write_lanes<most>(
            column, [&](int i) ENTS_LAMBDA_INLINE { return at_row(i) + t.g[i] * t.g[j]; }, N);
      else
        write_lanes<most>(column, at_row, N);
    }
  }
}

#endif

// The same out of line, where a call costs nothing beside it: compilers take long over long functions.
template <int D, class Tangent, class... Arguments>
ENTS_NOINLINE void write_long_tangent(const Tangent& t, const Arguments&... arguments) {
  write_tangent<D>(t, arguments...);
}

} // namespace ents::ENTS_ISA
