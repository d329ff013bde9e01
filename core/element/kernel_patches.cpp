// SPDX-License-Identifier: BSD-3-Clause
#include "core/element/kernel.hpp"

namespace ents::ENTS_ISA {
const KernelSet catmull_rom16_kernels = kernels_of<CatmullRom16>;
const KernelSet bspline16_kernels = kernels_of<BSpline16>;
} // namespace ents::ENTS_ISA
