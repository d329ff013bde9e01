// SPDX-License-Identifier: BSD-3-Clause
#include "exact_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace host {
namespace {

/// The sides slide along planes of symmetry or are tied to each other, the base is held, all else is free.
void check_supports(const LayerScene& place, const Mesh& mesh, const DofMap& dofs) {
  const Scene& scene = place.scene();
  const Box& box = place.box();
  const bool periodic = place.periodic();
  for (const SupportSpec& support : scene.supports)
    if (support.moves()) place.refuse(support.where, "is for supports that stay in place");
  for (int node = 0; node < mesh.node_count(); ++node) {
    const auto at = mesh.node(node);
    const bool on_base = at[2] == box.base();
    for (std::size_t c = 0; c < 3; ++c) {
      const bool on_side = !periodic && c < 2 && (at[c] == box.low[c] || at[c] == box.high[c]);
      if ((dofs.equation(node, static_cast<int>(c)) < 0) != (on_base || on_side))
        place.refuse(
            "/supports",
            periodic ? "is for a layer with periodic sides: all components on its base are 0, and no others"
                     : "is for a layer: x = 0 on its sides x_min and x_max, y = 0 on y_min and y_max, all "
                       "components on its base");
    }
  }
}

} // namespace

ExactLayer::ExactLayer(const Scene& scene, const EntsLibrary& library, const Mesh& mesh, const DofMap& dofs)
    : scene_(&scene), place_(scene, "the exact solution \"boundary_elements\"") {
  if (!scene.parts[0].layer) check_supports(place_, mesh, dofs);
  const ContactSpec& contact = *scene.contact;
  model_ = std::make_unique<EntsModel>(library, contact.model.dump(), scene.file.parent_path(),
                                       contact.model_where);
  cells(scene.exact.points); // what is wrong with the master is said before the first step
}

const ExactLayer::Cells& ExactLayer::cells(int points) const {
  if (const auto found = cells_.find(points); found != cells_.end()) return found->second;
  ElasticLayer layer = place_.layer(points, place_.box().length(2));
  Eigen::ArrayXXd gap = place_.gap(*model_, layer);
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
      const Line::Share u = x.share(place_.box().low[0] + layer.x(i)),
                        v = y.share(place_.box().low[1] + layer.y(j));
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
