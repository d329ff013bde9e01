// SPDX-License-Identifier: BSD-3-Clause
#include "removed_waves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "error.hpp"

namespace host {
namespace {

// The table goes from nearly full contact down to a few per mille of the area.
constexpr int levels = 16;
constexpr double most = 1.5, least = 1e-3;   // mean pressures over E* times the rms slope
constexpr double gap_of_full_contact = 1e-3; // gap over the rms of the waves: full contact
constexpr double enough = 4e-4;              // error of gaps, of the height of the waves
constexpr double mean_width = 0.5;           // standard deviation of the local mean, of the cut-off
constexpr double flattest = 0.1;             // least local height, of the rms
constexpr int tail = 5;                      // points of the exponential end, one per factor e

/// The waves of all parts of a height that have some.
int cut_off(Json& height, double wavelength) {
  int found = 0;
  if (height.is_object())
    for (const char* type : {"map", "roughness", "fourier", "weierstrass"})
      if (height.value("type", "") == type) height["cut_off"] = wavelength, ++found;
  if (height.is_structured())
    for (auto& part : height)
      if (part.is_structured()) found += cut_off(part, wavelength);
  return found;
}

/// Root of the mean square of the slope.
double slope(const Eigen::ArrayXXd& z, double dx, double dy) {
  const Eigen::Index n = z.rows(), m = z.cols();
  const Eigen::ArrayXXd along = (z.bottomRows(n - 1) - z.topRows(n - 1)) / dx,
                        across = (z.rightCols(m - 1) - z.leftCols(m - 1)) / dy;
  return std::sqrt(along.square().mean() + across.square().mean());
}

} // namespace

RemovedWaves::RemovedWaves(const Scene& scene, const EntsLibrary& library)
    : place_(scene, "\"cut_off\""), model_(scene.contact->model) {
  const CutOff& cut = scene.contact->cut_off;
  check_coordinates();
  const EntsModel full(library, model_.dump(), scene.file.parent_path(), scene.contact->model_where);
  if (!model_.contains("height") || cut_off(model_["height"], cut.wavelength) == 0)
    throw InputError(cut.where + ": the model's height has no part of type map, roughness, fourier or "
                                 "weierstrass, whose waves could be left out");
  const EntsModel smooth(library, model_.dump(), scene.file.parent_path(), scene.contact->model_where);
  const ElasticLayer cells = place_.layer(cut.points, std::numeric_limits<double>::infinity());
  Eigen::ArrayXXd waves = place_.gap(full, cells) - place_.gap(smooth, cells);
  waves -= waves.mean();
  const double mean_square = waves.square().mean();
  rms_ = std::sqrt(mean_square);
  if (!(rms_ > 1e-12 * (place_.box().length(0) + place_.box().length(1))))
    throw InputError(cut.where + ": the height has no waves shorter than " + std::to_string(cut.wavelength) +
                     " (in units of its surface coordinates); leave the key out, or cut longer waves off");
  const Eigen::ArrayXXd local = cells.smoothed(waves.square(), mean_width * cut.wavelength);
  scale_ = (local / mean_square).max(flattest * flattest).sqrt();
  press(waves / scale_, cells);
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

void RemovedWaves::press(const Eigen::ArrayXXd& gap, const ElasticLayer& half_space) {
  const double modulus = place_.material().contact_modulus(),
               rms_slope = slope(gap, half_space.x(1) - half_space.x(0), half_space.y(1) - half_space.y(0));
  Eigen::ArrayXXd start;
  for (int i = 0; i < levels; ++i) {
    const double mean = modulus * rms_slope * most * std::pow(least / most, i / (levels - 1.));
    LayerContact found = half_space.press_with(mean, gap, 0, start.size() == 0 ? nullptr : &start, enough);
    const double mean_gap = found.gap.mean();
    if (!gap_.empty() &&
        gap_.back() < gap_of_full_contact * rms_) // of several nearly full contacts the last one stays
      gap_.pop_back(), pressure_.pop_back(), share_.pop_back();
    gap_.push_back(mean_gap), pressure_.push_back(mean), share_.push_back(found.fraction);
    start = std::move(found.pressure);
  }
}

ContactSpec RemovedWaves::contact() const {
  // Behind the last point the pressure falls exponentially, as it does before it, and ends.
  std::vector<double> gap = gap_, pressure = pressure_;
  const std::size_t n = gap.size();
  const double length = (gap_[n - 1] - gap_[n - 2]) / std::log(pressure_[n - 2] / pressure_[n - 1]);
  for (int i = 1; i <= tail; ++i) {
    gap.push_back(gap_.back() + i * length);
    pressure.push_back(i < tail ? pressure_.back() * std::exp(-i) : 0);
  }
  ContactSpec contact = *place_.scene().contact;
  contact.model = model_;
  contact.model["contact"] = {{"normal", {{"type", "table"}, {"gap", gap}, {"pressure", pressure}}}};
  contact.law_scale = [this](double x, double y) { return scale(x, y); };
  return contact;
}

double RemovedWaves::scale(double x, double y) const {
  const auto line = [](double place, double low, double length, Eigen::Index cells) {
    const double at = std::clamp((place - low) / length * static_cast<double>(cells) - 0.5, 0.,
                                 static_cast<double>(cells - 1));
    const auto before = std::min(static_cast<Eigen::Index>(at), cells - 2);
    return std::pair(before, at - static_cast<double>(before));
  };
  const Box& box = place_.box();
  const auto [i, u] = line(x, box.low[0], box.length(0), scale_.rows());
  const auto [j, v] = line(y, box.low[1], box.length(1), scale_.cols());
  return (1 - u) * ((1 - v) * scale_(i, j) + v * scale_(i, j + 1)) +
         u * ((1 - v) * scale_(i + 1, j) + v * scale_(i + 1, j + 1));
}

double RemovedWaves::share(double pressure, double scale) const {
  const double p = pressure / scale;
  if (p <= pressure_.back()) return share_.back() * p / pressure_.back();
  if (p >= pressure_.front()) return share_.front();
  const auto after = std::upper_bound(pressure_.rbegin(), pressure_.rend(), p);
  const auto k = static_cast<std::size_t>(pressure_.rend() - after) - 1; // the pressure above p
  const double part = std::log(p / pressure_[k + 1]) / std::log(pressure_[k] / pressure_[k + 1]);
  return share_[k + 1] + part * (share_[k] - share_[k + 1]);
}

} // namespace host
