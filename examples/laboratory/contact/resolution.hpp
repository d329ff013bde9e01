// SPDX-License-Identifier: BSD-3-Clause
// Is the slave's mesh fine enough for the height of a rigid segment, and for the tension of an adhesive law? The shortest wave of the height against
// the distance of the slave nodes, which see the surface at their places only, and against the elements below
// them, which are too soft for waves of a few elements.
#pragma once

#include <filesystem>
#include <limits>
#include <string>

#include "toolbox/json_reader.hpp"

namespace host {

struct Mesh;
struct Scene;

struct Resolution {
  /// Lengths [L]; NaN: not known.
  double wave = std::numeric_limits<double>::quiet_NaN(); ///< shortest of the height; infinite: it has none
  double spacing = 0;                                     ///< largest distance of neighbouring slave points
  double tension =
      std::numeric_limits<double>::infinity(); ///< length over which the tension of an adhesive law acts
                                               ///< beside the contact; infinite: none
  double depth = 0; ///< largest of an element below the slave surface; 0: a layer, which has none

  /// What would do: of slave points, and of elements in all directions.
  double spacing_needed() const;
  double element_needed() const;
  double tension_needed() const; ///< spacing
  bool too_coarse() const;
  bool too_coarse_for_waves() const;
  bool too_coarse_for_tension() const;
};

/// Shortest wave of a height along its surface coordinates, in units of s. Infinite: none, as of a sphere;
/// NaN: not known (an expression, a callback, a thread).
/// @param height      of a model that the library has read
/// @param folder      where file names start
/// @param directions  number of surface coordinates
double shortest_wave(const Json& height, const std::filesystem::path& folder, std::size_t directions);

/// Length (pi / 4) E* w / s^2 over which a tension of the strength s acts beside the contact of an elastic body, w the
/// work of adhesion: the zone of Dugdale (J. Mech. Phys. Solids 8 (1960) 100) at the edge of JKR's contact.
/// @param model    of a contact; infinite: its law does not adhere
/// @param modulus  E* of the body [F/L^2]
double tension_length(const Json& model, double modulus);

/// @param mesh  of the scene's bodies; for a contact with a rigid master of one plain segment, else not known
Resolution resolution_of(const Scene& scene, const Mesh& mesh);

/// One sentence or two for the terminal; empty: not known, or there are no waves.
std::string describe(const Resolution& resolution, const std::string& unit);

/// null: a length that is not known, or infinite.
Json json_of(const Resolution& resolution);

} // namespace host
