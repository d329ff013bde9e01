// SPDX-License-Identifier: BSD-3-Clause
// Random expressions against numbers of 40 digits that expression_reference.py finds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>

#include "abi/read/expression_text.hpp"
#include "sample_count.hpp"

namespace expression_reference_test {
namespace {

using namespace ents;

// Random expressions against 40 digits; the bounds of the errors are those of the script. They leave out that
// sums of products have their rounding in another order, and that functions err by up to 2.5 units in the
// last place instead of 2.
TEST(Expression, AgreesWithFortyDigits) {
  const char* wanted =
      std::getenv("ENTS_EXPRESSIONS"); // 10000 take two minutes, nearly all of them in the script
  const long count = wanted ? std::atol(wanted) : static_cast<long>(test::samples(400));
  const std::string command = std::string(ENTS_PYTHON) + " " + ENTS_SOURCE_DIR +
                              "/tests/abi/expression_reference.py " + std::to_string(count) + " 1 50 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  ASSERT_TRUE(pipe);
  std::string output;
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) output.append(buffer, n);
  const int status = pclose(pipe);
  if (WEXITSTATUS(status) == 77) GTEST_SKIP() << output << " (Debian: python3-sympy python3-mpmath)";
  ASSERT_EQ(status, 0) << output;
  std::istringstream lines(output);
  std::string line;
  long done = 0;
  double worst = 0.0, relative = 0.0;
  while (std::getline(lines, line)) {
    const std::size_t tab = line.find('\t');
    ASSERT_NE(tab, std::string::npos) << line;
    const std::string text = line.substr(0, tab);
    std::istringstream numbers(line.substr(tab));
    double s[2], expected[10], error[10], jet[10] = {};
    numbers >> s[0] >> s[1];
    for (double& x : expected) numbers >> x;
    for (double& x : error) numbers >> x;
    ASSERT_TRUE(numbers) << line;
    const double estimated[2] = {Height::unbounded, Height::unbounded};
    const Height height = read_expression(text, "h", {2, {}, {}}, estimated);
    if (height.root().kind == HeightKind::external)
      height.root().external.jets(height.root().external, 3, 1, s, jet);
    else
      jet[0] = height.bound() * (expected[0] < 0.0 ? -1.0 : 1.0);
    for (int i = 0; i < 10; ++i) {
      const double off = std::fabs(jet[i] - expected[i]),
                   allowed = 2.0 * error[i] + 3e-16 * std::fabs(expected[i]) + 1e-300;
      EXPECT_LE(off, allowed) << text << " at " << s[0] << ", " << s[1] << ": number " << i << " is "
                              << jet[i] << ", not " << expected[i];
      worst = std::max(worst, off / allowed);
      if (error[i] < 1e-14 * std::fabs(expected[i]))
        relative = std::max(relative, off / std::fabs(expected[i]));
    }
    ++done;
  }
  EXPECT_EQ(done, count);
  EXPECT_LT(relative, 1e-13); // of numbers that rounding leaves 14 digits
  std::printf("%ld expressions, error over its bound %.2f, relative error of well-conditioned numbers %.1e\n",
              done, worst, relative);
}

} // namespace
} // namespace expression_reference_test
