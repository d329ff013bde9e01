// SPDX-License-Identifier: BSD-3-Clause
#include "sparse_system.hpp"

#include <algorithm>

namespace host {

void SparseSystem::build(std::span<const StencilGroup* const> groups) {
  const auto n = static_cast<std::size_t>(size_);
  // Which elements touch an equation, as compressed lists per group.
  struct Touching {
    std::vector<int> start, element;
  };
  std::vector<Touching> touching(groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    auto& [start, element] = touching[g];
    const auto dofs = static_cast<std::size_t>(groups[g]->dofs);
    start.assign(n + 1, 0);
    for (const int equation : groups[g]->equations)
      if (equation >= 0) ++start[static_cast<std::size_t>(equation) + 1];
    for (std::size_t i = 0; i < n; ++i) start[i + 1] += start[i];
    element.resize(static_cast<std::size_t>(start[n]));
    std::vector<int> next(start.begin(), start.end() - 1);
    for (std::size_t i = 0; i < groups[g]->equations.size(); ++i) {
      const int equation = groups[g]->equations[i];
      if (equation >= 0)
        element[static_cast<std::size_t>(next[static_cast<std::size_t>(equation)]++)] =
            static_cast<int>(i / dofs);
    }
  }

  std::vector<int> outer(n + 1, 0), inner, column, seen(n, -1);
  for (std::size_t j = 0; j < n; ++j) {
    column.assign(1, static_cast<int>(j)); // the diagonal is always there
    seen[j] = static_cast<int>(j);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const auto dofs = static_cast<std::size_t>(groups[g]->dofs);
      for (int t = touching[g].start[j]; t < touching[g].start[j + 1]; ++t) {
        const auto element = static_cast<std::size_t>(touching[g].element[static_cast<std::size_t>(t)]);
        for (std::size_t a = 0; a < dofs; ++a) {
          const int row = groups[g]->equations[element * dofs + a];
          if (row < 0 || (symmetric_ && row < static_cast<int>(j))) continue;
          if (seen[static_cast<std::size_t>(row)] == static_cast<int>(j)) continue;
          seen[static_cast<std::size_t>(row)] = static_cast<int>(j);
          column.push_back(row);
        }
      }
    }
    std::sort(column.begin(), column.end());
    inner.insert(inner.end(), column.begin(), column.end());
    outer[j + 1] = static_cast<int>(inner.size());
  }
  matrix_.resize(size_, size_);
  matrix_.resizeNonZeros(static_cast<Eigen::Index>(inner.size()));
  std::copy(outer.begin(), outer.end(), matrix_.outerIndexPtr());
  std::copy(inner.begin(), inner.end(), matrix_.innerIndexPtr());
  set_zero();

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
          slots.at.push_back(symmetric_ ? slot(std::max(equations[a], equations[b]),
                                               std::min(equations[a], equations[b]))
                                        : slot(equations[a], equations[b]));
        }
    }
  }
}

std::int32_t SparseSystem::slot(int row, int column) const {
  if (row < 0 || column < 0) return -1;
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
  // Two dofs of this element share an equation: both off-diagonal entries fall on the diagonal, one is missing.
  at = slots.at.data() + element * entries;
  for (std::size_t b = 0; b < dofs; ++b)
    for (std::size_t a = b; a < dofs; ++a, ++at)
      // A slot on the diagonal is the first entry of its column.
      if (a != b && *at >= 0 && matrix_.outerIndexPtr()[matrix_.innerIndexPtr()[*at]] == *at)
        values[*at] += tangent[a * dofs + b];
}

} // namespace host
