// SPDX-License-Identifier: BSD-3-Clause
#include "layer_scene.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "toolbox/error.hpp"

namespace host {

LayerScene::LayerScene(const Scene& scene, std::string what)
    : scene_(&scene), what_(std::move(what)), box_(read_box()), periodic_(read_periodic()) {}

void LayerScene::refuse(const std::string& key, const std::string& text) const {
  throw InputError(scene_->file.string() + ": " + key + ": " + what_ + " " + text);
}

Box LayerScene::read_box() const {
  const Scene& scene = *scene_;
  if (scene.parts.size() != 1 || scene.parts[0].lines.empty()) refuse("/parts", "is for one block");
  const PartSpec& part = scene.parts[0];
  if (part.setup.material.law != Material::Law::linear_elastic)
    refuse("/materials", "is for the law linear_elastic");
  if (scene.half_space) refuse("/half_space", "is for a layer that is held at its base");
  if (!scene.tractions.empty()) refuse("/tractions", "is for contact alone");
  if (!scene.springs.empty()) refuse("/springs", "is for contact alone");
  Box box;
  for (std::size_t c = 0; c < 3; ++c) box.low[c] = part.lines[c].front(), box.high[c] = part.lines[c].back();
  box.up = -scene.contact->direction[2];
  if (scene.contact->slave != part.name + (box.up > 0 ? ".z_max" : ".z_min"))
    refuse(scene.contact->slave_where, "is for the side of the block that the master moves to");
  return box;
}

bool LayerScene::read_periodic() const {
  const Scene& scene = *scene_;
  if (scene.periodic.empty()) return false;
  const std::string& name = scene.parts[0].name;
  std::size_t found = 0;
  for (const std::string axis : {".x", ".y"})
    for (const PeriodicSpec& pair : scene.periodic)
      found += (pair.first == name + axis + "_min" && pair.second == name + axis + "_max") ||
               (pair.first == name + axis + "_max" && pair.second == name + axis + "_min");
  if (found != 2 || scene.periodic.size() != 2)
    refuse("/periodic", "is for sides x_min and x_max, y_min and y_max that are periodic, or none");
  return true;
}

ElasticLayer LayerScene::layer(int points, double thickness) const {
  const double lx = box_.length(0), ly = box_.length(1);
  const auto along = [&](double length) {
    return std::max<Eigen::Index>(1, std::lround(points * length / std::max(lx, ly)));
  };
  return {along(lx), along(ly), lx, ly, thickness, material(), periodic_ ? Grid::periodic : Grid::cells};
}

Eigen::ArrayXXd LayerScene::gap(const EntsModel& model, const ElasticLayer& layer) const {
  const std::vector<double>& nodes = scene_->contact->rigid;
  const std::string key = "/contact/master/nodes";
  if (nodes.size() != 12) refuse(key, "is for a quad4 segment");
  const auto node = [&](int i) { return Eigen::Vector3d(nodes.data() + static_cast<std::size_t>(3 * i)); };
  const Eigen::Vector3d a = (node(1) - node(0)) / 2, b = (node(3) - node(0)) / 2,
                        middle = (node(0) + node(2)) / 2;
  const double size = a.norm() + b.norm();
  if ((node(0) - node(1) + node(2) - node(3)).norm() > 1e-12 * size ||
      std::abs(a[2]) + std::abs(b[2]) > 1e-12 * size)
    refuse(key, "is for a segment that is a parallelogram across its motion");
  Eigen::Matrix2d turn;
  turn << a[0], b[0], a[1], b[1];
  std::vector<double> xi;
  for (Eigen::Index j = 0; j < layer.cells_y(); ++j)
    for (Eigen::Index i = 0; i < layer.cells_x(); ++i) {
      const Eigen::Vector2d place(box_.low[0] + layer.x(i), box_.low[1] + layer.y(j));
      const Eigen::Vector2d at = turn.inverse() * (place - middle.head<2>());
      if (at.lpNorm<Eigen::Infinity>() > 1)
        refuse(key, "is for a segment that covers the whole slave surface");
      xi.insert(xi.end(), {at[0], at[1]});
    }
  const SurfaceSample sample = sample_surface(model, nodes, {}, xi);
  Eigen::ArrayXXd gap(layer.cells_x(), layer.cells_y());
  for (Eigen::Index k = 0; k < gap.size(); ++k)
    gap(k) = box_.up * (sample.point[static_cast<std::size_t>(3 * k + 2)] - box_.surface());
  return gap;
}

} // namespace host
