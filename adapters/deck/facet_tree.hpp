// SPDX-License-Identifier: BSD-3-Clause
// Closest point of a set of plain faces, through a tree of boxes. Faces are cut into triangles through their
// corners: good enough to choose which segments an element needs, for which nothing is projected.
#pragma once

#include <vector>

#include "faces.hpp"

namespace ents_deck {

class FacetTree {
public:
  FacetTree(const Mesh& mesh, const std::vector<Face>& faces);

  struct Closest {
    int face = -1; ///< -1: there is none
    Point point{};
    double distance = 0;
  };
  /// @param facing  faces whose normal has an angle below 90 degrees with it are left out; zero: none are
  Closest closest(const Point& x, const Point& facing) const;

  double distance(const Point& x, int face) const;

private:
  struct Box {
    Point low{}, high{};
    int first = 0, count = 0; ///< faces of a leaf
    int left = -1, right = -1;
  };
  struct Triangle {
    Point a, b, c;
  };
  std::vector<Box> boxes_;
  std::vector<int> order_;
  std::vector<std::vector<Triangle>> triangles_; ///< [faces]
  std::vector<Point> normals_, low_, high_;

  int build(int first, int count);
  Closest on_face(const Point& x, int face) const;
};

} // namespace ents_deck
