// SPDX-License-Identifier: BSD-3-Clause
// What result.json and the files for ParaView have in common in this program and in the laboratory.
#pragma once

#include <vector>

#include <ents.h>

#include "mesh.hpp"
#include "toolbox/json_reader.hpp"
#include "toolbox/vtu.hpp"

namespace host {

/// What the slave points carry together, of this mesh.
inline Json resultants_json(const ents_resultants& sum, int dimension) {
  const auto vector = [](const double* from, int size) { return std::vector<double>(from, from + size); };
  return {{"normal", vector(sum.normal, dimension)},
          {"tangential", vector(sum.tangential, dimension)},
          {"moment", vector(sum.moment, dimension == 2 ? 1 : 3)},
          {"centre", vector(sum.centre, dimension)},
          {"area", sum.area},
          {"largest_pressure", sum.largest_pressure},
          {"open", sum.open},
          {"contact", sum.contact},
          {"stick", sum.stick},
          {"slip", sum.slip}};
}

/// The bodies, without data. @param nodes  so many of the mesh are theirs
inline vtu::Grid grid_of(const Mesh& mesh, int nodes) {
  vtu::Grid grid;
  grid.dimension = mesh.dimension;
  grid.points.assign(mesh.coordinates.begin(), mesh.coordinates.begin() + nodes * mesh.dimension);
  for (const ElementGroup& group : mesh.groups)
    grid.add_cells(ents_deck::vtk_type(traits(group.type).shape),
                   static_cast<std::size_t>(node_count(group.type)), group.nodes);
  return grid;
}

} // namespace host
