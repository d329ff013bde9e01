// SPDX-License-Identifier: BSD-3-Clause
// The four wrong choices of h in Fig. 4 of the paper, and what says so: ents_surface_check, a status, a flag.
#pragma once

#include <string>
#include <vector>

#include "ents_library.hpp"

namespace host::chart {

struct WrongHeight {
  std::string panel;   ///< "a" .. "d"
  std::string what;    ///< as the paper has it
  std::string example; ///< segments and height
  std::string check;   ///< conditions of ents_surface_check that are violated, with their values
  std::string running; ///< what the evaluation or the detection says of a slave node there
  bool flagged = false;
};

std::vector<WrongHeight> wrong_heights(const EntsLibrary& library);

} // namespace host::chart
