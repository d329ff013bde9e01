// SPDX-License-Identifier: BSD-3-Clause
// Instantiates the kernels of ordinary elements of one basis.
#pragma once

#include "core/element/general_block.hpp"
#include "core/element/pair_kernels.hpp"

namespace ents::ENTS_ISA {

template <class B>
inline constexpr PairKernelsOfBasis pair_kernels_of = {
    {{evaluate_pairs<B, false, false>, evaluate_pairs<B, false, true>},
     {evaluate_pairs<B, true, false>, evaluate_pairs<B, true, true>}},
    {evaluate_general<B, false>, evaluate_general<B, true>}};

} // namespace ents::ENTS_ISA
