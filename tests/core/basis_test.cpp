// Segment bases: what every one must satisfy, and what each promises of its derivatives.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include "core/surface/rho.hpp"
#include "worst.hpp"

namespace basis_test {
namespace {

using namespace ents::ENTS_ISA;

// Coefficients are small fractions, |xi| <= 1.3 and degrees <= 6: a few roundings of numbers up to 10.
constexpr double rounding = 1e-14;

template <class B> struct BasisTest : testing::Test {
  static constexpr int T = B::dim - 1, K = symmetric_size<T>, M = B::nodes;
  static constexpr bool smoothed = std::is_same_v<B, CatmullRom4> || std::is_same_v<B, BSpline4> ||
                                   std::is_same_v<B, CatmullRom16> || std::is_same_v<B, BSpline16>;
  static constexpr bool bezier = std::is_same_v<B, Bezier15>;
  static constexpr bool interpolating =
      !std::is_same_v<B, BSpline4> && !std::is_same_v<B, BSpline16> && !bezier;

  // The points lie up to z = -1.9 for triangles: quartics of up to 150 there
  static constexpr double rounded = bezier ? 20.0 * rounding : rounding;

  // All over the segment, its border included, and a little beyond
  static std::vector<std::array<double, T>> points() {
    std::vector<std::array<double, T>> out;
    const double first = B::simplex ? -0.1 : -1.3, step = B::simplex ? 0.15 : 0.26;
    for (int j = 0; j < (T == 2 ? 11 : 1); ++j)
      for (int i = 0; i < 11; ++i) {
        std::array<double, T> xi{};
        xi[0] = first + step * i;
        if constexpr (T == 2) xi[1] = first + step * j + 0.01;
        out.push_back(xi);
      }
    return out;
  }

  template <int Order> static Shape<double, T, M> shape(const std::array<double, T>& at) {
    double xi[T];
    for (int a = 0; a < T; ++a) xi[a] = at[static_cast<std::size_t>(a)];
    Shape<double, T, M> s{};
    B::template shape<Order>(xi, s);
    return s;
  }

  // Everything differentiated once more along xi_a
  template <int Order> static Shape<Dual<double>, T, M> along(const std::array<double, T>& at, int a) {
    Dual<double> xi[T];
    for (int b = 0; b < T; ++b) xi[b] = Dual<double>(at[static_cast<std::size_t>(b)], a == b ? 1.0 : 0.0);
    Shape<Dual<double>, T, M> s{};
    B::template shape<Order>(xi, s);
    return s;
  }

  // Natural coordinates of node i; of the smoothed bases: its place in the grid of nodes
  static std::array<double, 2> node(int i) {
    if constexpr (std::is_same_v<B, Line2>)
      return {2.0 * i - 1.0, 0.0};
    else if constexpr (std::is_same_v<B, Line3>)
      return {i == 0 ? -1.0 : (i == 1 ? 1.0 : 0.0), 0.0};
    else if constexpr (bezier)
      return {Bezier15::power[i][1] / 4.0, Bezier15::power[i][2] / 4.0};
    else if constexpr (smoothed)
      return {2.0 * (i % 4) - 3.0, T == 2 ? 2.0 * (i / 4) - 3.0 : 0.0};
    else if constexpr (B::simplex) {
      constexpr double p[6][2] = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
      return {p[i][0], p[i][1]};
    } else {
      constexpr double p[9][2] = {{-1, -1}, {1, -1}, {1, 1},  {-1, 1}, {0, -1},
                                  {1, 0},   {0, 1},  {-1, 0}, {0, 0}};
      return {p[i][0], p[i][1]};
    }
  }
};

using Bases = testing::Types<Line2, Line3, CatmullRom4, BSpline4, Tri3, Tri6, Quad4, Quad8, Quad9,
                             CatmullRom16, BSpline16, Bezier15>;
TYPED_TEST_SUITE(BasisTest, Bases);

TYPED_TEST(BasisTest, SumsToOne) {
  for (const auto& xi : this->points()) {
    const auto s = this->template shape<3>(xi);
    double sum = 0.0, sum_1[2] = {}, sum_2[3] = {}, sum_3[4] = {};
    for (int i = 0; i < TypeParam::nodes; ++i) {
      sum += s.n[i];
      for (int a = 0; a < this->T; ++a) sum_1[a] += s.d1[a][i];
      for (int k = 0; k < this->K; ++k) sum_2[k] += s.d2[k][i]; // zero where the basis does not write
      for (int k = 0; k < (this->T == 1 ? 1 : 4); ++k) sum_3[k] += s.d3[k][i];
    }
    EXPECT_NEAR(sum, 1.0, TestFixture::rounded);
    for (const double x : sum_1) EXPECT_NEAR(x, 0.0, TestFixture::rounded);
    for (const double x : sum_2) EXPECT_NEAR(x, 0.0, TestFixture::rounded);
    for (const double x : sum_3) EXPECT_NEAR(x, 0.0, TestFixture::rounded);
  }
}

// x = sum N_i x_i for the coordinates themselves; the product of quadratics where the basis is complete to
// that degree
TYPED_TEST(BasisTest, ReproducesPolynomials) {
  constexpr bool linear =
      std::is_same_v<TypeParam, Line2> || std::is_same_v<TypeParam, Tri3> || std::is_same_v<TypeParam, Quad4>;
  for (const auto& xi : this->points()) {
    const auto s = this->template shape<0>(xi);
    const double x = xi[0], y = this->T == 2 ? xi[static_cast<std::size_t>(this->T - 1)] : 0.0;
    double sum_x = 0.0, sum_y = 0.0, sum_xx = 0.0, sum_xy = 0.0, sum_yy = 0.0;
    for (int i = 0; i < TypeParam::nodes; ++i) {
      const auto p = this->node(i);
      sum_x += s.n[i] * p[0];
      sum_y += s.n[i] * p[1];
      sum_xx += s.n[i] * p[0] * p[0];
      sum_xy += s.n[i] * p[0] * p[1];
      sum_yy += s.n[i] * p[1] * p[1];
    }
    EXPECT_NEAR(sum_x, x, rounding);
    if (this->T == 2) {
      EXPECT_NEAR(sum_y, y, rounding);
    }
    if constexpr (linear) continue;
    // an approximating spline adds spacing^2 / 3 to a square: 4 / 3
    const double shift = this->interpolating ? 0.0 : 4.0 / 3.0;
    if constexpr (TestFixture::bezier) {
      // a Bernstein polynomial of degree 4 shortens a square: 3/4 of it and 1/4 of the coordinate
      EXPECT_NEAR(sum_xx, 0.75 * x * x + 0.25 * x, rounding);
      EXPECT_NEAR(sum_xy, 0.75 * x * y, rounding);
      continue;
    }
    EXPECT_NEAR(sum_xx, x * x + shift, 10 * rounding);
    if (this->T == 2) {
      EXPECT_NEAR(sum_xy, x * y, 10 * rounding);
      EXPECT_NEAR(sum_yy, y * y + shift, 10 * rounding);
    }
  }
}

TYPED_TEST(BasisTest, IsOneAtItsOwnNodeAndZeroAtTheOthers) {
  if (this->bezier) { // in its corners only
    for (int j = 0; j < 3; ++j) {
      std::array<double, TestFixture::T> xi{};
      for (std::size_t a = 0; a < xi.size(); ++a) xi[a] = this->node(j)[a];
      const auto s = this->template shape<0>(xi);
      for (int i = 0; i < TypeParam::nodes; ++i) EXPECT_NEAR(s.n[i], i == j ? 1.0 : 0.0, rounding);
    }
    return;
  }
  if (!this->interpolating) {
    // the B-spline's weights at a node of the grid: 1/6 4/6 1/6
    std::array<double, TestFixture::T> xi{};
    xi.fill(-1.0);
    const auto at_node = this->template shape<0>(xi);
    const double w[4] = {1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0, 0.0};
    for (int i = 0; i < TypeParam::nodes; ++i)
      EXPECT_NEAR(at_node.n[i], w[i % 4] * (this->T == 2 ? w[i / 4] : 1.0), rounding);
    return;
  }
  for (int j = 0; j < TypeParam::nodes; ++j) {
    const auto p = this->node(j);
    if (std::fabs(p[0]) > 1.0 || std::fabs(p[1]) > 1.0) continue; // beside the segment
    std::array<double, TestFixture::T> xi{};
    for (std::size_t a = 0; a < xi.size(); ++a) xi[a] = p[a];
    const auto s = this->template shape<0>(xi);
    for (int i = 0; i < TypeParam::nodes; ++i)
      EXPECT_NEAR(s.n[i], i == j ? 1.0 : 0.0, rounding) << i << " at node " << j;
  }
}

// Every derivative is the derivative of the one before, by dual numbers; and `second`, `third` tell which
// vanish identically.
TYPED_TEST(BasisTest, DerivativesFollowFromEachOther) {
  using B = TypeParam;
  constexpr int parameters = TestFixture::T;
  double largest_2[3] = {}, largest_3[4] = {};
  for (const auto& xi : this->points()) {
    const auto s = this->template shape<3>(xi);
    for (int a = 0; a < parameters; ++a) {
      const auto d = this->template along<2>(xi, a);
      for (int i = 0; i < B::nodes; ++i) {
        EXPECT_NEAR(d.n[i].v, s.n[i], TestFixture::rounded);
        EXPECT_NEAR(d.n[i].d, s.d1[a][i], TestFixture::rounded);
        for (int b = 0; b < parameters; ++b) {
          const int k = symmetric_index(a, b);
          test::raise(largest_2[k], std::fabs(d.d1[b][i].d));
          if (B::second[k]) {
            EXPECT_NEAR(d.d1[b][i].d, s.d2[k][i], TestFixture::rounded) << a << b;
          }
        }
        for (int k = 0; k < TestFixture::K; ++k) {
          const int abc = k + a; // 11 12 22 and 1 2
          if (!B::second[k]) continue;
          test::raise(largest_3[abc], std::fabs(d.d2[k][i].d));
          if (B::third[abc]) {
            EXPECT_NEAR(d.d2[k][i].d, s.d3[abc][i], TestFixture::rounded) << k << " along " << a;
          }
        }
      }
    }
  }
  for (int k = 0; k < TestFixture::K; ++k) EXPECT_EQ(B::second[k], largest_2[k] > 1e-3) << k;
  for (int k = 0; k < (parameters == 1 ? 1 : 4); ++k) EXPECT_EQ(B::third[k], largest_3[k] > 1e-3) << k;
  bool bends = false;
  for (const bool second : B::second) bends = bends || second;
  EXPECT_EQ(is_flat<B>, !bends);
}

// Asking for less gives the same bits.
TYPED_TEST(BasisTest, LowerOrdersAreTheSameNumbers) {
  for (const auto& xi : this->points()) {
    const auto s0 = this->template shape<0>(xi), s1 = this->template shape<1>(xi),
               s2 = this->template shape<2>(xi), s3 = this->template shape<3>(xi);
    for (int i = 0; i < TypeParam::nodes; ++i) {
      EXPECT_EQ(s0.n[i], s3.n[i]);
      EXPECT_EQ(s1.n[i], s3.n[i]);
      EXPECT_EQ(s2.n[i], s3.n[i]);
      for (int a = 0; a < this->T; ++a) {
        EXPECT_EQ(s1.d1[a][i], s3.d1[a][i]);
        EXPECT_EQ(s2.d1[a][i], s3.d1[a][i]);
      }
      for (int k = 0; k < this->K; ++k)
        if (TypeParam::second[k]) {
          EXPECT_EQ(s2.d2[k][i], s3.d2[k][i]);
        }
    }
  }
}

template <class B> ents::Basis name_of() {
#define ENTS_BASIS(name, type, ...)                                                                          \
  if (std::is_same_v<B, type>) return ents::Basis::name;
  ENTS_BASES(ENTS_BASIS)
#undef ENTS_BASIS
  return ents::Basis::line2;
}

// The kernels know all but three bases as one type, whose nodes are counted: the same numbers.
TYPED_TEST(BasisTest, IsTheSameWhereItIsCounted) {
  using B = TypeParam;
  if constexpr (compiled_alone<B>) {
    EXPECT_TRUE((std::is_same_v<KernelBasis<B>, B>));
  } else {
    using C = CountedBasis<B::dim>;
    EXPECT_TRUE((std::is_same_v<KernelBasis<B>, C>));
    const C counted = basis_of<C>(name_of<B>());
    EXPECT_EQ(node_count(counted), B::nodes);
    EXPECT_EQ(is_simplex(counted), B::simplex);
    EXPECT_EQ(has_thirds(counted), any_third<B>());
    for (int k = 0; k < (this->T == 1 ? 1 : 4); ++k) EXPECT_EQ(has_third(counted, k), B::third[k]) << k;
    for (const auto& at : this->points()) {
      double xi[TestFixture::T];
      for (int a = 0; a < this->T; ++a) xi[a] = at[static_cast<std::size_t>(a)];
      const auto own = this->template shape<3>(at);
      Shape<double, TestFixture::T, C::nodes> s{};
      counted.template shape<3>(xi, s);
      for (int i = 0; i < B::nodes; ++i) {
        EXPECT_EQ(s.n[i], own.n[i]);
        for (int a = 0; a < this->T; ++a) EXPECT_EQ(s.d1[a][i], own.d1[a][i]);
        for (int k = 0; k < this->K; ++k) EXPECT_EQ(s.d2[k][i], own.d2[k][i]);
        for (int k = 0; k < (this->T == 1 ? 1 : 4); ++k) EXPECT_EQ(s.d3[k][i], own.d3[k][i]);
      }
    }
  }
}

// rho as a polynomial is the sum over the nodes.
TYPED_TEST(BasisTest, IsAPolynomialOfItsNodes) {
  using B = TypeParam;
  using C = KernelBasis<B>;
  if constexpr (!is_flat<B>) {
    ElementNodes<C, double> nodes(basis_of<C>(name_of<B>()));
    nodes.has_coordinates = false;
    for (int i = 0; i < B::nodes; ++i)
      for (int c = 0; c < B::dim; ++c) nodes.y[i][c] = std::sin(1.0 + 7.0 * i + 3.0 * c);
    const Rho<C, double> rho(nodes);
    const double tolerance = 100.0 * TestFixture::rounded;
    for (const auto& at : this->points()) {
      double xi[TestFixture::T];
      for (int a = 0; a < this->T; ++a) xi[a] = at[static_cast<std::size_t>(a)];
      Shape<double, TestFixture::T, C::nodes> unused;
      Surface<C, true, double> s;
      rho.template evaluate<3>(nodes, xi, unused, s);
      const auto own = this->template shape<3>(at);
      const auto sum = [&](const double(&n)[B::nodes], int c) {
        double of = 0.0;
        for (int i = 0; i < B::nodes; ++i) of += n[i] * nodes.y[i][c];
        return of;
      };
      for (int c = 0; c < B::dim; ++c) {
        EXPECT_NEAR(-s.d[c], sum(own.n, c), tolerance);
        for (int a = 0; a < this->T; ++a) EXPECT_NEAR(s.a[a][c], sum(own.d1[a], c), tolerance);
        for (int k = 0; k < this->K; ++k)
          if (B::second[k]) {
            EXPECT_NEAR(s.a2[k][c], sum(own.d2[k], c), tolerance);
          }
        for (int k = 0; k < (this->T == 1 ? 1 : 4); ++k)
          if (B::third[k]) {
            EXPECT_NEAR(s.a3[k][c], sum(own.d3[k], c), tolerance);
          }
      }
    }
  }
}

// Smoothed lines of five nodes: segments 0..3 and 1..4 meet with Continuity common derivatives.
template <class B> void meets_its_neighbour(int continuity) {
  const double end[1] = {1.0}, begin[1] = {-1.0};
  Shape<double, 1, 4> left{}, right{};
  B::template shape<2>(end, left);
  B::template shape<2>(begin, right);
  for (int i = 0; i < 5; ++i) { // weight of node i of the five
    const double l[3] = {i < 4 ? left.n[i] : 0.0, i < 4 ? left.d1[0][i] : 0.0, i < 4 ? left.d2[0][i] : 0.0};
    const double r[3] = {i > 0 ? right.n[i - 1] : 0.0, i > 0 ? right.d1[0][i - 1] : 0.0,
                         i > 0 ? right.d2[0][i - 1] : 0.0};
    for (int order = 0; order <= continuity; ++order)
      EXPECT_NEAR(l[order], r[order], rounding) << "order " << order << ", node " << i;
  }
}

TEST(SmoothedBases, CatmullRomIsContinuouslyDifferentiable) {
  meets_its_neighbour<CatmullRom4>(1);
  // and no more than that
  const double end[1] = {1.0}, begin[1] = {-1.0};
  Shape<double, 1, 4> left{}, right{};
  CatmullRom4::shape<2>(end, left);
  CatmullRom4::shape<2>(begin, right);
  EXPECT_GT(std::fabs(left.d2[0][1] - right.d2[0][0]), 0.1);
}

TEST(SmoothedBases, BSplineIsTwiceContinuouslyDifferentiable) { meets_its_neighbour<BSpline4>(2); }

} // namespace
} // namespace basis_test
