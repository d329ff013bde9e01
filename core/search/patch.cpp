// SPDX-License-Identifier: BSD-3-Clause
#include "core/search/patch.hpp"

#include <algorithm>
#include <cmath>

#include "core/element/segment.hpp"
#include "core/search/segment_tree.hpp"

namespace ents {

namespace {

constexpr int most_nodes = 1 + 16, most_dofs = 3 * most_nodes, most_of_all = 4 * most_nodes + 3;

// One element: which segment it is on now, and the kernel's results spread over the patch's dofs.
class PatchElement {
public:
  PatchElement(const Plan& plan, const PatchedModel& model, const ElementInput& in, const ElementOutput& out)
      : plan_(plan), patch_(model.patch), in_(in), out_(out), sizes_(sizes_of(plan, model.patch)),
        d_(plan.dimension), segments_(static_cast<std::int64_t>(patch_.connectivity.size()) / plan.nodes) {
    const double* s = in.surface_coordinates          ? in.surface_coordinates
                      : model.own_surface_coordinates ? model.surface_coordinates.data()
                                                      : nullptr;
    if (s)
      for (std::size_t i = 0; i < patch_.connectivity.size(); ++i)
        for (int t = 0; t < plan.parameters; ++t)
          coordinates_[i * static_cast<std::size_t>(plan.parameters) + static_cast<std::size_t>(t)] =
              s[patch_.connectivity[i] * plan.parameters + t];
    mesh_ = {segments_, patch_.connectivity.data(), patch_.nodes, in.master, s ? coordinates_ : nullptr};
  }

  // open: nothing has been written, the element is open without a segment.
  Status evaluate(bool& open) {
    double sum = 0.0;
    for (int i = 0; i < patch_.nodes * d_; ++i) sum += 0.0 * in_.master[i];
    for (int i = 0; i < d_; ++i) sum += 0.0 * in_.slave[i];
    if (sum != 0.0) return Status::non_finite; // NaN, too
    if (in_.state_begin && !known_state()) return Status::bad_state;

    Detection found;
    if (const Status status = choose(found); status != Status::ok) return status;
    SegmentNodes nodes;
    if (const Status status = gather(plan_, mesh_, segment_, nodes); status != Status::ok) return status;
    double state_begin[largest_state], state_end[largest_state];
    if (in_.state_begin) {
      std::copy_n(in_.state_begin, plan_.state.size, state_begin);
      if (in_.state_begin[StateLayout::history_at] >= 1.0 && before() >= 0 && before() != segment_) {
        SegmentNodes old;
        if (const Status status = gather(plan_, mesh_, before(), old); status != Status::ok) return status;
        const Status status = plan_.transfer(plan_, old.positions, old.surface_coordinates, nodes.positions,
                                             nodes.surface_coordinates, in_.state_begin, state_begin);
        if (status != Status::ok) return status;
      }
      if (in_contact())
        for (int t = 0; t < plan_.parameters; ++t) state_begin[StateLayout::xi_at + t] = found.at.xi[t];
    }
    ElementInput element = {in_.slave,      nodes.positions,  nodes.surface_coordinates,
                            found.at.xi,    in_.area,         in_.state_begin ? state_begin : nullptr,
                            in_.multiplier, in_.slave_values, in_.slave_temperature,
                            nullptr};
    double temperatures[most_nodes];
    if (in_.master_temperature) {
      for (int i = 0; i < plan_.nodes; ++i) temperatures[i] = in_.master_temperature[node_of(i)];
      element.master_temperature = temperatures;
    }
    element.time_increment = in_.time_increment;
    if (open_) { // what it projects on from behind, ahead of a ridge, is no contact
      std::int32_t flags = 0;
      ElementOutput look{};
      look.wanted = want::flags, look.flags = &flags;
      if (plan_.element(plan_, element, look) != Status::ok || (flags & flag::contact) != 0) {
        open = true;
        return Status::ok;
      }
    }
    ElementOutput results = out_;
    results.state_end = state_end;
    // What has as many entries as dofs comes here first.
    const auto local = [&](std::int32_t bit, double*& pointer, double* room) {
      if ((out_.wanted & bit) != 0 && spreads()) pointer = room;
    };
    local(want::gap_gradient, results.gap_gradient, gap_gradient_);
    local(want::gap_hessian, results.gap_hessian, gap_hessian_);
    local(want::xi_gradient, results.xi_gradient, xi_gradient_);
    local(want::xi_hessian, results.xi_hessian, xi_hessian_);
    local(want::residual, results.residual, residual_);
    local(want::tangent, results.tangent, tangent_);
    if (spreads()) results.tangent_leading_dimension = plan_.dofs;
    const Status status = evaluate_segment(plan_, element, results);
    if (status != Status::ok) return status;
    if ((out_.wanted & want::state) != 0) {
      std::copy_n(state_end, plan_.state.size, out_.state_end);
      out_.state_end[plan_.state.size] = static_cast<double>(segment_ + 1);
    }
    if (spreads()) spread();
    return Status::ok;
  }

private:
  bool spreads() const { return !plan_.rigid; } // a rigid master has no dofs
  // Node of the patch that a node of the segment is
  int node_of(int node) const {
    return static_cast<int>(patch_.connectivity[static_cast<std::size_t>(segment_ * plan_.nodes + node)]);
  }
  std::int64_t before() const { return segment_of_state(plan_, in_.state_begin); }
  // At the begin of the increment. An open slave may be over another segment by now.
  bool in_contact() const { return in_.state_begin && in_.state_begin[StateLayout::history_at] > 1.0; }
  bool known_state() const {
    const double segment = in_.state_begin[plan_.state.size] - 1.0;
    return is_state(plan_.state, in_.state_begin) && segment >= (in_contact() ? 0.0 : -1.0) &&
           segment < static_cast<double>(segments_) && segment == std::floor(segment);
  }

  // Diagonal of the box around a segment
  double length(std::int64_t segment) const {
    double low[3], high[3], sum = 0.0;
    for (int k = 0; k < d_; ++k) low[k] = infinity, high[k] = -infinity;
    for (int i = 0; i < plan_.nodes; ++i) {
      const double* x =
          in_.master + patch_.connectivity[static_cast<std::size_t>(segment * plan_.nodes + i)] * d_;
      for (int k = 0; k < d_; ++k) low[k] = std::min(low[k], x[k]), high[k] = std::max(high[k], x[k]);
    }
    for (int k = 0; k < d_; ++k) sum += (high[k] - low[k]) * (high[k] - low[k]);
    return std::sqrt(sum);
  }
  // How deep a slave may be: what lies farther is not looked at.
  double reach() const {
    if (plan_.penetration_limit > 0.0) return plan_.penetration_limit;
    double most = 0.0;
    for (std::int64_t s = 0; s < segments_; ++s) most = std::max(most, length(s));
    return most;
  }
  // Is a gap on this segment within reach? Its own length is enough in most cases.
  bool within_reach(double gap, std::int64_t segment) const {
    return (plan_.penetration_limit <= 0.0 && std::fabs(gap) <= length(segment)) || std::fabs(gap) <= reach();
  }

  // How far the enriched surface is at most: where the slave projects on the segments without their height,
  // which are searched at once. Infinite: on none.
  Status look_at_base(Detection& base, double& at_most) const {
    at_most = infinity;
    base.segment = -1;
    if (const Status status = detect(*plan_.base, mesh_, nullptr, in_.slave, infinity, base);
        status != Status::ok)
      return status;
    if (base.segment < 0 || base.at.beyond > 0.0)
      return Status::ok; // beyond an edge the rank of a projection counts, not its gap
    SegmentNodes nodes;
    if (const Status status = gather(plan_, mesh_, base.segment, nodes); status != Status::ok) return status;
    double point[3], sum = 0.0;
    const SurfacePoint to = {point, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr};
    if (plan_.surface(plan_, nodes.positions, nodes.surface_coordinates, base.at.xi, to) != Status::ok)
      return Status::ok;
    for (int k = 0; k < d_; ++k) sum += (in_.slave[k] - point[k]) * (in_.slave[k] - point[k]);
    at_most = std::sqrt(sum) * (1.0 + 1e-9) + 10.0 * base.at.tie;
    return Status::ok;
  }

  // By the block kernel, which is the fastest: is the slave still on the segment of before, next to where it
  // was? False: nothing is known.
  bool follow(Detection& found) const {
    SegmentNodes nodes;
    if (!plan_.block || gather(plan_, mesh_, before(), nodes) != Status::ok) return false;
    ElementInput here = in_;
    here.master = nodes.positions, here.surface_coordinates = nodes.surface_coordinates;
    double xi[2] = {}, gap = 0.0;
    std::int32_t flags = 0;
    ElementOutput look{};
    look.wanted = want::xi | want::gap | want::flags;
    look.xi = xi, look.gap = &gap, look.flags = &flags;
    if (plan_.block(plan_, block_of(here, look, found.at.xi, look.wanted), 1) == 0 ||
        (flags & flag::outside) != 0 || !within_reach(gap, before()))
      return false;
    found.segment = before();
    found.at.gap = gap;
    for (int t = 0; t < plan_.parameters; ++t) found.at.xi[t] = xi[t];
    return true;
  }

  // The segment of before while the slave is on it; else the best of all; where none is within reach, the
  // nearest: the slave is open there, or too deep.
  Status choose(Detection& found) {
    found.segment = in_contact() ? before() : -1;
    if (in_contact()) {
      for (int t = 0; t < plan_.parameters; ++t) found.at.xi[t] = in_.state_begin[StateLayout::xi_at + t];
      if (!follow(found))
        if (const Status status = detect_followed(plan_, mesh_, in_.slave, reach(), found);
            status != Status::ok)
          return status;
      if (found.segment >= 0) {
        segment_ = found.segment;
        return Status::ok;
      }
    }
    const double deepest = reach();
    Detection base;
    double at_most;
    if (const Status status = look_at_base(base, at_most); status != Status::ok) return status;
    // Looking no farther than the surface is keeps the search short; beside a free border a projection may be
    // farther.
    for (const double far : {std::min(at_most, deepest), deepest}) {
      found.segment = -1;
      if (const Status status = detect(plan_, mesh_, nullptr, in_.slave, far, found); status != Status::ok)
        return status;
      if ((found.segment >= 0 && !found.at.ambiguous) || at_most > deepest) break;
    }
    if (found.behind_edge) return Status::no_projection;
    if (found.segment >= 0) {
      segment_ = found.segment;
      const bool doubtful = found.at.ambiguous && found.at.gap < 0.0 && !in_contact();
      return doubtful ? Status::ambiguous_projection : Status::ok;
    }
    const bool doubtful = found.at.ambiguous;
    if (base.behind_edge) return Status::no_projection;
    segment_ = base.segment;
    found.at = base.at;
    if (segment_ >= 0) {
      if (base.at.gap < -deepest) return Status::deep_penetration;
      if (doubtful && base.at.gap <= plan_.height_bound) return Status::ambiguous_projection;
      open_ = true;
      return Status::ok;
    }
    if (doubtful) return Status::ambiguous_projection;
    double least = infinity;
    for (std::int64_t s = 0; s < segments_; ++s) {
      SegmentNodes nodes;
      double box[6];
      if (const Status status = gather(plan_, mesh_, s, nodes); status != Status::ok) return status;
      plan_.box(plan_, nodes.positions, nodes.surface_coordinates, box, box + d_);
      const double distance = distance_to_box(d_, in_.slave, box);
      if (segment_ < 0 || distance < least) segment_ = s, least = distance;
    }
    for (double& xi : found.at.xi) xi = plan_.simplex ? 1.0 / 3.0 : 0.0;
    open_ = true;
    return Status::ok;
  }

  // Is the segment a quadrilateral of which two nodes are one?
  bool has_node_twice() const {
    const auto first = patch_.connectivity.begin() + segment_ * plan_.nodes, last = first + plan_.nodes;
    return plan_.nodes == 4 && (*first == *(last - 1) || std::adjacent_find(first, last) != last);
  }

  // Dof of the patch that a dof of the kernel's element is, `own` to a node
  int dof(int local, int own) const {
    const int nodes = own * (1 + plan_.nodes);
    if (local < own) return local;
    if (local >= nodes) return local - nodes + own * (1 + patch_.nodes);
    return own * (1 + node_of(local / own - 1)) + local % own;
  }

  // A row of the kernel's element to one of the patch: a node at a time
  template <int Own> void spread_row(const double* from, int n, double* to) const {
    const int master = Own * (1 + plan_.nodes);
    for (int i = 0; i < master; i += Own)
      for (int c = 0; c < Own; ++c) to[places_[i] + c] = from[i + c];
    for (int i = master; i < n; ++i) to[places_[i]] = from[i];
  }
  void spread_row(const double* from, int n, double* to) const {
    if (collapsed_)
      for (int i = 0; i < n; ++i) to[places_[i]] += from[i];
    else if (own_ == 2)
      spread_row<2>(from, n, to);
    else
      own_ == 3 ? spread_row<3>(from, n, to) : spread_row<4>(from, n, to);
  }
  void set_places(int own, int n) {
    own_ = own;
    for (int i = 0; i < n; ++i) places_[i] = dof(i, own);
  }
  void spread_vector(const double* from, int n, int all, double* to) const {
    std::fill_n(to, all, 0.0);
    spread_row(from, n, to);
  }
  void spread_matrix(const double* from, int n, int all, std::int64_t leading, double* to) const {
    for (int j = 0; j < all; ++j) std::fill_n(to + j * leading, all, 0.0);
    for (int j = 0; j < n; ++j) spread_row(from + j * n, n, to + places_[j] * leading);
  }

  void spread() {
    const int n = d_ * (1 + plan_.nodes), all = d_ * (1 + patch_.nodes), w = out_.wanted;
    collapsed_ = has_node_twice();
    set_places(d_, n);
    if (w & want::gap_gradient) spread_vector(gap_gradient_, n, all, out_.gap_gradient);
    if (w & want::gap_hessian) spread_matrix(gap_hessian_, n, all, all, out_.gap_hessian);
    for (int t = 0; t < plan_.parameters; ++t) {
      if (w & want::xi_gradient) spread_vector(xi_gradient_ + t * n, n, all, out_.xi_gradient + t * all);
      if (w & want::xi_hessian)
        spread_matrix(xi_hessian_ + t * n * n, n, all, all, out_.xi_hessian + t * all * all);
    }
    set_places(plan_.node_dofs, plan_.dofs);
    if (w & want::residual) spread_vector(residual_, plan_.dofs, sizes_.dofs, out_.residual);
    if (w & want::tangent)
      spread_matrix(tangent_, plan_.dofs, sizes_.dofs, out_.tangent_leading_dimension, out_.tangent);
  }

  const Plan& plan_;
  const Patch& patch_;
  const ElementInput& in_;
  const ElementOutput& out_;
  const ElementSizes sizes_;
  const int d_;
  const std::int64_t segments_;
  MasterMesh mesh_;
  std::int64_t segment_ = -1;
  bool open_ = false, collapsed_ = false;
  int own_ = 0;                      // dofs of a node
  std::int32_t places_[most_of_all]; // of dof()
  double coordinates_[most_patch_segments * 16 * 2];
  double gap_gradient_[most_dofs], gap_hessian_[most_dofs * most_dofs], xi_gradient_[2 * most_dofs],
      xi_hessian_[2 * most_dofs * most_dofs], residual_[most_of_all], tangent_[most_of_all * most_of_all];
};

} // namespace

ElementSizes sizes_of(const Plan& plan, const Patch& patch) {
  if (patch.empty()) return {plan.nodes, plan.dofs, plan.state.size + 1};
  return {patch.nodes, plan.node_dofs * (plan.rigid ? 1 : 1 + patch.nodes) + plan.multipliers,
          plan.state.size + 1};
}

Status evaluate_patch(const Plan& plan, const PatchedModel& model, const ElementInput& in,
                      const ElementOutput& out, bool& open) {
  open = false;
  return PatchElement(plan, model, in, out).evaluate(open);
}

} // namespace ents
