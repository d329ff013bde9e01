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
#include "core/tangent/dof_rows.hpp"

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

template <int N> ENTS_INLINE const double* column_of(const double (&numbers)[N]) { return numbers; }
template <int N> ENTS_INLINE const double* column_of(const DofRow<N>& numbers) { return numbers.column; }

// All entries but g g^T, D pieces after D pieces in a loop, so that components of their rows are known: where
// the pieces of a column are many, unrolled code for each of them takes minutes to compile. The last piece
// overlaps the one before.
template <int D, class Tangent>
ENTS_INLINE void write_pieces(const Tangent& t, double* out, std::int64_t leading) {
  constexpr int M = std::extent_v<decltype(t.weights), 1>, N = D * M, W = width_for(N);
  constexpr int weights = std::extent_v<decltype(t.weights)>, last = N - N % (D * W);
  using R = typename Register<W>::type;
  double of_row[weights][N];
  for (int w = 0; w < weights; ++w)
    for (int i = 0; i < N; ++i) of_row[w][i] = t.weights[w][i / D];
  for (int n = 0; n < M; ++n) {
    double of_column[weights];
    for (int w = 0; w < weights; ++w) of_column[w] = t.weights[w][n];
    unroll<D>([&](auto c) ENTS_LAMBDA_INLINE {
      const int j = D * n + c;
      const auto write = [&](int i, int component) ENTS_LAMBDA_INLINE {
        R of_piece[weights];
        for (int w = 0; w < weights; ++w) of_piece[w] = load<R>(of_row[w] + i);
        const auto row = [i](const auto& numbers)
                             ENTS_LAMBDA_INLINE { return load<R>(column_of(numbers) + i); };
        const R k = where_component<D>(product_of_weights(of_piece, of_column), component, c.value);
        store(out + j * leading + i, t.template add_rest<R>(t.template add_products<R>(k, row, j), row, j));
      };
      ENTS_ROLLED
      for (int at = 0; at < last; at += D * W)
        unroll<D>([&](auto p) ENTS_LAMBDA_INLINE { write(at + p * W, p * W % D); });
      unroll<pieces(N - last, W)>([&](auto p) ENTS_LAMBDA_INLINE {
        constexpr int at = last + (p + 1) * W <= N ? last + p * W : N - W;
        write(at, at % D);
      });
    });
  }
}

// Rows of one element, one piece each: where they are few
template <int N>
inline constexpr bool unrolls_pieces = N <= 15 || (width_for(N) >= 4 && N <= 30) ||
                                       (width_for(N) >= 8 && N <= 56);

template <int D, class Tangent>
ENTS_INLINE void write_tangent(const Tangent& t, double* out, std::int64_t leading) {
  constexpr int M = std::extent_v<decltype(t.weights), 1>, N = D * M, W = width_for(N), P = pieces(N, W);
  constexpr int weights = std::extent_v<decltype(t.weights)>;
  if constexpr (!unrolls_pieces<N>) {
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
  if (t.curved_law) // g g^T
    for (int j = 0; j < N; ++j)
      for (int i = 0; i < N; ++i) out[j * leading + i] += t.g[i] * t.g[j];
}

#if defined(ENTS_HAS_LANES)

// Where entry (i, j) of a symmetric matrix is kept: lower triangle, column by column.
template <int N> constexpr int kept_at(int i, int j) {
  const int low = i < j ? i : j, high = i < j ? j : i;
  return low * (2 * N - low + 1) / 2 + (high - low);
}
template <int N> struct KeptAt {
  std::int16_t of[N * N];
  constexpr KeptAt() : of() {
    for (int j = 0; j < N; ++j)
      for (int i = 0; i < N; ++i) of[j * N + i] = static_cast<std::int16_t>(kept_at<N>(i, j));
  }
};
template <int N> inline constexpr KeptAt<N> kept_table{};

// Entries 0 .. Count - 1 of all lanes, entry(i) each (a reference: it lies in memory), to to[lane][0 .. Count
// - 1].
template <int Count, int W, class Entry> ENTS_INLINE void write_lanes(double* const (&to)[W], Entry&& entry) {
  typename VectorOf<W>::Numbers r[W];
  if constexpr (Count < W) {
    for (int i = 0; i < W; ++i) r[i] = entry(i < Count ? i : Count - 1).v;
    transpose<W, W / 2>(r);
    for (int k = 0; k < W; ++k) std::memcpy(to[k], &r[k], sizeof(double) * Count);
  } else {
    for (int at = 0; at < Count; at += W) {
      const int first = at + W <= Count ? at : Count - W;
      if constexpr (std::is_reference_v<decltype(entry(0))>) {
        read_transposed<W>(
            [&](int i) ENTS_LAMBDA_INLINE { return reinterpret_cast<const double*>(&entry(first + i)); }, r);
      } else {
        for (int i = 0; i < W; ++i) r[i] = entry(first + i).v;
        transpose<W, W / 2>(r);
      }
      for (int k = 0; k < W; ++k) std::memcpy(to[k] + first, &r[k], sizeof r[k]);
    }
  }
}

// number(k) of each lane k, without memory: a register read after writing its numbers one by one would stall.
template <int W, class Number, int... k>
ENTS_INLINE Lanes<W> each_lane(Number&& number, std::integer_sequence<int, k...>) {
  return Lanes<W>(typename VectorOf<W>::Numbers{number(k)...}, 0);
}
template <int W, class Number> ENTS_INLINE Lanes<W> each_lane(Number&& number) {
  return each_lane<W>(number, std::make_integer_sequence<int, W>());
}

// Numbers 0 .. Count - 1 of each lane's array.
template <int W, int Count>
ENTS_INLINE void read_lanes(const double* const (&from)[W], Lanes<W> (&out)[Count]) {
  constexpr int half = W / 2;
  const auto piece = [&](auto first, auto width, auto read) ENTS_LAMBDA_INLINE {
    typename VectorOf<W>::Numbers r[width.value];
    read_transposed<W, width.value, read.value>(
        [&](int k) ENTS_LAMBDA_INLINE { return from[k] + first.value; }, r);
    for (int i = 0; i < read; ++i) out[first.value + i].v = r[i];
  };
  if constexpr (Count == 1 || W < 4) {
    for (int i = 0; i < Count; ++i)
      out[i] = each_lane<W>([&](int k) ENTS_LAMBDA_INLINE { return from[k][i]; });
  } else if constexpr (W == 8 && Count == 2) {
    typename VectorOf<W>::Numbers r[2];
    for (int i = 0; i < 2; ++i) r[i] = VectorOf<W>::pairs(from[i], from[i + 2], from[i + 4], from[i + 6]);
    transpose<W, 1>(r);
    for (int i = 0; i < 2; ++i) out[i].v = r[i];
  } else if constexpr (Count <= half) {
    piece(Index<0>{}, Index<half>{}, Index<Count>{});
  } else if constexpr (Count < W) {
    piece(Index<0>{}, Index<half>{}, Index<half>{});
    piece(Index<Count - half>{}, Index<half>{}, Index<half>{});
  } else {
    unroll<pieces(Count, W)>([&](auto at) ENTS_LAMBDA_INLINE {
      constexpr int width = piece_width(Count, W, at.value);
      piece(Index<piece_at(Count, W, at.value)>{}, Index<width>{}, Index<width>{});
    });
  }
}
// A number of each of W elements, `stride` apart
template <int W> ENTS_INLINE Lanes<W> read_lanes(const double* from, std::int64_t stride) {
  if (stride == 1) return load<Lanes<W>>(from);
  if (stride == 0) return Lanes<W>(*from);
  return each_lane<W>([&](int k) ENTS_LAMBDA_INLINE { return from[k * stride]; });
}

// Each lane's numbers to an element of its own: to(lane)
template <int W, int N, class To> ENTS_INLINE void scatter(const Lanes<W> (&numbers)[N], To&& to) {
  static_assert(width_for(N) == W);
  unroll<pieces(N, W)>([&](auto piece) ENTS_LAMBDA_INLINE {
    constexpr int p = piece.value, first = piece_at(N, W, p);
    if constexpr (piece_width(N, W, p) == W) {
      typename VectorOf<W>::Numbers r[W];
      for (int i = 0; i < W; ++i) r[i] = numbers[first + i].v;
      transpose<W, W / 2>(r);
      for (int k = 0; k < W; ++k) set_piece<p>(to(k), Lanes<W>(r[k], 0));
    } else { // four numbers of eight lanes: two of their squares
      unroll<2>([&](auto part) ENTS_LAMBDA_INLINE {
        typename VectorOf<W / 2>::Numbers r[W / 2];
        for (int i = 0; i < W / 2; ++i)
          r[i] = load<typename VectorOf<W / 2>::Numbers>(
              reinterpret_cast<const double*>(&numbers[first + i]) + part * (W / 2));
        transpose<W / 2, W / 4>(r);
        for (int k = 0; k < W / 2; ++k) set_piece<p>(to(part * (W / 2) + k), Lanes<W / 2>(r[k], 0));
      });
    }
  });
}

// The same of a tangent: its weights, g and the arrays that pick(tangent) names, one of each natural
// coordinate
template <class Tangent, class One, int W, class... Pick>
ENTS_INLINE void scatter_tangent(const Tangent& t, One (&one)[W], Pick... pick) {
  constexpr int M = std::extent_v<decltype(t.weights), 1>;
  for (std::size_t r = 0; r < std::extent_v<decltype(t.weights)>; ++r) {
    double* of_lane[W];
    for (int k = 0; k < W; ++k) of_lane[k] = one[k].weights[r];
    write_lanes<M>(of_lane, [&](int i) ENTS_LAMBDA_INLINE { return t.weights[r][i]; });
  }
  const auto each = [&](auto of) ENTS_LAMBDA_INLINE {
    for (int a = 0; a < Tangent::T; ++a)
      scatter(
          of(t)[a], [&](int k) ENTS_LAMBDA_INLINE -> auto& { return of(one[k])[a]; });
  };
  (each(pick), ...);
  if (t.curved_law)
    scatter(
        t.g, [&](int k) ENTS_LAMBDA_INLINE -> auto& { return one[k].g; });
  for (int k = 0; k < W; ++k) one[k].curved_law = t.curved_law;
}

// Where column j begins. Lanes whose bit is not set write to out[lane][0 .. N * N - 1], wherever that is.
template <int N, int W>
ENTS_INLINE void column_places(double* const (&out)[W], int j, std::int64_t leading, std::uint32_t used,
                               double* (&column)[W]) {
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
    column_places<N>(out, j, leading, used, column);
    write_lanes<N>(column, [&](int i) ENTS_LAMBDA_INLINE -> const Lanes<W>& { return entry(N * j + i); });
  }
}

// `last` is copied beside.
template <int D, class Tangent, int W>
ENTS_INLINE void write_tangent(const Tangent& t, double* const (&out)[W], std::int64_t leading,
                               std::uint32_t used, DeferredCopy* last) {
  constexpr int M = std::extent_v<decltype(t.weights), 1>, N = D * M,
                weights = std::extent_v<decltype(t.weights)>;
  using S = Lanes<W>;
  constexpr bool few = N < W; // columns: then all at once
  if constexpr (few) interleave_copy(last, W * N * N);
  S kept[Tangent::symmetric ? N * (N + 1) / 2 : N * N];
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
  const auto entry_at = [&](int i) ENTS_LAMBDA_INLINE -> const S& {
    if constexpr (Tangent::symmetric)
      return kept[kept_table<N>.of[i]];
    else
      return kept[i];
  };
  if constexpr (!Tangent::has_rest) {
    write_columns<N>(out, leading, used, entry_at);
  } else {
    for (int j = 0; j < N; ++j) {
      double* column[W];
      column_places<N>(out, j, leading, used, column);
      const auto at_row = [&](int i) ENTS_LAMBDA_INLINE {
        return t.template add_rest<S>(
            entry_at(N * j + i), [i](const auto& array) ENTS_LAMBDA_INLINE { return array[i]; }, j);
      };
      if (t.curved_law)
        write_lanes<N>(column, [&](int i) ENTS_LAMBDA_INLINE { return at_row(i) + t.g[i] * t.g[j]; });
      else
        write_lanes<N>(column, at_row);
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
