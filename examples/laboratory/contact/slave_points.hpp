// SPDX-License-Identifier: BSD-3-Clause
// The slave side of a contact: its nodes, or sampling points inside its faces.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "dof_map.hpp"
#include "ents_library.hpp"
#include "mesh.hpp"
#include "surface_coordinates.hpp"

namespace host {

/// Points that are combinations of nodes of the mesh, the same number for each.
struct SlavePoints {
  std::size_t nodes_per_point = 1;
  std::vector<int> nodes;      ///< [points][nodes_per_point]
  std::vector<double> weights; ///< [points][nodes_per_point]
  std::vector<double> areas;   ///< [points]
  std::vector<double>
      heights; ///< [points] above their faces, along normals that turn with them [L]; empty: in them
  std::vector<double> slopes; ///< [points][nodes_per_point][d-1] of the weights, with heights
  /// Where several points stand at one place, as the springs of its law do: the first of each place, and the
  /// number of points; empty: every point is a place.
  std::vector<std::size_t> places;
  /// [points] of the law "table", ents_input.slave_values[0] and [3]; or empty.
  std::vector<double> offsets, scales;

  std::size_t size() const { return areas.size(); }
  bool are_nodes() const { return nodes_per_point == 1; }

  /// Sum of the weights times a field [mesh nodes][d].
  std::array<double, 3> combine(std::size_t point, const std::vector<double>& field, std::size_t d) const;
  /// Place in the undeformed face, below the point if it has a height.
  std::array<double, 3> place(std::size_t point, const Mesh& mesh) const;
  /// As the library takes them. `begin` [points + 1] and `nodes` are filled, and have to live as long
  ents_combination combination(std::vector<std::int64_t>& begin, std::vector<std::int64_t>& nodes) const;
};

/// What areas are made of.
struct SlaveGeometry {
  double thickness = 1;
  bool axisymmetric = false;
  bool equal = false; ///< nodes: all the same area, wherever they are
};

/// The most nodes that one of the faces has: of each in connectivity_of().
std::size_t count_of_nodes(const std::vector<Face>& faces);

/// The nodes of the faces with their tributary areas; tied nodes are one.
SlavePoints slave_nodes(const Mesh& mesh, const DofMap& dofs, const std::vector<Face>& faces,
                        const SlaveGeometry& geometry);

/// `per_direction` points per direction inside every face, from the library.
/// @throws InputError if the faces are not all of one kind
SlavePoints sampling_points(const EntsLibrary& library, const Mesh& mesh, const std::vector<Face>& faces,
                            int per_direction, const SlaveGeometry& geometry, const std::string& where);

struct ContactSpec;

/// The height of the slave's faces: the scene's "slave_height". Its fields change, if the model wears.
class SlaveSurface {
public:
  /// @param folder  where relative names of height maps start
  /// @throws InputError with the library's message
  SlaveSurface(const EntsLibrary& library, const ContactSpec& spec, const std::filesystem::path& folder,
               const Mesh& mesh);
  /// Points inside faces get its heights.
  void raise(SlavePoints& points) const;
  /// Blocks of its fields by name: see EntsModel::fields. Give new ones to `take`.
  const std::map<std::string, std::vector<double>>& fields() const { return model_.fields(); }
  void take(const std::map<std::string, std::vector<double>>& fields);
  /// What the slave has lost goes from states into the first field.
  /// @param model      of the contact
  /// @param thickness  2D: of the bodies; axisymmetric ones: 0
  /// @param state      [points][state_size]
  void collect(const EntsModel& model, const SlavePoints& points, double thickness,
               std::vector<double>& state);

private:
  /// Surface coordinates of the nodes of all points; empty: natural ones.
  std::vector<double> coordinates(const SlavePoints& points, const std::vector<std::int64_t>& nodes) const;

  const Mesh* mesh_;
  CoordinateRule rule_;
  std::string where_;
  EntsModel model_;
};

} // namespace host
