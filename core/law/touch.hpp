// SPDX-License-Identifier: BSD-3-Clause
// The part of an increment in which an element slips (theory.md, section 5.10). An element that
// was open at the begin, by the clearance c_n > 0, and is in contact at the end has touched in between; with a
// gap that falls linearly, the part z / (c_n + z) of the increment comes after the touch, z >= 0: the depth at the end. Slip
// and wear of this increment are that part of xi - xi_n:
//   D = s (xi - xi_n),  s = z / (c_n + z),  ds/dz = c_n / (c_n + z)^2
// Multipliers that are dofs leave no depth: an element that touches within an increment has no friction in it.
#pragma once

#include "core/law/contact_law.hpp"
#include "core/numbers/lanes.hpp"

namespace ents::ENTS_ISA {

// What an increment begins with.
template <class S, int T> struct SlipBegin {
  S from[T];         // anchor of an element in contact; projection xi_n of an open one
  S known;           // 1 where there is one of these
  S clearance;       // c_n [L] of an open element; 0: it was in contact
  double time = 0.0; // of the increment; read where the coefficient of friction depends on the slip rate
};

template <class S> struct SlipShare {
  S share = S(1.0), rate = S(0.0); // s, ds/dz
  S touches = S(0.0);              // 1 where the element was open at the begin
  bool some = false;               // was any?
};

// Smaller ones are none: their inverse leaves the range of numbers.
inline constexpr double smallest_clearance = 1e-100;

// Not inlined: few elements touch in an increment, and the code of all others stays short.
template <class S>
ENTS_NOINLINE void share_after_touch(const S& clearance, const S& depth, SlipShare<S>& of) {
  const Truth<S> closes = clearance > smallest_clearance, deep = depth >= 0.0;
  const S z = select(deep, depth, S(0.0)), whole = select(closes, clearance + z, S(1.0));
  of.share = select(closes, z / whole, S(1.0));
  of.touches = select(closes, S(1.0), S(0.0));
  of.rate = select(both(closes, deep), (clearance / whole) / whole, S(0.0));
}

template <class S> ENTS_INLINE SlipShare<S> slip_share(const S& clearance, const S& depth) {
  SlipShare<S> of;
  of.some = any(clearance > smallest_clearance);
  if (of.some) {
    SlipShare<S> touching; // a copy: `of` stays in registers
    share_after_touch(clearance, depth, touching);
    of.share = touching.share, of.rate = touching.rate, of.touches = touching.touches;
  }
  return of;
}

} // namespace ents::ENTS_ISA
