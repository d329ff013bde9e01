// The laws alone: functions of numbers. Every law of the list is tested, a new one too.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "core/law/friction.hpp"
#include "core/law/laws.hpp"
#include "core/law/wear.hpp"

namespace law_test {
namespace {

using namespace ents;
using namespace ents::ENTS_ISA;

class Random {
public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }

private:
  std::mt19937 engine_;
};

struct SomeLaw {
  ContactLaw law;
  std::vector<LawTable> table;
  double reach; ///< gaps of interest are within
};

// Its numbers by what its table says; of a law that has none with which it would be refused.
SomeLaw some_law(const LawEntry& entry, Random& random) {
  SomeLaw some{{}, {}, 1.0};
  set_normal_law(entry, some.law);
  double* number = some.law.number;
  for (int i = 0; i < entry.count; ++i) switch (entry.numbers[i].kind) {
    case LawNumber::positive:
      *number++ = random(0.5, 3.0);
      break;
    case LawNumber::exponent:
      some.law.twice_exponent = static_cast<int>(random(2.0, 9.0));
      break;
    case LawNumber::rising: {
      std::vector<double> gap{-random(1.0, 2.0)}, pressure{random(3.0, 5.0)};
      for (int k = 0; k < 4; ++k) {
        gap.push_back(gap.back() + random(0.1, 0.5));
        pressure.push_back(k == 3 ? 0.0 : pressure.back() * random(0.2, 0.9));
      }
      some.table = make_law_table(gap, pressure);
      some.law.table = some.table.data(), some.law.table_points = 5;
      break;
    }
    case LawNumber::falling: // with the gaps
      break;
    }
  if (entry.mistake(some.law)) return some_law(entry, random);
  return some; // not copied: the law points to its table
}

// The number of the state of an element that has bonded, or has not
double some_bond(const SomeLaw& some, Random& random) {
  if (!some.law.bonds || random(0.0, 1.0) < 0.3) return 0.0;
  return next_bond(some.law, random(0.0, 3.0), next_bond(some.law, -1.0, 0.0));
}

class EveryLaw : public testing::TestWithParam<LawEntry> {
protected:
  Random random{7};
};

TEST_P(EveryLaw, ForceAndStiffnessAreTheDerivativesOfTheEnergy) {
  int touching = 0;
  for (int i = 0; i < 2000; ++i) {
    const SomeLaw some = some_law(GetParam(), random);
    const double lambda = random(0.0, 2.0), scale = random(0.5, 2.0), h = 1e-6,
                 bond = some_bond(some, random);
    const double gap = random(-1.5, some.law.pulls ? 3.0 : 0.5);
    const auto at = [&](double g) { return normal_force(some.law, g, lambda, scale, bond); };
    // with what damage has taken since the begin of the increment
    const auto energy = [&](double g) {
      return at(g).energy + bond_dissipation(some.law, bond, next_bond(some.law, g, bond));
    };
    const NormalForce<double> f = at(gap), before = at(gap - h), after = at(gap + h);
    if (before.contact != after.contact) continue; // the kink between
    touching += f.contact;
    const double size = 1.0 + std::fabs(f.force) + std::fabs(f.stiffness);
    ASSERT_NEAR(f.force, (energy(gap + h) - energy(gap - h)) / (2 * h), 1e-8 * size) << gap;
    // W'' of a table has kinks in its points; so has that of laws that pull, between h / 2 and h away
    const double by_force = (after.force - before.force) / (2 * h);
    const double jump = std::fabs(at(gap + 2 * h).stiffness - at(gap - 2 * h).stiffness);
    if (!some.law.pulls || jump < 1e-3 * size) {
      const double tolerance = some.table.empty() ? 1e-8 : 1e-5;
      ASSERT_NEAR(f.stiffness, by_force, tolerance * size) << gap;
    }
    ASSERT_TRUE(some.law.pulls || f.force <= 0.0);
    ASSERT_TRUE(f.contact || (f.force == 0.0 && f.stiffness == 0.0));
    const NormalForce<Dual<double>> dual = normal_force(
        some.law, Dual<double>(gap, 1.0), Dual<double>(lambda), Dual<double>(scale), Dual<double>(bond));
    ASSERT_EQ(dual.force.v, f.force);
    ASSERT_NEAR(dual.force.d, f.stiffness, 1e-12 * size);
    if (!some.law.is_damaged) {
      ASSERT_NEAR(dual.energy.d, f.force, 1e-12 * size);
    }
  }
  EXPECT_GE(touching, 500);
}

TEST_P(EveryLaw, IsWhatItSaysOfItself) {
  for (int i = 0; i < 500; ++i) {
    const SomeLaw some = some_law(GetParam(), random);
    const ContactLaw& law = some.law;
    const double gap = -random(0.01, 1.0), lambda = 0.0, scale = random(0.5, 2.0);
    const NormalForce<double> f = normal_force(law, gap, lambda, scale);
    const NormalForce<double> deeper = normal_force(law, 2.0 * gap, lambda, scale);
    if (GetParam().has_slope) {
      ASSERT_NEAR(f.stiffness, 0.5 * law.twice_exponent * f.force / gap, 1e-13 * f.stiffness);
      ASSERT_NEAR(force_per_gap(law, gap) * gap, f.force, 1e-13 * -f.force);
    }
    if (is_linear(law)) {
      ASSERT_EQ(f.stiffness, deeper.stiffness);
    }
    if (GetParam().wears) {
      ASSERT_GE(deeper.stiffness, f.stiffness * (1.0 - 1e-14));
    }
    if (!GetParam().has_scale) {
      ASSERT_EQ(f.force, normal_force(law, gap, lambda).force);
    }
    // Bodies that touch are held, but by laws whose stiffness begins at 0, or is in the multiplier.
    const NormalForce<double> touching = normal_force(law, 0.0, 0.0, scale);
    if (GetParam().kind != NormalKind::table) { // its points decide
      ASSERT_TRUE(touching.contact);
      ASSERT_EQ(touching.stiffness > 0.0, GetParam().kind != NormalKind::multiplier &&
                                              (GetParam().kind != NormalKind::power || is_linear(law)));
    }
    // Contact begins at touching_gap(), without a jump of the force
    const double begin = touching_gap(law, scale);
    ASSERT_FALSE(normal_force(law, begin + 1e-9, lambda, scale).contact);
    const double first = normal_force(law, begin - 1e-9, lambda, scale).force;
    if (law.bonds) // the bond forms there
      ASSERT_NEAR(first, law.number[0] * begin, 1e-6);
    else
      ASSERT_NEAR(first, 0.0, 1e-6);
  }
}

// The reader refuses wear with the other laws.
class WearingLaw : public EveryLaw {};
std::vector<LawEntry> wearing_laws() {
  std::vector<LawEntry> laws;
  for (const LawEntry& entry : law_entries)
    if (entry.wears && entry.multiplier != Multiplier::is_dof) laws.push_back(entry);
  return laws;
}
TEST_P(WearingLaw, PressureSolvesItsEquation) {
  int worn = 0;
  for (int i = 0; i < 2000; ++i) {
    const SomeLaw some = some_law(GetParam(), random);
    const double known = random(-1.5, 0.5), share = random(0.0, 2.0), lambda = random(0.0, 1.0);
    bool found = false;
    const double p = worn_pressure(some.law, known, share, lambda, found);
    ASSERT_TRUE(found);
    if (!normal_force(some.law, known, lambda).contact) continue;
    ++worn;
    const NormalForce<double> f = normal_force(some.law, known + share * p, lambda);
    ASSERT_NEAR(p, -f.force, 1e-13 * (1.0 + p) * (1.0 + share * f.stiffness));
  }
  EXPECT_GE(worn, 500);
}

std::string name_of(const testing::TestParamInfo<LawEntry>& info) { return info.param.type; }
INSTANTIATE_TEST_SUITE_P(Laws, EveryLaw, testing::ValuesIn(law_entries), name_of);
INSTANTIATE_TEST_SUITE_P(Laws, WearingLaw, testing::ValuesIn(wearing_laws()), name_of);

// An element with T surface coordinates whose metric is that of random tangents
template <int T> struct Rubbing {
  double xi[T], metric[symmetric_size<T>], area;
  SlipBegin<double, T> begin{};
  ContactLaw law;

  explicit Rubbing(Random& random) : area(random(0.5, 2.0)) {
    double tangent[T][3];
    for (int a = 0; a < T; ++a) {
      xi[a] = random(-0.5, 0.5), begin.from[a] = random(-0.5, 0.5);
      for (double& x : tangent[a]) x = random(-1.0, 1.0);
      tangent[a][a] += 2.0;
    }
    for (int a = 0; a < T; ++a)
      for (int b = a; b < T; ++b) {
        metric[symmetric_index(a, b)] = 0.0;
        for (int k = 0; k < 3; ++k) metric[symmetric_index(a, b)] += tangent[a][k] * tangent[b][k];
      }
    begin.known = 1.0;
    law.friction = FrictionKind::coulomb;
    law.friction_coefficient = random(0.1, 1.0);
    law.friction_stiffness = random(0.5, 5.0);
  }
  Friction<double, T> at(double pressure_force, const SlipShare<double>& share = {}) const {
    Friction<double, T> f;
    f.evaluate(law, {xi, metric, area, true}, begin, share, pressure_force);
    return f;
  }
  // sqrt(t_a A^ab t_b)
  double size(const double (&t)[T]) const {
    double inverse[symmetric_size<T>], sum = 0.0;
    invert_with(metric, 1.0 / determinant(metric), inverse);
    for (int a = 0; a < T; ++a)
      for (int b = 0; b < T; ++b) sum += t[a] * inverse[symmetric_index(a, b)] * t[b];
    return std::sqrt(sum);
  }
};

template <int T> void returns_to_the_limit() {
  Random random(11);
  int slips = 0, sticks = 0, capped = 0;
  for (int i = 0; i < 5000; ++i) {
    Rubbing<T> some(random);
    const double press = random(0.0, 3.0), h = 1e-6;
    if (i % 3 == 0) some.law.shear_limit = random(0.1, 1.0);
    const Friction<double, T> f = some.at(press), more = some.at(press + h), less = some.at(press - h);
    double limit = some.law.friction_coefficient * press;
    if (some.law.shear_limit > 0.0) limit = std::min(limit, some.law.shear_limit * some.area);
    double trial[T];
    for (int a = 0; a < T; ++a) {
      trial[a] = 0.0;
      for (int b = 0; b < T; ++b)
        trial[a] += some.area * some.law.friction_stiffness * some.metric[symmetric_index(a, b)] *
                    (some.xi[b] - some.begin.from[b]);
    }
    const double size = some.size(trial);
    ASSERT_EQ(f.slip, size > limit);
    ASSERT_NEAR(some.size(f.force), std::min(size, limit), 1e-12 * (1.0 + size));
    for (int a = 0; a < T; ++a) // along the trial
      ASSERT_NEAR(f.force[a] * size, trial[a] * std::min(size, limit), 1e-11 * (1.0 + size * size));
    for (int a = 0; a < T && more.slip == less.slip && more.at_shear_limit == less.at_shear_limit; ++a)
      ASSERT_NEAR(f.by_force[a], (more.force[a] - less.force[a]) / (2 * h), 1e-7 * (1.0 + size));
    slips += f.slip, sticks += !f.slip, capped += f.at_shear_limit;
  }
  EXPECT_GE(slips, 500);
  EXPECT_GE(sticks, 300);
  EXPECT_GE(capped, 100);
}
TEST(FrictionAlone, ReturnsToTheLimitAlongTheTrial) {
  returns_to_the_limit<1>();
  returns_to_the_limit<2>();
}

// An element that was open by c slips in the part z / (c + z) of the increment; by_gap is its derivative.
template <int T> void slips_after_the_touch() {
  Random random(13);
  for (int i = 0; i < 2000; ++i) {
    Rubbing<T> some(random);
    some.begin.clearance = random(0.01, 1.0);
    const double depth = random(0.01, 1.0), press = 1e3, h = 1e-6; // sticks
    const auto at = [&](double z) { return some.at(press, slip_share(some.begin.clearance, z)); };
    const Friction<double, T> f = at(depth), deeper = at(depth + h), higher = at(depth - h);
    ASSERT_NEAR(f.share, depth / (some.begin.clearance + depth), 1e-15);
    ASSERT_TRUE(f.closes);
    for (int a = 0; a < T; ++a)
      ASSERT_NEAR(f.by_gap[a], (higher.force[a] - deeper.force[a]) / (2 * h),
                  1e-5 * (1.0 + some.size(f.force) / some.begin.clearance / some.begin.clearance));
  }
}
TEST(FrictionAlone, SlipsAfterTheTouch) {
  slips_after_the_touch<1>();
  slips_after_the_touch<2>();
}

TEST(FrictionAlone, HasNoneWithoutABeginOrACoefficient) {
  Random random(17);
  Rubbing<2> some(random);
  some.begin.known = 0.0;
  EXPECT_EQ(some.at(1.0).force[0], 0.0);
  some.begin.known = 1.0;
  EXPECT_NE(some.at(1.0).force[0], 0.0);
  some.law.friction_coefficient = 0.0;
  EXPECT_EQ(some.at(1.0).force[0], 0.0);
  EXPECT_TRUE(some.at(1.0).slip);
}

} // namespace
} // namespace law_test
