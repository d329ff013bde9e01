// SPDX-License-Identifier: BSD-3-Clause
// Node-to-segment contact: one element of the library per slave node, or per sampling point inside the slave
// faces. Made of its two sides, the search of segments, the states that increments start from, and wear; this class
// has the elements in the equations of the host.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "contact_energy.hpp"
#include "contact_search.hpp"
#include "contact_sides.hpp"
#include "contact_states.hpp"
#include "contact_tangent.hpp"
#include "contact_wear.hpp"
#include "slave_values.hpp"
#include "status_changes.hpp"

namespace host {

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

  const Master& master() const { return sides_.master; }
  const SlavePoints& slaves() const { return sides_.points; }
  const std::vector<double>& areas() const { return sides_.points.areas; } ///< [slaves]
  /// Current positions of the slave points, [slaves][d].
  std::vector<double> positions(const std::vector<double>& displacement) const {
    return sides_.positions(displacement);
  }
  double total_area() const;
  const MasterFrame& frame() const { return sides_.frame; }
  /// Diagonal of the box round the slave nodes: the length that penetrations are measured by.
  double size() const { return sides_.size; }
  bool symmetric_tangent() const { return sides_.layout().symmetric_tangent != 0 && !frame().turns(); }
  /// What an increment ends with depends on more than the configuration it starts from.
  bool has_history() const { return sides_.has_history(); }
  /// Are the slave faces cut anew at the begin of each increment? If the points have a history or multipliers
  /// of their own, they stay those of the reference configuration.
  bool cuts_again() const { return sides_.cut.per_direction > 0 && !has_history() && multipliers() == 0; }
  bool augmentable() const { return sides_.layout().augmentable != 0; }
  /// Is there tension at positive gaps, so that surfaces may jump together or apart?
  bool pulls() const { return pulls_; }
  /// The forces are derivatives of an energy; with `friction` all but its own are.
  bool conservative(bool friction) const {
    return (friction || symmetric_tangent()) && !frame().turns() && !augmentable() && !wears() &&
           multipliers() == 0;
  }
  /// Of the last `assemble`, if the law pulls.
  const ContactEnergy& energy() const { return energy_; }
  /// Does the model wear?
  bool wears() const { return wear_.acts(); }
  /// Volumes that slave and master have lost until the last accepted increment, of this mesh [L^3].
  double worn_slave() const { return wear_.of_slave(states_); }
  double worn_master() const { return wear_.of_master; }
  /// What a slave slides at most for a unit of the parameter that slides: 1, or round an axis its largest
  /// radius.
  double largest_arm() const { return values_.largest_arm(); }
  /// Distance slid beside the motion of the mesh until then; round an axis the angle.
  double slid() const { return sides_.slid(); }
  /// Unknowns of multipliers: so many per slave node, in the order of `slaves`, after the displacements.
  std::size_t multipliers() const { return sides_.multipliers; }
  std::size_t multiplier_count() const { return multipliers() * sides_.points.size(); }
  /// Residuals of the multipliers times this are forces per area times area.
  double multiplier_scale(std::size_t index) const;

  /// Cut the slave faces where an increment begins. Points, areas and the accepted fields are new then, and
  /// the tangent needs its pattern again.
  /// @param again  also if the points are those of this configuration already
  /// @return false: they are, or stay
  bool cut_again(const Configuration& begin, bool again = false);

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
  const std::string& lost() const { return search_.lost(); }
  bool lost_behind_edge() const { return search_.lost_behind_edge(); }

  /// For the same elements again.
  ElementStart start() const { return {at_, states_.in}; }
  /// As if `choose` had found these; until the next `begin_increment`.
  void take(const ElementStart& start) { at_ = start.at, states_.in = start.state; }

  /// The tangent's pattern for the present choice.
  void build_tangent() { tangent_.build(at_.segment); }
  /// That of the last `assemble`.
  const ContactTangent& tangent() const { return tangent_; }
  ContactTangent& tangent() { return tangent_; }

  /// Add the contact forces to the residual; the elements' tangents are in `tangent` then.
  /// @param residual  [dofs, multipliers]
  /// @param coupling  optional, rigid master only
  /// @param squared_force  |R|^2 on the slave nodes: the size of the contact forces
  /// @return status of the library; positive: cut the step, see `report`
  std::int32_t assemble(const Configuration& at, std::vector<double>& residual, bool want_tangent,
                        RigidCoupling* coupling, double& squared_force, ents_report& report);

  /// Of each of `unknowns` the size of the numbers beside its own that a gap is made of: the coordinate of
  /// the node, and of a rigid master its motion and the nodes of the segment; multipliers: 0.
  std::vector<double> position_sizes(const Configuration& at) const;

  /// Uzawa: the forces of the last `assemble`, which found equilibrium, become multipliers unless they are
  /// close enough.
  /// @return by how much forces and multipliers differ over the stiffness: penetration or elastic slip [L]
  double augment(const Configuration& at, double enough);

  /// How many slave nodes the last `assemble` found in another status than the one before it; those that opened or
  /// closed, and those that stayed closed on another segment.
  int status_changes() const { return changes_.all; }
  int switches() const { return changes_.switches; }
  int moves() const { return changes_.moves; }

  /// The increment is accepted: what the last `assemble` left becomes the history.
  void accept(const Configuration& at);

  /// Present fields with the history at the begin of the increment.
  ContactFields fields(const Configuration& at);
  /// Fields at the end of the last accepted increment.
  const ContactFields& accepted() const { return states_.accepted; }

  /// Points that are cut again have none: the configuration says where they are.
  ContactHistory history() const;
  /// @throws InputError if the sizes or the state blocks are not of this model
  void restore(const ContactHistory& history, const Configuration& at);

private:
  /// Is this a history of this scene?
  void check(const ContactHistory& history) const;
  void take(const ContactHistory& history, const Configuration& begin);
  /// Arrays over the slave points, for points that have been nowhere yet.
  void reset_points();
  ents_input input(const ents_master_mesh& mesh) const;
  /// The library's elements, added to `system`.
  /// @throws JobError for what a smaller step does not cure
  std::int32_t add_elements(const ents_output& out, ents_system system, ents_report& report);
  ContactSides sides_;
  SlaveValues values_;
  ContactSearch search_;
  ContactStates states_;
  ContactWear wear_;
  ContactTangent tangent_;
  double normal_stiffness_, tangential_stiffness_, time_increment_ = 1;
  bool pulls_ = false;
  Projections at_; ///< present ones
  StatusChanges changes_;
  std::vector<std::int64_t> point_begin_, point_nodes_;
  ContactEnergy energy_;
};

} // namespace host
