// SPDX-License-Identifier: BSD-3-Clause
// The residual of an element with friction (theory.md, section 5).
#pragma once

#include "core/law/friction_point.hpp"
#include "core/tangent/frictionless_tangent.hpp"

namespace ents::ENTS_ISA {

// R = A W' dg + t_a dxi^a; push: A W' n_e
template <bool Rigid, class Basis, bool Enriched, class Scalar>
ENTS_INLINE void friction_residual(const ProjectedPoint<Basis, Enriched, Scalar>& point,
                                   const Friction<Scalar, Basis::dim - 1>& friction,
                                   const Vec<Scalar, Basis::dim>& push,
                                   Scalar (&out)[dof_count<Basis, Rigid>]) {
  constexpr int T = Basis::dim - 1;
  const auto& p = point.projector;
  Form<Basis, Scalar> force, f[T];
  form_of_p<Basis, Enriched>(p.s, push, force);
  if constexpr (!Enriched)
    for (auto& v : force.a) v = Vec<Scalar, Basis::dim>::zero();
  for (auto& v : force.a2.of) v = Vec<Scalar, Basis::dim>::zero();
  forms_of_f(p.s, f);
  Scalar inverse[symmetric_size<T>];
  invert(p.f2, determinant(p.f2), inverse);
  for (int b = 0; b < T; ++b) {
    Scalar raised = inverse[symmetric_index(0, b)] * friction.force[0];
    if constexpr (T == 2) raised = raised + inverse[symmetric_index(1, b)] * friction.force[1];
    add_form<parts_of_f<Basis, Enriched>>(force, raised, f[b]);
  }
  expand_to_dofs<Rigid, parts_of_f<Basis, Enriched>>(p.nodes.basis, force, p.N, out);
}

} // namespace ents::ENTS_ISA
