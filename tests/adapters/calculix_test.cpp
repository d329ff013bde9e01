// SPDX-License-Identifier: BSD-3-Clause
// What CalculiX's elements U1E and U1A say where they cannot work.
#include <gtest/gtest.h>
#include <unistd.h>

#include "calculix_host.hpp"
#include "problem.hpp"

extern "C" int ents_ccx_unsymmetric_(const int* ne, const int* ipkon, const char* lakon, const int* ielprop,
                                     const double* prop, const int* nprop);

namespace adapters::calculix_test {
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

// ccx does not tell an element how many constants it has: where they end is known from those of the next
// section.
TEST(CalculixConstants, FewerThanThreeStopTheJob) {
  const Problem p = problem("quad4_friction");
  const double model = p.elements.model, prop[] = {model, 0.5, 0, model};
  const int ne = 2, ipkon[] = {0, 5}, ielprop[] = {0, 3};
  const char labels[] = "U1E   \x03\x05U1E   \x03\x05";
  const auto ask = [&] {
    dup2(STDERR_FILENO, STDOUT_FILENO); // ccx's channel
    const int nprop = 4;
    ents_ccx_unsymmetric_(&ne, ipkon, labels, ielprop, prop, &nprop);
  };
  EXPECT_EXIT(ask(), testing::ExitedWithCode(201), "CONSTANTS=1: write CONSTANTS=3");
}

TEST(CalculixConstants, DecksWithoutContactElementsHaveNone) {
  const int ne = 2, ipkon[] = {0, -1}, nprop = 0;
  EXPECT_EQ(ents_ccx_unsymmetric_(&ne, ipkon, "C3D8    U1E   \x03\x05", nullptr, nullptr, &nprop), 0);
}

INSTANTIATE_TEST_SUITE_P(Adapters, Calculix, testing::Values("U1E", "U1A"),
                         [](const auto& test) { return test.param; });

} // namespace
} // namespace adapters::calculix_test
