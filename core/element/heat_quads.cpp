// SPDX-License-Identifier: BSD-3-Clause
#include "core/element/heat_block.hpp"

namespace ents::ENTS_ISA {
ENTS_HEAT_KERNELS(Quad4)
} // namespace ents::ENTS_ISA
