// SPDX-License-Identifier: BSD-3-Clause
// The ordinary element: projection along the normal from a start next to it, penalty or power law, consistent tangent. It is what
// nearly all elements of nearly all calls are, so it is written for speed, for one element (S = double) or one per lane; both
// run the same operations in the same order. Whatever is not ordinary (no start, a projection that needs care, an edge of the
// range of numbers, an error) is left to evaluate_element().
//
// F = |x_s - rho_e|^2 / 2 is g^2 / 2 at its minimum, so that with s the weights of delta X = x_s - rho and f_a = - F_,xi_a u
//   dg dg^T + g D2g = D2F* = F_uu - f F_,xixi^-1 f,   F_uu = s s^T I + sum_k (w_k z_k^T + z_k w_k^T)
//   K = A [ W'/g D2F* + (W'' - W'/g) dg dg^T ]
// W'/g is finite where the pressure vanishes with the gap.
#pragma once

#include "core/dof_rows.hpp"
#include "core/pair_forms.hpp"
#include "core/pair_surface.hpp"
#include "core/pair_write.hpp"
#include "core/plan.hpp"
#include "core/projection.hpp"

namespace ents::ENTS_ISA {

inline constexpr int max_pair_evaluations = 8;
// Lengths, heights and stiffnesses below this, and lengths above its inverse, keep every product in range.
inline constexpr double comfortable = 1e30;

template <int K, class S> ENTS_INLINE Truth<S> minimum_of(const S (&f2)[K], const S (&metric)[K]) {
  return both(f2[0] > 1e-8 * metric[0], determinant(f2) > 1e-8 * determinant(metric));
}

template <class S> ENTS_INLINE S larger(S a, S b) { return select(a > b, a, b); }

// An element on its way through.
template <class B, bool H, class S> struct Pair {
  static constexpr int D = B::dim, T = D - 1, K = symmetric_size<T>;
  const PairNodes<B, S>& nodes;
  S area, xi[T];
  S evaluations, per_gap; // W'/g per area, 0 where open
  Vec<S, D> gap_vector;   // g n_e
  S gap;                  // g
  Vec<S, D> normal;       // and n_e, where they are measured
  Truth<S> ordinary, contact, outside;
  PairProjector<B, H, S> projector;

  ENTS_INLINE Pair(const PairNodes<B, S>& y, const S (&start)[T]) : nodes(y), projector(nodes) {
    for (int a = 0; a < T; ++a) xi[a] = start[a];
  }
  Pair(const Pair&) = delete;

  ENTS_INLINE Truth<S> has_area() const { return both(area >= 0.0, area < comfortable); }

  // Is the slave above all of the enriched segment, so that a projection could only find it open? False: not known.
  //   flat   rho_e is a graph over the plane: n_e . n > 0, and x_s - rho_e = g n_e has the component zeta - h > 0 along n
  //   quad4, plain   rho is a graph over the plane of its middle if its normals are on the side of that normal; they and rho are
  //          bilinear, so their corners decide
  ENTS_INLINE Truth<S> is_clearly_open(const Plan& plan) const {
    if constexpr (is_flat<B>) {
      if constexpr (H) return projector.zeta > S(plan.height_bound);
      else return dot(normal_of_tangents(projector.s.a), projector.offset) > S(0.0);
    } else if constexpr (std::is_same_v<B, Quad4> && !H) {
      const auto& rho = projector.rho;
      const Vec<S, 3> middle = cross(rho.c1, rho.c2), turn_1 = cross(rho.c1, rho.c12), turn_2 = cross(rho.c12, rho.c2);
      const S reach = S(1.0 + plan.border), size = dot(middle, middle);
      Truth<S> open = size > reach * (absolute(dot(middle, turn_1)) + absolute(dot(middle, turn_2)));
      const S height = dot(middle, rho.c), along_1 = reach * dot(middle, rho.c1), along_2 = reach * dot(middle, rho.c2),
              warp = reach * reach * dot(middle, rho.c12);
      return both(open, -height > absolute(along_1) + absolute(along_2) + absolute(warp));
    } else {
      return S(1.0) < S(0.0);
    }
  }

  // Newton's method with full steps. Not ordinary: a step that does not descend, is long or leaves the segment far behind.
  ENTS_INLINE void project() {
    if constexpr (PairProjector<B, H, S>::closed_form) {
      for (int a = 0; a < T; ++a) xi[a] = projector.foot[a];
      evaluations = S(1.0);
      ordinary = evaluations > 0.0;
    } else {
      using Descent = typename DescentOf<B, H, S>::type;
      Descent p(projector);
      S step[T];
      const S floor = std::remove_reference_t<Descent>::rounding * dot(nodes.y[0], nodes.y[0]);
      S previous_length = S(0.0), previous_merit = S(2.0 * comfortable * comfortable);
      evaluations = S(0.0);
      Truth<S> active = evaluations >= 0.0;
      ordinary = active;
      for (int count = 1; count < max_pair_evaluations; ++count) {
        p.evaluate(xi);
        evaluations = select(active, evaluations + 1.0, evaluations);
        if constexpr (T == 1) {
          step[0] = unchecked_ratio(p.r[0], p.f2[0]);
        } else {
          const S q = unchecked_inverse(determinant(p.f2));
          step[0] = (p.f2[2] * p.r[0] - p.f2[1] * p.r[1]) * q;
          step[1] = (p.f2[0] * p.r[1] - p.f2[1] * p.r[0]) * q;
        }
        S length = absolute(step[0]);
        if constexpr (T == 2) length = larger(length, absolute(step[1]));
        Truth<S> fine = both(both(minimum_of(p.f2, p.metric), length <= max_step),
                             p.twice_merit <= previous_merit * (1.0 + 1e-12) + floor);
        S size = S(0.0);
        for (int a = 0; a < T; ++a) {
          step[a] = xi[a] + step[a];
          size = size + absolute(step[a]);
        }
        fine = both(fine, size <= far_outside);
        ordinary = without(ordinary, without(active, fine));
        active = both(active, fine);
        active = both(active, length > 1e-15);
        if (!any(active)) break;
        // quadratic convergence: see project()
        const Truth<S> last = either(length <= 1e-13,
                                     both(length < 1e-4, 10.0 * length * length * length <= 1e-16 * previous_length * previous_length));
        // one element, or all of them: the next step does not wait for what this one is compared with
        if (every(active)) {
          for (int a = 0; a < T; ++a) xi[a] = step[a];
        } else {
          for (int a = 0; a < T; ++a) xi[a] = select(active, step[a], xi[a]);
        }
        evaluations = select(both(active, last), evaluations + 1.0, evaluations); // that of arrive()
        active = without(active, last);
        previous_length = length;
        previous_merit = p.twice_merit;
        if (!any(active)) break;
      }
      ordinary = without(ordinary, active);
    }
  }

  // The surface at the projection.
  ENTS_INLINE void arrive() {
    if constexpr (!PairProjector<B, H, S>::closed_form) projector.evaluate(xi);
  }

  // Gap, force and status. A penalty's forces need neither g nor n_e, which cost a root.
  ENTS_INLINE void press(const Plan& plan, bool measures) {
    auto& p = projector;
    const S area2 = p.finish(xi);
    const Vec<S, D> m = H ? normal_of_tangents(p.s.e) : normal_of_tangents(p.s.a);
    const S area2_e = H ? dot(m, m) : area2;
    S across; // g |m|
    if constexpr (is_flat<B> && !H) across = dot(p.offset, m);
    else across = dot(p.s.d, m);
    gap_vector = unchecked_ratio(across, area2_e) * m;
    if (measures) {
      const S q = unchecked_inverse(square_root(area2_e));
      normal = q * m;
      gap = across * q;
    } else {
      normal = Vec<S, D>::zero();
      gap = S(0.0);
    }
    if constexpr (H) {
      ordinary = both(ordinary, area2_e > degenerate_size * area2);
      S heights = absolute(p.s.height.h);
      for (const S& h : p.s.height.h1) heights = heights + absolute(h);
      for (const S& h : p.s.height.h2) heights = heights + absolute(h);
      ordinary = both(ordinary, heights < comfortable);
    }

    S size2 = dot(p.s.a[0], p.s.a[0]), reach2 = dot(nodes.y[0], nodes.y[0]);
    if constexpr (T == 2) size2 = size2 + dot(p.s.a[1], p.s.a[1]);
    for (int i = 1; i < B::nodes; ++i) reach2 = reach2 + dot(nodes.y[i], nodes.y[i]);
    // degenerate segments: the margins of Geometry::smallest_area2, and more. On a plane xi comes from normal equations, whose error grows
    // with the square of the ratio of the sides: up to 100
    constexpr double flattest = is_flat<B> && T == 2 ? 1e-4 : 1e-20;
    const S small = flattest * (T == 2 ? size2 * size2 : size2) + 1e-26 * reach2 * (T == 2 ? size2 : S(1.0));
    ordinary = both(ordinary, both(area2 > small, minimum_of(p.f2, p.metric)));
    ordinary = both(ordinary, both(area2 > 1.0 / (comfortable * comfortable), reach2 < comfortable * comfortable));
    ordinary = both(ordinary, has_area());

    if constexpr (B::simplex) {
      outside = either(either(xi[0] < -plan.border, xi[1] < -plan.border), xi[0] + xi[1] - 1.0 > plan.border);
    } else {
      outside = absolute(xi[0]) - 1.0 > plan.border;
      if constexpr (T == 2) outside = either(outside, absolute(xi[1]) - 1.0 > plan.border);
    }
    contact = without(across < 0.0, outside);

    per_gap = S(plan.law.stiffness);
    if (plan.law.normal == NormalKind::power && plan.law.twice_exponent > 2) {
      const int n = plan.law.twice_exponent - 2; // c (-g)^(m-1)
      const S depth = larger(-gap, S(0.0));
      if (n % 2) per_gap = per_gap * square_root(depth);
      for (int i = 0; i < n / 2; ++i) per_gap = per_gap * depth;
    }
    ordinary = both(ordinary, area * per_gap < comfortable);
    const S deep2 = plan.penetration_limit > 0.0 ? S(plan.penetration_limit * plan.penetration_limit)
                                                 : (B::simplex ? 1.0 : 4.0) * size2;
    // close to the limit evaluate_element() decides
    ordinary = without(ordinary, both(contact, across * across >= 0.99 * deep2 * area2_e));
    per_gap = select(contact, per_gap, S(0.0));
  }

  // out = R: A W' dg
  template <bool Rigid> ENTS_INLINE void residual(S (&out)[dof_count<B, Rigid>]) const {
    Form<B, S> f;
    form_of_p<B, H>(projector.s, (area * per_gap) * gap_vector, f);
    expand_to_dofs<B, Rigid, parts_of_p<H>>(f, projector.N, out);
  }
};

// Of g g^T = A (W'' - W'/g) dg dg^T = (m - 1) A W'/g dg dg^T, where the law is not linear
template <class B, bool H, class S> ENTS_INLINE void form_of_g(const Plan& plan, const Pair<B, H, S>& pair, Form<B, S>& g) {
  const S root = square_root(pair.area * pair.per_gap);
  form_of_p<B, H>(pair.projector.s, (root * square_root(0.5 * plan.law.twice_exponent - 1.0)) * pair.normal, g);
}
// False: the law is linear, and g zero.
template <bool Rigid, class B, bool H, class S>
ENTS_INLINE bool set_g(const Plan& plan, const Pair<B, H, S>& pair, DofArray<S, dof_count<B, Rigid>>& g) {
  if (plan.law.twice_exponent > 2) {
    Form<B, S> form;
    form_of_g(plan, pair, form);
    expand_to_dofs<B, Rigid, parts_of_p<H>>(form, pair.projector.N, g);
    return true;
  }
  for_each_dof(g, []() ENTS_LAMBDA_INLINE { return S(0.0); });
  return false;
}

// K = s s^T I - sum_a v_a v_a^T + sum_a (w_a z_a^T + z_a w_a^T) [ + g g^T ]
template <class B, bool H, bool Rigid, class S> struct PairTangent {
  static constexpr int D = B::dim, T = D - 1, N = dof_count<B, Rigid>, M = N / D;
  static constexpr bool turns = H && !Rigid; // w, z: dofs of the master
  static constexpr bool symmetric = true, has_rest = false, one_by_one = !turns;
  static constexpr int products = turns ? 3 * T : T; // that an entry is the sum of
  S weights[1][M]; // s
  DofArray<S, N> v[T];
  DofArray<S, N> w[turns ? T : 1], z[turns ? T : 1];
  DofArray<S, N> g; // where the law is not linear
  bool curved_law;

  ENTS_INLINE void evaluate(const Plan& plan, const Pair<B, H, S>& pair) {
    const auto& p = pair.projector;
    const S stiffness = pair.area * pair.per_gap, root = square_root(stiffness);
    weights[0][0] = root;
    if constexpr (!Rigid)
      for (int i = 0; i < B::nodes; ++i) weights[0][i + 1] = -(root * p.N.n[i]);

    // f F^-1 f = sum v v with F = C C^T, v = C^-1 f
    constexpr int parts = parts_of_f<B, H>;
    Form<B, S> f[T];
    forms_of_f(p.s, f);
    const S c11 = square_root(p.f2[0]);
    if constexpr (T == 2) {
      const S q = root / square_root(p.f2[0] * determinant(p.f2));
      set_form<parts>(f[1], q * p.f2[0], f[1]);
      add_form<parts>(f[1], -(q * p.f2[1]), f[0]);
    }
    set_form<parts>(f[0], root / c11, f[0]);
    for (int a = 0; a < T; ++a) expand_to_dofs<B, Rigid, parts>(f[a], p.N, v[a]);

    if constexpr (turns) {
      Form<B, S> zf[T];
      forms_of_z<B>(p.s, zf);
      const Vec<S, D> n = stiffness * p.s.n; // w_a = n . delta a_a
      for (int a = 0; a < T; ++a) {
        expand_to_dofs<B, Rigid, on_position | on_tangents>(zf[a], p.N, z[a]);
        expand_to_nodes<B>(p.N.d1[a], n, w[a]);
      }
    }
    curved_law = set_g<Rigid>(plan, pair, g);
  }

  // Each lane's to one[lane]
  template <class One, int W>
    requires(!turns)
  ENTS_INLINE void hand_out_lanes(One (&one)[W]) const {
    hand_out_tangent(*this, one, [](auto& t) ENTS_LAMBDA_INLINE -> auto& { return t.v; });
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
