// SPDX-License-Identifier: BSD-3-Clause
// Bounds of a segment over boxes: no point of a box is outside them, and they are narrow.
#include "core/projection/net.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

namespace ents::net_test {
namespace {

using namespace ents::ENTS_ISA;

template <class Type, Basis name> struct Kind {
  using B = Type;
  static constexpr Basis basis = name;
};

template <class K> class NetTest : public testing::Test {
protected:
  using B = typename K::B;
  static constexpr int D = B::dim, T = D - 1;

  NetTest() {
    height.kind = HeightKind::sine;
    height.sine = {0.08, {0.7, -0.4}, 0.2};
    g.height = &height;
  }
  double random(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }

  // Nodes at random round a regular place far from the slave, with surface coordinates or without.
  void draw(double waves) {
    const double far[3] = {7.0, -5.0, 3.0};
    for (int i = 0; i < node_count(basis); ++i)
      for (int k = 0; k < D; ++k) {
        const double place = k == T ? 0.0 : i % (k == 0 ? 4 : 3) + 0.1 * i;
        g.y[i][k] = far[k] + place + random(-waves, waves);
      }
    g.smallest_area2 = 1e-20;
    for (double& s : coordinates) s = random(20.0, 22.0);
    g.surface_coordinates = engine() % 2 == 0 ? coordinates : nullptr;
  }

  // A box of the domain with its border, and a point of it.
  void draw_box(double half) {
    const Domain<B> domain(basis, border);
    for (int a = 0; a < T; ++a) {
      const double w = half * domain.width;
      box[a] = {random(domain.low + w, domain.low + domain.width - w), w};
      at[a] = box[a].v + random(-w, w);
    }
  }

  std::mt19937_64 engine{20};
  const B basis = basis_of<B>(K::basis);
  const double border = 0.01;
  Geometry<B> g{basis};
  HeightNode height{};
  double coordinates[T * B::nodes];
  Ball box[T];
  double at[T];
};

struct Compared {
  double outside = 0.0; // largest distance of a value from its bounds, of the value's size
  double off_centre = 0.0;
  void take(const Ball& bound, double inside, double centre) {
    const double size = 1.0 + std::abs(bound.v);
    outside = std::max(outside, (std::abs(inside - bound.v) - bound.r) / size);
    off_centre = std::max(off_centre, std::abs(centre - bound.v) / size);
  }
  template <int D>
  void take(const Vec<Ball, D>& bound, const Vec<double, D>& inside, const Vec<double, D>& centre) {
    for (int k = 0; k < D; ++k) take(bound[k], inside[k], centre[k]);
  }
};

using Kinds = testing::Types<Kind<CountedBasis<2>, Basis::line3>, Kind<CountedBasis<2>, Basis::catmull_rom4>,
                             Kind<CountedBasis<2>, Basis::bspline4>, Kind<CountedBasis<3>, Basis::tri6>,
                             Kind<CountedBasis<3>, Basis::quad8>, Kind<CountedBasis<3>, Basis::quad9>,
                             Kind<CountedBasis<3>, Basis::catmull_rom16>,
                             Kind<CountedBasis<3>, Basis::bspline16>, Kind<CountedBasis<3>, Basis::bezier15>>;
struct Names {
  template <class K> static std::string GetName(int) { return basis_entry(K::basis).name; }
};
TYPED_TEST_SUITE(NetTest, Kinds, Names);

template <bool Enriched, class B, int T>
void compare(const Geometry<B>& g, double border, const Ball (&box)[T], const double (&at)[T], Compared& to,
             int& normals) {
  const SurfaceRange<2, B, Enriched> range(g, border);
  Surface<B, Enriched, Ball> bound;
  if (!range(box, bound)) return; // no normal somewhere
  ++normals;
  double centre[T];
  for (int a = 0; a < T; ++a) centre[a] = box[a].v;
  Shape<double, T, B::nodes> N;
  Surface<B, Enriched, double> inside, middle;
  ASSERT_TRUE(evaluate_surface<2>(g, at, N, inside));
  ASSERT_TRUE(evaluate_surface<2>(g, centre, N, middle));
  to.take(bound.d, inside.d, middle.d);
  for (int a = 0; a < T; ++a) to.take(bound.e[a], inside.e[a], middle.e[a]);
  for (int k = 0; k < symmetric_size<T>; ++k) to.take(bound.e2[k], inside.e2[k], middle.e2[k]);
}

TYPED_TEST(NetTest, NoPointOfABoxIsOutside) {
  using Type = typename TypeParam::B;
  Compared plain, enriched;
  int normals[2] = {0, 0};
  for (int draw = 0; draw < 4000; ++draw) {
    this->draw(0.3);
    this->draw_box(std::pow(10.0, this->random(-9.0, -0.31)));
    compare<false, Type>(this->g, this->border, this->box, this->at, plain, normals[0]);
    compare<true, Type>(this->g, this->border, this->box, this->at, enriched, normals[1]);
  }
  EXPECT_GT(normals[0], 2000);
  EXPECT_GT(normals[1], 2000);
  for (const Compared& c : {plain, enriched}) {
    EXPECT_LT(c.outside, 1e-12);
    EXPECT_LT(c.off_centre, 1e-10);
  }
}

// Natural coordinates at which all shape functions reproduce a linear function from its values.
void place_of_node(Basis basis, int i, double (&place)[2]) {
  static constexpr double quad[9][2] = {{-1, -1}, {1, -1}, {1, 1},  {-1, 1}, {0, -1},
                                        {1, 0},   {0, 1},  {-1, 0}, {0, 0}};
  static constexpr double triangle[6][2] = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
  const bool quadratic = basis == Basis::quad8 || basis == Basis::quad9;
  for (int a = 0; a < 2; ++a) {
    if (basis == Basis::line3)
      place[a] = i == 2 ? 0.0 : 2.0 * i - 1.0;
    else if (basis == Basis::tri6)
      place[a] = triangle[i][a];
    else if (basis == Basis::bezier15)
      place[a] = Bezier15::power[i][a + 1] / 4.0;
    else if (quadratic)
      place[a] = quad[i][a];
    else // cubic splines, row by row
      place[a] = 2.0 * (a == 0 ? i % 4 : i / 4) - 3.0;
  }
}

// A plane at equal distances, far from the slave: what is linear has the range that it has, derivatives have none.
TYPED_TEST(NetTest, IsNarrow) {
  using Type = typename TypeParam::B;
  constexpr int dim = Type::dim, directions = dim - 1;
  const Domain<Type> domain(this->basis, 0.0);
  Ball all[directions];
  for (Ball& x : all) x = {domain.low + 0.5 * domain.width, 0.5 * domain.width};
  for (int draw = 0; draw < 100; ++draw) {
    this->draw(0.0);
    Vec<double, dim> corner[directions + 1];
    for (Vec<double, dim>& c : corner)
      for (int k = 0; k < dim; ++k) c[k] = this->random(-9.0, 9.0);
    for (int i = 0; i < node_count(this->basis); ++i) {
      double place[2];
      place_of_node(TypeParam::basis, i, place);
      for (int k = 0; k < dim; ++k) {
        this->g.y[i][k] = corner[directions][k];
        for (int a = 0; a < directions; ++a) this->g.y[i][k] += place[a] / domain.width * corner[a][k];
      }
    }
    const SurfaceRange<2, Type, false> range(this->g, 0.0);
    Surface<Type, false, Ball> bound;
    range(all, bound);
    for (int k = 0; k < dim; ++k) {
      double spread = 0.0;
      for (int a = 0; a < directions; ++a) {
        spread += 0.5 * std::abs(corner[a][k]);
        EXPECT_LT(bound.e[a][k].r, 1e-10);
      }
      EXPECT_NEAR(bound.d[k].r, spread, 1e-10);
      for (int s = 0; s < symmetric_size<directions>; ++s) EXPECT_LT(bound.e2[s][k].r, 1e-10);
    }
  }
}

} // namespace
} // namespace ents::net_test
