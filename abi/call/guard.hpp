// SPDX-License-Identifier: BSD-3-Clause
// The floating-point environment of a call: inside, rounding is to nearest, nothing traps and denormal
// numbers count; outside, everything is as the caller left it, sticky flags included. Reading the control
// word is cheap, writing it is not, so it is written only when it must change.
#pragma once

#include <cstdint>

#if defined(__SSE2__) || defined(_M_X64)
#include <xmmintrin.h>
#define ENTS_HAS_MXCSR 1
#else
#include <cfenv>
#endif

namespace ents {

class FloatingPointGuard {
public:
  FloatingPointGuard(const FloatingPointGuard&) = delete;
  FloatingPointGuard& operator=(const FloatingPointGuard&) = delete;
#ifdef ENTS_HAS_MXCSR
  FloatingPointGuard() noexcept : saved_(_mm_getcsr()) {
    if ((saved_ & ~sticky_flags) != all_masked) _mm_setcsr(all_masked);
  }
  ~FloatingPointGuard() {
    if (_mm_getcsr() != saved_) _mm_setcsr(saved_);
  }

private:
  static constexpr std::uint32_t sticky_flags = 0x3f; // invalid .. inexact
  static constexpr std::uint32_t all_masked = 0x1f80; // nearest, no trap, no flush to zero
  std::uint32_t saved_;
#else
  FloatingPointGuard() noexcept {
    std::feholdexcept(&saved_);
    std::fesetround(FE_TONEAREST);
  }
  ~FloatingPointGuard() { std::fesetenv(&saved_); }

private:
  std::fenv_t saved_;
#endif
};

} // namespace ents
