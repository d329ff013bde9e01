// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "core/smoothing/smoothing.hpp"

namespace ents {

void collect(Terms& terms) {
  std::sort(terms.begin(), terms.end(), [](const Term& a, const Term& b) { return a.node < b.node; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < terms.size();) {
    Term sum = terms[i++];
    for (; i < terms.size() && terms[i].node == sum.node; ++i) sum.weight += terms[i].weight;
    if (sum.weight != 0.0) terms[kept++] = sum;
  }
  terms.resize(kept);
}

void Smoothed::add_nodes(std::int64_t count) {
  for (std::int64_t i = 0; i < count; ++i) {
    nodes.push_back(i), weights.push_back(1.0);
    begin.push_back(i + 1);
  }
}

std::int64_t Smoothed::add_point(const Terms& terms) {
  for (const Term& t : terms) nodes.push_back(t.node), weights.push_back(t.weight);
  begin.push_back(static_cast<std::int64_t>(nodes.size()));
  return points() - 1;
}

Refusal smooth_lines(Ends ends, std::int64_t facets, const std::int64_t* connectivity, std::int64_t nodes,
                     Smoothed& out) {
  const auto count = static_cast<std::size_t>(nodes);
  std::vector<std::int64_t> from(count, -1), to(count, -1); // the facets that start and end in a node
  const auto at = [](std::int64_t i) { return static_cast<std::size_t>(i); };
  for (std::int64_t f = 0; f < facets; ++f) {
    const std::int64_t a = connectivity[2 * f], b = connectivity[2 * f + 1];
    if (a == b) return {Refusal::repeated_node, f, -1, a};
    for (const bool start : {true, false}) {
      const std::int64_t node = start ? a : b;
      std::int64_t& mine = (start ? from : to)[at(node)];
      // two facets that both start (or end) here: turned, unless there is a third one
      if (mine >= 0)
        return {(start ? to : from)[at(node)] >= 0 ? Refusal::branch : Refusal::opposed, f, mine, node};
      mine = f;
    }
  }
  out.add_nodes(nodes);
  const auto beyond = [&](std::int64_t end, std::int64_t inside) {
    Terms terms = {{end, 1.0}};
    if (ends == Ends::straight) terms = {{end, 2.0}, {inside, -1.0}};
    collect(terms);
    return out.add_point(terms);
  };
  for (std::int64_t f = 0; f < facets; ++f) {
    const std::int64_t a = connectivity[2 * f], b = connectivity[2 * f + 1];
    const std::int64_t before = to[at(a)], after = from[at(b)];
    out.segment_points.push_back(before >= 0 ? connectivity[2 * before] : beyond(a, b));
    out.segment_points.push_back(a);
    out.segment_points.push_back(b);
    out.segment_points.push_back(after >= 0 ? connectivity[2 * after + 1] : beyond(b, a));
  }
  return {};
}

} // namespace ents
