// SPDX-License-Identifier: BSD-3-Clause
// Ordinary elements of a call: a block of up to 64, each written or left to evaluate_element().
#pragma once

#include "core/element/block_parts.hpp"
#include "core/law/friction.hpp"
#include "core/law/power.hpp"
#include "core/tangent/friction_residual.hpp"
#include "core/tangent/reduced_friction_tangent.hpp"

namespace ents::ENTS_ISA {

template <bool Frictional, bool Rigid, class Basis, bool Enriched, class Scalar>
using TangentOf = std::conditional_t<Frictional, FrictionTangentOf<Basis, Enriched, Rigid, Scalar>,
                                     FrictionlessTangent<Basis, Enriched, Rigid, Scalar>>;

// Gap, force and friction at the projection.
template <bool Frictional, class Basis, bool Enriched, class Scalar>
ENTS_INLINE void evaluate_law(const Plan& plan, std::int32_t wanted,
                              ProjectedPoint<Basis, Enriched, Scalar>& p, Friction<Scalar, Basis::dim - 1>& f,
                              const SlipBegin<Scalar, Basis::dim - 1>* begin) {
  p.evaluate_at_solution();
  p.template evaluate_law<Power>(plan,
                                 Frictional || plan.law.twice_exponent > 2 || (wanted & beside_forces) != 0);
  if constexpr (Frictional) {
    f.evaluate(plan.law, p.place(), *begin, slip_share(begin->clearance, -p.gap),
               -(p.area * p.per_gap * p.gap));
    p.ordinary = both(p.ordinary, f.ordinary);
  }
  if constexpr (Frictional && Enriched)
    if ((wanted & want::tangent) != 0 && has_functions(plan))
      p.ordinary = both(p.ordinary, height_has_thirds(p));
}
// Shape functions come as late as here, with as many derivatives as are asked for.
template <bool Frictional, bool Rigid, class Basis, bool Enriched, class Scalar>
ENTS_INLINE void residual(ProjectedPoint<Basis, Enriched, Scalar>& p,
                          const Friction<Scalar, Basis::dim - 1>& f, Scalar (&out)[dof_count<Basis, Rigid>]) {
  if constexpr (!Rigid)
    p.nodes.basis.template shape<(Enriched ? 1 : 0) + (Frictional ? 1 : 0)>(p.xi, p.projector.N);
  if constexpr (Frictional)
    friction_residual<Rigid>(p, f, (p.area * p.per_gap) * p.gap_vector, out);
  else
    frictionless_residual<Rigid>(p, out);
}
template <bool Frictional, bool Rigid, class Basis, bool Enriched, class Scalar>
ENTS_INLINE void tangent(const Plan& plan, ProjectedPoint<Basis, Enriched, Scalar>& p,
                         const Friction<Scalar, Basis::dim - 1>& f,
                         TangentOf<Frictional, Rigid, Basis, Enriched, Scalar>& out) {
  if constexpr (!Rigid) p.nodes.basis.template shape<Enriched || Frictional ? 2 : 1>(p.xi, p.projector.N);
  if constexpr (Frictional)
    out.evaluate(plan, p, f);
  else
    out.evaluate(plan, p);
}

// Residual and tangent of an element in contact.
template <bool Frictional, bool Rigid, class Basis, bool Enriched>
ENTS_INLINE void write_forces(const Plan& plan, const ElementBlock& block,
                              ProjectedPoint<Basis, Enriched, double>& p,
                              const Friction<double, Basis::dim - 1>& f, std::int64_t e) {
  constexpr int N = dof_count<Basis, Rigid>;
  if (block.wanted & want::residual) {
    double of_dofs[N];
    residual<Frictional, Rigid>(p, f, of_dofs);
    double* r = block.residual + e * block.residual_stride;
    for (int i = 0; i < dofs_of<Rigid>(p.nodes.basis); ++i) r[i] = of_dofs[i];
  }
  if (block.wanted & want::tangent) {
    TangentOf<Frictional, Rigid, Basis, Enriched, double> t;
    tangent<Frictional, Rigid>(plan, p, f, t);
    double* k = block.tangent + e * block.tangent_stride;
    if constexpr (N <= 15)
      write_tangent<Basis::dim>(t, k, block.leading);
    else
      write_long_tangent<Basis::dim>(t, k, block.leading);
  }
}

// Of segments of many dofs out of line, where a call costs nothing beside it: compilers take long over long
// functions.
template <bool Frictional, bool Rigid, class... Arguments>
ENTS_NOINLINE void write_forces_apart(Arguments&... arguments) {
  write_forces<Frictional, Rigid>(arguments...);
}
template <bool Frictional, class Basis, class... Arguments>
ENTS_INLINE void write_forces_of(bool rigid, Arguments&... arguments) {
  if constexpr ((dof_count<Basis, false>) > 30) {
    if (rigid)
      write_forces_apart<Frictional, true>(arguments...);
    else
      write_forces_apart<Frictional, false>(arguments...);
  } else {
    if (rigid)
      write_forces<Frictional, true>(arguments...);
    else
      write_forces<Frictional, false>(arguments...);
  }
}

template <class Basis, bool Enriched, bool Frictional>
ENTS_INLINE bool evaluate_one(const Plan& plan, const ElementBlock& block, std::int64_t e) {
  const OneInput<Basis, Enriched, Frictional> in(plan, block, e);
  if (!in.known) return false;
  ProjectedPoint<Basis, Enriched, double> p(in.nodes, in.xi);
  Friction<double, Basis::dim - 1> f;
  p.area = in.area;
  if (block.wanted & forces_only && p.has_area() && p.is_clearly_open(plan)) {
    write_open(block, e);
    return true;
  }
  p.project();
  evaluate_law<Frictional>(plan, block.wanted, p, f, &in.begin);
  if (!p.ordinary || (block.rest && !write_rest(plan, block, p))) return false;
  if (!p.contact)
    write_zeros(block, e, plan.dofs);
  else
    write_forces_of<Frictional, Basis>(plan.dofs == Basis::dim, plan, block, p, f, e);
  if (block.wanted & beside_forces) SmallResults<Basis, Frictional, double>(p, f).write(plan, block, 0, e);
  return true;
}

#if defined(ENTS_HAS_LANES)
// Both projections at once.
template <class Basis, bool Enriched, int W>
ENTS_INLINE void project_both(ProjectedPoint<Basis, Enriched, Lanes<W>>& a,
                              ProjectedPoint<Basis, Enriched, Lanes<W>>& b) {
  constexpr int D = Basis::dim, T = D - 1;
  using Scalar = Twice<Lanes<W>>;
  ElementNodes<Basis, Scalar> nodes(a.nodes.basis);
  const int count = node_count(nodes.basis);
  for (int i = 0; i < count; ++i)
    for (int c = 0; c < D; ++c) nodes.y[i][c] = {a.nodes.y[i][c], b.nodes.y[i][c]};
  nodes.has_coordinates = a.nodes.has_coordinates;
  if (nodes.has_coordinates)
    for (int i = 0; i < T * count; ++i)
      nodes.coordinates[i] = {a.nodes.coordinates[i], b.nodes.coordinates[i]};
  nodes.height = a.nodes.height;
  Scalar xi[T];
  for (int i = 0; i < T; ++i) xi[i] = {a.xi[i], b.xi[i]};
  ProjectedPoint<Basis, Enriched, Scalar> p(nodes, xi);
  p.project();
  for (int i = 0; i < T; ++i) a.xi[i] = p.xi[i].low, b.xi[i] = p.xi[i].high;
  a.evaluations = p.evaluations.low, b.evaluations = p.evaluations.high;
  a.ordinary = p.ordinary.low, b.ordinary = p.ordinary.high;
  const auto& sine = p.projector.sine;
  a.projector.sine = {sine.turns.low, sine.h.low, sine.slope.low};
  b.projector.sine = {sine.turns.high, sine.h.high, sine.slope.high};
}

// Residuals and tangents of the elements e + k whose bit is set in `contact`.
template <bool Frictional, bool Rigid, class Basis, bool Enriched, int W>
ENTS_INLINE void
write_forces(const Plan& plan, const ElementBlock& block, ProjectedPoint<Basis, Enriched, Lanes<W>>& p,
             const Friction<Lanes<W>, Basis::dim - 1>& f, std::int64_t e, std::uint32_t contact) {
  constexpr int N = dof_count<Basis, Rigid>;
  using Scalar = Lanes<W>;
  double nowhere[N * N];
  const auto places = [&](double* first, std::int64_t stride, double*(&out)[W]) {
    for (int k = 0; k < W; ++k) out[k] = contact >> k & 1 ? first + (e + k) * stride : nowhere;
  };
  if (block.wanted & want::residual) {
    Scalar r[N];
    residual<Frictional, Rigid>(p, f, r);
    double* out[W];
    places(block.residual, block.residual_stride, out);
    write_lanes<N>(
        out, [&](int i) ENTS_LAMBDA_INLINE { return r[i]; }, dofs_of<Rigid>(p.nodes.basis));
  }
  if (block.wanted & want::tangent) {
    TangentOf<Frictional, Rigid, Basis, Enriched, Scalar> t;
    tangent<Frictional, Rigid>(plan, p, f, t);
    double* out[W];
    places(block.tangent, block.tangent_stride, out);
    using Tangent = TangentOf<Frictional, Rigid, Basis, Enriched, Scalar>;
    if constexpr (Tangent::one_by_one && N >= W) {
      TangentOf<Frictional, Rigid, Basis, Enriched, double> one[W];
      t.scatter_lanes(one);
      for (int k = 0; k < W; ++k) {
        interleave_copy(block.last, std::int64_t{plan.dofs} * plan.dofs);
        if (contact >> k & 1) write_tangent<Basis::dim>(one[k], out[k], block.leading);
      }
    } else if constexpr (N <= 12)
      write_tangent<Basis::dim>(t, out, block.leading, contact, block.last);
    else
      write_long_tangent<Basis::dim>(t, out, block.leading, contact, block.last);
  }
}

// W projected elements from e on, those with a bit in `far` clearly open; bit k: element e + k was ordinary
// and is written.
template <class Basis, bool Enriched, bool Frictional, int W>
ENTS_INLINE std::uint32_t write_lanes_from(const Plan& plan, const ElementBlock& block,
                                           const LaneInputs<Basis, Enriched, Frictional, W>& in,
                                           ProjectedPoint<Basis, Enriched, Lanes<W>>& p, std::uint32_t far,
                                           std::int64_t e) {
  constexpr int D = Basis::dim;
  using Scalar = Lanes<W>;
  Friction<Scalar, Basis::dim - 1> f;
  evaluate_law<Frictional>(plan, block.wanted, p, f, &in.begin);
  const std::uint32_t done = in.known & (bits_of(p.ordinary) | far);
  if (!done) return 0;
  const std::uint32_t contact = done & bits_of(p.contact) & ~far;
  if (contact) write_forces_of<Frictional, Basis>(plan.dofs == D, plan, block, p, f, e, contact);
  for (int k = 0; k < W; ++k)
    if ((done & ~contact) >> k & 1) write_zeros(block, e + k, plan.dofs);
  if (block.wanted & beside_forces) {
    const SmallResults<Basis, Frictional, Scalar> small(p, f);
    for (int k = 0; k < W; ++k) {
      if (far >> k & 1)
        write_open(block, e + k);
      else if (done >> k & 1)
        small.write(plan, block, k, e + k);
    }
  }
  return done;
}
#endif

// Bit k: element first + k was ordinary and is written.
template <class Basis, bool Enriched, bool Frictional>
std::uint64_t evaluate_fast(const Plan& plan, const ElementBlock& block, std::int32_t count) {
  std::uint64_t done = 0;
  std::int32_t k = 0;
#if defined(ENTS_HAS_LANES)
  if constexpr (1 < block_width<Basis>)
    for (constexpr int W = block_width<Basis>; k + W <= count;) {
      constexpr std::uint32_t all = (1u << W) - 1;
      const auto far_of = [&](const LaneInputs<Basis, Enriched, Frictional, W>& lanes,
                              const ProjectedPoint<Basis, Enriched, Lanes<W>>& point) ENTS_LAMBDA_INLINE {
        return block.wanted & forces_only
                   ? lanes.known & bits_of(both(point.has_area(), point.is_clearly_open(plan)))
                   : 0u;
      };
      // a line's few numbers leave registers free for two projections at once
      constexpr bool in_pairs = std::is_same_v<Basis, Line2> && Enriched;
      const bool two = in_pairs && k + 2 * W <= count;
      const std::int64_t e = block.first + k;
      const LaneInputs<Basis, Enriched, Frictional, W> a(plan, block, e);
      ProjectedPoint<Basis, Enriched, Lanes<W>> p(a.nodes, a.xi);
      p.area = a.area;
      const std::uint32_t far = far_of(a, p);
      if (far == all) {
        for (int i = 0; i < W; ++i) write_open(block, e + i);
        done |= std::uint64_t{all} << k;
        k += W;
        continue;
      }
      if (two) {
        const LaneInputs<Basis, Enriched, Frictional, W> b(plan, block, e + W);
        ProjectedPoint<Basis, Enriched, Lanes<W>> q(b.nodes, b.xi);
        q.area = b.area;
        if constexpr (in_pairs) project_both(p, q);
        done |= std::uint64_t{write_lanes_from<Basis, Enriched, Frictional, W>(plan, block, b, q,
                                                                               far_of(b, q), e + W)}
                << (k + W);
      } else {
        p.project();
      }
      done |= std::uint64_t{write_lanes_from<Basis, Enriched, Frictional, W>(plan, block, a, p, far, e)} << k;
      k += two ? 2 * W : W;
    }
#endif
  for (; k < count; ++k)
    done |= std::uint64_t{evaluate_one<Basis, Enriched, Frictional>(plan, block, block.first + k)} << k;
  return done;
}

// Those of a basis, instantiated; block_table.cpp lists them.
#define ENTS_FAST_KERNELS(Basis)                                                                             \
  template std::uint64_t evaluate_fast<Basis, false, false>(const Plan&, const ElementBlock&, std::int32_t); \
  template std::uint64_t evaluate_fast<Basis, false, true>(const Plan&, const ElementBlock&, std::int32_t);  \
  template std::uint64_t evaluate_fast<Basis, true, false>(const Plan&, const ElementBlock&, std::int32_t);  \
  template std::uint64_t evaluate_fast<Basis, true, true>(const Plan&, const ElementBlock&, std::int32_t);

} // namespace ents::ENTS_ISA
