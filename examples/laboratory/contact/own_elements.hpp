// SPDX-License-Identifier: BSD-3-Clause
// ents_assemble with residuals and tangents that other code computes: an adapter, or automatic
// differentiation.
#pragma once

#include <vector>

#include "ents_library.hpp"

namespace host {

/// The equations of one call of ents_assemble, element by element. Slave points may be combinations of nodes,
/// master nodes may not.
class OwnElements {
public:
  OwnElements(const ents_layout& layout, const ents_input& input, const ents_system& system)
      : layout_(layout), input_(input), system_(system) {}

  bool has_segment(std::int64_t element) const {
    return input_.segment[element * input_.segment_stride] >= 0;
  }
  /// The input of this element as that of a single one, number 0, which stands alone: no mesh. Valid until
  /// the next call.
  ents_input input(std::int64_t element);
  /// Unknowns of an element; with a rigid body that turns those of slave, reference point and spin.
  int rows() const { return system_.pose == nullptr ? layout_.dofs : layout_.dimension == 2 ? 5 : 9; }
  /// @param residual  [rows]; not read if the system wants none
  /// @param tangent   [rows][rows] column-major; not read if the system wants none
  void add(std::int64_t element, const double* residual, const double* tangent);

private:
  struct Dof {
    int local;
    double weight;
    std::int64_t equation;
  };
  std::vector<Dof> dofs_of(std::int64_t element) const;

  const ents_layout& layout_;
  const ents_input& input_;
  const ents_system& system_;
  std::vector<double> master_;
};

} // namespace host
