// SPDX-License-Identifier: BSD-3-Clause
#include "core/slave/sampling.hpp"

#include <cmath>
#include <vector>

#include "core/slave/facet.hpp"

namespace ents {

namespace {

struct Point {
  double xi[2], weight;
};

// Roots of the Legendre polynomial P_n by Newton's method from Chebyshev's, and Gauss's weights 2 / ((1 -
// x^2) P_n'^2).
std::vector<Point> gauss_legendre(int n) {
  std::vector<Point> points;
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

template <class B> std::vector<Point> rule(int n) {
  if constexpr (B::simplex) {
    std::vector<Point> points;
    const double part = 1.0 / n;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n - j; ++i) {
        points.push_back({{(i + 1.0 / 3.0) * part, (j + 1.0 / 3.0) * part}, 0.5 * part * part});
        if (i + j + 1 < n)
          points.push_back({{(i + 2.0 / 3.0) * part, (j + 2.0 / 3.0) * part}, 0.5 * part * part});
      }
    return points;
  } else {
    const std::vector<Point> line = gauss_legendre(n);
    if constexpr (B::dim == 2) return line;
    std::vector<Point> points;
    for (const Point& q : line)
      for (const Point& p : line) points.push_back({{p.xi[0], q.xi[0]}, p.weight * q.weight});
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

template <class B>
Status sample(int n, std::int64_t count, const std::int64_t* connectivity, const double* positions,
              double thickness, std::int64_t* nodes, double* weights, double* areas, std::int64_t& facet) {
  using namespace ENTS_ISA;
  constexpr int T = B::dim - 1, M = B::nodes;
  const std::vector<Point> points = rule<B>(n);
  for (const bool writes : {false, true}) // nothing, unless all facets are good
    for (facet = 0; facet < count; ++facet)
      for (const Point& point : points) {
        double xi[T];
        for (int a = 0; a < T; ++a) xi[a] = point.xi[a];
        Shape<double, T, M> N;
        const double area =
            point.weight * facet_density<B>(connectivity + facet * M, positions, thickness, xi, N);
        if constexpr (B::dim == 2 && M == 2)
          if (n == 1 && thickness == 0.0) N = shape_at_centroid<B>(connectivity + facet * M, positions);
        if (!(area > 0.0) || !(area < 1e300)) return Status::degenerate_segment;
        if (!writes) continue;
        for (int i = 0; i < M; ++i) {
          *nodes++ = connectivity[facet * M + i];
          *weights++ = N.n[i];
        }
        *areas++ = area;
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
