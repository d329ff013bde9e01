// SPDX-License-Identifier: BSD-3-Clause
#include "core/element/pair_kernel.hpp"

namespace ents::ENTS_ISA {
ENTS_PAIR_KERNELS(Line2)
ENTS_PAIR_KERNELS(Line3)
ENTS_PAIR_KERNELS(CatmullRom4)
ENTS_PAIR_KERNELS(BSpline4)
} // namespace ents::ENTS_ISA
