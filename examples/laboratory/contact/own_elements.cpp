// SPDX-License-Identifier: BSD-3-Clause
#include "own_elements.hpp"

#include <algorithm>

#include "toolbox/error.hpp"

namespace host {

ents_input OwnElements::input(std::int64_t element) {
  const ents_master_mesh& mesh = *input_.mesh;
  const std::int64_t segment = input_.segment[element * input_.segment_stride];
  master_.clear();
  for (int a = 0; a < layout_.nodes; ++a) {
    const double* node = mesh.positions + mesh.connectivity[segment * layout_.nodes + a] * layout_.dimension;
    master_.insert(master_.end(), node, node + layout_.dimension);
  }
  ents_input one = input_;
  one.mesh = nullptr, one.segment = nullptr;
  one.master = master_.data();
  if (mesh.surface_coordinates != nullptr)
    one.surface_coordinates = mesh.surface_coordinates + segment * layout_.nodes * layout_.parameters;
  one.slave += element * input_.slave_stride;
  if (one.start != nullptr) one.start += element * input_.start_stride;
  if (one.area != nullptr) one.area += element * input_.area_stride;
  if (one.state_begin != nullptr) one.state_begin += element * input_.state_begin_stride;
  if (one.multiplier != nullptr) one.multiplier += element * input_.multiplier_stride;
  if (one.slave_values != nullptr) one.slave_values += element * input_.slave_values_stride;
  return one;
}

std::vector<OwnElements::Dof> OwnElements::dofs_of(std::int64_t element) const {
  const int d = layout_.dimension, of_nodes = layout_.dofs - layout_.multipliers;
  std::vector<Dof> dofs;
  const auto add_node = [&](int first, double weight, const std::int64_t* equations, std::int64_t node) {
    for (int i = 0; i < d; ++i) dofs.push_back({first + i, weight, equations[node * d + i]});
  };
  if (const ents_combination* points = system_.slave) {
    if (points->heights != nullptr)
      throw JobError(
          "\"slave_height\" is for the library's own assembly; elements of other programs have plain slaves");
    for (std::int64_t j = points->begin[element]; j < points->begin[element + 1]; ++j)
      add_node(0, points->weights[j], system_.slave_equations, points->nodes[j]);
  } else {
    add_node(0, 1, system_.slave_equations, element);
  }
  if (system_.pose != nullptr) {
    for (int i = 0; d + i < rows(); ++i) dofs.push_back({d + i, 1, system_.body_equations[i]});
    return dofs;
  }
  const std::int64_t* nodes =
      input_.mesh->connectivity + input_.segment[element * input_.segment_stride] * layout_.nodes;
  for (int a = 0; d * (a + 1) < of_nodes; ++a) add_node(d * (a + 1), 1, system_.master_equations, nodes[a]);
  for (int j = 0; j < layout_.multipliers; ++j)
    dofs.push_back({of_nodes + j, 1, system_.multiplier_equations[element * layout_.multipliers + j]});
  return dofs;
}

void OwnElements::add(std::int64_t element, const double* residual, const double* tangent) {
  if (system_.index_size != sizeof(int) || system_.master != nullptr)
    throw JobError(
        "elements of other programs are added to rows of 32-bit indices and to the master's own nodes only");
  const auto *begin = static_cast<const int*>(system_.row_begin),
             *columns = static_cast<const int*>(system_.columns);
  const std::vector<Dof> dofs = dofs_of(element);
  for (const Dof& row : dofs) {
    if (row.equation < 0) continue;
    if (system_.residual != nullptr) system_.residual[row.equation] += row.weight * residual[row.local];
    for (const Dof& column : dofs) {
      if (system_.values == nullptr || column.equation < 0) continue;
      const int *first = columns + begin[row.equation], *last = columns + begin[row.equation + 1];
      const int* at = std::lower_bound(first, last, static_cast<int>(column.equation));
      if (at == last || *at != column.equation)
        throw JobError("an element has no place in the tangent's pattern");
      system_.values[at - columns] += row.weight * column.weight * tangent[row.local + rows() * column.local];
    }
  }
}

} // namespace host
