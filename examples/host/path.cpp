// SPDX-License-Identifier: BSD-3-Clause
#include "path.hpp"

#include "json_reader.hpp"

namespace host {

Path read_path(JsonObject& object) {
  Path path;
  if (!object.has("path")) return path;
  const JsonValue value = object.at("path");
  for (const JsonValue& item : value.items()) {
    const auto point = item.numbers(2);
    if (!path.points.empty() && !(point[0] > path.points.back()[0]))
      item.fail("load factors of a path ascend");
    path.points.push_back({point[0], point[1]});
  }
  if (path.points.empty()) value.fail("at least one point [load factor, factor] is expected");
  return path;
}

} // namespace host
