// The contact element as one would write it for automatic differentiation: the residual by hand, its tangent
// by numbers that carry their derivatives with respect to all dofs. What it is held against is the same
// element of the library.
//
// The projection converges in double precision, by the library's own iteration; then one step of Newton's
// method in differentiated numbers, with the second derivatives in double precision, gives the numbers xi
// their derivatives exactly (implicit function theorem): r(xi, u) = 0, d xi = F_,xixi^-1 d r. At the
// projection x_s - rho_e = g n_e, so that with d = x_s - rho_e the residual is  R = A eps d . delta d  at
// fixed xi, and
//   d . delta (h n) = q_a . delta a_a,   p = h (d - n (n . d)) / |m|,
//   q_1 = a_2 x p,  q_2 = p x a_1   (2D: q_1 = p turned by -90 degrees).
// Neither second derivatives of the height nor n_e are needed.
#pragma once

#include <cmath>
#include <cstring>

#define ENTS_ISA differentiation
#include "core/tangent/frictionless_tangent.hpp"
#include "differentiated.hpp"

namespace ents::differentiation {

// The number of derivatives, rounded up to whole registers: this makes Eigen's numbers twice as fast for 15
// dofs and does not change the time of Sacado's.
constexpr int padded(int dofs) { return (dofs + 3) / 4 * 4; }

// Numbers: make(value, dof), a number with derivative 1 along dof; value(x); derivative(x, dof);
// set_derivative(x, dof, v); and chain(value, slope, x), a function of x by its value and slope.
template <class Numbers, class B, bool H> struct DifferentiatedElement {
  using S = typename Numbers::Number;
  static constexpr int D = B::dim, T = D - 1, M = B::nodes, N = D * (M + 1);

  // Shape functions and their first derivatives at xi, X = double or S
  template <class X> struct Functions {
    X n[M], d1[T][M];
    explicit Functions(const X (&xi)[T]) {
      if constexpr (B::simplex) {
        n[0] = 1.0 - xi[0] - xi[1];
        n[1] = xi[0];
        n[2] = xi[1];
        for (int i = 0; i < M; ++i)
          for (int a = 0; a < T; ++a) d1[a][i] = X(i == 0 ? -1.0 : i == a + 1 ? 1.0 : 0.0);
      } else if constexpr (T == 1) {
        line(xi[0], n, d1[0]);
      } else {
        X f[2][order], g[2][order];
        line(xi[0], f[0], f[1]);
        line(xi[1], g[0], g[1]);
        for (int k = 0; k < M; ++k) {
          const int i = at_1[k], j = at_2[k];
          n[k] = f[0][i] * g[0][j];
          d1[0][k] = f[1][i] * g[0][j];
          d1[1][k] = f[0][i] * g[1][j];
        }
      }
    }
  };
  static constexpr int order = M == 9 ? 3 : 2; // functions of a line: ends, middle
  static constexpr int at_1[9] = {0, 1, 1, 0, 2, 1, 2, 0, 2}, at_2[9] = {0, 0, 1, 1, 0, 2, 1, 2, 2};
  template <class X> static void line(const X& x, X (&f)[order], X (&slope)[order]) {
    if constexpr (order == 2) {
      f[0] = 0.5 - 0.5 * x;
      f[1] = 0.5 + 0.5 * x;
      slope[0] = X(-0.5);
      slope[1] = X(0.5);
    } else {
      f[0] = 0.5 * x * (x - 1.0);
      f[1] = 0.5 * x * (x + 1.0);
      f[2] = 1.0 - x * x;
      slope[0] = x - 0.5;
      slope[1] = x + 0.5;
      slope[2] = -2.0 * x;
    }
  }

  // The surface at xi: x_s - rho_e, tangents of rho, and what comes with a height
  template <class X> struct At {
    S d[D], a[T][D];
    S m[H ? D : 1], n[H ? D : 1], area;
    X h;
    double h1[T]; // at constant xi only
  };

  static void normal_of(const S (&a)[T][D], S (&m)[D]) {
    if constexpr (D == 2) {
      m[0] = -a[0][1];
      m[1] = a[0][0];
    } else {
      cross(a[0], a[1], m);
    }
  }
  static void cross(const S (&a)[D], const S (&b)[D], S (&c)[D]) {
    if constexpr (D == 3) {
      c[0] = a[1] * b[2] - a[2] * b[1];
      c[1] = a[2] * b[0] - a[0] * b[2];
      c[2] = a[0] * b[1] - a[1] * b[0];
    }
  }
  static S dot(const S (&a)[D], const S (&b)[D]) {
    if constexpr (D == 2)
      return a[0] * b[0] + a[1] * b[1];
    else
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
  template <class W> static void sum(const W (&weights)[M], const S (&y)[M][D], S (&v)[D]) {
    for (int c = 0; c < D; ++c) {
      v[c] = weights[0] * y[0][c];
      for (int i = 1; i < M; ++i) v[c] += weights[i] * y[i][c];
    }
  }

  template <class X>
  static void surface(const Sine<double>& sine, const S (&y)[M][D], const X (&xi)[T],
                      const Functions<X>& shape, At<X>& at) {
    S rho[D];
    sum(shape.n, y, rho);
    for (int a = 0; a < T; ++a) sum(shape.d1[a], y, at.a[a]);
    if constexpr (H) {
      normal_of(at.a, at.m);
      using std::sqrt;
      at.area = sqrt(dot(at.m, at.m));
      const S inverse = 1.0 / at.area;
      for (int c = 0; c < D; ++c) at.n[c] = inverse * at.m[c];
      height(sine, xi, at);
      for (int c = 0; c < D; ++c) at.d[c] = -(rho[c] + at.h * at.n[c]);
    } else {
      for (int c = 0; c < D; ++c) at.d[c] = -rho[c];
    }
  }

  static void height(const Sine<double>& p, const double (&xi)[T], At<double>& at) {
    double turns = p.phase, sine, cosine;
    for (int a = 0; a < T; ++a) turns += p.wave_vector[a] * xi[a];
    sin_cos_turns(turns, 0.0, sine, cosine);
    at.h = p.amplitude * sine;
    for (int a = 0; a < T; ++a) at.h1[a] = (two_pi * p.wave_vector[a] * p.amplitude) * cosine;
  }
  static void height(const Sine<double>& p, const S (&xi)[T], At<S>& at) {
    S turns = p.wave_vector[0] * xi[0] + p.phase;
    if constexpr (T == 2) turns += p.wave_vector[1] * xi[1];
    double sine, cosine;
    sin_cos_turns(Numbers::value(turns), 0.0, sine, cosine);
    at.h = Numbers::chain(p.amplitude * sine, (two_pi * p.amplitude) * cosine, turns);
  }

  // r_a = rho_e,a . d at constant xi
  static void orthogonality(const S (&y)[M][D], const Shape<double, T, M>& shape, const At<double>& at,
                            S (&r)[T]) {
    S tangential[D]; // part of d, by h / |m|
    if constexpr (H) {
      const S along = dot(at.n, at.d), factor = at.h / at.area;
      for (int c = 0; c < D; ++c) tangential[c] = factor * (at.d[c] - along * at.n[c]);
      for (int a = 0; a < T; ++a) r[a] = dot(at.a[a], at.d) + at.h1[a] * along;
      // h n_,a . d = tangential . m_,a
      for (int a = 0; a < T; ++a) {
        if constexpr (D == 3) {
          S second[D], m1[D];
          if constexpr (B::second[1]) {
            sum(shape.d2[1], y, second);
            if (a == 0)
              cross(at.a[0], second, m1); // a_1 x a_2,1
            else
              cross(second, at.a[1], m1); // a_1,2 x a_2
            r[a] += dot(tangential, m1);
          }
          if constexpr (B::second[0]) {
            sum(shape.d2[2 * a], y, second);
            if (a == 0)
              cross(second, at.a[1], m1);
            else
              cross(at.a[0], second, m1);
            r[a] += dot(tangential, m1);
          }
        }
      }
    } else {
      for (int a = 0; a < T; ++a) r[a] = dot(at.a[a], at.d);
    }
  }

  static void evaluate(const bench::DifferentiationInput& in, double* residual, double* tangent) {
    // projection
    using Kernel = KernelBasis<B>;
    ElementNodes<Kernel, double> nodes(basis_of<Kernel>(Basis::quad9)); // the one that is counted here
    HeightNode node{};
    node.kind = HeightKind::sine;
    node.sine = {in.amplitude, {in.wave_vector[0], in.wave_vector[1]}, in.phase};
    nodes.has_coordinates = false;
    nodes.height = H ? &node : nullptr;
    for (int i = 0; i < M; ++i)
      for (int c = 0; c < D; ++c) nodes.y[i][c] = in.master[D * i + c] - in.slave[c];
    double start[T];
    for (int a = 0; a < T; ++a) start[a] = in.start[a];
    ProjectedPoint<Kernel, H, double> pair(nodes, start);
    pair.project();
    pair.evaluate_at_solution();
    const double(&f2)[symmetric_size<T>] = second_derivatives(pair);

    // master nodes relative to the slave node, their derivatives with respect to the dofs: 1, and -1 for the
    // slave node's
    S y[M][D];
    for (int i = 0; i < M; ++i)
      for (int c = 0; c < D; ++c) {
        y[i][c] = Numbers::make(nodes.y[i][c], D * (i + 1) + c);
        Numbers::set_derivative(y[i][c], c, -1.0);
      }

    // xi with its derivatives
    At<double> fixed;
    surface(node.sine, y, pair.xi, Functions<double>(pair.xi), fixed);
    Shape<double, T, M> curvatures;
    B::template shape<2>(pair.xi, curvatures);
    S r[T], xi[T];
    orthogonality(y, curvatures, fixed, r);
    if constexpr (T == 1) {
      xi[0] = pair.xi[0] + (1.0 / f2[0]) * r[0];
    } else {
      const double q = 1.0 / (f2[0] * f2[2] - f2[1] * f2[1]);
      xi[0] = pair.xi[0] + (q * f2[2]) * r[0] - (q * f2[1]) * r[1];
      xi[1] = pair.xi[1] + (q * f2[0]) * r[1] - (q * f2[1]) * r[0];
    }

    // residual
    const Functions<S> shape(xi);
    At<S> at;
    surface(node.sine, y, xi, shape, at);
    const double stiffness = in.area * in.stiffness;
    for (S& x : at.d) x *= stiffness;
    S q[T][D];
    if constexpr (H) {
      const S along = dot(at.n, at.d), factor = at.h / at.area;
      S p[D];
      for (int c = 0; c < D; ++c) p[c] = factor * (at.d[c] - along * at.n[c]);
      if constexpr (D == 2) {
        q[0][0] = p[1];
        q[0][1] = -p[0];
      } else {
        cross(at.a[1], p, q[0]);
        cross(p, at.a[0], q[1]);
      }
    }
    for (int c = 0; c < D; ++c) store(at.d[c], c, residual, tangent);
    for (int i = 0; i < M; ++i)
      for (int c = 0; c < D; ++c) {
        S force = -(shape.n[i] * at.d[c]);
        if constexpr (H)
          for (int a = 0; a < T; ++a) force -= shape.d1[a][i] * q[a][c];
        store(force, D * (i + 1) + c, residual, tangent);
      }
  }

private:
  static const double (
      &second_derivatives(ProjectedPoint<KernelBasis<B>, H, double>& pair))[symmetric_size<T>] {
    if constexpr (SurfaceAt<KernelBasis<B>, H, double>::closed_form)
      return pair.projector.base;
    else
      return pair.projector.f2;
  }
  static void store(const S& force, int row, double* residual, double* tangent) {
    residual[row] = Numbers::value(force);
    for (int j = 0; j < N; ++j) tangent[j * N + row] = Numbers::derivative(force, j); // column by column
  }
};

template <template <int> class Numbers, class B>
bench::DifferentiatedElement element_of_basis(bool enriched) {
  constexpr int N = B::dim * (B::nodes + 1);
  return enriched ? DifferentiatedElement<Numbers<N>, B, true>::evaluate
                  : DifferentiatedElement<Numbers<N>, B, false>::evaluate;
}
template <template <int> class Numbers>
bench::DifferentiatedElement element_of(const char* basis, bool enriched) {
  if (std::strcmp(basis, "line2") == 0) return element_of_basis<Numbers, Line2>(enriched);
  if (std::strcmp(basis, "tri3") == 0) return element_of_basis<Numbers, Tri3>(enriched);
  if (std::strcmp(basis, "quad4") == 0) return element_of_basis<Numbers, Quad4>(enriched);
  if (std::strcmp(basis, "quad9") == 0) return element_of_basis<Numbers, Quad9>(enriched);
  return nullptr;
}

} // namespace ents::differentiation
