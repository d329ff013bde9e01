// SPDX-License-Identifier: BSD-3-Clause
// Numbers that the model takes of each slave point: ents_input.slave_values.
#pragma once

#include <cstddef>
#include <vector>

namespace host {

struct ContactSpec;
class ContactSides;

class SlaveValues {
public:
  /// @param turns  what slides turns round an axis: the arm of a point is its radius, else 1
  SlaveValues(const ContactSides& sides, const ContactSpec& spec, bool turns);

  bool empty() const { return values_.empty(); } ///< the model needs none
  const double* data() const { return values_.data(); }
  std::size_t each() const { return each_; }
  double& offset(std::size_t point) { return values_[each_ * point]; } ///< of the law [L]
  double offset(std::size_t point) const { return values_[each_ * point]; }
  double& wear_factor(std::size_t point) { return values_[each_ * point + 1]; }
  /// 1, or round an axis the largest radius.
  double largest_arm() const;

private:
  std::vector<double> values_; ///< [points][each]
  std::size_t each_ = 3;       ///< 4: with the scale of a table
};

} // namespace host
