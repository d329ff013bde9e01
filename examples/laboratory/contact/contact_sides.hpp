// SPDX-License-Identifier: BSD-3-Clause
// Both sides of a contact: where slave points and master are, now and at the begin of the increment, and the library's
// model with the parameters of now.
#pragma once

#include <memory>
#include <vector>

#include "configuration.hpp"
#include "cut_points.hpp"
#include "dof_map.hpp"
#include "master.hpp"
#include "master_frame.hpp"
#include "slave_points.hpp"

namespace host {

/// The slave's faces, and how its points are made anew where an increment begins: see cut_points.hpp.
struct CutSpec {
  std::vector<Face> faces;
  SlaveGeometry geometry;
  int per_direction = 0;                 ///< 0: the slave points are given and stay
  std::shared_ptr<SlaveSurface> surface; ///< what puts the points above their faces; null: they are in them
};

class ContactSides {
public:
  /// @param points   without a cut
  /// @param sliding  name of the model's parameter that is the distance slid; null: none is
  ContactSides(Master master, const Mesh& mesh, const DofMap& dofs, SlavePoints points, CutSpec cut,
               const Json& sliding);
  ContactSides(const ContactSides&) = delete; // the frame knows the master by its address
  ContactSides& operator=(const ContactSides&) = delete;

  Master master;
  MasterFrame frame;
  const Mesh* bodies;
  const DofMap* dofs;
  CutSpec cut;
  SlavePoints points;
  std::size_t d, m, parameters, multipliers, state_size; ///< of the model's layout
  double size = 0;     ///< diagonal of the box round the slave nodes: what penetrations are measured by
  Configuration begin; ///< where the increment began
  std::vector<double> master_begin; ///< positions there, of a rigid master in its frame
  std::vector<double> slave_begin;  ///< the same of the slave points, if somebody needs it
  std::vector<double> slave_now, master_now, multiplier_now; ///< where `place` put them

  std::size_t mesh_dofs() const { return static_cast<std::size_t>(dofs->dofs()); }
  std::int64_t count() const { return stride(points.size()); }
  const ents_layout& layout() const { return master.model->layout(); }
  const ents::Library& library() const { return master.model->library(); }
  bool has_history() const { return (layout().needs & ENTS_NEEDS_HISTORY) != 0; }

  /// An increment begins here. @param slaves  shall the positions of the slave points be kept, too?
  void begin_increment(const Configuration& at, bool slaves);
  /// The model with the parameters of a configuration, and what has been slid since the begin of the increment.
  void bind(const Configuration& at);
  /// The fields of the model are others now.
  void unbind() { bound_.clear(); }
  /// So often have parameters changed the master's surface.
  int surface_changes() const { return surface_changes_; }
  /// The model with the parameters of a configuration; slave and master positions; those of a rigid master stay, and
  /// the slaves move against it.
  void place(const Configuration& at);
  /// Distance slid beside the motion of the mesh until the begin of the increment; round an axis the angle.
  double slid() const;
  /// Has the model a parameter that is the distance slid?
  bool slides() const { return sliding_ < master.model->parameters().size(); }

  /// The master as `place` put it.
  ents_master_mesh mesh() const;
  /// The master's side of a system of equations: all nodes, with the net's combination.
  void set_master(ents_system& system, ents_combination& net,
                  const std::vector<std::int64_t>& equations) const;
  /// Nodes [m][d] of a segment at the begin of the increment.
  void gather(std::int64_t segment, std::vector<double>& positions) const;
  /// Surface coordinates [m][d-1] of a segment; null: the model's own, else s = xi.
  const double* coordinates(std::int64_t segment) const;
  /// Points of a segment at the begin of the increment. @param model  the master's, or its profile
  SurfaceSample sample(const EntsModel& model, std::int64_t segment, const std::vector<double>& xi) const;

  /// Current positions of the mesh's nodes [nodes][d], and of the slave points [slaves][d].
  std::vector<double> nodes_at(const std::vector<double>& displacement) const;
  std::vector<double> positions(const std::vector<double>& displacement) const;
  /// Out of the slave's body in the slave points, [points][d] of any length, as the master sees them.
  std::vector<double> slave_normals(const Configuration& at);

  /// Cut the slave faces there.
  /// @param again  also where the points are those of this configuration already
  /// @return false: they are, and stay
  bool cut_points_at(const Configuration& at, bool again);

private:
  /// Positions of the slave points; of a rigid master that moves in its frame.
  std::vector<double> slave_points(const Configuration& at);
  /// Positions of the master's nodes or control points, [n][d], for displacements of the mesh.
  std::vector<double> master_points(const std::vector<double>& displacement) const;
  SegmentCorners segment_corners() const;

  Configuration cut_at_;      ///< where the points were cut
  std::size_t sliding_ = 0;   ///< the parameter that is the distance slid; behind the last one: none is
  std::vector<double> bound_; ///< parameters of the model at present
  int surface_changes_ = 0;
};

} // namespace host
