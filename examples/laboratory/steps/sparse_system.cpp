// SPDX-License-Identifier: BSD-3-Clause
#include "sparse_system.hpp"

#include <algorithm>

namespace host {

namespace {

/// Which elements touch an equation, as compressed lists.
struct Touching {
  std::vector<int> start, element;

  Touching(const std::vector<int>& equations, std::size_t dofs, std::size_t size) : start(size + 1, 0) {
    for (const int equation : equations)
      if (equation >= 0) ++start[static_cast<std::size_t>(equation) + 1];
    for (std::size_t i = 0; i < size; ++i) start[i + 1] += start[i];
    element.resize(static_cast<std::size_t>(start[size]));
    std::vector<int> next(start.begin(), start.end() - 1);
    for (std::size_t i = 0; i < equations.size(); ++i)
      if (const int equation = equations[i]; equation >= 0)
        element[static_cast<std::size_t>(next[static_cast<std::size_t>(equation)]++)] =
            static_cast<int>(i / dofs);
  }

  std::span<const int> of(std::size_t equation) const {
    const auto first = static_cast<std::size_t>(start[equation]),
               last = static_cast<std::size_t>(start[equation + 1]);
    return std::span(element).subspan(first, last - first);
  }
};

/// Unknowns with an entry in the same row.
std::span<const int> columns(const SparseMatrix& matrix, std::size_t row) {
  const int *begin = matrix.outerIndexPtr() + row, first = begin[0], last = begin[1];
  return {matrix.innerIndexPtr() + first, static_cast<std::size_t>(last - first)};
}

} // namespace

std::vector<StencilGroup> stencils(const Mesh& mesh, const DofMap& dofs) {
  std::vector<StencilGroup> result;
  for (const ElementGroup& group : mesh.groups) {
    StencilGroup stencil;
    stencil.dofs = node_count(group.type) * mesh.dimension;
    stencil.equations.reserve(group.nodes.size() * static_cast<std::size_t>(mesh.dimension));
    for (const int node : group.nodes)
      for (int c = 0; c < mesh.dimension; ++c) stencil.equations.push_back(dofs.equation(node, c));
    result.push_back(std::move(stencil));
  }
  return result;
}

SparseMatrix pattern_of(int size, bool lower, std::span<const StencilGroup* const> groups,
                        const MatrixPart& part) {
  const auto n = static_cast<std::size_t>(size);
  std::vector<Touching> touching;
  for (const StencilGroup* group : groups)
    touching.emplace_back(group->equations, static_cast<std::size_t>(group->dofs), n);
  const Touching part_touching(part.equations, 1, n);

  std::vector<int> outer(n + 1, 0), inner, column, seen(n, -1);
  for (std::size_t j = 0; j < n; ++j) {
    column.assign(1, static_cast<int>(j)); // the diagonal is always there
    seen[j] = static_cast<int>(j);
    const auto take = [&](int row) {
      if (row < 0 || (lower && row < static_cast<int>(j))) return;
      if (seen[static_cast<std::size_t>(row)] == static_cast<int>(j)) return;
      seen[static_cast<std::size_t>(row)] = static_cast<int>(j);
      column.push_back(row);
    };
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const auto dofs = static_cast<std::size_t>(groups[g]->dofs);
      for (const int element : touching[g].of(j))
        for (std::size_t a = 0; a < dofs; ++a)
          take(groups[g]->equations[static_cast<std::size_t>(element) * dofs + a]);
    }
    for (const int unknown : part_touching.of(j))
      for (const int other : columns(*part.matrix, static_cast<std::size_t>(unknown)))
        take(part.equations[static_cast<std::size_t>(other)]);
    std::sort(column.begin(), column.end());
    inner.insert(inner.end(), column.begin(), column.end());
    outer[j + 1] = static_cast<int>(inner.size());
  }
  SparseMatrix matrix(size, size);
  matrix.resizeNonZeros(static_cast<Eigen::Index>(inner.size()));
  std::copy(outer.begin(), outer.end(), matrix.outerIndexPtr());
  std::copy(inner.begin(), inner.end(), matrix.innerIndexPtr());
  std::fill_n(matrix.valuePtr(), matrix.nonZeros(), 0.0);
  return matrix;
}

void SparseSystem::build(std::span<const StencilGroup* const> groups, const MatrixPart& part) {
  matrix_ = pattern_of(size_, symmetric_, groups, part);
  slots_.assign(groups.size(), {});
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const auto dofs = static_cast<std::size_t>(groups[g]->dofs);
    Slots& slots = slots_[g];
    slots.dofs = groups[g]->dofs;
    slots.at.reserve(groups[g]->size() * (symmetric_ ? dofs * (dofs + 1) / 2 : dofs * dofs));
    slots.doubled.assign(groups[g]->size(), 0);
    for (std::size_t e = 0; e < groups[g]->size(); ++e) {
      const auto equations = std::span(groups[g]->equations).subspan(e * dofs, dofs);
      for (std::size_t b = 0; b < dofs; ++b)
        for (std::size_t a = symmetric_ ? b : 0; a < dofs; ++a) {
          if (a != b && equations[a] >= 0 && equations[a] == equations[b]) slots.doubled[e] = 1;
          slots.at.push_back(
              symmetric_ ? slot(std::max(equations[a], equations[b]), std::min(equations[a], equations[b]))
                         : slot(equations[a], equations[b]));
        }
    }
  }
  part_slots_.clear();
  for (std::size_t i = 0; i < part.equations.size(); ++i)
    for (const int j : columns(*part.matrix, i))
      part_slots_.push_back(slot(part.equations[i], part.equations[static_cast<std::size_t>(j)]));
}

std::int32_t SparseSystem::slot(int row, int column) const {
  if (row < 0 || column < 0 || (symmetric_ && row < column)) return -1;
  const int* begin = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column];
  const int* end = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column + 1];
  return static_cast<std::int32_t>(std::lower_bound(begin, end, row) - matrix_.innerIndexPtr());
}

void SparseSystem::add(std::size_t group, std::size_t element, const double* tangent) {
  const Slots& slots = slots_[group];
  const auto dofs = static_cast<std::size_t>(slots.dofs);
  const std::size_t entries = symmetric_ ? dofs * (dofs + 1) / 2 : dofs * dofs;
  const std::int32_t* at = slots.at.data() + element * entries;
  double* values = matrix_.valuePtr();
  for (std::size_t b = 0; b < dofs; ++b)
    for (std::size_t a = symmetric_ ? b : 0; a < dofs; ++a, ++at)
      if (*at >= 0) values[*at] += tangent[b * dofs + a];
  if (!symmetric_ || slots.doubled[element] == 0) return;
  // Two dofs of this element share an equation: both off-diagonal entries fall on the diagonal, one is
  // missing.
  at = slots.at.data() + element * entries;
  for (std::size_t b = 0; b < dofs; ++b)
    for (std::size_t a = b; a < dofs; ++a, ++at)
      // A slot on the diagonal is the first entry of its column.
      if (a != b && *at >= 0 && matrix_.outerIndexPtr()[matrix_.innerIndexPtr()[*at]] == *at)
        values[*at] += tangent[a * dofs + b];
}

void SparseSystem::add(const Matrix& part) {
  double* values = matrix_.valuePtr();
  for (std::size_t i = 0; i < part_slots_.size(); ++i)
    if (part_slots_[i] >= 0) values[part_slots_[i]] += part.valuePtr()[i];
}

} // namespace host
