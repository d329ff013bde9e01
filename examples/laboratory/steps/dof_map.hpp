// SPDX-License-Identifier: BSD-3-Clause
// From degrees of freedom (node, component) to equations: prescribed ones have none, tied nodes share theirs.
#pragma once

#include <algorithm>
#include <vector>

namespace host {

class DofMap {
public:
  DofMap(int nodes, int dimension)
      : dimension_(dimension), owner_(static_cast<std::size_t>(nodes)),
        equation_(static_cast<std::size_t>(nodes * dimension), 0) {
    for (std::size_t i = 0; i < owner_.size(); ++i) owner_[i] = static_cast<int>(i);
  }

  /// Give `node` the displacement of `owner` (periodic boundaries).
  void tie(int node, int owner) {
    node = representative(node), owner = representative(owner);
    if (node != owner) owner_[static_cast<std::size_t>(std::max(node, owner))] = std::min(node, owner);
  }

  /// Prescribe one component, also of all nodes tied to this one.
  void prescribe(int node, int component) { equation_[dof(node, component)] = -1; }

  /// Number the equations in node order. Call once, after `tie` and `prescribe`.
  void number() {
    const int nodes = static_cast<int>(owner_.size());
    for (int node = 0; node < nodes; ++node)
      for (int c = 0; c < dimension_; ++c)
        if (equation_[dof(node, c)] < 0) equation_[dof(representative(node), c)] = -1;
    size_ = 0;
    for (int node = 0; node < nodes; ++node) {
      const int owner = representative(node);
      for (int c = 0; c < dimension_; ++c) {
        int& equation = equation_[dof(node, c)];
        if (owner != node)
          equation = equation_[dof(owner, c)]; // the owner has the smaller number: already done
        else if (equation >= 0)
          equation = size_++;
      }
    }
  }

  int dimension() const { return dimension_; }
  int dofs() const { return static_cast<int>(equation_.size()); }
  /// Number of equations.
  int size() const { return size_; }
  /// -1 for a prescribed degree of freedom.
  int equation(int node, int component) const { return equation_[dof(node, component)]; }
  int equation(std::size_t dof_index) const { return equation_[dof_index]; }
  int representative(int node) const {
    while (owner_[static_cast<std::size_t>(node)] != node) node = owner_[static_cast<std::size_t>(node)];
    return node;
  }

private:
  std::size_t dof(int node, int component) const {
    return static_cast<std::size_t>(node * dimension_ + component);
  }

  int dimension_, size_ = 0;
  std::vector<int> owner_, equation_;
};

} // namespace host
