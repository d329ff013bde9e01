// SPDX-License-Identifier: BSD-3-Clause
// Ordinary elements of segments. Compiled once per instruction set.
#include "core/element/pair_table.hpp"
#include "core/numbers/past_caches.hpp"

namespace ents::ENTS_ISA {

void expression_jets(const ExternalHeight&, std::int32_t, std::int32_t, const double*,
                     double*); // expression.hpp

#define ENTS_TEXT_OF(name) #name
#define ENTS_TEXT(name) ENTS_TEXT_OF(name)

extern const PairKernels pair_kernels = {ENTS_TEXT(ENTS_ISA),
                                         [](Basis basis) -> const PairKernelsOfBasis& {
                                           switch (basis) {
                                           case Basis::line2:
                                             return pair_kernels_of<Line2>;
                                           case Basis::line3:
                                             return pair_kernels_of<Line3>;
                                           case Basis::catmull_rom4:
                                             return pair_kernels_of<CatmullRom4>;
                                           case Basis::bspline4:
                                             return pair_kernels_of<BSpline4>;
                                           case Basis::tri3:
                                             return pair_kernels_of<Tri3>;
                                           case Basis::tri6:
                                             return pair_kernels_of<Tri6>;
                                           case Basis::quad4:
                                             return pair_kernels_of<Quad4>;
                                           case Basis::quad8:
                                             return pair_kernels_of<Quad8>;
                                           case Basis::quad9:
                                             return pair_kernels_of<Quad9>;
                                           default:
                                             return pair_kernels_of_patch(basis);
                                           }
                                         },
                                         copy_past_caches, expression_jets};

} // namespace ents::ENTS_ISA
