// SPDX-License-Identifier: BSD-3-Clause
#include "core/smoothing/quasi_interpolation.hpp"

namespace ents {

Terms extrapolated(const std::vector<std::int64_t>& nodes) {
  static constexpr double weights[3][4] = {{2.0, -1.0}, {3.0, -3.0, 1.0}, {4.0, -6.0, 4.0, -1.0}};
  Terms terms;
  for (std::size_t i = 0; i < nodes.size(); ++i) terms.push_back({nodes[i], weights[nodes.size() - 2][i]});
  return terms;
}

Terms along_line(std::int64_t before, std::int64_t node, std::int64_t after, double factor) {
  return {{before, -factor / 6.0}, {node, 8.0 * factor / 6.0}, {after, -factor / 6.0}};
}

// From the start of a half-edge straight on through inner nodes of four facets: at most `most` nodes.
std::vector<std::int64_t> FacetMesh::line_inwards(std::int64_t half, std::size_t most) const {
  std::vector<std::int64_t> line = {start(half), end(half)};
  while (line.size() < most && out_[index(line.back())] < 0 && incident_[index(line.back())] == 4) {
    half = next(twin_[index(next(half))]);
    line.push_back(end(half));
  }
  return line;
}

// Along the border, through nodes of two facets.
std::vector<std::int64_t> FacetMesh::line_along_border(std::int64_t node, bool forward,
                                                       std::size_t most) const {
  std::vector<std::int64_t> line = {node};
  do line.push_back(forward ? end(out_[index(line.back())]) : start(in_[index(line.back())]));
  while (line.size() < most && incident_[index(line.back())] == 2);
  return line;
}

// Regular: from the rule across the border, where `before` and `after` are neighbours along it.
void FacetMesh::control_beyond(std::int64_t laid, std::int64_t node, const std::vector<std::int64_t>& inner,
                               std::int64_t before, std::int64_t after) {
  laid_controls_.resize(laid_around_.size());
  LaidControl& control = laid_controls_[index(laid - nodes_)];
  if (inner.size() == 1) {
    control.nodes = along_line(before, node, after, 6.0);
    control.controls = {{node, -4.0}, {inner[0], -1.0}};
    return;
  }
  control.controls = {{node, 2.0}};
  for (const std::int64_t i : inner)
    control.controls.push_back({i, -1.0 / static_cast<double>(inner.size())});
}

// What is laid beyond the corner where half-edge h of the border starts, in both directions: the mean of what
// the two rows beside it say, which are one and the same where facets are regular.
void FacetMesh::extrapolate_corner(Ends ends, std::int64_t h) {
  const std::int64_t v = start(h), beyond_in = beyond_in_[index(v)], beyond_out = beyond_out_[index(v)];
  const std::int64_t corner = beyond_out + 1; // laid in this order
  const std::int64_t p = end(h), q = start(in_[index(v)]);
  control_beyond(beyond_in, v, {p}, beyond_out, q);
  control_beyond(beyond_out, v, {q}, beyond_in, p);
  laid_controls_.resize(laid_around_.size());
  Terms position;
  LaidControl control;
  for (const bool forward : {true, false}) {
    std::vector<std::int64_t> line = line_along_border(v, forward, extrapolation_nodes(ends));
    // the border's own control points at v and the next node u, and beyond v: 6 v - 4 (at v) - (at u)
    const std::int64_t u = line[1];
    const bool ends_there = incident_[index(u)] == 1;
    const std::int64_t after_u = forward ? (ends_there ? beyond_out_[index(u)] : end(out_[index(u)]))
                                         : (ends_there ? beyond_in_[index(u)] : start(in_[index(u)]));
    const std::int64_t beyond_v = forward ? beyond_in : beyond_out;
    const std::int64_t other =
        forward ? q : p; // the row's control points: 6 (border) - 4 (at v) - (at `other`)
    control.nodes.push_back({v, 0.5 * 36.0});
    for (const Term& t : along_line(beyond_v, v, u, 0.5 * -24.0)) control.nodes.push_back(t);
    for (const Term& t : along_line(v, u, after_u, 0.5 * -6.0)) control.nodes.push_back(t);
    control.controls.push_back({beyond_v, 0.5 * -4.0});
    control.controls.push_back({forward ? beyond_out_[index(other)] : beyond_in_[index(other)], 0.5 * -1.0});
    line[0] = forward ? beyond_out : beyond_in;
    for (std::size_t i = 1; i < line.size(); ++i)
      line[i] = forward ? beyond_in_[index(line[i])] : beyond_out_[index(line[i])];
    for (const Term& t : extrapolated(line))
      for (const Term& n : laid_around_[index(t.node - nodes_)])
        position.push_back({n.node, 0.5 * t.weight * n.weight});
  }
  collect(position);
  laid_around_[index(corner - nodes_)] = std::move(position);
  laid_controls_[index(corner - nodes_)] = std::move(control);
}

Refusal QuadControls::build(const FacetMesh& mesh) {
  of_.assign(static_cast<std::size_t>(mesh.all_nodes()), {});
  mesh_ = &mesh;
  Ring ring;
  for (std::int64_t f = 0; f < mesh.facets(); ++f)
    for (int corner = 0; corner < 4; ++corner) {
      const std::int64_t node = mesh.node(f, corner);
      if (!of(node).empty()) continue;
      if (const Refusal refusal = mesh.ring(f, corner, ring); refusal.reason != Refusal::none) return refusal;
      of_[static_cast<std::size_t>(node)] = inside(node, ring);
    }
  for (std::int64_t node = mesh.nodes(); node < mesh.all_nodes(); ++node) find_laid(node);
  return {};
}

Terms QuadControls::inside(std::int64_t node, const Ring& ring) const {
  const auto n = static_cast<double>(ring.size());
  double own = 64.0 / 36.0, edge = -8.0 / 36.0, face = 1.0 / 36.0;
  if (ring.size() != 4) {
    own = 2.0 - n / (n + 5.0);
    edge = -4.0 / (n * (n + 5.0)), face = -1.0 / (n * (n + 5.0));
  }
  Terms terms;
  append_node(terms, own, node);
  for (const std::int64_t e : ring.edge) append_node(terms, edge, e);
  for (const std::int64_t f : ring.face) append_node(terms, face, f);
  collect(terms);
  return terms;
}

// A corner's control point needs those of the laid nodes beside it.
void QuadControls::find_laid(std::int64_t node) {
  if (!of(node).empty()) return;
  Terms terms;
  for (const Term& t : mesh_->laid_control(node).nodes) append_node(terms, t.weight, t.node);
  for (const Term& t : mesh_->laid_control(node).controls) {
    if (t.node >= mesh_->nodes()) find_laid(t.node);
    for (const Term& c : of(t.node)) terms.push_back({c.node, t.weight * c.weight});
  }
  collect(terms);
  of_[static_cast<std::size_t>(node)] = std::move(terms);
}

void QuadControls::append_node(Terms& terms, double weight, std::int64_t node) const {
  if (node < mesh_->nodes()) {
    terms.push_back({node, weight});
    return;
  }
  for (const Term& t : mesh_->laid_around()[static_cast<std::size_t>(node - mesh_->nodes())])
    terms.push_back({t.node, weight * t.weight});
}

} // namespace ents
