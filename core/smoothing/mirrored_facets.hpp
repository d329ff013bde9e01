// SPDX-License-Identifier: BSD-3-Clause
// A surface that ends on planes of symmetry, with its mirror images.
#pragma once

#include <array>

#include "core/smoothing/smoothing.hpp"

namespace ents {

struct MirrorPlane { // normal to an axis, at `place` on it
  int axis;
  double place;
};

class MirroredFacets {
public:
  // [facets][corners], [nodes][dimension]; both are looked at until all planes are added.
  MirroredFacets(int corners, int dimension, std::int64_t facets, const std::int64_t* connectivity,
                 std::int64_t nodes, const double* positions);

  enum class Outcome { done, no_node, both_sides };
  // `bad`: the plane that no node lies on, or that has nodes on both sides.
  Outcome add(const std::vector<MirrorPlane>& planes, std::size_t& bad);

  // With the images: those of facet f are f + k facets.
  std::int64_t all_facets() const { return static_cast<std::int64_t>(connectivity_.size()) / corners_; }
  std::int64_t all_nodes() const { return nodes_ + static_cast<std::int64_t>(images_.size()); }
  const std::int64_t* connectivity() const { return connectivity_.data(); }
  std::int64_t origin(std::int64_t node) const { return node < nodes_ ? node : image(node).node; }

  // What was smoothed with the images, as combinations of the nodes: the points of the facets themselves.
  void fold(Smoothed& surface) const;

private:
  struct Image { // x' = x + shift, components of the bits in `reflected` reversed
    std::int64_t node;
    std::int32_t reflected = 0;
    std::array<double, 3> shift{};
  };
  const Image& image(std::int64_t node) const { return images_[static_cast<std::size_t>(node - nodes_)]; }
  double place(std::int64_t node, int axis) const;
  Outcome add(const MirrorPlane& plane);
  bool joined_by_a_facet(const MirrorPlane& a, const MirrorPlane& b) const;

  int corners_, dimension_;
  std::int64_t facets_, nodes_;
  const double* positions_;
  double tolerance_ = 0.0;
  std::vector<std::int64_t> connectivity_;
  std::vector<Image> images_;
};

} // namespace ents
