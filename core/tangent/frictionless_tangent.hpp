// SPDX-License-Identifier: BSD-3-Clause
// Residual and tangent of the frictionless element with a penalty or power law: see projected_point.hpp.
#pragma once

#include "core/projection/projected_point.hpp"
#include "core/tangent/dof_rows.hpp"
#include "core/tangent/projection_forms.hpp"
#include "core/tangent/write_tangent.hpp"

namespace ents::ENTS_ISA {

// out = R: A W' dg
template <bool Rigid, class Basis, bool Enriched, class Scalar>
ENTS_INLINE void frictionless_residual(const ProjectedPoint<Basis, Enriched, Scalar>& point,
                                       Scalar (&out)[dof_count<Basis, Rigid>]) {
  Form<Basis, Scalar> f;
  form_of_p<Basis, Enriched>(point.projector.s, (point.area * point.per_gap) * point.gap_vector, f);
  expand_to_dofs<Rigid, parts_of_p<Enriched>>(point.nodes.basis, f, point.projector.N, out);
}

// Of g g^T = A (W'' - W'/g) dg dg^T = (m - 1) A W'/g dg dg^T, where the law is not linear
template <class Basis, bool Enriched, class Scalar>
ENTS_INLINE void form_of_g(const Plan& plan, const ProjectedPoint<Basis, Enriched, Scalar>& point,
                           Form<Basis, Scalar>& g) {
  const Scalar root = square_root(point.area * point.per_gap);
  form_of_p<Basis, Enriched>(point.projector.s,
                             (root * square_root(0.5 * plan.law.twice_exponent - 1.0)) * point.normal, g);
}
// False: the law is linear, and g zero.
template <bool Rigid, class Basis, bool Enriched, class Scalar>
ENTS_INLINE bool set_g(const Plan& plan, const ProjectedPoint<Basis, Enriched, Scalar>& point,
                       DofArray<Basis, Rigid, Scalar>& g) {
  if (plan.law.twice_exponent > 2) {
    Form<Basis, Scalar> form;
    form_of_g(plan, point, form);
    expand_to_dofs<Rigid, parts_of_p<Enriched>>(point.nodes.basis, form, point.projector.N, g);
    return true;
  }
  for_each_dof(dofs_of<Rigid>(point.nodes.basis), g, []() ENTS_LAMBDA_INLINE { return Scalar(0.0); });
  return false;
}

// K = s s^T I - sum_a v_a v_a^T + sum_a (w_a z_a^T + z_a w_a^T) [ + g g^T ]
template <class Basis, bool Enriched, bool Rigid, class Scalar> struct FrictionlessTangent {
  static constexpr int D = Basis::dim, T = D - 1, N = dof_count<Basis, Rigid>, M = N / D;
  static constexpr bool turns = Enriched && !Rigid; // w, z: dofs of the master
  static constexpr bool symmetric = true, has_rest = false, one_by_one = !turns;
  static constexpr int products = turns ? 3 * T : T; // that an entry is the sum of
  static constexpr bool counted = counts_dofs<Basis, Rigid>;
  using Array = DofArray<Basis, Rigid, Scalar>;
  [[no_unique_address]] Basis basis;
  Scalar weights[1][M]; // s
  Array v[T];
  Array w[turns ? T : 1], z[turns ? T : 1];
  Array g; // where the law is not linear
  bool curved_law;

  // The slave, and nodes whose dofs there are
  ENTS_INLINE constexpr int places() const { return Rigid ? 1 : node_count(basis) + 1; }

  ENTS_INLINE void evaluate(const Plan& plan, const ProjectedPoint<Basis, Enriched, Scalar>& point) {
    const auto& p = point.projector;
    const Scalar stiffness = point.area * point.per_gap, root = square_root(stiffness);
    basis = point.nodes.basis;
    weights[0][0] = root;
    if constexpr (!Rigid)
      for (int i = 0; i + 1 < places(); ++i) weights[0][i + 1] = -(root * p.N.n[i]);

    // f F^-1 f = sum v v with F = C C^T, v = C^-1 f
    constexpr int parts = parts_of_f<Basis, Enriched>;
    Form<Basis, Scalar> f[T];
    forms_of_f(p.s, f);
    const Scalar c11 = square_root(p.f2[0]);
    if constexpr (T == 2) {
      const Scalar q = root / square_root(p.f2[0] * determinant(p.f2));
      set_form<parts>(f[1], q * p.f2[0], f[1]);
      add_form<parts>(f[1], -(q * p.f2[1]), f[0]);
    }
    set_form<parts>(f[0], root / c11, f[0]);
    for (int a = 0; a < T; ++a) expand_to_dofs<Rigid, parts>(basis, f[a], p.N, v[a]);

    if constexpr (turns) {
      Form<Basis, Scalar> zf[T];
      forms_of_z<Basis>(p.s, zf);
      const Vec<Scalar, D> n = stiffness * p.s.n; // w_a = n . delta a_a
      for (int a = 0; a < T; ++a) {
        expand_to_dofs<Rigid, on_position | on_tangents>(basis, zf[a], p.N, z[a]);
        expand_to_nodes(basis, p.N.d1[a], n, w[a]);
      }
    }
    curved_law = set_g<Rigid>(plan, point, g);
  }

  // Each lane's to one[lane]
  template <class One, int W>
  requires(!turns) ENTS_INLINE void scatter_lanes(One (&one)[W]) const {
    scatter_tangent(
        *this, one, [](auto& t) ENTS_LAMBDA_INLINE -> auto& { return t.v; });
  }

  // k + all but the weights and g g^T; row(array) is the array's entry of the row
  template <class R, class Row> ENTS_INLINE R add_products(R k, Row&& row, int j) const {
    for (int a = 0; a < T; ++a) k = k - row(v[a]) * R(v[a][j]);
    if constexpr (turns)
      for (int a = 0; a < T; ++a) k = k + (row(w[a]) * R(z[a][j]) + row(z[a]) * R(w[a][j]));
    return k;
  }
  template <class R, class Row> ENTS_INLINE R add_rest(R k, Row&&, int) const { return k; }
};

} // namespace ents::ENTS_ISA
