// SPDX-License-Identifier: BSD-3-Clause
// Contact: slave points without a projection. Beyond the ends of a curved segment the equation for it need
// not have a solution, or the segment's extension folds. Such a point is open, and no reason to cut the step.
// Near the surface it may be one that has gone through.
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "contact.hpp"

namespace host {
namespace {

std::ptrdiff_t offset(std::size_t value) { return static_cast<std::ptrdiff_t>(value); }

} // namespace

bool Contact::is_far(std::size_t e) const {
  const double* first = master_positions_.data() + (master_.segments == 1 ? 0 : e * m_ * d_);
  std::vector<double> coordinates;
  if (!active_coordinates_.empty()) {
    const auto begin = active_coordinates_.begin() + offset(e * m_ * parameters_);
    coordinates.assign(begin, begin + offset(m_ * parameters_));
  }
  constexpr std::size_t cells = 16;
  const SurfaceSample sample =
      sample_surface(*master_.model, {first, first + m_ * d_}, coordinates,
                     even_grid(static_cast<int>(parameters_), cells, master_.triangles));
  const std::size_t count = sample.height.size();
  using Point = Eigen::Vector3d;
  const auto point = [&](const std::vector<double>& from, std::size_t i) {
    Point p = Point::Zero();
    for (std::size_t c = 0; c < d_; ++c) p[static_cast<Eigen::Index>(c)] = from[i * d_ + c];
    return p;
  };
  Point normal = Point::Zero();
  for (std::size_t i = 0; i < count; ++i) normal += point(sample.base_normal, i);
  normal.normalize();
  // A box along the normal and across it.
  Eigen::Matrix3d axes;
  axes.col(2) = normal;
  axes.col(0) = d_ == 2 ? Point(normal[1], -normal[0], 0) : Point(normal.unitOrthogonal());
  axes.col(1) = normal.cross(axes.col(0));
  Point low = Point::Constant(INFINITY), high = -low;
  for (std::size_t i = 0; i < count; ++i) {
    const Point p = axes.transpose() * point(sample.point, i);
    low = low.cwiseMin(p), high = high.cwiseMax(p);
  }
  const double margin = 0.01 * (high - low).norm(); // of what lies between the samples
  const Point slave = axes.transpose() * point(slave_positions_, e);
  const bool ahead = slave[2] > high[2] + margin;
  const auto beside = [&](Eigen::Index i) {
    return slave[i] > high[i] + margin || slave[i] < low[i] - margin;
  };
  return ahead || beside(0) || beside(1);
}

std::int32_t Contact::without_far(const std::vector<std::int32_t>& status, const ents_input& in,
                                  ents_report& report) {
  const EntsLibrary& library = master_.model->library();
  for (std::size_t e = 0; e < status.size(); ++e) {
    if (status[e] == ENTS_OK) continue;
    if ((status[e] == ENTS_NO_PROJECTION || status[e] == ENTS_DEGENERATE_SEGMENT) && is_far(e)) {
      if (state_size_ == 0) continue;
      auto one = ents_struct<ents_report>();
      const std::int32_t made =
          library.state_init(master_.model->get(), 1, state_out_.data() + e * state_size_,
                             static_cast<std::int64_t>(state_size_), &one);
      if (made != ENTS_OK) throw JobError("contact state: " + describe(library, made, one));
      continue;
    }
    std::vector<double> residual((e + 1) * element_dofs_);
    std::vector<std::int32_t> again(e + 1);
    auto out = ents_struct<ents_output>(); // once more, for the message
    out.wanted = ENTS_RESIDUAL;
    out.residual = residual.data(), out.residual_stride = static_cast<std::int64_t>(element_dofs_);
    out.status = again.data(), out.status_stride = 1;
    report = ents_struct<ents_report>();
    library.evaluate(master_.model->get(), static_cast<std::int64_t>(e), 1, &in, &out, &report);
    return status[e];
  }
  return ENTS_OK;
}

} // namespace host
