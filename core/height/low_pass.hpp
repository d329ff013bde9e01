// SPDX-License-Identifier: BSD-3-Clause
// A height map without its short waves.
#pragma once

#include "core/height/height_map.hpp"

namespace ents {

// Leaves out the waves shorter than cut_off (in units of s): those of the period, or of a clamped map those
// of its mirror image, the cosines with a maximum in the first and the last sample. Takes of the order of
// samples x 4 size / cut_off operations. The bits are the same on all machines.
void leave_out_short_waves(HeightMap& map, double cut_off);

} // namespace ents
