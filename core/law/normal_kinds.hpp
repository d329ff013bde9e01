// SPDX-License-Identifier: BSD-3-Clause
// The normal laws by name. A new one is a file beside this one (normal_law.hpp says what it has), its include
// in laws.hpp and its line at the end of this list; the model's schema is made anew by abi/bindings/schema.py.
#pragma once

#include <cstdint>

// X(NormalKind, type)
#define ENTS_NORMAL_LAWS(X)                                                                                  \
  X(penalty, Penalty)                                                                                        \
  X(power, Power)                                                                                            \
  X(exponential, Exponential)                                                                                \
  X(augmented, Augmented)                                                                                    \
  X(augmented_multiplier, AugmentedMultiplier)                                                               \
  X(multiplier, PureMultiplier)                                                                              \
  X(table, Tabular)                                                                                          \
  X(tied, Tied)                                                                                              \
  X(cohesive, Cohesive)                                                                                      \
  X(dugdale, Dugdale)                                                                                        \
  X(separation, Separation)                                                                                  \
  X(lennard_jones, LennardJones)

namespace ents {

#define ENTS_LAW(name, type) name,
enum class NormalKind : std::int32_t { none, ENTS_NORMAL_LAWS(ENTS_LAW) };
#undef ENTS_LAW

enum class Multiplier : std::int32_t { none, in_state, is_dof };

} // namespace ents
