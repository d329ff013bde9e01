// SPDX-License-Identifier: BSD-3-Clause
// Numbers of one element per lane from the elements' arrays, and to them.
#pragma once

#include "core/tangent/dof_rows.hpp"

namespace ents::ENTS_ISA {

#if defined(ENTS_HAS_LANES)

// Entries 0 .. count - 1 of all lanes, entry(i) each (a reference: it lies in memory), to to[lane][0 .. count
// - 1]; room for Most. If Most is less than W, this many are written, else there are W and more.
template <int Most, int W, class Entry>
ENTS_INLINE void write_lanes(double* const (&to)[W], Entry&& entry, int count = Most) {
  typename VectorOf<W>::Numbers r[W];
  if constexpr (Most < W) {
    for (int i = 0; i < W; ++i) r[i] = entry(i < count ? i : count - 1).v;
    transpose<W, W / 2>(r);
    for (int k = 0; k < W; ++k) std::memcpy(to[k], &r[k], sizeof(double) * Most);
  } else {
    for (int at = 0; at < count; at += W) {
      const int first = at + W <= count ? at : count - W;
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
template <int Count, int W> ENTS_INLINE void read_numbers(const double* const (&from)[W], Lanes<W>* out) {
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
template <int W, int Count>
ENTS_INLINE void read_lanes(const double* const (&from)[W], Lanes<W> (&out)[Count]) {
  read_numbers<Count>(from, out);
}
// `each` numbers of each node
template <int each, class Basis, int W>
ENTS_INLINE void read_nodes(const Basis& basis, const double* const (&from)[W], Lanes<W>* out) {
  if constexpr (!is_counted<Basis>) {
    read_numbers<each * Basis::nodes>(from, out);
  } else if constexpr (Basis::dim == 2) { // few, in which no register need find room
    with_basis<2>(basis.which, [&](auto type) ENTS_LAMBDA_INLINE {
      read_numbers<each* decltype(type)::nodes>(from, out);
    });
  } else {
    const int count = each * basis.count;
    for (int at = 0; at < count; at += W) {
      const double* piece[W];
      const int first = at + W <= count ? at : count - W;
      for (int k = 0; k < W; ++k) piece[k] = from[k] + first;
      read_numbers<W>(piece, out + first);
    }
  }
}
// A number of each of W elements, `stride` apart
template <int W> ENTS_INLINE Lanes<W> read_lanes(const double* from, std::int64_t stride) {
  if (stride == 1) return load<Lanes<W>>(from);
  if (stride == 0) return Lanes<W>(*from);
  return each_lane<W>([&](int k) ENTS_LAMBDA_INLINE { return from[k * stride]; });
}

// Each lane's numbers of `count` dofs to an element of its own: to(lane)
template <int W, int N, class To>
ENTS_INLINE void scatter_counted(int count, const Lanes<W> (&numbers)[N], To&& to) {
  double* of_lane[W];
  for (int k = 0; k < W; ++k) of_lane[k] = to(k);
  write_lanes<N>(
      of_lane, [&](int i) ENTS_LAMBDA_INLINE -> const Lanes<W>& { return numbers[i]; }, count);
}
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

#endif

} // namespace ents::ENTS_ISA
