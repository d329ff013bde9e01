// SPDX-License-Identifier: BSD-3-Clause
// A slave that had a segment finds none: has it risen from the surface, or is its contact lost?
#pragma once

#include "core/search/detection.hpp"

namespace ents {

enum class Lost { no, behind_edge, beside, too_deep };

// `before`: the slave's segment, a number of the mesh, and its projection there. `found`: what was detected,
// without a segment.
Lost judge_lost_contact(const Plan& plan, const MasterMesh& mesh, const double* tree, const double* slave,
                        std::int64_t before, const double* xi_before, const Detection& found) noexcept;

} // namespace ents
