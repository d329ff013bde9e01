// SPDX-License-Identifier: BSD-3-Clause
#include "core/element/fast_block.hpp"

namespace ents::ENTS_ISA {
ENTS_FAST_KERNELS(CountedBasis<2>)
} // namespace ents::ENTS_ISA
