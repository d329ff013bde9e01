// Many elements, from and to main memory.
#pragma once

#include <cstdint>
#include <iosfwd>

namespace bench {

// Residual and tangent of line2, tri3, quad4 and quad9, plain and with a sine, in array calls of 10^2 ..
// `most` elements: results to main memory, and into the same 64 places again and again. quad9: what 4 GB
// hold.
void run_streaming(std::ostream& out, std::int64_t most);

} // namespace bench
