// SPDX-License-Identifier: BSD-3-Clause
// Bounds of a segment over boxes of its natural coordinates. Positions and surface coordinates are polynomials
// of xi; over a box a polynomial stays between its Bernstein coefficients, its control net (Lane & Riesenfeld,
// Bounds on a polynomial, BIT 21, 1981), which departs from it by the square of the box's size at most. Nets of
// smaller boxes are cut from one of the whole segment by de Casteljau's algorithm. A sum of shape functions, each
// with its own bound, would be wider by the size of the segment: they are large and cancel. The bases that are
// compiled on their own have few and small ones, which are summed.
#pragma once

#include "core/projection/ball.hpp"
#include "core/surface/surface.hpp"

namespace ents::ENTS_ISA {

// Coefficients [j][i] of a polynomial of V components, of degree count - 1 per direction, on 0 .. 1.
template <int V, int T> struct Net {
  static constexpr int most = 5, rows = T == 2 ? most : 1; // degree 4
  int count[2];                                            // second one: 1 of a line
  Vec<double, V> c[rows][most];

  // Of the derivative along direction a
  ENTS_INLINE Net derivative(int a, double inverse_width) const {
    Net d;
    for (int k = 0; k < 2; ++k) d.count[k] = count[k] - (k == a);
    const double scale = d.count[a] * inverse_width;
    for (int j = 0; j < d.count[1]; ++j)
      for (int i = 0; i < d.count[0]; ++i) {
        const Vec<double, V>& next = a == 0 ? c[j][i + 1] : c[rows == 1 ? 0 : j + 1][i];
        for (int k = 0; k < V; ++k) d.c[j][i][k] = scale * (next[k] - c[j][i][k]);
      }
    return d;
  }

  // On from .. to per direction. Two turns of de Casteljau's algorithm: up to `to`, and of that the part after `from`
  ENTS_INLINE void cut(const double (&from)[T], const double (&to)[T]) {
    for (int j = 0; j < count[1]; ++j) cut(&c[j][0], 1, count[0], from[0], to[0]);
    if constexpr (T == 2)
      for (int i = 0; i < count[0]; ++i) cut(&c[0][i], most, count[1], from[1], to[1]);
  }

  // Value at the centre, and the largest departure of a coefficient from it.
  ENTS_INLINE void range(Vec<Ball, V>& out) const {
    static constexpr double middle[5][5] = {{1.0},
                                            {0.5, 0.5},
                                            {0.25, 0.5, 0.25},
                                            {0.125, 0.375, 0.375, 0.125},
                                            {0.0625, 0.25, 0.375, 0.25, 0.0625}};
    for (int k = 0; k < V; ++k) {
      double value = 0.0, radius = 0.0;
      for (int j = 0; j < count[1]; ++j) {
        double row = 0.0;
        for (int i = 0; i < count[0]; ++i) row += middle[count[0] - 1][i] * c[j][i][k];
        value += middle[count[1] - 1][j] * row;
      }
      for (int j = 0; j < count[1]; ++j)
        for (int i = 0; i < count[0]; ++i) radius = greater(radius, absolute(c[j][i][k] - value));
      out[k] = {value, radius};
    }
  }

private:
  static ENTS_INLINE void cut(Vec<double, V>* p, int step, int n, double from, double to) {
    for (int k = 1; k < n; ++k)
      for (int i = n - 1; i >= k; --i) move(p[step * i], p[step * (i - 1)], 1.0 - to);
    const double rest = to > 0.0 ? from / to : 0.0;
    for (int k = 1; k < n; ++k)
      for (int i = 0; i < n - k; ++i) move(p[step * i], p[step * (i + 1)], rest);
  }
  static ENTS_INLINE void move(Vec<double, V>& p, const Vec<double, V>& towards, double by) {
    for (int k = 0; k < V; ++k) p[k] += by * (towards[k] - p[k]);
  }
};

// Has a net room for every counted basis?
template <int D> constexpr bool nets_have_room() {
  for (const CountedBasis<D>& basis : counted_bases<D>.of)
    if (basis.degree >= Net<D, D - 1>::most) return false;
  return true;
}
static_assert(nets_have_room<2>() && nets_have_room<3>());

// Values at equal distances to Bernstein coefficients, in place.
template <int V> ENTS_INLINE void interpolate(Vec<double, V>* p, int step, int n) {
  static constexpr double inverse[5][5][5] = {
      {{1.0}},
      {{1.0, 0.0}, {0.0, 1.0}},
      {{1.0, 0.0, 0.0}, {-0.5, 2.0, -0.5}, {0.0, 0.0, 1.0}},
      {{1.0, 0.0, 0.0, 0.0},
       {-5.0 / 6.0, 3.0, -1.5, 1.0 / 3.0},
       {1.0 / 3.0, -1.5, 3.0, -5.0 / 6.0},
       {0.0, 0.0, 0.0, 1.0}},
      {{1.0, 0.0, 0.0, 0.0, 0.0},
       {-13.0 / 12.0, 4.0, -3.0, 4.0 / 3.0, -0.25},
       {13.0 / 18.0, -32.0 / 9.0, 20.0 / 3.0, -32.0 / 9.0, 13.0 / 18.0},
       {-0.25, 4.0 / 3.0, -3.0, 4.0, -13.0 / 12.0},
       {0.0, 0.0, 0.0, 0.0, 1.0}}};
  Vec<double, V> values[5];
  for (int i = 0; i < n; ++i) values[i] = p[step * i];
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < V; ++k) {
      double sum = 0.0;
      for (int j = 0; j < n; ++j) sum += inverse[n - 1][i][j] * values[j][k];
      p[step * i][k] = sum;
    }
}

// The domain of a basis with its border, as a box: of a triangle with what lies beside it.
template <class B> struct Domain {
  static constexpr int T = B::dim - 1;
  double low, width;
  ENTS_INLINE Domain(const B& basis, double border)
      : low(is_simplex(basis) ? -border : -1.0 - border),
        width(is_simplex(basis) ? 1.0 + 2.0 * border : 2.0 + 2.0 * border) {}
};

// The net of a segment over its domain, of V numbers per node.
template <class B, int V> struct SegmentNet : Net<V, B::dim - 1> {
  static constexpr int T = B::dim - 1;

  ENTS_INLINE SegmentNet(const B& basis, const Domain<B>& domain, const double* of) {
    const int n = basis.degree + 1;
    this->count[0] = n, this->count[1] = T == 2 ? n : 1;
    for (int j = 0; j < this->count[1]; ++j)
      for (int i = 0; i < n; ++i) {
        const int at[2] = {i, j};
        double xi[T];
        for (int a = 0; a < T; ++a) xi[a] = domain.low + domain.width * at[a] / (n - 1);
        Shape<double, T, B::nodes> N;
        basis.template shape<0>(xi, N);
        for (int k = 0; k < V; ++k) {
          double sum = 0.0;
          for (int m = 0; m < node_count(basis); ++m) sum += N.n[m] * of[V * m + k];
          this->c[j][i][k] = sum;
        }
      }
    for (int j = 0; j < this->count[1]; ++j) interpolate(&this->c[j][0], 1, n);
    if constexpr (T == 2)
      for (int i = 0; i < n; ++i) interpolate(&this->c[0][i], this->most, n);
  }
};

// A surface and its derivatives over boxes, as evaluate_surface.
template <int Order, class B, bool H> class SurfaceRange {
public:
  ENTS_INLINE SurfaceRange(const Geometry<B>& g, double) : g_(g) {}
  ENTS_INLINE bool operator()(const Ball (&xi)[B::dim - 1], Surface<B, H, Ball>& s) const {
    Shape<Ball, B::dim - 1, B::nodes> N;
    return evaluate_surface<Order>(g_, xi, N, s);
  }

private:
  const Geometry<B>& g_;
};

// The same of nets, made once.
template <int Order, int Dim, bool H> class SurfaceRange<Order, CountedBasis<Dim>, H> {
  using B = CountedBasis<Dim>;
  static constexpr int D = B::dim, T = D - 1, K = symmetric_size<T>;
  static constexpr int basis_order = bent_below<B, H> ? Order + 1 : Order;
  static constexpr int K3 = T == 1 ? 1 : 4;
  using Positions = Net<D, T>;
  using Coordinates = Net<T, T>;

public:
  ENTS_NOINLINE SurfaceRange(const Geometry<B>& g, double border) : g_(g), domain_(g.basis, border) {
    const double scale = 1.0 / domain_.width;
    rho_ = SegmentNet<B, D>(g.basis, domain_, g.y[0].c);
    for (int a = 0; a < T; ++a) a_[a] = rho_.derivative(a, scale);
    if constexpr (basis_order > 1)
      for (int k = 0; k < K; ++k) a2_[k] = a_[k / 2].derivative((k + 1) / 2, scale);
    if constexpr (basis_order > 2)
      for (int k = 0; k < K3; ++k)
        if (has_third(g.basis, k))
          a3_[k] = k < K ? a2_[k].derivative(0, scale) : a2_[K - 1].derivative(1, scale);
    if (!H || !g.surface_coordinates) return;
    s_ = SegmentNet<B, T>(g.basis, domain_, g.surface_coordinates);
    for (int a = 0; a < T; ++a) s1_[a] = s_.derivative(a, scale);
    if constexpr (Order > 1)
      for (int k = 0; k < K; ++k) s2_[k] = s1_[k / 2].derivative((k + 1) / 2, scale);
  }

  ENTS_INLINE bool operator()(const Ball (&xi)[T], Surface<B, H, Ball>& s) const {
    const Cut cut(domain_, xi);
    Vec<Ball, D> rho;
    cut.range(rho_, rho);
    s.d = -rho;
    for (int a = 0; a < T; ++a) cut.range(a_[a], s.a[a]);
    if constexpr (basis_order > 1)
      for (int k = 0; k < K; ++k) cut.range(a2_[k], s.a2[k]);
    if constexpr (basis_order > 2)
      for (int k = 0; k < K3; ++k)
        if (has_third(g_.basis, k)) cut.range(a3_[k], s.a3[k]);
    return complete_surface<Order>(
        g_, [&](HeightJet<T, Ball>& h) { height(cut, xi, h); }, s);
  }

private:
  struct Cut {
    double from[T], to[T];
    ENTS_INLINE Cut(const Domain<B>& domain, const Ball (&xi)[T]) {
      for (int a = 0; a < T; ++a) {
        from[a] = (xi[a].v - xi[a].r - domain.low) / domain.width;
        to[a] = (xi[a].v + xi[a].r - domain.low) / domain.width;
      }
    }
    template <int V> ENTS_INLINE void range(const Net<V, T>& whole, Vec<Ball, V>& out) const {
      Net<V, T> part = whole;
      part.cut(from, to);
      part.range(out);
    }
  };

  ENTS_INLINE void height(const Cut& cut, const Ball (&xi)[T], HeightJet<T, Ball>& h) const {
    if (!g_.surface_coordinates) {
      h = evaluate_height(*g_.height, xi);
      return;
    }
    Ball s[T], s1[T][T], s2[K][T];
    Vec<Ball, T> v;
    const auto take = [&](const Coordinates& of, Ball(&to)[T]) {
      cut.range(of, v);
      for (int t = 0; t < T; ++t) to[t] = v[t];
    };
    take(s_, s);
    for (int a = 0; a < T; ++a) take(s1_[a], s1[a]);
    if constexpr (Order > 1)
      for (int k = 0; k < K; ++k) take(s2_[k], s2[k]);
    height_by_xi<Order, B>(evaluate_height(*g_.height, s), s1, s2, h);
  }

  const Geometry<B>& g_;
  Domain<B> domain_;
  Positions rho_, a_[T], a2_[K], a3_[K3];
  Coordinates s_, s1_[T], s2_[K];
};

} // namespace ents::ENTS_ISA
