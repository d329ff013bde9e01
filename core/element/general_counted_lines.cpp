// SPDX-License-Identifier: BSD-3-Clause
#include "core/element/general_block.hpp"

namespace ents::ENTS_ISA {
ENTS_GENERAL_KERNELS(CountedBasis<2>)
} // namespace ents::ENTS_ISA
