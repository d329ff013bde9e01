// SPDX-License-Identifier: BSD-3-Clause
// Temperatures of the bodies: steady conduction, and thermal expansion of linear elastic ones. They stand behind all
// displacements, one per node, as changes of the scene's "temperature".
#pragma once

#include <vector>

#include "bulk.hpp"

namespace host {

class Heat {
public:
  /// @param setups  one per part of the mesh, of materials with a conductivity
  /// @param start   temperature from which `values` are counted
  Heat(const Mesh& mesh, const std::vector<ElementSetup>& setups, double start)
      : mesh_(&mesh), setups_(setups), start_(start) {}

  /// Add the power that leaves each node and the stress of expansion to `residual`, hand the elements' tangents on.
  /// @param values     [dofs] displacements and changes of temperature
  /// @param direction  [dofs] or empty: adds tangent * direction to the residual
  /// @return the size of the powers before they cancel in the elements: [power]
  double assemble(const std::vector<double>& values, const std::vector<double>& direction,
                  std::vector<double>& residual, const AddTangent& add) const;

private:
  template <ElementType Type>
  double assemble_group(std::size_t group, const std::vector<double>& values,
                        const std::vector<double>& direction, std::vector<double>& residual,
                        const AddTangent& add) const;

  const Mesh* mesh_;
  std::vector<ElementSetup> setups_;
  double start_;
};

} // namespace host
