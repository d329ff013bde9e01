// SPDX-License-Identifier: BSD-3-Clause
// Copies to memory that nobody reads soon: past the caches where the processor can, so that what is
// overwritten need not be read first.
#pragma once

#include <cstdint>
#include <cstring>

#include "core/numbers/scalar.hpp"

#if defined(__AVX__)
#include <immintrin.h>
#elif defined(__SSE2__) || defined(_M_X64)
#include <emmintrin.h>
#endif

namespace ents {
// `count` numbers to be copied past the caches, some now, some later
struct DeferredCopy {
  const double* from;
  std::int64_t count;
  double* to;
};
} // namespace ents

namespace ents::ENTS_ISA {

#if defined(__AVX512F__)
inline constexpr int stream_width = 8;
ENTS_INLINE void stream_store(double* to, const double* from) { _mm512_stream_pd(to, _mm512_loadu_pd(from)); }
#elif defined(__AVX__)
inline constexpr int stream_width = 4;
ENTS_INLINE void stream_store(double* to, const double* from) { _mm256_stream_pd(to, _mm256_loadu_pd(from)); }
#elif defined(__SSE2__) || defined(_M_X64)
inline constexpr int stream_width = 2;
ENTS_INLINE void stream_store(double* to, const double* from) { _mm_stream_pd(to, _mm_loadu_pd(from)); }
#else
inline constexpr int stream_width = 1;
ENTS_INLINE void stream_store(double* to, const double* from) { *to = *from; }
#endif

// Another thread sees what is copied after stream_fence() of the copying one.
inline void stream_copy(const double* from, std::int64_t count, double* to) {
  constexpr std::int64_t line =
      64 / sizeof(double); // a part of a line costs more than a store through the caches
  const auto copy = [=](std::int64_t begin, std::int64_t end) {
    std::memcpy(to + begin, from + begin, sizeof(double) * static_cast<std::size_t>(end - begin));
  };
  const std::int64_t before =
      static_cast<std::int64_t>(-reinterpret_cast<std::uintptr_t>(to) % 64 / sizeof(double));
  const std::int64_t first = before < count ? before : count, last = first + (count - first) / line * line;
  copy(0, first);
  for (std::int64_t i = first; i < last; i += stream_width) stream_store(to + i, from + i);
  copy(last, count);
}
// About `count` of the numbers still to be copied: up to the end of a line.
ENTS_NOINLINE inline void copy_some(DeferredCopy& of, std::int64_t count) {
  const std::int64_t beyond =
      static_cast<std::int64_t>(reinterpret_cast<std::uintptr_t>(of.to + count) % 64 / sizeof(double));
  if (count > beyond) count -= beyond;
  if (count > of.count) count = of.count;
  stream_copy(of.from, count, of.to);
  of.from += count, of.to += count, of.count -= count;
}
// Memory takes few lines at a time: a computation interleaves these copies with its own operations, about as
// many numbers as it computes meanwhile.
ENTS_INLINE void interleave_copy(DeferredCopy* of, std::int64_t count) {
  if (of) copy_some(*of, count);
}
inline void stream_fence() {
#if defined(__SSE2__) || defined(_M_X64)
  _mm_sfence();
#endif
}

} // namespace ents::ENTS_ISA
