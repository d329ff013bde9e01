// SPDX-License-Identifier: BSD-3-Clause
#include "core/element/flattening.hpp"

#include <algorithm>
#include <cmath>

namespace ents {

namespace {

constexpr int residual_size = 3 * 17, most_steps = 100, samples = 16;

class FlattenedElement {
public:
  FlattenedElement(const Plan& plan, const ElementInput& in)
      : law_(plan.law.flattening), plan_(plan), in_(in) {
    std::copy_n(plan.height, plan.height_nodes, nodes_);
    plan_.height = nodes_;
    plan_.element = plan.unflattened;
  }

  Status evaluate(const ElementOutput& out) {
    if (const Status status = look(1.0); status != Status::ok) return status;
    Status status = Status::ok;
    if (pressure_ > 0.0)
      status = solve();
    else if (known_ && gap_ < plan_.height_bound)
      status = look_for_contact();
    return status == Status::ok ? write(out) : status;
  }

private:
  double scale_at(double p) const { return law_.least + (1.0 - law_.least) * std::exp(-p / law_.pressure); }
  double slope_at(double p) const {
    return -(1.0 - law_.least) / law_.pressure * std::exp(-p / law_.pressure);
  }

  // Pressure and projection at the scale s.
  Status look(double s) {
    s_ = s;
    for (std::int32_t i = 0; i < plan_.height_nodes; ++i)
      if (nodes_[i].kind == HeightKind::constant && nodes_[i].bound_to[0] == law_.parameter)
        nodes_[i].constant.value = s;
    std::int32_t flags = 0;
    ElementOutput to{};
    to.wanted = want::xi | want::flags | want::pressure | want::gap;
    to.xi = xi_, to.flags = &flags, to.pressure = &pressure_, to.gap = &gap_;
    const Status status = plan_.element(plan_, here(), to);
    if (status != Status::ok) return status;
    known_ = (flags & flag::outside) == 0;
    if ((flags & flag::contact) == 0) pressure_ = 0.0;
    return Status::ok;
  }

  // The derivatives of what look() has found.
  Status differentiate(double* residual) {
    rates_ = {};
    rates_.residual = residual;
    return plan_.by_parameter(plan_, in_, xi_, law_.parameter, rates_);
  }
  // d/ds (s - f(p(s))): not above 0 on a branch that no load can follow
  double stability() const { return 1.0 - slope_at(pressure_) * rates_.pressure; }

  Status solve() {
    double low = law_.least, high = 1.0;
    bool crest = true; // the gap falls with s wherever it was looked at
    for (int step = 0; step < most_steps; ++step) {
      if (const Status status = differentiate(nullptr); status != Status::ok) return status;
      crest = crest && rates_.gap <= 0.0;
      const double miss = s_ - scale_at(pressure_);
      (miss > 0.0 ? high : low) = s_;
      const double newton = s_ - miss / stability();
      const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
      if (miss == 0.0 || std::fabs(next - s_) <= 2e-16 || !(next > low && next < high)) break;
      if (const Status status = look(next); status != Status::ok) return status;
    }
    if (!(std::fabs(s_ - scale_at(pressure_)) <= 1e-9) || !(stability() > 0.0))
      return Status::ambiguous_projection;
    return crest ? Status::ok : look_for_others(1);
  }

  // Open with all of its height: a hollow could have risen to the slave all the same.
  Status look_for_contact() {
    if (const Status status = look(law_.least); status != Status::ok) return status;
    if (pressure_ == 0.0) return look(1.0);
    s_ = 1.0;
    return look_for_others(0);
  }

  // On a hollow, the solutions beside the present one, as far as sixteen places between tell: where
  // s - f(p(s)) > 0 changes more often than `expected`.
  Status look_for_others(int expected) {
    const double found = s_;
    int changes = 0;
    bool before = false;
    for (int i = 0; i <= samples; ++i) {
      const double s = law_.least + (1.0 - law_.least) * i / samples;
      if (const Status status = look(s); status != Status::ok) return status;
      const bool above = s_ - scale_at(pressure_) > 0.0;
      changes += i > 0 && above != before;
      before = above;
    }
    if (changes > expected) return Status::ambiguous_projection;
    return look(found);
  }

  Status write(const ElementOutput& out) {
    const int dofs = plan_.dofs;
    const bool coupled = pressure_ > 0.0 && known_ && (out.wanted & want::tangent) != 0;
    double residual[residual_size], gradient[residual_size];
    if (coupled) {
      if (const Status status = differentiate(residual); status != Status::ok) return status;
      ElementOutput to{};
      to.wanted = want::gap_gradient;
      to.gap_gradient = gradient;
      if (const Status status = plan_.element(plan_, here(), to); status != Status::ok) return status;
    }
    if (const Status status = plan_.element(plan_, here(), out); status != Status::ok) return status;
    if (!coupled) return Status::ok;
    // ds/du = f' dp/du / (1 - f' dp/ds), dp/du = - W'' dg/du at a fixed scale
    const double by_gap = -slope_at(pressure_) * rates_.stiffness / stability();
    const bool symmetrised = plan_.law.symmetrised;
    for (int j = 0; j < dofs; ++j)
      for (int i = 0; i < dofs; ++i) {
        const double own = residual[i] * by_gap * gradient[j], turned = residual[j] * by_gap * gradient[i];
        out.tangent[j * out.tangent_leading_dimension + i] += symmetrised ? 0.5 * (own + turned) : own;
      }
    return Status::ok;
  }

  ElementInput here() const {
    ElementInput in = in_;
    if (s_ < 1.0 && known_) in.start = xi_, in.start_first = true;
    return in;
  }

  const Flattening& law_;
  Plan plan_;
  const ElementInput& in_;
  HeightNode nodes_[most_flattened_nodes];
  ParameterRates rates_{};
  double s_ = 1.0, pressure_ = 0.0, gap_ = 0.0, xi_[2] = {};
  bool known_ = false;
};

} // namespace

Status evaluate_flattened(const Plan& plan, const ElementInput& in, const ElementOutput& out) {
  if (plan.law.normal == NormalKind::none || !plan.height) return plan.unflattened(plan, in, out);
  return FlattenedElement(plan, in).evaluate(out);
}

} // namespace ents
