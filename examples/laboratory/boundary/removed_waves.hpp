// SPDX-License-Identifier: BSD-3-Clause
// A scene with the key "cut_off": waves of the height that are shorter than it are left out of the geometry.
// What they do is a law, pressure against the mean gap of these waves alone on a half-space, from boundary
// elements; in places where they are r times as high as in the mean it is r p(g / r).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "layer_scene.hpp"

namespace host {

class RemovedWaves {
public:
  /// @throws InputError if the scene is no layer under a rigid segment whose height has waves to leave out
  RemovedWaves(const Scene& scene, const EntsLibrary& library);

  /// The contact of the scene with the smooth height, the law and its scale, which this object computes.
  ContactSpec contact() const;
  /// Local height of the removed waves over their rms, near a place of the slave surface.
  double scale(double x, double y) const;
  /// Part of the area around a slave point that is in contact.
  double share(double pressure, double scale) const;
  double rms() const { return rms_; } ///< of the removed waves [L]

private:
  void check_coordinates() const;
  /// The law of waves of this height, on a half-space.
  void press(const Eigen::ArrayXXd& gap, const ElasticLayer& half_space);

  LayerScene place_;
  Json model_;
  double rms_ = 0;
  Eigen::ArrayXXd scale_;                      ///< [cells x][cells y]
  std::vector<double> gap_, pressure_, share_; ///< of the law, by falling pressure
};

} // namespace host
