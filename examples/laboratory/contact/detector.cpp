// SPDX-License-Identifier: BSD-3-Clause
#include "detector.hpp"

#include <algorithm>
#include <cmath>

#include "toolbox/error.hpp"

namespace host {
namespace {

/// Farther than any slave is from the surface: an iterate of Newton's may take a slave a long way through it.
double reach_of(const ents_master_mesh& mesh, const std::vector<double>& slaves, std::size_t d) {
  double squared = 0;
  for (std::size_t i = 0; i < d; ++i) {
    double low = INFINITY, high = -low;
    const auto cover = [&](const double* positions, std::size_t count) {
      for (std::size_t k = 0; k < count; ++k) {
        low = std::min(low, positions[k * d + i]);
        high = std::max(high, positions[k * d + i]);
      }
    };
    cover(mesh.positions, static_cast<std::size_t>(mesh.nodes));
    cover(slaves.data(), slaves.size() / d);
    squared += (high - low) * (high - low);
  }
  return 2 * std::sqrt(squared);
}

/// Self-contact: what is farther in front of a slave is open, and nothing is contact that a slave is behind by more than
/// half the thickness of its body.
double longest_segment(const ents_master_mesh& mesh, std::size_t nodes, std::size_t d) {
  double longest = 0;
  for (std::int64_t s = 0; s < mesh.segments; ++s)
    for (std::size_t a = 1; a < nodes; ++a) {
      const std::int64_t* of = mesh.connectivity + static_cast<std::size_t>(s) * nodes;
      double squared = 0;
      for (std::size_t i = 0; i < d; ++i) {
        const double apart = mesh.positions[static_cast<std::size_t>(of[a]) * d + i] -
                             mesh.positions[static_cast<std::size_t>(of[0]) * d + i];
        squared += apart * apart;
      }
      longest = std::max(longest, squared);
    }
  return std::sqrt(longest);
}

} // namespace

void Detector::move(const ents_master_mesh& mesh) {
  const ents::Library& library = model_->library();
  auto report = ents_struct<ents_report>();
  std::int32_t status = ENTS_OK;
  if (tree_.empty()) {
    std::int64_t size = 0;
    status = library.tree_size(model_->get(), mesh.segments, &size, &report);
    tree_.resize(static_cast<std::size_t>(size));
    if (status == ENTS_OK) status = library.tree_build(model_->get(), &mesh, tree_.data(), size, &report);
  } else {
    status = library.tree_refit(model_->get(), &mesh, tree_.data(), static_cast<std::int64_t>(tree_.size()),
                                &report);
  }
  if (status != ENTS_OK) throw JobError("contact search: " + describe(library, status, report));
}

ents_detection Detector::arguments(const ents_master_mesh& mesh, const std::vector<double>& slaves,
                                   const std::vector<double>& normals, const LeftOut& left_out) const {
  const auto given = [](const auto& array) { return array.empty() ? nullptr : array.data(); };
  auto detection = ents_struct<ents_detection>();
  detection.slave = slaves.data(), detection.slave_normal = given(normals);
  const auto d = static_cast<std::size_t>(model_->layout().dimension);
  const bool one_surface = !left_out.node.empty() || !left_out.segment.empty();
  detection.reach = one_surface ? longest_segment(mesh, static_cast<std::size_t>(model_->layout().nodes), d)
                                : reach_of(mesh, slaves, d);
  detection.slave_node = given(left_out.node), detection.slave_segment = given(left_out.segment);
  detection.depth = given(left_out.depth);
  detection.slave_side = given(left_out.side), detection.segment_side = given(left_out.segment_side);
  detection.slave_begin = left_out.slave_begin, detection.positions_begin = left_out.positions_begin;
  return detection;
}

void Detector::measure(const ents_master_mesh& mesh, const std::vector<double>& slaves,
                       const std::vector<double>& normals, const LeftOut& left_out,
                       std::vector<double>& thickness) const {
  const ents::Library& library = model_->library();
  std::vector<std::int64_t> segment(thickness.size(), -1);
  std::vector<double> xi(thickness.size() * static_cast<std::size_t>(model_->layout().parameters));
  ents_detection detection = arguments(mesh, slaves, normals, left_out);
  detection.segment = segment.data(), detection.xi = xi.data(), detection.depth = nullptr;
  auto report = ents_struct<ents_report>();
  const std::int32_t status =
      library.thickness(model_->get(), &mesh, tree_.data(), static_cast<std::int64_t>(tree_.size()), 0,
                        static_cast<std::int64_t>(thickness.size()), &detection, thickness.data(), &report);
  if (status != ENTS_OK) throw JobError("thickness of the body: " + describe(library, status, report));
}

Lost Detector::find(const ents_master_mesh& mesh, const std::vector<double>& slaves,
                    const std::vector<double>& normals, const LeftOut& left_out, Projections& at) const {
  const ents::Library& library = model_->library();
  const auto d = static_cast<std::size_t>(model_->layout().dimension);
  std::vector<std::int32_t> flags(at.segment.size());
  ents_detection detection = arguments(mesh, slaves, normals, left_out);
  detection.segment = at.segment.data();
  detection.xi = at.xi.data();
  detection.flags = flags.data();
  detection.permitted =
      ENTS_FLAG_LEFT | ENTS_FLAG_BEHIND_EDGE; // of an iterate; the caller looks at what is returned
  auto report = ents_struct<ents_report>();
  const std::int32_t status =
      library.detect(model_->get(), &mesh, tree_.data(), static_cast<std::int64_t>(tree_.size()), 0,
                     static_cast<std::int64_t>(at.segment.size()), &detection, &report);
  const bool crossed = status == ENTS_NO_PROJECTION; // all else that it says is permitted
  if (status != ENTS_OK && !crossed) throw JobError("contact search: " + describe(library, status, report));
  Lost lost;
  if (crossed) lost = {report.element, false, true};
  for (std::size_t k = 0; k < at.segment.size(); ++k) {
    if (at.segment[k] >= 0) continue;
    std::fill_n(at.xi.begin() + static_cast<std::ptrdiff_t>(k * (d - 1)), d - 1, 0.0);
    if ((flags[k] & (ENTS_FLAG_BEHIND_EDGE | ENTS_FLAG_LEFT)) == 0 || lost.slave >= 0) continue;
    lost = {static_cast<std::int64_t>(k), (flags[k] & ENTS_FLAG_BEHIND_EDGE) != 0, false};
  }
  return lost;
}

} // namespace host
