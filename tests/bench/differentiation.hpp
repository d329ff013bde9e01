// Closed form against automatic differentiation of the same element.
#pragma once

#include <iosfwd>

namespace bench {

// Residual and tangent of line2, tri3, quad4 and quad9 elements, plain and with a sine, frictionless: by the
// library and by public libraries for automatic differentiation, as far as CMake found them. Returns false if
// a tangent differs.
bool run_differentiation(std::ostream& out);

} // namespace bench
