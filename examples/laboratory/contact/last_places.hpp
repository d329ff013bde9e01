// SPDX-License-Identifier: BSD-3-Clause
// Numbers as distances from others that are near, in units in the last place: few digits, and the same bits
// when they are read.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "toolbox/json_reader.hpp"

namespace host {

/// @param from,to  equally long
inline Json last_places(const std::vector<double>& from, const std::vector<double>& to) {
  Json places = Json::array();
  for (std::size_t i = 0; i < to.size(); ++i)
    places.push_back(static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(to[i]) -
                                               std::bit_cast<std::uint64_t>(from[i])));
  return places;
}

/// @throws InputError if they are not as many, or no distances from these
inline std::vector<double> from_last_places(const std::vector<double>& from, const JsonValue& places) {
  const std::vector<JsonValue> items = places.items();
  if (items.size() != from.size())
    places.fail("the checkpoint is of another scene: so many numbers are not expected");
  std::vector<double> to;
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (!items[i].json().is_number_integer()) items[i].fail("a whole number is expected");
    to.push_back(std::bit_cast<double>(std::bit_cast<std::uint64_t>(from[i]) +
                                       static_cast<std::uint64_t>(items[i].json().get<std::int64_t>())));
    if (!std::isfinite(to.back())) items[i].fail("this is no distance from the number of the checkpoint");
  }
  return to;
}

} // namespace host
