// SPDX-License-Identifier: BSD-3-Clause
#include "smoothing.hpp"

#include <map>

#include "error.hpp"

namespace host {

std::vector<int> smoothed_lines(const std::vector<Face>& faces, const std::string& where) {
  std::map<int, int> next, previous;
  for (const Face& face : faces) {
    const bool first = next.emplace(face.nodes[0], face.nodes[1]).second;
    const bool second = previous.emplace(face.nodes[1], face.nodes[0]).second;
    if (!first || !second) throw InputError(where + ": the faces are no chain: more than two meet in a node");
  }
  std::vector<int> nodes;
  for (const Face& face : faces) {
    const auto before = previous.find(face.nodes[0]), after = next.find(face.nodes[1]);
    nodes.push_back(before == previous.end() ? face.nodes[0] : before->second);
    nodes.push_back(face.nodes[0]);
    nodes.push_back(face.nodes[1]);
    nodes.push_back(after == next.end() ? face.nodes[1] : after->second);
  }
  return nodes;
}

} // namespace host
