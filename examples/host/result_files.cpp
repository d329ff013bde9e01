// SPDX-License-Identifier: BSD-3-Clause
// The VTU series of a run.
#include <cmath>

#include "result.hpp"

namespace host {
namespace {

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + " [" + unit + "]";
}

vtu::Grid bulk_grid(const Simulation& simulation) {
  const Mesh& mesh = simulation.mesh();
  const UnitNames& units = simulation.scene().units;
  vtu::Grid grid;
  grid.dimension = mesh.dimension;
  grid.points = mesh.coordinates;
  for (const ElementGroup& group : mesh.groups) {
    vtu::Cells cells;
    cells.type = group.type == ElementType::tri3    ? vtu::Cell::triangle
                 : group.type == ElementType::quad4 ? vtu::Cell::quad
                 : group.type == ElementType::tet4  ? vtu::Cell::tetrahedron
                                                    : vtu::Cell::hexahedron;
    cells.nodes_per_cell = node_count(group.type);
    cells.connectivity.assign(group.nodes.begin(), group.nodes.end());
    grid.cells.push_back(std::move(cells));
  }
  grid.point_data.push_back(
      {with_unit("displacement", units.length), mesh.dimension, simulation.now().displacement});
  if (mesh.groups.empty()) { // a layer: its surface, and no stress below it
    vtu::Cells cells;
    cells.type = vtu::Cell::quad;
    cells.nodes_per_cell = 4;
    for (const Face& face : mesh.face_sets.at(simulation.scene().parts.front().name + ".z_max"))
      cells.connectivity.insert(cells.connectivity.end(), face.nodes.begin(), face.nodes.end());
    grid.cells.push_back(std::move(cells));
    return grid;
  }
  grid.point_data.push_back({with_unit("stress", units.pressure), mesh.dimension == 3 ? 6 : 4,
                             simulation.bulk().nodal_stress(simulation.now().displacement)});
  return grid;
}

vtu::Grid slave_grid(Simulation& simulation, const StepRecord& record) {
  const UnitNames& units = simulation.scene().units;
  const int d = simulation.mesh().dimension;
  vtu::Grid grid = vtu::point_cloud(d, record.positions);
  grid.point_data.push_back({with_unit("gap", units.length), 1, record.fields.gap});
  grid.point_data.push_back({with_unit("pressure", units.pressure), 1, record.fields.pressure});
  grid.point_data.push_back({"normal", d, record.fields.normal});
  grid.point_data.push_back({"area", 1, simulation.contact()->areas()});
  grid.point_data.push_back({with_unit("traction", units.pressure), d, record.fields.traction});
  grid.point_data.push_back({with_unit("slip", units.length), 1, record.fields.slip});
  grid.point_data.push_back({"age", 1, record.fields.age});
  if (!record.fields.worn.empty())
    grid.point_data.push_back({with_unit("worn depth", units.length), 1, record.fields.worn});
  grid.point_data.push_back({"segment", 1, {record.fields.segment.begin(), record.fields.segment.end()}});
  std::vector<double> status; // 0 open, 1 stick, 2 slip, 3 slip at the shear limit
  for (const std::int32_t flags : record.fields.flags) status.push_back(status_number(flags));
  grid.point_data.push_back({"status", 1, std::move(status)});
  return grid;
}

/// rho_e of one rigid segment, sampled so finely that it looks as smooth as it is; the border of the block
/// cuts nothing off.
vtu::Grid surface_grid(Simulation& simulation) {
  const Scene& scene = simulation.scene();
  const Master& master = simulation.contact()->master();
  const int d = scene.dimension, n1 = d == 2 ? 801 : 257, n2 = d == 2 ? 1 : n1;
  std::vector<double> positions = master.positions;
  for (std::size_t i = 0; i < positions.size(); ++i)
    positions[i] += simulation.now().motion * master.direction[i % static_cast<std::size_t>(d)];
  const SurfaceSample sample =
      sample_surface(*master.model, positions, {}, even_grid(d - 1, static_cast<std::size_t>(n1 - 1)));
  vtu::Grid grid = vtu::sampled_surface(d, n1, n2, sample.point);
  grid.point_data.push_back({with_unit("height", scene.units.length), 1, sample.height});
  grid.point_data.push_back({"normal", d, sample.normal});
  return grid;
}

/// Plain segments as they are.
vtu::Grid segments_grid(const Simulation& simulation, const Master& master) {
  const Mesh& mesh = simulation.mesh();
  const auto d = static_cast<std::size_t>(mesh.dimension);
  const auto m = static_cast<std::size_t>(master.model->layout().nodes);
  vtu::Grid grid;
  grid.dimension = mesh.dimension;
  vtu::Cells cells;
  cells.type = d == 2 ? vtu::Cell::line : master.triangles ? vtu::Cell::triangle : vtu::Cell::quad;
  cells.nodes_per_cell = d == 2 ? 2 : master.triangles ? 3 : 4;
  const auto corners = static_cast<std::size_t>(cells.nodes_per_cell);
  for (std::size_t s = 0; s < master.segments(); ++s)
    for (std::size_t a = 0; a < corners; ++a) {
      cells.connectivity.push_back(static_cast<std::int64_t>(s * corners + a));
      for (std::size_t i = 0; i < d; ++i) {
        const std::size_t dof = static_cast<std::size_t>(master.connectivity[s * m + a]) * d + i;
        grid.points.push_back(master.rigid
                                  ? master.positions[dof] + simulation.now().motion * master.direction[i]
                                  : mesh.coordinates[dof] + simulation.now().displacement[dof]);
      }
    }
  grid.cells.push_back(std::move(cells));
  return grid;
}

} // namespace

std::vector<std::function<void()>> parts_of_step(vtu::Series& series, Simulation& simulation,
                                                 const StepRecord& record) {
  const auto part = [&](const char* name, auto grid) {
    return [&series, &record, name, grid] { series.add(record.step, record.value, name, grid()); };
  };
  std::vector<std::function<void()>> parts{part("bulk", [&] { return bulk_grid(simulation); })};
  if (simulation.contact() != nullptr) {
    parts.push_back(part("slave", [&] { return slave_grid(simulation, record); }));
    parts.push_back(part("surface", [&] {
      const Master& master = simulation.contact()->master();
      return master.rigid && master.segments() == 1 && !master.triangles ? surface_grid(simulation)
                                                                         : segments_grid(simulation, master);
    }));
  }
  parts.push_back([&series] { series.write_list(); });
  return parts;
}

} // namespace host
