// SPDX-License-Identifier: BSD-3-Clause
// The compiled kernels of each basis. kernel_*.cpp instantiate them, basis by basis: together they take long
// to compile.
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
#define ENTS_BASIS(name, ...) extern const KernelSet name##_kernels;
ENTS_BASES(ENTS_BASIS)
#undef ENTS_BASIS
} // namespace portable

} // namespace ents
