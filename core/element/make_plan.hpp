// SPDX-License-Identifier: BSD-3-Clause
// The kernels of a model, chosen once.
#pragma once

#include "core/element/block_kernels.hpp"

namespace ents {

// The plan of a model; the model must outlive it. `base` is null.
Plan make_plan(const ModelSpec& model);
// The same, whatever the model's height, without one.
Plan make_base_plan(const ModelSpec& model);

// Sets those for blocks of elements of a model; null: evaluate_element() takes them one by one.
void set_block_kernels(const ModelSpec& model, const BlockKernels& kernels, Plan& plan);

// Those of the best instruction set of this processor.
const BlockKernels& best_block_kernels();

} // namespace ents
