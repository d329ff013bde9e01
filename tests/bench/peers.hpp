// What the contact elements of other programs cost, in the same run.
#pragma once

#include <iosfwd>

namespace bench {

// Residual and tangent of elements, plain and enriched, with and without friction: the library's against
// CalculiX's contact spring and against the IPC Toolkit's pairs, as far as they are in this program; else how
// to get them there. Returns 1 if their forces are not those of the library, 2 if none is in this program,
// else 0.
int run_peers(std::ostream& out);

} // namespace bench
