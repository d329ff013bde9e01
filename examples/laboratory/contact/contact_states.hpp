// SPDX-License-Identifier: BSD-3-Clause
// What a contact carries from increment to increment: projections, states and fields. Every try starts from those of the
// begin, which only an accepted increment changes: a step that is thrown away leaves nothing to undo.
#pragma once

#include <vector>

#include "contact_fields.hpp"
#include "contact_sides.hpp"
#include "detector.hpp"

namespace host {

class ContactStates {
public:
  explicit ContactStates(const ContactSides& sides) : sides_(&sides) { reset(); }

  Projections begun;         ///< at the begin of the increment
  std::vector<double> begin; ///< [slaves][state_size] there
  ContactFields accepted;    ///< there
  std::vector<double> in;    ///< [slaves][state_size] those of the begin, as seen from the present segments
  std::vector<double> out;   ///< [slaves][state_size] what the last assembly left

  /// For points that have been nowhere yet.
  void reset();
  /// An increment begins: multipliers are those of its begin.
  void begin_increment();
  /// The states of the begin, as seen from segments that were found; of open points as these see them there.
  /// @param found   present projections
  /// @param time    of the increment
  /// @param report  of a history that could not be moved: its status is positive, cut the step
  void move(const Projections& found, double time, ents_report& report);
  /// Uzawa: the forces of the last assembly become multipliers unless they are close enough.
  /// @param now      fields of the last assembly
  /// @param normal, tangential  stiffness of the law
  /// @return by how much forces and multipliers differ over the stiffness: penetration or elastic slip [L]
  double augment(const ContactFields& now, double normal, double tangential, double enough);
  /// The increment is accepted: what the last assembly left becomes the history.
  void accept(const Projections& found, ContactFields fields);

private:
  /// States of open points as their present segments see them at the begin of the increment: what touches
  /// within it slips from there.
  void find_begin(const std::vector<std::size_t>& points, const Projections& found, double time);

  const ContactSides* sides_;
  std::vector<double> pressure_, traction_; ///< [slaves], [slaves][d] multipliers of the begin states (Uzawa)
};

} // namespace host
