// SPDX-License-Identifier: BSD-3-Clause
// Derivatives of an element's gap, energy and residual by a named parameter theta of its height or law, at
// fixed positions and state:
//   dR/dtheta = R_,theta + R_,xi dxi/dtheta,   dxi/dtheta = - F_,xixi^-1 F_,xi theta   (normal projection)
// The element is evaluated in dual numbers, whose derivatives are those along (theta, xi(theta)):
// theory.md, section 8.
#pragma once

#include "core/element/general_inputs.hpp"
#include "core/projection/target.hpp"

namespace ents::ENTS_ISA {

// The Newton step of the projection, in dual numbers: at the projection its value is zero, its derivative
// dxi/dtheta.
template <class B, class S>
ENTS_INLINE void dual_step(ProjectedPoint<B, true, S>& p, const Ray<S, B::dim>* ray, S (&step)[B::dim - 1]) {
  constexpr int T = B::dim - 1;
  if (ray) {
    Vec<S, B::dim> onto[T], across;
    p.projector.finish(p.xi);
    ray_frame(p.projector.s.e, ray->e, onto, across);
    for (int a = 0; a < T; ++a) step[a] = dot(onto[a], p.projector.s.d);
    return;
  }
  S inverse[symmetric_size<T>];
  invert(p.projector.f2, determinant(p.projector.f2), inverse);
  for (int a = 0; a < T; ++a) {
    step[a] = inverse[symmetric_index(a, 0)] * p.projector.r[0];
    if constexpr (T == 2) step[a] = step[a] + inverse[symmetric_index(a, 1)] * p.projector.r[1];
  }
}

// xi: of the projection. plan.law.rates: of the parameter; parameter: 1 + its index. residual: [dofs] or
// null.
template <class B>
Status evaluate_parameter_rates(const Plan& plan, const ElementInput& in, const double* xi,
                                std::int32_t parameter, ParameterRates& out) {
  using S = Dual<double>;
  constexpr int D = B::dim, T = D - 1, N = dof_count<B, false>;
  ElementNodes<B, S> nodes(basis_of<B>(plan.basis));
  const int count = node_count(nodes.basis);
  for (int i = 0; i < count; ++i)
    for (int c = 0; c < D; ++c) nodes.y[i][c] = S(in.master[D * i + c] - in.slave[c]);
  const double* coordinates = in.surface_coordinates ? in.surface_coordinates : plan.surface_coordinates;
  nodes.has_coordinates = coordinates != nullptr;
  for (int i = 0; coordinates && i < T * count; ++i) nodes.coordinates[i] = S(coordinates[i]);
  HeightNode none{};
  nodes.height = plan.height ? plan.height : &none;
  nodes.parameter = parameter;
  S start[T];
  for (int a = 0; a < T; ++a) start[a] = S(xi[a]);
  ProjectedPoint<B, true, S> point(nodes, start);
  point.area = S(in.area ? *in.area : 1.0);
  point.evaluations = S(0.0);
  point.ordinary = true;
  Ray<S, D> ray;
  const bool shadow = plan.projection != ProjectionKind::normal;
  if (shadow) {
    Target t;
    if (!set_target<D>(plan, in.slave, t)) return Status::grazing_ray;
    for (int c = 0; c < D; ++c) ray.e[c] = S(t.ray[c]);
    ray.inverse_distance = S(t.inverse_distance);
  }
  S step[T];
  point.projector.evaluate(point.xi);
  dual_step(point, shadow ? &ray : nullptr, step);
  for (int a = 0; a < T; ++a) point.xi[a].d = step[a].d;
  point.projector.evaluate(point.xi);

  ContactPoint<B, true, S> at(point);
  at.ray = shadow ? &ray : nullptr;
  at.measure(plan);
  const ElementBlock block = block_of(in, ElementOutput{}, nullptr, 0);
  const GeneralInputs<B, true, double> begin(plan, block, 0);
  SlipBegin<S, T> slip;
  S multiplier[1 + T];
  WornState<S, T> worn;
  slip.known = S(begin.begin.known), slip.clearance = S(begin.begin.clearance);
  slip.time = begin.begin.time;
  for (int a = 0; a < T; ++a) slip.from[a] = S(begin.begin.from[a]);
  for (int a = 0; a < 1 + T; ++a) multiplier[a] = S(begin.multiplier[a]);
  if (begin.has_wear) {
    worn.depth = S(begin.worn.depth), worn.pressure = S(begin.worn.pressure), worn.seen = S(begin.worn.seen);
    for (int a = 0; a < T; ++a) worn.anchor[a] = S(begin.worn.anchor[a]);
    worn.factor = S(begin.worn.factor), worn.sliding_factor = S(begin.worn.sliding_factor);
  }
  at.evaluate_law(plan, slip, begin.has_multiplier ? multiplier : nullptr, begin.has_wear ? &worn : nullptr,
                  S(begin.offset), S(begin.scale), S(begin.bond));
  out.gap = at.gap.d;
  out.energy = point.area.v * at.law.energy.d;
  out.pressure = 0.0 - at.law.force.d;
  out.stiffness = at.law.stiffness.v;
  const int n = plan.dofs;
  for (int i = 0; out.residual && i < n; ++i) out.residual[i] = 0.0;
  double size = absolute(out.gap) + absolute(out.energy);
  if (point.contact && out.residual) {
    S residual[N];
    nodes.basis.template shape<2>(point.xi, point.projector.N);
    at.residual(plan, residual);
    for (int i = 0; i < n; ++i) {
      out.residual[i] = residual[i].d;
      size += absolute(residual[i].d);
    }
  }
  return size < 1e300 ? Status::ok : Status::out_of_range;
}

} // namespace ents::ENTS_ISA
