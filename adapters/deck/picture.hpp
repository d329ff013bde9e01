// SPDX-License-Identifier: BSD-3-Clause
// What was made of the contact pairs, to look at: slave points and the enriched masters.
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

/// Of pair k: pair_k_slave.vtu (slave points with area, number of segments, element), pair_k_master.vtu (the
/// enriched surface with its height), and pair_k.png, which pictures.py, left beside them, draws of both with
/// matplotlib. To change a picture, edit pictures.py in the folder and run it.
Pictures draw(const Job& job, const std::filesystem::path& out);

/// Text of pictures.py.
extern const char* const pictures_script;

} // namespace ents_deck
