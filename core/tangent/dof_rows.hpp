// SPDX-License-Identifier: BSD-3-Clause
// Numbers of an element's dofs, made and read a register at a time where one element has registers of its
// own. The operations for a dof are those of expand(), so the bits are the same.
//
// DofRow copies, so that a register is read as it was written: this avoids a store-forwarding stall.
#pragma once

#include <cstring>
#include <type_traits>
#include <utility>

#include "core/numbers/lanes.hpp"
#include "core/tangent/forms.hpp"

namespace ents::ENTS_ISA {

// Elements that the block kernels of a basis take at once. Sanitizers check those of few dofs, which have all
// of the code.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
template <class Basis>
inline constexpr int block_width = Basis::dim*(Basis::nodes + 1) <= 15 ? register_width : 1;
#else
template <class Basis> inline constexpr int block_width = register_width;
#endif

// The widest register that is not longer than n.
constexpr int width_for(int n) {
  int width = register_width;
  while (width > n) width /= 2;
  return width;
}
// Pieces that cover n numbers: of `width`, the last one of half of it where that is enough and four; if it
// would reach beyond the end it overlaps the one before.
constexpr int pieces(int n, int width) { return (n + width - 1) / width; }
constexpr int piece_width(int n, int width, int piece) {
  const int left = n - piece * width;
  return width >= 8 && 2 * left <= width ? width / 2 : width;
}
constexpr int piece_at(int n, int width, int piece) {
  const int at = piece * width, last = n - piece_width(n, width, piece);
  return at < last ? at : last;
}

template <int W> struct Register { using type = Lanes<W>; };
template <> struct Register<1> { using type = double; };

template <class R> inline constexpr bool has_numbers = width_of<R> != 1;
// (By way of the compiler's own vector: into an object of a class it copies 16 bytes at a time, and who reads that
// waits for the stores.)
template <class R> ENTS_INLINE R load(const void* from) {
  if constexpr (has_numbers<R>) {
    typename R::Numbers numbers;
    std::memcpy(&numbers, from, sizeof numbers);
    return R(numbers, 0);
  } else {
    R r;
    std::memcpy(&r, from, sizeof r);
    return r;
  }
}
template <class R> ENTS_INLINE void store(double* to, const R& r) {
  if constexpr (has_numbers<R>) {
    const typename R::Numbers numbers = r.v;
    std::memcpy(to, &numbers, sizeof numbers);
  } else {
    std::memcpy(to, &r, sizeof r);
  }
}

template <int N, int Piece> using PieceOf = typename Register<piece_width(N, width_for(N), Piece)>::type;
template <int N> struct Pieces {
  static constexpr int count = pieces(N, width_for(N)),
                       whole = count - (piece_width(N, width_for(N), count - 1) < width_for(N));
  PieceOf<N, 0> of[whole];
  PieceOf<N, count - 1> half; // where the last piece is one
  template <int Piece> ENTS_INLINE auto& at() {
    if constexpr (Piece < whole)
      return of[Piece];
    else
      return half;
  }
  template <int Piece> ENTS_INLINE const auto& at() const {
    return const_cast<Pieces*>(this)->template at<Piece>();
  }
};

// Numbers of N dofs of one element: as columns, and as pieces of rows.
template <int N> struct DofRow {
  double column[N];
  Pieces<N> row;
  ENTS_INLINE const double& operator[](int dof) const { return column[dof]; }
};

// Are numbers of dofs kept in rows? Where their number is known at compile time, and one element has
// registers of its own.
template <class Basis, bool Rigid, class Scalar>
inline constexpr bool has_rows =
    std::is_same_v<Scalar, double>&& register_width >= 4 && !counts_dofs<Basis, Rigid>;

// Numbers of the dofs of an element (double), or of one per lane
template <class Basis, bool Rigid, class Scalar> struct DofNumbers {
  using type = Scalar[dof_count<Basis, Rigid>];
};
template <class Basis, bool Rigid, class Scalar>
requires(has_rows<Basis, Rigid, Scalar>) struct DofNumbers<Basis, Rigid, Scalar> {
  using type = DofRow<dof_count<Basis, Rigid>>;
};
template <class Basis, bool Rigid, class Scalar>
using DofArray = typename DofNumbers<Basis, Rigid, Scalar>::type;

template <int Piece, int N, class R> ENTS_INLINE void set_piece(double (&out)[N], const R& r) {
  store(out + piece_at(N, width_for(N), Piece), r);
}
template <int Piece, int N, class R> ENTS_INLINE void set_piece(DofRow<N>& out, const R& r) {
  out.row.template at<Piece>() = r;
  set_piece<Piece>(out.column, r);
}
template <int Piece, int N> ENTS_INLINE auto piece_of(const double (&numbers)[N]) {
  return load<PieceOf<N, Piece>>(numbers + piece_at(N, width_for(N), Piece));
}
template <int Piece, int N> ENTS_INLINE auto piece_of(const DofRow<N>& numbers) {
  return numbers.row.template at<Piece>();
}

// out = f(in ...) of each of `count` dofs
template <class Scalar, int N, class F, class... In>
ENTS_INLINE void for_each_dof(int count, Scalar (&out)[N], F&& f, const In&... in) {
  for (int i = 0; i < count; ++i) out[i] = f(in[i]...);
}
template <int N, class F, class... In>
ENTS_INLINE void for_each_dof(int, DofRow<N>& out, F&& f, const In&... in) {
  unroll<Pieces<N>::count>([&](auto piece) ENTS_LAMBDA_INLINE {
    set_piece<piece.value>(out, PieceOf<N, piece.value>(f(piece_of<piece.value>(in)...)));
  });
}

#if defined(ENTS_HAS_LANES) && defined(__AVX__)
#define ENTS_HAS_DOF_ROWS 1
// W dofs from dof `At` on: dof At + k is component (At + k) % D of the slave (node -1) or of a node of the
// master.
template <int D, int W, int At> struct DofPiece {
  using R = Lanes<W>;
  static constexpr int component(int k) { return (At + k) % D; }
  static constexpr int node(int k) { return (At + k) / D - 1; }
  static constexpr bool has_slave = At < D;

  static ENTS_INLINE R components(const Vec<double, D>& x) {
    return components_of(x, std::make_integer_sequence<int, W>());
  }
  // n[node + Slave]: of the master's nodes alone (then that of the slave is of no meaning), or of the slave,
  // too
  template <int Slave, int M> static ENTS_INLINE R weights(const double (&n)[M]) {
    return weights_of<Slave>(n, std::make_integer_sequence<int, W>());
  }
  static ENTS_INLINE R where_slave(const R& slave, const R& other) {
    LaneTruth<W> here{};
    for (int k = 0; k < W; ++k) {
      if constexpr (has_masks<W>)
        here.v = static_cast<decltype(here.v)>(here.v | (node(k) < 0) << k);
      else
        here.v[k] = node(k) < 0 ? -1 : 0;
    }
    return select(here, slave, other);
  }

private:
  template <int... k>
  static ENTS_INLINE R components_of(const Vec<double, D>& x, std::integer_sequence<int, k...>) {
    if constexpr (D == 3)
      return R(__builtin_shufflevector(x.v, x.v, component(k)...), 0);
    else
      return R(typename R::Numbers{x[component(k)]...}, 0);
  }
  // Of M weights, the first of four in which are all that are needed
  static constexpr int first_of(int M, int slave) {
    return M < 4 || node(0) + slave < 0 ? 0 : node(0) + slave + 4 > M ? M - 4 : node(0) + slave;
  }
  static constexpr int within(int k, int M, int slave) {
    return node(k) + slave < 0 ? 0 : node(k) + slave - first_of(M, slave);
  }
  template <int Slave, int M, int... k>
  static ENTS_INLINE R weights_of(const double (&n)[M], std::integer_sequence<int, k...>) {
    static_assert(within(W - 1, M, Slave) < 4);
    if constexpr (M < 4) {
      return R(typename R::Numbers{n[within(k, M, Slave)]...}, 0);
    } else {
      typename VectorOf<4>::Numbers four;
      if constexpr (M == 4)
        four = typename VectorOf<4>::Numbers{n[0], n[1], n[2], n[3]};
      else
        std::memcpy(&four, n + first_of(M, Slave), sizeof four);
      return R(__builtin_shufflevector(four, four, within(k, M, Slave)...), 0);
    }
  }
};
template <class Basis, bool Rigid, int Piece, int N = dof_count<Basis, Rigid>>
using PieceOfDofs =
    DofPiece<Basis::dim, piece_width(N, width_for(N), Piece), piece_at(N, width_for(N), Piece)>;
#endif

// expand() to numbers of dofs; that of the slave may be left out
template <bool Rigid, int Parts, bool Slave = true, class Basis, class Scalar, class Out>
ENTS_INLINE void expand_to_dofs(const Basis& basis, const Form<Basis, Scalar>& f,
                                const Shape<Scalar, Basis::dim - 1, Basis::nodes>& N, Out& out) {
  constexpr int D = Basis::dim;
  if constexpr (!has_rows<Basis, Rigid, Scalar>) {
    expand<Rigid, Parts>(basis, f, N, out);
    if constexpr (!Slave)
      for (int c = 0; c < D; ++c) out[c] = Scalar(0.0);
  } else {
#if defined(ENTS_HAS_DOF_ROWS)
    constexpr int T = D - 1, count = dof_count<Basis, Rigid>;
    unroll<pieces(count, width_for(count))>([&](auto piece) ENTS_LAMBDA_INLINE {
      using Piece = PieceOfDofs<Basis, Rigid, piece.value>;
      using R = typename Piece::R;
      R slave(0.0), v(0.0);
      if constexpr ((Parts & on_position) != 0) {
        const R x = Piece::components(f.x);
        if constexpr (Slave) slave = x;
        if constexpr (!Rigid) v = -(Piece::template weights<0>(N.n) * x);
      }
      if constexpr (!Rigid) {
        if constexpr ((Parts & on_tangents) != 0)
          for (int k = 0; k < T; ++k) v = v + Piece::template weights<0>(N.d1[k]) * Piece::components(f.a[k]);
        if constexpr ((Parts & on_curvatures) != 0)
          unroll<symmetric_size<T>>([&](auto k) ENTS_LAMBDA_INLINE {
            if constexpr (Basis::second[k])
              v = v + Piece::template weights<0>(N.d2[k]) * Piece::components(f.a2[k]);
          });
      }
      if constexpr (Piece::has_slave) v = Piece::where_slave(slave, v);
      set_piece<piece.value>(out, v);
    });
#endif
  }
}

// out = weight of the node times v; 0 at the slave
template <class Basis, class Scalar, class Out>
ENTS_INLINE void expand_to_nodes(const Basis& basis, const Scalar (&weights)[Basis::nodes],
                                 const Vec<Scalar, Basis::dim>& v, Out& out) {
  constexpr int D = Basis::dim;
  if constexpr (!has_rows<Basis, false, Scalar>) {
    const int nodes = node_count(basis);
    for (int c = 0; c < D; ++c) out[c] = Scalar(0.0);
    for (int i = 0; i < nodes; ++i)
      for (int c = 0; c < D; ++c) out[D * (i + 1) + c] = weights[i] * v[c];
  } else {
#if defined(ENTS_HAS_DOF_ROWS)
    constexpr int count = dof_count<Basis, false>;
    unroll<pieces(count, width_for(count))>([&](auto piece) ENTS_LAMBDA_INLINE {
      using Piece = PieceOfDofs<Basis, false, piece.value>;
      typename Piece::R r = Piece::template weights<0>(weights) * Piece::components(v);
      if constexpr (Piece::has_slave) r = Piece::where_slave(0.0, r);
      set_piece<piece.value>(out, r);
    });
#endif
  }
}

} // namespace ents::ENTS_ISA
