// SPDX-License-Identifier: BSD-3-Clause
// The bodies: assembly of all bulk elements.
#pragma once

#include <functional>
#include <vector>

#include "element.hpp"
#include "mesh.hpp"

namespace host {

/// The tangent of one element, on its way into the equations.
struct ElementTangent {
  std::size_t group, element;        ///< its place in the mesh
  std::span<const std::size_t> dofs; ///< of all nodes' dofs
  const double* values;              ///< [dofs][dofs], column by column
};
using AddTangent = std::function<void(const ElementTangent&)>;

class Bulk {
public:
  /// @param setups  one per part of the mesh
  Bulk(const Mesh& mesh, std::vector<ElementSetup> setups);

  /// Add the internal forces to `residual`, and hand the elements' tangents on, one after the other.
  /// @param displacement  [dofs] of all nodes
  /// @param direction     [dofs] or empty: adds tangent * direction to the residual (a prescribed jump)
  /// @param residual      [dofs], also of prescribed dofs: their reactions
  /// @param add           null: no tangent is wanted
  /// @param energy        optional
  /// @return false if an element is turned inside out
  bool assemble(const std::vector<double>& displacement, const std::vector<double>& direction,
                std::vector<double>& residual, const AddTangent& add, double* energy = nullptr) const;

  /// The tangent does not depend on the displacement.
  bool linear() const { return linear_; }
  const std::vector<ElementSetup>& setups() const { return setups_; }

  /// Cauchy stress xx yy zz xy yz xz (2D: xx yy zz xy) averaged to the nodes.
  /// @return [nodes][6 or 4]
  std::vector<double> nodal_stress(const std::vector<double>& displacement) const;

private:
  template <ElementType Type>
  bool assemble_group(std::size_t group, const std::vector<double>& displacement,
                      const std::vector<double>& direction, std::vector<double>& residual,
                      const AddTangent& add, double* energy) const;
  template <ElementType Type>
  void stress_of_group(const ElementGroup& group, const std::vector<double>& displacement,
                       std::vector<double>& sum, std::vector<double>& weight) const;

  const Mesh* mesh_;
  std::vector<ElementSetup> setups_;
  bool linear_ = true;
};

} // namespace host
