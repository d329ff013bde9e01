// SPDX-License-Identifier: BSD-3-Clause
// Problems with heat that hosts solve: two bars, and a block that is dragged.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace adapters {

/// Two bars of areas 1.2: a power enters the far end of the upper one, the far end of the lower one has a
/// temperature. Between them two slave nodes on one segment; a spring presses each down, two hold each master
/// node.
struct Bars {
  using Values = std::vector<double>;
  /// One contact element at nodes with (x, y, T) each, slave first, then the ends of a line: [9], [9][9] column-major.
  struct Response {
    Values residual, tangent;
  };
  using Element = std::function<Response(int element, const Values& reference, const Values& unknowns)>;
  /// The whole contact: adds its residual and tangent.
  using Contact = std::function<void(const Eigen::VectorXd& unknowns, Eigen::VectorXd& residual,
                                     Eigen::MatrixXd& tangent)>;

  static constexpr double area = 1.2, k_up = 3, k_low = 5, length_up = 2, length_low = 0.7, power = 8,
                          end = 20;
  // Nodes: 0, 1 slave, 2, 3 master, 4, 5 upper and 6, 7 lower ends: (x, y, T) each.
  static constexpr int n = 24;
  Eigen::VectorXd unknowns = Eigen::VectorXd::Zero(n);
  int iterations = 0;

  /// @return size of the residual, relative to that of its parts
  double assemble(const Contact& contact, Eigen::VectorXd& residual, Eigen::MatrixXd& tangent) const {
    residual = Eigen::VectorXd::Zero(n), tangent = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd size = Eigen::VectorXd::Constant(n, 1.0);
    const auto spring = [&](int dof, double stiffness, double foot) {
      residual(dof) += stiffness * (unknowns(dof) - foot), tangent(dof, dof) += stiffness;
      size(dof) += std::abs(stiffness * foot);
    };
    for (int node = 0; node < 8; ++node)
      for (int i = 0; i < 2; ++i) spring(3 * node + i, node < 2 ? 40 : 300, node < 2 && i == 1 ? -0.3 : 0);
    for (const int node : {6, 7}) spring(3 * node + 2, 1, end);
    for (const auto& [a, b, c] : {std::array{0, 4, 1}, {1, 5, 1}, {2, 6, 0}, {3, 7, 0}}) {
      const double s = 0.5 * area * (c ? k_up / length_up : k_low / length_low);
      const int i = 3 * a + 2, j = 3 * b + 2;
      const double q = s * (unknowns(i) - unknowns(j));
      residual(i) += q, residual(j) -= q;
      tangent(i, i) += s, tangent(j, j) += s, tangent(i, j) -= s, tangent(j, i) -= s;
    }
    for (const int node : {4, 5}) residual(3 * node + 2) -= power / 2;
    for (const int node : {6, 7}) { // prescribed
      const int i = 3 * node + 2;
      residual(i) = unknowns(i) - end;
      tangent.row(i).setZero(), tangent(i, i) = 1;
    }
    contact(unknowns, residual, tangent);
    return residual.cwiseQuotient(size).norm();
  }

  void solve(const Contact& contact) {
    Eigen::VectorXd residual;
    Eigen::MatrixXd tangent;
    while (assemble(contact, residual, tangent) > 1e-12) {
      ASSERT_LT(++iterations, 20);
      unknowns -= tangent.partialPivLu().solve(residual);
    }
  }
  void solve(const Element& element) {
    solve([&](const Eigen::VectorXd& u, Eigen::VectorXd& residual, Eigen::MatrixXd& tangent) {
      for (int slave = 0; slave < 2; ++slave) {
        const int nodes[3] = {slave, 2, 3};
        Values reference{slave == 0 ? -0.5 : 0.5, 0, -1, 0, 1, 0}, at;
        for (const int node : nodes)
          for (int i = 0; i < 3; ++i) at.push_back(u(3 * node + i));
        const Response r = element(slave, reference, at);
        for (std::size_t i = 0; i < 9; ++i) {
          const int row = 3 * nodes[i / 3] + static_cast<int>(i % 3);
          residual(row) += r.residual[i];
          for (std::size_t j = 0; j < 9; ++j)
            tangent(row, 3 * nodes[j / 3] + static_cast<int>(j % 3)) += r.tangent[i + 9 * j];
        }
      }
    });
  }
  double resistance(double conductance) const {
    return length_up / (k_up * area) + length_low / (k_low * area) + 1 / (conductance * area);
  }
};

/// A block that is dragged: nodes at the depth move by a step in each increment. Their friction has the power mu N v
/// and heats with 0.9 of it.
namespace dragged {
constexpr double mu = 0.3, normal = 100, tangential = 80, depth = 0.02, step = 0.05;

/// @param slave  part of the heat that the slave takes
inline std::string model(double slave) {
  return R"({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 100},
    "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 80},
    "heat": {"friction": {"share": 0.9, "slave": )" +
         std::to_string(slave) + "}}}}";
}
} // namespace dragged

} // namespace adapters
