// Projection, forces and tangent alone: the headers of the fast block on random segments, without a model.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "core/element/fast_block.hpp"

namespace element_test {
namespace {

using namespace ents;
using namespace ents::ENTS_ISA;

template <class Type, Basis name> struct Kind {
  using B = Type;
  static constexpr Basis basis = name;
};

template <class K> class Element : public testing::Test {
protected:
  using B = typename K::B;
  static constexpr int D = B::dim, T = D - 1, most = D * (B::nodes + 1);
  using Point = ProjectedPoint<B, true, double>;

  Element() {
    plan.law.has_slope = true;
    plan.law.number[0] = 3.0;
    plan.law.normal = NormalKind::penalty;
    plan.border = 0.2;
    height.kind = HeightKind::sine;
    height.sine = {0.03, {0.4, 0.3}, 0.2};
    plan.height = &height, plan.height_nodes = 1, plan.height_bound = 0.03;
  }

  double random(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
  int dofs() const { return D * (node_count(basis) + 1); }

  // Nodes of a nearly regular segment, and a slave a little below it: u [dofs], the slave first
  void draw() {
    const bool simplex = is_simplex(basis);
    for (int a = 0; a < T; ++a) start[a] = simplex ? random(0.2, 0.4) : random(-0.6, 0.6);
    double local[T];
    for (int a = 0; a < T; ++a) local[a] = start[a];
    Shape<double, T, B::nodes> N{};
    basis.template shape<0>(local, N);
    const int n = node_count(basis);
    for (int i = 0; i < n; ++i) {
      double place[2] = {0.0, 0.0};
      place_of_node(i, place);
      for (int a = 0; a < T; ++a) u[D * (i + 1) + a] = place[a] + random(-0.05, 0.05);
      u[D * (i + 1) + T] = random(-0.05, 0.05);
    }
    for (int k = 0; k < D; ++k) {
      u[k] = 0.0;
      for (int i = 0; i < n; ++i) u[k] += N.n[i] * u[D * (i + 1) + k];
    }
    u[T] -= 0.05; // below the surface and its height
    for (int a = 0; a < T; ++a) from[a] = start[a] + random(-0.3, 0.3);
  }
  void place_of_node(int i, double (&place)[2]) const {
    static constexpr double quad[9][2] = {{-1, -1}, {1, -1}, {1, 1},  {-1, 1}, {0, -1},
                                          {1, 0},   {0, 1},  {-1, 0}, {0, 0}};
    static constexpr double triangle[6][2] = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
    if (K::basis == Basis::bspline4)
      place[0] = 2.0 * i - 3.0;
    else if (T == 1)
      place[0] = i == 2 ? 0.0 : 2.0 * i - 1.0;
    else
      for (int a = 0; a < T; ++a) place[a] = is_simplex(basis) ? triangle[i][a] : quad[i][a];
  }

  struct Result {
    double gap, energy, residual[most], tangent[most * most];
    double off; // |rho_e,a . d| of the projection
    bool ordinary, contact, slip;
  };
  template <bool F> Result evaluate(const double (&x)[most], bool wants_tangent) {
    ElementNodes<B, double> nodes(basis);
    nodes.has_coordinates = false;
    nodes.height = &height;
    for (int i = 0; i < node_count(basis); ++i)
      for (int k = 0; k < D; ++k) nodes.y[i][k] = x[D * (i + 1) + k] - x[k];
    Point p(nodes, start);
    Friction<double, T> f{};
    SlipBegin<double, T> begin{};
    for (int a = 0; a < T; ++a) begin.from[a] = from[a];
    begin.known = 1.0;
    p.area = 1.3;
    p.project();
    evaluate_law<F>(plan, want::tangent | want::residual | want::gap, p, f, &begin);
    Result out{};
    out.gap = p.gap, out.ordinary = p.ordinary, out.contact = p.contact;
    out.energy = p.contact ? 0.5 * p.area * plan.law.number[0] * p.gap * p.gap : 0.0;
    for (int a = 0; a < T; ++a)
      out.off = std::max(out.off, std::fabs(dot(p.projector.s.d, p.projector.s.e[a])));
    if constexpr (F) out.slip = f.slip;
    residual<F, false>(p, f, out.residual);
    if (wants_tangent) {
      TangentOf<F, false, B, true, double> t;
      tangent<F, false>(plan, p, f, t);
      write_tangent<D>(t, out.tangent, dofs());
    }
    return out;
  }

  template <class F> void differences(F&& of, double (&column)[most], int j) {
    constexpr double h = 1e-6;
    double moved[most];
    std::copy_n(u, most, moved);
    moved[j] = u[j] + h;
    const Result more = of(moved);
    moved[j] = u[j] - h;
    const Result less = of(moved);
    rate = (more.energy - less.energy) / (2.0 * h);
    same = more.slip == less.slip;
    for (int i = 0; i < dofs(); ++i) column[i] = (more.residual[i] - less.residual[i]) / (2.0 * h);
  }

  const B basis = basis_of<B>(K::basis);
  std::mt19937 engine{5};
  Plan plan{};
  HeightNode height{};
  double start[T], from[T], u[most], rate = 0.0;
  bool same = true;
};

using Kinds = testing::Types<Kind<Line2, Basis::line2>, Kind<Tri3, Basis::tri3>, Kind<Quad4, Basis::quad4>,
                             Kind<CountedBasis<2>, Basis::line3>, Kind<CountedBasis<2>, Basis::bspline4>,
                             Kind<CountedBasis<3>, Basis::tri6>, Kind<CountedBasis<3>, Basis::quad9>>;
TYPED_TEST_SUITE(Element, Kinds);

TYPED_TEST(Element, ProjectsAtARightAngleAndIsClosedBelowTheSurface) {
  for (int i = 0; i < 300; ++i) {
    this->draw();
    const auto at = this->template evaluate<false>(this->u, false);
    ASSERT_TRUE(at.ordinary);
    ASSERT_LE(at.off, 1e-14);
    ASSERT_TRUE(at.contact);
    ASSERT_LT(at.gap, 0.0);
  }
}

TYPED_TEST(Element, ResidualIsTheDerivativeOfTheEnergyAndTangentThatOfTheResidual) {
  for (int i = 0; i < 60; ++i) {
    this->draw();
    const auto at = this->template evaluate<false>(this->u, true);
    double column[TestFixture::most];
    for (int j = 0; j < this->dofs(); ++j) {
      this->differences([&](auto& x) { return this->template evaluate<false>(x, false); }, column, j);
      ASSERT_NEAR(at.residual[j], this->rate, 1e-8);
      for (int k = 0; k < this->dofs(); ++k) ASSERT_NEAR(at.tangent[j * this->dofs() + k], column[k], 1e-7);
    }
  }
}

TYPED_TEST(Element, TangentWithFrictionIsTheDerivativeOfTheResidual) {
  this->plan.law.friction = FrictionKind::coulomb;
  this->plan.law.friction_stiffness = 2.0;
  int slips = 0, sticks = 0;
  for (int i = 0; i < 60; ++i) {
    this->plan.law.friction_coefficient = i % 2 == 0 ? 0.2 : 20.0;
    this->draw();
    const auto at = this->template evaluate<true>(this->u, true);
    double column[TestFixture::most];
    for (int j = 0; j < this->dofs(); ++j) {
      this->differences([&](auto& x) { return this->template evaluate<true>(x, false); }, column, j);
      for (int k = 0; k < this->dofs() && this->same; ++k)
        ASSERT_NEAR(at.tangent[j * this->dofs() + k], column[k], 1e-6);
    }
    (at.slip ? slips : sticks) += 1;
  }
  EXPECT_GE(slips, 20);
  EXPECT_GE(sticks, 20);
}

} // namespace
} // namespace element_test
