// SPDX-License-Identifier: BSD-3-Clause
// Where a rigid master is, and how it sees others.
#pragma once

#include <array>
#include <vector>

#include "configuration.hpp"
#include "master.hpp"
#include "toolbox/solver.hpp"

namespace host {

/// A rigid master that moves along a line, or a rigid body that moves and turns, stays where it is in a frame of its
/// own. The displacements of the body's second node are turns about the axes of space: their increment is the spin (a
/// rotation vector) that turns the body on from where the increment began.
class MasterFrame {
public:
  /// @param master  has to live as long
  explicit MasterFrame(const Master& master);

  /// Is it a rigid body that turns?
  bool turns() const { return master_->body_node >= 0; }
  /// Of such a body, at the last `see`.
  const ents_pose& pose() const { return pose_; }
  /// Positions [n][d] in space become what the master sees of them.
  void see(const Configuration& at, std::vector<double>& positions);
  /// Vectors [n][d] of the frame of a body that turns, in space.
  void turn(std::vector<double>& vectors) const;
  /// Positions [n][d] of this frame, in space.
  void to_space(std::vector<double>& points) const;
  /// Of forces [n][d] in these places, about the reference point of a body that turns: [3], 2D [1].
  std::vector<double> moment(const std::vector<double>& places, const std::vector<double>& forces) const;
  /// An increment ends here: how a body that turns lies then.
  void keep_rotation(Configuration& at) const;
  /// From columns for the spin to columns for the displacements of the body's second node.
  /// @param equations  columns of the body's displacements and of its turns
  void columns_of_turns(const Configuration& at, const std::vector<std::int64_t>& equations,
                        SparseMatrix& tangent) const;

private:
  const ents::Library& library() const;
  /// Where a rigid body is that moves and turns.
  ents_pose pose_at(const Configuration& at) const;
  /// What it has turned since the begin of the increment: a rotation vector in space, 2D one angle.
  std::array<double, 3> spin(const Configuration& at) const;

  const Master* master_;
  std::size_t d_;
  ents_pose pose_{};
};

} // namespace host
