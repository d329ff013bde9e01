// SPDX-License-Identifier: BSD-3-Clause
// Copies to memory that nobody reads soon: past the caches where the processor can, so that what is overwritten need not be read first.
#pragma once

#include <algorithm>
#include <cstdint>

#if defined(__SSE2__) || defined(_M_X64)
#include <emmintrin.h>
#define ENTS_HAS_STREAMING 1
#endif

namespace ents {

// Another thread sees what is copied after the end of this object's life.
class StreamCopy {
public:
  StreamCopy() = default;
  StreamCopy(const StreamCopy&) = delete;
  StreamCopy& operator=(const StreamCopy&) = delete;
#if defined(ENTS_HAS_STREAMING)
  ~StreamCopy() {
    if (any_) _mm_sfence();
  }
  void operator()(const double* from, std::int64_t count, double* to) noexcept {
    any_ = true;
    constexpr std::int64_t line = 64 / sizeof(double); // half a line costs more than a store through the caches
    const std::int64_t before = static_cast<std::int64_t>(-reinterpret_cast<std::uintptr_t>(to) % 64 / sizeof(double));
    const std::int64_t first = std::min(before, count), last = first + (count - first) / line * line;
    std::copy_n(from, first, to);
    for (std::int64_t i = first; i < last; i += 2) _mm_stream_pd(to + i, _mm_loadu_pd(from + i));
    std::copy_n(from + last, count - last, to + last);
  }

private:
  bool any_ = false;
#else
  void operator()(const double* from, std::int64_t count, double* to) noexcept { std::copy_n(from, count, to); }
#endif
};

} // namespace ents
