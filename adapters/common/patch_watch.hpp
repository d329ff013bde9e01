// SPDX-License-Identifier: BSD-3-Clause
// Slave points that are beside their patches: an element has a fixed number of master nodes, and where a body moves
// farther than its patches reach, contact is not seen. With ents_patches.json (patch_file.hpp), which has the whole
// surfaces, the end of every increment is compared with them. Nodes that no evaluated element has are taken to move
// as the nearest one that some element has. Without the file the adapter counts open points below the surface as it
// goes on beyond a patch, and cannot know whether the master goes on there.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "element.hpp"

namespace ents_adapter {

/// What the end of an increment has shown of one pair.
struct Beside {
  std::string slave, master;
  int points = 0;     ///< of the slave
  int open = 0;       ///< of them beside their patches, not pressed into the master
  int lost = 0;       ///< of them beside their patches and pressed into the master, without a force
  bool grows = false; ///< more are open than in any increment before
  double beyond = 0;  ///< [L] from the patch to the farthest of them
  double slide = 0;   ///< [L] that would do
  double deepest = 0; ///< [L] of those that are lost

  /// @param advice  behind "run ents-deck with --slide N"
  std::string open_text(const std::string& advice) const;
  std::string lost_text(const std::string& advice) const;
};

/// What evaluate() knows of an element. Any thread.
/// @param has_patch  its model has one: without ents_patches.json others are not watched
/// @param beside  open, beside its patch and below the surface as it goes on there
/// @param depth   [L] below it
/// @return what is wrong with ents_patches.json; "" if nothing
std::string note(const Element& element, bool has_patch, int slave_nodes, bool contact, bool beside,
                 double depth);

/// Compares the whole surfaces with where the host's nodes are. Any thread.
/// @param place  displacement [3] of the node with this number: hosts that know all nodes; null: of the elements
///               evaluated last
std::vector<Beside> compare_patches(const Host& host,
                                    const std::function<const double*(std::int64_t)>& displacement = nullptr);

/// The same of one element's point, at an iterate. @return false: above its patch, or not watched
bool is_beside(const Host& host, std::int64_t element,
               const std::function<const double*(std::int64_t)>& displacement, Beside& out);

/// What the host's user should read at the end of an increment.
struct IncrementEnd {
  std::vector<std::string> warnings;
  std::string lost; ///< not empty: the job should end with this message
};

IncrementEnd increment_end(const Host& host);

/// For hosts that tell each element that the increment has converged: the comparison is made when the last of all
/// elements has been told; before that, nothing.
IncrementEnd element_converged(const Host& host, std::int64_t element);

} // namespace ents_adapter
