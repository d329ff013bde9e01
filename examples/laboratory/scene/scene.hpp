// SPDX-License-Identifier: BSD-3-Clause
// A scene file, read and checked. examples/laboratory/README.md describes every key.
#pragma once

#include <algorithm>
#include <functional>

#include "crown.hpp"
#include "keys.hpp"
#include "rigid_body.hpp"
#include "surface_coordinates.hpp"

namespace host {

/// What the reference host leaves to the laboratory of a body.
struct PartSpec : Part {
  std::string where;  ///< file and path, for messages
  Crown crown;        ///< block
  bool layer = false; ///< block: its surface alone has nodes, layer_body.hpp
};

/// Prescribed displacement components of a node set (of the point `about` if it turns), or its motion as a rigid
/// body; they follow the load factor along their path.
struct SupportSpec : Support {
  std::vector<double> turn; ///< radians: in the plane one angle, in space a rotation vector; empty: none
  std::array<double, 3> about{};

  bool moves() const {
    const auto nonzero = [](const std::optional<double>& component) { return component.value_or(0) != 0; };
    return !turn.empty() || std::any_of(displacement.begin(), displacement.end(), nonzero);
  }
};

/// Outer boundary of a block that stands for a half-space: its nodes follow the half-space's displacement
/// under a point load of the scene's total force.
struct HalfSpaceSpec {
  std::vector<std::string> nodes;
  std::string where;
  std::vector<double> point; ///< where the force acts
  Material material;
};

/// Elastic foundation: every component pulls back on its own.
struct SpringSpec {
  std::string faces, where;
  std::vector<double> stiffness; ///< [dimension], force / length / reference area, >= 0
};

/// Opposite sides with the same displacement, or sides of two bodies that are glued.
struct PeriodicSpec {
  std::string first, second, where;
};

/// A plane of symmetry, normal to an axis, that is a border of the master's faces.
struct MirrorPlane {
  int axis = 0;
  double place = 0;
  std::string where;
};

/// Waves of the height that the mesh need not resolve: removed_waves.hpp.
struct CutOff {
  double wavelength = 0; ///< shorter ones become a law; 0: none
  int points = 256;      ///< cells of the boundary elements along the longer side
  /// Each place has a law of its own (place_laws.hpp); else one law, scaled with the local height of the waves
  bool own = false;
  std::string where;
};

struct ContactSpec {
  std::string slave, slave_where; ///< faces whose nodes are the slave nodes
  int sampling = 0;               ///< points per direction inside every slave face instead; 0: the nodes
  int cut = 0; ///< points per direction of every piece of the slave faces, which are cut at the borders of
               ///< the master's segments; 0: no pieces
  bool equal_areas = false; ///< every slave node gets the same area, as if it had no neighbours to share with
  std::vector<double>
      rigid; ///< rigid master that moves along a line: [m][d], nodes of its one segment; else empty
  std::optional<RigidBodySpec> body; ///< rigid master that moves and turns
  Path wear_factor; ///< of the model's wear coefficient, over the pressure at the begin of the increment; no
                    ///< points: 1
  std::string master, master_where; ///< deformable master: faces, each one segment
  std::string ends = "repeated";    ///< smoothed master: the scene's key "ends"
  std::vector<MirrorPlane> mirror;  ///< smoothed master
  CoordinateRule coordinates;       ///< deformable master: its surface coordinates
  std::vector<double> direction;    ///< rigid master: unit vector of its motion
  CutOff cut_off;                   ///< short waves of the height become a law
  Json slave_height;                ///< of the slave's faces; null: they are plain
  std::string slave_height_where;
  CoordinateRule slave_coordinates;                    ///< in which it is given
  std::function<double(double x, double y)> law_scale; ///< of a law "table" in a slave point; empty: 1
  bool two_pass = false;                               ///< the points of the master faces are slaves, too
  bool gap_only = false; ///< the height changes the gap and nothing else, see Master::profile
  bool hard = false; ///< "law": "hard": the model has augmented multipliers, and Simulation their stiffness
  double heat_share = 0; ///< of what friction dissipates that is heat: "heat" of the model
  double heat_slave = 0; ///< of this heat that enters the slave
  Json model;            ///< passed on to the library
  std::string model_where;
};

/// A named parameter of the contact model that changes over the steps.
struct HistorySpec {
  std::string name;
  std::vector<double> values; ///< [steps] at the end of each; within a step on a straight line
};

/// Which exact solution the result is held against.
struct ExactSpec {
  enum class Type {
    none,
    hertz_line,
    hertz_point,
    westergaard,
    double_sine,
    cattaneo,
    slope,
    uniform_pressure,
    boundary_elements,
    worn_cylinder,
    screw
  };
  Type type = Type::none;
  std::string where;                ///< file and path, for messages
  double radius = 0;                ///< hertz_line, hertz_point, cattaneo, worn_cylinder [L]
  double coefficient = 0;           ///< cattaneo, slope, screw: friction
  double lead = 0, flank_angle = 0; ///< screw: along z in a turn [L]; degrees, in an axial section
  double distance = 0;              ///< cattaneo: of the points that displacements are measured against [L]
  double amplitude = 0, wavelength = 0; ///< westergaard, double_sine [L]
  double pressure = 0;                  ///< uniform_pressure [F/L^2]
  int points = 128;                     ///< boundary_elements: along the longer side of the layer
  double error = 0;     ///< boundary_elements: refine until the estimated error is as small; 0: do not
  double stiffness = 0; ///< boundary_elements: of a penalty [F/L^3]; 0: hard contact
};

/// Words for tables and pictures; the numbers are never converted.
struct UnitNames {
  std::string length, force, pressure;
};

/// Of a volume.
inline std::string cubic(const std::string& length) { return length.empty() ? "" : length + "^3"; }

/// Does Newton's iteration halve steps that do not lower the residual?
enum class LineSearch {
  when_needed, ///< in another try at an increment that fails without
  always,
  never,
};

struct SolverSpec {
  double tolerance = 1e-10; ///< residual norm relative to the forces present
  int max_iterations = 25;
  double min_step = 1e-3;   ///< smallest part of a step before the run gives up
  bool extrapolate = false; ///< first guess: the motion of the last increment goes on
  int segment_choices = 4;  ///< Newton iterations that may choose segments anew
  double gap_tolerance =
      1e-10; ///< Uzawa: of penetration and elastic slip, relative to the size of the slave surface
  int max_augmentations = 100;
  LineSearch line_search = LineSearch::when_needed;
};

/// A change of the scene under a name: a JSON merge patch (RFC 7386).
struct Variant {
  std::string name;
  Json patch;
};

/// For --compare: the scene against explicit meshes of plain segments.
struct CompareSpec {
  std::vector<int> divisions; ///< segments per direction of each mesh
  double error = 1e-3;        ///< relative difference at which the prices are compared
};

struct Scene {
  std::filesystem::path file; ///< for messages; the model's relative file names start at its folder
  std::string title;
  int dimension = 2;
  std::vector<PartSpec> parts;
  std::vector<SupportSpec> supports;
  std::optional<HalfSpaceSpec> half_space;
  std::vector<Traction> tractions;
  std::vector<SpringSpec> springs;
  std::vector<PeriodicSpec> periodic;
  std::vector<PeriodicSpec> tied; ///< their nodes lie in the same places
  std::optional<ContactSpec> contact;
  int symmetry_copies = 1; ///< the mesh is one of so many mirror images; forces are those of all
  Control control = Control::load_factor;
  std::vector<double> steps;
  std::vector<double> durations; ///< [steps] time that each takes
  double probe = 0; ///< part by which each step's load is changed for its incremental conductance; 0: none
  std::vector<HistorySpec> history;
  ExactSpec exact;
  UnitNames units;
  SolverSpec solver;
  CompareSpec compare;
  std::vector<Variant> variants;
  Json definition; ///< the file's text, changed by the variant: what a checkpoint is held against
};

/// @param variant  one of the scene's own, or empty: the scene as it is
/// @throws InputError naming the file and the JSON path
Scene read_scene(const std::filesystem::path& file, const std::string& variant = {});

/// The same from text; `file` stands for it in messages and gives the folder.
Scene read_scene_text(const std::string& text, const std::filesystem::path& file);

/// The part that a set "PART" or "PART.NAME" is of; null: none of that name.
const PartSpec* part_of_set(const Scene& scene, const std::string& set);

} // namespace host
