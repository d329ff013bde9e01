// SPDX-License-Identifier: BSD-3-Clause
#include "exact_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace host {
namespace {

[[noreturn]] void refuse(const Scene& scene, const std::string& key, const std::string& text) {
  throw InputError(scene.file.string() + ": " + key + ": the exact solution \"boundary_elements\" " + text);
}

/// The sides slide along planes of symmetry or are tied to each other, the base is held, all else is free.
void check_supports(const Scene& scene, const Mesh& mesh, const DofMap& dofs, const Box& box, bool periodic) {
  for (const SupportSpec& support : scene.supports)
    for (const std::optional<double>& component : support.displacement)
      if (component && *component != 0) refuse(scene, support.where, "is for supports that stay in place");
  for (int node = 0; node < mesh.node_count(); ++node) {
    const auto place = mesh.node(node);
    const bool on_base = place[2] == box.base();
    for (std::size_t c = 0; c < 3; ++c) {
      const bool on_side = !periodic && c < 2 && (place[c] == box.low[c] || place[c] == box.high[c]);
      if ((dofs.equation(node, static_cast<int>(c)) < 0) != (on_base || on_side))
        refuse(scene, "/supports",
               periodic
                   ? "is for a layer with periodic sides: all components on its base are 0, and no others"
                   : "is for a layer: x = 0 on its sides x_min and x_max, y = 0 on y_min and y_max, all "
                     "components on its base");
    }
  }
}

Box box_of(const Scene& scene) {
  if (scene.parts.size() != 1 || scene.parts[0].lines.empty()) refuse(scene, "/parts", "is for one block");
  const PartSpec& part = scene.parts[0];
  if (part.setup.material.law != Material::Law::linear_elastic)
    refuse(scene, "/materials", "is for the law linear_elastic");
  if (scene.half_space) refuse(scene, "/half_space", "is for a layer that is held at its base");
  if (!scene.tractions.empty()) refuse(scene, "/tractions", "is for contact alone");
  if (!scene.springs.empty()) refuse(scene, "/springs", "is for contact alone");
  Box box;
  for (std::size_t c = 0; c < 3; ++c) box.low[c] = part.lines[c].front(), box.high[c] = part.lines[c].back();
  box.up = -scene.contact->direction[2];
  if (scene.contact->slave != part.name + (box.up > 0 ? ".z_max" : ".z_min"))
    refuse(scene, scene.contact->slave_where, "is for the side of the block that the master moves to");
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

/// Both pairs of sides are tied, or none is.
bool is_periodic(const Scene& scene) {
  if (scene.periodic.empty()) return false;
  const std::string& name = scene.parts[0].name;
  std::size_t found = 0;
  for (const std::string axis : {".x", ".y"})
    for (const PeriodicSpec& pair : scene.periodic)
      found += (pair.first == name + axis + "_min" && pair.second == name + axis + "_max") ||
               (pair.first == name + axis + "_max" && pair.second == name + axis + "_min");
  if (found != 2 || scene.periodic.size() != 2)
    refuse(scene, "/periodic", "is for sides x_min and x_max, y_min and y_max that are periodic, or none");
  return true;
}

} // namespace

ExactLayer::ExactLayer(const Scene& scene, const EntsLibrary& library, const Mesh& mesh, const DofMap& dofs)
    : scene_(&scene), box_(box_of(scene)), periodic_(is_periodic(scene)) {
  if (!scene.parts[0].layer) check_supports(scene, mesh, dofs, box_, periodic_);
  const ContactSpec& contact = *scene.contact;
  model_ = std::make_unique<EntsModel>(library, contact.model.dump(), scene.file.parent_path(),
                                       contact.model_where);
  cells(scene.exact.points); // what is wrong with the master is said before the first step
}

const ExactLayer::Cells& ExactLayer::cells(int points) const {
  if (const auto found = cells_.find(points); found != cells_.end()) return found->second;
  const double lx = box_.high[0] - box_.low[0], ly = box_.high[1] - box_.low[1];
  const auto along = [&](double length) {
    return std::max<Eigen::Index>(1, std::lround(points * length / std::max(lx, ly)));
  };
  ElasticLayer layer(along(lx), along(ly), lx, ly, box_.high[2] - box_.low[2],
                     scene_->parts[0].setup.material, periodic_ ? Grid::periodic : Grid::cells);
  Eigen::ArrayXXd gap = gap_over(*scene_, *model_, box_, layer);
  return cells_.emplace(points, Cells{std::move(layer), std::move(gap)}).first->second;
}

LayerContact ExactLayer::press(int points, double motion) const {
  const Cells& grid = cells(points);
  const double stiffness = scene_->exact.stiffness;
  return grid.layer.press(grid.gap - motion, stiffness > 0 ? 1 / stiffness : 0);
}

/// The force of a cell goes to the four slave points around it, bilinearly, as the nodes of a mesh would have
/// it; beyond the outermost to these alone. The points form a grid, not necessarily an even one.
std::vector<double> ExactLayer::pressure_at(const SurfaceState& state, const LayerTruth& truth) const {
  const ElasticLayer& layer = cells(truth.points).layer;
  const LayerContact& exact = truth.fine;
  struct Line {
    std::vector<double> places; ///< of the points, each once
    struct Share {
      Eigen::Index before;
      double next; ///< what the point after it has
    };
    Share share(double x) const {
      const auto last = static_cast<Eigen::Index>(places.size()) - 1;
      const auto above = std::upper_bound(places.begin(), places.end(), x) - places.begin();
      if (above == 0 || above > last) return {above == 0 ? 0 : last - 1, above == 0 ? 0. : 1.};
      const auto i = static_cast<std::size_t>(above);
      return {above - 1, (x - places[i - 1]) / (places[i] - places[i - 1])};
    }
  };
  const auto line = [&](const std::vector<double>& all) {
    Line sorted{all};
    std::sort(sorted.places.begin(), sorted.places.end());
    const double same = 1e-9 * (sorted.places.back() - sorted.places.front());
    const auto equal = [&](double a, double b) { return b - a <= same; };
    sorted.places.erase(std::unique(sorted.places.begin(), sorted.places.end(), equal), sorted.places.end());
    return sorted;
  };
  const Line x = line(state.place), y = line(state.place_y);
  Eigen::ArrayXXd force = Eigen::ArrayXXd::Zero(static_cast<Eigen::Index>(x.places.size()) + 1,
                                                static_cast<Eigen::Index>(y.places.size()) + 1),
                  area = force;
  for (Eigen::Index j = 0; j < exact.pressure.cols(); ++j)
    for (Eigen::Index i = 0; i < exact.pressure.rows(); ++i) {
      const Line::Share u = x.share(box_.low[0] + layer.x(i)), v = y.share(box_.low[1] + layer.y(j));
      for (const Eigen::Index a : {0, 1})
        for (const Eigen::Index b : {0, 1}) {
          const double part = (a == 1 ? u.next : 1 - u.next) * (b == 1 ? v.next : 1 - v.next);
          force(u.before + a, v.before + b) += part * exact.pressure(i, j);
          area(u.before + a, v.before + b) += part;
        }
    }
  const auto index = [](const Line& of, double place) {
    const Line::Share share = of.share(place);
    return share.before + (share.next > 0.5 ? 1 : 0);
  };
  std::vector<double> pressure;
  for (std::size_t k = 0; k < state.area.size(); ++k) {
    const Eigen::Index a = index(x, state.place[k]), b = index(y, state.place_y[k]);
    pressure.push_back(force(a, b) / area(a, b));
  }
  return pressure;
}

double LayerTruth::change() const {
  if (!(fine.mean_pressure > 0)) return 0;
  return std::max(std::abs(coarse.mean_pressure / fine.mean_pressure - 1),
                  std::abs(coarse.fraction / fine.fraction - 1));
}

LayerTruth ExactLayer::truth(double motion) const {
  constexpr int finest = 2048;
  int points = scene_->exact.points;
  LayerTruth truth{press(points / 2, motion), press(points, motion), points};
  while (scene_->exact.error > 0 && truth.change() > scene_->exact.error) {
    if (2 * points > finest)
      throw JobError("boundary elements: pressure and area still change by " +
                     std::to_string(truth.change()) + " from " + std::to_string(points / 2) + " to " +
                     std::to_string(points) + " points; give a larger /exact/error, or a smoother surface");
    points *= 2;
    truth = {std::move(truth.fine), press(points, motion), points};
  }
  return truth;
}

LayerAnswer ExactLayer::compare(const LayerTruth& truth, const SurfaceState& state) const {
  const LayerContact &coarse = truth.coarse, &fine = truth.fine;
  double closed = 0, area = 0, gap = 0;
  for (std::size_t k = 0; k < state.area.size(); ++k) {
    area += state.area[k];
    gap += state.area[k] * state.gap[k];
    if (state.closed[k]) closed += state.area[k];
  }
  const double peak = *std::max_element(state.pressure.begin(), state.pressure.end());
  LayerAnswer answer{{}, pressure_at(state, truth)};
  double off = 0, squares = 0;
  for (std::size_t k = 0; k < state.area.size(); ++k) {
    off += state.area[k] * std::pow(state.pressure[k] - answer.pressure[k], 2);
    squares += state.area[k] * std::pow(answer.pressure[k], 2);
  }
  const std::string &unit = scene_->units.pressure, &length = scene_->units.length;
  answer.quantities = {
      exact_quantity("mean pressure", unit, state.mean_pressure, fine.mean_pressure),
      exact_quantity("contact fraction", "", closed / area, fine.fraction),
      exact_quantity("contact fraction, estimated", "", state.contact_estimate, fine.fraction),
      exact_quantity("peak pressure", unit, peak, fine.peak_pressure),
      exact_quantity("mean gap", length, gap / area, fine.gap.mean()),
      {"pressure (rms of the difference, relative)", "", std::sqrt(off / squares)},
      {"mean pressure, half the points", unit, coarse.mean_pressure},
      {"contact fraction, half the points", "", coarse.fraction},
      {"peak pressure, half the points", unit, coarse.peak_pressure},
      {"points of the exact solution", "", static_cast<double>(truth.points)},
      {"change from half the points", "", truth.change()}};
  return answer;
}

} // namespace host
