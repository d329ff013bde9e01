// The time of a call beside that of its parts: kernel, chain of operations, stores, arithmetic.
#pragma once

#include <iosfwd>

namespace bench {

void run_limits(std::ostream& out);

} // namespace bench
