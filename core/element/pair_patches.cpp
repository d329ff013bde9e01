// SPDX-License-Identifier: BSD-3-Clause
// Instantiates the kernels of ordinary elements of segments of nine nodes and more. Compiled once per
// instruction set.
#include "core/element/pair_table.hpp"

namespace ents::ENTS_ISA {

const PairKernelsOfBasis& pair_kernels_of_patches(Basis basis) {
  switch (basis) {
  case Basis::quad9:
    return pair_kernels_of<Quad9>;
  case Basis::catmull_rom16:
    return pair_kernels_of<CatmullRom16>;
  case Basis::bspline16:
    return pair_kernels_of<BSpline16>;
  default:
    return pair_kernels_of<Bezier15>;
  }
}

} // namespace ents::ENTS_ISA
