// SPDX-License-Identifier: BSD-3-Clause
// The VTU series of a run.
#include <algorithm>
#include <cmath>

#include "output.hpp"
#include "result.hpp"

namespace host {
namespace {

/// The last nodes of the mesh, which no element has.
int nodes_of_rigid_body(const Simulation& simulation) {
  return simulation.contact() != nullptr && simulation.contact()->master().body_node >= 0 ? 2 : 0;
}

vtu::Grid bulk_grid(const Simulation& simulation) {
  const Mesh& mesh = simulation.mesh();
  const UnitNames& units = simulation.scene().units;
  const int nodes = mesh.node_count() - nodes_of_rigid_body(simulation);
  vtu::Grid grid = grid_of(mesh, nodes);
  const std::vector<double>& moved = simulation.now().displacement;
  grid.point_data.push_back({with_unit("displacement", units.length),
                             mesh.dimension,
                             {moved.begin(), moved.begin() + nodes * mesh.dimension}});
  if (mesh.groups.empty()) { // a layer: its surface, and no stress below it
    for (const Face& face : mesh.face_sets.at(simulation.scene().parts.front().name + ".z_max"))
      grid.add_cells(vtu::quad, 4, face.nodes);
    return grid;
  }
  std::vector<double> stress = simulation.bulk().nodal_stress(moved);
  const std::size_t components = mesh.dimension == 3 ? 6 : 4;
  stress.resize(static_cast<std::size_t>(nodes) * components);
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
  vtu::Grid grid;
  grid.dimension = d;
  grid.add_surface(n1, n2, sample.point);
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
    if (master.body_node >= 0) contact.frame().to_space(sample.point);
    grid.add_surface(static_cast<int>(n) + 1, d == 2 ? 1 : static_cast<int>(n) + 1, sample.point);
    height.insert(height.end(), sample.height.begin(), sample.height.end());
  }
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
