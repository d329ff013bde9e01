// SPDX-License-Identifier: BSD-3-Clause
#include "core/element/pair_kernel.hpp"

namespace ents::ENTS_ISA {
ENTS_PAIR_KERNELS(Quad4)
ENTS_PAIR_KERNELS(Quad8)
ENTS_PAIR_KERNELS(Quad9)
} // namespace ents::ENTS_ISA
