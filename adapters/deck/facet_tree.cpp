// SPDX-License-Identifier: BSD-3-Clause
#include "facet_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace ents_deck {
namespace {

constexpr int leaf_size = 4;

Point at(const Point& a, const Point& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

Point on_edge(const Point& x, const Point& a, const Point& b) {
  const Point ab = minus(b, a);
  const double size = dot(ab, ab);
  return at(a, b, size > 0 ? std::clamp(dot(minus(x, a), ab) / size, 0.0, 1.0) : 0.0);
}

/// Closest point of a triangle, or of its edges where it is not ahead of x. Lines have c = b.
Point on_triangle(const Point& x, const Point& a, const Point& b, const Point& c) {
  const Point ab = minus(b, a), ac = minus(c, a), ax = minus(x, a);
  const double bb = dot(ab, ab), bc = dot(ab, ac), cc = dot(ac, ac), determinant = bb * cc - bc * bc;
  if (determinant > 1e-14 * bb * cc) {
    const double xb = dot(ax, ab), xc = dot(ax, ac);
    const double u = (cc * xb - bc * xc) / determinant, v = (bb * xc - bc * xb) / determinant;
    if (u >= 0 && v >= 0 && u + v <= 1)
      return {a[0] + u * ab[0] + v * ac[0], a[1] + u * ab[1] + v * ac[1], a[2] + u * ab[2] + v * ac[2]};
  }
  Point best = on_edge(x, a, b);
  for (const Point& other : {on_edge(x, b, c), on_edge(x, c, a)})
    if (length(minus(x, other)) < length(minus(x, best))) best = other;
  return best;
}

} // namespace

FacetTree::FacetTree(const Mesh& mesh, const std::vector<Face>& faces) {
  for (const Face& face : faces) {
    const auto x = [&](std::size_t i) { return mesh.nodes[static_cast<std::size_t>(face.nodes[i])].x; };
    auto& triangles = triangles_.emplace_back();
    const auto corners = static_cast<std::size_t>(corner_count(face.shape));
    if (corners == 2) triangles.push_back({x(0), x(1), x(1)});
    for (std::size_t i = 2; i < corners; ++i) triangles.push_back({x(0), x(i - 1), x(i)});
    normals_.push_back(face_normal(mesh, face));
    Point low = x(0), high = x(0);
    for (std::size_t i = 1; i < corners; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        low[j] = std::min(low[j], x(i)[j]), high[j] = std::max(high[j], x(i)[j]);
    low_.push_back(low);
    high_.push_back(high);
  }
  order_.resize(faces.size());
  std::iota(order_.begin(), order_.end(), 0);
  if (!faces.empty()) build(0, static_cast<int>(faces.size()));
}

int FacetTree::build(int first, int count) {
  const int self = static_cast<int>(boxes_.size());
  Box box;
  box.low.fill(std::numeric_limits<double>::infinity());
  box.high.fill(-std::numeric_limits<double>::infinity());
  for (int i = first; i < first + count; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      box.low[j] =
          std::min(box.low[j], low_[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])][j]);
      box.high[j] =
          std::max(box.high[j], high_[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])][j]);
    }
  box.first = first;
  box.count = count;
  boxes_.push_back(box);
  if (count <= leaf_size) return self;
  std::size_t widest = 0;
  for (std::size_t j = 1; j < 3; ++j)
    if (box.high[j] - box.low[j] > box.high[widest] - box.low[widest]) widest = j;
  const auto middle = [&](int f) {
    return low_[static_cast<std::size_t>(f)][widest] + high_[static_cast<std::size_t>(f)][widest];
  };
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count,
                   [&](int a, int b) { return middle(a) < middle(b); });
  const int left = build(first, count / 2), right = build(first + count / 2, count - count / 2);
  boxes_[static_cast<std::size_t>(self)].left = left;
  boxes_[static_cast<std::size_t>(self)].right = right;
  return self;
}

FacetTree::Closest FacetTree::on_face(const Point& x, int face) const {
  Closest out{-1, {}, std::numeric_limits<double>::infinity()};
  for (const Triangle& t : triangles_[static_cast<std::size_t>(face)]) {
    const Point p = on_triangle(x, t.a, t.b, t.c);
    const double d = length(minus(x, p));
    if (d < out.distance) out = {face, p, d};
  }
  return out;
}

double FacetTree::distance(const Point& x, int face) const { return on_face(x, face).distance; }

FacetTree::Closest FacetTree::closest(const Point& x, const Point& facing) const {
  Closest best{-1, {}, std::numeric_limits<double>::infinity()};
  const auto to_box = [&](const Box& box) {
    double sum = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      const double d = std::max({box.low[j] - x[j], x[j] - box.high[j], 0.0});
      sum += d * d;
    }
    return std::sqrt(sum);
  };
  std::vector<int> stack;
  if (!boxes_.empty()) stack.push_back(0);
  while (!stack.empty()) {
    const Box& box = boxes_[static_cast<std::size_t>(stack.back())];
    stack.pop_back();
    if (to_box(box) >= best.distance) continue;
    if (box.left < 0) {
      for (int i = box.first; i < box.first + box.count; ++i) {
        const int face = order_[static_cast<std::size_t>(i)];
        if (dot(normals_[static_cast<std::size_t>(face)], facing) > 0) continue;
        const Closest found = on_face(x, face);
        // Of equally close faces the first one: what is chosen does not depend on the tree.
        if (found.distance < best.distance || (found.distance == best.distance && found.face < best.face))
          best = found;
      }
      continue;
    }
    const bool left_first = to_box(boxes_[static_cast<std::size_t>(box.left)]) <
                            to_box(boxes_[static_cast<std::size_t>(box.right)]);
    stack.push_back(left_first ? box.right : box.left);
    stack.push_back(left_first ? box.left : box.right);
  }
  if (best.face < 0) best.distance = 0;
  return best;
}

} // namespace ents_deck
