// SPDX-License-Identifier: BSD-3-Clause
// What a ray from a point adds to the tangent: it turns when the slave moves.
#pragma once

#include "core/tangent/contact_point.hpp"

namespace ents::ENTS_ISA {

// The terms of a ray that turns with the slave: matrix += - [dg (C . de)^T + its transpose] - g C . DD'e
template <int D, class Array>
ENTS_INLINE void add_turning_ray(const Vec<double, D>& covector, const Ray<double, D>& ray, double gap,
                                 const Array& dg, int dofs, double* out, std::int64_t leading) {
  const double q = ray.inverse_distance, along = dot(covector, ray.e);
  if (q == 0.0) return;
  const Vec<double, D> r = variation_of_ray(covector, ray);
  for (int j = 0; j < D; ++j)
    for (int i = 0; i < dofs; ++i) {
      const double mixed = -r[j] * dg[i];
      out[j * leading + i] += mixed;
      out[i * leading + j] += mixed;
    }
  for (int j = 0; j < D; ++j)
    for (int i = 0; i < D; ++i) {
      const double projector = (i == j ? 1.0 : 0.0) - ray.e[i] * ray.e[j];
      out[j * leading + i] -= gap * (q * (r[i] * ray.e[j] + ray.e[i] * r[j]) - along * q * q * projector);
    }
}

} // namespace ents::ENTS_ISA
