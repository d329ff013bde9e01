// SPDX-License-Identifier: BSD-3-Clause
// The compiled kernels of blocks of elements: fast_block.hpp (penalty and power law), general_block.hpp (any
// law). They exist once per instruction set; the bits of their results are the same.
#pragma once

#include "core/model/plan.hpp"

namespace ents {

// Beside the results in ElementBlock::wanted: residual and tangent of elements in contact are all that is looked
// at, and ENTS_FLAG_CONTACT. Of others nothing is written but their flags, and an element that is clearly
// open is not projected.
inline constexpr std::int32_t forces_only = 1 << 30;
static_assert((want::all & forces_only) == 0);

struct BlockKernelsOfBasis {
  BlockKernel of[2][2];    // [enriched][friction], of penalty and power law with the consistent tangent
  BlockKernel general[2];  // [enriched], of any law and tangent
  HeatBlockKernel heat[2]; // [enriched]
};
struct BlockKernels {
  const char* instruction_set;
  const BlockKernelsOfBasis* of_basis;                                     // [basis]; null: one by one
  void (*stream_copy)(const double* from, std::int64_t count, double* to); // streaming.hpp
};
namespace portable {
extern const BlockKernels block_kernels;
}
#ifdef ENTS_HAS_AVX2
namespace avx2 {
extern const BlockKernels block_kernels;
}
#endif
#ifdef ENTS_HAS_AVX512
namespace avx512 {
extern const BlockKernels block_kernels;
}
#endif

} // namespace ents
