// SPDX-License-Identifier: BSD-3-Clause
// The table of the compiled kernels of an instruction set.
#include "core/element/pair_kernels.hpp"
#include "core/numbers/past_caches.hpp"

namespace ents::ENTS_ISA {

const PairKernelsOfBasis& pair_kernels_of_lines(Basis basis); // pair_lines.cpp and so on
const PairKernelsOfBasis& pair_kernels_of_triangles(Basis basis);
const PairKernelsOfBasis& pair_kernels_of_quads(Basis basis);
const PairKernelsOfBasis& pair_kernels_of_patches(Basis basis);
void expression_jets(const ExternalHeight&, std::int32_t, std::int32_t, const double*,
                     double*); // expression.hpp

#define ENTS_TEXT_OF(name) #name
#define ENTS_TEXT(name) ENTS_TEXT_OF(name)

extern const PairKernels pair_kernels = {ENTS_TEXT(ENTS_ISA),
                                         [](Basis basis) -> const PairKernelsOfBasis& {
                                           switch (basis) {
                                           case Basis::line2:
                                           case Basis::line3:
                                           case Basis::catmull_rom4:
                                           case Basis::bspline4:
                                             return pair_kernels_of_lines(basis);
                                           case Basis::tri3:
                                           case Basis::tri6:
                                             return pair_kernels_of_triangles(basis);
                                           case Basis::quad4:
                                           case Basis::quad8:
                                             return pair_kernels_of_quads(basis);
                                           default:
                                             return pair_kernels_of_patches(basis);
                                           }
                                         },
                                         copy_past_caches, expression_jets};

} // namespace ents::ENTS_ISA
