// SPDX-License-Identifier: BSD-3-Clause
// A scene with the key "cut_off" or "below": waves of the height that are shorter than it are left out of the
// geometry. What they do is a law, pressure against the mean gap of these waves alone on a half-space, from
// boundary elements. "cut_off": in places where they are r times as high as in the mean it is r p(g / r);
// "below": each place has a law of its own (place_laws.hpp).
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "layer_scene.hpp"
#include "place_laws.hpp"

namespace host {

/// Give the waves of a height a cut_off: of all its parts that have some.
/// @return how many parts
int leave_out_short_waves(Json& height, double wavelength);

class RemovedWaves {
public:
  /// @throws InputError if the scene is no layer under a rigid segment whose height has waves to leave out
  RemovedWaves(const Scene& scene, const EntsLibrary& library);

  /// The contact of the scene with the smooth height, the law and its scale, which this object computes.
  ContactSpec contact() const;
  /// Local height of the removed waves over their rms, near a place of the slave surface.
  double scale(double x, double y) const;
  /// The contact elements of the slave points: with laws of their own several in each.
  SlavePoints points(SlavePoints points, const Mesh& mesh) const;
  /// Part of the area around a place of the slave surface that is in contact under this pressure.
  double share(double x, double y, double pressure) const;
  double rms() const { return rms_; } ///< of the removed waves [L]

private:
  void check_coordinates() const;
  void press(const Eigen::ArrayXXd& waves);

  LayerScene place_;
  Json model_;
  double rms_ = 0, mean_ = 0; ///< of the waves [L]; the mean is part of the gap to their mean plane
  Eigen::ArrayXXd scale_;     ///< [cells x][cells y]
  std::unique_ptr<const ElasticLayer> cells_; ///< a half-space of unit modulus
  std::unique_ptr<const PlaceLaws> own_;
  std::vector<double> gap_, pressure_, share_; ///< of the law, by falling pressure
};

} // namespace host
