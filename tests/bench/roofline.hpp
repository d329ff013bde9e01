// What the machine could do, and how near to it the elements are.
#pragma once

#include <iosfwd>

namespace bench {

// Measures the flop rate and the store bandwidth of this machine, one thread, then residual and tangent of
// elements in calls of 64 and of many, and prints flops and bytes of an element and percent of either limit.
void run_roofline(std::ostream& out);

} // namespace bench
