// SPDX-License-Identifier: BSD-3-Clause
// Slaves that pass through the surface within an increment: in front of it at the begin and at the end, and
// behind it in between (theory.md, section 9.5). A search at the end alone does not see them.
#pragma once

#include "core/search/detection.hpp"

namespace ents {

// An increment: slaves and nodes of the mesh at its begin and at its end, which is the mesh's own `positions`.
struct Increment {
  const double* slave_begin;     // [count][d]
  const double* slave;           // [count][d]
  const double* positions_begin; // [nodes][d]; null: the mesh does not move
  LeftOutOfSlaves left_out;
  const double* depth; // [count] as of Detection, or null
};

struct Crossing {
  std::int64_t slave = -1; // the first one that passes through the surface, or may; -1: none
  double part = 1.0;       // of the increment, after which it is behind the surface, or in sight of it
  double moved = 0.0;      // relative to the master, at most [L]
  double within = 0.0;     // behind the surface it is seen up to this distance: `reach`, or its depth [L]
  bool seen = false;       // false: the way is longer than what is looked at
};

// Of slaves first .. first + count - 1 those that are in front of the surface at the end. A slave
// that moves by no more than r / 2 relative to the master, with r the smaller of `reach` and its depth, passes
// through thinner parts of the body alone; the others are looked for at places r / 2 apart on their straight
// way, in the mesh as it is there.
// Allocates (std::bad_alloc) if there are such slaves. ok, or what detect() and refit_tree() say.
Status find_crossing(const Plan& plan, const MasterMesh& mesh, const double* tree, const Increment& way,
                     std::int64_t first, std::int64_t count, double reach, Crossing& out);

} // namespace ents
