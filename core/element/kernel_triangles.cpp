// SPDX-License-Identifier: BSD-3-Clause
#include "core/element/kernel.hpp"

namespace ents::ENTS_ISA {
const KernelSet tri3_kernels = kernels_of<Tri3>;
const KernelSet tri6_kernels = kernels_of<Tri6>;
} // namespace ents::ENTS_ISA
