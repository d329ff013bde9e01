// SPDX-License-Identifier: BSD-3-Clause
#include "core/element/kernel.hpp"

namespace ents::ENTS_ISA {
const KernelSet quad4_kernels = kernels_of<Quad4>;
const KernelSet quad8_kernels = kernels_of<Quad8>;
const KernelSet quad9_kernels = kernels_of<Quad9>;
} // namespace ents::ENTS_ISA
