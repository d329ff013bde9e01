// SPDX-License-Identifier: BSD-3-Clause
// The law of one contact point, for hosts that know gap and slip but no segment: the model's height on a flat
// rigid face under the point, which the point has moved over by the slip.
#pragma once

#include "element.hpp"

namespace ents_adapter {

/// Properties: 1 model number, 2 half the face's length [L] (longer than any slip), 3 options.
struct Point {
  const Host* host = nullptr;
  std::int64_t number = -1;
  int directions = 0; ///< 2 or 3: normal, then tangents
  const double* closing =
      nullptr; ///< [directions] penetration of the face without height (> 0), then slip, [L]
  const double* change = nullptr;      ///< [directions] or null: what of `closing` belongs to this increment
  const double* temperature = nullptr; ///< [2] of the point and of the face under it, for models with "heat"
  double time_increment = 0;
  const double* start = nullptr; ///< [directions-1] surface coordinates of the point where it has not slipped
  Row<const double> properties;
  int property_count = 0;
  Row<const double> history; ///< begin of the increment, may be the same memory as `history_end`
  int history_size = 0;
  // Out, all written.
  double* traction =
      nullptr; ///< [directions] pressure (> 0), then tangential, [F/A]; work-conjugate to `closing`
  double* stiffness = nullptr; ///< [directions][directions] column-major d traction / d closing
  Row<double> history_end;
  double* energy = nullptr;              ///< [1] [F L/A] stored
  double* dissipation = nullptr;         ///< [1] [F L/A] of friction in this increment
  double* flux = nullptr;                ///< [2] [power/A] into the point and into the face
  double* flux_by_temperature = nullptr; ///< [2][2] column-major d flux / d temperature
  double* flux_by_closing = nullptr;     ///< [2][directions] column-major d flux / d closing
};

Result evaluate(const Point& point);

} // namespace ents_adapter
