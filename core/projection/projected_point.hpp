// SPDX-License-Identifier: BSD-3-Clause
// An element on its way to its projection: xi, gap, normal and the surface there, found by Newton's method
// from a start next to it. It serves every law and both projections, for one element (Scalar = double) or one per
// lane; both run the same operations in the same order. Whatever is not ordinary (no start, a projection that
// needs care, an edge of the range of numbers, an error) is left to evaluate_element().
//
// evaluate_law() is that of a law with a slope (power.hpp) under normal projection: F = |x_s - rho_e|^2 / 2 is
// g^2 / 2 at its minimum, so that with s the weights of delta X = x_s - rho and f_a = - F_,xi_a u
//   dg dg^T + g D2g = D2F* = F_uu - f F_,xixi^-1 f,   F_uu = s s^T I + sum_k (w_k z_k^T + z_k w_k^T)
//   K = A [ W'/g D2F* + (W'' - W'/g) dg dg^T ]
// W'/g is finite where the pressure vanishes with the gap.
#pragma once

#include "core/law/friction_point.hpp"
#include "core/model/plan.hpp"
#include "core/projection/projection.hpp"
#include "core/surface/surface_at.hpp"

namespace ents::ENTS_ISA {

inline constexpr int most_projection_steps = 8;

template <int K, class Scalar>
ENTS_INLINE Truth<Scalar> minimum_of(const Scalar (&f2)[K], const Scalar (&metric)[K]) {
  return both(f2[0] > 1e-8 * metric[0], determinant(f2) > 1e-8 * determinant(metric));
}

template <class Basis, bool Enriched, class Scalar> struct ProjectedPoint {
  static constexpr int D = Basis::dim, T = D - 1, K = symmetric_size<T>;
  const ElementNodes<Basis, Scalar>& nodes;
  Scalar area, xi[T];
  Scalar evaluations, per_gap; // W'/g per area, 0 where open
  Vec<Scalar, D> gap_vector;   // g n_e
  Scalar gap;                  // g
  Vec<Scalar, D> normal;       // and n_e, where they are measured
  Truth<Scalar> ordinary, contact, outside;
  SurfaceAt<Basis, Enriched, Scalar> projector;

  ENTS_INLINE ProjectedPoint(const ElementNodes<Basis, Scalar>& y, const Scalar (&start)[T])
      : nodes(y), projector(nodes) {
    for (int a = 0; a < T; ++a) xi[a] = start[a];
  }
  ProjectedPoint(const ProjectedPoint&) = delete;

  // The surface at xi by sums over the nodes, which keep their accuracy where a segment is nearly degenerate.
  // False: it is. f2: F_,xixi, if it is known.
  ENTS_INLINE bool arrive_by_nodes(const Geometry<Basis>& g, const double* f2) {
    auto& p = projector;
    if (!evaluate_surface<2>(g, xi, p.N, p.s)) return false;
    for (int k = 0; k < K; ++k) {
      p.metric[k] = dot(p.s.e[k / 2], p.s.e[(k + 1) / 2]);
      p.f2[k] = f2 ? f2[k] : p.metric[k] - dot(p.s.d, p.s.e2[k]);
    }
    if constexpr (is_flat<Basis> && Enriched) p.zeta = dot(p.s.n, p.s.d) + p.s.height.h;
    return true;
  }

  FrictionPlace<Scalar, T> place() const { return {xi, projector.metric, area, contact}; }

  ENTS_INLINE Truth<Scalar> has_area() const { return both(area >= 0.0, area < safe_magnitude); }

  // Is the slave above all of the enriched segment, so that a projection could only find it open? False: not
  // known.
  //   flat           rho_e is a graph over the plane: n_e . n > 0, and x_s - rho_e = g n_e has the component
  //                  zeta - h > 0 along n
  //   quad4, plain   rho is a graph over the plane of its middle if its normals are on the side of that
  //                  normal; they and rho are bilinear, so their corners decide
  ENTS_INLINE Truth<Scalar> is_clearly_open(const Plan& plan) const {
    if constexpr (is_flat<Basis>) {
      if constexpr (Enriched)
        return projector.zeta > Scalar(plan.height_bound);
      else
        return dot(normal_of_tangents(projector.s.a), projector.offset) > Scalar(0.0);
    } else if constexpr (std::is_same_v<Basis, Quad4> && !Enriched) {
      const auto& rho = projector.rho;
      const Vec<Scalar, 3> middle = cross(rho.c1, rho.c2), turn_1 = cross(rho.c1, rho.c12),
                           turn_2 = cross(rho.c12, rho.c2);
      const Scalar reach = Scalar(1.0 + plan.border), size = dot(middle, middle);
      Truth<Scalar> open = size > reach * (absolute(dot(middle, turn_1)) + absolute(dot(middle, turn_2)));
      const Scalar height = dot(middle, rho.c), along_1 = reach * dot(middle, rho.c1),
                   along_2 = reach * dot(middle, rho.c2), warp = reach * reach * dot(middle, rho.c12);
      return both(open, -height > absolute(along_1) + absolute(along_2) + absolute(warp));
    } else {
      return Scalar(1.0) < Scalar(0.0);
    }
  }

  // Newton's method with full steps. Not ordinary: a step that does not descend, is long or leaves the
  // segment far behind. step_at(xi, step, twice_merit): the step from xi; where is it one? floor: rounding of
  // twice_merit
  template <class Step> ENTS_INLINE void descend(const Scalar& floor, Step&& step_at) {
    Scalar step[T], previous_length = Scalar(0.0),
                    previous_merit = Scalar(2.0 * safe_magnitude * safe_magnitude);
    evaluations = Scalar(0.0);
    Truth<Scalar> active = evaluations >= 0.0;
    ordinary = active;
    for (int count = 1; count < most_projection_steps; ++count) {
      Scalar twice_merit;
      Truth<Scalar> fine = step_at(xi, step, twice_merit);
      evaluations = select(active, evaluations + 1.0, evaluations);
      Scalar length = absolute(step[0]);
      if constexpr (T == 2) length = larger(length, absolute(step[1]));
      fine = both(both(fine, length <= max_step), twice_merit <= previous_merit * (1.0 + 1e-12) + floor);
      Scalar size = Scalar(0.0);
      for (int a = 0; a < T; ++a) {
        step[a] = xi[a] + step[a];
        size = size + absolute(step[a]);
      }
      fine = both(fine, size <= far_outside);
      ordinary = without(ordinary, without(active, fine));
      active = both(active, fine);
      active = both(active, length > 1e-15);
      if (!any(active)) break;
      // quadratic convergence: see project() of projection.hpp
      const Truth<Scalar> last =
          either(length <= 1e-13, both(length < 1e-4, 10.0 * length * length * length <=
                                                          1e-16 * previous_length * previous_length));
      // one element, or all of them: the next step does not wait for what this one is compared with
      if (every(active)) {
        for (int a = 0; a < T; ++a) xi[a] = step[a];
      } else {
        for (int a = 0; a < T; ++a) xi[a] = select(active, step[a], xi[a]);
      }
      evaluations =
          select(both(active, last), evaluations + 1.0, evaluations); // that of evaluate_at_solution()
      active = without(active, last);
      previous_length = length;
      previous_merit = twice_merit;
      if (!any(active)) break;
    }
    ordinary = without(ordinary, active);
  }

  ENTS_INLINE void project() {
    if constexpr (SurfaceAt<Basis, Enriched, Scalar>::closed_form) {
      for (int a = 0; a < T; ++a) xi[a] = projector.foot[a];
      evaluations = Scalar(1.0);
      ordinary = evaluations > 0.0;
    } else {
      using Descent = typename DescentOf<Basis, Enriched, Scalar>::type;
      Descent p(projector);
      descend(std::remove_reference_t<Descent>::rounding * dot(nodes.y[0], nodes.y[0]),
              [&](const Scalar(&at)[T], Scalar(&step)[T], Scalar& twice_merit) ENTS_LAMBDA_INLINE {
                p.evaluate(at);
                if constexpr (T == 1) {
                  step[0] = unchecked_ratio(p.r[0], p.f2[0]);
                } else {
                  const Scalar q = unchecked_inverse(determinant(p.f2));
                  step[0] = (p.f2[2] * p.r[0] - p.f2[1] * p.r[1]) * q;
                  step[1] = (p.f2[0] * p.r[1] - p.f2[1] * p.r[0]) * q;
                }
                twice_merit = p.twice_merit;
                return minimum_of(p.f2, p.metric);
              });
    }
  }

  // The same along a ray e: the merit is the distance from it.
  ENTS_INLINE void project_along(const Vec<Scalar, D>& e) {
    descend(SurfaceAt<Basis, Enriched, Scalar>::rounding * dot(nodes.y[0], nodes.y[0]),
            [&](const Scalar(&at)[T], Scalar(&step)[T], Scalar& twice_merit) ENTS_LAMBDA_INLINE {
              auto& p = projector;
              if constexpr (!SurfaceAt<Basis, Enriched, Scalar>::closed_form) p.evaluate(at);
              if constexpr (is_flat<Basis>) p.finish(at);
              Vec<Scalar, D> onto[T], across, off = p.s.d;
              const Truth<Scalar> fine = ray_frame(p.s.e, e, onto, across);
              for (int a = 0; a < T; ++a) step[a] = dot(onto[a], p.s.d);
              add_scaled(off, -dot(p.s.d, e), e);
              twice_merit = dot(off, off);
              return fine;
            });
  }

  // The surface at the projection.
  ENTS_INLINE void evaluate_at_solution() {
    if constexpr (!SurfaceAt<Basis, Enriched, Scalar>::closed_form) projector.evaluate(xi);
  }

  // What the law needs to know of the gap: g |m|, |m|^2 of the enriched and of the plain segment, and the
  // squared size of the segment.
  struct Measured {
    Scalar across, area2_e, area2, size2;
  };

  // Gap and normal. A penalty's forces need neither g nor n_e, which cost a root.
  ENTS_INLINE Measured measure(const Plan& plan, bool measures) {
    return measure_at(plan, measures, projector.finish(xi));
  }

  // The same where the surface is complete; area2: |a|^2 or |a_1 x a_2|^2
  ENTS_INLINE Measured measure_at(const Plan& plan, bool measures, const Scalar& area2,
                                  bool from_foot = true) {
    auto& p = projector;
    Measured at;
    at.area2 = area2;
    const Vec<Scalar, D> m = Enriched ? normal_of_tangents(p.s.e) : normal_of_tangents(p.s.a);
    at.area2_e = Enriched ? dot(m, m) : at.area2;
    if constexpr (is_flat<Basis> && !Enriched)
      at.across = dot(from_foot ? p.offset : p.s.d, m);
    else
      at.across = dot(p.s.d, m);
    gap_vector = unchecked_ratio(at.across, at.area2_e) * m;
    if (measures) {
      const Scalar q = unchecked_inverse(square_root(at.area2_e));
      normal = q * m;
      gap = at.across * q;
    } else {
      normal = Vec<Scalar, D>::zero();
      gap = Scalar(0.0);
    }
    at.size2 = dot(p.s.a[0], p.s.a[0]);
    if constexpr (T == 2) at.size2 = at.size2 + dot(p.s.a[1], p.s.a[1]);
    if (is_simplex(nodes.basis)) {
      outside = either(either(xi[0] < -plan.border, xi[T - 1] < -plan.border),
                       xi[0] + xi[T - 1] - 1.0 > plan.border);
    } else {
      outside = absolute(xi[0]) - 1.0 > plan.border;
      if constexpr (T == 2) outside = either(outside, absolute(xi[1]) - 1.0 > plan.border);
    }
    return at;
  }

  // Is the surface far from degenerate, and every number far from the ends of the range? closest: is it the
  // closest point, too?
  ENTS_INLINE Truth<Scalar> is_regular(const Measured& at, bool closest = true) const {
    const auto& p = projector;
    const int count = node_count(nodes.basis);
    Truth<Scalar> regular = has_area();
    if constexpr (Enriched) {
      regular = both(regular, at.area2_e > degenerate_size * at.area2);
      Scalar heights = absolute(p.s.height.h);
      for (const Scalar& h : p.s.height.h1) heights = heights + absolute(h);
      for (const Scalar& h : p.s.height.h2) heights = heights + absolute(h);
      regular = both(regular, heights < safe_magnitude);
      if (nodes.has_coordinates) {
        Scalar far = absolute(nodes.coordinates[0]);
        for (int i = 1; i < T * count; ++i) far = far + absolute(nodes.coordinates[i]);
        regular = both(regular, far < safe_magnitude);
      }
    }
    Scalar reach2 = dot(nodes.y[0], nodes.y[0]);
    for (int i = 1; i < count; ++i) reach2 = reach2 + dot(nodes.y[i], nodes.y[i]);
    // degenerate segments: the margins of Geometry::smallest_area2, and more. On a plane xi comes from normal
    // equations, whose error grows with the square of the ratio of the sides: up to 100
    constexpr double flattest = is_flat<Basis> && T == 2 ? 1e-4 : 1e-20;
    const Scalar& size2 = at.size2;
    const Scalar small =
        flattest * (T == 2 ? size2 * size2 : size2) + 1e-26 * reach2 * (T == 2 ? size2 : Scalar(1.0));
    regular = both(regular, closest ? both(at.area2 > small, minimum_of(p.f2, p.metric)) : at.area2 > small);
    return both(regular, both(at.area2 > 1.0 / (safe_magnitude * safe_magnitude),
                              reach2 < safe_magnitude * safe_magnitude));
  }

  // Is it so deep that the careful kernel has to decide whether that is too deep? across: g |m|
  ENTS_INLINE Truth<Scalar> is_deep(const Plan& plan, const Measured& at, const Scalar& across) const {
    const Scalar deep2 = plan.penetration_limit > 0.0
                             ? Scalar(plan.penetration_limit * plan.penetration_limit)
                             : (is_simplex(nodes.basis) ? 1.0 : 4.0) * at.size2;
    return across * across >= 0.99 * deep2 * at.area2_e;
  }

  // Gap, force and status of a law that has a slope.
  template <class Law> ENTS_INLINE void evaluate_law(const Plan& plan, bool measures) {
    const Measured at = measure(plan, measures);
    ordinary = both(ordinary, is_regular(at));
    contact = without(at.across <= 0.0, outside);
    per_gap = Law::force_per_gap(plan.law, gap);
    ordinary = both(ordinary, area * per_gap < safe_magnitude);
    ordinary = without(ordinary, both(contact, is_deep(plan, at, at.across)));
    per_gap = select(contact, per_gap, Scalar(0.0));
  }
};

} // namespace ents::ENTS_ISA
