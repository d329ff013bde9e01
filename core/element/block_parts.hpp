// SPDX-License-Identifier: BSD-3-Clause
// What the blocks of all laws share: what is checked of heights, and what open elements write.
#pragma once

#include <cstring>

#include "core/element/block_kernels.hpp"
#include "core/element/small_results.hpp"
#include "core/projection/projected_point.hpp"

namespace ents::ENTS_ISA {

inline constexpr std::int32_t beside_forces = want::block & ~want::forces;

// Is the height, or a part of it, a function whose derivatives may be anything?
ENTS_INLINE bool has_functions(const Plan& plan) {
  for (std::int32_t i = 0; i < plan.height_nodes; ++i)
    if (plan.height[i].kind == HeightKind::external) return true;
  return false;
}
// Are its third derivatives finite, which tangents with friction have?
template <class Basis, bool Enriched, class Scalar>
ENTS_NOINLINE Truth<Scalar> height_has_thirds(const ProjectedPoint<Basis, Enriched, Scalar>& p) {
  constexpr int T = Basis::dim - 1;
  Scalar size(0.0);
  for (int c = 0; c < T; ++c) {
    Scalar along[T];
    for (int a = 0; a < T; ++a) along[a] = Scalar(a == c ? 1.0 : 0.0);
    HeightJet<T, Dual<Scalar>> jet;
    p.projector.nodes.height_along(p.xi, along, p.projector.s.height, jet);
    for (const Dual<Scalar>& second : jet.h2) size = size + absolute(second.d);
  }
  return size < safe_magnitude;
}

// The `rest` of a block of one element at its projection
template <class Basis, bool Enriched>
ENTS_INLINE bool write_rest(const Plan& plan, const ElementBlock& block,
                            const ProjectedPoint<Basis, Enriched, double>& p) {
  ProjectedElement at{};
  for (int a = 0; a < Basis::dim - 1; ++a) at.xi[a] = p.xi[a];
  const auto& sine = p.projector.sine;
  at.sine[0] = sine.turns, at.sine[1] = sine.h, at.sine[2] = sine.slope;
  at.area = p.area;
  return plan.rest(plan, *block.one, *block.rest, at);
}

// An element that is clearly open
ENTS_INLINE void write_open(const ElementBlock& block, std::int64_t e) {
  if (block.wanted & want::flags) block.flags[e * block.flags_stride] = 0;
}
// An element that is open
ENTS_INLINE void write_zeros(const ElementBlock& block, std::int64_t e, int N) {
  if (block.wanted & forces_only) return;
  if (block.wanted & want::residual)
    for (int i = 0; i < N; ++i) block.residual[e * block.residual_stride + i] = 0.0;
  if (!(block.wanted & want::tangent)) return;
  double* tangent = block.tangent + e * block.tangent_stride;
  const std::int64_t columns = block.leading == N ? 1 : N,
                     length = block.leading == N ? std::int64_t{N} * N : N;
  for (std::int64_t j = 0; j < columns; ++j)
    std::memset(tangent + j * block.leading, 0, sizeof(double) * static_cast<std::size_t>(length));
}

} // namespace ents::ENTS_ISA
