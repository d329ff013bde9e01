// SPDX-License-Identifier: BSD-3-Clause
// Second variations of every law, both projections and all kinds of tangent, as a sum of products of vectors
// of dofs:
//   K = dg (a dg + a_s dds)^T + b D2g + dxi^a dt_a + t_a D2xi^a       dds: of wear (wear.hpp)
//
// normal    D2g = - n_e . DD'rho_e + q G q + q P dxi + dxi P^T q + dxi (H P) dxi,
//           q_a = n_e . delta rho_e,a,  H_ab = n_e . rho_e,ab,  G = g A_e^-1,  P = G H - 1
//           (D2g of theory.md, section 3, with p eliminated in favour of dxi: no difference of large numbers
//           is left where g is small)
//           = - n_e . DD'rho_e + g sum_a qq_a qq_a + sum_a (dxi^a Y_a + Y_a dxi^a),
//           qq = C^-1 q with A_e = C C^T,  Y = P^T q + H P dxi / 2
// small gap the same with G = 0, P = -1 and dxi = A_e^-1 p
// shadow    C . (D2 of the ray's equations) with the covector C = b c + t_a onto^a: G = 0, P = -1, and the
//           terms of a ray that turns
// D2xi      of the normal projection: second_xi.hpp
#pragma once

#include "core/tangent/contact_point.hpp"
#include "core/tangent/range.hpp"
#include "core/tangent/second_xi.hpp"

namespace ents::ENTS_ISA {

// out += v at the slave
template <class Scalar, int N, int D>
ENTS_INLINE void add_to_slave(Scalar (&out)[N], const Vec<Scalar, D>& v) {
  for (int i = 0; i < D; ++i) out[i] = out[i] + v[i];
}
template <int N, int D> ENTS_INLINE void add_to_slave(DofRow<N>& out, const Vec<double, D>& v) {
  add_to_slave(out.column, v);
  unroll<Pieces<N>::count>([&](auto piece) ENTS_LAMBDA_INLINE {
    out.row.template at<piece.value>() = piece_of<piece.value>(out.column);
  });
}

// What is summed.
template <class Scalar, int T> struct Weights {
  Scalar by_gap;  // a
  bool stiff;     // is there one?
  Scalar by_slid; // a_s, of wear
  bool wears;
  Scalar push;     // b
  Scalar force[T]; // t_a
  bool second_gap; // D2g
  bool small_gap;
  bool second_xi;     // D2xi
  bool force_changes; // dt_a
};

// Friction: is there any, or wear, or are second variations of xi summed? If not, there is nothing but dg
// dg^T and D2g, and the sum is symmetric.
template <class Basis, bool Enriched, class Scalar, bool Friction>
struct TangentSum : SecondXi<Basis, Enriched, false, Scalar> {
  using Base = SecondXi<Basis, Enriched, false, Scalar>;
  using Base::D, Base::T, Base::N, Base::K, Base::M, Base::turns, Base::bends, Base::parts;
  using Base::weights, Base::x, Base::Y, Base::w, Base::Z, Base::w1, Base::z;
  using typename Base::Derivative;
  using typename Base::Forms;
  static constexpr bool friction = Friction, symmetric = true, has_rest = Friction; // as write_tangent() asks
  static constexpr int products = 1 + 5 * T;
  using V = Vec<Scalar, D>;
  using Base::basis, Base::places;
  using typename Base::Array;
  Scalar by_gap, by_q;
  // by_gap dg dg^T, x_a Y_a^T + Y_a x_a^T, w_a Z_a^T + .., by_q q_a q_a^T; of friction w1_a z_a^T + ..; the
  // rest dg dW^T, dxi_a P_a^T
  Array dg, q[T], dW, dxi[T], P[T];
  bool has_gap, has_xi, has_q, has_second_xi, has_force, has_dW;
  static constexpr bool curved_law = false;
  const Scalar* g = nullptr;

  // Shape functions and two derivatives of them are there.
  ENTS_NOINLINE void evaluate(const Plan& plan, const ContactPoint<Basis, Enriched, Scalar>& at,
                              const Weights<Scalar, T>& sum) {
    const bool shadow = at.ray != nullptr, second_xi = Friction && sum.second_xi;
    basis = at.point.nodes.basis;
    for (auto& row : weights)
      for (int m = 0; m < places(); ++m) row[m] = Scalar(0.0);
    by_gap = sum.by_gap;
    has_gap = sum.stiff;
    has_xi = sum.second_gap || second_xi;
    has_q = sum.second_gap && !shadow && !sum.small_gap;
    has_second_xi = second_xi && !shadow;
    has_force = Friction && sum.force_changes;
    has_dW = Friction && sum.wears;
    set_gap(at);
    Form<Basis, Scalar> xf[T];
    if (has_xi || has_force || has_dW) {
      forms_of_xi(at, xf);
      if constexpr (Friction)
        for (int a = 0; a < T; ++a) expand_xi(at, xf[a], dxi[a]);
    }
    if (has_dW) set_slid(at, sum.by_slid);
    if (has_xi) set_second(at, sum, xf);
    if constexpr (Friction)
      if (has_force) set_force(plan, at, sum);
  }

  // dg and dxi alone
  ENTS_NOINLINE void evaluate_first(const ContactPoint<Basis, Enriched, Scalar>& at) {
    Form<Basis, Scalar> xf[T];
    basis = at.point.nodes.basis;
    set_gap(at);
    forms_of_xi(at, xf);
    for (int a = 0; a < T; ++a) expand_xi(at, xf[a], dxi[a]);
  }

  // Shadow projection: the covector whose second variation is summed
  static ENTS_INLINE V covector_of(const ContactPoint<Basis, Enriched, Scalar>& at,
                                   const Weights<Scalar, T>& sum) {
    Scalar force[T];
    for (int a = 0; a < T; ++a) force[a] = sum.second_xi ? sum.force[a] : Scalar(0.0);
    return at.covector(sum.second_gap ? sum.push : Scalar(0.0), force);
  }

  // The sum of the absolute numbers of dofs
  ENTS_INLINE double size_of(const Array& numbers) const { return sum_of_absolutes(numbers, dofs()); }

  // No entry, and no partial sum of one, is larger.
  ENTS_INLINE double bound() const {
    double b = (has_gap ? (1.0 + absolute(by_gap)) * size_of(dg) * size_of(dg) : 0.0) +
               2.0 * sum_of_absolutes(weights[0], places()) * sum_of_absolutes(weights[1], places());
    const auto add = [&](const auto& u, const auto& v) {
      for (int a = 0; a < T; ++a) b += 2.0 * size_of(u[a]) * size_of(v[a]);
    };
    if (has_xi) {
      add(x, Y);
      if constexpr (turns) add(w, Z);
    }
    for (int a = 0; a < T && has_q; ++a) b += (1.0 + absolute(by_q)) * size_of(q[a]) * size_of(q[a]);
    if constexpr (bends)
      if (has_second_xi) add(w1, z);
    if (has_dW) b += size_of(dg) * size_of(dW);
    if (has_force) add(dxi, P);
    return b;
  }

  // k + all but the weights; row(array) is the array's entry of the row
  template <class R, class Row> ENTS_INLINE R add_products(R k, Row&& row, int j) const {
    if (!Friction || has_gap) k = k + R(by_gap) * (row(dg) * R(dg[j]));
    if (has_xi)
      for (int a = 0; a < T; ++a) {
        k = k + (row(x[a]) * R(Y[a][j]) + row(Y[a]) * R(x[a][j]));
        if constexpr (turns) k = k + (row(w[a]) * R(Z[a][j]) + row(Z[a]) * R(w[a][j]));
      }
    if (has_q) {
      R square = row(q[0]) * R(q[0][j]);
      if constexpr (T == 2) square = square + row(q[1]) * R(q[1][j]);
      k = k + R(by_q) * square;
    }
    if constexpr (Friction && bends)
      if (has_second_xi)
        for (int a = 0; a < T; ++a) k = k + (row(w1[a]) * R(z[a][j]) + row(z[a]) * R(w1[a][j]));
    return k;
  }
  // k + what is not symmetric
  template <class R, class Row> ENTS_INLINE R add_rest(R k, Row&& row, int j) const {
    if constexpr (Friction) {
      if (has_dW) k = k + row(dg) * R(dW[j]);
      if (has_force)
        for (int a = 0; a < T; ++a) k = k + row(dxi[a]) * R(P[a][j]);
    }
    return k;
  }

  // The entry of two dofs of the slave
  ENTS_INLINE Scalar of_slave(int i, int j) const {
    const auto row = [i](const auto& array) ENTS_LAMBDA_INLINE { return array[i]; };
    const Scalar own = i == j ? 2.0 * (weights[0][0] * weights[1][0]) : Scalar(0.0);
    return add_rest<Scalar>(add_products<Scalar>(own, row, j), row, j);
  }

private:
  ENTS_INLINE constexpr int dofs() const { return D * places(); }
  template <int Parts>
  static ENTS_INLINE void expand(const ContactPoint<Basis, Enriched, Scalar>& at,
                                 const Form<Basis, Scalar>& f, Array& out) {
    expand_to_dofs<false, Parts>(at.point.nodes.basis, f, at.point.projector.N, out);
  }
  // + factor times the ray's own turn, of a covector's form
  static ENTS_INLINE void add_turn(const ContactPoint<Basis, Enriched, Scalar>& at, const V& c, Array& out) {
    add_to_slave(out, -(at.gap * variation_of_ray(c, *at.ray)));
  }
  // out += factor v
  ENTS_INLINE void add(Array& out, const Scalar& factor, const Array& v) const {
    for_each_dof(
        dofs(), out, [&](auto a, auto b) ENTS_LAMBDA_INLINE { return a + decltype(a)(factor) * b; }, out, v);
  }

  ENTS_INLINE void set_gap(const ContactPoint<Basis, Enriched, Scalar>& at) {
    Form<Basis, Scalar> f;
    form_of_p<Basis, Enriched>(at.point.projector.s, at.c, f);
    expand<parts_of_p<Enriched>>(at, f, dg);
    if (at.ray) add_turn(at, at.c, dg);
  }

  // c . p, with zeros where it has no part
  static ENTS_INLINE void whole_form_of_p(const ContactPoint<Basis, Enriched, Scalar>& at, const V& c,
                                          Form<Basis, Scalar>& f) {
    for (auto& v : f.a) v = V::zero();
    for (auto& v : f.a2.of) v = V::zero();
    form_of_p<Basis, Enriched>(at.point.projector.s, c, f);
  }

  // dxi^a, but for the turn of a ray
  static ENTS_INLINE void forms_of_xi(const ContactPoint<Basis, Enriched, Scalar>& at,
                                      Form<Basis, Scalar> (&xf)[T]) {
    const auto& p = at.point.projector;
    if (at.ray) {
      for (int a = 0; a < T; ++a) whole_form_of_p(at, at.onto[a], xf[a]);
    } else {
      Form<Basis, Scalar> f[T];
      forms_of_f(p.s, f);
      combine(p.f2, f, xf);
    }
  }
  // of = matrix^-1 f
  static ENTS_INLINE void combine(const Scalar (&matrix)[K], const Form<Basis, Scalar> (&f)[T],
                                  Form<Basis, Scalar> (&of)[T]) {
    Scalar inverse[K];
    invert_with(matrix, unchecked_inverse(determinant(matrix)), inverse);
    for (int a = 0; a < T; ++a) {
      set_form<parts>(of[a], inverse[symmetric_index(a, 0)], f[0]);
      if constexpr (T == 2) add_form<parts>(of[a], inverse[symmetric_index(a, 1)], f[1]);
    }
  }
  ENTS_INLINE void expand_xi(const ContactPoint<Basis, Enriched, Scalar>& at, const Form<Basis, Scalar>& f,
                             Array& out) const {
    expand<parts>(at, f, out);
    if (at.ray) add_turn(at, f.x, out);
  }

  // dW = a_s dds
  ENTS_NOINLINE void set_slid(const ContactPoint<Basis, Enriched, Scalar>& at, const Scalar& by_slid) {
    Scalar by_xi[T];
    at.slid_by_xi(by_xi);
    for_each_dof(dofs(), dW, []() ENTS_LAMBDA_INLINE { return Scalar(0.0); });
    for (int c = 0; c < T; ++c) add(dW, by_slid * by_xi[c], dxi[c]);
    unroll<T>([&](auto b) ENTS_LAMBDA_INLINE {
      Form<Basis, Scalar> f;
      form_of_slope<b.value, Basis, Enriched>(at.point.projector.s, at.wear.m, f);
      Array own;
      expand<parts_of_slope<Basis, Enriched>>(at, f, own);
      add(dW, by_slid * at.wear.moved[b], own);
    });
  }

  // x, Y, w, Z, q, and of friction the weights, w1 and z; xf: dxi
  ENTS_INLINE void set_second(const ContactPoint<Basis, Enriched, Scalar>& at, const Weights<Scalar, T>& sum,
                              const Form<Basis, Scalar> (&xf)[T]) {
    const auto& p = at.point.projector;
    const bool shadow = at.ray != nullptr;
    const V c = shadow ? covector_of(at, sum) : at.normal;
    const Scalar push = shadow ? Scalar(1.0) : sum.second_gap ? sum.push : Scalar(0.0);
    Form<Basis, Scalar> of[T], Yf[T];
    Scalar HP[T][T];
    const auto& pairs_with = [&]() ENTS_LAMBDA_INLINE -> const Form<Basis, Scalar>(&)[T] {
      if (shadow || !sum.small_gap || !sum.second_gap) return xf;
      Form<Basis, Scalar> lowered[T];
      for (int a = 0; a < T; ++a) whole_form_of_p(at, p.s.e[a], lowered[a]);
      combine(p.metric, lowered, of);
      return of;
    }();
    set_gap_terms(at, c, push, pairs_with, Yf, HP);
    const auto add_z = [&]([[maybe_unused]] auto a, [[maybe_unused]] Form<Basis, Scalar>& Zf)
                           ENTS_LAMBDA_INLINE {
                             if constexpr (Enriched) {
                               Form<Basis, Scalar> own;
                               form_of_z<a.value, Basis>(p.s, c, own);
                               add_form<on_tangents>(Zf, push, own);
                             }
                           };
    if constexpr (Friction)
      if (has_second_xi) {
        Scalar inverse[K], y[T];
        Forms::set_direction(at.point, sum.force, inverse, y);
        const Derivative derivative(p, at.point.xi, y);
        Base::set_weights(Scalar(0.0), derivative);
        Base::set_projection_terms(
            at.point, inverse, derivative, Scalar(0.0),
            [&](int a, const Form<Basis, Scalar>&, const Form<Basis, Scalar>(&)[T], Form<Basis, Scalar>& Y_a)
                ENTS_LAMBDA_INLINE { add_form<parts>(Y_a, Scalar(1.0), Yf[a]); });
        if constexpr (turns) Base::set_height_terms(Scalar(0.0), derivative, add_z);
        return;
      }
    for (int a = 0; a < T; ++a) {
      expand_xi(at, pairs_with[a], x[a]);
      expand<parts>(at, Yf[a], Y[a]);
      if (shadow)
        for (int b = 0; b < T; ++b) add_turn(at, (push * (0.5 * HP[a][b])) * at.onto[b], Y[a]);
    }
    if constexpr (Enriched)
      unroll<T>([&](auto a) ENTS_LAMBDA_INLINE {
        Form<Basis, Scalar> Zf;
        for (auto& v : Zf.a) v = V::zero();
        add_z(a, Zf);
        expand<on_tangents>(at, Zf, Z[a]);
        expand_to_nodes(basis, p.N.d1[a], p.s.n, w[a]);
      });
  }

  // Of push D2g with the covector c: q, and the forms of Y
  ENTS_INLINE void set_gap_terms(const ContactPoint<Basis, Enriched, Scalar>& at, const V& c,
                                 const Scalar& push, const Form<Basis, Scalar> (&xf)[T],
                                 Form<Basis, Scalar> (&Yf)[T], Scalar (&HP)[T][T]) {
    const auto& p = at.point.projector;
    Scalar bend[K], G[T][T], PT[T][T];
    for (int k = 0; k < K; ++k) bend[k] = dot(c, p.s.e2[k]);
    for (auto& row : G)
      for (Scalar& entry : row) entry = Scalar(0.0);
    if (has_q) {
      Scalar inverse[K];
      invert_with(p.metric, unchecked_inverse(determinant(p.metric)), inverse);
      for (int a = 0; a < T; ++a)
        for (int b = 0; b < T; ++b) G[a][b] = at.gap * inverse[symmetric_index(a, b)];
    }
    for (int a = 0; a < T; ++a)
      for (int b = 0; b < T; ++b) {
        Scalar entry = Scalar(a == b ? -1.0 : 0.0);
        for (int k = 0; k < T; ++k) entry = entry + G[a][k] * bend[symmetric_index(k, b)];
        PT[b][a] = entry;
      }
    for (int a = 0; a < T; ++a)
      for (int b = 0; b < T; ++b) {
        HP[a][b] = bend[symmetric_index(a, 0)] * PT[b][0];
        if constexpr (T == 2) HP[a][b] = HP[a][b] + bend[symmetric_index(a, 1)] * PT[b][1];
      }
    constexpr int slope = parts_of_slope<Basis, Enriched>;
    Form<Basis, Scalar> qf[T];
    unroll<T>([&](auto a) ENTS_LAMBDA_INLINE { form_of_slope<a.value, Basis, Enriched>(p.s, c, qf[a]); });
    for (int a = 0; a < T; ++a) {
      Yf[a].x = V::zero();
      set_form<slope>(Yf[a], push * PT[a][0], qf[0]);
      if constexpr (T == 2) add_form<slope>(Yf[a], push * PT[a][1], qf[1]);
      for (int b = 0; b < T; ++b) add_form<parts>(Yf[a], push * (0.5 * HP[a][b]), xf[b]);
    }
    if (!has_q) return;
    by_q = push * at.gap;
    const auto& metric = p.metric;
    if constexpr (T == 2) {
      const Scalar scale = unchecked_inverse(square_root(metric[0] * determinant(metric)));
      set_form<slope>(qf[1], scale * metric[0], qf[1]);
      add_form<slope>(qf[1], -(scale * metric[1]), qf[0]);
    }
    set_form<slope>(qf[0], unchecked_inverse(square_root(metric[0])), qf[0]);
    for (int a = 0; a < T; ++a) expand<slope>(at, qf[a], q[a]);
  }

  // dt_a
  ENTS_NOINLINE void set_force(const Plan& plan, const ContactPoint<Basis, Enriched, Scalar>& at,
                               const Weights<Scalar, T>& sum) {
    const auto& friction_at = at.friction;
    const typename Forms::ChangeOfForce change(at.point, friction_at,
                                               plan.law.multiplier_is_dof() || plan.law.multiplier_in_state(),
                                               plan.law.coefficient_varies() ? &friction_at.radial : nullptr);
    for (int a = 0; a < T; ++a) {
      Form<Basis, Scalar> f;
      for (auto& v : f.a) v = V::zero();
      for (auto& v : f.a2.of) v = V::zero();
      change.add_to(a, at.point.projector.s, f);
      expand<parts_of_slope<Basis, Enriched>>(at, f, P[a]);
      for (int b = 0; b < T; ++b) add(P[a], change.by_xi[a][b], dxi[b]);
      const Scalar per_force = -friction_at.by_force[a];
      add(P[a], friction_at.by_gap[a] + per_force * sum.by_gap, dg);
      if (has_dW) add(P[a], per_force, dW);
    }
  }
};

// The matrix of the slave's dofs, of a rigid master
template <class Basis, bool Enriched, bool Friction>
ENTS_INLINE void write_slave(const TangentSum<Basis, Enriched, double, Friction>& sum, double* out,
                             std::int64_t leading) {
  for (int j = 0; j < Basis::dim; ++j)
    for (int i = 0; i < Basis::dim; ++i) out[j * leading + i] = sum.of_slave(i, j);
}
#if defined(ENTS_HAS_LANES)
// Of each lane k whose bit is set, to place(k)
template <class Basis, bool Enriched, class Scalar, bool Friction, class Place>
ENTS_INLINE void write_slaves(const TangentSum<Basis, Enriched, Scalar, Friction>& sum, std::uint32_t used,
                              std::int64_t leading, Place&& place) {
  for (int j = 0; j < Basis::dim; ++j)
    for (int i = 0; i < Basis::dim; ++i) {
      const Scalar entry = sum.of_slave(i, j);
      for (int k = 0; k < width_of<Scalar>; ++k)
        if (used >> k & 1) place(k)[j * leading + i] = lane(entry, k);
    }
}
#endif

} // namespace ents::ENTS_ISA
