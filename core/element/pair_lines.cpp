// SPDX-License-Identifier: BSD-3-Clause
// Instantiates the kernels of ordinary elements of lines. Compiled once per instruction set.
#include "core/element/pair_table.hpp"

namespace ents::ENTS_ISA {

const PairKernelsOfBasis& pair_kernels_of_lines(Basis basis) {
  switch (basis) {
  case Basis::line2:
    return pair_kernels_of<Line2>;
  case Basis::line3:
    return pair_kernels_of<Line3>;
  case Basis::catmull_rom4:
    return pair_kernels_of<CatmullRom4>;
  default:
    return pair_kernels_of<BSpline4>;
  }
}

} // namespace ents::ENTS_ISA
