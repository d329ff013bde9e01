// SPDX-License-Identifier: BSD-3-Clause
// A single element.
#pragma once

#include "core/model/plan.hpp"

namespace ents {

// An element of one segment: by the block kernel where that knows it, else by the element kernel. What else
// is wanted never shows in the bits of a result.
Status evaluate_segment(const Plan& plan, const ElementInput& in, const ElementOutput& out);

} // namespace ents
