// SPDX-License-Identifier: BSD-3-Clause
// A scene: bodies, how they are held and loaded, one contact, and the steps. README.md lists the keys.
#pragma once

#include <ents.h>

#include "keys.hpp"

namespace host {

/// The scene is right, and is solved by the laboratory's program.
struct NeedsLaboratory : InputError {
  using InputError::InputError;
};

/// Slave faces, and either a rigid segment that moves along a line, or master faces.
struct ContactInput {
  std::string slave, slave_where, master, master_where;
  int sampling = 0;                 ///< points per direction inside the slave faces; 0: their nodes
  std::vector<double> rigid;        ///< [m][d] nodes of the segment; empty: master faces
  std::vector<double> direction;    ///< [d] unit vector of the rigid master's motion
  std::vector<int> coordinate_axes; ///< master faces: reference coordinates that are surface coordinates
  std::int32_t ends = ENTS_ENDS_REPEATED; ///< what a smoothed master does at its borders
  double temperature = 0;                 ///< of a rigid master
  Json model;                             ///< for the library
  std::string model_where;
};

struct Scene {
  std::filesystem::path file;
  std::string title, unit_of_length, unit_of_force, unit_of_pressure;
  int dimension = 2;
  std::vector<Part> parts;
  std::vector<Support> supports;
  std::vector<Traction> tractions;
  std::optional<ContactInput> contact;
  bool heat = false;       ///< the materials conduct, and every node has a temperature
  double temperature = 0;  ///< of everything before the first step, without stress
  int symmetry_copies = 1; ///< the mesh is one of so many mirror images
  Control control = Control::load_factor;
  std::vector<double> steps, durations; ///< values, and the time that each takes
  double tolerance = 1e-10;             ///< of the residual, relative to the forces present
  int max_iterations = 25;
  double min_step = 1e-3; ///< smallest part of a step before the run gives up

  bool by_force() const { return control == Control::force || control == Control::mean_pressure; }
};

/// Does ents_smooth make segments of this name?
bool is_smoothed(const std::string& segment);

/// @param variant  one of the scene's own, a patch of its text; empty: the scene as it is
/// @throws InputError naming the file and the key; NeedsLaboratory
Scene read_scene(const std::filesystem::path& file, const std::string& variant);

} // namespace host
