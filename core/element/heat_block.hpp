// SPDX-License-Identifier: BSD-3-Clause
// What the heat of elements depends on, of many that a block kernel has projected: HeatBlockKernel. One element or one
// per lane; an element that needs care is left to evaluate_heat_ingredients().
#pragma once

#include "core/element/general_block.hpp"
#include "core/element/heat_ingredients.hpp"

namespace ents::ENTS_ISA {

// Of elements from `first` on, at places that are known; bit k: element first + k needed no care and is written.
template <class Basis, bool Enriched, class Scalar>
ENTS_NOINLINE std::uint32_t
write_heat_ingredients(const Plan& plan, const ElementBlock& block, std::uint32_t known,
                       ProjectedPoint<Basis, Enriched, Scalar>& p, const Ray<Scalar, Basis::dim>* ray,
                       std::int64_t first, HeatIngredients* out) {
  const GeneralInputs<Basis, Enriched, Scalar> in(plan, block, first);
  const Scalar area = p.area;
  p.evaluations = Scalar(0.0);
  p.ordinary = p.evaluations >= 0.0;
  p.evaluate_at_solution();
  ContactPoint<Basis, Enriched, Scalar> at(p);
  at.ray = ray;
  Truth<Scalar> fine = p.is_regular(at.measure(plan), !ray);
  const auto& f = p.projector;
  const Scalar metric = determinant(f.metric);
  if (!ray) fine = both(fine, both(metric > 0.0, absolute(determinant(f.f2)) > 1e-10 * metric));
  p.nodes.basis.template shape<2>(p.xi, p.projector.N);
  at.evaluate_law(plan, in.begin, in.multipliers(), in.worn_or_null(), in.offset, in.scale, in.bond);
  known &= bits_of(fine);
  if (!known) return 0;
  HeatIngredientsOf<Basis, Enriched, Scalar> heat(plan, at, in);
  heat.evaluate();
  for (int k = 0; k < width_of<Scalar>; ++k)
    if (known >> k & 1) {
      HeatIngredients& of = out[first - block.first + k];
      heat.write(k, of);
      of.area = lane(area, k);
    }
  return known;
}

template <class Basis, bool Enriched>
ENTS_NOINLINE std::uint32_t heat_of_one(const Plan& plan, const ElementBlock& block, std::int64_t e,
                                        HeatIngredients* out) {
  const OneInput<Basis, Enriched, false> in(plan, block, e);
  if (!in.known) return 0;
  ProjectedPoint<Basis, Enriched, double> p(in.nodes, in.xi);
  p.area = in.area;
  Ray<double, Basis::dim> ray;
  const bool shadow = plan.projection != ProjectionKind::normal;
  if (shadow && !set_rays(plan, block, e, ray)) return 0;
  return write_heat_ingredients<Basis, Enriched, double>(plan, block, 1, p, shadow ? &ray : nullptr, e, out);
}

// Places are block.start. Bit k: out[k] is that of element first + k.
template <class Basis, bool Enriched>
std::uint64_t evaluate_heat(const Plan& plan, const ElementBlock& block, std::int32_t count,
                            HeatIngredients* out) {
  std::uint64_t done = 0;
  std::int32_t k = 0;
#if defined(ENTS_HAS_LANES)
  if constexpr (constexpr int W = block_width<Basis>; W > 1)
    for (; k + W <= count; k += W) {
      const std::int64_t e = block.first + k;
      const LaneInputs<Basis, Enriched, false, W> in(plan, block, e);
      std::uint32_t known = in.known;
      ProjectedPoint<Basis, Enriched, Lanes<W>> p(in.nodes, in.xi);
      p.area = in.area;
      Ray<Lanes<W>, Basis::dim> ray;
      const bool shadow = plan.projection != ProjectionKind::normal;
      if (shadow) known &= bits_of(set_rays(plan, block, e, ray));
      done |= std::uint64_t{write_heat_ingredients<Basis, Enriched, Lanes<W>>(
                  plan, block, known, p, shadow ? &ray : nullptr, e, out)}
              << k;
    }
#endif
  for (; k < count; ++k)
    done |= std::uint64_t{heat_of_one<Basis, Enriched>(plan, block, block.first + k, out)} << k;
  return done;
}

// Those of a basis, instantiated; block_table.cpp lists them.
#define ENTS_HEAT_KERNELS(Basis)                                                                             \
  template std::uint64_t evaluate_heat<Basis, false>(const Plan&, const ElementBlock&, std::int32_t,         \
                                                     HeatIngredients*);                                      \
  template std::uint64_t evaluate_heat<Basis, true>(const Plan&, const ElementBlock&, std::int32_t,          \
                                                    HeatIngredients*);

} // namespace ents::ENTS_ISA
