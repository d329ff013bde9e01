// SPDX-License-Identifier: BSD-3-Clause
// How high the surface is, and whether the measured maps lie where it is: a forgotten unit shows here.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "check_mesh.hpp"
#include "scene.hpp"
#include "toolbox/json_reader.hpp"

namespace host {

/// Interval on each surface coordinate.
struct Extent {
  std::vector<double> low, high; ///< [d-1]
};

struct MapExtent {
  std::string where; ///< "/height", "/height/of/1"
  bool clamped = false;
  Extent covers;
  bool too_small = false; ///< clamped, and less than the segments' surface coordinates
};

struct SurfaceExtent {
  double low = 0, high = 0; ///< height, sampled
  Extent coordinates;       ///< of the segments
  std::vector<MapExtent> maps;
};

/// @param model  its text; file names start at `folder`
SurfaceExtent extent_of(const EntsModel& model, const Json& text, const std::filesystem::path& folder,
                        const MasterSurface& surface);

/// Lines for the terminal; a map that is too small is a line that begins with "warning: ".
std::string describe(const SurfaceExtent& extent);

/// Tell on stderr which maps of a scene are too small, as `describe` does of a model; heights are not
/// sampled.
/// @param of_segments  [segments][m][d-1] surface coordinates of a master that deforms; empty: the model's
///                     own, else s = xi
void note_small_maps(const Scene& scene, const std::vector<double>& of_segments);

Json extent_json(const SurfaceExtent& extent);

} // namespace host
