// SPDX-License-Identifier: BSD-3-Clause
// The judge's geometry in space: a flat base with the height amplitude sin(2 pi waves x) sin(2 pi waves y),
// so that rho_e is the graph z = h(x, y), whatever segments carry it.
#pragma once

#include "chart/press.hpp"
#include "chart/true_surface.hpp"

namespace host::chart {

class TrueSheet final : public TrueSurface {
public:
  TrueSheet(double amplitude, double waves, ProjectionKind projection)
      : amplitude_(amplitude), waves_(waves), projection_(projection) {}

  Pair closest(const Vec& slave) const override;
  Pair follow(const Vec& slave, const Pair& before) const override;
  Kink kink(const Pair&) const override { return {}; }
  double end_zone(const Pair&) const override { return 0; }

private:
  /// h, its slopes and its second derivatives 11, 22, 12.
  struct Height2 {
    double h, slope[2], second[3];
  };
  Height2 at(double x, double y) const;
  Pair pair(const Vec& slave, double x, double y) const;
  Pair descend(const Vec& slave, double x, double y) const;

  double amplitude_, waves_;
  ProjectionKind projection_;
};

/// The press over quad4 (local) or bspline16 (c2) segments of a flat row two segments wide.
Press make_press_in_space(double amplitude, double waves, const Method& method);

} // namespace host::chart
