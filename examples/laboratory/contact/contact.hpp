// SPDX-License-Identifier: BSD-3-Clause
// Node-to-segment contact: one element of the library per slave node, or per sampling point inside the slave
// faces.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "configuration.hpp"
#include "contact_unknowns.hpp"
#include "cut_points.hpp"
#include "detector.hpp"
#include "dof_map.hpp"
#include "master.hpp"
#include "master_frame.hpp"
#include "slave_points.hpp"
#include "sparse_system.hpp"

namespace host {

/// What a rigid master feels: total force along its direction of motion e, and how it and the forces on the
/// other unknowns depend on its motion.  dW/d(motion) = -sum R_s . e
struct RigidCoupling {
  double force = 0;           ///< -sum R_s . e [F]; > 0 presses
  std::vector<double> column; ///< [dofs, multipliers] dR/d(motion) = -K_s e
  std::vector<double> row;    ///< [dofs, multipliers] d(force)/du = -e K_s
  double diagonal = 0;        ///< d(force)/d(motion) = sum e K_s e
};

/// Of all elements together.
struct ContactEnergy {
  double stored = 0;     ///< by the laws of normal contact and friction [F L]
  double dissipated = 0; ///< within the increment [F L]
  double size = 0;       ///< sum of the elements' sizes: the measure of rounding
};

/// Fields on the slave nodes, in their order.
struct ContactFields {
  std::vector<double> gap, normal_gap,
      pressure;                      ///< [slaves]; no projection inside the segment: NaN gaps, no pressure
  std::vector<double> normal, point; ///< [slaves][d] n_e and rho_e at the projection
  std::vector<char> closed;          ///< [slaves] carries pressure
  std::vector<double> traction;      ///< [slaves][d] tangential, on the master
  std::vector<double> slip, age;     ///< [slaves] accumulated; increments since the last change of status
  double dissipation = 0;            ///< of friction within the increment, all points [F L]
  std::vector<double> worn;          ///< [slaves] depth lost by the slave surface [L]; empty: no wear
  std::vector<std::int32_t> flags;   ///< [slaves] ENTS_FLAG_...; no segment: ENTS_FLAG_OUTSIDE
  std::vector<std::int64_t> segment; ///< [slaves] -1: none
  std::vector<double> node_forces;   ///< [slaves][d] on the master
  std::vector<double> force;         ///< [d] their sum
  std::vector<double>
      moment; ///< [3], 2D [1] about the reference point of a rigid body that turns; else empty
};

/// The slave's faces, and how its points are made anew where an increment begins: see cut_points.hpp.
struct CutSpec {
  std::vector<Face> faces;
  SlaveGeometry geometry;
  int per_direction = 0;                 ///< 0: the slave points are given and stay
  std::shared_ptr<SlaveSurface> surface; ///< what puts the points above their faces; null: they are in them
};

/// What a restart needs: the history at the end of the last accepted increment.
struct ContactHistory {
  Projections at;
  std::vector<double> state, pressure, traction;
  std::map<std::string, std::vector<double>> fields; ///< blocks of the model's fields
  double worn_master = 0;                            ///< volume that the master has lost [L^3]
  std::vector<double>
      thickness; ///< [slaves] self-contact: of the body at the begin of the increment [L]; else empty
  std::map<std::string, std::vector<double>> slave_fields; ///< blocks of the fields of the slave's height
  std::vector<double> given_away; ///< [slaves] depth that has gone into them [L]; empty: no wear that does
};

/// What the elements start from beside the configuration: the last choice, and the states of the increment's
/// begin as seen from there. Without history, too: the state's projection is the one that is followed.
struct ElementStart {
  Projections at;
  std::vector<double> state; ///< [slaves][state_size]
};

class Contact {
public:
  /// @param points     without a cut
  /// @param thickness  2D: of the bodies; axisymmetric ones: 0
  Contact(Master master, const ContactSpec& spec, const Mesh& mesh, const DofMap& dofs, SlavePoints points,
          CutSpec cut, double thickness);

  const Master& master() const { return master_; }
  const SlavePoints& slaves() const { return points_; }
  const std::vector<double>& areas() const { return points_.areas; } ///< [slaves]
  /// Current positions of the slave points, [slaves][d].
  std::vector<double> positions(const std::vector<double>& displacement) const;
  double total_area() const;
  const MasterFrame& frame() const { return frame_; }
  /// Diagonal of the box round the slave nodes: the length that penetrations are measured by.
  double size() const { return size_; }
  bool symmetric_tangent() const { return master_.model->layout().symmetric_tangent != 0 && !frame_.turns(); }
  /// What an increment ends with depends on more than the configuration it starts from.
  bool has_history() const;
  /// Are the slave faces cut anew at the begin of each increment? If the points have a history or multipliers
  /// of their own, they stay those of the reference configuration.
  bool cuts_again() const { return cut_.per_direction > 0 && !has_history() && multipliers_ == 0; }
  bool augmentable() const { return master_.model->layout().augmentable != 0; }
  /// Is there tension at positive gaps, so that surfaces may jump together or apart?
  bool pulls() const { return pulls_; }
  /// The forces are derivatives of an energy; with `friction` all but its own are.
  bool conservative(bool friction) const {
    return (friction || symmetric_tangent()) && !frame_.turns() && !augmentable() && !wears() &&
           multipliers_ == 0;
  }
  /// Of the last `assemble`, if the law pulls.
  const ContactEnergy& energy() const { return energy_; }
  /// Rows that may make the tangent of the last `assemble` indefinite get a diagonal as large as the sum of the sizes
  /// of their other entries (Gershgorin).
  /// @param every_row  false: only those whose diagonal is negative
  /// @param coupling   optional, becomes that of the changed tangent
  /// @return what has been added, of the tangent's pattern
  SparseMatrix make_definite(bool every_row, RigidCoupling* coupling);
  /// Does the model wear?
  bool wears() const { return master_.model->layout().worn >= 0; }
  /// Volumes that slave and master have lost until the last accepted increment, of this mesh [L^3].
  double worn_slave() const;
  double worn_master() const { return worn_master_; }
  /// What a slave slides at most for a unit of the parameter that slides: 1, or round an axis its largest
  /// radius.
  double largest_arm() const;
  /// Distance slid beside the motion of the mesh until then; round an axis the angle.
  double slid() const;
  /// Unknowns of multipliers: so many per slave node, in the order of `slaves`, after the displacements.
  std::size_t multipliers() const { return multipliers_; }
  std::size_t multiplier_count() const { return multipliers_ * points_.size(); }
  /// Residuals of the multipliers times this are forces per area times area.
  double multiplier_scale(std::size_t index) const;

  /// Cut the slave faces where an increment begins. Points, areas and the accepted fields are new then, and
  /// the tangent needs its pattern again.
  /// @return false: the points are those of this configuration already, or stay
  bool cut_again(const Configuration& begin);

  /// How long increments take from now on: friction may depend on the rate of the slip.
  void take_time(double increment) { time_increment_ = increment; }
  /// An increment begins here, whatever was tried before.
  void begin_increment(const Configuration& begin);

  /// Find the segment of every slave node. A closed node is followed, an open one is searched anew: it may
  /// have moved over another flank of the surface. The history of a node that moved on to another segment
  /// moves with it.
  /// @param only_lost  a closed node on its segment's border stays there, else it is searched, too
  /// @param report     of a history that could not be moved: its status is positive, cut the step
  /// @return the choice is not that of the last `build_tangent`: a deformable master needs it again
  bool choose(const Configuration& at, bool only_lost, ents_report& report);
  /// The offsets of a master's profile, if it has one: what is below each point where it was chosen, before
  /// the first step. The points keep them.
  /// @throws JobError if a point is over no segment
  void read_profile();

  /// Where the last `choose` found a slave node whose contact is lost: behind a concave edge, open although
  /// it has penetrated; or beside all segments, although it was in contact in the iterate before or at the
  /// begin of the increment. Empty: nowhere.
  const std::string& lost() const { return lost_; }
  bool lost_behind_edge() const { return lost_behind_edge_; }

  /// For the same elements again.
  ElementStart start() const { return {at_, state_in_}; }
  /// As if `choose` had found these; until the next `begin_increment`.
  void take(const ElementStart& start) { at_ = start.at, state_in_ = start.state; }

  /// The tangent's pattern for the present choice.
  void build_tangent();
  /// Tangent of the elements over `unknowns`, compressed rows.
  const SparseMatrix& tangent() const { return tangent_; }
  /// Those of [dofs, multipliers] that contact elements have.
  const std::vector<std::size_t>& unknowns() const { return unknowns_.dofs; }

  /// Add the contact forces to the residual; the tangents are in `tangent` then.
  /// @param residual  [dofs, multipliers]
  /// @param coupling  optional, rigid master only
  /// @param squared_force  |R|^2 on the slave nodes: the size of the contact forces
  /// @return status of the library; positive: cut the step, see `report`
  std::int32_t assemble(const Configuration& at, std::vector<double>& residual, bool want_tangent,
                        RigidCoupling* coupling, double& squared_force, ents_report& report);

  /// Of each of `unknowns` the size of the numbers beside its own that a gap is made of: the coordinate of
  /// the node, and of a rigid master its motion and the nodes of the segment; multipliers: 0.
  std::vector<double> position_sizes(const Configuration& at) const;

  /// residual += tangent of the last `assemble` times displacements [dofs].
  void add_tangent_times(const std::vector<double>& direction, std::vector<double>& residual) const;

  /// Uzawa: the forces of the last `assemble`, which found equilibrium, become multipliers unless they are
  /// close enough.
  /// @return by how much forces and multipliers differ over the stiffness: penetration or elastic slip [L]
  double augment(const Configuration& at, double enough);

  /// How many slave nodes the last `assemble` found in another status (open, stick, slip) or closed on
  /// another segment than the one before it: Newton's iteration is quadratic once there are none.
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

  /// Points that are cut again have none: the configuration says where they are.
  ContactHistory history() const {
    if (cuts_again()) return {{}, {}, {}, {}, master_.model->fields(), worn_master_, {}, slave_fields(), {}};
    return {begin_at_,    state_begin_,     accepted_.pressure, accepted_.traction, master_.model->fields(),
            worn_master_, thickness_below_, slave_fields(),     given_away_};
  }
  /// @throws InputError if the sizes or the state blocks are not of this model
  void restore(const ContactHistory& history, const Configuration& at);

private:
  std::size_t dofs() const { return static_cast<std::size_t>(dofs_->dofs()); }
  std::int64_t count() const { return static_cast<std::int64_t>(points_.size()); }
  /// Of a surface that is slave and master: half of each area, and what the search leaves out.
  void read_both_sides(const ContactSpec& spec);
  /// Self-contact: an increment begins there.
  void measure_thickness(const Configuration& begin);
  /// @throws InputError where slave nodes are nodes of the master
  void refuse_self_contact(const ContactSpec& spec) const;
  /// Have two segments the same nodes: is the master a sheet without thickness, but for its height?
  /// @throws InputError where the height is none
  bool has_two_sides(const ContactSpec& spec) const;
  /// The slave points of a cut in this configuration.
  SlavePoints cut(const Configuration& at);
  /// Arrays over the slave points, for points that have been nowhere yet.
  void reset_points();
  SegmentCorners segment_corners() const;
  /// Positions of the slave points, of a rigid master that moves in its frame
  std::vector<double> slave_points(const Configuration& at);
  /// Positions of the mesh's nodes [nodes][d].
  std::vector<double> nodes_at(const std::vector<double>& displacement) const;
  /// Out of the slave's body in these points, [points][d] of any length, as the master sees them; empty: a sheet
  /// between bodies has slaves on both sides
  std::vector<double> slave_normals(const Configuration& at);
  /// The model with the parameters of a configuration, and what has been slid since the begin of the
  /// increment.
  void bind(const Configuration& at);
  /// What the master has lost goes from the states into the model's field, what the slave has lost into that of
  /// its height; a side without a field keeps it there.
  void collect_wear();
  void collect_slave_wear();
  std::map<std::string, std::vector<double>> slave_fields() const;
  /// The accepted depths, from the states.
  void set_worn();
  std::size_t parameter_of(const Json& name) const;
  /// The model with the parameters of a configuration; slave and master positions; those of a rigid master
  /// stay, and the slaves move against it.
  void place(const Configuration& at);
  ents_master_mesh mesh() const;
  /// Positions of the master's nodes or control points, [n][d], for displacements of the mesh.
  std::vector<double> master_points(const std::vector<double>& displacement) const;
  /// The master's side of a system of equations: `master_nodes_` nodes, with the net's combination.
  void set_master(ents_system& system, ents_combination& points,
                  const std::vector<std::int64_t>& equations) const;
  /// Mirror images move against their nodes: the signs of their unknowns go into the tangent.
  void turn_images();
  ents_input input(const ents_master_mesh& mesh) const;
  /// The library's elements, added to `system`.
  /// @throws JobError for what a smaller step does not cure
  std::int32_t add_elements(const ents_output& out, ents_system system, ents_report& report);
  /// Nodes [m][d] of a segment at the begin of the increment. A rigid master's are in its own frame.
  void gather(std::int64_t segment, std::vector<double>& positions) const;
  /// History of the elements as seen from their segments.
  void move_history(ents_report& report);
  /// States of open points as their present segments see them at the begin of the increment: what touches
  /// within it slips from there.
  void find_begin(const std::vector<std::size_t>& points);
  void count_changes(const std::vector<std::int32_t>& flags);
  /// @param energies  three of each point: stored, stored by friction, dissipated
  void ask_for_energy(ents_output& out, std::vector<double>& energies) const;
  void add_up(const std::vector<double>& energies);
  /// The tangent's part of the coupling.
  void couple(RigidCoupling& coupling) const;

  Master master_;
  MasterFrame frame_;
  const Mesh* mesh_;
  const DofMap* dofs_;
  CutSpec cut_;
  Configuration cut_at_; ///< where the points were cut
  SlavePoints points_;
  std::size_t d_, m_, parameters_, multipliers_, state_size_;
  double size_ = 0, normal_stiffness_ = 1, tangential_stiffness_ = 1;
  double thickness_, worn_master_ = 0, time_increment_ = 1;
  std::vector<double> given_away_;   ///< see ContactHistory
  Path wear_factor_;                 ///< over the pressure, see ContactSpec
  std::vector<double> slave_values_; ///< [points][slave_numbers_], see ents_input; empty: none
  std::size_t slave_numbers_ = 3;    ///< 4: with the scale of a table
  std::size_t sliding_ = 0;     ///< the parameter that is the distance slid; behind the last one: none is
  std::vector<double> bound_;   ///< parameters of the model at present
  bool surface_changed_ = true; ///< since the detector has seen it
  Detector detector_;
  LeftOut left_out_;
  std::vector<double> thickness_below_; ///< [slaves] self-contact, see ContactHistory; else empty
  bool one_surface_ = false;
  std::unique_ptr<Detector> base_detector_;   ///< on the segments without their height
  Projections at_, begin_at_;                 ///< present ones; those of the history
  std::vector<std::int64_t> pattern_segment_; ///< for which the tangent's pattern was made
  std::vector<double> state_begin_;           ///< [slaves][state_size]
  Configuration begin_;                       ///< where the increment began
  /// [slaves] segment and status that the last `assemble` found; -1: open
  std::vector<std::int64_t> found_;
  /// A node that was in contact at the begin of the increment, and has no segment now: an earlier iterate may
  /// have lost it.
  Lost find_lost_since_begin(const ents_master_mesh& where) const;
  std::string lost_;
  bool lost_behind_edge_ = false, has_two_sides_ = false;
  std::vector<char> closed_; ///< [slaves] by the last `assemble`
  int status_changes_ = 0, switches_ = 0, moves_ = 0;
  std::vector<double> slave_positions_, slave_normals_, master_positions_, multiplier_values_;
  std::vector<double> master_begin_, slave_begin_; ///< positions at the begin of the increment
  std::vector<double> state_in_, state_out_;
  std::vector<double> pressure_, traction_; ///< [slaves], [slaves][d] multipliers of the begin states (Uzawa)
  ContactUnknowns unknowns_;                ///< rows and columns of `tangent_`
  std::vector<std::int64_t> point_begin_, point_nodes_, places_;
  SparseMatrix tangent_;
  bool pulls_ = false;
  ContactEnergy energy_;
  ContactFields accepted_;
};

} // namespace host
