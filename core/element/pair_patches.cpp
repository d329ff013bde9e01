// SPDX-License-Identifier: BSD-3-Clause
#include "core/element/pair_kernel.hpp"

namespace ents::ENTS_ISA {
ENTS_PAIR_KERNELS(CatmullRom16)
ENTS_PAIR_KERNELS(BSpline16)
ENTS_PAIR_KERNELS(Bezier15)
} // namespace ents::ENTS_ISA
