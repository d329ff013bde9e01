// SPDX-License-Identifier: BSD-3-Clause
// Floating-point environments that a host may have: rounding, traps, flags, flush to zero.
#pragma once

#include <gtest/gtest.h>

#include <cfenv>
#include <utility>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace test {

// Everything a host can see or set.
struct Environment {
  int rounding = 0, traps = 0, flags = 0;
  unsigned control = 0; // MXCSR, sticky flags included
  bool operator==(const Environment&) const = default;
};

inline Environment current() {
  Environment e;
  e.rounding = std::fegetround();
  e.traps = fegetexcept();
  e.flags = std::fetestexcept(FE_ALL_EXCEPT);
#if defined(__SSE2__)
  e.control = _mm_getcsr();
#endif
  return e;
}

struct Setting {
  const char* name;
  int rounding;
  int traps;
  bool flush; // results and inputs that are denormal count as 0
  int raised; // flags that stand already (without traps: a standing flag would trap)
};
inline constexpr int usual_traps = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;
inline const Setting settings[] = {
    {"default", FE_TONEAREST, 0, false, 0},
    {"upward", FE_UPWARD, 0, false, 0},
    {"downward", FE_DOWNWARD, 0, false, 0},
    {"towards zero", FE_TOWARDZERO, 0, false, 0},
    {"traps", FE_TONEAREST, usual_traps, false, 0},
    {"all traps, upward", FE_UPWARD, FE_ALL_EXCEPT, false, 0},
    {"flush to zero", FE_TONEAREST, 0, true, 0},
    {"flush to zero, downward, traps, flags", FE_DOWNWARD, FE_UNDERFLOW, true, FE_INVALID | FE_INEXACT},
    {"flags", FE_TONEAREST, 0, false, FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW | FE_UNDERFLOW | FE_INEXACT},
};

// `body` in a setting; nothing else of the test may run in it. Returns the environments just before and
// after.
template <class Body> std::pair<Environment, Environment> in(const Setting& setting, Body&& body) {
  std::fenv_t saved;
  std::fegetenv(&saved);
  fedisableexcept(FE_ALL_EXCEPT);
  std::feclearexcept(FE_ALL_EXCEPT);
  std::feraiseexcept(setting.raised);
  std::fesetround(setting.rounding);
#if defined(__SSE2__)
  if (setting.flush) _mm_setcsr(_mm_getcsr() | 0x8040u); // FTZ and DAZ
#endif
  feenableexcept(setting.traps);
  const Environment before = current();
  body();
  const Environment after = current();
  std::fesetenv(&saved);
  return {before, after};
}

#define EXPECT_KEPT(setting, body)                                                                           \
  do {                                                                                                       \
    const auto environments = in(setting, body);                                                             \
    EXPECT_EQ(environments.first.rounding, environments.second.rounding) << (setting).name;                  \
    EXPECT_EQ(environments.first.traps, environments.second.traps) << (setting).name;                        \
    EXPECT_EQ(environments.first.flags, environments.second.flags) << (setting).name;                        \
    EXPECT_EQ(environments.first.control, environments.second.control) << (setting).name;                    \
  } while (false)

} // namespace test
