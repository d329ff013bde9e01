// SPDX-License-Identifier: BSD-3-Clause
#include "master_frame.hpp"

#include <algorithm>
#include <cmath>

namespace host {

MasterFrame::MasterFrame(const Master& master)
    : master_(&master), d_(static_cast<std::size_t>(master.model->layout().dimension)) {}

const ents::Library& MasterFrame::library() const { return master_->model->library(); }

std::array<double, 3> MasterFrame::spin(const Configuration& at) const {
  std::array<double, 3> spin{};
  const double* turns = at.displacement.data() + (static_cast<std::size_t>(master_->body_node) + 1) * d_;
  for (std::size_t i = 0; i < (d_ == 2 ? 1 : 3); ++i)
    spin[i] = turns[i] - (at.turned.empty() ? 0 : at.turned[i]);
  return spin;
}

ents_pose MasterFrame::pose_at(const Configuration& at) const {
  auto pose = ents_struct<ents_pose>();
  auto report = ents_struct<ents_report>();
  const double* moved = at.displacement.data() + static_cast<std::size_t>(master_->body_node) * d_;
  std::array<double, 3> point = master_->reference;
  for (std::size_t i = 0; i < d_; ++i) point[i] += moved[i];
  const auto d = static_cast<std::int32_t>(d_);
  std::int32_t status = library().pose_init(d, &pose, &report);
  std::copy(at.rotation.begin(), at.rotation.end(), pose.turn);
  if (status == ENTS_OK) status = library().pose_move(d, point.data(), spin(at).data(), &pose, &report);
  if (status != ENTS_OK) throw JobError("the rigid body: " + describe(library(), report.status, report));
  return pose;
}

void MasterFrame::keep_rotation(Configuration& at) const {
  if (!turns()) return;
  const ents_pose pose = pose_at(at);
  at.rotation.assign(pose.turn, pose.turn + d_ * d_);
  const double* turns = at.displacement.data() + (static_cast<std::size_t>(master_->body_node) + 1) * d_;
  at.turned.assign(turns, turns + (d_ == 2 ? 1 : 3));
}

// With a spin s that is not small its change ds turns the body by T ds, T the tangent of the exponential map:
// T = I + (1 - cos a) / a^2 [s]x + (a - sin a) / a^3 [s]x^2, a = |s|. The library's columns are for T ds.
void MasterFrame::columns_of_turns(const Configuration& at, const std::vector<std::int64_t>& equations,
                                   SparseMatrix& tangent) const {
  if (!turns() || d_ == 2) return;
  const std::array<double, 3> s = spin(at);
  const double a = std::hypot(s[0], s[1], s[2]), half = std::sin(a / 2);
  if (a == 0) return;
  // Below 1e-3 the difference a - sin a is mostly rounding, and two terms of its series are exact.
  const double first = 2 * half * half / (a * a),
               second = a < 1e-3 ? 1. / 6 - a * a / 120 : (a - std::sin(a)) / (a * a * a);
  double map[3][3];
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) map[i][j] = second * s[i] * s[j] + (i == j ? 1 - second * a * a : 0);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    map[k][j] += first * s[i], map[j][k] -= first * s[i];
  }
  for (Eigen::Index row = 0; row < tangent.outerSize(); ++row) {
    std::array<double*, 3> entry{};
    for (int place = tangent.outerIndexPtr()[row]; place < tangent.outerIndexPtr()[row + 1]; ++place)
      for (std::size_t j = 0; j < 3; ++j)
        if (tangent.innerIndexPtr()[place] == equations[3 + j]) entry[j] = tangent.valuePtr() + place;
    if (entry[0] == nullptr) continue; // a row has all three or none
    const std::array<double, 3> spins{*entry[0], *entry[1], *entry[2]};
    for (std::size_t j = 0; j < 3; ++j)
      *entry[j] = spins[0] * map[0][j] + spins[1] * map[1][j] + spins[2] * map[2][j];
  }
}

void MasterFrame::see(const Configuration& at, std::vector<double>& positions) {
  for (std::size_t i = 0; master_->translates() && i < positions.size(); ++i)
    positions[i] -= at.motion * master_->direction[i % d_];
  if (!turns()) return;
  pose_ = pose_at(at);
  auto report = ents_struct<ents_report>();
  if (library().pose_to_body(static_cast<std::int32_t>(d_), &pose_,
                             static_cast<std::int64_t>(positions.size() / d_), positions.data(),
                             positions.data(), &report) != ENTS_OK)
    throw JobError("the rigid body: " + describe(library(), report.status, report));
}

void MasterFrame::turn(std::vector<double>& vectors) const {
  auto report = ents_struct<ents_report>();
  if (library().pose_to_space(static_cast<std::int32_t>(d_), &pose_,
                              static_cast<std::int64_t>(vectors.size() / d_), vectors.data(), vectors.data(),
                              &report) != ENTS_OK)
    throw JobError("the rigid body: " + describe(library(), report.status, report));
}

void MasterFrame::to_space(std::vector<double>& points) const {
  turn(points);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] += pose_.point[i % d_];
}

std::vector<double> MasterFrame::moment(const std::vector<double>& places,
                                        const std::vector<double>& forces) const {
  std::vector<double> sum(d_ == 2 ? 1 : 3, 0.0);
  for (std::size_t k = 0; k < places.size() / d_; ++k) {
    std::array<double, 3> arm{}, force{};
    for (std::size_t i = 0; i < d_; ++i)
      arm[i] = places[k * d_ + i] - pose_.point[i], force[i] = forces[k * d_ + i];
    for (std::size_t i = 0; i < sum.size(); ++i) {
      const std::size_t b = d_ == 2 ? 0 : (i + 1) % 3, c = d_ == 2 ? 1 : (i + 2) % 3;
      sum[i] += arm[b] * force[c] - arm[c] * force[b];
    }
  }
  return sum;
}

} // namespace host
