// SPDX-License-Identifier: BSD-3-Clause
#include "core/element/general_block.hpp"

namespace ents::ENTS_ISA {
ENTS_GENERAL_KERNELS(CatmullRom16)
ENTS_GENERAL_KERNELS(BSpline16)
ENTS_GENERAL_KERNELS(Bezier15)
} // namespace ents::ENTS_ISA
