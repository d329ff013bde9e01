// SPDX-License-Identifier: BSD-3-Clause
// How many plain segments the surface itself asks for, before any contact.
#pragma once

#include "ents_library.hpp"
#include "scene.hpp"

namespace host::chart {

/// Plain segments through points of a rigid enriched segment that are nowhere farther from it than `share` of
/// its amplitude (half of its height's range), at equal xi; as many in each direction, one less in each is
/// too few.
/// @param share  positive
/// @return their number; 0: the master is not rigid or has no height, or 1024 in each direction are not
///         enough
std::size_t segments_that_follow(const EntsLibrary& library, const Scene& scene, double share);

} // namespace host::chart
