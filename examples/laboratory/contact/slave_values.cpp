// SPDX-License-Identifier: BSD-3-Clause
#include "slave_values.hpp"

#include <algorithm>
#include <cmath>

#include "contact_sides.hpp"

namespace host {

SlaveValues::SlaveValues(const ContactSides& sides, const ContactSpec& spec, bool turns) {
  const SlavePoints& points = sides.points;
  const bool own = !points.scales.empty(), scaled = spec.law_scale || own;
  if (scaled) each_ = 4;
  if (!turns && spec.wear_factor.points.empty() && !sides.master.profile && !scaled) return;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto place = points.place(k, *sides.bodies);
    for (const double value : {own ? points.offsets[k] : 0.0, 1.0, turns ? std::abs(place[0]) : 1.0})
      values_.push_back(value);
    if (scaled) values_.push_back(own ? points.scales[k] : spec.law_scale(place[0], place[1]));
  }
}

double SlaveValues::largest_arm() const {
  double largest = values_.empty() ? 1 : 0;
  for (std::size_t i = 2; i < values_.size(); i += each_) largest = std::max(largest, values_[i]);
  return largest;
}

} // namespace host
