// SPDX-License-Identifier: BSD-3-Clause
// What an evaluation says of itself: its status, and flags of each element.
#pragma once

#include <cstdint>

namespace ents {

// Outcome of an evaluation; the values are those of the C ABI.
enum class Status : std::int32_t {
  ok = 0,
  no_projection = 1,
  singular_projection = 2,
  ambiguous_projection = 3,
  degenerate_segment = 4,
  grazing_ray = 5,
  deep_penetration = 6,
  out_of_range = 7,
  non_finite = -4,
  bad_value = -7,
  bad_state = -12,
};

namespace flag {
enum : std::int32_t {
  contact = 1,
  outside = 2,
  far_side = 4,
  searched = 8,
  stick = 16,
  slip = 32,
  shear_limit = 64,
  changed = 128,
  no_begin = 2048
};
}

} // namespace ents
