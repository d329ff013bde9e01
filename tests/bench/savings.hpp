// What it is worth to model no more than a scene needs.
#pragma once

#include <iosfwd>

namespace bench {

// Elements of a scene that needs everything, then with each thing left out, alone and together: time of an
// element evaluated in calls of one and of 64, and assembled, what the library says it left out, and the
// ratio to the full scene.
void run_savings(std::ostream& out);

} // namespace bench
