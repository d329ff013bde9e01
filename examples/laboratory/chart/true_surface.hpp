// SPDX-License-Identifier: BSD-3-Clause
// The judge's own contact geometry. Nothing here calls the library: a result of the library is held against
// it.
#pragma once

#include <Eigen/Core>

namespace host::chart {

using Vec = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>; ///< of the plane or of space, no heap
using Mat = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;

/// A slave node over a point of the whole surface.
struct Pair {
  int piece = -1;       ///< of the surface; -1: none
  double v[2] = {0, 0}; ///< place on the piece, 0 .. 1
  double gap = 0;       ///< as ents.h has it: along n_e, or along the ray
  Vec gradient;         ///< dg/dx of the slave
  Mat hessian;          ///< d2g/dx2
  bool corner = false;  ///< over a corner between two pieces, where neither has a projection
};

/// A valley of two pieces: where, and dg/dx on its two sides.
struct Kink {
  bool found = false;
  Vec point, gradient[2];
};

/// A whole surface that does not move. The rule of choice is that of ents.h: a pair that is closed stays on
/// its branch, one that is open is the closest of all (shadow: the lit one).
class TrueSurface {
public:
  virtual ~TrueSurface() = default;
  virtual Pair closest(const Vec& slave) const = 0;
  virtual Pair follow(const Vec& slave, const Pair& before) const = 0;
  /// The valley between the pair's piece and the neighbour beyond its nearer end, if they make one and the
  /// projection leaves a kink in the gap there (shadow).
  virtual Kink kink(const Pair& pair) const = 0;
  /// Length beyond the piece's end up to which a host's segment may go on, if the pair is there or as close
  /// to the end on this side; else 0. In this zone a host's plain segments are not the surface.
  virtual double end_zone(const Pair& pair) const = 0;

  /// The pair that the rule demands.
  Pair next(const Vec& slave, const Pair& before) const {
    if (before.piece >= 0 && before.gap < 0)
      if (Pair pair = follow(slave, before); pair.gap < 0) return pair;
    return closest(slave);
  }
};

} // namespace host::chart
