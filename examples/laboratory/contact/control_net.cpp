// SPDX-License-Identifier: BSD-3-Clause
#include "control_net.hpp"

#include <algorithm>

#include "toolbox/error.hpp"

namespace host {

ents_combination ControlNet::combination() const {
  auto result = ents_struct<ents_combination>();
  result.points = points();
  result.begin = begin.data(), result.nodes = nodes.data(), result.weights = weights.data();
  return result;
}

std::vector<std::int64_t> ControlNet::nodes_of(const std::int64_t* of, std::size_t count) const {
  std::vector<std::int64_t> result;
  for (std::size_t a = 0; a < count; ++a) {
    const auto point = static_cast<std::size_t>(of[a]);
    result.insert(result.end(), nodes.begin() + begin[point], nodes.begin() + begin[point + 1]);
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

std::set<std::int64_t> ControlNet::nodes_of_mesh() const {
  std::set<std::int64_t> result;
  for (const std::int64_t node : nodes) result.insert(origin(node));
  return result;
}

std::vector<double> ControlNet::positions(const std::vector<double>& of_nodes) const {
  const auto d = static_cast<std::size_t>(dimension);
  std::vector<double> result(static_cast<std::size_t>(points()) * d, 0.0);
  for (std::size_t point = 0; point + 1 < begin.size(); ++point)
    for (std::int64_t j = begin[point]; j < begin[point + 1]; ++j) {
      const std::int64_t node = nodes[static_cast<std::size_t>(j)];
      const double* x = of_nodes.data() + static_cast<std::size_t>(origin(node)) * d;
      for (std::size_t i = 0; i < d; ++i) {
        const double offset =
            node < mesh_nodes ? 0 : images[static_cast<std::size_t>(node - mesh_nodes)].offset[i];
        result[point * d + i] += weights[static_cast<std::size_t>(j)] * (sign(node, i) * x[i] + offset);
      }
    }
  return result;
}

void ControlNet::check_held(const std::vector<double>& displacement) const {
  for (const std::size_t dof : held)
    if (displacement[dof] != 0)
      throw JobError("contact: node " + std::to_string(dof / static_cast<std::size_t>(dimension)) +
                     " of the master has left its plane of symmetry (/contact/master/mirror); hold it with a "
                     "support");
}

} // namespace host
