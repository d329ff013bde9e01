// SPDX-License-Identifier: BSD-3-Clause
#include "core/element/general_block.hpp"

namespace ents::ENTS_ISA {
ENTS_GENERAL_KERNELS(Line2)
ENTS_GENERAL_KERNELS(Line3)
ENTS_GENERAL_KERNELS(CatmullRom4)
ENTS_GENERAL_KERNELS(BSpline4)
} // namespace ents::ENTS_ISA
