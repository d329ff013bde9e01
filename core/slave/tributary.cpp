// SPDX-License-Identifier: BSD-3-Clause
#include "core/slave/tributary.hpp"

#include <cmath>

#include "core/slave/facet.hpp"

namespace ents {

namespace {

// 3 Gauss points per direction; 7 points of degree 5 on triangles (Radon 1948).
constexpr double gauss = 0.774596669241483377;
constexpr double gauss_points[3] = {-gauss, 0.0, gauss};
constexpr double gauss_weights[3] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};

template <class B> int quadrature(QuadraturePoint (&points)[9]) {
  int n = 0;
  if constexpr (B::dim == 2) {
    for (int i = 0; i < 3; ++i) points[n++] = {{gauss_points[i], 0.0}, gauss_weights[i]};
  } else if constexpr (B::simplex) {
    const double root = std::sqrt(15.0);
    points[n++] = {{1.0 / 3.0, 1.0 / 3.0}, 9.0 / 80.0};
    for (const double sign : {-1.0, 1.0}) {
      const double a = (6.0 + sign * root) / 21.0, b = 1.0 - 2.0 * a, w = (155.0 + sign * root) / 2400.0;
      points[n++] = {{a, a}, w};
      points[n++] = {{b, a}, w};
      points[n++] = {{a, b}, w};
    }
  } else {
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        points[n++] = {{gauss_points[i], gauss_points[j]}, gauss_weights[i] * gauss_weights[j]};
  }
  return n;
}

template <class B>
bool add_facet(const std::int64_t* nodes, const double* positions, double thickness, double* areas) {
  using namespace ENTS_ISA;
  constexpr int D = B::dim, T = D - 1, M = B::nodes;
  QuadraturePoint points[9];
  const int n = quadrature<B>(points);
  double area = 0.0, share[M] = {}, square[M] = {}, squares = 0.0;
  for (int q = 0; q < n; ++q) {
    double xi[T];
    for (int a = 0; a < T; ++a) xi[a] = points[q].xi[a];
    Shape<double, T, M> N;
    const double w = points[q].weight * facet_density<B>(nodes, positions, thickness, xi, N);
    if (!(w > 0.0)) return false; // folded, or beyond the axis
    area += w;
    for (int i = 0; i < M; ++i) {
      share[i] += w * N.n[i];
      square[i] += w * N.n[i] * N.n[i];
      squares += w * N.n[i] * N.n[i];
    }
  }
  if (!(area > 0.0) || !(area < 1e300)) return false;
  constexpr bool linear = M <= (D == 2 ? 2 : (B::simplex ? 3 : 4));
  for (int i = 0; i < M; ++i) areas[nodes[i]] += linear ? share[i] : area * (square[i] / squares);
  return true;
}

template <class B>
Status add_facets(std::int64_t count, const std::int64_t* connectivity, const double* positions,
                  double thickness, double* areas, std::int64_t& facet) {
  for (facet = 0; facet < count; ++facet)
    if (!add_facet<B>(connectivity + facet * B::nodes, positions, thickness, areas))
      return Status::degenerate_segment;
  return Status::ok;
}

} // namespace

Status add_tributary_areas(Basis facet_basis, std::int64_t count, const std::int64_t* connectivity,
                           const double* positions, double thickness, double* areas, std::int64_t& facet) {
  using namespace ENTS_ISA;
  const auto add = [&]<class B>(B*) {
    return add_facets<B>(count, connectivity, positions, thickness, areas, facet);
  };
  return with_facet(facet_basis, Status::bad_value, add);
}

} // namespace ents
