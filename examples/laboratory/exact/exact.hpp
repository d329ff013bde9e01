// SPDX-License-Identifier: BSD-3-Clause
// Exact solutions of elastic contact with a rigid body, and what a computed step says about the same
// quantities. E* = E / (1 - nu^2), in plane stress E.
//   Hertz, line and point contact: K. L. Johnson, Contact Mechanics, 1985, sections 4.2(a), 4.2(c);
//   Westergaard's sinusoidal surface in plane strain: ibid., section 13.2;
//   double sine, full contact: K. L. Johnson, J. A. Greenwood, J. G. Higginson, Int. J. Mech. Sci.
//     27 (1985) 383.
#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "scene.hpp"

namespace host {

class EntsLibrary;

/// E* of the body that has the slave surface.
double contact_modulus(const Scene& scene);
double contact_modulus(const ElementSetup& setup);

/// The axis of the contact, along x: the crest of the rigid master, wherever the scene puts it.
struct ExactAxis {
  double x = 0;
  std::string mismatch; ///< the master does not have the shape that the solution is of, and errors would mean
                        ///< nothing; empty: it has
};
/// Solutions in the plane and round an axis; {} for all others, which have their axis where x = y = 0.
ExactAxis exact_axis(const Scene& scene, const EntsLibrary& library);

/// Distance of a place from the axis, of a wave: from its nearest crest.
double distance_from(const ExactAxis& axis, const ExactSpec& exact, double x);

struct HertzLine {
  double half_width, peak_pressure;
};
/// @param force  per length of the cylinder
HertzLine hertz_line(double force, double radius, double contact_modulus);

/// Depth of the groove of this cross-section that a rigid cylinder wears: the cylinder's own shape, of chord
/// 2 a, a^2 = 2 R d, area 4/3 a d. Elastic shapes are forgotten once a is many times the half-width of Hertz.
double worn_groove_depth(double area, double radius);

struct HertzPoint {
  double force, radius, peak_pressure;
};
/// @param approach  of the sphere relative to points far away
HertzPoint hertz_point(double approach, double radius, double contact_modulus);
/// The same from the force, which needs no points far away.
HertzPoint hertz_point_under(double force, double radius, double contact_modulus);

/// Pressure at a distance x from the middle of a contact, line or point, of this half width or radius.
double hertz_pressure(double peak, double half_width, double x);

/// p* = pi E* Delta / lambda: mean pressure of full contact with the sine of amplitude Delta.
double westergaard_full_contact(double amplitude, double wavelength, double contact_modulus);

/// Half width of the contact where the mean pressure of the wave is `mean`, below or at p*.
double westergaard_half_width(double full, double mean, double wavelength);

/// Pressure at a distance x from a crest, for mean pressures below and above p*.
double westergaard_pressure(double full, double mean, double x, double wavelength);

/// Gap at a distance x from a crest where the contact has this half-width a, 0 within it. With S = sin(pi x /
/// lambda), s = sin(pi a / lambda): 2 Delta (S sqrt(S^2 - s^2) - s^2 arcosh(S / s)), the integral of the
/// imaginary part of the function whose real part is the pressure.
double westergaard_gap(double amplitude, double half_width, double x, double wavelength);

/// Mean of this gap over a wave: Delta (1 - P + P ln P), P = mean pressure / p* = s^2. The mean displacement
/// is Delta less it, and the energy of an area p* Delta (P^2 / 4 - P^2 ln P / 2), because the pressure works
/// on the change of the mean gap.
double westergaard_mean_gap(double amplitude, double part);

/// sqrt(2) pi E* Delta / lambda: the same for Delta cos(2 pi x / lambda) cos(2 pi y / lambda).
double double_sine_full_contact(double amplitude, double wavelength, double contact_modulus);

/// What is known about the slave surface of a step.
struct SurfaceState {
  std::vector<double> distance;      ///< [slaves] from the axis of the contact, in the plane of the surface
  std::vector<double> pressure;      ///< [slaves]
  std::vector<double> gap;           ///< [slaves] NaN: nothing is opposite
  std::vector<double> area;          ///< [slaves] tributary, this mesh's share
  std::vector<char> closed;          ///< [slaves]
  std::vector<double> shear;         ///< [slaves] tangential traction on the master along x; in the plane
  std::vector<double> place;         ///< [slaves] reference x
  std::vector<double> place_y;       ///< [slaves] and y
  std::vector<double> moved;         ///< [slaves] displacement along x
  std::vector<char> sticks;          ///< [slaves] closed and not slipping
  std::vector<double> contact_force; ///< [d] of the slave nodes on the master, this mesh's share
  std::vector<double> load;          ///< [d] dead loads, this mesh's share
  double moment = 0;                 ///< of these about z, of a rigid body that turns
  double mean_radius = 0;            ///< weighted by the force along z
  int turning = 0;                   ///< 1, -1: the way such a body turns round z in this step
  double approach = 0;               ///< motion of the master since first touch
  double force = 0;                  ///< of all symmetric copies
  double mean_pressure = 0;
  double slid = 0, worn_volume = 0,
         worn_depth = 0; ///< wear: distance; what all copies of the slave have lost; deepest
  double contact_estimate = std::numeric_limits<double>::quiet_NaN(); ///< share of the area, contact_area.hpp
};

/// A computed quantity beside its exact value.
struct Quantity {
  std::string name, unit;
  double value = 0;
  double exact = std::numeric_limits<double>::quiet_NaN(); ///< NaN: nothing to compare with
  double error = std::numeric_limits<double>::quiet_NaN(); ///< relative, with sign
  bool compared = false;
};

/// One that is compared.
inline Quantity exact_quantity(std::string name, std::string unit, double value, double exact) {
  return {std::move(name), std::move(unit), value, exact, value / exact - 1, true};
}

/// Where the pressure vanishes, more finely than the nodes lie: p^2 falls linearly to zero at the edge of a
/// contact (Hertz, Westergaard: p ~ sqrt(a - x)). Least-squares parabola of p^2 through the outer closed
/// nodes, the outermost left out (its tributary area is partly open), continued to zero.
/// @return NaN with fewer than four closed nodes; `limit` at most (full contact)
double contact_edge(const SurfaceState& state, double limit = std::numeric_limits<double>::infinity());

/// Last closed and first open node: the edge lies between them.
struct EdgeBracket {
  double closed = 0, open = std::numeric_limits<double>::infinity();
};
EdgeBracket edge_bracket(const SurfaceState& state);

/// Cattaneo and Mindlin: two equal cylinders pressed together by a normal force and then sheared
/// (exact_friction.cpp has the formulae).
std::vector<Quantity> compare_with_cattaneo(const Scene& scene, const SurfaceState& state);

/// A block on a slope: the friction force is the lesser of the pull and coefficient times normal force.
std::vector<Quantity> compare_with_slope(const Scene& scene, const SurfaceState& state);

/// Torque over axial force of a screw (exact_screw.cpp). flank_angle: degrees, in an axial section
double screw_torque(double radius, double lead, double flank_angle, double coefficient, bool tightened);
std::vector<Quantity> compare_with_screw(const Scene& scene, const SurfaceState& state);

/// The scene's exact solution against a step; empty if the scene has none.
std::vector<Quantity> compare_with_exact(const Scene& scene, const SurfaceState& state);

} // namespace host
