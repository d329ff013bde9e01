// SPDX-License-Identifier: BSD-3-Clause
// A slave point above its facet, x = sum_i N_i x_i + h n with the facet's unit normal n: its place and its
// derivatives by the facet's nodes (theory.md, section 11.4). All of them follow from one vector per node,
//   p_i = sum_k N_i,k a^k           (a^k: dual tangents of the facet)
//   dx / dx_i              = N_i 1 - h p_i (x) n
//   c . d2x / dx_i dx_j    = h [ (c . p_j) n (x) p_i + (c . p_i) p_j (x) n - (c . n) (p_i . p_j) n (x) n ]
#pragma once

#include <cstdint>

#include "core/model/model.hpp"
#include "core/model/status.hpp"

namespace ents {

inline constexpr int most_facet_nodes = 9;

struct RaisedPoint {
  int dimension, count; // of space, and nodes of the facet
  double height, normal[3], place[3];
  double area;                       // of the facet, per unit of its natural coordinates
  const double* weights;             // N_i [count]
  double along[most_facet_nodes][3]; // p_i

  // positions [nodes][d] of all nodes; slopes N_i,k [count][d-1]. degenerate_segment: the facet has no normal.
  Status set(int d, std::int64_t facet_nodes, const std::int64_t* nodes, const double* weights,
             const double* slopes, double height, const double* positions) noexcept;
  // J[a][b]: component a of x by component b of node i
  void derivative(int i, double (&J)[3][3]) const noexcept;
  // G[a][b]: sum_c force_c d2x_c by component a of node i and component b of node j
  void second_derivative(int i, int j, const double* force, double (&G)[3][3]) const noexcept;
};

// N_i,k [count][d-1] of the facet whose shape functions are `weights`, by its dimension and number of nodes, and
// its natural coordinates there. bad_value: they are those of no facet of so many nodes.
Status facet_slopes(int d, std::int64_t count, const double* weights, double* slopes,
                    double (&xi)[2]) noexcept;

} // namespace ents
