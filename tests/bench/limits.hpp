// What a call is made of, and what none of its parts can be faster than.
#pragma once

#include <iosfwd>

namespace bench {

void run_limits(std::ostream& out);

} // namespace bench
