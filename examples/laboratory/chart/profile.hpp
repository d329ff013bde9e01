// SPDX-License-Identifier: BSD-3-Clause
// The masters of the stability maps: a row of segments on an arc, carrying waves.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "toolbox/json_reader.hpp"

namespace host::chart {

/// How one and the same geometry is given to the library.
enum class SurfaceKind {
  plain, ///< explicit facets: line2 segments through points of the c2 surface, no height
  local, ///< line2 segments with a height that vanishes at their ends
  c1,    ///< catmull_rom4 with the height
  c2,    ///< bspline4 with the height
};
enum class ProjectionKind { normal, shadow };
enum class TangentKind {
  consistent,
  small_gap,
  first_variation, ///< K = lambda' dg dg^T, made by the host from the gap's gradient
};

struct Method {
  SurfaceKind surface = SurfaceKind::c2;
  ProjectionKind projection = ProjectionKind::normal;
  TangentKind tangent = TangentKind::consistent;
};
inline constexpr SurfaceKind surface_kinds[] = {SurfaceKind::plain, SurfaceKind::local, SurfaceKind::c1,
                                                SurfaceKind::c2};
inline constexpr ProjectionKind projection_kinds[] = {ProjectionKind::normal, ProjectionKind::shadow};
inline constexpr TangentKind tangent_kinds[] = {TangentKind::consistent, TangentKind::small_gap,
                                                TangentKind::first_variation};
const char* word(SurfaceKind kind);
const char* word(ProjectionKind kind);
const char* word(TangentKind kind);

/// h(s) = constant + sum of amplitude sin(2 pi waves s + phase).
struct Height {
  struct Wave {
    double amplitude, waves, phase;
  };
  double constant = 0;
  std::vector<Wave> sum;

  double value(double s) const;
  double slope(double s) const;
  double highest() const; ///< a bound
  Json json() const;      ///< as the model has it
};

/// A row of segments of length 1 on an arc; s counts segments, 0 in the middle of the row.
struct Profile {
  SurfaceKind surface = SurfaceKind::c2;
  double curvature = 0; ///< of the arc; > 0: the slave is on the side of its centre
  int segments = 4;     ///< even
  Height height;
  double wavelength = 1;    ///< the shortest of the height, in segments
  int facets_per_wave = 16; ///< plain
};

/// The arc's point at arc length s, moved by `level` along its normal.
struct ArcPoint {
  double x, y;
};
ArcPoint on_arc(double curvature, double s, double level);

/// Nodes of a row in the order in which the library wants them.
struct SegmentRow {
  std::string segment; ///< the library's name
  int nodes_per_segment = 2;
  std::vector<double> positions;           ///< [nodes][2]
  std::vector<std::int64_t> connectivity;  ///< [segments][nodes_per_segment]
  std::vector<double> surface_coordinates; ///< [segments][nodes_per_segment]; empty: no height
  std::int64_t segments() const { return static_cast<std::int64_t>(connectivity.size()) / nodes_per_segment; }
};
SegmentRow make_row(const Profile& profile);

} // namespace host::chart
