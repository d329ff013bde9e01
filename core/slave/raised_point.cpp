// SPDX-License-Identifier: BSD-3-Clause
#include "core/slave/raised_point.hpp"

#include <cmath>

#include "core/slave/facet.hpp"
#include "core/surface/surface.hpp"

namespace ents {

namespace {

using namespace ENTS_ISA;

template <int D>
Status set_normal(RaisedPoint& point, const std::int64_t* nodes, const double* slopes,
                  const double* positions) noexcept {
  constexpr int T = D - 1;
  const Vec<double, D> origin = vec_at<D>(positions + D * nodes[0]);
  Vec<double, D> a[T], x = Vec<double, D>::zero();
  for (auto& tangent : a) tangent = Vec<double, D>::zero();
  double size2 = 0.0;
  for (int i = 0; i < point.count; ++i) {
    const Vec<double, D> y = vec_at<D>(positions + D * nodes[i]) - origin;
    size2 += dot(y, y);
    add_scaled(x, point.weights[i], y);
    for (int k = 0; k < T; ++k) add_scaled(a[k], slopes[T * i + k], y);
  }
  const Vec<double, D> m = normal_of_tangents(a);
  const double area2 = dot(m, m);
  if (!(area2 > degenerate_size * degenerate_size * (T == 2 ? size2 * size2 : size2)))
    return Status::degenerate_segment;
  point.area = square_root(area2);
  const Vec<double, D> n = (1.0 / point.area) * m;
  double metric[symmetric_size<T>], inverse[symmetric_size<T>];
  for (int k = 0; k < symmetric_size<T>; ++k) metric[k] = dot(a[k / 2], a[(k + 1) / 2]);
  invert(metric, area2, inverse);
  Vec<double, D> dual[T];
  for (int k = 0; k < T; ++k) {
    dual[k] = inverse[symmetric_index(k, 0)] * a[0];
    if constexpr (T == 2) add_scaled(dual[k], inverse[symmetric_index(k, 1)], a[1]);
  }
  for (int i = 0; i < point.count; ++i) {
    Vec<double, D> p = Vec<double, D>::zero();
    for (int k = 0; k < T; ++k) add_scaled(p, slopes[T * i + k], dual[k]);
    for (int c = 0; c < D; ++c) point.along[i][c] = p[c];
  }
  for (int c = 0; c < D; ++c) {
    point.normal[c] = n[c];
    point.place[c] = origin[c] + (x[c] + point.height * n[c]);
    if (!std::isfinite(point.place[c])) return Status::non_finite;
  }
  return Status::ok;
}

// Where the nodes of facets lie: xi of node i.
void place_of_node(Basis basis, int i, double (&xi)[2]) {
  static constexpr double line[3][2] = {{-1, 0}, {1, 0}, {0, 0}},
                          triangle[6][2] = {{0, 0}, {1, 0}, {0, 1}, {.5, 0}, {.5, .5}, {0, .5}},
                          square[9][2] = {{-1, -1}, {1, -1}, {1, 1},  {-1, 1}, {0, -1},
                                          {1, 0},   {0, 1},  {-1, 0}, {0, 0}};
  const bool flat = basis == Basis::line2 || basis == Basis::line3;
  const double(&at)[2] =
      flat ? line[i] : (basis == Basis::tri3 || basis == Basis::tri6 ? triangle[i] : square[i]);
  xi[0] = at[0], xi[1] = at[1];
}

Basis facet_of(int d, std::int64_t count) {
  if (d == 2) return count == 2 ? Basis::line2 : (count == 3 ? Basis::line3 : Basis::bezier15);
  switch (count) {
  case 3:
    return Basis::tri3;
  case 4:
    return Basis::quad4;
  case 6:
    return Basis::tri6;
  case 8:
    return Basis::quad8;
  case 9:
    return Basis::quad9;
  default:
    return Basis::bezier15; // no facet
  }
}

bool slopes_of(Basis basis, const double* weights, double* slopes, double (&xi)[2]) {
  return with_facet(basis, false, [&]<class B>(B*) {
    constexpr int T = B::dim - 1, M = B::nodes;
    xi[0] = xi[1] = 0.0; // all facets reproduce linear functions of xi
    for (int i = 0; i < M; ++i) {
      double place[2];
      place_of_node(basis, i, place);
      for (int k = 0; k < T; ++k) xi[k] += weights[i] * place[k];
    }
    double at[T];
    for (int k = 0; k < T; ++k) at[k] = xi[k];
    Shape<double, T, M> N;
    B::template shape<1>(at, N);
    for (int i = 0; i < M; ++i) {
      if (!(std::fabs(N.n[i] - weights[i]) <= 1e-9)) return false;
      for (int k = 0; k < T; ++k) slopes[T * i + k] = N.d1[k][i];
    }
    return true;
  });
}

} // namespace

Status RaisedPoint::set(int d, std::int64_t facet_nodes, const std::int64_t* nodes, const double* N,
                        const double* slopes, double h, const double* positions) noexcept {
  if (facet_nodes < 2 || facet_nodes > most_facet_nodes) return Status::bad_value;
  dimension = d, count = static_cast<int>(facet_nodes), height = h, weights = N;
  return d == 2 ? set_normal<2>(*this, nodes, slopes, positions)
                : set_normal<3>(*this, nodes, slopes, positions);
}

void RaisedPoint::derivative(int i, double (&J)[3][3]) const noexcept {
  for (int a = 0; a < dimension; ++a)
    for (int b = 0; b < dimension; ++b)
      J[a][b] = (a == b ? weights[i] : 0.0) - height * along[i][a] * normal[b];
}

void RaisedPoint::second_derivative(int i, int j, const double* force, double (&G)[3][3]) const noexcept {
  double on_normal = 0.0, on_i = 0.0, on_j = 0.0, product = 0.0;
  for (int c = 0; c < dimension; ++c) {
    on_normal += force[c] * normal[c];
    on_i += force[c] * along[i][c];
    on_j += force[c] * along[j][c];
    product += along[i][c] * along[j][c];
  }
  for (int a = 0; a < dimension; ++a)
    for (int b = 0; b < dimension; ++b)
      G[a][b] = height * (on_j * normal[a] * along[i][b] + on_i * along[j][a] * normal[b] -
                          on_normal * product * normal[a] * normal[b]);
}

Status facet_slopes(int d, std::int64_t count, const double* weights, double* slopes,
                    double (&xi)[2]) noexcept {
  if (slopes_of(facet_of(d, count), weights, slopes, xi)) return Status::ok;
  if (d != 3 || count != 4) return Status::bad_value;
  // A quadrilateral with a collapsed side, as ents_sampling_points takes it: its corner there has two equal halves.
  for (int side = 0; side < 4; ++side) {
    const int twin = (side + 1) % 4, corner[3] = {side, (side + 2) % 4, (side + 3) % 4};
    if (weights[side] != weights[twin]) continue;
    const double N[3] = {weights[side] + weights[twin], weights[corner[1]], weights[corner[2]]};
    double own[6];
    if (!slopes_of(Basis::tri3, N, own, xi)) continue;
    for (int k = 0; k < 2; ++k) {
      slopes[2 * side + k] = slopes[2 * twin + k] = 0.5 * own[k];
      slopes[2 * corner[1] + k] = own[2 + k], slopes[2 * corner[2] + k] = own[4 + k];
    }
    return Status::ok;
  }
  return Status::bad_value;
}

} // namespace ents
