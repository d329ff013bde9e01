// SPDX-License-Identifier: BSD-3-Clause
// What the heat of an element depends on, at a projection that has been found, and the variations of it: gap,
// place, pressure, and what friction dissipates (theory.md, section 7.5). HeatKernel
#pragma once

#include "core/element/general_element.hpp"

namespace ents::ENTS_ISA {

template <class Basis, bool Enriched> class HeatIngredientsOf {
public:
  static constexpr int D = Basis::dim, T = D - 1, K = symmetric_size<T>;
  using At = ContactPoint<Basis, Enriched, double>;
  using Inputs = GeneralInputs<Basis, Enriched, double>;

  HeatIngredientsOf(const Plan& plan, const At& at, const Inputs& begin, HeatIngredients& out)
      : plan_(plan), at_(at), begin_(begin), n_(node_dofs(plan)), out_(out) {}

  void write() {
    const auto& point = at_.point;
    first_.evaluate_first(at_);
    out_.contact = point.contact, out_.outside = point.outside;
    out_.gap = at_.law_gap + (begin_.has_wear ? begin_.worn.depth : 0.0);
    out_.pressure = -at_.law.force;
    const int count = node_count(point.nodes.basis);
    for (int i = 0; i < count; ++i) {
      out_.shape[i] = point.projector.N.n[i];
      for (int a = 0; a < T; ++a) out_.shape_slope[a][i] = point.projector.N.d1[a][i];
    }
    for (int i = 0; i < plan_.dofs; ++i) {
      out_.gap_by[i] = i < n_ ? first_.dg[i] : 0.0;
      for (int a = 0; a < T; ++a) out_.xi_by[a][i] = i < n_ ? first_.dxi[a][i] : 0.0;
      out_.pressure_by[i] = out_.dissipation_by[i] = 0.0;
    }
    if (point.contact) set_pressure();
    out_.dissipation = 0.0;
    if (plan_.law.heat.has_friction && at_.friction.active && at_.friction.slip) set_dissipation();
  }

private:
  using Array = DofArray<Basis, false, double>;

  // dp = - dW'
  void set_pressure() {
    for (int i = 0; i < n_; ++i) out_.pressure_by[i] = -at_.law.stiffness * first_.dg[i];
    if (plan_.law.multiplier_is_dof()) out_.pressure_by[n_] = 1.0;
    if (!begin_.has_wear) return;
    double by_xi[T];
    at_.slid_by_xi(by_xi);
    Vec<double, D> covector[T];
    for (int b = 0; b < T; ++b) covector[b] = at_.wear.moved[b] * at_.wear.m;
    add_slopes(-at_.wear.by_slid, covector, out_.pressure_by);
    for (int i = 0; i < n_; ++i)
      for (int a = 0; a < T; ++a) out_.pressure_by[i] -= at_.wear.by_slid * by_xi[a] * first_.dxi[a][i];
  }

  // to += factor covector[b] . (variation of rho_e,b at fixed xi)
  void add_slopes(double factor, const Vec<double, D> (&covector)[T], double* to) const {
    unroll<T>([&](auto b) ENTS_LAMBDA_INLINE {
      Form<Basis, double> f;
      Array own;
      form_of_slope<b.value, Basis, Enriched>(at_.point.projector.s, covector[b], f);
      expand_to_dofs<false, parts_of_slope<Basis, Enriched>>(at_.point.nodes.basis, f, at_.point.projector.N,
                                                             own);
      for (int i = 0; i < n_; ++i) to[i] += factor * own[i];
    });
  }

  // What the dissipation depends on: xi, the metric, p A, the depth since the touch, multipliers that are dofs
  static constexpr int by_metric = T, by_force = T + K, by_depth = T + K + 1, by_multiplier = T + K + 2,
                       most_arguments = 2 * T + K + 2;

  // D with its derivative by one of them
  Dual<double> dissipation_along(int argument) const {
    using S = Dual<double>;
    const auto seeded = [argument](double value, int place) {
      return S(value, argument == place ? 1.0 : 0.0);
    };
    const ContactLaw& law = plan_.law;
    S xi[T], metric[K], multiplier[T];
    for (int a = 0; a < T; ++a) xi[a] = seeded(at_.point.xi[a], a);
    for (int k = 0; k < K; ++k) metric[k] = seeded(at_.point.projector.metric[k], by_metric + k);
    for (int a = 0; a < T; ++a) multiplier[a] = seeded(begin_.multiplier[1 + a], by_multiplier + a);
    const S area(at_.point.area), force = seeded(pressing_force(), by_force);
    SlipBegin<S, T> from;
    const bool touched = law.multiplier_is_dof() && begin_.begin.clearance > 0.0;
    from.known = S(touched ? 0.0 : begin_.begin.known), from.clearance = S(begin_.begin.clearance);
    for (int a = 0; a < T; ++a) from.from[a] = S(begin_.begin.from[a]);
    SlipShare<S> slipping;
    if (at_.slipping.some) slipping = slip_share(from.clearance, seeded(-at_.clearance, by_depth));
    Friction<S, T> friction;
    from.time = begin_.begin.time;
    friction.template evaluate<true>(law, {xi, metric, area, true}, from, slipping, force,
                                     begin_.has_multiplier ? multiplier : nullptr);
    return dissipation_of(law, friction);
  }

  // That friction acts on
  double pressing_force() const {
    if (!plan_.law.pulls) return -(at_.point.area * at_.law.force);
    return at_.point.area * rubbing_pressure(plan_.law, at_.law.force, at_.law_gap, begin_.scale);
  }

  void set_dissipation() {
    double by[most_arguments];
    const int arguments = plan_.multipliers > 1 ? most_arguments : by_multiplier;
    for (int i = 0; i < arguments; ++i) {
      const Dual<double> d = dissipation_along(i);
      out_.dissipation = d.v, by[i] = d.d;
    }
    const auto& s = at_.point.projector.s;
    Vec<double, D> covector[T];
    for (int a = 0; a < T; ++a) { // A_ab = rho_e,a . rho_e,b
      covector[a] = Vec<double, D>::zero();
      for (int b = 0; b < T; ++b)
        add_scaled(covector[a], (a == b ? 2.0 : 1.0) * by[by_metric + symmetric_index(a, b)], s.e[b]);
    }
    double by_xi[T];
    for (int c = 0; c < T; ++c) {
      by_xi[c] = by[c];
      for (int b = 0; b < T; ++b) by_xi[c] += dot(covector[b], s.e2[symmetric_index(b, c)]);
    }
    double* const to = out_.dissipation_by;
    add_slopes(1.0, covector, to);
    for (int i = 0; i < n_; ++i) {
      to[i] -= by[by_depth] * first_.dg[i];
      for (int a = 0; a < T; ++a) to[i] += by_xi[a] * first_.dxi[a][i];
    }
    for (int i = 0; i < plan_.dofs; ++i) to[i] += by[by_force] * at_.point.area * out_.pressure_by[i];
    for (int a = 0; a < T && plan_.multipliers > 1; ++a) to[n_ + 1 + a] += by[by_multiplier + a];
  }

  const Plan& plan_;
  const At& at_;
  const Inputs& begin_;
  const int n_;
  HeatIngredients& out_;
  TangentSum<Basis, Enriched, double, true> first_;
};

template <class Basis, bool Enriched>
Status evaluate_heat_ingredients(const Plan& plan, const ElementInput& in, const double* xi,
                                 HeatIngredients& out) {
  return at_projection<Basis, Enriched>(plan, in, xi, [&](auto& point, auto& at) {
    point.area = out.area = in.area ? *in.area : 1.0;
    point.evaluations = 0.0, point.ordinary = true;
    point.evaluate_at_solution();
    const bool shadow = at.ray != nullptr;
    if (point.is_regular(at.measure(plan), !shadow)) {
      point.nodes.basis.template shape<2>(point.xi, point.projector.N);
    } else {
      Geometry<Basis> g(point.nodes.basis);
      g.set(in.slave, in.master);
      g.surface_coordinates = in.surface_coordinates ? in.surface_coordinates : plan.surface_coordinates;
      g.height = plan.height;
      if (!point.arrive_by_nodes(g, nullptr)) return Status::degenerate_segment;
      at.measure(plan, true);
    }
    const auto& p = point.projector;
    const double metric = determinant(p.metric);
    if (!shadow && !(metric > 0.0 && absolute(determinant(p.f2)) > 1e-10 * metric))
      return Status::singular_projection;
    const ElementBlock block = block_of(in, ElementOutput{}, nullptr, 0);
    const GeneralInputs<Basis, Enriched, double> begin(plan, block, 0);
    at.evaluate_law(plan, begin.begin, begin.multipliers(), begin.worn_or_null(), begin.offset, begin.scale,
                    begin.bond);
    HeatIngredientsOf<Basis, Enriched>(plan, at, begin, out).write();
    return Status::ok;
  });
}

} // namespace ents::ENTS_ISA
