// What the machine can do: no program is faster.
#pragma once

#include <cstdint>

namespace bench {

struct Machine {
  double flops; // per second: additions and multiplications that do not wait for each other, not fused,
                // because the library does not fuse either
  double bytes; // per second: stores to memory
  const char* registers; // the widest
};
Machine measure_machine();

// Columns of `dofs` numbers (6, 12, 15 or 30), stored in the widest registers, the last of a column
// overlapping the one before it, as tangents are: without computing them.
void store_columns(double* to, int dofs, std::int64_t columns);

} // namespace bench
