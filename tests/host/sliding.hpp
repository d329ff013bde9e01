// SPDX-License-Identifier: BSD-3-Clause
// A small scene with friction for the tests: an elastic block pressed on an elastic slab, then dragged along
// it over several of its segments and back.
#pragma once

#include "support.hpp"

namespace host::test {

/// @param length,pressure  one millimetre and one megapascal in the units wanted; forces follow
inline Json sliding(const Json& normal, const Json& friction, const std::string& segment = "bspline4",
                    double length = 1, double pressure = 1) {
  const auto scaled = [&](Json law) {
    const double exponent = law.value("exponent", 1.);
    for (const char* key : {"stiffness", "coefficient"})
      if (law.contains(key) && !(law.at("type") == "coulomb" && std::string(key) == "coefficient"))
        law[key] = law.at(key).get<double>() * pressure / std::pow(length, exponent);
    for (const char* key : {"pressure", "shear_limit"})
      if (law.contains(key)) law[key] = law.at(key).get<double>() * pressure;
    if (law.contains("clearance")) law["clearance"] = law.at("clearance").get<double>() * length;
    return law;
  };
  Json contact{{"normal", scaled(normal)}};
  if (!friction.is_null()) contact["friction"] = scaled(friction);
  const double l = length;
  return {
      {"dimension", 2},
      {"formulation", "plane_strain"},
      {"thickness", l},
      {"materials", {{"m", {{"law", "linear_elastic"}, {"young", 100 * pressure}, {"poisson", 0.3}}}}},
      {"parts",
       {{{"name", "slab"},
         {"material", "m"},
         {"element", "quad4"},
         {"x", axis(-2 * l, 2 * l, 20)},
         {"y", axis(-l, 0, 4)}},
        {{"name", "block"},
         {"material", "m"},
         {"element", "quad4"},
         {"x", axis(-0.55 * l, 0.55 * l, 7)},
         {"y", axis(0, 0.6 * l, 3)}}}},
      {"supports",
       {{{"nodes", "slab.y_min"}, {"x", 0}, {"y", 0}},
        {{"nodes", "block.y_max"}, {"y", -0.01 * l}, {"path", {{0, 0}, {1, 1}}}},
        {{"nodes", "block.y_max"}, {"x", 0.4 * l}, {"path", {{1, 0}, {2, 1}, {3, 0.5}}}}}},
      {"contact",
       {{"slave", "block.y_min"},
        {"master", {{"faces", "slab.y_max"}, {"surface_coordinates", {"x"}}}},
        {"model", {{"segment", segment}, {"contact", contact}}}}},
      {"solver", {{"tolerance", 1e-12}, {"extrapolate", true}}},
      {"steps",
       {{"control", "load_factor"}, {"values", {{{"to", 1}, {"count", 2}}, {{"to", 3}, {"count", 40}}}}}}};
}

inline const Json penalty{{"type", "penalty"}, {"stiffness", 1e4}};
inline const Json coulomb{{"type", "coulomb"}, {"coefficient", 0.3}, {"stiffness", 2e3}};

} // namespace host::test
