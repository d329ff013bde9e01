// SPDX-License-Identifier: BSD-3-Clause
#include "core/element/heat_block.hpp"

namespace ents::ENTS_ISA {
ENTS_HEAT_KERNELS(CountedBasis<3>)
} // namespace ents::ENTS_ISA
