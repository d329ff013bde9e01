// SPDX-License-Identifier: BSD-3-Clause
// The judge's geometry of a row of segments in the plane: bases, height and projections written anew, from
// their definitions, with a sweep over the whole row where the library searches.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "chart/profile.hpp"
#include "chart/true_surface.hpp"

namespace host::chart {

class TrueCurve final : public TrueSurface {
public:
  /// Of two plain pieces that meet in a ridge, a closed pair keeps its own for `border` beyond the end: the
  /// model's rule. In a valley the surface is what it is: the nearest piece, or the corner itself.
  /// @param border  of a piece's length: of a model's "border", the half
  TrueCurve(const Profile& profile, ProjectionKind projection, double border);

  Pair closest(const Vec& slave) const override;
  Pair follow(const Vec& slave, const Pair& before) const override;
  Kink kink(const Pair& pair) const override;
  double end_zone(const Pair& pair) const override;

  int pieces() const { return pieces_; }
  Eigen::Vector2d point(int piece, double v) const { return at(piece, v).point; }

private:
  struct Place {
    Eigen::Vector2d point, tangent; ///< rho_e, d rho_e / dv
  };
  Place at(int piece, double v) const;
  /// A local minimum of the distance, from v downhill in short steps; false if it is not on the piece and its
  /// border.
  bool descend(const Eigen::Vector2d& slave, int piece, double& v, double border) const;
  /// The crossing of the vertical through the slave and the piece that is next to v.
  bool cross(const Eigen::Vector2d& slave, int piece, double& v, double border) const;
  /// Do this piece and its neighbour make a valley at v = 0 or 1?
  bool valley(int piece, int end) const;
  Pair pair(const Eigen::Vector2d& slave, int piece, double v) const;
  Pair corner(const Eigen::Vector2d& slave, int piece, double v) const;

  SurfaceKind surface_;
  ProjectionKind projection_;
  double border_;
  Height height_;
  int pieces_ = 0, samples_ = 1;
  double stride_ = 0.01;                 ///< of a descent, in v
  double spacing_ = 0;                   ///< largest distance of two samples
  std::vector<Eigen::Vector2d> nodes_;   ///< plain: of the facets; else control points, one more at both ends
  std::vector<Eigen::Vector2d> sampled_; ///< [pieces][samples + 1]
};

} // namespace host::chart
