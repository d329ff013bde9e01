// SPDX-License-Identifier: BSD-3-Clause
#include "detector.hpp"

#include <algorithm>
#include <cmath>

#include "error.hpp"

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

Lost Detector::find(const ents_master_mesh& mesh, const std::vector<double>& slaves,
                    const std::vector<double>& normals, Projections& at) const {
  const ents::Library& library = model_->library();
  const auto d = static_cast<std::size_t>(model_->layout().dimension);
  std::vector<std::int32_t> flags(at.segment.size());
  auto detection = ents_struct<ents_detection>();
  detection.slave = slaves.data();
  if (!normals.empty()) detection.slave_normal = normals.data();
  detection.reach = reach_of(mesh, slaves, d);
  detection.segment = at.segment.data();
  detection.xi = at.xi.data();
  detection.flags = flags.data();
  detection.permitted =
      ENTS_FLAG_LEFT | ENTS_FLAG_BEHIND_EDGE; // of an iterate; the caller looks at what is returned
  auto report = ents_struct<ents_report>();
  const std::int32_t status =
      library.detect(model_->get(), &mesh, tree_.data(), static_cast<std::int64_t>(tree_.size()), 0,
                     static_cast<std::int64_t>(at.segment.size()), &detection, &report);
  if (status != ENTS_OK) throw JobError("contact search: " + describe(library, status, report));
  Lost lost;
  for (std::size_t k = 0; k < at.segment.size(); ++k) {
    if (at.segment[k] >= 0) continue;
    std::fill_n(at.xi.begin() + static_cast<std::ptrdiff_t>(k * (d - 1)), d - 1, 0.0);
    if ((flags[k] & (ENTS_FLAG_BEHIND_EDGE | ENTS_FLAG_LEFT)) == 0 || lost.slave >= 0) continue;
    lost = {static_cast<std::int64_t>(k), (flags[k] & ENTS_FLAG_BEHIND_EDGE) != 0};
  }
  return lost;
}

} // namespace host
