// SPDX-License-Identifier: BSD-3-Clause
// Poses of rigid masters as arguments.
#pragma once

#include "abi/call/entry_point.hpp"
#include "core/body/pose.hpp"

namespace ents {

// The caller's pose, or null with the report written.
const ents_pose* checked_pose(int dimension, const ents_pose* pose, ents_pose& copy, const char* name,
                              std::int32_t& status, ents_report* report);

} // namespace ents
