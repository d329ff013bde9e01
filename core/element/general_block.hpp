// SPDX-License-Identifier: BSD-3-Clause
// Blocks of elements of any law and tangent under normal projection (those of penalty and power law with the
// consistent tangent have a faster kernel: fast_block.hpp), one element or one per lane. An element that
// needs care is left to evaluate_element().
#pragma once

#include "core/element/block_parts.hpp"
#include "core/element/general_element.hpp"

namespace ents::ENTS_ISA {

template <class Scalar, int D> ENTS_INLINE Vec<double, D> vector_of_lane(const Vec<Scalar, D>& v, int k) {
  Vec<double, D> one;
  for (int c = 0; c < D; ++c) one.set(c, lane(v[c], k));
  return one;
}
// The rays of shadow projections of elements from `first` on; false where there is none: the slave is at the
// emitter, or far from it.
template <int D, class Scalar>
ENTS_INLINE Truth<Scalar> set_rays(const Plan& plan, const ElementBlock& block, std::int64_t first,
                                   Ray<Scalar, D>& ray) {
  for (int c = 0; c < D; ++c) ray.e[c] = Scalar(plan.ray[c]);
  ray.inverse_distance = Scalar(0.0);
  if (plan.projection != ProjectionKind::shadow_point) return ray.inverse_distance <= 0.0;
  for (int c = 0; c < D; ++c)
    ray.e[c] = ray.e[c] - of_each<Scalar>([&](int k) ENTS_LAMBDA_INLINE {
                 return block.slave[(first + k) * block.slave_stride + c];
               });
  const Scalar length = square_root(dot(ray.e, ray.e));
  ray.inverse_distance = unchecked_inverse(length);
  ray.e = ray.inverse_distance * ray.e;
  return both(length > 1.0 / safe_magnitude, length < safe_magnitude);
}

// Are there sums without friction apart? They are shorter; the bits are the same.
#if defined(ENTS_SMALL_CODE)
template <class Scalar> inline constexpr bool without_friction = false;
#else
template <class Scalar> inline constexpr bool without_friction = width_of<Scalar> > 1;
#endif

// The tangents of elements in contact, whose bits are set, and what belongs to them: the turn of a ray,
// multipliers, symmetry.
template <bool Friction, class Basis, bool Enriched, class Scalar>
ENTS_NOINLINE void write_tangents(const Plan& plan, const ElementBlock& block,
                                  const ContactPoint<Basis, Enriched, Scalar>& at, const Scalar* multiplier,
                                  std::uint32_t contact, std::int64_t first) {
  constexpr int D = Basis::dim, N = dof_count<Basis, false>, W = width_of<Scalar>;
  TangentSum<Basis, Enriched, Scalar, Friction> sum;
  const auto weights = weights_of_tangent(plan, at);
  sum.evaluate(plan, at, weights);
  const int n = node_dofs(plan);
  const auto place = [&](int k) { return block.tangent + (first + k) * block.tangent_stride; };
  if (n == D) {
    if constexpr (W == 1)
      write_slave(sum, place(0), block.leading);
    else
      write_slaves(sum, contact, block.leading, place);
  } else if constexpr (W == 1) {
    write_long_tangent<D>(sum, place(0), block.leading);
  } else {
    double nowhere[N * N], *out[W];
    for (int k = 0; k < W; ++k) out[k] = contact >> k & 1 ? place(k) : nowhere;
    write_long_tangent<D>(sum, out, block.leading, contact, static_cast<DeferredCopy*>(nullptr));
  }
  const bool turns = plan.projection == ProjectionKind::shadow_point;
  if (!turns && plan.multipliers == 0 && !plan.law.symmetrised) return;
  const Vec<Scalar, D> covector = turns ? sum.covector_of(at, weights) : Vec<Scalar, D>::zero();
  for (int k = 0; k < W; ++k) {
    if (!(contact >> k & 1)) continue;
    if (turns) {
      double dg[N];
      for (int i = 0; i < N; ++i) dg[i] = lane(sum.dg[i], k);
      add_turning_ray(vector_of_lane(covector, k),
                      Ray<double, D>{vector_of_lane(at.ray->e, k), lane(at.ray->inverse_distance, k)},
                      lane(at.gap, k), dg, n, place(k), block.leading);
    }
    if (plan.multipliers > 0)
      MultiplierEquations<Basis, Enriched, Scalar>{plan, at, multiplier}.write_tangent(k, &sum, n, place(k),
                                                                                       block.leading);
    if (plan.law.symmetrised) symmetrise(plan.dofs, place(k), block.leading);
  }
}

// Law, friction and what is asked for, of projected elements from `first` on; bit k: element first + k needed
// no care and is written.
template <class Basis, bool Enriched, class Scalar>
ENTS_NOINLINE std::uint32_t write_general(const Plan& plan, const ElementBlock& block, std::uint32_t known,
                                          ProjectedPoint<Basis, Enriched, Scalar>& p,
                                          const Ray<Scalar, Basis::dim>* ray, std::int64_t first) {
  constexpr int N = dof_count<Basis, false>, W = width_of<Scalar>;
  const GeneralInputs<Basis, Enriched, Scalar> in(plan, block, first);
  p.evaluate_at_solution();
  ContactPoint<Basis, Enriched, Scalar> at(p);
  at.ray = ray;
  const auto measured = at.measure(plan);
  Truth<Scalar> fine = both(both(p.ordinary, at.safe), p.is_regular(measured, !ray));
  if (plan.multipliers > 0) fine = both(fine, p.area > 0.0);
  at.evaluate_law(plan, in.begin, in.multipliers(), in.worn_or_null(), in.offset, in.scale, in.bond);
  Scalar size = p.area * (absolute(at.law.force) + absolute(at.law.stiffness));
  if (in.has_wear) {
    size = size + p.area * (absolute(at.wear.by_slid) + at.wear.slid) + absolute(in.worn.depth);
    fine = both(fine, at.solved);
  }
  Scalar own = Scalar(0.0);
  for (const Scalar& lambda : in.multiplier) own = own + absolute(lambda);
  fine = both(fine, both(size < safe_magnitude, own < safe_magnitude));
  fine = both(fine, p.ordinary); // friction may have cleared it
  if constexpr (Enriched)
    if ((block.wanted & want::tangent) != 0 && plan.law.has_friction_force() && has_functions(plan))
      fine = both(fine, height_has_thirds(p));
  fine =
      without(fine, both(p.contact, both(at.gap < 0.0, p.is_deep(plan, measured,
                                                                 ray ? at.gap * square_root(measured.area2_e)
                                                                     : measured.across))));
  const std::uint32_t done = known & bits_of(fine), contact = done & bits_of(p.contact);
  if (!done) return 0;
  if constexpr (W == 1)
    if (block.rest && !write_rest(plan, block, p)) return 0;

  const int n = node_dofs(plan);
  if (contact && (block.wanted & (want::residual | want::tangent)))
    p.nodes.basis.template shape<2>(p.xi, p.projector.N);
  if (block.wanted & want::residual) {
    Scalar r[N];
    if (contact) at.residual(plan, r);
    for (int k = 0; k < W; ++k)
      if (contact >> k & 1)
        for (int i = 0; i < n; ++i) block.residual[(first + k) * block.residual_stride + i] = lane(r[i], k);
  }
  if (contact && (block.wanted & want::tangent)) {
    if (!without_friction<Scalar> || sums_friction(plan))
      write_tangents<true>(plan, block, at, in.multiplier, contact, first);
    else if constexpr (without_friction<Scalar>)
      write_tangents<false>(plan, block, at, in.multiplier, contact, first);
  }
  for (int k = 0; k < W; ++k)
    if ((done & ~contact) >> k & 1) write_zeros(block, first + k, plan.dofs);
  if (plan.multipliers > 0) {
    const MultiplierEquations<Basis, Enriched, Scalar> equations{plan, at, in.multiplier};
    for (int k = 0; k < W; ++k) {
      if (!(done >> k & 1)) continue;
      const std::int64_t e = first + k;
      if (block.wanted & want::residual)
        equations.write_residual(k, block.residual + e * block.residual_stride + n);
      if ((block.wanted & want::tangent) && !(contact >> k & 1))
        equations.write_open(k, n, block.tangent + e * block.tangent_stride, block.leading);
    }
  }
  if (block.wanted & beside_forces) {
    const SmallResults<Basis, true, Scalar> small(at);
    for (int k = 0; k < W; ++k)
      if (done >> k & 1) small.write(plan, block, k, first + k);
  }
  return done;
}

template <class Basis, bool Enriched>
ENTS_NOINLINE bool evaluate_general_one(const Plan& plan, const ElementBlock& block, std::int64_t e) {
  const OneInput<Basis, Enriched, false> in(plan, block, e);
  if (!in.known || !has_sound_values(plan, block, e)) return false;
  ProjectedPoint<Basis, Enriched, double> p(in.nodes, in.xi);
  p.area = in.area;
  Ray<double, Basis::dim> ray;
  if (plan.projection == ProjectionKind::normal) {
    p.project();
    return write_general<Basis, Enriched, double>(plan, block, 1, p, nullptr, e) != 0;
  }
  if (!set_rays(plan, block, e, ray)) return false;
  p.project_along(ray.e);
  return write_general<Basis, Enriched, double>(plan, block, 1, p, &ray, e) != 0;
}

// Bit k: element first + k was ordinary and is written.
template <class Basis, bool Enriched>
std::uint64_t evaluate_general(const Plan& plan, const ElementBlock& block, std::int32_t count) {
  std::uint64_t done = 0;
  std::int32_t k = 0;
#if defined(ENTS_HAS_LANES)
  if constexpr (constexpr int W = block_width<Basis>; W > 1)
    for (; k + W <= count; k += W) {
      const std::int64_t e = block.first + k;
      const LaneInputs<Basis, Enriched, false, W> in(plan, block, e);
      std::uint32_t known = in.known;
      for (int i = 0; i < W && (block.state_begin || block.slave_values); ++i)
        if ((block.state_begin &&
             !is_finite(block.state_begin + (e + i) * block.state_begin_stride, plan.state.size)) ||
            !has_sound_values(plan, block, e + i))
          known &= ~(1u << i);
      ProjectedPoint<Basis, Enriched, Lanes<W>> p(in.nodes, in.xi);
      p.area = in.area;
      Ray<Lanes<W>, Basis::dim> ray;
      const bool shadow = plan.projection != ProjectionKind::normal;
      if (shadow) {
        known &= bits_of(set_rays(plan, block, e, ray));
        p.project_along(ray.e);
      } else {
        p.project();
      }
      done |= std::uint64_t{write_general<Basis, Enriched, Lanes<W>>(plan, block, known, p,
                                                                     shadow ? &ray : nullptr, e)}
              << k;
    }
#endif
  for (; k < count; ++k)
    done |= std::uint64_t{evaluate_general_one<Basis, Enriched>(plan, block, block.first + k)} << k;
  return done;
}

// Those of a basis, instantiated; block_table.cpp lists them.
#define ENTS_GENERAL_KERNELS(Basis)                                                                          \
  template std::uint64_t evaluate_general<Basis, false>(const Plan&, const ElementBlock&, std::int32_t);     \
  template std::uint64_t evaluate_general<Basis, true>(const Plan&, const ElementBlock&, std::int32_t);

} // namespace ents::ENTS_ISA
