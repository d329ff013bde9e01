// SPDX-License-Identifier: BSD-3-Clause
// Instantiates the kernels of ordinary elements of bilinear and serendipity quadrilaterals. Compiled once per
// instruction set.
#include "core/element/pair_table.hpp"

namespace ents::ENTS_ISA {

const PairKernelsOfBasis& pair_kernels_of_quads(Basis basis) {
  switch (basis) {
  case Basis::quad4:
    return pair_kernels_of<Quad4>;
  default:
    return pair_kernels_of<Quad8>;
  }
}

} // namespace ents::ENTS_ISA
