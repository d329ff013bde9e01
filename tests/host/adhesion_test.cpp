// SPDX-License-Identifier: BSD-3-Clause
// Adhesion on an elastic layer without a mesh: a cylinder from the JKR limit to rigid bodies (Maugis), waves (Johnson),
// and the energy that jumps take.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

#include "ents.hpp"
#include "json_reader.hpp"
#include "layer_body.hpp"

namespace host::adhesion_test {
namespace {

constexpr double pi = std::numbers::pi;
const Material material{Material::Law::linear_elastic, 1000, 0.3};
const double modulus = 1000 / (1 - 0.3 * 0.3); // E*

/// Half of a period, a strip of nodes: planes of symmetry at both ends.
std::vector<GridLines> strip(double length, int cells, double thickness) {
  std::vector<GridLines> lines{{0}, {0}, {-thickness, 0}};
  append_graded(lines[0], length, cells, 1);
  append_graded(lines[1], length / cells, 1, 1);
  return lines;
}

/// A rigid height that sticks down by h(x) moves down by `motion` and touches z = 0 at x = 0 at 0.
class Press {
public:
  Press(double length, int cells, double thickness, const Json& height, double top, const Json& law)
      : lines_(strip(length, cells, thickness)), body_(std::make_shared<const LayerBody>(lines_, material)),
        solver_(body_), model_(text(height, law)), top_(top), width_(length / cells) {
    const std::size_t n = lines_[0].size();
    for (std::size_t j = 0; j < 2; ++j)
      for (std::size_t i = 0; i < n; ++i) {
        slave_.insert(slave_.end(), {lines_[0][i], lines_[1][j], 0});
        start_.insert(start_.end(), {lines_[0][i] / 4, 0.0});
        area_.push_back(width_ * width_ / 2 * (i == 0 || i + 1 == n ? 0.5 : 1));
      }
    displacement_ = Eigen::VectorXd::Zero(body_->nodes());
  }

  /// Equilibrium at a motion, from the last one. @return force on the master over all of the period, per length
  double move(double motion) {
    motion_ = motion;
    evaluate();
    for (int iteration = 0; iteration < 2000; ++iteration) {
      const Eigen::VectorXd residual = body_->force(displacement_) + contact_;
      const double enough = 1e-11 * modulus * width_ * width_;
      if (residual.lpNorm<Eigen::Infinity>() < enough) {
        iterations_ = iteration;
        return contact_.sum() / width_ * 2;
      }
      SparseSystem::Matrix matrix(body_->nodes(), body_->nodes());
      matrix.reserve(Eigen::VectorXi::Ones(body_->nodes()));
      for (Eigen::Index i = 0; i < body_->nodes(); ++i)
        matrix.insert(static_cast<int>(i), static_cast<int>(i)) = stiffness_[i];
      matrix.makeCompressed();
      if (!solver_.factorize(matrix)) break;
      const Eigen::VectorXd step = solver_.solve(-residual).col(0), from = displacement_;
      if (!step.allFinite()) break;
      const double before = energy();
      for (double share = 1; share > 1e-6; share /= 2) {
        displacement_ = from + share * step;
        evaluate();
        if (energy() <= before + 1e-14 * std::abs(before)) break;
      }
    }
    ADD_FAILURE() << "no equilibrium at the motion " << motion;
    return 0;
  }
  /// Elastic and of the law, of the same part as the force.
  double energy() const {
    return (0.5 * displacement_.dot(body_->force(displacement_)) + law_energy_) / width_ * 2;
  }
  int iterations() const { return iterations_; }

private:
  static std::string text(const Json& height, const Json& law) {
    return Json{{"segment", "quad4"},
                {"master", "rigid"},
                {"surface_coordinates", {{-4, -4}, {-4, 4}, {4, 4}, {4, -4}}},
                {"height", height},
                {"contact", {{"normal", law}}}}
        .dump();
  }
  void evaluate() {
    const std::size_t count = area_.size();
    for (std::size_t i = 0; i < count; ++i) slave_[3 * i + 2] = displacement_[static_cast<Eigen::Index>(i)];
    const double z = top_ - motion_, master[12] = {-4, -4, z, -4, 4, z, 4, 4, z, 4, -4, z};
    std::vector<double> residual(3 * count), tangent(9 * count), energy(count);
    auto in = ents::make<ents_input>();
    in.slave = slave_.data(), in.slave_stride = 3;
    in.master = master, in.area = area_.data(), in.area_stride = 1;
    in.start = start_.data(), in.start_stride = 2;
    auto out = ents::make<ents_output>();
    out.wanted = ENTS_RESIDUAL | ENTS_TANGENT | ENTS_ENERGY;
    out.residual = residual.data(), out.residual_stride = 3;
    out.tangent = tangent.data(), out.tangent_stride = 9;
    out.energy = energy.data(), out.energy_stride = 1;
    ents::require(ents::linked(), ents::linked().evaluate, model_.get(), std::int64_t{0},
                  static_cast<std::int64_t>(count), &in, &out);
    contact_.resize(static_cast<Eigen::Index>(count)), stiffness_.resize(contact_.size());
    law_energy_ = 0;
    for (std::size_t i = 0; i < count; ++i) {
      contact_[static_cast<Eigen::Index>(i)] = residual[3 * i + 2];
      stiffness_[static_cast<Eigen::Index>(i)] = tangent[9 * i + 8];
      law_energy_ += energy[i];
    }
  }

  std::vector<GridLines> lines_;
  std::shared_ptr<const LayerBody> body_;
  LayerSolver solver_;
  ents::Model model_;
  double top_, width_, motion_ = 0, law_energy_ = 0;
  std::vector<double> slave_, start_, area_;
  Eigen::VectorXd displacement_, contact_, stiffness_;
  int iterations_ = 0;
};

/// The largest tension while the master moves away, until it is free.
double pull_off(Press& press, double from, double step) {
  double least = 0;
  for (double motion = from; motion > from - 400 * step; motion -= step) {
    const double force = press.move(motion);
    if (force > 0.3 * least && least < 0) return least;
    least = std::min(least, force);
  }
  ADD_FAILURE() << "does not come off";
  return least;
}

// ---- a cylinder, line contact: R 10, w 0.01 ----

constexpr double radius = 10, work = 0.01;

/// Baney and Hui, J. Appl. Phys. 82 (1997) 519; K. L. Johnson and J. A. Greenwood, J. Phys. D 41 (2008) 155315: half-widths
/// of contact a and of tension m a, tension s: the load at a.
double maugis_load(double a, double s) {
  const auto opening = [&](double m) {
    const double root = std::sqrt(m * m - 1), log = std::log(m + root);
    return a * a / (2 * radius) * (m * root - log) +
           4 * s * a / (pi * modulus) * (root * log - m * std::log(m));
  };
  double low = 1, high = 2;
  while (opening(high) < work / s) high *= 2;
  for (int i = 0; i < 200; ++i) (opening(0.5 * (low + high)) < work / s ? low : high) = 0.5 * (low + high);
  return pi * modulus * a * a / (4 * radius) - 2 * s * a * std::sqrt(low * low - 1);
}
double maugis_pull_off(double s) {
  double least = 0;
  for (int i = 0; i <= 4000; ++i) least = std::min(least, maugis_load(std::pow(10.0, -4 + i / 1000.0), s));
  return least;
}
const double jkr = -3 * std::cbrt(pi * modulus * work * work * radius / 16);

double cylinder(double strength, int cells, double from, double step) {
  const Json height = {{"type", "polynomial"}, {"coefficients", {{0.0}, {0.0}, {-0.5 / radius}}}};
  Press press(2, cells, 4, height, 0,
              {{"type", "dugdale"},
               {"work", work},
               {"strength", strength},
               {"stiffness", std::max(2e5, 4 * strength * strength / work)}});
  return pull_off(press, from, step);
}

TEST(Adhesion, CylinderFromJkrToRigidBodies) {
  EXPECT_NEAR(jkr, -1.799357, 1e-6);
  EXPECT_NEAR(maugis_pull_off(64) / jkr, 1, 2e-5);
  const double few = cylinder(16, 1024, 0, 1e-4);
  std::cout << "JKR " << few / jkr - 1 << "\n";
  EXPECT_NEAR(few / jkr, 1, 0.01);
  for (const auto& [strength, cells] :
       {std::pair(0.25, 256), std::pair(1.0, 256), std::pair(4.0, 512), std::pair(8.0, 512)}) {
    const double force = cylinder(strength, cells, 0, strength < 1 ? 1e-3 : 1e-4),
                 exact = maugis_pull_off(strength);
    std::cout << "strength " << strength << ": " << force << ", Maugis " << exact << ", error "
              << force / exact - 1 << "\n";
    EXPECT_NEAR(force / exact, 1, 0.01) << strength;
  }
  // rigid: all points within the range pull
  EXPECT_NEAR(maugis_pull_off(0.25) / (-2 * std::sqrt(2 * radius * work * 0.25)), 1, 0.01);
}

// ---- a wave: Johnson, Int. J. Solids Struct. 32 (1995) 423 ----

const double amplitude = 5e-4, full = pi * modulus * amplitude; // of a wave of the length 1; p*

Json wave() {
  return {{"type", "sine"}, {"amplitude", amplitude}, {"wave_vector", {1, 0}}, {"phase", pi / 2}};
}
Json wave_law(double alpha, double strength) {
  const double w = 0.5 * alpha * alpha * pi * pi * modulus * amplitude * amplitude;
  return {{"type", "dugdale"},
          {"work", w},
          {"strength", strength},
          {"stiffness", std::max(2e6, 4 * strength * strength / w)}};
}

TEST(Adhesion, PullOffOfAWave) {
  const double pull[] = {-0.0219842, -0.0556107, -0.1415920}, alphas[] = {0.1, 0.2, 0.4};
  for (int i = 0; i < 3; ++i) {
    const double alpha = alphas[i];
    Press press(0.5, 512, 1, wave(), amplitude, wave_law(alpha, 10 * alpha));
    const double force = pull_off(press, 0, 1e-5 * alpha / 0.2) / full;
    std::cout << "alpha " << alpha << ": " << force << ", Johnson " << pull[i] << ", error "
              << force / pull[i] - 1 << "\n";
    EXPECT_NEAR(force / pull[i], 1, 0.02) << alpha;
  }
}

// Down and up again: between jumps the work of the master is the change of energy, and what is missing in the loop is
// lost in two steps, jump into contact and out of it.
TEST(Adhesion, OfALoopJumpsTakeTheEnergy) {
  Press press(0.5, 256, 1, wave(), amplitude, wave_law(0.2, 1.2));
  constexpr double low = -4e-4, high = 2e-4;
  constexpr int steps = 150;
  double work_done = 0, lost = 0, largest_of_others = 0;
  int jumps = 0;
  double force = press.move(low), energy = press.energy();
  const double first = energy;
  for (int i = 1; i <= 2 * steps; ++i) {
    const double part =
        i <= steps ? static_cast<double>(i) / steps : static_cast<double>(2 * steps - i) / steps;
    const double next = press.move(low + (high - low) * part), then = press.energy();
    const double way = (high - low) / steps * (i <= steps ? 1 : -1), done = 0.5 * (force + next) * way;
    const double missing = done - (then - energy);
    work_done += done;
    if (missing > 1e-8) // jumps
      lost += missing, ++jumps;
    else
      largest_of_others = std::max(largest_of_others, std::abs(missing));
    force = next, energy = then;
  }
  std::cout << "loop " << work_done << ", jumps " << jumps << " lost " << lost << ", others at most "
            << largest_of_others << "\n";
  EXPECT_EQ(jumps, 2);
  EXPECT_NEAR(energy, first, 1e-12);
  EXPECT_NEAR(work_done, lost, 0.01 * lost);
  EXPECT_LT(largest_of_others, 1e-3 * lost); // of the trapezoidal rule, one step
}

} // namespace
} // namespace host::adhesion_test
