// What it costs to bring elements into a host's equations.
#pragma once

#include <iosfwd>

namespace bench {

// ents_assemble on quad4 surfaces of 10^2 .. 10^6 segments with a slave node over each: all, evaluation
// alone, and the rest; first call (places are looked for) and later ones.
void run_assembly(std::ostream& out);

} // namespace bench
