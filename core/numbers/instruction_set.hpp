// SPDX-License-Identifier: BSD-3-Clause
// The instruction sets that code is compiled for, and the best one that this processor has.
#pragma once

namespace ents {

enum class InstructionSet { portable, avx2, avx512 };

// Of those that are in the library.
InstructionSet best_instruction_set();

} // namespace ents
