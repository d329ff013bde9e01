// How many random samples a test takes (sample_count.hpp), and the worst error among them.
#pragma once

#include <string>

#include "sample_count.hpp"

namespace mechanics {

using test::long_divisor;
using test::long_samples;
using test::sample_divisor;
using test::samples;

struct Worst {
  double error = 0.0;
  std::string where = "nothing";

  template <class Describe> void see(double now, Describe&& describe) {
    if (error != error || now <= error) return; // a NaN is the worst of all, and stays
    error = now;
    where = describe();
  }
};

} // namespace mechanics
