// SPDX-License-Identifier: BSD-3-Clause
// The enriched surface as facets between samples, in a tree of boxes (Eigen's), and the conditions that
// compare any two places of it.
#pragma once

#include <cstdint>
#include <unsupported/Eigen/BVH>
#include <utility>
#include <vector>

#include "core/admissibility/surface_checker.hpp"

namespace ents {

// A cell of the grid of samples of a segment: a line, or a quadrangle that is cut into two triangles; the
// last cell of each row of a triangular segment is one triangle.
struct Facets {
  using Tree = Eigen::KdBVH<double, 3, std::int64_t>;

  int n = 2; // samples per direction
  std::int64_t per_segment = 0;
  std::vector<Eigen::Vector3d> points, normals; // [segments][per_segment]
  std::vector<char> known;                      // 0: rho_e has no tangent plane there
  Tree tree;                                    // of cells

  // As many samples as `wanted`, fewer where the surface has many segments: 2^18 in all, or the corners of
  // each.
  Facets(const SurfaceChecker& checker, int wanted);

  struct Cell {
    std::int64_t segment;
    int i, j;
  };
  Cell cell(std::int64_t index) const {
    const std::int64_t row = n - 1, all = surface_ ? row * row : row, k = index % all;
    return {index / all, static_cast<int>(k % row), static_cast<int>(k / row)};
  }
  // Sample (i, j) of a segment.
  std::int64_t sample(std::int64_t segment, int i, int j) const {
    const std::int64_t before =
        simplex_ ? std::int64_t{j} * n - std::int64_t{j} * (j - 1) / 2 : std::int64_t{j} * n;
    return segment * per_segment + before + i;
  }
  void xi_of(int i, int j, double (&xi)[2]) const;
  bool on_border(int i, int j) const {
    return i == 0 || i == n - 1 || (surface_ && (j == 0 || j == n - 1 || (simplex_ && i + j == n - 1)));
  }
  // Corners of its lines (2 each) or triangles (3 each), as (i, j); the number of these pieces: 0 .. 2.
  struct Piece {
    int corner[3][2];
  };
  int pieces(const Cell& cell, Piece (&out)[2]) const;
  int corners() const { return surface_ ? 3 : 2; }
  const Eigen::Vector3d& point(const Cell& c, const int (&corner)[2]) const {
    return points[static_cast<std::size_t>(sample(c.segment, corner[0], corner[1]))];
  }

private:
  bool surface_, simplex_;
};

// Two normal projections of one slave: the smallest ball that touches the surface in two places.
void check_two_projections(const SurfaceChecker& checker, const Facets& facets,
                           const std::vector<bool>& smooth);
// Points of the surface with another one between them and the light.
void check_occlusion(const SurfaceChecker& checker, const Facets& facets);
// Segments that intersect each other, or themselves.
void check_crossing(const SurfaceChecker& checker, const Facets& facets);

} // namespace ents
