// SPDX-License-Identifier: BSD-3-Clause
// The table of the compiled kernels of an instruction set.
#include "core/element/block_kernels.hpp"
#include "core/numbers/streaming.hpp"
#include "core/surface/counted_basis.hpp"

namespace ents::ENTS_ISA {

template <class B, bool H, bool F> // fast_*.cpp
std::uint64_t evaluate_fast(const Plan&, const ElementBlock&, std::int32_t count);
template <class B, bool H> // general_*.cpp
std::uint64_t evaluate_general(const Plan&, const ElementBlock&, std::int32_t count);
template <class B, bool H> // heat_*.cpp
std::uint64_t evaluate_heat(const Plan&, const ElementBlock&, std::int32_t count, HeatIngredients*);

#if defined(ENTS_NO_BLOCKS) // evaluate_element() takes all elements
static constexpr const BlockKernelsOfBasis* of_basis = nullptr;
static constexpr const char* instruction_set = "none";
#else
template <class B>
static constexpr BlockKernelsOfBasis kernels_of = {
    {{evaluate_fast<B, false, false>, evaluate_fast<B, false, true>},
     {evaluate_fast<B, true, false>, evaluate_fast<B, true, true>}},
    {evaluate_general<B, false>, evaluate_general<B, true>},
    {evaluate_heat<B, false>, evaluate_heat<B, true>}};
#define ENTS_BASIS(name, type, ...) kernels_of<KernelBasis<type>>,
static constexpr BlockKernelsOfBasis of_basis[] = {ENTS_BASES(ENTS_BASIS)};
#undef ENTS_BASIS
#define ENTS_TEXT_OF(name) #name
#define ENTS_TEXT(name) ENTS_TEXT_OF(name)
static constexpr const char* instruction_set = ENTS_TEXT(ENTS_ISA);
#endif

extern const BlockKernels block_kernels = {instruction_set, of_basis, stream_copy};

} // namespace ents::ENTS_ISA
