// SPDX-License-Identifier: BSD-3-Clause
#include "exact_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace host {
namespace {

/// The block of the scene, and which way its surface looks.
struct Box {
  std::array<double, 3> low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
  double up = 1; ///< z of its surface's normal
  double surface() const { return up > 0 ? high[2] : low[2]; }
  double base() const { return up > 0 ? low[2] : high[2]; }
};

[[noreturn]] void refuse(const Scene& scene, const std::string& key, const std::string& text) {
  throw InputError(scene.file.string() + ": " + key + ": the exact solution \"boundary_elements\" " + text);
}

/// The sides slide along planes of symmetry, the base is held, all else is free.
void check_supports(const Scene& scene, const Mesh& mesh, const DofMap& dofs, const Box& box) {
  for (const SupportSpec& support : scene.supports)
    for (const std::optional<double>& component : support.displacement)
      if (component && *component != 0) refuse(scene, support.where, "is for supports that stay in place");
  for (int node = 0; node < mesh.node_count(); ++node) {
    const auto place = mesh.node(node);
    const bool on_base = place[2] == box.base();
    for (std::size_t c = 0; c < 3; ++c) {
      const bool on_side = c < 2 && (place[c] == box.low[c] || place[c] == box.high[c]);
      if ((dofs.equation(node, static_cast<int>(c)) < 0) != (on_base || on_side))
        refuse(scene, "/supports",
               "is for a layer: x = 0 on its sides x_min and x_max, y = 0 on y_min and y_max, all components "
               "on its base");
    }
  }
}

Box box_of(const Scene& scene, const Mesh& mesh) {
  if (scene.parts.size() != 1 || scene.parts[0].lines.empty()) refuse(scene, "/parts", "is for one block");
  const PartSpec& part = scene.parts[0];
  if (part.setup.material.law != Material::Law::linear_elastic)
    refuse(scene, "/materials", "is for the law linear_elastic");
  if (scene.half_space) refuse(scene, "/half_space", "is for a layer that is held at its base");
  if (!scene.tractions.empty()) refuse(scene, "/tractions", "is for contact alone");
  if (!scene.springs.empty()) refuse(scene, "/springs", "is for contact alone");
  if (!scene.periodic.empty()) refuse(scene, "/periodic", "is for sides that are planes of symmetry");
  Box box;
  box.up = -scene.contact->direction[2];
  if (scene.contact->slave != part.name + (box.up > 0 ? ".z_max" : ".z_min"))
    refuse(scene, scene.contact->slave_where, "is for the side of the block that the master moves to");
  for (int node = 0; node < mesh.node_count(); ++node)
    for (std::size_t c = 0; c < 3; ++c) {
      box.low[c] = std::min(box.low[c], mesh.node(node)[c]);
      box.high[c] = std::max(box.high[c], mesh.node(node)[c]);
    }
  return box;
}

/// Heights of the rigid segment over the centres of the cells.
Eigen::ArrayXXd gap_over(const Scene& scene, const EntsModel& model, const Box& box,
                         const ElasticLayer& layer) {
  const std::vector<double>& nodes = scene.contact->rigid;
  const std::string key = "/contact/master/nodes";
  if (nodes.size() != 12) refuse(scene, key, "is for a quad4 segment");
  const auto node = [&](int i) { return Eigen::Vector3d(nodes.data() + static_cast<std::size_t>(3 * i)); };
  const Eigen::Vector3d a = (node(1) - node(0)) / 2, b = (node(3) - node(0)) / 2,
                        middle = (node(0) + node(2)) / 2;
  const double size = a.norm() + b.norm();
  if ((node(0) - node(1) + node(2) - node(3)).norm() > 1e-12 * size ||
      std::abs(a[2]) + std::abs(b[2]) > 1e-12 * size)
    refuse(scene, key, "is for a segment that is a parallelogram across its motion");
  Eigen::Matrix2d turn;
  turn << a[0], b[0], a[1], b[1];
  std::vector<double> xi;
  for (Eigen::Index j = 0; j < layer.cells_y(); ++j)
    for (Eigen::Index i = 0; i < layer.cells_x(); ++i) {
      const Eigen::Vector2d place(box.low[0] + layer.x(i), box.low[1] + layer.y(j));
      const Eigen::Vector2d at = turn.inverse() * (place - middle.head<2>());
      if (at.lpNorm<Eigen::Infinity>() > 1)
        refuse(scene, key, "is for a segment that covers the whole slave surface");
      xi.insert(xi.end(), {at[0], at[1]});
    }
  const SurfaceSample sample = sample_surface(model, nodes, {}, xi);
  Eigen::ArrayXXd gap(layer.cells_x(), layer.cells_y());
  for (Eigen::Index k = 0; k < gap.size(); ++k)
    gap(k) = box.up * (sample.point[static_cast<std::size_t>(3 * k + 2)] - box.surface());
  return gap;
}

} // namespace

ExactLayer::ExactLayer(const Scene& scene, const EntsLibrary& library, const Mesh& mesh, const DofMap& dofs)
    : scene_(&scene) {
  const Box box = box_of(scene, mesh);
  check_supports(scene, mesh, dofs, box);
  const ContactSpec& contact = *scene.contact;
  const EntsModel model(library, contact.model.dump(), scene.file.parent_path(), contact.model_where);
  const double lx = box.high[0] - box.low[0], ly = box.high[1] - box.low[1];
  for (const int points : {scene.exact.points, scene.exact.points / 2}) {
    const auto cells = [&](double length) {
      return std::max<Eigen::Index>(1, std::lround(points * length / std::max(lx, ly)));
    };
    ElasticLayer layer(cells(lx), cells(ly), lx, ly, box.high[2] - box.low[2], scene.parts[0].setup.material);
    Eigen::ArrayXXd gap = gap_over(scene, model, box, layer);
    grids_.push_back({std::move(layer), std::move(gap)});
  }
}

std::vector<Quantity> ExactLayer::compare(double motion, const SurfaceState& state) const {
  const LayerContact fine = grids_[0].layer.press(grids_[0].gap - motion),
                     coarse = grids_[1].layer.press(grids_[1].gap - motion);
  double closed = 0, area = 0;
  for (std::size_t k = 0; k < state.area.size(); ++k) {
    area += state.area[k];
    if (state.closed[k]) closed += state.area[k];
  }
  const double peak = *std::max_element(state.pressure.begin(), state.pressure.end());
  const std::string& unit = scene_->units.pressure;
  return {exact_quantity("mean pressure", unit, state.mean_pressure, fine.mean_pressure),
          exact_quantity("contact fraction", "", closed / area, fine.fraction),
          exact_quantity("peak pressure", unit, peak, fine.peak_pressure),
          {"mean pressure, half the points", unit, coarse.mean_pressure},
          {"contact fraction, half the points", "", coarse.fraction},
          {"peak pressure, half the points", unit, coarse.peak_pressure}};
}

} // namespace host
