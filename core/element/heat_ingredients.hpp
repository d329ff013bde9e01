// SPDX-License-Identifier: BSD-3-Clause
// What the heat of an element depends on, at a projection that has been found, and the variations of it: gap,
// place, pressure, and what friction dissipates (theory.md, section 7.5). HeatKernel
#pragma once

#include "core/element/general_element.hpp"

namespace ents::ENTS_ISA {

// Of one element, or of each lane's
template <class Basis, bool Enriched, class Scalar> class HeatIngredientsOf {
public:
  static constexpr int D = Basis::dim, T = D - 1, K = symmetric_size<T>, N = dof_count<Basis, false> + 1 + T,
                       W = width_of<Scalar>;
  using At = ContactPoint<Basis, Enriched, Scalar>;
  using Inputs = GeneralInputs<Basis, Enriched, Scalar>;

  HeatIngredientsOf(const Plan& plan, const At& at, const Inputs& begin)
      : plan_(plan), at_(at), begin_(begin), n_(node_dofs(plan)), contact_(bits_of(at.point.contact)),
        outside_(bits_of(at.point.outside)) {}

  void evaluate() {
    first_.evaluate_first(at_);
    for (int i = 0; i < plan_.dofs; ++i) pressure_by_[i] = dissipation_by_[i] = Scalar(0.0);
    if (contact_) set_pressure();
    dissipation_ = Scalar(0.0);
    if (plan_.law.heat.has_friction) slips_ = bits_of(both(at_.friction.active, at_.friction.slip));
    if (slips_) set_dissipation();
  }

  // Of lane k; all but the area, which a multiplier's law changes
  void write(int k, HeatIngredients& out) const {
    const auto& point = at_.point;
    const bool contact = contact_ >> k & 1, slips = slips_ >> k & 1;
    out.contact = contact, out.outside = outside_ >> k & 1;
    out.gap = lane(at_.law_gap, k) + (begin_.has_wear ? lane(begin_.worn.depth, k) : 0.0);
    out.pressure = -lane(at_.law.force, k);
    out.dissipation = slips ? lane(dissipation_, k) : 0.0;
    const int count = node_count(point.nodes.basis);
    for (int i = 0; i < count; ++i) {
      out.shape[i] = lane(point.projector.N.n[i], k);
      for (int a = 0; a < T; ++a) out.shape_slope[a][i] = lane(point.projector.N.d1[a][i], k);
    }
    for (int i = 0; i < plan_.dofs; ++i) {
      out.gap_by[i] = i < n_ ? lane(first_.dg[i], k) : 0.0;
      for (int a = 0; a < T; ++a) out.xi_by[a][i] = i < n_ ? lane(first_.dxi[a][i], k) : 0.0;
      out.pressure_by[i] = contact ? lane(pressure_by_[i], k) : 0.0;
      out.dissipation_by[i] = slips ? lane(dissipation_by_[i], k) : 0.0;
    }
  }

private:
  using Array = DofArray<Basis, false, Scalar>;

  // dp = - dW'
  void set_pressure() {
    for (int i = 0; i < n_; ++i) pressure_by_[i] = -at_.law.stiffness * first_.dg[i];
    if (plan_.law.multiplier_is_dof()) pressure_by_[n_] = Scalar(1.0);
    if (!begin_.has_wear) return;
    Scalar by_xi[T];
    at_.slid_by_xi(by_xi);
    Vec<Scalar, D> covector[T];
    for (int b = 0; b < T; ++b) covector[b] = at_.wear.moved[b] * at_.wear.m;
    add_slopes(-at_.wear.by_slid, covector, pressure_by_);
    for (int i = 0; i < n_; ++i)
      for (int a = 0; a < T; ++a)
        pressure_by_[i] = pressure_by_[i] - at_.wear.by_slid * by_xi[a] * first_.dxi[a][i];
  }

  // to += factor covector[b] . (variation of rho_e,b at fixed xi)
  void add_slopes(const Scalar& factor, const Vec<Scalar, D> (&covector)[T], Scalar* to) const {
    unroll<T>([&](auto b) ENTS_LAMBDA_INLINE {
      Form<Basis, Scalar> f;
      Array own;
      form_of_slope<b.value, Basis, Enriched>(at_.point.projector.s, covector[b], f);
      expand_to_dofs<false, parts_of_slope<Basis, Enriched>>(at_.point.nodes.basis, f, at_.point.projector.N,
                                                             own);
      for (int i = 0; i < n_; ++i) to[i] = to[i] + factor * own[i];
    });
  }

  // What the dissipation depends on: xi, the metric, p A, the depth since the touch, multipliers that are dofs
  static constexpr int by_metric = T, by_force = T + K, by_depth = T + K + 1, by_multiplier = T + K + 2,
                       most_arguments = 2 * T + K + 2;

  // D of lane k with its derivative by one of them
  ENTS_NOINLINE Dual<double> dissipation_along(int k, int argument) const {
    using S = Dual<double>;
    const auto seeded = [argument](double value, int place) {
      return S(value, argument == place ? 1.0 : 0.0);
    };
    const ContactLaw& law = plan_.law;
    S xi[T], metric[K], multiplier[T];
    for (int a = 0; a < T; ++a) xi[a] = seeded(lane(at_.point.xi[a], k), a);
    for (int m = 0; m < K; ++m) metric[m] = seeded(lane(at_.point.projector.metric[m], k), by_metric + m);
    for (int a = 0; a < T; ++a) multiplier[a] = seeded(lane(begin_.multiplier[1 + a], k), by_multiplier + a);
    const S area(lane(at_.point.area, k)), force = seeded(pressing_force(k), by_force);
    const double clearance = lane(begin_.begin.clearance, k);
    SlipBegin<S, T> from;
    const bool touched = law.multiplier_is_dof() && clearance > 0.0;
    from.known = S(touched ? 0.0 : lane(begin_.begin.known, k)), from.clearance = S(clearance);
    for (int a = 0; a < T; ++a) from.from[a] = S(lane(begin_.begin.from[a], k));
    SlipShare<S> slipping;
    if (at_.slipping.some) slipping = slip_share(from.clearance, seeded(-lane(at_.clearance, k), by_depth));
    Friction<S, T> friction;
    from.time = begin_.begin.time;
    evaluate_friction(law, FrictionPlace<S, T>{xi, metric, area, true}, from, slipping, force,
                      begin_.has_multiplier ? static_cast<const S*>(multiplier) : nullptr, friction);
    return dissipation_of(law, friction);
  }

  // That friction acts on
  double pressing_force(int k) const {
    const double area = lane(at_.point.area, k), force = lane(at_.law.force, k);
    if (!plan_.law.pulls) return -(area * force);
    return area * rubbing_pressure(plan_.law, force, lane(at_.law_gap, k), lane(begin_.scale, k));
  }

  void set_dissipation() {
    Scalar by[most_arguments];
    const int arguments = plan_.multipliers > 1 ? most_arguments : by_multiplier;
    for (int i = 0; i < arguments; ++i) {
      double value[W] = {}, slope[W] = {};
      for (int k = 0; k < W; ++k)
        if (slips_ >> k & 1) {
          const Dual<double> d = dissipation_along(k, i);
          value[k] = d.v, slope[k] = d.d;
        }
      dissipation_ = of_each<Scalar>([&](int k) ENTS_LAMBDA_INLINE { return value[k]; });
      by[i] = of_each<Scalar>([&](int k) ENTS_LAMBDA_INLINE { return slope[k]; });
    }
    const auto& s = at_.point.projector.s;
    Vec<Scalar, D> covector[T];
    for (int a = 0; a < T; ++a) { // A_ab = rho_e,a . rho_e,b
      covector[a] = Vec<Scalar, D>::zero();
      for (int b = 0; b < T; ++b)
        add_scaled(covector[a], (a == b ? 2.0 : 1.0) * by[by_metric + symmetric_index(a, b)], s.e[b]);
    }
    Scalar by_xi[T];
    for (int c = 0; c < T; ++c) {
      by_xi[c] = by[c];
      for (int b = 0; b < T; ++b) by_xi[c] = by_xi[c] + dot(covector[b], s.e2[symmetric_index(b, c)]);
    }
    Scalar* const to = dissipation_by_;
    add_slopes(Scalar(1.0), covector, to);
    for (int i = 0; i < n_; ++i) {
      to[i] = to[i] - by[by_depth] * first_.dg[i];
      for (int a = 0; a < T; ++a) to[i] = to[i] + by_xi[a] * first_.dxi[a][i];
    }
    for (int i = 0; i < plan_.dofs; ++i) to[i] = to[i] + by[by_force] * at_.point.area * pressure_by_[i];
    for (int a = 0; a < T && plan_.multipliers > 1; ++a)
      to[n_ + 1 + a] = to[n_ + 1 + a] + by[by_multiplier + a];
  }

  const Plan& plan_;
  const At& at_;
  const Inputs& begin_;
  const int n_;
  std::uint32_t contact_, outside_, slips_ = 0; // bits of lanes
  Scalar dissipation_, pressure_by_[N], dissipation_by_[N];
  TangentSum<Basis, Enriched, Scalar, true> first_;
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
    HeatIngredientsOf<Basis, Enriched, double> heat(plan, at, begin);
    heat.evaluate();
    heat.write(0, out);
    return Status::ok;
  });
}

} // namespace ents::ENTS_ISA
