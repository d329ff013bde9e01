// SPDX-License-Identifier: BSD-3-Clause
// Numbers that a slave node has of its own.
#pragma once

#include "core/law/contact_law.hpp"
#include "core/model/status.hpp"

namespace ents::ENTS_ISA {

// null: none
ENTS_INLINE Status check_slave_values(const ContactLaw& law, const double* values) {
  if (!values) return Status::ok;
  double zero = 0.0;
  for (int i = 0; i < law.slave_values(); ++i) zero += 0.0 * values[i];
  if (!(zero == 0.0)) return Status::non_finite;
  constexpr double smallest_scale = 1e-30, largest_scale = 1e30;
  if (law.has_scale &&
      !(values[slave_value::scale] >= smallest_scale && values[slave_value::scale] <= largest_scale))
    return Status::bad_value;
  return values[slave_value::wear] >= 0.0 && values[slave_value::sliding] >= 0.0 ? Status::ok
                                                                                 : Status::bad_value;
}

} // namespace ents::ENTS_ISA
