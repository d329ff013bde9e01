// What the contact elements of other programs cost, in the same run.
#pragma once

#include <iosfwd>

namespace bench {

// Residual and tangent of a quad4: the library's, plain and enriched, with and without friction, against
// CalculiX's contact spring on a plain quad4. Returns 1 if its forces are not those of the library, 2 if it
// is not in this program, else 0.
int run_peers(std::ostream& out);

} // namespace bench
