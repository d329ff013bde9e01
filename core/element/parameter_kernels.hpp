// SPDX-License-Identifier: BSD-3-Clause
// Kernels of each basis that only models with named parameters or fields need.
#pragma once

#include "core/model/plan.hpp"

namespace ents {

struct ParameterKernels {
  ParameterKernel rates;
  CoordinatesKernel coordinates;
};
const ParameterKernels& parameter_kernels(Basis basis);

} // namespace ents
