// SPDX-License-Identifier: BSD-3-Clause
// The search of the master's segments: which slave points are followed and which are searched anew, what a point must
// not find, and which have lost their contact.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "both_sides.hpp"
#include "contact_sides.hpp"
#include "detector.hpp"

namespace host {

class ContactSearch {
public:
  /// Points of surfaces that are slave and master get half their areas.
  /// @throws InputError where slave nodes are nodes of the master, or a sheet without thickness has no height
  ContactSearch(ContactSides& sides, const ContactSpec& spec);

  /// An increment begins there: of a surface in contact with itself the thickness of its body is measured.
  void begin_increment(const Configuration& begin);

  /// Find the segments where `sides` has been placed. A closed point is followed, an open one is searched anew: it may
  /// have moved over another flank of the surface.
  /// @param closed     [slaves]
  /// @param only_lost  a closed point on its segment's border stays there, else it is searched, too
  /// @param begun      projections at the begin of the increment
  /// @param pressure   [slaves] there
  /// @param found      in: those of before; out: the present ones
  void find(const Configuration& at, const std::vector<char>& closed, bool only_lost,
            const Projections& begun, const std::vector<double>& pressure, Projections& found);

  /// Where the last `find` found a slave point whose contact is lost: behind a concave edge, open although
  /// it has penetrated; or beside all segments, although it was in contact in the iterate before or at the
  /// begin of the increment. Empty: nowhere.
  const std::string& lost() const { return lost_; }
  bool lost_behind_edge() const { return lost_behind_edge_; }

  /// Are slave and master one surface?
  bool one_surface() const { return one_surface_; }
  const LeftOut& left_out() const { return left_out_; }
  /// [slaves] self-contact: of the body at the begin of the increment [L]; else empty
  std::vector<double> thickness;

private:
  /// @throws InputError where slave nodes are nodes of the master
  void refuse_self_contact(const ContactSpec& spec) const;
  /// Have two segments the same nodes: is the master a sheet without thickness, but for its height?
  /// @throws InputError where the height is none
  bool has_two_sides(const ContactSpec& spec) const;
  /// Out of the slave's body in the slave points; empty: a sheet between bodies has slaves on both sides.
  void look(const Configuration& at);
  /// Rough surfaces: the segments straight ahead, on the surface without its height.
  void find_straight(const ents_master_mesh& where, Projections& found) const;
  /// A point that was in contact at the begin of the increment, and has no segment now: an earlier iterate may
  /// have lost it.
  Lost find_lost_since_begin(const ents_master_mesh& where, const Projections& begun,
                             const std::vector<double>& pressure, const Projections& found) const;
  void describe_lost(const Lost& lost, const Configuration& at);

  ContactSides* sides_;
  Detector detector_;
  std::unique_ptr<Detector> base_detector_; ///< on the segments without their height
  LeftOut left_out_;
  bool one_surface_ = false, has_two_sides_ = false, lost_behind_edge_ = false;
  std::vector<double> normals_; ///< [slaves][d]
  int seen_ = -1;               ///< changes of the surface that the detectors have seen
  std::string lost_;
};

} // namespace host
