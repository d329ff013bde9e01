// SPDX-License-Identifier: BSD-3-Clause
// Contact through the library: what a host keeps, and which function of ents.h it calls when.
#pragma once

#include <string>
#include <vector>

#include <ents.hpp>

#include "mesh.hpp"
#include "scene.hpp"
#include "toolbox/solver.hpp"
#include "toolbox/vtu.hpp"

namespace host {

/// Sizes and numbers of ents.h.
inline std::int64_t ssize_of(std::size_t size) { return static_cast<std::int64_t>(size); }

/// Where everything is.
struct Configuration {
  std::vector<double> displacement; ///< [dofs] of all nodes
  double motion = 0; ///< of the rigid master along its direction, from where the scene puts it [L]
  double load_factor = 0;
  double force = 0; ///< prescribed on the rigid master, of this mesh [F]
};

/// Areas of the nodes of faces that a pressure on them is shared out by.
/// @return [nodes of the mesh]
/// @throws InputError with the library's message
std::vector<double> node_areas(const Mesh& mesh, const std::vector<Face>& faces, const ElementSetup& setup,
                               const std::string& where);

/// What became of a call that may ask for a smaller step.
struct Outcome {
  bool ok = true;
  std::string reason;
  double step_factor = 1; ///< not ok: how much smaller the increment should be
};

/// Results in the slave points, at the end of an increment.
struct ContactResults {
  std::vector<double> position, normal, traction; ///< [points][d]
  std::vector<double> gap, pressure, slip;        ///< [points]
  std::vector<double> heat;                       ///< [points] power from slave to master; empty: no "heat"
  double friction_heat = 0;                       ///< power that friction makes, both sides together
  std::vector<double> force;                      ///< [d] of the slave points on the master
  std::vector<std::int32_t> flags;                ///< [points] ENTS_FLAG_...
};

/// Force on a rigid master along its direction, and how it and the residual change with the motion along it.
struct Coupling {
  double force = 0, diagonal = 0;  ///< [F], dforce/dmotion
  std::vector<double> column, row; ///< [dofs] dR/dmotion, dforce/du
};

class Contact {
public:
  /// @throws InputError with the library's message, or for a set that is not in the mesh; NeedsLaboratory
  Contact(const Scene& scene, const Mesh& mesh);

  bool rigid() const { return rigid_; }
  bool symmetric() const { return model_.layout().symmetric_tangent != 0; }
  std::size_t segments() const {
    return connectivity_.size() / static_cast<std::size_t>(model_.layout().nodes);
  }
  std::size_t points() const { return areas_.size(); }
  const std::vector<double>& areas() const { return areas_; } ///< [points] tributary areas
  const ents::Model& model() const { return model_; }
  ents_master_mesh mesh() const; ///< the master as it is now

  /// An increment begins here: positions that friction and wear start from. It takes the time `duration` > 0.
  void begin_increment(const Configuration& begin, double duration);
  /// The increment is accepted: states of its end are the begin of the next one.
  void accept();

  /// Find the segments of all slave points.
  /// @return not ok: contact was lost, cut the increment. `changed`: the tangent's pattern is another one
  Outcome search(const Configuration& at, bool& changed);

  /// Zero entries where the tangent has some: dofs of the mesh as rows and columns.
  void build_pattern();
  const SparseMatrix& tangent() const { return tangent_; }

  /// Contact forces are added to the residual; `tangent` is that of these forces.
  /// @param residual  [dofs] of all nodes, prescribed ones, too
  /// @param squared, squared_power  |R|^2 of the slave points' nodes is added: the size of the forces, the powers
  Outcome assemble(const Configuration& at, std::vector<double>& residual, double& squared,
                   double& squared_power);

  /// Force of the slave points on the master, [d], of the last `assemble`.
  std::vector<double> force() const;
  /// Of the last `assemble`, for a rigid master.
  Coupling coupling() const;

  /// @throws JobError if contact cannot be evaluated there
  ContactResults results(const Configuration& at);
  /// The enriched master, so many cells a segment and direction, for pictures; heights go into the first array.
  void sample_surface(const Configuration& at, int divisions, vtu::Grid& grid);

private:
  void read_slaves(const Scene& scene, const Mesh& mesh);
  void read_master(const Scene& scene, const Mesh& mesh);
  void smooth(const Scene& scene, const std::vector<Face>& faces);
  void place(const Configuration& at);
  void warm(const Configuration& at);
  std::vector<double> slave_positions(const Configuration& at) const;
  std::vector<double> master_positions(const Configuration& at) const;
  ents_detection detection();
  /// The library's elements: rows of `system`, if there is one, and results in `out`.
  Outcome iterate(const ents_output& out, const ents_system* system);
  Outcome outcome(const ents::Result& result) const;

  const Mesh* bodies_;
  std::size_t d_;
  ents::Model model_;
  bool rigid_, sampled_ = false, smoothed_ = false, heat_ = false;
  std::vector<double> direction_; ///< rigid: of its motion
  // Slave points: nodes, or combinations of the nodes of their face.
  ents::Combination slave_;
  std::vector<double> areas_;
  std::vector<int> slave_nodes_;
  // Master: its segments over nodes of the mesh, control points, or nodes of its own.
  std::vector<std::int64_t> connectivity_; ///< [segments][m]
  ents::Combination net_;                  ///< smoothed: control points over nodes
  std::vector<double> surface_coordinates_, fixed_;
  ents::Tree tree_;
  double reach_ = 0, duration_ = 1; ///< of the search; of the increment
  // Changes with the configuration.
  std::vector<double> slave_now_, master_now_, slave_begin_, master_begin_;
  std::vector<double> slave_temperature_,
      master_temperatures_; ///< with "heat": of points, of the master's nodes
  std::vector<std::int64_t> segment_, pattern_segment_;
  std::vector<double> xi_;
  std::vector<std::int32_t> flags_;
  struct Begin { ///< where an increment that is tried again begins
    std::vector<std::int64_t> segment;
    std::vector<double> xi;
    std::vector<std::int32_t> flags;
  };
  Begin accepted_;
  ents::States states_;
  // In the host's equations, whose rows are the dofs of the mesh.
  double temperature_ = 0, master_temperature_ = 0; ///< of everything at first; of a rigid master
  std::vector<std::int64_t> rows_;                  ///< [nodes][node_dofs]
  SparseMatrix tangent_;
  std::vector<double> own_force_; ///< [dofs] of the last `assemble`
};

} // namespace host
