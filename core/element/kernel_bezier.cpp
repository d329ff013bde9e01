// SPDX-License-Identifier: BSD-3-Clause
#include "core/element/kernel.hpp"

namespace ents::ENTS_ISA {
const KernelSet bezier15_kernels = kernels_of<Bezier15>;
} // namespace ents::ENTS_ISA
