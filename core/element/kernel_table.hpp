// SPDX-License-Identifier: BSD-3-Clause
// The compiled kernels of each basis. kernel_*.cpp instantiate them: together they take long to compile.
#pragma once

#include "core/model/plan.hpp"

namespace ents {

struct KernelSet {
  ElementKernel element[2];
  FinishKernel finish[2];
  HeatKernel heat[2];
  RestKernel rest[2];
  SurfaceKernel surface[2];
  TransferKernel transfer[2];
  ProjectKernel project[2];
  BorderKernel border_point[2];
  BoxKernel box[2];
  double (*hull_spread)(Basis which, double border);
};

namespace portable {
template <class B> const KernelSet& kernels_of(); // B: KernelBasis
}

} // namespace ents
