// SPDX-License-Identifier: BSD-3-Clause
// The VTU series of a run.
#include <algorithm>
#include <cmath>

#include "result.hpp"

namespace host {
namespace {

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + " [" + unit + "]";
}

/// The last nodes of the mesh, which no element has.
int nodes_of_rigid_body(const Simulation& simulation) {
  return simulation.contact() != nullptr && simulation.contact()->master().body_node >= 0 ? 2 : 0;
}

vtu::Grid bulk_grid(const Simulation& simulation) {
  const Mesh& mesh = simulation.mesh();
  const UnitNames& units = simulation.scene().units;
  vtu::Grid grid;
  grid.dimension = mesh.dimension;
  const auto of_bodies = static_cast<std::size_t>(mesh.dimension) *
                         static_cast<std::size_t>(mesh.node_count() - nodes_of_rigid_body(simulation));
  grid.points.assign(mesh.coordinates.begin(),
                     mesh.coordinates.begin() + static_cast<std::ptrdiff_t>(of_bodies));
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
  const std::vector<double>& moved = simulation.now().displacement;
  grid.point_data.push_back({with_unit("displacement", units.length),
                             mesh.dimension,
                             {moved.begin(), moved.begin() + static_cast<std::ptrdiff_t>(of_bodies)}});
  if (mesh.groups.empty()) { // a layer: its surface, and no stress below it
    vtu::Cells cells;
    cells.type = vtu::Cell::quad;
    cells.nodes_per_cell = 4;
    for (const Face& face : mesh.face_sets.at(simulation.scene().parts.front().name + ".z_max"))
      cells.connectivity.insert(cells.connectivity.end(), face.nodes.begin(), face.nodes.end());
    grid.cells.push_back(std::move(cells));
    return grid;
  }
  std::vector<double> stress = simulation.bulk().nodal_stress(moved);
  const std::size_t components = mesh.dimension == 3 ? 6 : 4;
  stress.resize(of_bodies / static_cast<std::size_t>(mesh.dimension) * components);
  grid.point_data.push_back(
      {with_unit("stress", units.pressure), static_cast<int>(components), std::move(stress)});
  return grid;
}

vtu::Grid slave_grid(Simulation& simulation, const StepRecord& record) {
  const UnitNames& units = simulation.scene().units;
  const int d = simulation.mesh().dimension;
  vtu::Grid grid = vtu::point_cloud(d, record.positions);
  grid.point_data.push_back({with_unit("gap", units.length), 1, record.fields.gap});
  grid.point_data.push_back({with_unit("pressure", units.pressure), 1, record.fields.pressure});
  grid.point_data.push_back({"normal", d, record.fields.normal});
  grid.point_data.push_back({"area", 1, record.areas});
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

/// Nodes or control points of the master, where they are now; those of a rigid body in its own frame.
std::vector<double> present_points(const Simulation& simulation, const Master& master) {
  const auto d = static_cast<std::size_t>(simulation.mesh().dimension);
  std::vector<double> points = master.rigid ? master.positions : simulation.mesh().coordinates;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!master.rigid)
      points[i] += simulation.now().displacement[i];
    else if (master.body_node < 0)
      points[i] += simulation.now().motion * master.direction[i % d];
  return master.net ? master.net->positions(points) : points;
}

/// Divisions of a segment along each direction: plain segments are drawn as they are, others as smooth as so
/// many cells allow.
std::size_t divisions_of(const Master& master, std::size_t d) {
  const ents_layout& layout = master.model->layout();
  const bool plain = layout.nodes == (d == 2 ? 2 : master.triangles ? 3 : 4) && !master.base;
  if (plain) return 1;
  const std::size_t segments = std::max<std::size_t>(master.segments(), 1);
  if (d == 2) return std::clamp<std::size_t>(8000 / segments, 2, 200);
  return std::clamp<std::size_t>(static_cast<std::size_t>(std::sqrt(40000. / static_cast<double>(segments))),
                                 2, 24);
}

/// rho_e of all segments, where they are now.
vtu::Grid segments_grid(Simulation& simulation) {
  const Contact& contact = *simulation.contact();
  const Master& master = contact.master();
  const auto d = static_cast<std::size_t>(simulation.mesh().dimension),
             m = static_cast<std::size_t>(master.model->layout().nodes);
  const std::size_t n = divisions_of(master, d);
  const std::vector<double> xi = even_grid(static_cast<int>(d) - 1, n, master.triangles),
                            points = present_points(simulation, master);
  vtu::Grid grid;
  grid.dimension = static_cast<int>(d);
  vtu::Cells cells;
  cells.type = d == 2 ? vtu::Cell::line : vtu::Cell::quad;
  cells.nodes_per_cell = d == 2 ? 2 : 4;
  std::vector<double> height;
  for (std::size_t s = 0; s < master.segments(); ++s) {
    std::vector<double> nodes, coordinates;
    for (std::size_t a = 0; a < m; ++a)
      for (std::size_t i = 0; i < d; ++i)
        nodes.push_back(points[static_cast<std::size_t>(master.connectivity[s * m + a]) * d + i]);
    if (!master.surface_coordinates.empty())
      coordinates.assign(master.surface_coordinates.begin() + static_cast<std::ptrdiff_t>(s * m * (d - 1)),
                         master.surface_coordinates.begin() +
                             static_cast<std::ptrdiff_t>((s + 1) * m * (d - 1)));
    SurfaceSample sample = sample_surface(*master.model, nodes, coordinates, xi);
    if (master.body_node >= 0) contact.to_space(sample.point);
    const auto first = static_cast<std::int64_t>(grid.points.size() / d),
               row = static_cast<std::int64_t>(n + 1);
    grid.points.insert(grid.points.end(), sample.point.begin(), sample.point.end());
    height.insert(height.end(), sample.height.begin(), sample.height.end());
    for (std::int64_t j = 0; j < (d == 2 ? 1 : row - 1); ++j)
      for (std::int64_t i = 0; i + 1 < row; ++i) {
        const std::int64_t corner = first + j * row + i;
        cells.connectivity.insert(cells.connectivity.end(), {corner, corner + 1});
        if (d == 3) cells.connectivity.insert(cells.connectivity.end(), {corner + row + 1, corner + row});
      }
  }
  grid.cells.push_back(std::move(cells));
  grid.point_data.push_back({with_unit("height", simulation.scene().units.length), 1, std::move(height)});
  return grid;
}

} // namespace

vtu::Grid master_grid(Simulation& simulation) {
  const Master& master = simulation.contact()->master();
  return master.rigid && master.body_node < 0 && master.segments() == 1 && !master.triangles
             ? surface_grid(simulation)
             : segments_grid(simulation);
}

std::vector<std::function<void()>> parts_of_step(vtu::Series& series, Simulation& simulation,
                                                 const StepRecord& record) {
  const auto part = [&](const char* name, auto grid) {
    return [&series, &record, name, grid] { series.add(record.step, record.value, name, grid()); };
  };
  std::vector<std::function<void()>> parts{part("bulk", [&] { return bulk_grid(simulation); })};
  if (simulation.contact() != nullptr) {
    parts.push_back(part("slave", [&] { return slave_grid(simulation, record); }));
    parts.push_back(part("surface", [&] { return master_grid(simulation); }));
  }
  parts.push_back([&series] { series.write_list(); });
  return parts;
}

} // namespace host
