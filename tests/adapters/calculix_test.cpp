// SPDX-License-Identifier: BSD-3-Clause
// What CalculiX's elements U1E and U1A say where they cannot work.
#include <gtest/gtest.h>
#include <unistd.h>

#include "calculix_host.hpp"
#include "problem.hpp"

namespace adapters {
namespace {

class Calculix : public testing::TestWithParam<const char*> {};

TEST_P(Calculix, LinearStepsStopWithAdvice) {
  const Problem p = problem("quad4_friction");
  CalculixHost host(p.elements, GetParam());
  host.linear_step();
  const auto iteration = [&] {
    dup2(STDERR_FILENO, STDOUT_FILENO); // ccx's channel
    host.evaluate(0, pressed(p));
  };
  EXPECT_EXIT(iteration(), testing::ExitedWithCode(201),
              std::string("ERROR in ") + GetParam() + ": ents, element 1: .*this step is linear");
}

INSTANTIATE_TEST_SUITE_P(Adapters, Calculix, testing::Values("U1E", "U1A"),
                         [](const auto& test) { return test.param; });

} // namespace
} // namespace adapters
