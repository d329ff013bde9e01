// SPDX-License-Identifier: BSD-3-Clause
// The tangent of Coulomb friction (friction_forms.hpp) in the reduced space, where w_a = n . delta a_a
// is on one field alone, w_a' = n' . delta a_a + y^b n . delta a_ab, and delta X . delta X and its derivative
// are numbers times I.
#pragma once

#include "core/tangent/friction_tangent.hpp"
#include "core/tangent/reduced_expansion.hpp"

namespace ents::ENTS_ISA {

template <class Basis, bool Enriched, bool Rigid, class Scalar> struct ReducedFrictionTangent {
  using Forms = FrictionForms<Basis, Enriched, Rigid, Scalar>;
  using Expansion = ReducedExpansion<Basis>;
  using V = Vec<Scalar, Basis::dim>;
  static constexpr int D = Basis::dim, T = D - 1, N = Forms::N, M = Forms::M, K = Forms::K;
  static constexpr bool turns = Forms::turns, bends = Forms::bends;
  static constexpr bool one_by_one = register_width == 4 && !Rigid; // few registers
  static constexpr int fields = fields_of<Basis, Rigid, Forms::parts_of_rate>,
                       fields_of_x = fields_of<Basis, Rigid, Forms::parts>;
  static constexpr int fields_of_g = fields_of<Basis, Rigid, parts_of_p<Enriched>>;
  static constexpr int slopes = Rigid ? 1 : D; // without delta a_kl
  Form<Basis, Scalar> x[T], Y[T], P[T];        // P: Y_a + dt_a
  V n, n_rate;
  Form<Basis, Scalar> Z[turns ? T : 1], z[bends ? T : 1];
  Form<Basis, Scalar> bent_z[bends ? fields - D : 1]; // sum of y^b z_a over both orders of ab
  Scalar stiffness, y[T], xi[T];
  V g[M]; // at the nodes
  bool curved_law;

  ENTS_INLINE void evaluate(const Plan& plan, const ProjectedPoint<Basis, Enriched, Scalar>& point,
                            const Friction<Scalar, Basis::dim - 1>& friction) {
    for (int a = 0; a < T; ++a) xi[a] = point.xi[a];
    stiffness = point.area * point.per_gap;
    Scalar inverse[K];
    Forms::set_direction(point, friction.force, inverse, y);
    Forms::in_part([&]() ENTS_LAMBDA_INLINE {
      const Derivative derivative(point.projector, point.xi, y);
      Forms::in_part(
          [&]() ENTS_LAMBDA_INLINE { set_projection_terms(plan, point, friction, inverse, derivative); });
      if constexpr (turns) Forms::in_part([&]() ENTS_LAMBDA_INLINE { set_height_terms(derivative); });
    });
    curved_law = plan.law.twice_exponent > 2;
    if (curved_law) {
      Form<Basis, Scalar> form;
      form_of_g(plan, point, form);
      V of[fields];
      unroll<fields>([&](auto f) ENTS_LAMBDA_INLINE {
        if constexpr (f.value < fields_of_g)
          of[f] = on_field<f.value>(form);
        else
          of[f] = V::zero();
      });
      expand_fields(*this, of, g);
    }
  }

  // What K has on field `Row`, of component c of field `Column`, but for g g^T
  template <int Row, int Column> ENTS_INLINE V entries(int c) const {
    V sum = V::zero();
    unroll<T>([&](auto a) ENTS_LAMBDA_INLINE {
      constexpr bool first = a.value == 0, with_Y = Column < fields_of_x;
      if constexpr (with_Y) add<first>(sum, on_field<Column>(x[a])[c], on_field<Row>(Y[a]));
      if constexpr (Row < fields_of_x)
        add<first && !with_Y>(sum, on_field<Column>(P[a])[c], on_field<Row>(x[a]));
    });
    if constexpr (turns) add_height_terms<Row, Column>(c, sum);
    if constexpr (Row == 0 && Column == 0)
      add_to_component(sum, c, stiffness);
    else if constexpr (Row == 0 && Column <= T)
      add_to_component(sum, c, -y[Column - 1]);
    else if constexpr (Column == 0 && Row <= T)
      add_to_component(sum, c, -y[Row - 1]);
    return sum;
  }

#if defined(ENTS_HAS_LANES) && defined(__AVX__)
  // Each lane's to one[lane]
  template <class One> ENTS_INLINE void scatter_lanes(One (&one)[4]) const {
    const auto form = [&](auto count, auto of) ENTS_LAMBDA_INLINE {
      unroll<count.value>([&](auto field) ENTS_LAMBDA_INLINE {
        scatter_vector(
            on_field<field.value>(of(*this)), [&](int k) ENTS_LAMBDA_INLINE -> auto& {
              return on_field<field.value>(of(one[k]));
            });
      });
    };
    for (int a = 0; a < T; ++a) {
      form(
          Index<fields_of_x>{}, [a](auto& t) ENTS_LAMBDA_INLINE -> auto& { return t.x[a]; });
      form(
          Index<fields>{}, [a](auto& t) ENTS_LAMBDA_INLINE -> auto& { return t.Y[a]; });
      form(
          Index<fields>{}, [a](auto& t) ENTS_LAMBDA_INLINE -> auto& { return t.P[a]; });
      if constexpr (turns)
        form(
            Index<fields>{}, [a](auto& t) ENTS_LAMBDA_INLINE -> auto& { return t.Z[a]; });
      if constexpr (bends)
        form(
            Index<slopes>{}, [a](auto& t) ENTS_LAMBDA_INLINE -> auto& { return t.z[a]; });
    }
    if constexpr (turns)
      scatter_vector(
          n, [&](int k) ENTS_LAMBDA_INLINE -> auto& { return one[k].n; });
    if constexpr (bends)
      scatter_vector(
          n_rate, [&](int k) ENTS_LAMBDA_INLINE -> auto& { return one[k].n_rate; });
    if constexpr (bends)
      form(
          Index<slopes>{}, [](auto& t) ENTS_LAMBDA_INLINE -> auto& { return t.bent_z[0]; });
    if (curved_law)
      for (int m = 0; m < M; ++m)
        scatter_vector(
            g[m], [&](int k) ENTS_LAMBDA_INLINE -> auto& { return one[k].g[m]; });
    for (int k = 0; k < 4; ++k) {
      one[k].curved_law = curved_law;
      one[k].stiffness = lane(stiffness, k);
      for (int a = 0; a < T; ++a) {
        one[k].y[a] = lane(y[a], k);
        one[k].xi[a] = lane(xi[a], k);
      }
    }
  }
#endif

private:
  using Derivative = typename Forms::Derivative;

  template <bool First = false> static ENTS_INLINE void add(V& sum, const Scalar& factor, const V& v) {
    if constexpr (First)
      sum = factor * v;
    else
      add_scaled(sum, factor, v);
  }

  template <int Parts> static ENTS_INLINE void keep(const Form<Basis, Scalar>& f, Form<Basis, Scalar>& to) {
    unroll<fields_of<Basis, Rigid, Parts>>(
        [&](auto field) ENTS_LAMBDA_INLINE { on_field<field.value>(to) = on_field<field.value>(f); });
  }

  template <int Row, int Column> ENTS_INLINE void add_height_terms(int c, V& sum) const {
    if constexpr (Row > 0 && Row <= T) {
      add(sum, on_field<Column>(Z[Row - 1])[c], n);
      if constexpr (bends && Column < slopes) add(sum, on_field<Column>(z[Row - 1])[c], n_rate);
    }
    if constexpr (Column > 0 && Column <= T) {
      add(sum, n[c], on_field<Row>(Z[Column - 1]));
      if constexpr (bends && Row < slopes) add(sum, n_rate[c], on_field<Row>(z[Column - 1]));
    }
    if constexpr (Row > T && Column < slopes) add(sum, on_field<Column>(bent_z[Row - D])[c], n);
    if constexpr (Column > T && Row < slopes) add(sum, n[c], on_field<Row>(bent_z[Column - D]));
  }

  ENTS_INLINE void set_projection_terms(const Plan& plan,
                                        const ProjectedPoint<Basis, Enriched, Scalar>& point,
                                        const Friction<Scalar, Basis::dim - 1>& friction,
                                        const Scalar (&inverse)[K], const Derivative& derivative) {
    Form<Basis, Dual<Scalar>> f[T];
    forms_of_f(derivative.s, f);
    // (what is added to stays in registers where it is known to be nobody else's)
    Form<Basis, Scalar> value[T], xf[T];
    Forms::set_x(f, inverse, value, xf);
    const typename Forms::ChangeOfForce change(point, friction, false);
    Form<Basis, Scalar> gap;
    form_of_p<Basis, Enriched>(point.projector.s, point.normal, gap);
    for_each_coordinate<T, Scalar>([&](int a) ENTS_LAMBDA_INLINE {
      Form<Basis, Scalar> rate, Yf, Pf;
      Forms::set_Y(a, derivative, stiffness, f, xf, rate, Yf);
      Forms::template set_P<true>(a, derivative, stiffness, rate, xf, change,
                                  Forms::by_gap(a, plan, point, friction), gap, Pf);
      keep<Forms::parts>(xf[a], x[a]);
      keep<Forms::parts_of_rate>(Yf, Y[a]);
      keep<Forms::parts_of_rate>(Pf, P[a]);
    });
  }

  ENTS_INLINE void set_height_terms(const Derivative& derivative) {
    Form<Basis, Dual<Scalar>> moving_z[T];
    forms_of_z<Basis>(derivative.s, moving_z);
    n = derivative.p.s.n;
    Form<Basis, Scalar> zf[T];
    for_each_coordinate<T, Scalar>([&](int a) ENTS_LAMBDA_INLINE {
      Form<Basis, Scalar> Zf;
      Forms::set_Z(moving_z[a], derivative, stiffness, zf[a], Zf);
      keep<Forms::parts_of_z_rate>(Zf, Z[a]);
      if constexpr (bends) keep<Forms::parts_of_z>(zf[a], z[a]);
    });
    if constexpr (bends) {
      n_rate = derivative_of(derivative.s.n);
      unroll<K>([&](auto k) ENTS_LAMBDA_INLINE {
        constexpr int a = k / 2, b = (k + 1) / 2;
        if constexpr (Basis::second[k]) {
          Form<Basis, Scalar> sum;
          set_form<Forms::parts_of_z>(sum, derivative.y[b], zf[a]);
          if constexpr (a != b) add_form<Forms::parts_of_z>(sum, derivative.y[a], zf[b]);
          keep<Forms::parts_of_z>(sum, bent_z[OnCurvatures<Basis, V>::before(k)]);
        }
      });
    }
  }
};

// Where it is the faster way (measured)
template <class Basis, bool Enriched, bool Rigid, class Scalar>
using FrictionTangentOf =
    std::conditional_t<std::is_same_v<Basis, Tri3> || (Enriched && std::is_same_v<Basis, Quad4>),
                       ReducedFrictionTangent<Basis, Enriched, Rigid, Scalar>,
                       FrictionTangent<Basis, Enriched, Rigid, Scalar>>;

} // namespace ents::ENTS_ISA
