// SPDX-License-Identifier: BSD-3-Clause
// Errors that a test prints beside the bounds that they keep.
#pragma once

#include <gtest/gtest.h>

#include <iostream>

namespace test {

inline void expect_measured(const char* what, double error, double bound) {
  std::cout << what << ": " << error << ", bound " << bound << "\n";
  EXPECT_LE(error, bound) << what;
}

} // namespace test
