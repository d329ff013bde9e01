// SPDX-License-Identifier: BSD-3-Clause
// What ordinary elements of a call begin with: positions, and where the projection starts, from the host's
// arrays to numbers of one element or of one per lane.
#pragma once

#include "core/law/touch.hpp"
#include "core/tangent/frictionless_tangent.hpp"

namespace ents::ENTS_ISA {

// From the state's numbers: those at `anchor_at`, and of an open element its projection.
template <int T> ENTS_INLINE SlipBegin<double, T> slip_begin(const double* state, std::int32_t anchor_at) {
  SlipBegin<double, T> begin{};
  const double history = state[StateLayout::history_at];
  if (history < 1.0) return begin;
  const bool open = history == 1.0;
  begin.known = 1.0;
  begin.clearance = open && state[anchor_at] > 0.0 ? state[anchor_at] : 0.0;
  for (int a = 0; a < T; ++a) begin.from[a] = state[(open ? StateLayout::xi_at : anchor_at) + a];
  return begin;
}

template <class T> ENTS_INLINE T* element_at(T* data, std::int64_t stride, std::int64_t e) {
  return data ? data + stride * e : nullptr;
}

ENTS_INLINE bool is_finite(const double* numbers, int count) {
  double zero = 0.0;
  for (int i = 0; i < count; ++i) zero += 0.0 * numbers[i];
  return zero == 0.0;
}

ENTS_INLINE const double* coordinates_of(const Plan& plan, const ElementBlock& block, std::int64_t e) {
  return block.surface_coordinates ? block.surface_coordinates + e * block.surface_coordinates_stride
                                   : plan.surface_coordinates;
}

// The nodes of one element, seen from its slave.
template <bool Enriched, class Basis>
ENTS_INLINE void set_nodes(const Plan& plan, const double* slave, const double* master,
                           const double* coordinates, ElementNodes<Basis, double>& nodes) {
  constexpr int D = Basis::dim;
  const int count = node_count(nodes.basis);
  for (int i = 0; i < count; ++i) nodes.y[i] = vec_at<D>(master + std::int64_t{D} * i) - vec_at<D>(slave);
  nodes.has_coordinates = Enriched && coordinates;
  if (nodes.has_coordinates)
    for (int i = 0; i < (D - 1) * count; ++i) nodes.coordinates[i] = coordinates[i];
  nodes.height = plan.height;
}

// What an element starts from, as evaluate_element() has it. Null: the whole segment has to be searched, or
// an input is wrong that would not be noticed later.
template <class Basis, bool Enriched>
ENTS_INLINE const double* start_of(const Plan& plan, const ElementBlock& block, std::int64_t e) {
  if constexpr (!Enriched)
    if (block.surface_coordinates && !is_finite(coordinates_of(plan, block, e),
                                                (Basis::dim - 1) * node_count(basis_of<Basis>(plan.basis))))
      return nullptr;
  const double* start = element_at(block.start, block.start_stride, e);
  if (start && !is_finite(start, Basis::dim - 1)) return nullptr;
  if (block.state_begin) {
    const double* state = block.state_begin + e * block.state_begin_stride;
    if (state[StateLayout::tag_at] != plan.state.tag || !is_finite(state, plan.state.size)) return nullptr;
    const double history = state[StateLayout::history_at];
    if (history == 2.0 || history == 3.0)
      return block.start_first && start ? start : state + StateLayout::xi_at;
    if (history != 0.0 && history != 1.0) return nullptr;
  }
  return start;
}

// Inputs of element e.
template <class Basis, bool Enriched, bool Frictional> struct OneInput {
  static constexpr int T = Basis::dim - 1;
  ElementNodes<Basis, double> nodes;
  double xi[T], area;
  SlipBegin<double, T> begin{}; // friction
  bool known;

  ENTS_INLINE OneInput(const Plan& plan, const ElementBlock& block, std::int64_t e)
      : nodes(basis_of<Basis>(plan.basis)) {
    const double* start = start_of<Basis, Enriched>(plan, block, e);
    known = start != nullptr;
    if (!known) return;
    set_nodes<Enriched>(plan, block.slave + e * block.slave_stride, block.master + e * block.master_stride,
                        coordinates_of(plan, block, e), nodes);
    for (int a = 0; a < T; ++a) xi[a] = start[a];
    area = block.area ? block.area[e * block.area_stride] : 1.0;
    if constexpr (Frictional)
      if (block.state_begin)
        begin = slip_begin<T>(block.state_begin + e * block.state_begin_stride, plan.state.anchor_at);
  }
};

#if defined(ENTS_HAS_LANES)
// `size` numbers of each of W elements will be read soon.
template <int W> ENTS_INLINE void prefetch(const double* from, std::int64_t stride, std::int64_t size) {
  constexpr std::int64_t line = 64 / sizeof(double);
  const std::int64_t all = (W - 1) * stride + size;
  if (all <= 2 * W * size) {
    for (std::int64_t i = 0; i < all; i += line) __builtin_prefetch(from + i);
  } else {
    for (int k = 0; k < W; ++k)
      for (std::int64_t i = 0; i < size; i += line) __builtin_prefetch(from + k * stride + i);
  }
}

// Inputs of W elements from e on.
template <class Basis, bool Enriched, bool Frictional, int W> struct LaneInputs {
  static constexpr int D = Basis::dim, T = D - 1;
  using Scalar = Lanes<W>;
  ElementNodes<Basis, Scalar> nodes;
  Scalar xi[T], area;
  SlipBegin<Scalar, T> begin; // friction
  std::uint32_t known;        // bit k: element e + k has a start

  ENTS_INLINE LaneInputs(const Plan& plan, const ElementBlock& block, std::int64_t e)
      : nodes(basis_of<Basis>(plan.basis)) {
    const Basis& basis = nodes.basis;
    const int count = node_count(basis);
    prefetch_inputs(plan, block, e + 2 * W);
    const double* from[W];
    const auto rows = [&](const double* data, std::int64_t stride) ENTS_LAMBDA_INLINE {
      for (int k = 0; k < W; ++k) from[k] = data + (e + k) * stride;
    };
    Scalar x[D], y[D * Basis::nodes];
    rows(block.slave, block.slave_stride);
    read_lanes<W>(from, x);
    rows(block.master, block.master_stride);
    read_nodes<D>(basis, from, y);
    for (int i = 0; i < count; ++i)
      for (int c = 0; c < D; ++c) nodes.y[i][c] = y[D * i + c] - x[c];
    nodes.has_coordinates = Enriched && coordinates_of(plan, block, e);
    if (nodes.has_coordinates) {
      for (int k = 0; k < W; ++k) from[k] = coordinates_of(plan, block, e + k);
      read_nodes<T>(basis, from, nodes.coordinates);
    }
    nodes.height = plan.height;
    area = block.area ? read_lanes<W>(block.area + e * block.area_stride, block.area_stride) : Scalar(1.0);
    known = (1u << W) - 1;
    if constexpr (!Enriched)
      if (block.surface_coordinates)
        for (int k = 0; k < W; ++k)
          if (!is_finite(coordinates_of(plan, block, e + k), T * count)) known &= ~(1u << k);
    if (block.start) {
      if constexpr (T == 1) {
        xi[0] = read_lanes<W>(block.start + e * block.start_stride, block.start_stride);
      } else {
        rows(block.start, block.start_stride);
        read_lanes<W>(from, xi);
      }
      known &= bits_of(are_finite(xi));
    }
    if (block.state_begin) {
      rows(block.state_begin, block.state_begin_stride);
      read_states(plan, block, from);
    } else {
      if (!block.start) known = 0;
      begin.known = begin.clearance = Scalar(0.0);
      for (Scalar& x_0 : begin.from) x_0 = Scalar(0.0);
    }
    if (known != (1u << W) - 1) { // others begin anywhere
      double starts[W];
      for (int k = 0; k < W; ++k) starts[k] = known >> k & 1 ? 1.0 : 0.0;
      const Truth<Scalar> has_start = load<Scalar>(starts) > 0.5;
      for (Scalar& x_0 : xi) x_0 = select(has_start, x_0, Scalar(0.0));
    }
  }

private:
  template <int Count> static ENTS_INLINE Truth<Scalar> are_finite(const Scalar (&numbers)[Count]) {
    Scalar zero = 0.0 * numbers[0];
    for (int i = 1; i < Count; ++i) zero = zero + 0.0 * numbers[i];
    return zero >= 0.0;
  }
  // As start_of() has it
  ENTS_INLINE void read_states(const Plan& plan, const ElementBlock& block, const double* const (&from)[W]) {
    Scalar state[Frictional ? StateLayout::xi_at + 2 * T + 1 : StateLayout::xi_at + T];
    read_lanes<W>(from, state);
    const auto is = [](const Scalar& a, double b) ENTS_LAMBDA_INLINE { return both(a >= b, a <= b); };
    const Scalar& last = state[StateLayout::history_at];
    const Truth<Scalar> touched = either(is(last, 2.0), is(last, 3.0)),
                        free = either(is(last, 0.0), is(last, 1.0));
    const bool first = block.start_first && block.start;
    known &= bits_of(
        both(both(is(state[StateLayout::tag_at], plan.state.tag), are_finite(state)), either(touched, free)));
    if (!block.start) known &= bits_of(touched);
    if (!first)
      for (int a = 0; a < T; ++a)
        xi[a] = block.start ? select(touched, state[StateLayout::xi_at + a], xi[a])
                            : state[StateLayout::xi_at + a];
    if constexpr (Frictional) { // as slip_begin() has it
      const Scalar *place = state + StateLayout::xi_at, *anchor = place + T;
      begin.known = select(last >= 1.0, Scalar(1.0), Scalar(0.0));
      begin.clearance = select(both(is(last, 1.0), anchor[0] > 0.0), anchor[0], Scalar(0.0));
      for (int a = 0; a < T; ++a) begin.from[a] = select(touched, anchor[a], place[a]);
    }
  }
  // Of a later element, or of none: inputs of long calls come from memory, and the hardware prefetch of the
  // processor stops at each page (4 KiB).
  ENTS_INLINE void prefetch_inputs(const Plan& plan, const ElementBlock& block, std::int64_t e) const {
    const int count = node_count(nodes.basis);
    const auto soon = [e](const double* data, std::int64_t stride, std::int64_t size) ENTS_LAMBDA_INLINE {
      if (data) prefetch<W>(data + e * stride, stride, size);
    };
    soon(block.slave, block.slave_stride, D);
    soon(block.master, block.master_stride, D * count);
    soon(block.surface_coordinates, block.surface_coordinates_stride, T * count);
    soon(block.start, block.start_stride, T);
    soon(block.area, block.area_stride, 1);
    soon(block.state_begin, block.state_begin_stride, plan.state.size);
  }
};
#endif

} // namespace ents::ENTS_ISA
