// SPDX-License-Identifier: BSD-3-Clause
#include "core/numbers/instruction_set.hpp"

namespace ents {

InstructionSet best_instruction_set() {
#if defined(ENTS_HAS_AVX2) || defined(ENTS_HAS_AVX512)
  __builtin_cpu_init();
#endif
#ifdef ENTS_HAS_AVX512
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
    return InstructionSet::avx512;
#endif
#ifdef ENTS_HAS_AVX2
  if (__builtin_cpu_supports("avx2")) return InstructionSet::avx2;
#endif
  return InstructionSet::portable;
}

} // namespace ents
