// SPDX-License-Identifier: BSD-3-Clause
// What was made of a contact pair, to look at: slave nodes and the enriched master.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "convert.hpp"

namespace ents_deck {

struct Pictures {
  std::vector<std::filesystem::path> files;
  std::string problem; ///< one line; a picture never fails a conversion
};

/// NAME_slave.vtu (nodes with area, number of segments, element), NAME_master.vtu (the enriched surface with
/// its height) and, through gnuplot if it is installed, NAME.png.
Pictures draw(const Job& job, const Contact& contact, const std::filesystem::path& out,
              const std::string& name);

} // namespace ents_deck
