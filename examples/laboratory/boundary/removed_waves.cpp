// SPDX-License-Identifier: BSD-3-Clause
#include "removed_waves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "output/table.hpp"
#include "toolbox/error.hpp"

namespace host {
namespace {

constexpr double mean_width = 0.5; // standard deviation of the local mean, of the cut-off
constexpr double flattest = 0.1;   // least local height, of the rms

} // namespace

int leave_out_short_waves(Json& height, double wavelength) {
  int found = 0;
  if (height.is_object())
    for (const char* type : {"map", "roughness", "fourier", "weierstrass"})
      if (height.value("type", "") == type) height["cut_off"] = wavelength, ++found;
  if (height.is_structured())
    for (auto& part : height)
      if (part.is_structured()) found += leave_out_short_waves(part, wavelength);
  return found;
}

RemovedWaves::RemovedWaves(const Scene& scene, const EntsLibrary& library)
    : place_(scene, scene.contact->cut_off.own ? "\"below\"" : "\"cut_off\""), model_(scene.contact->model) {
  const CutOff& cut = scene.contact->cut_off;
  check_coordinates();
  const EntsModel full(library, model_.dump(), scene.file.parent_path(), scene.contact->model_where);
  if (!model_.contains("height") || leave_out_short_waves(model_["height"], cut.wavelength) == 0)
    throw InputError(cut.where + ": the model's height has no part of type map, roughness, fourier or "
                                 "weierstrass, whose waves could be left out");
  const EntsModel smooth(library, model_.dump(), scene.file.parent_path(), scene.contact->model_where);
  const ElasticLayer layer = place_.layer(cut.points, std::numeric_limits<double>::infinity());
  cells_ = std::make_unique<const ElasticLayer>(
      unit_half_space(layer.cells_x(), layer.cells_y(), layer.length_x(), layer.length_y(), layer.grid()));
  const ElasticLayer& cells = *cells_;
  Eigen::ArrayXXd waves = place_.gap(full, cells) - place_.gap(smooth, cells);
  mean_ = waves.mean();
  waves -= mean_;
  const double mean_square = waves.square().mean();
  rms_ = std::sqrt(mean_square);
  if (!(rms_ > 1e-12 * (place_.box().length(0) + place_.box().length(1))))
    throw InputError(cut.where + ": the height has no waves shorter than " + std::to_string(cut.wavelength) +
                     " (in units of its surface coordinates); leave the key out, or cut longer waves off");
  if (!cut.own) {
    const Eigen::ArrayXXd local = cells.smoothed(waves.square(), mean_width * cut.wavelength);
    scale_ = (local / mean_square).max(flattest * flattest).sqrt();
    waves /= scale_;
  }
  press(waves);
}

/// Says on stderr how far the boundary elements are: they take a minute where nothing has been kept.
void RemovedWaves::press(const Eigen::ArrayXXd& waves) {
  const double modulus = place_.material().contact_modulus();
  const CutOff& cut = place_.scene().contact->cut_off;
  const WaveProgress progress = progress_on_stderr(cut.where + ": boundary elements of the waves below " +
                                                   format_number(cut.wavelength));
  WaveLaw law = kept_wave_law(waves, *cells_, modulus, progress);
  for (const WaveLevel& level : law)
    gap_.push_back(level.gap), pressure_.push_back(level.pressure), share_.push_back(level.share);
  const PartSpec& part = place_.scene().parts[0];
  const auto spacing = [&](std::size_t axis) {
    return place_.box().length(axis) / static_cast<double>(part.lines[axis].size() - 1);
  };
  if (cut.own)
    own_ = std::make_unique<PlaceLaws>(std::move(law), *cells_,
                                       std::array{place_.box().low[0], place_.box().low[1]}, modulus,
                                       spacing(0), spacing(1));
}

SlavePoints RemovedWaves::points(SlavePoints points, const Mesh& mesh) const {
  return own_ ? own_->springs(points, mesh) : points;
}

void RemovedWaves::check_coordinates() const {
  const ContactSpec& contact = *place_.scene().contact;
  std::vector<double> s;
  if (const Json given = find_json(model_, "/surface_coordinates"); given.is_array())
    for (const Json& node : given)
      for (const Json& coordinate : node)
        if (coordinate.is_number()) s.push_back(coordinate.get<double>());
  if (s.empty()) s = {-1, -1, 1, -1, 1, 1, -1, 1};
  bool lengths = s.size() == 8 && contact.rigid.size() == 12;
  for (const std::size_t node : {1u, 3u})
    if (lengths) {
      const double in_s = std::hypot(s[2 * node] - s[0], s[2 * node + 1] - s[1]),
                   in_space = std::hypot(contact.rigid[3 * node] - contact.rigid[0],
                                         contact.rigid[3 * node + 1] - contact.rigid[1]);
      lengths = std::abs(in_s - in_space) <= 1e-9 * in_space;
    }
  if (!lengths)
    throw InputError(contact.cut_off.where +
                     ": is for surface coordinates that are lengths; write the places "
                     "of the master's nodes as /contact/model/surface_coordinates");
}

ContactSpec RemovedWaves::contact() const {
  if (own_) {
    ContactSpec contact = *place_.scene().contact;
    contact.model = model_;
    contact.model["contact"] = own_->contact();
    contact.model["contact"]["offset"] = mean_;
    return contact;
  }
  ContactSpec contact = *place_.scene().contact;
  contact.model = model_;
  contact.model["contact"] = {{"normal", law_table(gap_, pressure_)}, {"offset", mean_}};
  contact.law_scale = [this](double x, double y) { return scale(x, y); };
  return contact;
}

double RemovedWaves::scale(double x, double y) const {
  const Box& box = place_.box();
  return cells_->between(scale_, x - box.low[0], y - box.low[1]);
}

double RemovedWaves::share(double x, double y, double pressure) const {
  if (own_) return own_->share(x, y, pressure);
  const double scale = this->scale(x, y);
  const double p = pressure / scale;
  if (p <= pressure_.back()) return share_.back() * p / pressure_.back();
  if (p >= pressure_.front()) return share_.front();
  const auto after = std::upper_bound(pressure_.rbegin(), pressure_.rend(), p);
  const auto k = static_cast<std::size_t>(pressure_.rend() - after) - 1; // the pressure above p
  const double part = std::log(p / pressure_[k + 1]) / std::log(pressure_[k] / pressure_[k + 1]);
  return share_[k + 1] + part * (share_[k] - share_[k + 1]);
}

} // namespace host
