#include "bases.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <initializer_list>
#include <stdexcept>

namespace mechanics {

namespace {

std::vector<std::array<double, 2>> four_by_four() {
  std::vector<std::array<double, 2>> points;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) points.push_back({2.0 * i - 3.0, 2.0 * j - 3.0});
  return points;
}

// Lagrange polynomial of `own` among `nodes`
template <class S> S lagrange(std::initializer_list<double> nodes, double own, S x) {
  S value = 1.0;
  for (const double other : nodes)
    if (other != own) value *= (x - other) / (own - other);
  return value;
}

// Cubic Hermite interpolation between the middle two of four values, with the slopes (p_{i+1} - p_{i-1}) / 2
template <class S> S catmull_rom(int node, S x) {
  const S t = 0.5 * (x + 1.0), q = 1.0 - t;
  double p[4] = {};
  p[node] = 1.0;
  return p[1] * (1.0 + 2.0 * t) * q * q + 0.5 * (p[2] - p[0]) * t * q * q + p[2] * t * t * (3.0 - 2.0 * t) -
         0.5 * (p[3] - p[1]) * t * t * q;
}

// B-spline over the knots first, first + 1, ..., on the span 3 .. 4
template <class S> S cox_de_boor(int first, int degree, S t) {
  if (degree == 0) return first == 3 ? 1.0 : 0.0;
  const double k = first, d = degree;
  return (t - k) / d * cox_de_boor(first, degree - 1, t) +
         (k + d + 1.0 - t) / d * cox_de_boor(first + 1, degree - 1, t);
}

// One direction; `node` is the natural coordinate of the node.
template <class S> S on_line(Family family, double node, S x) {
  switch (family) {
  case Family::linear:
    return lagrange({-1.0, 1.0}, node, x);
  case Family::quadratic:
    return lagrange({-1.0, 0.0, 1.0}, node, x);
  case Family::catmull_rom:
    return catmull_rom(static_cast<int>(node + 3.0) / 2, x);
  default:
    return cox_de_boor(static_cast<int>(node + 3.0) / 2, 3, 3.0 + 0.5 * (x + 1.0));
  }
}

template <class S> S shape(const Basis& basis, int node, S x, S y) {
  const double xn = basis.nodes[static_cast<std::size_t>(node)][0];
  const double yn = basis.nodes[static_cast<std::size_t>(node)][1];
  if (basis.dimension == 2) return on_line(basis.family, xn, x);
  if (basis.simplex) {
    const S l[3] = {1.0 - x - y, x, y}; // area coordinates
    if (basis.family == Family::bernstein) {
      const int j = static_cast<int>(4.0 * xn), k = static_cast<int>(4.0 * yn), powers[3] = {4 - j - k, j, k};
      S value = 24.0;
      for (int a = 0; a < 3; ++a)
        for (int e = 1; e <= powers[a]; ++e) value *= l[a] / static_cast<double>(e);
      return value;
    }
    if (basis.family == Family::linear) return l[node];
    if (node < 3) return l[node] * (2.0 * l[node] - 1.0);
    return 4.0 * l[node - 3] * l[(node - 2) % 3];
  }
  if (basis.family == Family::serendipity) {
    if (xn == 0.0) return 0.5 * (1.0 - x * x) * (1.0 + yn * y);
    if (yn == 0.0) return 0.5 * (1.0 + xn * x) * (1.0 - y * y);
    return 0.25 * (1.0 + xn * x) * (1.0 + yn * y) * (xn * x + yn * y - 1.0);
  }
  return on_line(basis.family, xn, x) * on_line(basis.family, yn, y);
}

} // namespace

const std::vector<Basis>& bases() {
  using F = Family;
  static const std::vector<Basis> table = {
      {"line2", F::linear, 2, false, {{-1, 0}, {1, 0}}},
      {"line3", F::quadratic, 2, false, {{-1, 0}, {1, 0}, {0, 0}}},
      {"catmull_rom4", F::catmull_rom, 2, false, {{-3, 0}, {-1, 0}, {1, 0}, {3, 0}}},
      {"bspline4", F::bspline, 2, false, {{-3, 0}, {-1, 0}, {1, 0}, {3, 0}}},
      {"tri3", F::linear, 3, true, {{0, 0}, {1, 0}, {0, 1}}},
      {"tri6", F::quadratic, 3, true, {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}},
      {"quad4", F::linear, 3, false, {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}},
      {"quad8",
       F::serendipity,
       3,
       false,
       {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}}},
      {"quad9",
       F::quadratic,
       3,
       false,
       {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, 0}}},
      {"catmull_rom16", F::catmull_rom, 3, false, four_by_four()},
      {"bspline16", F::bspline, 3, false, four_by_four()},
  };
  return table;
}

const std::vector<Basis>& all_bases() {
  static const std::vector<Basis> table = [] {
    std::vector<Basis> all = bases();
    all.push_back({"bezier15",
                   Family::bernstein,
                   3,
                   true,
                   {{0, 0},
                    {1, 0},
                    {0, 1},
                    {0.25, 0},
                    {0.5, 0},
                    {0.75, 0},
                    {0.75, 0.25},
                    {0.5, 0.5},
                    {0.25, 0.75},
                    {0, 0.75},
                    {0, 0.5},
                    {0, 0.25},
                    {0.25, 0.25},
                    {0.5, 0.25},
                    {0.25, 0.5}}});
    return all;
  }();
  return table;
}

const Basis& basis_named(const std::string& name) {
  for (const Basis& basis : all_bases())
    if (basis.name == name) return basis;
  throw std::invalid_argument(name);
}

namespace {

std::vector<std::string> names_of(const std::vector<Basis>& some) {
  std::vector<std::string> names;
  for (const Basis& basis : some) names.push_back(basis.name);
  return names;
}

} // namespace

std::vector<std::string> basis_names() { return names_of(bases()); }
std::vector<std::string> all_basis_names() { return names_of(all_bases()); }

namespace {

// Of a quadrilateral whose shape functions are products: the factors of each direction, of every node of a row.
template <class S> struct Factors {
  explicit Factors(const Basis& basis, const S& x, const S& y)
      : count(basis.family == Family::linear      ? 2
              : basis.family == Family::quadratic ? 3
                                                  : 4),
        first(count == 4 ? -3.0 : -1.0), apart(count == 3 ? 1.0 : 2.0) {
    for (int i = 0; i < count; ++i) {
      f[i] = on_line(basis.family, first + apart * i, x);
      g[i] = on_line(basis.family, first + apart * i, y);
    }
  }
  const S& along_1(const std::array<double, 2>& node) const {
    return f[static_cast<int>((node[0] - first) / apart)];
  }
  const S& along_2(const std::array<double, 2>& node) const {
    return g[static_cast<int>((node[1] - first) / apart)];
  }
  static bool are_of(const Basis& basis) {
    return basis.dimension == 3 && !basis.simplex && basis.family != Family::serendipity;
  }

  int count;
  double first, apart;
  S f[4], g[4];
};

} // namespace

std::vector<double> shape_values(const Basis& basis, const double* xi) {
  std::vector<double> out;
  out.reserve(basis.nodes.size());
  if (Factors<double>::are_of(basis)) {
    const Factors<double> factors(basis, xi[0], xi[1]);
    for (const auto& node : basis.nodes) out.push_back(factors.along_1(node) * factors.along_2(node));
    return out;
  }
  for (int i = 0; i < basis.node_count(); ++i)
    out.push_back(shape(basis, i, xi[0], basis.dimension == 3 ? xi[1] : 0.0));
  return out;
}

// Derivatives by a complex step: f'(x) = Im f(x + i h) / h, without any difference of close numbers.
Shape shape_functions(const Basis& basis, const double* xi) {
  using Complex = std::complex<double>;
  constexpr double h = 1e-30;
  const double y = basis.dimension == 3 ? xi[1] : 0.0;
  Shape out;
  for (std::vector<double>* row : {&out.value, &out.d1, &out.d2}) row->reserve(basis.nodes.size());
  if (Factors<Complex>::are_of(basis)) {
    const Factors<Complex> factors(basis, Complex(xi[0], h), Complex(xi[1], h));
    for (const auto& node : basis.nodes) {
      const Complex &a = factors.along_1(node), &b = factors.along_2(node);
      out.value.push_back(a.real() * b.real());
      out.d1.push_back(a.imag() / h * b.real());
      out.d2.push_back(a.real() * (b.imag() / h));
    }
    return out;
  }
  for (int i = 0; i < basis.node_count(); ++i) {
    const Complex along_1 = shape(basis, i, Complex(xi[0], h), Complex(y));
    out.value.push_back(along_1.real());
    out.d1.push_back(along_1.imag() / h);
    out.d2.push_back(basis.dimension == 3 ? shape(basis, i, Complex(xi[0]), Complex(y, h)).imag() / h : 0.0);
  }
  return out;
}

bool is_on_border(const Basis& basis, const std::array<double, 2>& xi) {
  const double inside = basis.simplex ? std::min({xi[0], xi[1], 1.0 - xi[0] - xi[1]})
                                      : 1.0 - std::max(std::fabs(xi[0]), std::fabs(xi[1]));
  return inside < 1e-5;
}

} // namespace mechanics
