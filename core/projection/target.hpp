// SPDX-License-Identifier: BSD-3-Clause
// The ray of an element, made from its model and its slave node.
#pragma once

#include "core/model/plan.hpp"
#include "core/projection/projection.hpp"

namespace ents::ENTS_ISA {

// The ray of this element. False if the slave sits on the emitter.
template <int D> ENTS_INLINE bool set_target(const Plan& plan, const double* slave, Target& t) {
  t.kind = plan.projection;
  t.inverse_distance = 0.0;
  for (int c = 0; c < D; ++c) t.ray[c] = plan.ray[c];
  if (plan.projection != ProjectionKind::shadow_point) return true;
  Vec<double, D> r;
  for (int c = 0; c < D; ++c) r[c] = plan.ray[c] - slave[c];
  const double length = square_root(dot(r, r));
  if (!(length > 1e-150) || !(length < 1e150)) return false;
  t.inverse_distance = 1.0 / length;
  for (int c = 0; c < D; ++c) t.ray[c] = r[c] * t.inverse_distance;
  return true;
}

} // namespace ents::ENTS_ISA
