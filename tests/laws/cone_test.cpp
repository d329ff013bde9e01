// SPDX-License-Identifier: BSD-3-Clause
// What holds for every element: the cone of friction, the balance of forces and moments, invariance under
// rigid motions, flags whatever else is wanted.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "law_elements.hpp"
#include "samples.hpp"
#include "worst.hpp"

namespace laws::cone_test {
namespace {

double length_of(const double* v, std::size_t d) {
  double s = 0.0;
  for (std::size_t i = 0; i < d; ++i) s += v[i] * v[i];
  return std::sqrt(s);
}

// |t| = |A^ab t_b rho_e,a|: two multiplications with the metric and its inverse and a norm, each within a few
// units in the last place times the metric's condition (below 10 here).
TEST(Cone, TractionNeverExceedsMuTimesPressure) {
  Random random(5);
  double worst = 0.0;
  std::int64_t slips = 0;
  for (const Basis& basis : mechanics::all_bases())
    for (const char* projection : mechanics::projections) {
      const mechanics::Scene scene = draw_scene(random, basis, "sine", projection);
      const mechanics::Model model = model_of(scene, coulomb);
      const LawElements e = draw(random, scene, model, mechanics::samples(1000), 0.05);
      LawResults r;
      evaluate(model, e, ENTS_FLAGS | ENTS_PRESSURE | ENTS_TRACTION, r);
      const std::size_t d = static_cast<std::size_t>(e.layout.dimension);
      for (std::size_t i = 0; i < r.status.size(); ++i) {
        if (r.status[i] != ENTS_OK || !(r.flags[i] & ENTS_FLAG_CONTACT)) continue;
        const double limit = 0.3 * r.pressure[i], t = length_of(&r.traction[i * d], d);
        test::raise(worst, (t - limit) / limit);
        if (r.flags[i] & ENTS_FLAG_SLIP) {
          ++slips;
          EXPECT_NEAR(t, limit, 1e-14 * limit);
        }
      }
    }
  EXPECT_GT(slips, mechanics::samples(5000));
  EXPECT_LE(worst, 1e-14);
  std::cout << slips << " slipping elements, worst (|t| - mu p) / mu p: " << worst << "\n";
}

// Forces balance: gap and xi do not change when everything moves together. Normal projection: so do moments.
TEST(Balance, OfForcesAndOfMomentsWithFriction) {
  Random random(6);
  double worst_force = 0.0, worst_moment = 0.0;
  for (const Basis& basis : mechanics::all_bases()) {
    const mechanics::Scene scene = draw_scene(random, basis, "sine", "normal");
    const mechanics::Model model = model_of(scene, coulomb);
    const LawElements e = draw(random, scene, model, mechanics::samples(1000), 0.05);
    LawResults r;
    evaluate(model, e, ENTS_FLAGS | ENTS_RESIDUAL, r);
    const std::size_t d = static_cast<std::size_t>(e.layout.dimension),
                      n = static_cast<std::size_t>(e.layout.dofs);
    for (std::size_t i = 0; i < r.status.size(); ++i) {
      if (r.status[i] != ENTS_OK || !(r.flags[i] & (ENTS_FLAG_STICK | ENTS_FLAG_SLIP))) continue;
      const double* R = &r.residual[i * n];
      const std::vector<double> x = mechanics::dofs_of(e.at, static_cast<std::int64_t>(i), basis);
      double force[3] = {}, moment[3] = {};
      for (std::size_t node = 0; node < n / d; ++node) {
        double p[3] = {}, f[3] = {};
        for (std::size_t c = 0; c < d; ++c) {
          f[c] = R[node * d + c];
          p[c] = x[node * d + c] - x[c];
          force[c] += f[c];
        }
        for (int c = 0; c < 3; ++c)
          moment[c] += p[(c + 1) % 3] * f[(c + 2) % 3] - p[(c + 2) % 3] * f[(c + 1) % 3];
      }
      const double scale = mechanics::largest_entry(R, n);
      test::raise(worst_force, length_of(force, 3) / scale);
      test::raise(worst_moment, length_of(moment, 3) / scale);
    }
  }
  EXPECT_LE(worst_force, 1e-13);
  EXPECT_LE(worst_moment, 1e-12);
  std::cout << "worst force " << worst_force << ", worst moment " << worst_moment << "\n";
}

// An element that moves as a rigid body, its state as it was: the anchor moves along, so gap, pressure and
// |t| stay.
TEST(RigidMotion, ChangesNeitherGapNorPressureNorTraction) {
  Random random(7);
  double worst = 0.0;
  std::int64_t compared = 0;
  for (const Method& method : all_methods())
    for (const Basis& basis : mechanics::all_bases()) {
      if (method.friction.is_null()) continue;
      const mechanics::Scene scene = draw_scene(random, basis, "sine", "normal");
      const mechanics::Model model = model_of(scene, method);
      const LawElements e = draw(random, scene, model, mechanics::samples(100), 0.05);
      LawElements moved = e;
      const std::size_t d = static_cast<std::size_t>(e.layout.dimension);
      // turned about two axes (2D: one), and shifted by about the element's size
      const double c = std::cos(1.1), s = std::sin(1.1), c2 = std::cos(-0.7), s2 = std::sin(-0.7);
      for (std::vector<double>* x : {&moved.at.slave, &moved.at.master})
        for (std::size_t i = 0; i < x->size(); i += d) {
          double* p = x->data() + i;
          const double p0 = c * p[0] - s * p[1], p1 = s * p[0] + c * p[1];
          p[0] = p0 + 0.7, p[1] = p1 - 1.3;
          if (d == 3) {
            const double q1 = c2 * p[1] - s2 * p[2], q2 = s2 * p[1] + c2 * p[2];
            p[1] = q1, p[2] = q2 + 0.9;
          }
        }
      LawResults a, b;
      evaluate(model, e, ENTS_FLAGS | ENTS_GAP | ENTS_PRESSURE | ENTS_TRACTION, a);
      evaluate(model, moved, ENTS_FLAGS | ENTS_GAP | ENTS_PRESSURE | ENTS_TRACTION, b);
      for (std::size_t i = 0; i < a.status.size(); ++i) {
        if (a.status[i] != ENTS_OK || !(a.flags[i] & (ENTS_FLAG_STICK | ENTS_FLAG_SLIP))) continue;
        ++compared;
        const double t = length_of(&a.traction[i * d], d);
        // the size of the segment for the gap; the traction follows from the pressure and from slip times
        // stiffness (80)
        test::raise(worst, std::fabs(a.gap[i] - b.gap[i]));
        test::raise(worst, std::fabs(a.pressure[i] - b.pressure[i]) / (std::fabs(a.pressure[i]) + 10.0));
        test::raise(worst, std::fabs(t - length_of(&b.traction[i * d], d)) / (t + 10.0));
      }
    }
  EXPECT_GT(compared, mechanics::samples(10000));
  EXPECT_LE(worst, 1e-12);
  std::cout << compared << " elements in contact, worst change of gap, pressure, |t|: " << worst << "\n";
}

// Flags are those of the element, whatever else is wanted, also of a slave that is far away.
TEST(Flags, AloneRefuseNoSlaveFarAway) {
  const mechanics::Model model(
      R"({"segment": "line3", "contact": {"normal": {"type": "penalty", "stiffness": 100}}})");
  const double slave[2] = {50.0, 3.0}, master[6] = {1, 0, -1, 0, 0, 0.1};
  double residual[8];
  std::int32_t flags[2] = {-1, -1};
  for (const bool forces : {false, true}) {
    ents_input in{};
    in.struct_size = sizeof in;
    in.slave = slave, in.master = master;
    ents_output out{};
    out.struct_size = sizeof out;
    out.wanted = forces ? ENTS_FLAGS | ENTS_RESIDUAL : ENTS_FLAGS;
    out.flags = &flags[forces], out.residual = residual;
    EXPECT_EQ(ents_evaluate(model.handle(), 0, 1, &in, &out, nullptr), ENTS_OK);
  }
  EXPECT_EQ(flags[0], flags[1]);
  EXPECT_TRUE(flags[0] & ENTS_FLAG_OUTSIDE);
}

} // namespace
} // namespace laws::cone_test
