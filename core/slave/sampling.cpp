// SPDX-License-Identifier: BSD-3-Clause
#include "core/slave/sampling.hpp"

#include <cmath>
#include <type_traits>
#include <vector>

#include "core/slave/facet.hpp"

namespace ents {

namespace {

// Roots of the Legendre polynomial P_n by Newton's method from Chebyshev's, and Gauss's weights 2 / ((1 -
// x^2) P_n'^2).
std::vector<QuadraturePoint> gauss_legendre(int n) {
  std::vector<QuadraturePoint> points;
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(3.141592653589793 * (i + 0.75) / (n + 0.5)), slope = 1.0;
    for (int iteration = 0; iteration < 8; ++iteration) {
      double p = 1.0, before = 0.0;
      for (int k = 1; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
        before = p, p = next;
      }
      slope = n * (x * p - before) / (x * x - 1.0);
      x -= p / slope;
    }
    if (2 * i + 1 == n) x = 0.0;
    points.push_back({{x, 0.0}, 2.0 / ((1.0 - x * x) * slope * slope)});
  }
  return points;
}

template <class B> std::vector<QuadraturePoint> rule(int n) {
  if constexpr (B::simplex) {
    std::vector<QuadraturePoint> points;
    const double part = 1.0 / n;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n - j; ++i) {
        points.push_back({{(i + 1.0 / 3.0) * part, (j + 1.0 / 3.0) * part}, 0.5 * part * part});
        if (i + j + 1 < n)
          points.push_back({{(i + 2.0 / 3.0) * part, (j + 2.0 / 3.0) * part}, 0.5 * part * part});
      }
    // Centroids of parts lack the second moments of the parts, 1 / n^2 of the triangle's. Away from the
    // middle by this factor the points have all of them: the rule is exact for quadratic shape functions.
    if (B::nodes > 3 && n > 1)
      for (QuadraturePoint& point : points)
        for (double& xi : point.xi) xi = 1.0 / 3.0 + n / std::sqrt(n * n - 1.0) * (xi - 1.0 / 3.0);
    return points;
  } else {
    const std::vector<QuadraturePoint> line = gauss_legendre(n);
    if constexpr (B::dim == 2) return line;
    std::vector<QuadraturePoint> points;
    for (const QuadraturePoint& q : line)
      for (const QuadraturePoint& p : line) points.push_back({{p.xi[0], q.xi[0]}, p.weight * q.weight});
    return points;
  }
}

// The shape functions of a ring's two nodes where the radius has its mean weight: one point in the middle
// would not give them their shares, because N r is of degree 2.
template <class B> auto shape_at_centroid(const std::int64_t* nodes, const double* positions) {
  using namespace ENTS_ISA;
  const double first = positions[2 * nodes[0]], last = positions[2 * nodes[1]];
  const double xi[1] = {(last - first) / (3.0 * (first + last))};
  Shape<double, 1, 2> N;
  facet_density<B>(nodes, positions, 0.0, xi, N);
  return N;
}

// Shape functions and area of a point of a facet
template <class B> struct Sample { double N[B::nodes], area; };

template <class B>
Sample<B> sample_at(const QuadraturePoint& point, const std::int64_t* nodes, const double* positions,
                    double thickness) {
  using namespace ENTS_ISA;
  constexpr int T = B::dim - 1;
  double xi[T];
  for (int a = 0; a < T; ++a) xi[a] = point.xi[a];
  Shape<double, T, B::nodes> N;
  Sample<B> out;
  out.area = point.weight * facet_density<B>(nodes, positions, thickness, xi, N);
  for (int i = 0; i < B::nodes; ++i) out.N[i] = N.n[i];
  return out;
}

// Of the triangle that a quadrilateral with a collapsed side is; its corner there is both nodes, half and
// half.
Sample<ENTS_ISA::Quad4> sample_triangle(const QuadraturePoint& point, int side, const std::int64_t* nodes,
                                        const double* positions) {
  const int corner[3] = {side, (side + 2) % 4, (side + 3) % 4};
  const std::int64_t of_triangle[3] = {nodes[corner[0]], nodes[corner[1]], nodes[corner[2]]};
  const Sample<ENTS_ISA::Tri3> in = sample_at<ENTS_ISA::Tri3>(point, of_triangle, positions, 0.0);
  Sample<ENTS_ISA::Quad4> out;
  out.area = in.area;
  for (int i = 0; i < 3; ++i) out.N[corner[i]] = in.N[i];
  out.N[side] = out.N[(side + 1) % 4] = 0.5 * in.N[0];
  return out;
}

template <class B>
Status sample(int n, std::int64_t count, const std::int64_t* connectivity, const double* positions,
              double thickness, std::int64_t* nodes, double* weights, double* areas, std::int64_t& facet) {
  constexpr int M = B::nodes;
  constexpr bool may_collapse = std::is_same_v<B, ENTS_ISA::Quad4>;
  const std::vector<QuadraturePoint> points = rule<B>(n),
                                     of_triangle = rule<ENTS_ISA::Tri3>(may_collapse ? n : 1);
  for (const bool writes : {false, true}) // nothing, unless all facets are good
    for (facet = 0; facet < count; ++facet) {
      const std::int64_t* own = connectivity + facet * M;
      const int side = may_collapse ? ENTS_ISA::collapsed_side(own, positions) : -1;
      for (std::size_t k = 0; k < points.size(); ++k) {
        Sample<B> at;
        if constexpr (may_collapse)
          at = side < 0 ? sample_at<B>(points[k], own, positions, thickness)
                        : sample_triangle(of_triangle[k], side, own, positions);
        else
          at = sample_at<B>(points[k], own, positions, thickness);
        if constexpr (B::dim == 2 && M == 2)
          if (n == 1 && thickness == 0.0) {
            const auto N = shape_at_centroid<B>(own, positions);
            for (int i = 0; i < M; ++i) at.N[i] = N.n[i];
          }
        if (!(at.area > 0.0) || !(at.area < 1e300)) return Status::degenerate_segment;
        if (!writes) continue;
        for (int i = 0; i < M; ++i) {
          *nodes++ = own[i];
          *weights++ = at.N[i];
        }
        *areas++ = at.area;
      }
    }
  return Status::ok;
}

} // namespace

Status sample_facets(Basis facet_basis, int n, std::int64_t count, const std::int64_t* connectivity,
                     const double* positions, double thickness, std::int64_t* nodes, double* weights,
                     double* areas, std::int64_t& facet) {
  return ENTS_ISA::with_facet(facet_basis, Status::bad_value, [&]<class B>(B*) {
    return sample<B>(n, count, connectivity, positions, thickness, nodes, weights, areas, facet);
  });
}

} // namespace ents
