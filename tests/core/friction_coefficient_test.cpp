// Coefficients of friction that depend on slip rate and pressure, and elements that slip under them.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/law/friction.hpp"
#include "core/law/laws.hpp"
#include "measured.hpp"
#include "worst.hpp"

namespace friction_coefficient_test {
namespace {

using namespace ents;
using namespace ents::ENTS_ISA;

const double pressures[] = {1.0, 3.0}, rates[] = {0.0, 2.0, 10.0};
const double coefficients[] = {0.5, 0.3, 0.25, 0.4, 0.3, 0.2}; // a row for each pressure

ContactLaw decaying(double kinetic = 0.2) {
  ContactLaw law;
  law.friction = FrictionKind::coulomb;
  law.friction_coefficient = 0.5, law.friction_stiffness = 40.0;
  law.varying.kind = VaryingCoefficient::decays;
  law.varying.kinetic = kinetic, law.varying.decay = 0.7;
  return law;
}
ContactLaw tabulated() {
  ContactLaw law = decaying();
  law.varying = {};
  law.varying.kind = VaryingCoefficient::table;
  law.varying.pressure = pressures, law.varying.rate = rates, law.varying.coefficient = coefficients;
  law.varying.pressures = 2, law.varying.rates = 3;
  return law;
}
// mu(p, v), written a second time
double coefficient(const ContactLaw& law, double p, double v) {
  if (law.varying.kind == VaryingCoefficient::decays)
    return law.varying.kinetic + (0.5 - law.varying.kinetic) * std::exp(-0.7 * v);
  const auto row = [&](int i) {
    const double* c = coefficients + 3 * i;
    return v < 2.0    ? c[0] + (c[1] - c[0]) * v / 2.0
           : v < 10.0 ? c[1] + (c[2] - c[1]) * (v - 2.0) / 8.0
                      : c[2];
  };
  const double w = std::min(std::max(0.5 * (p - 1.0), 0.0), 1.0);
  return row(0) + w * (row(1) - row(0));
}

struct Draw {
  std::mt19937 engine{3};
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
};

TEST(FrictionCoefficient, SlipSolvesItsEquation) {
  Draw draw;
  for (const ContactLaw& law : {decaying(), decaying(0.9), tabulated()}) {
    int slips = 0, falls = 0;
    for (int i = 0; i < 5000; ++i) {
      const double area = draw(0.5, 2.0), force = area * draw(0.5, 4.0), scale = 40.0 * area,
                   norm = draw(0.0, 4.0);
      const double time = draw(0.005, 1.0), h = 1e-6;
      const auto at = [&](double n, double p) { return slip_limit(law, n, p, area, scale, time); };
      const SlipLimit limit = at(norm, force);
      const double slip = (norm - limit.limit) / scale;
      if (norm <= force * coefficient(law, force / area, 0.0)) {
        ASSERT_NEAR(limit.limit, force * coefficient(law, force / area, 0.0), 1e-14);
        continue;
      }
      ++slips;
      ASSERT_GT(slip, 0.0);
      ASSERT_NEAR(limit.limit, force * coefficient(law, force / area, slip / time), 1e-13);
      const double by_norm = (at(norm + h, force).limit - at(norm - h, force).limit) / (2 * h);
      const double by_force = (at(norm, force + h).limit - at(norm, force - h).limit) / (2 * h);
      if (std::fabs(by_norm - limit.by_norm) > 1e-4 || std::fabs(by_force - limit.by_force) > 1e-4) {
        // a kink of the table, or the jump from sticking to a slip that goes on by itself
        const double before = at(norm - 2 * h, force - 2 * h).by_norm,
                     after = at(norm + 2 * h, force + 2 * h).by_norm;
        const double before2 = at(norm - 2 * h, force + 2 * h).by_norm,
                     after2 = at(norm + 2 * h, force - 2 * h).by_norm;
        ASSERT_TRUE(std::fabs(before - after) > 1e-5 || std::fabs(before2 - after2) > 1e-5 ||
                    law.varying.pressures > 1);
        ++falls;
      }
    }
    EXPECT_GE(slips, 1000);
    EXPECT_LE(falls, 20);
  }
}

// Sliding at a constant rate: steps of an element in the plane, whose anchor is moved as the state does it
TEST(FrictionCoefficient, SteadySlidingHasTheCoefficientOfItsRate) {
  double worst = 0.0, worst_work = 0.0;
  for (const ContactLaw& law : {decaying(), tabulated()})
    for (const double pressure : {0.7, 2.0, 5.0})
      for (const double rate : {0.1, 1.5, 4.0, 30.0}) {
        const double time = 0.05, area = 1.3;
        double anchor = 0.0, place = 0.0, force = 0.0, dissipated = 0.0, work = 0.0;
        for (int step = 0; step < 1600; ++step) {
          place += rate * time;
          const double xi[1] = {place}, metric[1] = {1.0};
          SlipBegin<double, 1> begin{{anchor}, 1.0, 0.0, time};
          Friction<double, 1> f;
          f.evaluate<true>(law, {xi, metric, area, true}, begin, {}, pressure * area);
          if (f.slip) anchor = place - f.limit / f.scale;
          if (step >= 1400) work += f.force[0] * rate * time, dissipated += dissipation_of(law, f);
          force = f.force[0];
        }
        test::raise(worst, std::fabs(force / (pressure * area * coefficient(law, pressure, rate)) - 1.0));
        test::raise(worst_work, std::fabs(work / dissipated - 1.0)); // nothing more is stored
      }
  test::expect_measured("force of steady sliding against mu(p, v) p A", worst, 1e-9);
  test::expect_measured("its work against what is dissipated", worst_work, 1e-9);
}

// Static at rest, a drop when it starts: a spring that is pulled slowly sticks and slips
TEST(FrictionCoefficient, SticksUpToTheStaticLimit) {
  const ContactLaw law = decaying();
  const double metric[1] = {1.0}, area = 1.0;
  const auto at = [&](double place, double time) {
    const double xi[1] = {place};
    SlipBegin<double, 1> begin{{0.0}, 1.0, 0.0, time};
    Friction<double, 1> f;
    f.evaluate<true>(law, {xi, metric, area, true}, begin, {}, 4.0);
    return f;
  };
  EXPECT_FALSE(at(0.04999, 1e-3).slip);
  EXPECT_NEAR(at(0.04999, 1e-3).force[0], 1.9996, 1e-12);
  EXPECT_TRUE(at(0.05001, 1e3).slip);
  EXPECT_NEAR(at(0.05001, 1e3).force[0], 2.0, 1e-4);  // slowly: static
  EXPECT_NEAR(at(0.05001, 1e-3).force[0], 0.8, 1e-3); // at once: kinetic
}

TEST(FrictionCoefficient, ConstantTableIsTheConstant) {
  const double zero[] = {0.0}, mu[] = {0.3};
  ContactLaw law = decaying(), constant = law;
  constant.varying = {}, constant.friction_coefficient = 0.3;
  law.varying = {};
  law.varying.kind = VaryingCoefficient::table;
  law.varying.pressure = law.varying.rate = zero, law.varying.coefficient = mu;
  law.varying.pressures = law.varying.rates = 1;
  Draw draw;
  for (int i = 0; i < 500; ++i) {
    const double xi[1] = {draw(-0.2, 0.2)}, metric[1] = {draw(0.5, 2.0)}, force = draw(-0.5, 4.0);
    SlipBegin<double, 1> begin{{0.0}, 1.0, 0.0, 0.0};
    Friction<double, 1> a, b;
    a.evaluate<true>(law, {xi, metric, 1.0, true}, begin, {}, force > 0.0 ? force : 0.0);
    b.evaluate(constant, {xi, metric, 1.0, true}, begin, {}, force > 0.0 ? force : 0.0);
    ASSERT_EQ(a.force[0], b.force[0]);
    ASSERT_EQ(a.slip, b.slip);
  }
}

} // namespace
} // namespace friction_coefficient_test
