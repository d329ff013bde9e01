// SPDX-License-Identifier: BSD-3-Clause
// Smoothed segments over the faces of a body: control points, and what lies beyond its borders.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "control_net.hpp"
#include "mesh.hpp"
#include "scene.hpp"

namespace host {

/// Is it a basis over several faces: catmull_rom4, bspline4 on lines, catmull_rom16, bspline16 on
/// quadrilaterals, bezier15 on triangles?
inline bool is_smoothed(const std::string& segment) {
  return segment.starts_with("catmull_rom") || segment.starts_with("bspline") || segment == "bezier15";
}

struct SmoothedSurface {
  std::vector<std::int64_t> connectivity; ///< [faces][m] nodes of the mesh; with a net its points
  std::unique_ptr<ControlNet> net;        ///< null: control points are nodes of the mesh
};

/// One segment on each face, by the library. Beyond a free end or border there is what `contact.ends` says;
/// at a plane of symmetry the surface goes on as its mirror image does.
/// @throws InputError for faces that do not fit, or planes that are none of their borders
SmoothedSurface smoothed_surface(const EntsLibrary& library, const std::string& segment, const Mesh& mesh,
                                 const std::vector<Face>& faces, const ContactSpec& contact);

} // namespace host
