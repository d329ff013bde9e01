// SPDX-License-Identifier: BSD-3-Clause
#include "contact_area.hpp"

#include <cmath>
#include <vector>

#include "simulation.hpp"

namespace host {
namespace {

/// 1 / (1/E*_slave + 1/E*_master); a rigid master adds no compliance.
double common_modulus(const Scene& scene) {
  const double slave = contact_modulus(scene);
  const PartSpec* master = scene.contact->rigid.empty() ? part_of_set(scene, scene.contact->master) : nullptr;
  return master == nullptr ? slave : 1 / (1 / slave + 1 / contact_modulus(master->setup));
}

} // namespace

AreaEstimate estimate_area(const Simulation& simulation, const ContactFields& fields) {
  const Scene& scene = simulation.scene();
  const Contact& contact = *simulation.contact();
  const Mesh& mesh = simulation.mesh();
  const SlavePoints& slaves = contact.slaves();
  if (!slaves.are_nodes()) return {};
  const auto nodes = static_cast<std::size_t>(mesh.node_count());
  std::vector<double> gap(nodes, AreaEstimate::unknown), pressure(nodes, 0.0);
  for (std::size_t k = 0; k < slaves.size(); ++k) {
    gap[static_cast<std::size_t>(slaves.nodes[k])] = fields.gap[k];
    pressure[static_cast<std::size_t>(slaves.nodes[k])] = fields.pressure[k];
  }
  const std::vector<Face>& faces = mesh.face_sets.at(scene.contact->slave);
  for (const Face& face : faces) // tied nodes are one slave node
    for (int a = 0; a < face.count; ++a) {
      const auto node = static_cast<std::size_t>(face.nodes[static_cast<std::size_t>(a)]);
      const auto owner = static_cast<std::size_t>(simulation.dofs().representative(static_cast<int>(node)));
      gap[node] = gap[owner], pressure[node] = pressure[owner];
    }
  const ElementSetup& setup = scene.parts.front().setup;
  const double thickness = setup.formulation == Formulation::axisymmetric ? 0 : setup.thickness;
  const ents::Library& library = contact.master().model->library();
  auto sum = ents_struct<ents_area>();
  for (const auto& [count, name] : {std::pair(2, "line2"), std::pair(3, "tri3"), std::pair(4, "quad4")}) {
    std::vector<std::int64_t> connectivity;
    for (const Face& face : faces)
      if (face.count == count)
        connectivity.insert(connectivity.end(), face.nodes.begin(), face.nodes.begin() + face.count);
    if (connectivity.empty()) continue;
    auto area = ents_struct<ents_area>();
    auto report = ents_struct<ents_report>();
    const std::int32_t status =
        library.contact_area(name, static_cast<std::int64_t>(connectivity.size()) / count,
                             connectivity.data(), mesh.node_count(), mesh.coordinates.data(), thickness,
                             gap.data(), pressure.data(), common_modulus(scene), &area, &report);
    if (status != ENTS_OK) throw JobError("contact area: " + describe(library, status, report));
    sum.surface += area.surface, sum.estimate += area.estimate, sum.error += area.error;
    sum.border_corrected += area.border_corrected, sum.zero_line += area.zero_line;
    if (area.peak_pressure > sum.peak_pressure)
      sum.peak_pressure = area.peak_pressure, sum.peak_drop = area.peak_drop;
  }
  const double error = simulation.resolution().too_coarse() ? AreaEstimate::unknown : sum.error / sum.surface;
  return {sum.estimate / sum.surface, error, sum.border_corrected / sum.surface, sum.zero_line / sum.surface,
          sum.peak_drop};
}

} // namespace host
