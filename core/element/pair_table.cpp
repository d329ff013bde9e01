// SPDX-License-Identifier: BSD-3-Clause
// The table of the compiled kernels of an instruction set.
#include "core/element/pair_kernels.hpp"
#include "core/numbers/streaming.hpp"
#include "core/surface/counted_basis.hpp"

namespace ents::ENTS_ISA {

template <class B, bool H, bool F> // pair_*.cpp
std::uint64_t evaluate_pairs(const Plan&, const PairBlock&, std::int32_t count);
template <class B, bool H> // general_*.cpp
std::uint64_t evaluate_general(const Plan&, const PairBlock&, std::int32_t count);

#if defined(ENTS_NO_BLOCKS) // evaluate_element() takes all elements
static constexpr const PairKernelsOfBasis* of_basis = nullptr;
static constexpr const char* instruction_set = "none";
#else
template <class B>
static constexpr PairKernelsOfBasis kernels_of = {
    {{evaluate_pairs<B, false, false>, evaluate_pairs<B, false, true>},
     {evaluate_pairs<B, true, false>, evaluate_pairs<B, true, true>}},
    {evaluate_general<B, false>, evaluate_general<B, true>}};
#define ENTS_BASIS(name, type, ...) kernels_of<KernelBasis<type>>,
static constexpr PairKernelsOfBasis of_basis[] = {ENTS_BASES(ENTS_BASIS)};
#undef ENTS_BASIS
#define ENTS_TEXT_OF(name) #name
#define ENTS_TEXT(name) ENTS_TEXT_OF(name)
static constexpr const char* instruction_set = ENTS_TEXT(ENTS_ISA);
#endif

extern const PairKernels pair_kernels = {instruction_set, of_basis, stream_copy};

} // namespace ents::ENTS_ISA
