// SPDX-License-Identifier: BSD-3-Clause
// ents-deck run: a deck becomes a job, ccx solves it, and where slave points have left their patches these are made
// larger and the job is solved again.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "convert.hpp"

namespace ents_deck {

struct RunRequest {
  Options options;
  std::filesystem::path out;
  std::string ccx; ///< program; "": ccx_ents beside this program's build folder, or of the search path
};

/// @param write  converts and writes the job with these options, and says what it made where `first`
/// @return exit code: 0 solved, 1 not
int run_job(RunRequest request, const std::function<void(const Options& options, bool first)>& write);

/// Slides that the job of a folder asks for, by pair ("SLAVE, MASTER"): the largest of ents_slide.txt.
struct WantedSlides {
  std::map<std::string, double> open, pressed; ///< of points that were open; of those whose contact was lost
};
WantedSlides wanted_slides(const std::filesystem::path& folder);

/// A word between quotes, as the shell takes it.
std::string quoted(const std::string& word);

} // namespace ents_deck
