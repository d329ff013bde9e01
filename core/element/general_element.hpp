// SPDX-License-Identifier: BSD-3-Clause
// One element of any law, projection and tangent at a projection that has been found: what it may be refused
// for, and all of its results.
#pragma once

#include "core/element/general_inputs.hpp"
#include "core/element/multiplier_equations.hpp"
#include "core/element/small_results.hpp"
#include "core/projection/projection.hpp"
#include "core/projection/target.hpp"
#include "core/tangent/symmetrised.hpp"
#include "core/tangent/tangent_sum.hpp"
#include "core/tangent/turning_ray.hpp"

namespace ents::ENTS_ISA {

// TangentSum with `friction`? Multipliers of friction have equations where it has no force, too.
ENTS_INLINE bool sums_friction(const Plan& plan) {
  return plan.law.has_friction_force() || plan.multipliers > 1 || plan.law.wear.on;
}

// What the tangent of an element in contact is the sum of.
template <class Basis, bool Enriched, class Scalar>
ENTS_INLINE Weights<Scalar, Basis::dim - 1>
weights_of_tangent(const Plan& plan, const ContactPoint<Basis, Enriched, Scalar>& at) {
  Weights<Scalar, Basis::dim - 1> sum;
  const bool friction = plan.law.has_friction_force();
  sum.by_gap = at.point.area * at.law.stiffness;
  sum.stiff = true;
  sum.by_slid = plan.law.wear.on ? at.point.area * at.wear.by_slid : Scalar(0.0);
  sum.wears = plan.law.wear.on;
  sum.push = at.point.area * at.law.force;
  for (int a = 0; a < Basis::dim - 1; ++a) sum.force[a] = friction ? at.friction.force[a] : Scalar(0.0);
  sum.second_gap = plan.tangent != TangentKind::first_variation;
  sum.small_gap = plan.tangent == TangentKind::small_gap;
  sum.second_xi = friction && plan.tangent == TangentKind::consistent;
  sum.force_changes = friction;
  return sum;
}

template <class Basis, bool Enriched> struct GeneralElement {
  static constexpr int D = Basis::dim, T = D - 1, N = dof_count<Basis, false>;
  using Sum = TangentSum<Basis, Enriched, double, true>;
  const Plan& plan;
  const ElementInput& in;
  const ElementOutput& out;
  const FoundProjection& found;
  ContactPoint<Basis, Enriched, double>& at;
  const MultiplierEquations<Basis, Enriched, double> multipliers{plan, at, in.multiplier};
  const bool element = (out.wanted & want::element) != 0;
  // flags are those of the element; alone, or with kinematics, they refuse nothing
  const bool verdict_wanted =
      element || ((out.wanted & want::flags) != 0 && plan.law.normal != NormalKind::none);
  std::int32_t more_flags = 0;

  bool wants(std::int32_t bits) const { return (out.wanted & bits) != 0; }

  Status evaluate() {
    auto& point = at.point;
    const bool shadow = at.ray != nullptr;
    point.area = in.area ? *in.area : 1.0;
    point.evaluate_at_solution();
    auto measured = at.measure(plan);
    if (point.is_regular(measured, !shadow)) { // then the bits are those of a block
      point.nodes.basis.template shape<2>(point.xi, point.projector.N);
    } else {
      if (!point.arrive_by_nodes(geometry(), shadow || found.escaped ? nullptr : found.f2))
        return Status::degenerate_segment;
      measured = at.measure(plan, true);
    }
    if (!(measured.area2_e > degenerate_size * degenerate_size * measured.area2))
      return Status::degenerate_segment;
    if (shadow && !(ray_enters())) return Status::grazing_ray;
    if (!(absolute(at.gap) < largest_ingredient) || !(max_norm(point.xi) < 1e15)) return Status::out_of_range;
    point.outside = point.outside || found.escaped;
    const bool far_side = !shadow && !minimum_of(point.projector.f2, point.projector.metric);
    if (far_side) more_flags |= flag::far_side;
    if (found.searched) more_flags |= flag::searched;

    const ElementBlock block = block_of(in, out, nullptr, 0);
    const GeneralInputs<Basis, Enriched, double> begin(plan, block, 0);
    at.evaluate_law(plan, begin.begin, begin.multipliers(), begin.worn_or_null(), begin.offset, begin.scale,
                    begin.bond);
    if (element && !at.solved) return Status::out_of_range;
    if (!verdict_wanted) point.contact = false;
    if (point.contact && element) {
      if (far_side) return Status::singular_projection;
      if (found.ambiguous) return Status::ambiguous_projection;
      if (!at.safe) return Status::grazing_ray; // a ray from behind would push the slave further in
      const double deepest = plan.penetration_limit > 0.0
                                 ? plan.penetration_limit
                                 : (is_simplex(point.nodes.basis) ? 1.0 : 2.0) * square_root(measured.size2);
      if (-at.gap > deepest) return Status::deep_penetration;
    }
    if (at.friction.active && !(determinant(point.projector.metric) > 0.0)) {
      if (element && rubs()) return Status::degenerate_segment;
      at.friction.set_none();
    }
    const bool forces = point.contact && wants(want::residual | want::tangent);
    const bool varies =
        wants(want::xi_gradient | want::xi_hessian | want::gap_hessian) || (forces && rubs()) ||
        (point.contact && wants(want::tangent) && plan.tangent != TangentKind::first_variation);
    if (varies && !shadow && !projection_varies()) return Status::singular_projection;
    return write();
  }

  // Gradients and Hessians of an element of a block, which is at its projection.
  Status evaluate_variations() {
    at.point.nodes.basis.template shape<2>(at.point.xi, at.point.projector.N);
    at.measure(plan);
    at.law = {0.0, 0.0, 0.0, false};
    at.point.contact = false;
    at.friction.set_none();
    return at.ray || projection_varies() ? write() : Status::singular_projection;
  }

private:
  // Has friction a force here?
  bool rubs() const { return at.friction.active && plan.law.has_friction_force(); }
  Geometry<Basis> geometry() const {
    Geometry<Basis> g(at.point.nodes.basis);
    g.set(in.slave, in.master);
    g.surface_coordinates = in.surface_coordinates ? in.surface_coordinates : plan.surface_coordinates;
    g.height = plan.height;
    return g;
  }
  // Is the ray out of the tangent plane?
  bool ray_enters() const {
    const Vec<double, D> m = normal_of_tangents(at.point.projector.s.e);
    const double det = dot(m, at.ray->e);
    return det * det > 1e-20 * dot(m, m);
  }
  bool projection_varies() const {
    const auto& p = at.point.projector;
    const double metric = determinant(p.metric);
    const double det = plan.tangent == TangentKind::small_gap && !rubs() && !wants(want::kinematics)
                           ? metric
                           : determinant(p.f2);
    return metric > 0.0 && absolute(det) > 1e-10 * metric;
  }

  // May every force and small result be computed without leaving the range of double precision?
  bool law_in_range() const {
    const double area = at.point.area;
    double size = area * (absolute(at.law.force) + absolute(at.law.stiffness));
    if (plan.law.wear.on) size += area * (absolute(at.wear.by_slid) + at.wear.slid + absolute(at.wear.lost));
    double tangential = at.friction.active ? sum_of_absolutes(at.friction.force) : 0.0;
    size += tangential;
    if (plan.multipliers > 0) { // they come back in the residual, over a stiffness
      size +=
          area * (1.0 + absolute(at.law_gap) + absolute(in.multiplier[0]) * (1.0 + 1.0 / plan.law.number[0]));
      for (int a = 1; a < plan.multipliers; ++a) tangential += area * absolute(in.multiplier[a]);
      if (plan.multipliers > 1) size += tangential / plan.law.friction_stiffness;
    }
    return size < largest_ingredient;
  }

  Weights<double, T> none() const {
    Weights<double, T> sum{};
    sum.small_gap = plan.tangent == TangentKind::small_gap;
    return sum;
  }

  // Matrices that are wanted, one after the other: f(weights, where it goes, its leading dimension, is it the
  // tangent)
  template <class F> Status for_each_matrix(F&& f) const {
    const int n = node_dofs(plan);
    if (at.point.contact && wants(want::tangent))
      if (const Status s = f(weights_of_tangent(plan, at), out.tangent, out.tangent_leading_dimension, true);
          s != Status::ok)
        return s;
    if (wants(want::gap_hessian) && plan.tangent != TangentKind::first_variation) {
      Weights<double, T> sum = none();
      sum.push = 1.0, sum.second_gap = true;
      if (const Status s = f(sum, out.gap_hessian, n, false); s != Status::ok) return s;
    }
    for (int a = 0; a < T && wants(want::xi_hessian); ++a) {
      Weights<double, T> sum = none();
      sum.force[a] = 1.0, sum.second_xi = true;
      if (const Status s = f(sum, out.xi_hessian + std::int64_t{a} * n * n, n, false); s != Status::ok)
        return s;
    }
    return Status::ok;
  }

  // First all that may leave the range of numbers, then everything is written.
  Status write() const {
    const int n = node_dofs(plan);
    const bool rigid = n == D;
    Sum sum;
    SmallResults<Basis, true, double> small(at);
    small.more_flags = more_flags;
    small.escaped = found.escaped;
    if (element && !(law_in_range() && small_in_range(small))) return Status::out_of_range;
    double residual[N];
    const bool has_residual = at.point.contact && wants(want::residual);
    if (has_residual) {
      at.residual(plan, residual);
      if (!(sum_of_absolutes(residual, dofs_of<false>(at.point.nodes.basis)) < largest_result))
        return Status::out_of_range;
    }
    int matrices = 0;
    if (const Status s =
            for_each_matrix([&](const Weights<double, T>& weights, double*, std::int64_t, bool is_tangent) {
              ++matrices;
              sum.evaluate(plan, at, weights);
              const double bound =
                  sum.bound() + (is_tangent && plan.multipliers > 0 ? multipliers.bound(sum) : 0.0);
              return bound < largest_result ? Status::ok : Status::out_of_range;
            });
        s != Status::ok)
      return s;

    for_each_matrix(
        [&](const Weights<double, T>& weights, double* to, std::int64_t leading, bool is_tangent) {
          if (matrices > 1) sum.evaluate(plan, at, weights);
          if (rigid)
            write_slave(sum, to, leading);
          else
            write_tangent<D>(sum, to, leading);
          if (at.ray) add_turning_ray(Sum::covector_of(at, weights), *at.ray, at.gap, sum.dg, n, to, leading);
          if (is_tangent && plan.multipliers > 0) multipliers.write_tangent(0, &sum, n, to, leading);
          if (is_tangent && plan.law.symmetrised) symmetrise(plan.dofs, to, leading);
          return Status::ok;
        });
    if (wants(want::gap_gradient | want::xi_gradient)) {
      sum.evaluate_first(at);
      for (int i = 0; i < n && wants(want::gap_gradient); ++i) out.gap_gradient[i] = sum.dg[i];
      for (int a = 0; a < T && wants(want::xi_gradient); ++a)
        for (int i = 0; i < n; ++i) out.xi_gradient[a * n + i] = sum.dxi[a][i];
    }
    if (wants(want::gap_hessian) && plan.tangent == TangentKind::first_variation)
      for (int i = 0; i < n * n; ++i) out.gap_hessian[i] = 0.0;
    write_forces(residual);
    small.write(plan, block_of(in, out, in.start, out.wanted), 0, 0);
    return Status::ok;
  }

  void write_forces(const double (&residual)[N]) const {
    const int n = node_dofs(plan);
    if (wants(want::residual)) {
      for (int i = 0; i < n; ++i) out.residual[i] = at.point.contact ? residual[i] : 0.0;
      if (plan.multipliers > 0) multipliers.write_residual(0, out.residual + n);
    }
    if (wants(want::tangent) && !at.point.contact) {
      const std::int64_t leading = out.tangent_leading_dimension;
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) out.tangent[j * leading + i] = 0.0;
      if (plan.multipliers > 0) multipliers.write_open(0, n, out.tangent, leading);
    }
  }

  // The same of what has divisions by areas and stiffnesses: written here first
  bool small_in_range(const SmallResults<Basis, true, double>& small) const {
    double numbers[D + 2 + largest_state] = {};
    ElementBlock here =
        block_of(in, out, in.start, out.wanted & (want::traction | want::energy | want::slip | want::state));
    here.traction = numbers, here.energy = numbers + D, here.slip = numbers + D + 1,
    here.state_end = numbers + D + 2;
    small.write(plan, here, 0, 0);
    return sum_of_absolutes(numbers) < largest_result;
  }
};

// The ray of an element; false: the slave is at the emitter.
template <int D> ENTS_INLINE bool set_ray(const Plan& plan, const double* slave, Ray<double, D>& ray) {
  Target t;
  if (!set_target<D>(plan, slave, t)) return false;
  ray = {ray_of<D>(t), t.inverse_distance};
  return true;
}

// use(point, at) of an element at xi, whose surface is not evaluated there yet; grazing_ray where the slave is
// at the emitter.
template <class Basis, bool Enriched, class Use>
ENTS_INLINE Status at_projection(const Plan& plan, const ElementInput& in, const double* found, Use&& use) {
  constexpr int D = Basis::dim, T = D - 1;
  ElementNodes<Basis, double> nodes(basis_of<Basis>(plan.basis));
  set_nodes<Enriched>(plan, in.slave, in.master,
                      in.surface_coordinates ? in.surface_coordinates : plan.surface_coordinates, nodes);
  double xi[T];
  for (int a = 0; a < T; ++a) xi[a] = found[a];
  ProjectedPoint<Basis, Enriched, double> point(nodes, xi);
  ContactPoint<Basis, Enriched, double> at(point);
  Ray<double, D> ray;
  if (plan.projection != ProjectionKind::normal) {
    if (!set_ray(plan, in.slave, ray)) return Status::grazing_ray;
    at.ray = &ray;
  }
  return use(point, at);
}

// An element that a block has projected: RestKernel
template <class Basis, bool Enriched>
bool evaluate_rest(const Plan& plan, const ElementInput& in, const ElementOutput& out,
                   const ProjectedElement& projected) {
  const Status status = at_projection<Basis, Enriched>(plan, in, projected.xi, [&](auto& point, auto& at) {
    point.area = projected.area;
    point.projector.sine = {projected.sine[0], projected.sine[1], projected.sine[2]};
    point.evaluate_at_solution();
    const FoundProjection found{};
    return GeneralElement<Basis, Enriched>{plan, in, out, found, at}.evaluate_variations();
  });
  return status == Status::ok;
}

template <class Basis, bool Enriched>
Status finish_element(const Plan& plan, const ElementInput& in, const ElementOutput& out,
                      const FoundProjection& found) {
  return at_projection<Basis, Enriched>(plan, in, found.xi, [&](auto& point, auto& at) {
    point.evaluations = found.evaluations;
    point.ordinary = true; // read by the friction law; no block kernel has decided it here
    return GeneralElement<Basis, Enriched>{plan, in, out, found, at}.evaluate();
  });
}

} // namespace ents::ENTS_ISA
