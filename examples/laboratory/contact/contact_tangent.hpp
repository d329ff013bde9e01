// SPDX-License-Identifier: BSD-3-Clause
// The tangent of all contact elements: its unknowns, its pattern for a choice of segments, and what is made of it.
#pragma once

#include <cstdint>
#include <vector>

#include "contact_sides.hpp"
#include "contact_unknowns.hpp"
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

class ContactTangent {
public:
  /// @param sides  has to live as long
  explicit ContactTangent(const ContactSides& sides) : sides_(&sides) {}

  /// For points that have been nowhere yet.
  void reset();
  const ContactUnknowns& unknowns() const { return unknowns_; }
  /// Over `unknowns`, compressed rows.
  const SparseMatrix& matrix() const { return matrix_; }

  /// The pattern for these segments of the points.
  void build(const std::vector<std::int64_t>& segments);
  /// Is the pattern that of these segments?
  bool is_for(const std::vector<std::int64_t>& segments) const { return segments == segments_; }
  /// It is that of none.
  void forget() { segments_.clear(); }

  /// Zero entries, which the library's elements are to be added to.
  void receive(ents_system& system);
  /// Places of entries, which the library keeps from call to call, where it can.
  void lend_places(ents_system& system);
  /// Mirror images move against their nodes: the signs of their unknowns go into the entries; and a body that turns
  /// has columns for the displacements of its second node.
  void turn(const Configuration& at);

  /// residual += tangent times displacements [dofs].
  void add_times(const std::vector<double>& direction, std::vector<double>& residual) const;
  /// Rows that may make the tangent indefinite get a diagonal as large as the sum of the sizes of their other entries
  /// (Gershgorin).
  /// @param every_row  false: only those whose diagonal is negative
  /// @param coupling   optional, becomes that of the changed tangent
  /// @return what has been added, of the tangent's pattern
  SparseMatrix make_definite(bool every_row, RigidCoupling* coupling);
  /// The tangent's part of the coupling.
  void couple(RigidCoupling& coupling) const;

private:
  void turn_images();

  const ContactSides* sides_;
  ContactUnknowns unknowns_;
  std::vector<std::int64_t> segments_, places_;
  SparseMatrix matrix_;
};

} // namespace host
