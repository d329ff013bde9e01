// SPDX-License-Identifier: BSD-3-Clause
// theory.md, section 4.8.
// The law of the short waves around each point of the slave surface, which differs from place to place: one
// has a summit, another none. From the solution of boundary elements for all places at once (wave_law.hpp), at
// every level the mean pressure p_i of the box around the point and the gap g_i = g + u_i there: g is the gap of
// the level, u_i the displacement under all p_i that points with these distances can follow. What the body
// does at these wavelengths is in u_i, and not in the law: no compliance counts twice.
//
// The curve p_i(g_i) is made convex and becomes a sum of one-sided springs, K_j max(0, o_j - g): contact
// elements with a common law of type "table" that stand at the same place, each with an offset and its share
// of the area.
#pragma once

#include <array>
#include <vector>

#include "slave_points.hpp"
#include "toolbox/json_reader.hpp"
#include "wave_law.hpp"

namespace host {

/// Pressure of one place over its gap, from the last contact on: gaps fall, pressures and stiffnesses rise.
struct PlaceCurve {
  std::vector<double> gap, pressure;
  double after = 0; ///< stiffness beyond the last point [F/L^3]
};

class PlaceLaws {
public:
  /// @param low     corner of the cells
  /// @param modulus  E* [F/L^2]
  /// @param hx, hy   distances of the points
  PlaceLaws(WaveLaw law, const ElasticLayer& half_space, std::array<double, 2> low, double modulus, double hx,
            double hy);

  PlaceCurve curve(double x, double y) const;
  /// Part of the area around a place that is in contact under its pressure.
  double share(double x, double y, double pressure) const;

  /// The springs of every point in its place.
  /// @param points  nodes
  SlavePoints springs(const SlavePoints& points, const Mesh& mesh) const;
  /// The law of all springs, for /contact of a model.
  Json contact() const;

private:
  /// Mean over the box around a place, of a field [x][y] that has been summed up.
  double mean(const Eigen::ArrayXXd& sums, double x, double y) const;

  WaveLaw law_;
  ElasticLayer layer_;
  std::array<double, 2> low_;
  double hx_, hy_, stiffest_;
  std::vector<Eigen::ArrayXXd> pressed_, closed_; ///< [levels] sums up to the corner of each cell
  std::vector<Eigen::ArrayXXd> moved_;            ///< [levels] displacement u
};

} // namespace host
