// SPDX-License-Identifier: BSD-3-Clause
// Which master segment each slave point is projected on: ents_detect with its tree.
#pragma once

#include <cstdint>
#include <vector>

#include "both_sides.hpp"
#include "ents_library.hpp"

namespace host {

/// Segments and natural coordinates of slave points.
struct Projections {
  std::vector<std::int64_t> segment; ///< [slaves] -1: none
  std::vector<double> xi;            ///< [slaves][d-1]; 0 where there is no segment
};

/// A slave that has no segment although it has not risen from the surface.
struct Lost {
  std::int64_t slave = -1;  ///< -1: none
  bool behind_edge = false; ///< between two segments: it projects on neither; else it has left all segments
                            ///< beside a free edge
  bool crossed = false;     ///< it has passed through the surface within the increment
};

class Detector {
public:
  /// @param model  has to live as long as this
  explicit Detector(const EntsModel& model) : model_(&model) {}

  /// Has the master been anywhere yet?
  bool is_placed() const { return !tree_.empty(); }
  /// The master is at `mesh.positions` now.
  void move(const ents_master_mesh& mesh);

  /// @param slaves  [slaves][d] positions
  /// @param normals [slaves][d] out of their body, or empty: segments that look the same way are left out
  /// @param at      in: the projections of before, which are followed; segment -1: all segments are searched.
  ///                out: the present ones
  /// @return the first slave that is lost: behind an edge, or one that had a segment and is beside all of
  ///         them
  /// @throws JobError with the library's message
  Lost find(const ents_master_mesh& mesh, const std::vector<double>& slaves,
            const std::vector<double>& normals, const LeftOut& left_out, Projections& at) const;
  /// Self-contact: the thickness of the body below the slaves, where an increment begins.
  /// @param thickness [slaves] in: the last one, or 0; out: the present one
  void measure(const ents_master_mesh& mesh, const std::vector<double>& slaves,
               const std::vector<double>& normals, const LeftOut& left_out,
               std::vector<double>& thickness) const;

private:
  ents_detection arguments(const ents_master_mesh& mesh, const std::vector<double>& slaves,
                           const std::vector<double>& normals, const LeftOut& left_out) const;

  const EntsModel* model_;
  std::vector<double> tree_;
};

} // namespace host
