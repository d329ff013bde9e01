// SPDX-License-Identifier: BSD-3-Clause
// What slave and master lose by wear.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "contact_sides.hpp"
#include "contact_states.hpp"
#include "slave_values.hpp"

namespace host {

class ContactWear {
public:
  /// @param factor     of the wear coefficient over the pressure, see ContactSpec
  /// @param thickness  2D: of the bodies; axisymmetric ones: 0
  ContactWear(ContactSides& sides, Path factor, double thickness)
      : sides_(&sides), factor_(std::move(factor)), thickness_(thickness) {}

  /// Does the model wear?
  bool acts() const { return sides_->layout().worn >= 0; }
  /// An increment begins with this pressure: the factors of its wear.
  void begin_increment(const std::vector<double>& pressure, SlaveValues& values) const;
  /// An increment is accepted: what the master has lost goes from the states of the next begin into the model's field,
  /// what the slave has lost into that of its height; a side without a field keeps it there.
  /// @param input  of the elements, as they were assembled
  void collect(ents_input input, ContactStates& states);
  /// The accepted depths, from the states of the begin.
  void read_depths(ContactStates& states) const;
  /// The accepted gaps are those to the surfaces with what they have lost and no height has.
  void open_gaps(ContactStates& states) const;
  /// Volume that the slave has lost until the last accepted increment, of this mesh [L^3].
  double of_slave(const ContactStates& states) const;

  double of_master = 0; ///< the same of the master

  /// Blocks of the fields of the slave's height, and new ones.
  std::map<std::string, std::vector<double>> slave_fields() const;
  void take_slave_fields(const std::map<std::string, std::vector<double>>& fields);
  std::vector<double> given_away; ///< [slaves] depth that has gone into them [L]; empty: no wear that does

private:
  void collect_slave(ContactStates& states);

  ContactSides* sides_;
  Path factor_;
  double thickness_;
};

} // namespace host
