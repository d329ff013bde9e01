// SPDX-License-Identifier: BSD-3-Clause
#include "exact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>

#include <Eigen/Dense>

namespace host {
namespace {

using std::numbers::pi;

double squared(double value) { return value * value; }

} // namespace

HertzLine hertz_line(double force, double radius, double contact_modulus) {
  return {std::sqrt(4 * force * radius / (pi * contact_modulus)),
          std::sqrt(force * contact_modulus / (pi * radius))};
}

HertzPoint hertz_point(double approach, double radius, double contact_modulus) {
  const double contact_radius = std::sqrt(radius * approach);
  const double force = 4. / 3 * contact_modulus * contact_radius * approach;
  return {force, contact_radius, 3 * force / (2 * pi * squared(contact_radius))};
}

HertzPoint hertz_point_under(double force, double radius, double contact_modulus) {
  const double contact_radius = std::cbrt(3 * force * radius / (4 * contact_modulus));
  return {force, contact_radius, 3 * force / (2 * pi * squared(contact_radius))};
}

double hertz_pressure(double peak, double half_width, double x) {
  return peak * std::sqrt(std::max(0., 1 - squared(x / half_width)));
}

double westergaard_full_contact(double amplitude, double wavelength, double contact_modulus) {
  return pi * contact_modulus * amplitude / wavelength;
}

double westergaard_half_width(double full, double mean, double wavelength) {
  return wavelength / pi * std::asin(std::sqrt(std::min(mean / full, 1.)));
}

double westergaard_pressure(double full, double mean, double x, double wavelength) {
  if (mean >= full) return mean + full * std::cos(2 * pi * x / wavelength);
  const double edge = mean / full; // sin^2(pi a / lambda)
  const double rest = edge - squared(std::sin(pi * x / wavelength));
  return rest > 0 ? 2 * mean * std::cos(pi * x / wavelength) / edge * std::sqrt(rest) : 0;
}

double westergaard_gap(double amplitude, double half_width, double x, double wavelength) {
  const double S = std::abs(std::sin(pi * x / wavelength)), s = std::sin(pi * half_width / wavelength);
  if (!(S > s)) return 0;
  const double bent = s > 0 ? squared(s) * std::acosh(S / s) : 0;
  return 2 * amplitude * (S * std::sqrt(squared(S) - squared(s)) - bent);
}

double westergaard_mean_gap(double amplitude, double part) {
  if (part >= 1) return 0;
  return amplitude * (1 - part + (part > 0 ? part * std::log(part) : 0));
}

double double_sine_full_contact(double amplitude, double wavelength, double contact_modulus) {
  return std::numbers::sqrt2 * pi * contact_modulus * amplitude / wavelength;
}

double worn_groove_depth(double area, double radius) {
  return std::cbrt(squared(0.75 * area) / (2 * radius));
}

double contact_edge(const SurfaceState& state, double limit) {
  std::vector<std::size_t> closed;
  for (std::size_t k = 0; k < state.closed.size(); ++k)
    if (state.closed[k]) closed.push_back(k);
  if (closed.size() == state.closed.size()) return limit;
  if (closed.size() < 4) return std::numeric_limits<double>::quiet_NaN();
  std::sort(closed.begin(), closed.end(),
            [&](std::size_t a, std::size_t b) { return state.distance[a] < state.distance[b]; });
  const double outermost = state.distance[closed.back()];
  // The outermost node, and its mirror image if both halves are there, left out.
  const double reach = 1e-6 * outermost;
  while (closed.size() > 3 && state.distance[closed.back()] > outermost - reach) closed.pop_back();
  const std::size_t count = std::clamp<std::size_t>(closed.size() / 2, 3, 12);
  const std::span<const std::size_t> outer = std::span(closed).last(count);
  const double scale = state.distance[outer.back()];
  Eigen::MatrixXd A(static_cast<Eigen::Index>(count), 3);
  Eigen::VectorXd b(static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const double x = state.distance[outer[i]] / scale - 1;
    A.row(static_cast<Eigen::Index>(i)) << 1, x, x * x;
    b[static_cast<Eigen::Index>(i)] = squared(state.pressure[outer[i]]);
  }
  const Eigen::Vector3d c = A.colPivHouseholderQr().solve(b);
  // First zero outside of the last node taken: c0 + c1 x + c2 x^2 = 0 with c0 > 0.
  const double discriminant = c[1] * c[1] - 4 * c[2] * c[0];
  if (!(discriminant >= 0) || !(c[1] < 0)) return std::min(limit, outermost);
  const double x = 2 * c[0] / (-c[1] + std::sqrt(discriminant));
  return std::min(limit, scale * (1 + x));
}

EdgeBracket edge_bracket(const SurfaceState& state) {
  EdgeBracket bracket;
  for (std::size_t k = 0; k < state.closed.size(); ++k)
    if (state.closed[k])
      bracket.closed = std::max(bracket.closed, state.distance[k]);
    else
      bracket.open = std::min(bracket.open, state.distance[k]);
  return bracket;
}

namespace {

using Quantities = std::vector<Quantity>;

double peak_of(const SurfaceState& state) {
  return *std::max_element(state.pressure.begin(), state.pressure.end());
}

Quantities compare_with_hertz_line(const Scene& scene, const SurfaceState& state) {
  const ExactSpec& exact = scene.exact;
  const double modulus = contact_modulus(scene);
  const UnitNames& units = scene.units;
  const ElementSetup& setup = scene.parts.front().setup;
  const HertzLine reference = hertz_line(state.force / setup.thickness, exact.radius, modulus);
  const EdgeBracket bracket = edge_bracket(state);
  return {exact_quantity("peak pressure", units.pressure, peak_of(state), reference.peak_pressure),
          exact_quantity("half-width", units.length, contact_edge(state), reference.half_width),
          {"last closed node", units.length, bracket.closed},
          {"first open node", units.length, bracket.open}};
}

Quantities compare_with_hertz_point(const Scene& scene, const SurfaceState& state) {
  const ExactSpec& exact = scene.exact;
  const double modulus = contact_modulus(scene);
  const UnitNames& units = scene.units;
  double area = 0;
  for (std::size_t k = 0; k < state.area.size(); ++k)
    if (state.closed[k]) area += state.area[k] * scene.symmetry_copies;
  const double radius = scene.dimension == 3 ? std::sqrt(area / pi) : contact_edge(state);
  // The approach is one to points far away, which only a half-space has.
  const HertzPoint reference = scene.half_space ? hertz_point(state.approach, exact.radius, modulus)
                                                : hertz_point_under(state.force, exact.radius, modulus);
  std::vector<Quantity> result{
      exact_quantity("peak pressure", units.pressure, peak_of(state), reference.peak_pressure),
      exact_quantity("contact radius", units.length, radius, reference.radius)};
  if (scene.dimension == 3 && !std::isnan(state.contact_estimate)) {
    const double all = std::accumulate(state.area.begin(), state.area.end(), 0.) * scene.symmetry_copies;
    result.push_back(exact_quantity("contact radius, estimated", units.length,
                                    std::sqrt(state.contact_estimate * all / pi), reference.radius));
  }
  if (scene.half_space)
    result.insert(result.begin(), exact_quantity("force", units.force, state.force, reference.force));
  return result;
}

Quantities compare_with_westergaard(const Scene& scene, const SurfaceState& state) {
  const ExactSpec& exact = scene.exact;
  const double modulus = contact_modulus(scene);
  const UnitNames& units = scene.units;
  const double full = westergaard_full_contact(exact.amplitude, exact.wavelength, modulus);
  const double edge = contact_edge(state, exact.wavelength / 2);
  const EdgeBracket bracket = edge_bracket(state);
  const double sine = std::sin(pi * edge / exact.wavelength);
  const double exact_edge = westergaard_half_width(full, state.mean_pressure, 1);
  double area = 0, gap = 0, off = 0;
  for (std::size_t k = 0; k < state.area.size(); ++k) {
    area += state.area[k], gap += state.area[k] * state.gap[k];
    const double there =
        westergaard_gap(exact.amplitude, exact_edge * exact.wavelength, state.distance[k], exact.wavelength);
    off += state.area[k] * squared(state.gap[k] - there);
  }
  const double mean_gap = westergaard_mean_gap(exact.amplitude, state.mean_pressure / full);
  return {exact_quantity("mean pressure / p*", "", state.mean_pressure / full, squared(sine)),
          exact_quantity("half-width / lambda", "", edge / exact.wavelength, exact_edge),
          mean_gap > 0.01 * exact.amplitude ? exact_quantity("mean gap", units.length, gap / area, mean_gap)
                                            : Quantity{"mean gap", units.length, gap / area},
          {"gap (rms of the difference, of the amplitude)", "", std::sqrt(off / area) / exact.amplitude},
          {"last closed node / lambda", "", bracket.closed / exact.wavelength},
          {"first open node / lambda", "", bracket.open / exact.wavelength}};
}

Quantities compare_with_double_sine(const Scene& scene, const SurfaceState& state) {
  const ExactSpec& exact = scene.exact;
  const double modulus = contact_modulus(scene);
  const UnitNames& units = scene.units;
  const double full = double_sine_full_contact(exact.amplitude, exact.wavelength, modulus);
  std::vector<Quantity> result;
  result.push_back({"mean pressure / p*", "", state.mean_pressure / full});
  // In full contact the problem is linear: taking off the smallest pressure everywhere leaves the state in
  // which the last point is about to come off.
  if (std::all_of(state.closed.begin(), state.closed.end(), [](char c) { return c != 0; })) {
    const double smallest = *std::min_element(state.pressure.begin(), state.pressure.end());
    result.push_back(
        exact_quantity("full-contact pressure", units.pressure, state.mean_pressure - smallest, full));
  }
  return result;
}

Quantities compare_with_worn_cylinder(const Scene& scene, const SurfaceState& state) {
  const ExactSpec& exact = scene.exact;
  const double modulus = contact_modulus(scene);
  const UnitNames& units = scene.units;
  const ElementSetup& setup = scene.parts.front().setup;
  const double k = scene.contact->model.at("contact").at("wear").at("coefficient").get<double>();
  const double volume = k * state.force * state.slid;
  const double depth = worn_groove_depth(volume / setup.thickness, exact.radius);
  const HertzLine elastic = hertz_line(state.force / setup.thickness, exact.radius, modulus);
  if (!(volume > 0)) return {};
  std::vector<Quantity> result{exact_quantity("worn volume", cubic(units.length), state.worn_volume, volume)};
  if (std::sqrt(2 * exact.radius * depth) > 10 * elastic.half_width)
    result.push_back(exact_quantity("worn depth", units.length, state.worn_depth, depth));
  return result;
}

Quantities compare_with_uniform_pressure(const Scene& scene, const SurfaceState& state) {
  const ExactSpec& exact = scene.exact;
  const UnitNames& units = scene.units;
  double squares = 0, area = 0;
  for (std::size_t k = 0; k < state.pressure.size(); ++k) {
    squares += state.area[k] * squared(state.pressure[k] / exact.pressure - 1);
    area += state.area[k];
  }
  return {exact_quantity("largest pressure", units.pressure, peak_of(state), exact.pressure),
          exact_quantity("smallest pressure", units.pressure,
                         *std::min_element(state.pressure.begin(), state.pressure.end()), exact.pressure),
          {"scatter of the pressure (rms)", "", std::sqrt(squares / area)}};
}

} // namespace

std::vector<Quantity> compare_with_exact(const Scene& scene, const SurfaceState& state) {
  using Type = ExactSpec::Type;
  switch (scene.exact.type) {
  case Type::hertz_line:
    return compare_with_hertz_line(scene, state);
  case Type::hertz_point:
    return compare_with_hertz_point(scene, state);
  case Type::westergaard:
    return compare_with_westergaard(scene, state);
  case Type::double_sine:
    return compare_with_double_sine(scene, state);
  case Type::worn_cylinder:
    return compare_with_worn_cylinder(scene, state);
  case Type::cattaneo:
    return compare_with_cattaneo(scene, state);
  case Type::slope:
    return compare_with_slope(scene, state);
  case Type::screw:
    return compare_with_screw(scene, state);
  case Type::uniform_pressure:
    return compare_with_uniform_pressure(scene, state);
  case Type::boundary_elements: // exact_layer.hpp
  case Type::none:
    break;
  }
  return {};
}

} // namespace host
