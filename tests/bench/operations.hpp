// The number of arithmetic operations of an element.
#pragma once

#include <string>

namespace bench {

// Additions, multiplications, divisions and roots of a residual and, if wanted, a tangent, the projection
// from 1e-2 beside it included, sine and penalty; line2, tri3, quad4, quad9. NaN for another basis.
double operations_of(const std::string& basis, bool enriched, bool tangent, bool friction);

} // namespace bench
