// SPDX-License-Identifier: BSD-3-Clause
// Second variations of every law, both projections and all kinds of tangent, as a sum of products of vectors
// of dofs:
//   K = dg (a dg + a_s dds)^T + b D2g + dxi^a dt_a + t_a D2xi^a       dds: of wear (wear.hpp)
//
// normal    D2g = - n_e . DD'rho_e + q G q + q P dxi + dxi P^T q + dxi (H P) dxi,
//           q_a = n_e . delta rho_e,a,  H_ab = n_e . rho_e,ab,  G = g A_e^-1,  P = G H - 1
//           (D2g of theory section 2 with p eliminated in favour of dxi: no difference of large numbers is
//           left where g is small)
// small gap the same with G = 0, P = -1 and dxi = A_e^-1 p
// shadow    C . (D2 of the ray's equations) with the covector C = b c + t_a onto^a: G = 0, P = -1, and the
// terms of a ray that turns D2xi      of the normal projection: see pair_friction_forms.hpp
#pragma once

#include "core/law/contact_point.hpp"
#include "core/tangent/pair_friction_forms.hpp"
#include "core/tangent/pair_write.hpp"

namespace ents::ENTS_ISA {

// Results made of ingredients below this stay far inside the range of double precision.
inline constexpr double largest_ingredient = 1e60;
// A bound of results that leaves room for a few terms more.
inline constexpr double largest_result = 1e300;

template <int N> ENTS_INLINE double sum_of_absolutes(const double (&v)[N]) {
  double s = 0.0;
  for (int i = 0; i < N; ++i) s += absolute(v[i]);
  return s;
}
template <int N> ENTS_INLINE double sum_of_absolutes(const DofRow<N>& v) {
  return sum_of_absolutes(v.column);
}

// out += v at the slave
template <class S, int N, int D> ENTS_INLINE void add_to_slave(S (&out)[N], const Vec<S, D>& v) {
  for (int i = 0; i < D; ++i) out[i] = out[i] + v[i];
}
template <int N, int D> ENTS_INLINE void add_to_slave(DofRow<N>& out, const Vec<double, D>& v) {
  add_to_slave(out.column, v);
  unroll<Pieces<N>::count>([&](auto piece) ENTS_LAMBDA_INLINE {
    out.row.template at<piece.value>() = piece_of<piece.value>(out.column);
  });
}

// What is summed.
template <class S, int T> struct Weights {
  S by_gap;   // a
  bool stiff; // is there one?
  S by_slid;  // a_s, of wear
  bool wears;
  S push;          // b
  S force[T];      // t_a
  bool second_gap; // D2g
  bool small_gap;
  bool second_xi;     // D2xi
  bool force_changes; // dt_a
};

template <class B, bool H, class S> struct TangentSum {
  static constexpr int D = B::dim, T = D - 1, K = symmetric_size<T>, M = B::nodes + 1, N = D * M;
  static constexpr bool symmetric = false, has_rest = false; // as write_tangent() asks
  static constexpr int products = 1 + 9 * T;
  using V = Vec<S, D>;
  using Array = DofArray<S, N>;
  S weights[2][M]; // s, r of (s r^T + r s^T) I
  S by_gap;
  // dg dg^T, dg dW^T, s_a Y_a^T + Y_a s_a^T, q_a Q_a^T + .., w_a Z_a^T + .., w1_a z_a^T + .., x_a P_a^T
  Array dg, dW, s[T], Y[T], q[T], Q[T], w[T], Z[T], w1[T], z[T], x[T], P[T];
  bool has_gap, has_dW, has_Y, has_Q, has_Z, has_z, has_P;
  static constexpr bool curved_law = false;
  const S* g = nullptr;

  // Those of lane k
  template <class Lane> ENTS_INLINE void take(const TangentSum<B, H, Lane>& from, int k) {
    const auto array = [k](const auto& numbers, Array& to) ENTS_LAMBDA_INLINE {
      double own[N];
      for (int i = 0; i < N; ++i) own[i] = lane(numbers[i], k);
      for_each_dof(
          to, [](auto v) ENTS_LAMBDA_INLINE { return v; }, own);
    };
    has_gap = from.has_gap, has_dW = from.has_dW, has_Y = from.has_Y, has_Q = from.has_Q, has_Z = from.has_Z,
    has_z = from.has_z, has_P = from.has_P;
    by_gap = lane(from.by_gap, k);
    for (int r = 0; r < 2; ++r)
      for (int i = 0; i < M; ++i) weights[r][i] = lane(from.weights[r][i], k);
    array(from.dg, dg);
    if (has_dW) array(from.dW, dW);
    for (int a = 0; a < T; ++a) {
      if (has_Y) array(from.s[a], s[a]), array(from.Y[a], Y[a]);
      if (has_Q) array(from.q[a], q[a]), array(from.Q[a], Q[a]);
      if (has_Z) array(from.w[a], w[a]), array(from.Z[a], Z[a]);
      if (has_z) array(from.w1[a], w1[a]), array(from.z[a], z[a]);
      if (has_P) array(from.x[a], x[a]), array(from.P[a], P[a]);
    }
  }

  // Shape functions and two derivatives of them are there.
  ENTS_NOINLINE void evaluate(const Plan& plan, const ContactPoint<B, H, S>& at, const Weights<S, T>& sum) {
    const bool shadow = at.ray != nullptr, second = sum.second_gap || (shadow && sum.second_xi);
    for (auto& row : weights)
      for (S& weight : row) weight = S(0.0);
    by_gap = sum.by_gap;
    has_gap = sum.stiff;
    has_Y = second || sum.second_xi;
    has_Q = sum.second_gap && !shadow && !sum.small_gap;
    has_Z = H && has_Y;
    has_z = H && !is_flat<B> && sum.second_xi && !shadow;
    has_P = sum.force_changes;
    has_dW = sum.wears;
    set_gap(at);
    if (has_Y || has_P || has_dW) set_xi(at, sum.small_gap && !shadow && sum.second_gap);
    if (has_dW) set_slid(at, sum.by_slid);
    if (shadow) {
      if (second) add_second(at, covector_of(at, sum), S(1.0), false);
    } else {
      if (sum.second_xi) set_second_xi(at, sum.force);
      if (sum.second_gap) add_second(at, at.normal, sum.push, sum.second_xi);
    }
    if (has_P) set_force(plan, at, sum);
  }

  // dg and dxi alone
  ENTS_NOINLINE void evaluate_first(const ContactPoint<B, H, S>& at) {
    set_gap(at);
    set_xi(at, false);
  }

  // Shadow projection: the covector whose second variation is summed
  static ENTS_INLINE V covector_of(const ContactPoint<B, H, S>& at, const Weights<S, T>& sum) {
    S force[T];
    for (int a = 0; a < T; ++a) force[a] = sum.second_xi ? sum.force[a] : S(0.0);
    return at.covector(sum.second_gap ? sum.push : S(0.0), force);
  }

  // No entry, and no partial sum of one, is larger.
  ENTS_INLINE double bound() const {
    double b = (has_gap ? (1.0 + absolute(by_gap)) * sum_of_absolutes(dg) * sum_of_absolutes(dg) : 0.0) +
               2.0 * sum_of_absolutes(weights[0]) * sum_of_absolutes(weights[1]);
    if (has_dW) b += sum_of_absolutes(dg) * sum_of_absolutes(dW);
    const auto add = [&b](const Array(&u)[T], const Array(&v)[T]) {
      for (int a = 0; a < T; ++a) b += 2.0 * sum_of_absolutes(u[a]) * sum_of_absolutes(v[a]);
    };
    if (has_Y) add(s, Y);
    if (has_Q) add(q, Q);
    if (has_Z) add(w, Z);
    if (has_z) add(w1, z);
    if (has_P) add(x, P);
    return b;
  }

  // k + all but the weights; row(array) is the array's entry of the row
  template <class R, class Row> ENTS_INLINE R add_products(R k, Row&& row, int j) const {
    if (has_gap) k = k + R(by_gap) * (row(dg) * R(dg[j]));
    if (has_dW) k = k + row(dg) * R(dW[j]);
    const auto add = [&](const Array(&u)[T], const Array(&v)[T]) ENTS_LAMBDA_INLINE {
      for (int a = 0; a < T; ++a) k = k + (row(u[a]) * R(v[a][j]) + row(v[a]) * R(u[a][j]));
    };
    if (has_Y) add(s, Y);
    if constexpr (H)
      if (has_Z) add(w, Z);
    if (has_Q) add(q, Q);
    if constexpr (H && !is_flat<B>)
      if (has_z) add(w1, z);
    if (has_P)
      for (int a = 0; a < T; ++a) k = k + row(x[a]) * R(P[a][j]);
    return k;
  }
  template <class R, class Row> ENTS_INLINE R add_rest(R k, Row&&, int) const { return k; }

  // The matrix of the nodes' dofs; rigid: of the slave's alone.
  ENTS_NOINLINE void write(double* out, std::int64_t leading, bool rigid) const {
    if (!rigid) {
      write_tangent<D>(*this, out, leading);
      return;
    }
    for (int j = 0; j < D; ++j)
      for (int i = 0; i < D; ++i) {
        const double own = i == j ? 2.0 * (weights[0][0] * weights[1][0]) : 0.0;
        out[j * leading + i] = add_products<double>(
            own, [i](const auto& array) ENTS_LAMBDA_INLINE { return array[i]; }, j);
      }
  }

private:
  using Forms = PairFrictionForms<B, H, false, S>;
  static constexpr int parts = Forms::parts, parts_of_rate = Forms::parts_of_rate;

  template <int Parts>
  static ENTS_INLINE void expand(const ContactPoint<B, H, S>& at, const Form<B, S>& f, Array& out) {
    expand_to_dofs<B, false, Parts>(f, at.pair.projector.N, out);
  }
  // out = c . p, with the ray's own turn
  static ENTS_INLINE void expand_covector(const ContactPoint<B, H, S>& at, const V& c, Array& out) {
    Form<B, S> f;
    form_of_p<B, H>(at.pair.projector.s, c, f);
    expand<parts_of_p<H>>(at, f, out);
    if (at.ray) add_to_slave(out, -(at.gap * variation_of_ray(c, *at.ray)));
  }
  static ENTS_INLINE void zero(Array& out) {
    for_each_dof(out, []() ENTS_LAMBDA_INLINE { return S(0.0); });
  }
  // out += factor v
  static ENTS_INLINE void add(Array& out, const S& factor, const Array& v) {
    for_each_dof(
        out, [&](auto a, auto b) ENTS_LAMBDA_INLINE { return a + decltype(a)(factor) * b; }, out, v);
  }

  ENTS_INLINE void set_gap(const ContactPoint<B, H, S>& at) { expand_covector(at, at.c, dg); }

  // dxi^a, and those of small gaps in s where these are summed
  ENTS_INLINE void set_xi(const ContactPoint<B, H, S>& at, bool small_gap) {
    const auto& p = at.pair.projector;
    if (at.ray) {
      for (int a = 0; a < T; ++a) expand_covector(at, at.onto[a], x[a]);
    } else {
      Form<B, S> f[T], xf[T];
      S inverse[K];
      forms_of_f(p.s, f);
      invert_with(p.f2, unchecked_inverse(determinant(p.f2)), inverse);
      for (int a = 0; a < T; ++a) {
        set_form<parts>(xf[a], inverse[symmetric_index(a, 0)], f[0]);
        if constexpr (T == 2) add_form<parts>(xf[a], inverse[symmetric_index(a, 1)], f[1]);
        expand<parts>(at, xf[a], x[a]);
      }
    }
    for (int a = 0; a < T; ++a) {
      for_each_dof(
          s[a], [](auto v) ENTS_LAMBDA_INLINE { return v; }, x[a]);
      zero(Y[a]);
    }
    if (!small_gap) return;
    Array lowered[T];
    S inverse[K];
    for (int a = 0; a < T; ++a) expand_covector(at, p.s.e[a], lowered[a]);
    invert_with(p.metric, unchecked_inverse(determinant(p.metric)), inverse);
    for (int a = 0; a < T; ++a) {
      zero(s[a]);
      for (int b = 0; b < T; ++b) add(s[a], inverse[symmetric_index(a, b)], lowered[b]);
    }
  }
  // dW = a_s dds
  ENTS_NOINLINE void set_slid(const ContactPoint<B, H, S>& at, const S& by_slid) {
    S by_xi[T];
    at.slid_by_xi(by_xi);
    zero(dW);
    for (int c = 0; c < T; ++c) add(dW, by_slid * by_xi[c], x[c]);
    unroll<T>([&](auto b) ENTS_LAMBDA_INLINE {
      Form<B, S> f;
      form_of_slope<b.value, B, H>(at.pair.projector.s, at.wear.m, f);
      Array own;
      expand<parts_of_slope<B, H>>(at, f, own);
      add(dW, by_slid * at.wear.moved[b], own);
    });
  }
  // push D2g with the covector c; is Z there already?
  ENTS_INLINE void add_second(const ContactPoint<B, H, S>& at, const V& c, const S& push, bool with_Z) {
    const auto& p = at.pair.projector;
    S bend[K], G[T][T], PT[T][T], HP[T][T];
    for (int k = 0; k < K; ++k) bend[k] = dot(c, p.s.e2[k]);
    for (auto& row : G)
      for (S& entry : row) entry = S(0.0);
    if (has_Q) {
      S inverse[K];
      invert_with(p.metric, unchecked_inverse(determinant(p.metric)), inverse);
      for (int a = 0; a < T; ++a)
        for (int b = 0; b < T; ++b) G[a][b] = at.gap * inverse[symmetric_index(a, b)];
    }
    for (int a = 0; a < T; ++a)
      for (int b = 0; b < T; ++b) {
        S sum = S(a == b ? -1.0 : 0.0);
        for (int k = 0; k < T; ++k) sum = sum + G[a][k] * bend[symmetric_index(k, b)];
        PT[b][a] = sum;
      }
    for (int a = 0; a < T; ++a)
      for (int b = 0; b < T; ++b) {
        HP[a][b] = bend[symmetric_index(a, 0)] * PT[b][0];
        if constexpr (T == 2) HP[a][b] = HP[a][b] + bend[symmetric_index(a, 1)] * PT[b][1];
      }
    unroll<T>([&](auto a) ENTS_LAMBDA_INLINE {
      Form<B, S> f;
      form_of_slope<a.value, B, H>(p.s, c, f);
      expand<parts_of_slope<B, H>>(at, f, q[a]);
    });
    for (int a = 0; a < T; ++a) {
      if (has_Q) zero(Q[a]);
      for (int b = 0; b < T; ++b) {
        if (has_Q) add(Q[a], push * (0.5 * G[a][b]), q[b]);
        add(Y[a], push * PT[a][b], q[b]);
        add(Y[a], push * (0.5 * HP[a][b]), s[b]);
      }
    }
    if constexpr (H)
      unroll<T>([&](auto a) ENTS_LAMBDA_INLINE {
        Form<B, S> f;
        form_of_z<a.value, B>(p.s, c, f);
        Array own;
        expand<on_tangents>(at, f, own);
        if (!with_Z) {
          zero(Z[a]);
          expand_to_nodes<B>(p.N.d1[a], p.s.n, w[a]);
        }
        add(Z[a], push, own);
      });
  }

  // t_a D2xi^a of the normal projection
  ENTS_NOINLINE void set_second_xi(const ContactPoint<B, H, S>& at, const S (&force)[T]) {
    const auto& p = at.pair.projector;
    S inverse[K], y[T];
    invert_with(p.f2, unchecked_inverse(determinant(p.f2)), inverse);
    for (int a = 0; a < T; ++a) {
      S sum = inverse[symmetric_index(a, 0)] * force[0];
      if constexpr (T == 2) sum = sum + inverse[symmetric_index(a, 1)] * force[1];
      y[a] = -sum;
    }
    const typename Forms::Drift drift(p, at.pair.xi, y);
    weights[0][0] = S(1.0);
    for (int i = 0; i < B::nodes; ++i) {
      S change = y[0] * p.N.d1[0][i];
      if constexpr (T == 2) change = change + y[1] * p.N.d1[1][i];
      weights[0][i + 1] = -p.N.n[i];
      weights[1][i + 1] = -change;
    }
    Form<B, Dual<S>> f[T];
    forms_of_f(drift.s, f);
    Shape<S, T, B::nodes> shape_rates;
    if constexpr (Forms::by_third) Forms::set_shape_rates(at.pair.xi, y, shape_rates);
    for (int a = 0; a < T; ++a) {
      Form<B, S> rate, minus;
      set_form_rate<parts>(f[a], y, rate);
      set_form<parts_of_rate>(minus, S(-1.0), rate);
      expand<parts_of_rate>(at, minus, Y[a]);
      if constexpr (Forms::by_third) {
        Form<B, S> value;
        value_of_form<parts>(f[a], value);
        Forms::subtract_third(value, shape_rates, Y[a]);
      }
      for (int b = 0; b < T; ++b) add(Y[a], 0.5 * drift.f2[symmetric_index(a, b)], x[b]);
    }
    if constexpr (H) {
      Form<B, Dual<S>> moving[T];
      forms_of_z<B>(drift.s, moving);
      for (int a = 0; a < T; ++a) {
        Form<B, S> zf, rate;
        value_of_form<Forms::parts_of_z>(moving[a], zf);
        set_form_rate<Forms::parts_of_z>(moving[a], y, rate);
        expand<Forms::parts_of_z_rate>(at, rate, Z[a]);
        expand_to_nodes<B>(p.N.d1[a], p.s.n, w[a]);
        if constexpr (!is_flat<B>) {
          expand<Forms::parts_of_z>(at, zf, z[a]);
          Forms::expand_turn_rate(a, drift, w1[a]);
        }
      }
    }
  }

  // dt_a
  ENTS_NOINLINE void set_force(const Plan& plan, const ContactPoint<B, H, S>& at, const Weights<S, T>& sum) {
    const auto& friction = at.friction;
    const typename Forms::ChangeOfForce change(
        at.pair, friction, plan.law.multiplier_is_dof() || plan.law.multiplier_in_state());
    for (int a = 0; a < T; ++a) {
      Form<B, S> f;
      for (auto& v : f.a) v = V::zero();
      for (auto& v : f.a2.of) v = V::zero();
      change.add_to(a, at.pair.projector.s, f);
      expand<parts_of_slope<B, H>>(at, f, P[a]);
      for (int b = 0; b < T; ++b) add(P[a], change.by_xi[a][b], x[b]);
      const S per_force = -(change.slips[a] * friction.by_pressure);
      add(P[a], per_force * sum.by_gap, dg);
      if (has_dW) add(P[a], per_force, dW);
    }
  }
};

// The terms of a ray that turns with the slave: matrix += - [dg (C . de)^T + its transpose] - g C . DD'e
template <int D, class Array>
ENTS_INLINE void add_turning_ray(const Vec<double, D>& covector, const Ray<double, D>& ray, double gap,
                                 const Array& dg, int dofs, double* out, std::int64_t leading) {
  const double q = ray.inverse_distance, along = dot(covector, ray.e);
  if (q == 0.0) return;
  const Vec<double, D> r = variation_of_ray(covector, ray);
  for (int j = 0; j < D; ++j)
    for (int i = 0; i < dofs; ++i) {
      const double mixed = -r[j] * dg[i];
      out[j * leading + i] += mixed;
      out[i * leading + j] += mixed;
    }
  for (int j = 0; j < D; ++j)
    for (int i = 0; i < D; ++i) {
      const double projector = (i == j ? 1.0 : 0.0) - ray.e[i] * ray.e[j];
      out[j * leading + i] -= gap * (q * (r[i] * ray.e[j] + ray.e[i] * r[j]) - along * q * q * projector);
    }
}

} // namespace ents::ENTS_ISA
