// SPDX-License-Identifier: BSD-3-Clause
#include "core/projection/segment_projection.hpp"

namespace ents::ENTS_ISA {
ENTS_SEARCH(Line2)
ENTS_SEARCH(Line3)
ENTS_SEARCH(CatmullRom4)
ENTS_SEARCH(BSpline4)
} // namespace ents::ENTS_ISA
