// SPDX-License-Identifier: BSD-3-Clause
// The bases of the kernels. Those that nearly all elements have are types of their own. All others are one
// type per dimension, whose nodes are counted when the program runs: shape functions are chosen by a switch,
// loops over nodes have as many turns as there are, and the bits are those of a type of their own.
//
// A kernel has an object of its basis B: an empty one where B is known at compile time. B::nodes is the
// largest number of nodes, B::second and B::third say which derivatives a basis may have.
#pragma once

#include <iterator>
#include <type_traits>

#include "core/surface/bases.hpp"
#include "core/surface/basis.hpp"

namespace ents::ENTS_ISA {

template <class B>
inline constexpr bool compiled_alone =
    std::is_same_v<B, Line2> || std::is_same_v<B, Tri3> || std::is_same_v<B, Quad4>;

template <class B> constexpr bool any_third() {
  for (const bool third : B::third)
    if (third) return true;
  return false;
}

// What is asked of a basis that is counted: all second derivatives, and of the third ones none, or one of
// each two that are derivatives of the same second one.
template <class B> constexpr bool can_be_counted() {
  for (const bool second : B::second)
    if (!second) return false;
  for (int k = 0; B::dim == 3 && any_third<B>() && k < 3; ++k)
    if (!B::third[k] && !B::third[k + 1]) return false;
  return true;
}

// f(basis), of a basis that is counted: an object of the type that it has in basis.hpp
template <int D, class F> ENTS_INLINE void with_basis(Basis which, F&& f) {
#define ENTS_BASIS(name, type, ...)                                                                          \
  case Basis::name:                                                                                          \
    if constexpr (type::dim == D && !compiled_alone<type>) return f(type{});                                 \
    break;
  switch (which) { ENTS_BASES(ENTS_BASIS) }
#undef ENTS_BASIS
  ENTS_UNREACHABLE;
}

template <int D> struct AllDerivatives;
template <> struct AllDerivatives<2> { static constexpr bool second[1] = {true}, third[1] = {true}; };
template <> struct AllDerivatives<3> {
  static constexpr bool second[3] = {true, true, true}, third[4] = {true, true, true, true};
};

template <int D> struct CountedBasis : AllDerivatives<D> {
  static constexpr int dim = D, nodes = D == 2 ? 4 : 16;
  Basis which;
  std::int32_t count, degree;
  bool simplex, thirds[D == 2 ? 1 : 4], any_third;

  template <int Order, class S, class Out> ENTS_NOINLINE void shape(const S (&xi)[D - 1], Out& s) const {
    with_basis<D>(which,
                  [&](auto basis) ENTS_LAMBDA_INLINE { decltype(basis)::template shape<Order>(xi, s); });
  }
};
template <class B> inline constexpr bool is_counted = false;
template <int D> inline constexpr bool is_counted<CountedBasis<D>> = true;

template <int D> struct CountedBases {
  CountedBasis<D> of[std::size(basis_table)];
  constexpr CountedBases() : of() {
#define ENTS_BASIS(name, type, ...) set<type>(Basis::name);
    ENTS_BASES(ENTS_BASIS)
#undef ENTS_BASIS
  }

private:
  template <class B> constexpr void set(Basis which) {
    if constexpr (B::dim == D && !compiled_alone<B>) {
      static_assert(B::nodes <= CountedBasis<D>::nodes && can_be_counted<B>());
      CountedBasis<D>& b = of[static_cast<std::int32_t>(which)];
      b.which = which, b.count = B::nodes, b.degree = B::degree, b.simplex = B::simplex;
      b.any_third = ents::ENTS_ISA::any_third<B>();
      for (int k = 0; k < (D == 2 ? 1 : 4); ++k) b.thirds[k] = B::third[k];
    }
  }
};
template <int D> inline constexpr CountedBases<D> counted_bases{};

// The type by which the kernels know a basis, and an object of it
template <class B> using KernelBasis = std::conditional_t<compiled_alone<B>, B, CountedBasis<B::dim>>;
template <class B> ENTS_INLINE B basis_of([[maybe_unused]] Basis which) {
  if constexpr (is_counted<B>)
    return counted_bases<B::dim>.of[static_cast<std::int32_t>(which)];
  else
    return B{};
}

template <class B> ENTS_INLINE constexpr int node_count([[maybe_unused]] const B& basis) {
  if constexpr (is_counted<B>)
    return basis.count;
  else
    return B::nodes;
}
// Is the domain xi >= 0, sum xi <= 1, instead of -1 .. 1 per direction?
template <class B> ENTS_INLINE constexpr bool is_simplex([[maybe_unused]] const B& basis) {
  return basis.simplex;
}
// Has the basis this third derivative, or any? What B::third says where it is known at compile time
template <class B> ENTS_INLINE constexpr bool has_third([[maybe_unused]] const B& basis, int k) {
  if constexpr (is_counted<B>)
    return basis.thirds[k];
  else
    return B::third[k];
}
template <class B> ENTS_INLINE constexpr bool has_thirds([[maybe_unused]] const B& basis) {
  if constexpr (is_counted<B>)
    return basis.any_third;
  else
    return any_third<B>();
}

template <class B> ENTS_INLINE void domain_centre(const B& basis, double (&xi)[B::dim - 1]) {
  for (double& x : xi) x = is_simplex(basis) ? 1.0 / 3.0 : 0.0;
}

} // namespace ents::ENTS_ISA
