// Stores to memory and nothing else: what no program that writes as much can be faster than.
#pragma once

#include <algorithm>
#include <cstddef>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace bench {

inline void store_all(double* memory, std::size_t count, double value) {
  std::fill_n(memory, count, value);
  asm volatile("" : : "r"(memory) : "memory");
}

#if defined(__x86_64__) && defined(__GNUC__)
// In whole lines
__attribute__((target("avx512f"))) inline void store_lines_past_caches(double* memory, std::size_t count,
                                                                       double value) {
  const __m512d all = _mm512_set1_pd(value);
  for (std::size_t i = 0; i + 8 <= count; i += 8) _mm512_stream_pd(memory + i, all);
  std::fill_n(memory + count / 8 * 8, count % 8, value);
  _mm_sfence();
}
#endif

// Past the caches, in the widest registers the processor has. `memory` begins with a cache line, `count` is
// even.
inline void store_past_caches(double* memory, std::size_t count, double value) {
#if defined(__x86_64__) && defined(__GNUC__)
  if (__builtin_cpu_supports("avx512f")) return store_lines_past_caches(memory, count, value);
#endif
#if defined(__SSE2__)
  const __m128d both = _mm_set1_pd(value);
  for (std::size_t i = 0; i < count; i += 2) _mm_stream_pd(memory + i, both);
  _mm_sfence();
#else
  store_all(memory, count, value);
#endif
}

} // namespace bench
