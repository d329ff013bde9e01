// SPDX-License-Identifier: BSD-3-Clause
#include "core/element/kernel.hpp"

namespace ents::ENTS_ISA {
const KernelSet line2_kernels = kernels_of<Line2>;
const KernelSet line3_kernels = kernels_of<Line3>;
const KernelSet catmull_rom4_kernels = kernels_of<CatmullRom4>;
const KernelSet bspline4_kernels = kernels_of<BSpline4>;
} // namespace ents::ENTS_ISA
