// SPDX-License-Identifier: BSD-3-Clause
// Scenes of the reference host through its adapters, and how far two solutions are apart.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace adapters {

/// The scenes of examples/ that end (chatter: its variant that does) but texture, and one in 3D with
/// friction.
std::vector<std::string> scene_names();

enum class Mesh { coarse, shipped }; ///< coarse: half the divisions or less, fewer steps where there are many

/// The scene as a file of its own in `folder`.
/// @param name  of the list above, or cattaneo_soft: softer than the bodies, for symmetrised tangents
/// @param symmetrised  (K + K^T)/2 for the tangent of the contact, as hosts with symmetric matrices need it
/// @throws std::invalid_argument for another name
std::string write_scene(const std::string& name, Mesh mesh, const std::filesystem::path& folder,
                        bool symmetrised = false);

/// Names for --adapter but plain and direct.
std::vector<std::string> scene_adapters();

struct SceneResult {
  std::string refusal;     ///< what ents-lab says if it cannot or will not; else ""
  nlohmann::json steps;    ///< with the fields of the slave nodes, without times
  std::string fingerprint; ///< of displacements, histories and multipliers at the end
  double seconds = 0;
};

/// @param options  more words for ents-lab run
SceneResult run_scene(const std::string& file, const std::string& adapter, const std::string& options = "");

struct Comparison {
  bool iterations = false; ///< and cuts: the same in every step
  bool bits = false; ///< all numbers of all steps, those of every iteration included, and the fingerprint
  double motion = 0; ///< of slave nodes and rigid master, relative to the largest coordinate; worst step
  double force = 0;  ///< of pressures and tangential tractions, relative to the largest pressure
};
Comparison compare(const SceneResult& a, const SceneResult& b);

} // namespace adapters
