// SPDX-License-Identifier: BSD-3-Clause
// MSC Marc's two readings of dispt and r: one is the adapter's own, the other one is had by options, and a wrong choice
// is noticed as long as nothing has moved.
#include <gtest/gtest.h>

#include "other_hosts.hpp"
#include "problem.hpp"

namespace adapters::marc_test {
namespace {

TEST(Marc, DisplacementsOfTheBeginAndForcesOfTheOtherSignAreOptions) {
  Problem p = problem("quad4_friction");
  const std::vector<double> start(p.elements.reference.size()), u = pressed(p);
  const auto plain = marc_host(p.elements);
  p.elements.options = 2 + 4;
  const auto other = marc_user_code_host(p.elements);
  plain->begin(start), other->begin(start);
  for (int k = 0; k < static_cast<int>(p.elements.nodes.size()); ++k) {
    const auto a = plain->evaluate(k, u), b = other->evaluate(k, u);
    EXPECT_EQ(a.residual, b.residual) << k; // 0 + increment: no rounding
    EXPECT_EQ(a.tangent, b.tangent) << k;
  }
}

TEST(Marc, DisplacementsOfTheBeginAreNoticedWhereTheOptionIsMissing) {
  const Problem p = problem("quad4_friction");
  const std::vector<double> start(p.elements.reference.size());
  const auto host = marc_user_code_host(p.elements);
  host->begin(start);
  testing::internal::CaptureStdout();
  EXPECT_THROW(host->evaluate(0, pressed(p)), HostStopped);
  EXPECT_NE(testing::internal::GetCapturedStdout().find("add 2 to EGEOM3"), std::string::npos);
}

} // namespace
} // namespace adapters::marc_test
