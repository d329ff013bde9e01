// SPDX-License-Identifier: BSD-3-Clause
// Instantiates the kernels of ordinary elements of triangles. Compiled once per instruction set.
#include "core/element/pair_table.hpp"

namespace ents::ENTS_ISA {

const PairKernelsOfBasis& pair_kernels_of_triangles(Basis basis) {
  switch (basis) {
  case Basis::tri3:
    return pair_kernels_of<Tri3>;
  default:
    return pair_kernels_of<Tri6>;
  }
}

} // namespace ents::ENTS_ISA
