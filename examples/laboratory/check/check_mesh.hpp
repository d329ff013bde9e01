// SPDX-License-Identifier: BSD-3-Clause
// The surface that `ents-lab check` looks at: where its segments are.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "ents_library.hpp"

namespace host {

struct MasterSurface {
  std::size_t d = 2, m = 2;
  std::vector<double> nodes;               ///< [nodes][d]
  std::vector<std::int64_t> connectivity;  ///< [segments][m]
  std::vector<double> surface_coordinates; ///< [segments][m][d-1], or empty: the model's own, else s = xi

  std::size_t segments() const { return connectivity.size() / m; }
  ents_master_mesh mesh() const;
  std::vector<double> master(std::size_t segment) const;      ///< [m][d]
  std::vector<double> coordinates(std::size_t segment) const; ///< [m][d-1] or empty
};

/// @param file     .json: {"nodes": [[x, y], ...], "segments": [[0, 1], ...]} and, if wanted,
///                 "surface_coordinates": one entry per node; else an Abaqus/CalculiX deck whose elements are
///                 the segments; empty: one segment whose nodes lie at their natural coordinates
/// @param segment  of the model
/// @throws InputError naming file and key or line
MasterSurface read_surface(const std::filesystem::path& file, const std::string& segment,
                           const ents_layout& layout);

} // namespace host
