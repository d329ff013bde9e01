// SPDX-License-Identifier: BSD-3-Clause
// Pictures of runs with friction or with two elastic bodies.
#include "friction_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "exact.hpp"
#include "output/table.hpp"

namespace host {

using pictures::Chart;
using pictures::Curve;
using pictures::Style;

Chart partial_slip_profile(Simulation& simulation, const StepRecord& record) {
  const Scene& scene = simulation.scene();
  const ElementSetup& setup = scene.parts.front().setup;
  const SurfaceState state = surface_state(simulation, record);
  const double mu = scene.exact.coefficient, normal = -state.contact_force[1] / setup.thickness,
               shear = std::abs(state.contact_force[0]) / setup.thickness;
  const HertzLine hertz = hertz_line(normal, scene.exact.radius, setup.material.contact_modulus() / 2);
  const double a = hertz.half_width, c = a * std::sqrt(std::max(0., 1 - shear / (mu * normal)));
  const auto ellipse = [](double x, double edge) {
    return std::sqrt(std::max(0., 1 - x * x / (edge * edge)));
  };
  Chart chart;
  chart.title = "Pressure and shear traction, last step";
  chart.subtitle = "exact: Cattaneo, Mindlin; Q / (μ P) = " + format_number(shear / (mu * normal), 3) + ", " +
                   std::to_string(state.place.size()) + " slave nodes";
  chart.x = {"x", scene.units.length};
  chart.y = {"traction", scene.units.pressure, false, 0};
  Curve pressure{"μ p, exact", {}, {}, Style::exact}, traction{"q, exact", {}, {}, Style::exact_dashed};
  for (int i = -400; i <= 400; ++i) {
    const double x = a * i / 400;
    const double p = mu * hertz.peak_pressure * ellipse(x, a);
    pressure.x.push_back(x), traction.x.push_back(x);
    pressure.y.push_back(p);
    traction.y.push_back(c > 0 ? p - mu * hertz.peak_pressure * c / a * ellipse(x, c) : p);
  }
  Curve nodes{"μ p, slave nodes", {}, {}, Style::points}, shears{"q, slave nodes", {}, {}, Style::points};
  for (std::size_t k = 0; k < state.place.size(); ++k) {
    if (std::abs(state.place[k]) > 1.2 * a) continue;
    nodes.x.push_back(state.place[k]), shears.x.push_back(state.place[k]);
    nodes.y.push_back(mu * state.pressure[k]);
    shears.y.push_back(std::abs(state.shear[k]));
  }
  chart.curves = {pressure, traction, nodes, shears};
  chart.guides = {{"stick", -c}, {"", c}};
  return chart;
}

Chart force_history(const Scene& scene, const std::vector<StepRecord>& records) {
  Chart chart;
  chart.title = "Contact force";
  chart.subtitle = scene.title;
  chart.x = {"load factor", ""};
  chart.y = {"force on the master", scene.units.force};
  static constexpr std::array<const char*, 3> axes{"x", "y", "z"};
  for (std::size_t i = 0; i < static_cast<std::size_t>(scene.dimension); ++i) {
    Curve curve{axes[i], {}, {}, records.size() > 20 ? Style::line : Style::both};
    for (const StepRecord& record : records) {
      curve.x.push_back(record.value);
      curve.y.push_back(record.contact_force[i]);
    }
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

Chart screw_torque_history(const Scene& scene, const std::vector<StepRecord>& records) {
  Chart chart;
  chart.title = "Torque over axial force";
  chart.subtitle = scene.title + "; exact: a rigid helix with inclined flanks";
  chart.x = {"turns", ""};
  chart.y = {"torque / force", scene.units.length, false, 0};
  Curve computed{"computed", {}, {}, Style::points}, exact{"exact", {}, {}, Style::exact};
  for (const StepRecord& record : records) {
    double angle = 0;
    for (const BodyComponent& c : scene.contact->body->prescribed)
      if (c.component == 5) angle += c.value * c.path.at(record.value);
    for (const Quantity& quantity : record.exact) {
      if (!quantity.compared) continue;
      for (Curve* curve : {&computed, &exact}) curve->x.push_back(std::abs(angle) / (2 * std::numbers::pi));
      computed.y.push_back(quantity.value), exact.y.push_back(quantity.exact);
    }
  }
  double largest = 0;
  for (const double value : computed.y) largest = std::max(largest, value);
  if (largest > 0) chart.y.max = 1.15 * largest;
  chart.curves = {exact, computed};
  return chart;
}

} // namespace host
