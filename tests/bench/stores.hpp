// Stores to memory and nothing else: what no program that writes as much can be faster than.
#pragma once

#include <algorithm>
#include <cstddef>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace bench {

inline void store_all(double* memory, std::size_t count, double value) {
  std::fill_n(memory, count, value);
  asm volatile("" : : "r"(memory) : "memory");
}

// Past the caches, where the processor can. `memory` begins with a cache line, `count` is even.
inline void store_past_caches(double* memory, std::size_t count, double value) {
#if defined(__SSE2__)
  const __m128d both = _mm_set1_pd(value);
  for (std::size_t i = 0; i < count; i += 2) _mm_stream_pd(memory + i, both);
  _mm_sfence();
#else
  store_all(memory, count, value);
#endif
}

} // namespace bench
