// SPDX-License-Identifier: BSD-3-Clause
// The caller's master surface: its arguments are checked here.
#pragma once

#include "abi/call/handle.hpp"
#include "core/search/detection.hpp"

namespace ents {

// Counts and pointers of `caller`; its nodes are checked as they are read.
std::int32_t check_mesh(const ents_master_mesh* caller, const char* name, MasterMesh& mesh,
                        ents_report* report) noexcept;

// Name what `gather` refused.
std::int32_t explain_segment(const Plan& plan, const MasterMesh& mesh, Status status, std::int64_t segment,
                             ents_report* report) noexcept;

} // namespace ents
