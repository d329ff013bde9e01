// Time and memory of the detection on whole surfaces.
#pragma once

#include <cstdint>
#include <iosfwd>

namespace bench {

// n slave nodes over n segments, n = 1000, 10000 .. most, for some bases, plain and enriched: ns per segment
// to build and to refit the tree, ns per slave to search, to follow and to see that nothing is near, bytes
// per segment; and the slope of each time over n on logarithmic scales (1: proportional to n).
void run_detection(std::ostream& out, std::int64_t most);

} // namespace bench
