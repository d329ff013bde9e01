// SPDX-License-Identifier: BSD-3-Clause
// The residual of an element with friction (theory.md, section 5).
#pragma once

#include "core/law/friction.hpp"
#include "core/tangent/frictionless_tangent.hpp"

namespace ents::ENTS_ISA {

// R = A W' dg + t_a dxi^a; push: A W' n_e
template <bool Rigid, class B, bool H, class S>
ENTS_INLINE void friction_residual(const ProjectedPoint<B, H, S>& point,
                                   const Friction<S, B::dim - 1>& friction, const Vec<S, B::dim>& push,
                                   S (&out)[dof_count<B, Rigid>]) {
  constexpr int T = B::dim - 1;
  const auto& p = point.projector;
  Form<B, S> force, f[T];
  form_of_p<B, H>(p.s, push, force);
  if constexpr (!H)
    for (auto& v : force.a) v = Vec<S, B::dim>::zero();
  for (auto& v : force.a2.of) v = Vec<S, B::dim>::zero();
  forms_of_f(p.s, f);
  S inverse[symmetric_size<T>];
  invert(p.f2, determinant(p.f2), inverse);
  for (int b = 0; b < T; ++b) {
    S raised = inverse[symmetric_index(0, b)] * friction.force[0];
    if constexpr (T == 2) raised = raised + inverse[symmetric_index(1, b)] * friction.force[1];
    add_form<parts_of_f<B, H>>(force, raised, f[b]);
  }
  expand_to_dofs<Rigid, parts_of_f<B, H>>(p.nodes.basis, force, p.N, out);
}

} // namespace ents::ENTS_ISA
