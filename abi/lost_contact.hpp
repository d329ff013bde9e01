// SPDX-License-Identifier: BSD-3-Clause
// A slave that had a segment finds none: has it risen from the surface, or is its contact lost?
#pragma once

#include "abi/mesh.hpp"

namespace ents {

enum class Lost { no, behind_edge, beside, too_deep };

struct LostContact {
  Lost kind = Lost::no;
  double gap =
      0.0; // to the segment of before without its height, as it goes on beyond its edges; 0 if unknown
};

// `before`: the slave's segment, a number of the mesh, and its projection there. `found`: what was detected,
// without a segment.
Lost judge_lost_contact(const Plan& plan, const MasterMesh& mesh, const double* tree, const double* slave,
                        std::int64_t before, const double* xi_before, const Detection& found) noexcept;

// What the caller should do; `slave` is its number.
std::int32_t explain_lost_contact(Lost lost, std::int64_t slave, std::int64_t before, double reach,
                                  ents_report* report) noexcept;

} // namespace ents
