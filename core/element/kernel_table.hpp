// SPDX-License-Identifier: BSD-3-Clause
// The compiled kernels of each basis: [enriched]. Instantiated basis by basis in
// kernel_*.cpp, because together they are the bulk of the library's compile time.
#pragma once

#include "core/model/plan.hpp"

namespace ents {

struct KernelSet {
  ElementKernel element[2];
  FinishKernel finish[2];
  RestKernel rest[2];
  SurfaceKernel surface[2];
  TransferKernel transfer[2];
  ProjectKernel project[2];
  BorderKernel border_point[2];
  BoxKernel box[2];
  double (*hull_spread)(double border);
};

namespace portable {
#define ENTS_KERNELS(name) const KernelSet& name##_kernels();
ENTS_KERNELS(line2)
ENTS_KERNELS(line3)
ENTS_KERNELS(catmull_rom4)
ENTS_KERNELS(bspline4)
ENTS_KERNELS(tri3)
ENTS_KERNELS(tri6)
ENTS_KERNELS(quad4)
ENTS_KERNELS(quad8)
ENTS_KERNELS(quad9)
ENTS_KERNELS(catmull_rom16)
ENTS_KERNELS(bspline16)
ENTS_KERNELS(bezier15)
#undef ENTS_KERNELS
} // namespace portable

} // namespace ents
