// SPDX-License-Identifier: BSD-3-Clause
// A scene whose block is an elastic layer under a rigid segment: what boundary elements need to know of it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

#include "elastic_layer.hpp"
#include "ents_library.hpp"
#include "scene.hpp"

namespace host {

/// The block of the scene, and which way its surface looks.
struct Box {
  std::array<double, 3> low{}, high{};
  double up = 1; ///< z of its surface's normal
  double surface() const { return up > 0 ? high[2] : low[2]; }
  double base() const { return up > 0 ? low[2] : high[2]; }
  double length(std::size_t axis) const { return high[axis] - low[axis]; }
};

class LayerScene {
public:
  /// @param what  asks for boundary elements; begins the messages
  /// @throws InputError naming the key of the scene that is not a layer's
  LayerScene(const Scene& scene, std::string what);

  const Scene& scene() const { return *scene_; }
  const Box& box() const { return box_; }
  bool periodic() const { return periodic_; }
  const Material& material() const { return scene_->parts[0].setup.material; }

  /// Cells over the block, so many along its longer side.
  ElasticLayer layer(int points, double thickness) const;
  /// The gap between the block and the segment with the height of the model, where the scene puts them.
  /// @return [x][y] over the centres of the cells
  Eigen::ArrayXXd gap(const EntsModel& model, const ElasticLayer& layer) const;

  [[noreturn]] void refuse(const std::string& key, const std::string& text) const;

private:
  Box read_box() const;
  /// Both pairs of sides are tied, or none is.
  bool read_periodic() const;

  const Scene* scene_;
  std::string what_;
  Box box_;
  bool periodic_;
};

} // namespace host
