// SPDX-License-Identifier: BSD-3-Clause
// The compiled kernels of ordinary elements (pair.hpp). They exist once per instruction set; the bits of their results are the same.
#pragma once

#include "core/plan.hpp"

namespace ents {

struct PairKernelsOfBasis {
  PairKernel of[2][2]; // [enriched][friction]
};
struct PairKernels {
  const char* instruction_set;
  const PairKernelsOfBasis& (*of_basis)(Basis);
};
namespace portable {
extern const PairKernels pair_kernels;
}
#ifdef ENTS_X86_KERNELS
namespace avx2 {
extern const PairKernels pair_kernels;
}
namespace avx512 {
extern const PairKernels pair_kernels;
}
#endif

// Those of the best instruction set of this processor.
const PairKernels& best_pair_kernels();

} // namespace ents
