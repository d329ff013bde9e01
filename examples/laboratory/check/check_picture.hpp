// SPDX-License-Identifier: BSD-3-Clause
// The picture of `ents-lab check`.
#pragma once

#include <filesystem>
#include <vector>

#include "check_mesh.hpp"
#include "output/pictures.hpp"

namespace host {

/// The enriched surface, the segments in `violations` (one entry each; not 0: it fails) in the colour of
/// offences, and the worst places. More segments than a picture can show: those around the first place, and
/// the caption says so.
/// @return empty, or a line that says why there is none
std::string draw_check(const EntsModel& model, const MasterSurface& surface,
                       const std::vector<std::int64_t>& violations,
                       const std::vector<pictures::Place>& places, bool triangles,
                       const std::filesystem::path& folder);

} // namespace host
