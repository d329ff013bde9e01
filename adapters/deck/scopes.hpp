// SPDX-License-Identifier: BSD-3-Clause
// *PART, *INSTANCE and *ASSEMBLY: which statements belong to the mesh, and to which instance.
#pragma once

#include <vector>

#include "mesh.hpp"

namespace ents_deck {

struct Scoped {
  const Statement* statement = nullptr;
  int instance = no_instance;
  bool of_part = false; ///< from a part: its coordinates are placed by the instance
};

struct Scopes {
  std::vector<Instance> instances;
  std::vector<Scoped> list; ///< statements of a part once per instance
};

/// @throws Error for a nesting that is none, an unknown part, or a keyword that changes the mesh and is not
///         read
Scopes scopes_of(const Source& source);

/// A point of a part where its instance puts it: translated first, then turned.
Point placed(const Instance& instance, const Point& x);

} // namespace ents_deck
