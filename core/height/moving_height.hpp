// SPDX-License-Identifier: BSD-3-Clause
// A height along an iteration. Its points lie closer and closer to each other: a sine turns on from the one
// before.
#pragma once

#include <limits>

#include "core/height/height.hpp"
#include "core/numbers/lanes.hpp"

namespace ents::ENTS_ISA {

// A sine where it was last looked at.
template <class S> struct SineAt {
  S turns = S(std::numeric_limits<double>::infinity()); // wave_vector . s; none yet
  S h = S(0.0), slope = S(0.0);                         // amplitude times sine, times cosine
};

// Farther than this, turns, it is looked up.
inline constexpr double reuse_radius_turns = 1.0 / 64.0;

// Moves `at` to `turns`. Rounding adds up: over the moves of a projection to less than six units in the last
// place of the amplitude.
template <class S> ENTS_INLINE void move_sine(SineAt<S>& at, const Sine<double>& p, S turns) {
  const S f = turns - at.turns;
  const Truth<S> near = absolute(f) <= reuse_radius_turns;
  S h, slope;
  if (!every(near)) {
    sin_cos_turns(turns, p.phase, h, slope);
    h = p.amplitude * h;
    slope = p.amplitude * slope;
  }
  if (any(near)) {
    // The polynomials of sin_cos_near_zero() as far as they count here. What is large is added last and
    // waited for least.
    const S z = f * f, z2 = z * z, turned = two_pi * f;
    const S s =
        (-41.341702240399755 + z * 81.6052492760517) + z2 * (-76.70585973561397 + z * 42.05868917945876);
    const S c =
        (19.739208802178716 + z * -64.93939402266824) + z2 * (85.45681720664378 + z * -60.24464135269435);
    const S rest = f * z * s, lost = z * c;
    const S turned_h = (at.h + at.slope * turned) + (at.slope * rest - at.h * lost);
    const S turned_slope = (at.slope - at.h * turned) - (at.h * rest + at.slope * lost);
    if (every(near)) {
      h = turned_h, slope = turned_slope;
    } else {
      h = select(near, turned_h, h);
      slope = select(near, turned_slope, slope);
    }
  }
  at.turns = turns, at.h = h, at.slope = slope;
}

// evaluate_height() at one s after the other. An object whose address goes to a function out of line has to
// lie in memory as a whole. Apart: the address is that of a copy, and the object may stay in registers, which
// is faster where they hold most of a projection's numbers.
template <bool Apart, int T, class S>
ENTS_INLINE HeightJet<T, S> move_height(SineAt<S>& at, const HeightNode& node, const S (&s)[T]) {
  if (node.kind != HeightKind::sine) {
    if constexpr (!Apart) return evaluate_height(node, s);
    S copy[T];
    for (int a = 0; a < T; ++a) copy[a] = s[a];
    return evaluate_height(node, copy);
  }
  move_sine(at, node.sine, turns_of(node.sine, s));
  return sine_jet<T>(node.sine, at.h, at.slope);
}

} // namespace ents::ENTS_ISA
