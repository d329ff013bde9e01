// Stores to memory and nothing else: what no program that writes as much can be faster than.
#pragma once

#include <algorithm>
#include <cstddef>

namespace bench {

inline void store_all(double* memory, std::size_t count, double value) {
  std::fill_n(memory, count, value);
  asm volatile("" : : "r"(memory) : "memory");
}

} // namespace bench
