// SPDX-License-Identifier: BSD-3-Clause
// The model problem of the stability maps: one slave node on a spring, pressed into a wavy rigid master and
// drawn over two borders of its segments. Its energy
//   1/2 (x - anchor(t)) . K (x - anchor(t)) + penalty / 2 <-g(x)>^2
// has 2 (3D: 3) unknowns, so that every equilibrium can be found without the library.
#pragma once

#include <memory>
#include <string>

#include "chart/profile.hpp"
#include "chart/true_surface.hpp"

namespace host::chart {

struct Press {
  // the master, for the library
  SegmentRow row;
  Json height;        ///< null: plain
  bool local = false; ///< the height must vanish at the segments' ends
  double border = 0;  ///< natural coordinates, 0: the library's own
  Method method;
  int dimension = 2;
  // the node
  double lateral = 4; ///< stiffness of the spring along the row; 1 upwards
  double penalty = 100;
  int increments = 16;   ///< nominal
  double wavelength = 1; ///< shortest of the surface: what the host knows of it
  // where the spring's anchor goes, t = 0 .. 1: down, then along
  double curvature = 0, above = 0.1, below = 0, from = 0, to = 1;
  double slant = 0; ///< 3D: of the way, second coordinate over the first

  Vec anchor(double t) const;
  /// Stiffness of the spring by direction.
  Vec spring() const;
  /// The master as the judge sees it.
  std::shared_ptr<const TrueSurface> truth;
};

/// A plane problem.
struct PressOptions {
  Profile profile;
  Method method;
  double depth = 0.05; ///< of the anchor below the middle of the waves
  double penalty = 100;
  int increments = 16;
};
Press make_press(const PressOptions& options);

} // namespace host::chart
