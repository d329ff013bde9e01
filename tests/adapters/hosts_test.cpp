// SPDX-License-Identifier: BSD-3-Clause
// The same problems through every host: solutions, iterations and cuts are those of the plain ABI.
#include <cmath>

#include <gtest/gtest.h>

#include "hosts.hpp"
#include "problem.hpp"
#include "worst.hpp"

namespace adapters::hosts_test {
namespace {

class EveryHost : public testing::TestWithParam<std::tuple<HostKind, std::string>> {};

TEST_P(EveryHost, SolvesAsThePlainInterface) {
  const auto& [kind, name] = GetParam();
  const Problem p = problem(name);
  const Solution expected = solve(p, *plain_host(p.elements));
  ASSERT_GE(expected.in_contact, 5) << "the problem is not about contact";
  const std::unique_ptr<EmulatedHost> host = kind.make(p.elements);
  if (expected.cuts && !kind.cuts) {
    EXPECT_THROW(solve(p, *host), HostStopped); // an increment too large ends the job: never a wrong number
    return;
  }
  const Solution solution = solve(p, *host);
  EXPECT_EQ(solution.iterations, expected.iterations);
  EXPECT_EQ(solution.cuts, expected.cuts);
  ASSERT_EQ(solution.displacement.size(), expected.displacement.size());
  double worst = 0;
  for (std::size_t i = 0; i < expected.displacement.size(); ++i)
    ::test::raise(worst, std::abs(solution.displacement[i] - expected.displacement[i]));
  // The same bits. Where the host adds positions up in another order, Newton's iterations end at another
  // place within the tolerance: a residual of 1e-11 of all forces, about 100, against springs of 40 and more;
  // of multipliers, which are forces per area, against areas of 0.3 and more.
  const double bound = 1e-11 * 100 / (p.elements.multipliers > 0 ? 0.3 : 40);
  EXPECT_LE(worst, kind.same_bits ? 0.0 : bound);
}

TEST(Problems, FrictionMakesTheTangentUnsymmetricAndCutsHappen) {
  EXPECT_FALSE(problem("quad4_friction").elements.symmetric);
  for (const char* name : {"line2_cuts", "quad4_cuts"}) {
    const Problem p = problem(name);
    EXPECT_GT(solve(p, *plain_host(p.elements)).cuts, 0);
  }
}

TEST(Problems, SlaveNodesOfAPatchMoveOnToItsNextSegment) {
  const Problem p = problem("line2_patch");
  const Solution solution = solve(p, *plain_host(p.elements));
  const std::size_t unknowns = p.target.size(), last = solution.displacement.size() - unknowns;
  const auto x = [&](int node, std::size_t from) {
    const auto at = static_cast<std::size_t>(2 * node);
    return p.elements.reference[at] + solution.displacement[from + at];
  };
  int crossed = 0;
  for (const auto& nodes : p.elements.nodes)
    crossed += x(nodes[0], 0) < x(nodes[2], 0) && x(nodes[0], last) > x(nodes[2], last);
  EXPECT_GE(crossed, 5);
}

INSTANTIATE_TEST_SUITE_P(Adapters, EveryHost, testing::ValuesIn(hosts_and_problems()), [](const auto& test) {
  return std::get<0>(test.param).name + "_" + std::get<1>(test.param);
});

} // namespace
} // namespace adapters::hosts_test
