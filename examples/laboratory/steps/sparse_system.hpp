// SPDX-License-Identifier: BSD-3-Clause
// The global tangent: its sparsity pattern is built once, every element knows where its entries go.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dof_map.hpp"
#include "mesh.hpp"
#include "toolbox/solver.hpp"

namespace host {

/// Equations of elements of one size; a negative equation (a prescribed value) has no row.
struct StencilGroup {
  int dofs = 0;
  std::vector<int> equations; ///< [elements][dofs]

  std::size_t size() const { return dofs == 0 ? 0 : equations.size() / static_cast<std::size_t>(dofs); }
};

/// Equations of the bulk elements, one group per group of the mesh. The first groups of every SparseSystem.
std::vector<StencilGroup> stencils(const Mesh& mesh, const DofMap& dofs);

/// A matrix over other unknowns, of symmetric pattern in compressed rows, that is added as a whole.
struct MatrixPart {
  const SparseMatrix* matrix = nullptr;
  std::vector<int> equations; ///< of each unknown; -1: none
};

/// Zero entries wherever a group or the part has one, and on the diagonal. Symmetric in its pattern, so that
/// the compressed columns are compressed rows, too.
/// @param lower  only the lower triangle is stored
SparseMatrix pattern_of(int size, bool lower, std::span<const StencilGroup* const> groups,
                        const MatrixPart& part = {});

class SparseSystem {
public:
  using Matrix = SparseMatrix;

  /// @param symmetric  only the lower triangle is stored
  SparseSystem(int size, bool symmetric) : size_(size), symmetric_(symmetric) {}

  /// Pattern of all groups and the part together, entries zero.
  void build(std::span<const StencilGroup* const> groups, const MatrixPart& part = {});

  bool symmetric() const { return symmetric_; }
  const Matrix& matrix() const { return matrix_; }
  std::span<double> values() { return {matrix_.valuePtr(), static_cast<std::size_t>(matrix_.nonZeros())}; }
  void set_zero() {
    for (double& value : values()) value = 0;
  }

  /// Add an element matrix; its group is the g-th of `build`.
  /// @param tangent            [dofs][dofs] column-major
  void add(std::size_t group, std::size_t element, const double* tangent);

  /// Add the part of `build`, whose pattern is the same as then.
  void add(const Matrix& part);

private:
  std::int32_t slot(int row, int column) const; ///< -1: not stored

  int size_;
  bool symmetric_;
  Matrix matrix_;
  struct Slots {
    int dofs = 0;
    std::vector<std::int32_t> at; ///< [elements][entries]; -1: no row or no column
    std::vector<char> doubled;    ///< elements in which two dofs share an equation (symmetric storage only)
  };
  std::vector<Slots> slots_;
  std::vector<std::int32_t> part_slots_; ///< of each entry
};

} // namespace host
