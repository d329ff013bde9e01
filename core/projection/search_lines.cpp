// SPDX-License-Identifier: BSD-3-Clause
#include "core/projection/segment_projection.hpp"

namespace ents::ENTS_ISA {
ENTS_SEARCH(Line2)
} // namespace ents::ENTS_ISA
