// SPDX-License-Identifier: BSD-3-Clause
// Node-to-segment contact: one element of the library per slave node.
#pragma once

#include <optional>
#include <vector>

#include "dof_map.hpp"
#include "master.hpp"
#include "sparse_system.hpp"

namespace host {

/// What a rigid master feels: total force along its direction of motion e, and how it and the slave forces
/// depend on its motion.  dW/d(motion) = -sum R_s . e
struct RigidCoupling {
  double force = 0;               ///< -sum R_s . e [F]; > 0 presses
  std::vector<double> column;     ///< [dofs] dR/d(motion) = -K_s e
  std::vector<double> row;        ///< [dofs] d(force)/du = -e K_s
  double diagonal = 0;            ///< d(force)/d(motion) = sum e K_s e
};

/// Fields on the slave nodes, in their order.
struct ContactFields {
  std::vector<double> gap, normal_gap, pressure; ///< [slaves]; no projection inside the segment: NaN gaps, no pressure
  std::vector<double> normal, point;             ///< [slaves][d] n_e and rho_e at the projection
  std::vector<char> closed;                      ///< [slaves] carries pressure
};

class Contact {
public:
  /// @param axisymmetric,thickness  weights of the slave nodes' tributary areas in 2D
  Contact(Master master, const Mesh& mesh, const DofMap& dofs, const std::vector<Face>& slave_faces,
          double thickness, bool axisymmetric);

  const Master& master() const { return master_; }
  const std::vector<int>& slaves() const { return slaves_; }  ///< nodes of the mesh
  const std::vector<double>& areas() const { return areas_; } ///< tributary, [slaves]
  double total_area() const;
  bool symmetric_tangent() const { return master_.model->layout().symmetric_tangent != 0; }

  /// Choose a segment for every slave node: of those near by, the one that is least outside, then the
  /// closest, then the first.
  /// @return the choice changed: the pattern of a deformable master's equations is another one
  bool choose(const std::vector<double>& displacement, double motion);

  /// Equations of the elements for the present choice.
  StencilGroup stencil() const;

  /// Add the contact forces to the residual and the tangents to the system.
  /// @param residual  [dofs]
  /// @param system    optional; its group number is `group`
  /// @param coupling  optional, rigid master only
  /// @param squared_force  sum |R_s|^2: the size of the contact forces
  /// @return status of the library; positive: cut the step, see `report`
  std::int32_t assemble(const std::vector<double>& displacement, double motion, std::vector<double>& residual,
                        SparseSystem* system, std::size_t group, RigidCoupling* coupling,
                        double& squared_force, ents_report& report);

  /// How many slave nodes the last `assemble` found open that were closed before, closed that were open, or closed on
  /// another segment: Newton's iteration is quadratic once there are none.
  int status_changes() const { return status_changes_; }

  /// The increment is accepted: what the last `assemble` left becomes the history.
  void accept();

  ContactFields fields(const std::vector<double>& displacement, double motion);

private:
  /// Slave and master positions of the active elements, one after the other.
  void gather(const std::vector<double>& displacement, double motion);
  void gather_master(std::size_t segment, const std::vector<double>& displacement, double motion,
                     double* positions) const;
  ents_input input() const;
  /// Projections on the segment without its height, for elements whose own is not known yet: the point of a rough surface
  /// straight ahead of the node, at the price of a plain segment. Searching the whole enriched one would find a closer point
  /// somewhere else, or two that are equally close.
  /// @return false: none found, the library shall search
  bool start_from_base();

  Master master_;
  const Mesh* mesh_;
  const DofMap* dofs_;
  std::size_t d_, m_, parameters_, element_dofs_, state_size_;
  std::vector<int> slaves_;
  std::vector<double> areas_;
  std::vector<int> segment_, segment_begin_; ///< [slaves] chosen; chosen when the history was written
  std::vector<double> state_begin_, state_end_; ///< [slaves][state_size]
  std::vector<int> closed_on_; ///< [slaves] segment on which the last `assemble` found the node closed; -1: open
  int status_changes_ = 0;
  // The elements of the present choice, in the order of `active_`.
  std::vector<std::size_t> active_; ///< slaves with a segment
  std::vector<double> slave_positions_, master_positions_, active_areas_, state_in_, state_out_;
  std::vector<double> last_xi_; ///< [slaves][d-1] where the projection was last, NaN: unknown
  std::vector<double> start_;   ///< [active][d-1]; empty: search
};

} // namespace host
