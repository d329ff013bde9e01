// SPDX-License-Identifier: BSD-3-Clause
// Node-to-segment contact: one element of the library per slave node, or per sampling point inside the slave faces.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "configuration.hpp"
#include "dof_map.hpp"
#include "master.hpp"
#include "segment_search.hpp"
#include "slave_points.hpp"
#include "sparse_system.hpp"

namespace host {

/// What a rigid master feels: total force along its direction of motion e, and how it and the forces on the
/// other unknowns depend on its motion.  dW/d(motion) = -sum R_s . e
struct RigidCoupling {
  double force = 0;               ///< -sum R_s . e [F]; > 0 presses
  std::vector<double> column;     ///< [dofs, multipliers] dR/d(motion) = -K_s e
  std::vector<double> row;        ///< [dofs, multipliers] d(force)/du = -e K_s
  double diagonal = 0;            ///< d(force)/d(motion) = sum e K_s e
};

/// Fields on the slave nodes, in their order.
struct ContactFields {
  std::vector<double> gap, normal_gap, pressure; ///< [slaves]; no projection inside the segment: NaN gaps, no pressure
  std::vector<double> normal, point;             ///< [slaves][d] n_e and rho_e at the projection
  std::vector<char> closed;                      ///< [slaves] carries pressure
  std::vector<double> traction;                  ///< [slaves][d] tangential, on the master
  std::vector<double> slip, age;                 ///< [slaves] accumulated; increments since the last change of status
  std::vector<std::int32_t> flags;               ///< [slaves] ENTS_FLAG_...; no segment: ENTS_FLAG_OUTSIDE
  std::vector<int> segment;                      ///< [slaves] -1: none
  std::vector<double> node_forces;               ///< [slaves][d] on the master
  std::vector<double> force;                     ///< [d] their sum
};

/// What a restart needs: the history at the end of the last accepted increment.
struct ContactHistory {
  std::vector<int> segment;
  std::vector<double> state, xi, pressure, traction;
};

class Contact {
public:
  Contact(Master master, const ContactSpec& spec, const Mesh& mesh, const DofMap& dofs, SlavePoints points);

  const Master& master() const { return master_; }
  const SlavePoints& slaves() const { return points_; }
  const std::vector<double>& areas() const { return points_.areas; } ///< [slaves]
  /// Current position.
  std::array<double, 3> position_of(std::size_t slave, const std::vector<double>& displacement) const;
  double total_area() const;
  /// Diagonal of the box round the slave nodes: the length that penetrations are measured by.
  double size() const { return size_; }
  bool symmetric_tangent() const { return master_.model->layout().symmetric_tangent != 0; }
  /// What an increment ends with depends on more than the configuration it starts from.
  bool has_history() const;
  bool augmentable() const { return master_.model->layout().augmentable != 0; }
  /// Unknowns of multipliers: so many per slave node, in the order of `slaves`, after the displacements.
  std::size_t multipliers() const { return multipliers_; }
  std::size_t multiplier_count() const { return multipliers_ * points_.size(); }
  /// Residuals of the multipliers times this are forces per area times area.
  double multiplier_scale(std::size_t index) const;

  /// An increment begins here, whatever was tried before.
  void begin_increment(const Configuration& begin);

  /// Choose a segment for every slave node: of those near by, the one that is least outside, then the
  /// closest, then the first. The history of a node that moved on to another segment moves with it.
  /// @param only_lost  a node that projects inside its segment or its margin stays there
  /// @param report     of a history that could not be moved: its status is positive, cut the step
  /// @return the choice is not that of the last `stencil`: the pattern of a deformable master's equations is another one
  bool choose(const Configuration& at, bool only_lost, ents_report& report);

  /// Equations of the elements for the present choice.
  StencilGroup stencil();
  /// One equation each: multipliers of nodes without an element, which are zero.
  StencilGroup idle_stencil() const;

  /// Add the contact forces to the residual and the tangents to the system.
  /// @param residual  [dofs, multipliers]
  /// @param system    optional; the group numbers are `group` (stencil) and `group + 1` (idle_stencil)
  /// @param coupling  optional, rigid master only
  /// @param squared_force  sum |R_s|^2: the size of the contact forces
  /// @return status of the library; positive: cut the step, see `report`
  std::int32_t assemble(const Configuration& at, std::vector<double>& residual, SparseSystem* system,
                        std::size_t group, RigidCoupling* coupling, double& squared_force, ents_report& report);

  /// Uzawa: the forces of the last `assemble`, which found equilibrium, become multipliers unless they are close enough.
  /// @return by how much forces and multipliers differ over the stiffness: penetration or elastic slip [L]
  double augment(const Configuration& at, double enough);

  /// How many slave nodes the last `assemble` found in another status (open, stick, slip) or closed on another
  /// segment than the one before it: Newton's iteration is quadratic once there are none.
  int status_changes() const { return status_changes_; }
  /// Those of them that opened or closed.
  int switches() const { return switches_; }
  /// Those that stayed closed on another segment.
  int moves() const { return moves_; }

  /// The increment is accepted: what the last `assemble` left becomes the history.
  void accept(const Configuration& at);

  /// Present fields with the history at the begin of the increment.
  ContactFields fields(const Configuration& at);
  /// Fields at the end of the last accepted increment.
  const ContactFields& accepted() const { return accepted_; }

  ContactHistory history() const;
  /// @throws InputError if the sizes or the state blocks are not of this model
  void restore(const ContactHistory& history, const Configuration& at);

private:
  /// Slave and master positions of the active elements, one after the other.
  void gather(const Configuration& at);
  void gather_master(std::size_t segment, const std::vector<double>& displacement, double motion,
                     double* positions) const;
  ents_input input() const;
  /// Where the master's segments are; once for a rigid master, without its motion.
  void build_grid(const std::vector<double>& displacement);
  /// Segments of all slave nodes for this configuration.
  void search(const Configuration& at, bool only_lost);
  /// History of the active elements as seen from their segments.
  void move_history(ents_report& report);
  void list_active();
  /// Dofs of an element in the mesh: a slave point inside a face has those of the face's nodes.
  std::size_t expanded_dofs() const { return element_dofs_ + (points_.nodes_per_point - 1) * d_; }
  struct Expanded {
    std::vector<double> residual, tangent;
  };
  void expand(std::size_t k, const double* residual, const double* tangent, Expanded& out) const;
  /// Does the slave point of this element lie ahead of all that its segment's enriched surface fills, or beside it? Then it is open,
  /// also where its projection cannot be found.
  bool is_far(std::size_t element) const;
  /// Status of a call that found no projection for some elements: ENTS_OK if these are far, else that of the first that is not.
  /// The history of those that are far begins anew.
  std::int32_t without_far(const std::vector<std::int32_t>& status, const ents_input& in, ents_report& report);
  std::size_t unknown(std::size_t element, std::size_t expanded) const; ///< index into [dofs, multipliers]
  /// Projections on the segment without its height, for elements whose own is not known yet: the point of a rough surface
  /// straight ahead of the node, at the price of a plain segment. Searching the whole enriched one would find a closer point
  /// somewhere else, or two that are equally close.
  /// @return false: none found, the library shall search
  bool start_from_base();

  Master master_;
  const Mesh* mesh_;
  const DofMap* dofs_;
  SlavePoints points_;
  std::size_t d_, m_, parameters_, element_dofs_, node_dofs_, state_size_, multipliers_;
  double size_ = 0, normal_stiffness_ = 1, tangential_stiffness_ = 1;
  /// [slaves] chosen; chosen when the history was written; chosen when the equations were listed
  std::vector<int> segment_, segment_begin_, stencil_segment_;
  std::vector<double> state_begin_;          ///< [slaves][state_size]
  Configuration begin_;                      ///< where the increment began
  /// [slaves] segment and status that the last `assemble` found; -1: open
  std::vector<int> found_;
  int status_changes_ = 0, switches_ = 0, moves_ = 0;
  // The elements of the present choice, in the order of `active_`.
  std::vector<std::size_t> active_; ///< slaves with a segment
  std::vector<double> slave_positions_, master_positions_, active_coordinates_, active_areas_, active_multipliers_;
  std::vector<double> state_in_, state_out_;
  std::vector<double> last_xi_, xi_begin_; ///< [slaves][d-1] where the projection was last, NaN: unknown
  std::vector<double> start_;              ///< [active][d-1]; empty: search
  std::vector<double> pressure_, traction_; ///< [slaves], [slaves][d] multipliers of the begin states (Uzawa)
  std::unique_ptr<SegmentSearch> grid_;
  std::vector<double> grid_masters_; ///< [segments][m][d]
  ContactFields accepted_;
};

} // namespace host
