// SPDX-License-Identifier: BSD-3-Clause
// One slave node with a temperature, over a flat line.
#pragma once

#include <cmath>
#include <vector>

#include "law_elements.hpp"
#include "model_handle.hpp"

namespace laws::heated {

inline constexpr double eps = 100.0, mu = 0.3, k_t = 80.0;
inline const json penalty = {{"type", "penalty"}, {"stiffness", eps}};
inline const json coulomb = {{"type", "coulomb"}, {"coefficient", mu}, {"stiffness", k_t}};

inline json text_of(const json& heat, const json& friction = nullptr, const json& more = json::object()) {
  json text = {{"segment", "line2"},
               {"contact", {{"normal", penalty}, {"friction", friction}, {"heat", heat}}}};
  text.update(more);
  return text;
}

// A slave node over a flat line from -1 to 1, which may be turned.
class Point {
public:
  explicit Point(const json& text) : model_(make(text)), layout_(layout_of(model_.get())) {
    begin_.resize(static_cast<std::size_t>(layout_.state_size));
    end_ = begin_;
    ents_state_init(model_.get(), 1, begin_.data(), layout_.state_size, nullptr);
  }

  std::int32_t evaluate(double x, double y, double angle = 0.0, ents_report* report = nullptr) {
    const double c = std::cos(angle), s = std::sin(angle);
    const double slave[2] = {c * x - s * y, s * x + c * y}, master[4] = {-c, -s, c, s}, start = x;
    ents_input in{};
    in.struct_size = sizeof in, in.slave = slave, in.master = master, in.start = &start, in.area = &area;
    in.state_begin = begin_.data();
    in.slave_temperature = &slave_temperature, in.master_temperature = master_temperature;
    in.time_increment = time_increment;
    ents_output out{};
    out.struct_size = sizeof out;
    out.wanted = ENTS_PRESSURE | ENTS_STATE | ENTS_FLAGS | ENTS_RESIDUAL | ENTS_TANGENT | ENTS_HEAT |
                 ENTS_DISSIPATION | ENTS_FRICTION_ENERGY | ENTS_ENERGY;
    out.pressure = &pressure, out.state_end = end_.data(), out.flags = &flags, out.residual = residual;
    out.tangent = tangent, out.heat = heat, out.dissipation = &dissipation, out.energy = &energy;
    out.friction_energy = &friction_energy;
    return ents_evaluate(model_.get(), 0, 1, &in, &out, report);
  }
  void commit() { begin_ = end_; }

  double area = 0.7, time_increment = 0.1, slave_temperature = 5.0, master_temperature[2] = {1.0, 2.0};
  double pressure = 0.0, residual[9], tangent[81], heat[2], dissipation = 0.0, energy = 0.0,
         friction_energy = 0.0;
  std::int32_t flags = 0;

private:
  Handle model_;
  ents_layout layout_;
  std::vector<double> begin_, end_;
};

} // namespace laws::heated
