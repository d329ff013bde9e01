// What laws, projections and kinds of tangent cost beside the penalty element.
#pragma once

#include <iosfwd>

namespace bench {

// R + K of 64 elements of each law, frictionless and with friction, in calls of one and of 64, each as ratio
// to the penalty element of the same basis, height and friction; projections, tangents and patches likewise;
// one hard element among 64; second variations beside R + K.
void run_laws(std::ostream& out);

} // namespace bench
