// SPDX-License-Identifier: BSD-3-Clause
#include "contact_unknowns.hpp"

namespace host {

ContactUnknowns::ContactUnknowns(const Master& master, const SlavePoints& points, std::size_t mesh_dofs) {
  const auto d = static_cast<std::size_t>(master.model->layout().dimension);
  const std::size_t multiplier_count =
      static_cast<std::size_t>(master.model->layout().multipliers) * points.size();
  of_dofs.assign(mesh_dofs, -1);
  const auto add_node = [&](std::int64_t node) {
    for (std::size_t dof = static_cast<std::size_t>(node) * d, i = 0; i < d; ++i, ++dof)
      if (of_dofs[dof] < 0) {
        of_dofs[dof] = stride(dofs.size());
        dofs.push_back(dof);
      }
  };
  for (const int node : points.nodes) add_node(node);
  slave_dofs = dofs.size();
  const ControlNet* net = master.net.get();
  for (const std::int64_t node : net != nullptr ? net->nodes : master.connectivity)
    if (!master.rigid) add_node(net != nullptr ? net->origin(node) : node);
  if (master.body_node >= 0) {
    add_node(master.body_node), add_node(master.body_node + 1);
    for (std::size_t i = 0; i < (d == 2 ? 3 : 6); ++i)
      of_body.push_back(of_dofs[static_cast<std::size_t>(master.body_node) * d + i]);
  }
  // A mirror image's components along its planes are its node's; across they are unknowns of their own here,
  // which stand for the same one of the mesh with the other sign.
  signs.assign(dofs.size(), 1.0);
  of_master = of_dofs;
  for (std::size_t k = 0; net != nullptr && k < net->images.size(); ++k)
    for (std::size_t i = 0; i < d; ++i) {
      const std::size_t dof = static_cast<std::size_t>(net->images[k].node) * d + i;
      if (net->images[k].sign[i] > 0 || of_dofs[dof] < 0) {
        of_master.push_back(of_dofs[dof]);
        continue;
      }
      of_master.push_back(stride(dofs.size()));
      dofs.push_back(dof);
      signs.push_back(-1);
    }
  of_multipliers.resize(multiplier_count);
  for (std::size_t j = 0; j < multiplier_count; ++j) {
    of_multipliers[j] = stride(dofs.size());
    dofs.push_back(mesh_dofs + j);
  }
  signs.resize(dofs.size(), 1.0);
  for (const int node : points.nodes)
    for (std::size_t i = 0; i < d; ++i) of_slaves.push_back(of_dofs[static_cast<std::size_t>(node) * d + i]);
}

} // namespace host
