// Laws whose surfaces pull: exact numbers of one element.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/law/laws.hpp"
#include "measured.hpp"
#include "worst.hpp"

namespace pulling_law_test {
namespace {

using namespace ents;
using namespace ents::ENTS_ISA;

ContactLaw law_of(NormalKind kind, const double (&numbers)[4]) {
  ContactLaw law;
  for (const LawEntry& entry : law_entries)
    if (entry.kind == kind) set_normal_law(entry, law);
  std::copy_n(numbers, 4, law.number);
  return law;
}
double pressure(const ContactLaw& law, double gap, double bond = 0.0, double scale = 1.0) {
  return -normal_force(law, gap, 0.0, scale, bond).force;
}

// From one gap to another in steps: work and dissipation of an element with a state
struct Path {
  const ContactLaw& law;
  double bond = 0.0, gap = 0.0, work = 0.0, dissipated = 0.0;

  void go(double to, int steps = 20000) {
    const double from = gap;
    for (int i = 1; i <= steps; ++i) {
      const double next = from + (to - from) * i / steps, before = bond, middle = 0.5 * (gap + next);
      work -= pressure(law, middle, bond) * (next - gap);
      bond = next_bond(law, next, bond);
      dissipated += bond_dissipation(law, before, bond);
      gap = next;
    }
  }
  double stored() const { return normal_force(law, gap, 0.0, 1.0, bond).energy; }
};

// K 100, strength 2, energy 0.1: d_0 0.02, d_f 0.1
const ContactLaw cohesive = law_of(NormalKind::cohesive, {100.0, 2.0, 0.1, 1e-3});

TEST(Cohesive, FollowsItsLines) {
  Path path{cohesive};
  EXPECT_DOUBLE_EQ(pressure(cohesive, -0.01), 1.0); // pressure needs no bond
  EXPECT_EQ(pressure(cohesive, 0.0011), 0.0);       // none forms there
  path.go(-0.01);
  path.go(0.01);
  EXPECT_DOUBLE_EQ(pressure(cohesive, 0.01, path.bond), -1.0);
  EXPECT_DOUBLE_EQ(path.bond, 0.02);
  path.go(0.06); // half of the way down
  EXPECT_NEAR(pressure(cohesive, 0.06, path.bond), -1.0, 1e-14);
  EXPECT_NEAR(pressure(cohesive, 0.03, path.bond), -0.5, 1e-14); // back to the origin
  EXPECT_NEAR(pressure(cohesive, 0.08, path.bond), -0.5, 1e-14); // on along the line
  EXPECT_DOUBLE_EQ(pressure(cohesive, -0.01, path.bond), 1.0);   // the pressure is whole
  path.go(0.12);
  EXPECT_EQ(pressure(cohesive, 0.05, path.bond), 0.0);
  path.go(-0.02);
  EXPECT_DOUBLE_EQ(pressure(cohesive, -0.02, path.bond), 2.0);
  EXPECT_EQ(pressure(cohesive, 1e-9, next_bond(cohesive, -0.02, path.bond)), 0.0); // does not heal
}

TEST(Cohesive, BalancesItsEnergy) {
  Path path{cohesive};
  const double marks[] = {-0.01, 0.015, -0.005, 0.05, 0.01, -0.004, 0.07, 0.02, 0.2, -0.01};
  double worst = 0.0;
  for (const double gap : marks) {
    path.go(gap);
    test::raise(worst, std::fabs(path.work - path.stored() - path.dissipated) / 0.1);
  }
  test::expect_measured("cohesive path: work less stored less dissipated, of the energy", worst, 1e-6);
  test::expect_measured("dissipated when it has opened, against the energy",
                        std::fabs(path.dissipated / 0.1 - 1.0), 1e-14);
  // in one step, too
  EXPECT_DOUBLE_EQ(bond_dissipation(cohesive, 0.02, next_bond(cohesive, 5.0, 0.02)), 0.1);
}

TEST(Tied, HoldsWhatItTouched) {
  const ContactLaw tied = law_of(NormalKind::tied, {50.0, 0.01, 0.0, 0.0});
  EXPECT_EQ(pressure(tied, 0.02), 0.0);
  EXPECT_DOUBLE_EQ(pressure(tied, 0.005), -0.25);
  const double bond = next_bond(tied, 0.005, 0.0);
  EXPECT_DOUBLE_EQ(pressure(tied, 3.0, bond), -150.0);
  EXPECT_EQ(next_bond(tied, 0.02, 0.0), 0.0);
  EXPECT_EQ(next_bond(tied, 3.0, bond), bond);
}

struct Adhesive {
  NormalKind kind;
  double numbers[4], most, at;
}; // largest tension, where it is
const Adhesive adhesives[] = {
    {NormalKind::dugdale, {0.01, 2.0, 1e4, 0.0}, 2.0, 4e-4},
    {NormalKind::separation, {0.01, 2e-3, 0.0, 0.0}, 0.01 / (std::exp(1.0) * 2e-3), 2e-3},
    // 16 / (9 sqrt(3)) w / z_0 without a range
    {NormalKind::lennard_jones,
     {0.01, 2e-3, 20.0, 0.0},
     16.0 / (9.0 * std::sqrt(3.0)) * 5.0,
     2e-3 * (std::pow(3.0, 1.0 / 6.0) - 1.0)},
    {NormalKind::lennard_jones, {0.01, 2e-3, 0.02, 0.0}, 5.280833, 4.0e-4}}; // of a quadrature

TEST(Adhesion, WorkAndStrengthAreThoseOfTheLaw) {
  for (const Adhesive& a : adhesives) {
    const ContactLaw law = law_of(a.kind, a.numbers);
    ASSERT_EQ(mistake_of(law), nullptr);
    for (const double scale : {1.0, 0.4}) {
      EXPECT_NEAR(normal_force(law, 0.0, 0.0, scale).energy, -0.01 * scale, 1e-12);
      EXPECT_NEAR(pressure(law, 0.0, 0.0, scale), 0.0, 1e-12);
    }
    double work = 0.0, most = 0.0, at = 0.0;
    const double end = std::min(touching_gap(law, 1.0), 0.06);
    constexpr int steps = 200000;
    for (int i = 0; i < steps; ++i) {
      const double gap = end * (i + 0.5) / steps, t = -pressure(law, gap);
      work += t * end / steps;
      if (t > most * (1.0 + 1e-12)) most = t, at = gap;
    }
    const Strength<double> strength = ENTS_ISA::strength(law, 1.0);
    const bool long_tail = a.numbers[2] > 1.0 && a.kind == NormalKind::lennard_jones;
    test::expect_measured("work of adhesion against w", std::fabs(work / 0.01 - 1.0),
                          long_tail ? 2e-3 : 1e-6);
    test::expect_measured("largest tension", std::fabs(most / a.most - 1.0), 1e-3);
    EXPECT_NEAR(at, a.at, 0.02 * a.at);
    EXPECT_NEAR(strength.most, most, 1e-6 * most);
    EXPECT_NEAR(strength.gap, at, 0.02 * at);
    EXPECT_FALSE(normal_force(law, touching_gap(law, 1.0), 0.0).contact);
  }
}

TEST(Adhesion, FrictionActsOnThePressureOrOnAllBeyondTheStrength) {
  for (const Adhesive& a : adhesives) {
    ContactLaw law = law_of(a.kind, a.numbers);
    const auto rubs = [&](double gap) {
      const double force = normal_force(law, gap, 0.0).force;
      return rubbing_pressure(law, force, gap, 1.0);
    };
    const double most = strength(law, 1.0).most, at = strength(law, 1.0).gap;
    EXPECT_EQ(rubs(1e-4), 0.0);
    EXPECT_DOUBLE_EQ(rubs(-1e-4), pressure(law, -1e-4));
    law.rubs_adhering = true;
    EXPECT_NEAR(rubs(0.0), most, 1e-9 * most);
    EXPECT_NEAR(rubs(0.999 * at), 0.0, 1e-3 * most);
    EXPECT_EQ(rubs(1.001 * at), 0.0);
    EXPECT_DOUBLE_EQ(rubs(-1e-4), pressure(law, -1e-4) + most);
  }
}

} // namespace
} // namespace pulling_law_test
