// SPDX-License-Identifier: BSD-3-Clause
// The bases of segments, listed once.
#pragma once

#include <cstdint>

namespace ents {

// Their name, their type in surface/basis.hpp, and the rest of a BasisEntry.
#define ENTS_BASES(X)                                                                                        \
  X(line2, Line2, 2, 1, false, false)                                                                        \
  X(line3, Line3, 3, 1, false, false)                                                                        \
  X(catmull_rom4, CatmullRom4, 4, 1, false, true)                                                            \
  X(bspline4, BSpline4, 4, 1, false, true)                                                                   \
  X(tri3, Tri3, 3, 2, true, false)                                                                           \
  X(tri6, Tri6, 6, 2, true, false)                                                                           \
  X(quad4, Quad4, 4, 2, false, false)                                                                        \
  X(quad8, Quad8, 8, 2, false, false)                                                                        \
  X(quad9, Quad9, 9, 2, false, false)                                                                        \
  X(catmull_rom16, CatmullRom16, 16, 2, false, true)                                                         \
  X(bspline16, BSpline16, 16, 2, false, true)                                                                \
  X(bezier15, Bezier15, 15, 2, true, true)

#define ENTS_BASIS(name, ...) name,
enum class Basis : std::int32_t { ENTS_BASES(ENTS_BASIS) };
#undef ENTS_BASIS

struct BasisEntry {
  Basis basis;
  const char* name;
  std::int32_t nodes;      // m
  std::int32_t parameters; // convective coordinates = surface coordinates; dimension of space - 1
  bool simplex;            // xi >= 0, sum xi <= 1; else -1 .. 1 per direction
  bool smoothed;           // over several segments: its nodes are not the corners of the segment
};

#define ENTS_BASIS(name, type, ...) {Basis::name, #name, __VA_ARGS__},
inline constexpr BasisEntry basis_table[] = {ENTS_BASES(ENTS_BASIS)};
#undef ENTS_BASIS

constexpr const BasisEntry& basis_entry(Basis basis) { return basis_table[static_cast<std::int32_t>(basis)]; }

} // namespace ents
