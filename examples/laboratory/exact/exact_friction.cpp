// SPDX-License-Identifier: BSD-3-Clause
// Exact solutions with friction.
//
// Two equal elastic cylinders (K. L. Johnson, Contact Mechanics, 1985, sections 4.2(c), 7.2(a); C. Cattaneo
// 1938, R. D. Mindlin 1949). Normal force P and then tangential force Q < mu P per length, R the relative
// radius of curvature, 1/E* = 2 (1 - nu^2) / E (plane stress: 2 / E):
//   a^2 = 4 P R / (pi E*),  p0 = 2 P / (pi a),  stick for |x| <= c = a sqrt(1 - Q / (mu P)),
//   q = mu p0 (sqrt(1 - x^2/a^2) - (c/a) sqrt(1 - x^2/c^2)).
// An elliptical traction of total Q on |x| <= a moves the surface of one half-plane by (ibid., 2.25b)
//   u(x) = -2 (1 - nu^2) / (pi E) Q f(x, a) + constant,
//     f = ln(a/2) - 1/2 + x^2/a^2                                             |x| <= a,
//     f = ln((|x| + r)/2) - 1/2 + |x| (|x| - r) / a^2,  r = sqrt(x^2 - a^2)   |x| > a,
// so the stick zone moves relative to the points at |x| = L of its own surface by
//   2 (1 - nu^2) / (pi E) (mu P (f(L, a) - f(0, a)) - (mu P - Q) (f(L, c) - f(0, c))).
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "exact.hpp"

namespace host {
namespace {

using std::numbers::pi;

/// f(x, a) of the comment above.
double elliptical(double x, double a) {
  x = std::abs(x);
  if (x <= a) return std::log(a / 2) - 0.5 + x * x / (a * a);
  const double r = std::sqrt(x * x - a * a);
  return std::log((x + r) / 2) - 0.5 + x * (x - r) / (a * a);
}

/// Displacement at a place between the nodes, which lie in any order.
double interpolate(const SurfaceState& state, double x) {
  std::size_t below = state.place.size(), above = below;
  for (std::size_t k = 0; k < state.place.size(); ++k) {
    if (state.place[k] <= x && (below == state.place.size() || state.place[k] > state.place[below]))
      below = k;
    if (state.place[k] >= x && (above == state.place.size() || state.place[k] < state.place[above]))
      above = k;
  }
  if (below == state.place.size() || above == below || above == state.place.size())
    return state.moved[std::min({below, above, state.moved.size() - 1})];
  const double t = (x - state.place[below]) / (state.place[above] - state.place[below]);
  return (1 - t) * state.moved[below] + t * state.moved[above];
}

/// Half-axis of the ellipse mu p - |q| over the stick zone: its square is a straight line over x^2, fitted by
/// least squares to the sticking nodes; the outer fifth, where single nodes begin to slip, is left out.
double stick_edge(const SurfaceState& state, double coefficient) {
  double outermost = 0;
  for (std::size_t k = 0; k < state.place.size(); ++k)
    if (state.sticks[k]) outermost = std::max(outermost, std::abs(state.place[k]));
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t k = 0; k < state.place.size(); ++k) {
    if (!state.sticks[k] || std::abs(state.place[k]) > 0.8 * outermost) continue;
    const double rest = coefficient * state.pressure[k] - std::abs(state.shear[k]);
    const double a = state.place[k] * state.place[k], b = rest * rest;
    n += 1, x += a, y += b, xx += a * a, xy += a * b;
  }
  const double slope = (n * xy - x * y) / (n * xx - x * x);
  return std::sqrt(x / n - y / n / slope);
}

} // namespace

std::vector<Quantity> compare_with_cattaneo(const Scene& scene, const SurfaceState& state) {
  const ExactSpec& exact = scene.exact;
  const ElementSetup& setup = scene.parts.front().setup;
  const UnitNames& units = scene.units;
  const double modulus = contact_modulus(scene) / 2; // two equal bodies
  // The slave is above: it presses the master down and drags it along.
  const double normal = -state.contact_force[1] / setup.thickness,
               shear = state.contact_force[0] / setup.thickness;
  if (!(normal > 0)) return {};
  const HertzLine hertz = hertz_line(normal, exact.radius, modulus);
  const double peak = *std::max_element(state.pressure.begin(), state.pressure.end());
  std::vector<Quantity> result{
      exact_quantity("peak pressure", units.pressure, peak, hertz.peak_pressure),
      exact_quantity("half-width", units.length, contact_edge(state), hertz.half_width)};
  const double limit = exact.coefficient * normal, ratio = std::abs(shear) / limit;
  result.push_back({"Q / mu P", "", ratio});
  if (ratio < 0.02) return result; // slip has not come further in than a node or two
  const double stick = hertz.half_width * std::sqrt(std::max(0., 1 - ratio));
  result.push_back(
      exact_quantity("stick half-width", units.length, stick_edge(state, exact.coefficient), stick));
  double last_stick = 0, first_slip = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < state.place.size(); ++k) {
    if (state.sticks[k]) last_stick = std::max(last_stick, std::abs(state.place[k]));
    if (state.closed[k] && !state.sticks[k]) first_slip = std::min(first_slip, std::abs(state.place[k]));
  }
  result.push_back({"last sticking node", units.length, last_stick});
  result.push_back({"first slipping node", units.length, first_slip});
  const double moved = std::abs(interpolate(state, 0) - 0.5 * (interpolate(state, exact.distance) +
                                                               interpolate(state, -exact.distance)));
  const double reach = exact.distance, rest_force = limit - std::abs(shear);
  const double compliance = 2 / (pi * contact_modulus(scene));
  const double inner = rest_force > 0 ? rest_force * (elliptical(reach, stick) - elliptical(0, stick)) : 0;
  result.push_back(exact_quantity(
      "tangential displacement", units.length, moved,
      compliance *
          (limit * (elliptical(reach, hertz.half_width) - elliptical(0, hertz.half_width)) - inner)));
  return result;
}

std::vector<Quantity> compare_with_slope(const Scene& scene, const SurfaceState& state) {
  // The slope pushes back along its normal, which is y here; gravity turns instead.
  const double normal = std::abs(state.contact_force[1]), friction = std::abs(state.contact_force[0]);
  const double tangent = std::abs(state.load[0] / state.load[1]);
  double slipping = 0, closed = 0;
  for (std::size_t k = 0; k < state.closed.size(); ++k) {
    closed += state.closed[k];
    slipping += state.closed[k] && !state.sticks[k];
  }
  std::vector<Quantity> result;
  result.push_back({"tan(slope) / mu", "", tangent / scene.exact.coefficient});
  if (tangent > 0)
    result.push_back(exact_quantity("friction / mu N", "", friction / (scene.exact.coefficient * normal),
                                    std::min(tangent / scene.exact.coefficient, 1.)));
  result.push_back({"slipping nodes", "%", closed > 0 ? 100 * slipping / closed : 0});
  // Beyond the threshold only the springs under the block hold what friction does not.
  double moved = 0, area = 0;
  for (std::size_t k = 0; k < state.moved.size(); ++k)
    moved += state.area[k] * state.moved[k], area += state.area[k];
  moved = std::abs(moved / area);
  const double rest = std::abs(state.load[0]) - scene.exact.coefficient * std::abs(state.load[1]);
  if (rest > 0 && !scene.springs.empty())
    result.push_back(exact_quantity("moved", scene.units.length, moved,
                                    rest / (scene.springs.front().stiffness[0] * area)));
  else
    result.push_back({"moved", scene.units.length, moved, std::numeric_limits<double>::quiet_NaN(),
                      std::numeric_limits<double>::quiet_NaN(), true});
  return result;
}

} // namespace host
