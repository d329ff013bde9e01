// SPDX-License-Identifier: BSD-3-Clause
// Which maps there are.
#include <cmath>
#include <numbers>

#include "chart/map.hpp"
#include "chart/true_sheet.hpp"

namespace host::chart {
namespace {

using std::numbers::pi;

std::vector<double> spaced(double from, double to, int count, bool logarithmic) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / (count - 1);
    values.push_back(logarithmic ? from * std::pow(to / from, t) : from + t * (to - from));
  }
  return values;
}

std::vector<double> powers_of_two(int most, int factor) {
  std::vector<double> values;
  for (int n = 1; n <= most; n *= factor) values.push_back(n);
  return values;
}

/// A wave that vanishes at the segments' ends, on a slightly hollow row.
Profile wavy(SurfaceKind surface, double amplitude, double waves) {
  Profile profile;
  profile.surface = surface;
  profile.curvature = 0.1;
  profile.height.sum = {{amplitude, waves, 0}};
  profile.wavelength = 1 / waves;
  return profile;
}

/// Radius of curvature of a wave's crest.
double crest_radius(double amplitude, double waves) { return 1 / (amplitude * std::pow(2 * pi * waves, 2)); }

Map amplitude_over_waves(bool quick) {
  Map map;
  map.name = "amplitude";
  map.title = "Amplitude and wave number";
  map.text =
      "A sine of the given amplitude on a slightly hollow row of segments (curvature 0.1), 16 increments.";
  map.x = {"waves in a segment", quick ? std::vector<double>{0.5, 2, 4} : spaced(0.5, 5, 10, false)};
  map.y = {"amplitude / segment", spaced(0.002, 0.3, quick ? 4 : 14, true)};
  map.problem = [](double waves, double amplitude, const Method& method) {
    PressOptions options{wavy(method.surface, amplitude, waves), method};
    return make_press(options);
  };
  return map;
}

Map height_over_curvature(bool quick) {
  Map map;
  map.name = "curvature";
  map.title = "Height and curvature of the segments";
  map.text = "The surface runs at the height |h| above a hollow (curvature > 0) or a hill (< 0), with a fine "
             "wave on it. The local "
             "enrichment must come back to zero at every end of a segment: one bump of that height on each.";
  map.x = {"curvature x segment", spaced(-0.6, 0.6, quick ? 3 : 13, false)};
  map.y = {"|h| / segment", quick ? spaced(0.05, 2.5, 3, true) : spaced(0.02, 3, 13, true)};
  map.problem = [](double curvature, double height, const Method& method) {
    Profile profile;
    profile.surface = method.surface;
    profile.curvature = curvature;
    profile.height.sum = {{0.004, 2, 0}};
    profile.wavelength = 0.5;
    profile.height.constant = height;
    if (method.surface == SurfaceKind::local) { // h sin^2(pi s)
      profile.height.constant = 0.5 * height;
      profile.height.sum.push_back({-0.5 * height, 1, 0.5 * pi});
    }
    return make_press({profile, method});
  };
  return map;
}

Map penetration_over_step(bool quick) {
  Map map;
  map.name = "penetration";
  map.title = "Penetration and load step";
  map.text = "Penetration on the crests of a sine (amplitude 0.05, one wave in a segment) over the radius of "
             "curvature there, by a softer "
             "and softer penalty under the same force.";
  map.x = {"penetration / curvature radius", spaced(0.01, 3, quick ? 4 : 13, true)};
  map.y = {"increments", powers_of_two(64, quick ? 8 : 2)};
  map.problem = [](double ratio, double increments, const Method& method) {
    const double amplitude = 0.05, depth = 0.1, radius = crest_radius(amplitude, 1);
    PressOptions options{wavy(method.surface, amplitude, 1), method};
    // force on a crest = stiffness (depth + amplitude - p) = penalty p; depth grows with p so that the force
    // stays
    const double force = amplitude + depth, penetration = ratio * radius;
    options.depth = depth + penetration;
    options.penalty = force / penetration;
    options.increments = static_cast<int>(increments);
    return make_press(options);
  };
  return map;
}

Map stiffness_over_step(bool quick) {
  Map map;
  map.name = "stiffness";
  map.title = "Penalty stiffness and load step";
  map.text = "The same sine; penalty stiffness over that of the spring.";
  map.x = {"penalty / spring", spaced(1, 1e6, quick ? 3 : 13, true)};
  map.y = {"increments", powers_of_two(64, quick ? 8 : 2)};
  map.problem = [](double penalty, double increments, const Method& method) {
    PressOptions options{wavy(method.surface, 0.05, 1), method};
    options.depth = 0.1;
    options.penalty = penalty;
    options.increments = static_cast<int>(increments);
    return make_press(options);
  };
  return map;
}

Map space(bool quick) {
  Map map;
  map.name = "space";
  map.title = "Amplitude and wave number, in space";
  map.text = "A product of two sines on a flat row of quad4 segments (local enrichment). The node goes "
             "across the row at an angle, over "
             "three borders of segments. 16 increments.";
  map.x = {"waves in a segment", quick ? std::vector<double>{0.5, 2} : spaced(0.5, 4, 8, false)};
  map.y = {"amplitude / segment", spaced(0.004, 0.2, quick ? 2 : 8, true)};
  map.surfaces = {SurfaceKind::local};
  map.problem = [](double waves, double amplitude, const Method& method) {
    return make_press_in_space(amplitude, waves, method);
  };
  return map;
}

} // namespace

std::vector<Map> stability_maps(bool quick) {
  return {amplitude_over_waves(quick), height_over_curvature(quick), penetration_over_step(quick),
          stiffness_over_step(quick), space(quick)};
}

} // namespace host::chart
