// SPDX-License-Identifier: BSD-3-Clause
// Where the contact of an exact solution has its axis, and whether the rigid master has the shape that is
// solved for.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "ents_library.hpp"
#include "exact.hpp"
#include "output/table.hpp"

namespace host {
namespace {

using Type = ExactSpec::Type;

/// The master's profile in the plane: x and how far it is ahead along its motion.
struct Profile {
  std::vector<double> x, ahead;
};

Profile profile_of(const Scene& scene, const EntsLibrary& library) {
  const ContactSpec& contact = *scene.contact;
  const EntsModel model(library, contact.model.dump(), scene.file.parent_path(), contact.model_where);
  constexpr std::size_t count = 20000;
  const SurfaceSample sample = sample_surface(model, contact.rigid, {}, even_grid(1, count));
  Profile profile;
  for (std::size_t i = 0; i <= count; ++i) {
    profile.x.push_back(sample.point[2 * i]);
    profile.ahead.push_back(sample.point[2 * i + 1] * contact.direction[1]);
  }
  return profile;
}

/// x of the place that is farthest ahead: the vertex of the parabola through the three points round it.
struct Crest {
  double x, ahead;
};
Crest crest_of(const Profile& profile) {
  const auto best = std::max_element(profile.ahead.begin(), profile.ahead.end());
  const auto i = static_cast<std::size_t>(best - profile.ahead.begin());
  if (i == 0 || i + 1 == profile.x.size()) return {profile.x[i], *best}; // half of a symmetric body
  const double h0 = profile.x[i] - profile.x[i - 1], h1 = profile.x[i + 1] - profile.x[i];
  const double s0 = (profile.ahead[i] - profile.ahead[i - 1]) / h0,
               s1 = (profile.ahead[i + 1] - profile.ahead[i]) / h1;
  const double curvature = 2 * (s1 - s0) / (h0 + h1), slope = (s0 * h1 + s1 * h0) / (h0 + h1);
  if (!(curvature < 0)) return {profile.x[i], *best};
  return {profile.x[i] - slope / curvature, *best - 0.5 * slope * slope / curvature};
}

} // namespace

double contact_modulus(const Scene& scene) {
  const PartSpec* part = scene.contact ? part_of_set(scene, scene.contact->slave) : nullptr;
  return contact_modulus((part != nullptr ? *part : scene.parts.front()).setup);
}

double contact_modulus(const ElementSetup& setup) {
  return setup.formulation == Formulation::plane_stress ? setup.material.young
                                                        : setup.material.contact_modulus();
}

ExactAxis exact_axis(const Scene& scene, const EntsLibrary& library) {
  const ExactSpec& exact = scene.exact;
  const bool round = exact.type == Type::hertz_line || exact.type == Type::hertz_point;
  if (scene.dimension != 2 || !(round || exact.type == Type::westergaard)) return {};
  const Profile profile = profile_of(scene, library);
  const Crest crest = crest_of(profile);
  ExactAxis result;
  result.x = crest.x;
  // Of a circle a fiftieth of its radius is a parabola to 1e-4.
  const double reach = round ? exact.radius / 50 : exact.wavelength / 2;
  const double size = round ? reach * reach / (2 * exact.radius) : exact.amplitude;
  double worst = 0;
  for (std::size_t i = 0; i < profile.x.size(); ++i) {
    const double x = profile.x[i] - crest.x;
    if (std::abs(x) > reach) continue;
    const double depth = round
                             ? x * x / (2 * exact.radius)
                             : exact.amplitude * (1 - std::cos(2 * std::numbers::pi * x / exact.wavelength));
    worst = std::max(worst, std::abs(crest.ahead - profile.ahead[i] - depth));
  }
  if (worst > 0.01 * size)
    result.mismatch = exact.where + ": the master's surface is not the " +
                      (round ? "circle of this radius" : "wave of this amplitude and length") +
                      ": round x = " + format_number(crest.x) + " it differs by " + format_number(worst);
  if (exact.type == Type::hertz_point && std::abs(crest.x) > 1e-6 * exact.radius)
    result.mismatch = exact.where + ": the sphere's crest lies at x = " + format_number(crest.x) +
                      ", not on the axis x = 0";
  return result;
}

double distance_from(const ExactAxis& axis, const ExactSpec& exact, double x) {
  const double from = std::abs(x - axis.x);
  if (exact.type != Type::westergaard) return from;
  return std::abs(std::remainder(from, exact.wavelength)); // of the nearest crest
}

} // namespace host
