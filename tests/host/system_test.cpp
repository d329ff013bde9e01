// SPDX-License-Identifier: BSD-3-Clause
// Equations, sparse assembly and solvers against dense ones.
#include "sparse_system.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "dof_map.hpp"
#include "indefinite_solver.hpp"
#include "support.hpp"

namespace host::system_test {
namespace {

TEST(DofMap, PrescribedAndTiedDofs) {
  DofMap dofs(4, 2);
  dofs.tie(3, 1);
  dofs.prescribe(0, 0);
  dofs.prescribe(3, 1); // of a tied node: holds for its owner, too
  dofs.number();
  EXPECT_EQ(dofs.equation(0, 0), -1);
  EXPECT_EQ(dofs.equation(0, 1), 0);
  EXPECT_EQ(dofs.equation(1, 0), 1);
  EXPECT_EQ(dofs.equation(1, 1), -1);
  EXPECT_EQ(dofs.equation(3, 0), 1);
  EXPECT_EQ(dofs.equation(3, 1), -1);
  EXPECT_EQ(dofs.equation(2, 0), 2);
  EXPECT_EQ(dofs.equation(2, 1), 3);
  EXPECT_EQ(dofs.size(), 4);
  EXPECT_EQ(dofs.representative(3), 1);
}

TEST(DofMap, ChainsOfTiesEndAtOneNode) {
  DofMap dofs(5, 1); // the corner of a doubly periodic body
  dofs.tie(4, 3);
  dofs.tie(3, 1);
  dofs.tie(4, 2);
  dofs.number();
  for (const int node : {2, 3, 4}) EXPECT_EQ(dofs.equation(node, 0), dofs.equation(1, 0));
  EXPECT_EQ(dofs.size(), 2);
}

/// Two groups of elements of different size on 12 equations, with prescribed and shared ones among them.
struct Assembled {
  StencilGroup small, large;
  std::vector<Eigen::MatrixXd> small_tangents, large_tangents;
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(12, 12);

  explicit Assembled(bool symmetric) {
    test::Random random(5);
    const auto fill = [&](StencilGroup& group, std::vector<Eigen::MatrixXd>& tangents, int dofs,
                          int elements) {
      group.dofs = dofs;
      for (int e = 0; e < elements; ++e) {
        std::vector<int> equations;
        for (int a = 0; a < dofs; ++a) equations.push_back(static_cast<int>(random.uniform(-1.5, 11.99)));
        group.equations.insert(group.equations.end(), equations.begin(), equations.end());
        Eigen::MatrixXd K(dofs, dofs);
        for (int i = 0; i < dofs * dofs; ++i) K.data()[i] = random.uniform(-1, 1);
        if (symmetric) K = (K * K.transpose()).eval() + 0.1 * Eigen::MatrixXd::Identity(dofs, dofs);
        for (int a = 0; a < dofs; ++a)
          for (int b = 0; b < dofs; ++b)
            if (equations[static_cast<std::size_t>(a)] >= 0 && equations[static_cast<std::size_t>(b)] >= 0)
              dense(equations[static_cast<std::size_t>(a)], equations[static_cast<std::size_t>(b)]) +=
                  K(a, b);
        tangents.push_back(K);
      }
    };
    fill(small, small_tangents, 3, 8);
    fill(large, large_tangents, 6, 10);
  }
};

class Systems : public testing::TestWithParam<bool> {};

TEST_P(Systems, AssembleAndSolveLikeDenseOnes) {
  const bool symmetric = GetParam();
  const Assembled reference(symmetric);
  SparseSystem system(12, symmetric);
  const std::vector<const StencilGroup*> groups{&reference.small, &reference.large};
  system.build(groups);
  for (std::size_t e = 0; e < reference.small_tangents.size(); ++e)
    system.add(0, e, reference.small_tangents[e].data());
  for (std::size_t e = 0; e < reference.large_tangents.size(); ++e)
    system.add(1, e, reference.large_tangents[e].data());
  Eigen::MatrixXd sparse = Eigen::MatrixXd(system.matrix());
  if (symmetric) sparse = sparse.selfadjointView<Eigen::Lower>();
  EXPECT_LT((sparse - reference.dense).norm(), 1e-13 * reference.dense.norm());

  const auto solver = LinearSolver::create(symmetric);
  solver->analyze(system.matrix());
  ASSERT_TRUE(solver->factorize(system.matrix())) << solver->name();
  const Eigen::VectorXd exact = Eigen::VectorXd::LinSpaced(12, -1, 2);
  const Eigen::VectorXd solution = solver->solve(reference.dense * exact);
  const double condition = reference.dense.norm() * reference.dense.inverse().norm();
  EXPECT_LT((solution - exact).norm(), 1e-14 * condition * exact.norm()) << solver->name();
}

INSTANTIATE_TEST_SUITE_P(Both, Systems, testing::Bool());

TEST(Solver, SymmetricAndIndefiniteGoesToAnother) {
  StencilGroup group{2, {0, 1}};
  SparseSystem system(2, true);
  const std::vector<const StencilGroup*> groups{&group};
  system.build(groups);
  const std::array<double, 4> tangent{1, 2, 2, 1}; // eigenvalues 3 and -1
  system.add(0, 0, tangent.data());
  for (const bool laboratory : {false, true}) { // LU, or MUMPS where it is installed
    const auto solver = LinearSolver::create(true, laboratory ? indefinite_solver() : nullptr);
    solver->analyze(system.matrix());
    ASSERT_TRUE(solver->factorize(system.matrix()));
    const Eigen::VectorXd solution = solver->solve(Eigen::Vector2d(5, 4));
    EXPECT_NEAR(solution[0], 1, 1e-14);
    EXPECT_NEAR(solution[1], 2, 1e-14);
  }
}

} // namespace
} // namespace host::system_test
