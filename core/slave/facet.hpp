// SPDX-License-Identifier: BSD-3-Clause
// A facet of a slave surface: the area that belongs to a natural coordinate.
#pragma once

#include <cstdint>

#include "core/numbers/vec.hpp"
#include "core/surface/basis.hpp"

namespace ents {

// A point of a rule of quadrature over a facet
struct QuadraturePoint {
  double xi[2], weight;
};

namespace ENTS_ISA {

// Shape functions at xi, and area per natural area there; in 2D times the thickness, or the full turn about
// the second axis where that is 0.
template <class B>
double facet_density(const std::int64_t* nodes, const double* positions, double thickness,
                     const double (&xi)[B::dim - 1], Shape<double, B::dim - 1, B::nodes>& N) {
  constexpr int D = B::dim, T = D - 1, M = B::nodes;
  B::template shape<1>(xi, N);
  Vec<double, D> a[T];
  for (int k = 0; k < T; ++k) {
    a[k] = Vec<double, D>::zero();
    for (int i = 0; i < M; ++i) {
      Vec<double, D> y;
      for (int c = 0; c < D; ++c) y[c] = positions[D * nodes[i] + c] - positions[D * nodes[0] + c];
      add_scaled(a[k], N.d1[k][i], y);
    }
  }
  const Vec<double, D> m = normal_of_tangents(a);
  double density = square_root(dot(m, m));
  if constexpr (D == 2) {
    double radius = 0.0;
    for (int i = 0; i < M; ++i) {
      if (!(thickness > 0.0) && positions[D * nodes[i]] < 0.0) return -1.0; // beyond the axis
      radius += N.n[i] * positions[D * nodes[i]];
    }
    density *= thickness > 0.0 ? thickness : 6.283185307179586 * radius;
  }
  return density;
}

// The side of a quadrilateral whose two nodes are in one place, so that it is a triangle: from node k to node
// k + 1; -1: none.
inline int collapsed_side(const std::int64_t* nodes, const double* positions) {
  for (int k = 0; k < 4; ++k) {
    const auto at = [&](int i) { return vec_at<3>(positions + 3 * nodes[i % 4]); };
    const Vec<double, 3> gone = at(k + 1) - at(k), across = at(k + 2) - at(k);
    if (dot(gone, gone) <= 1e-24 * dot(across, across)) return k;
  }
  return -1;
}

// Calls f with a null pointer to the basis of a facet; bad_value for the smoothed bases, which have no facet
// of their own.
template <class Result, class F> Result with_facet(Basis basis, Result otherwise, F&& f) {
  switch (basis) {
  case Basis::line2:
    return f(static_cast<Line2*>(nullptr));
  case Basis::line3:
    return f(static_cast<Line3*>(nullptr));
  case Basis::tri3:
    return f(static_cast<Tri3*>(nullptr));
  case Basis::tri6:
    return f(static_cast<Tri6*>(nullptr));
  case Basis::quad4:
    return f(static_cast<Quad4*>(nullptr));
  case Basis::quad8:
    return f(static_cast<Quad8*>(nullptr));
  case Basis::quad9:
    return f(static_cast<Quad9*>(nullptr));
  default:
    return otherwise;
  }
}

} // namespace ENTS_ISA
} // namespace ents
