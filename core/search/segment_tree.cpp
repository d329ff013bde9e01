// SPDX-License-Identifier: BSD-3-Clause
#include "core/search/segment_tree.hpp"

#include <algorithm>
#include <vector>

#include "core/search/detection.hpp"

namespace ents {

Status box_of_segment(const Plan& plan, const MasterMesh& mesh, std::int64_t segment, double* low,
                      double* high) {
  SegmentNodes nodes;
  const Status status = gather(plan, mesh, segment, nodes);
  if (status == Status::ok) plan.box(plan, nodes.positions, nodes.surface_coordinates, low, high);
  return status;
}

std::int64_t tree_size(const Plan& plan, std::int64_t segments) {
  return segments > std::int64_t{1} << 40 ? 0 : BoxTree(plan, segments).size();
}

bool is_tree(const Plan& plan, const MasterMesh& mesh, const double* tree) {
  return tree[0] == tree_tag + plan.dimension && tree[1] == static_cast<double>(mesh.segments);
}

bool is_tree_of_model(const Plan& plan, const double* tree) { return tree[2] == plan.surface_stamp; }

Status build_tree(const Plan& plan, const MasterMesh& mesh, double* tree, std::int64_t& segment) {
  const BoxTree t(plan, mesh.segments);
  const int d = t.d;
  tree[0] = 0.0; // no tree until all boxes are there
  std::vector<double> centre(static_cast<std::size_t>(t.segments * d));
  double* order = t.order(tree);
  for (segment = 0; segment < t.segments; ++segment) {
    double low[3], high[3];
    if (const Status status = box_of_segment(plan, mesh, segment, low, high); status != Status::ok)
      return status;
    for (int k = 0; k < d; ++k) centre[static_cast<std::size_t>(segment * d + k)] = 0.5 * (low[k] + high[k]);
    order[segment] = static_cast<double>(segment);
  }
  const auto at = [&](double s, int k) {
    return centre[static_cast<std::size_t>(s) * static_cast<std::size_t>(d) + static_cast<std::size_t>(k)];
  };
  for (int level = 0; level < t.depth; ++level)
    for (std::int64_t k = 0; k < std::int64_t{1} << level; ++k) {
      double *first = order + t.first(k, level), *last = order + t.first(k + 1, level);
      int widest = 0;
      double width = -1.0;
      for (int c = 0; c < d; ++c) {
        double least = infinity, most = -infinity;
        for (const double* s = first; s != last; ++s) {
          least = std::min(least, at(*s, c));
          most = std::max(most, at(*s, c));
        }
        if (most - least > width) width = most - least, widest = c;
      }
      std::nth_element(first, order + t.first(2 * k + 1, level + 1), last, [&](double a, double b) {
        const double x = at(a, widest), y = at(b, widest);
        return x != y ? x < y : a < b;
      });
    }
  tree[1] = static_cast<double>(t.segments);
  return refit_tree(plan, mesh, tree, segment);
}

Status refit_tree(const Plan& plan, const MasterMesh& mesh, double* tree, std::int64_t& segment) {
  const BoxTree t(plan, mesh.segments);
  const int d = t.d;
  tree[0] = 0.0;
  for (std::int64_t node = 2 * t.leaves() - 1; node > 0; --node) {
    double* box = t.box(tree, node);
    for (int k = 0; k < d; ++k) box[k] = infinity, box[d + k] = -infinity;
    const auto join = [&](const double* low, const double* high) {
      for (int k = 0; k < d; ++k) {
        box[k] = std::min(box[k], low[k]);
        box[d + k] = std::max(box[d + k], high[k]);
      }
    };
    if (node >= t.leaves()) {
      const std::int64_t leaf = node - t.leaves();
      for (std::int64_t i = t.first(leaf, t.depth); i < t.first(leaf + 1, t.depth); ++i) {
        segment = static_cast<std::int64_t>(t.order(tree)[i]);
        double low[3], high[3];
        if (const Status status = box_of_segment(plan, mesh, segment, low, high); status != Status::ok)
          return status;
        join(low, high);
      }
    } else {
      for (const std::int64_t child : {2 * node, 2 * node + 1})
        join(t.box(tree, child), t.box(tree, child) + d);
    }
  }
  tree[0] = tree_tag + d, tree[2] = plan.surface_stamp;
  return Status::ok;
}

} // namespace ents
