// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "core/smoothing/quasi_interpolation.hpp"

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

namespace {

// Control points of quasi-interpolation along chains of lines.
class LineControls {
public:
  LineControls(Ends ends, const std::int64_t* connectivity, const std::vector<std::int64_t>& from,
               const std::vector<std::int64_t>& to)
      : most_(extrapolation_nodes(ends)), connectivity_(connectivity), from_(from), to_(to) {}

  Terms of(std::int64_t node) const {
    const std::int64_t before = neighbour(node, false), after = neighbour(node, true);
    if (before >= 0 && after >= 0) return along_line(before, node, after);
    Terms terms = {{node, 8.0 / 6.0}, {before >= 0 ? before : after, -1.0 / 6.0}};
    append(terms, -1.0 / 6.0, extrapolated(line(node, after >= 0)));
    return terms;
  }
  Terms beyond(std::int64_t end) const {
    Terms terms = {{end, 6.0}};
    append(terms, -4.0, of(end));
    append(terms, -1.0, of(line(end, neighbour(end, true) >= 0)[1]));
    return terms;
  }

private:
  static void append(Terms& sum, double factor, const Terms& terms) {
    for (const Term& t : terms) sum.push_back({t.node, factor * t.weight});
  }
  // -1: the chain ends in `node`
  std::int64_t neighbour(std::int64_t node, bool forward) const {
    const std::int64_t facet = (forward ? from_ : to_)[static_cast<std::size_t>(node)];
    return facet < 0 ? -1 : connectivity_[2 * facet + (forward ? 1 : 0)];
  }
  std::vector<std::int64_t> line(std::int64_t end, bool forward) const {
    std::vector<std::int64_t> nodes = {end};
    for (std::int64_t n = neighbour(end, forward); n >= 0 && nodes.size() < most_; n = neighbour(n, forward))
      nodes.push_back(n);
    return nodes;
  }

  std::size_t most_;
  const std::int64_t* connectivity_;
  const std::vector<std::int64_t>&from_, &to_;
};

} // namespace

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
  const bool quasi = is_quasi(ends);
  const LineControls controls(ends, connectivity, from, to);
  const auto add = [&](Terms terms) {
    collect(terms);
    return out.add_point(terms);
  };
  std::vector<std::int64_t> number(quasi ? count : 0, -1);
  const auto control_point = [&](std::int64_t node) {
    if (!quasi) return node;
    if (number[at(node)] < 0) number[at(node)] = add(controls.of(node));
    return number[at(node)];
  };
  const auto beyond = [&](std::int64_t end, std::int64_t inside) {
    if (quasi) return add(controls.beyond(end));
    return add(ends == Ends::straight ? Terms{{end, 2.0}, {inside, -1.0}} : Terms{{end, 1.0}});
  };
  for (std::int64_t f = 0; f < facets; ++f) {
    const std::int64_t a = connectivity[2 * f], b = connectivity[2 * f + 1];
    const std::int64_t before = to[at(a)], after = from[at(b)];
    out.segment_points.push_back(before >= 0 ? control_point(connectivity[2 * before]) : beyond(a, b));
    out.segment_points.push_back(control_point(a));
    out.segment_points.push_back(control_point(b));
    out.segment_points.push_back(after >= 0 ? control_point(connectivity[2 * after + 1]) : beyond(b, a));
  }
  return {};
}

} // namespace ents
