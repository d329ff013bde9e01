// SPDX-License-Identifier: BSD-3-Clause
#include "core/smoothing/mirrored_facets.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace ents {

MirroredFacets::MirroredFacets(int corners, int dimension, std::int64_t facets,
                               const std::int64_t* connectivity, std::int64_t nodes, const double* positions)
    : corners_(corners), dimension_(dimension), facets_(facets), nodes_(nodes), positions_(positions),
      connectivity_(connectivity, connectivity + corners * facets) {
  double extent = 0.0;
  for (int axis = 0; axis < dimension && facets > 0; ++axis) {
    double low = place(connectivity_[0], axis), high = low;
    for (const std::int64_t node : connectivity_) {
      low = std::min(low, place(node, axis));
      high = std::max(high, place(node, axis));
    }
    extent = std::max(extent, high - low);
  }
  tolerance_ = 1e-9 * extent;
}

double MirroredFacets::place(std::int64_t node, int axis) const {
  const double x = positions_[origin(node) * dimension_ + axis];
  if (node < nodes_) return x;
  return ((image(node).reflected >> axis & 1) != 0 ? -x : x) +
         image(node).shift[static_cast<std::size_t>(axis)];
}

// A segment sees two nodes beyond each border of its facet. Between two planes of one axis the surface is
// repeated without end; with the images in one and then in the other it goes on by one width beyond the
// first: too short if that is one facet.
MirroredFacets::Outcome MirroredFacets::add(const std::vector<MirrorPlane>& planes, std::size_t& bad) {
  std::vector<MirrorPlane> more;
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = i + 1; j < planes.size(); ++j)
      if (planes[i].axis == planes[j].axis && joined_by_a_facet(planes[i], planes[j]))
        more.push_back({planes[i].axis, 2.0 * planes[i].place - planes[j].place});
  for (bad = 0; bad < planes.size(); ++bad)
    if (const Outcome outcome = add(planes[bad]); outcome != Outcome::done) return outcome;
  for (const MirrorPlane& plane : more) static_cast<void>(add(plane)); // an image of a plane
  return Outcome::done;
}

bool MirroredFacets::joined_by_a_facet(const MirrorPlane& a, const MirrorPlane& b) const {
  for (std::size_t f = 0; f < connectivity_.size(); f += static_cast<std::size_t>(corners_)) {
    bool on_a = false, on_b = false;
    for (std::size_t k = 0; k < static_cast<std::size_t>(corners_); ++k) {
      const double x = place(connectivity_[f + k], a.axis);
      on_a = on_a || std::abs(x - a.place) <= tolerance_;
      on_b = on_b || std::abs(x - b.place) <= tolerance_;
    }
    if (on_a && on_b) return true;
  }
  return false;
}

MirroredFacets::Outcome MirroredFacets::add(const MirrorPlane& plane) {
  const double tolerance = tolerance_;
  double low = 0.0, high = 0.0; // beyond the plane on either side
  bool touches = false;
  for (const std::int64_t node : connectivity_) {
    const double distance = place(node, plane.axis) - plane.place;
    low = std::min(low, distance), high = std::max(high, distance);
    touches = touches || std::abs(distance) <= tolerance;
  }
  if (!touches) return Outcome::no_node;
  if (low < -tolerance && high > tolerance) return Outcome::both_sides;
  std::map<std::int64_t, std::int64_t> image_of;
  const auto reflect = [&](std::int64_t node) {
    const auto [found, is_new] = image_of.emplace(node, node);
    if (is_new && std::abs(place(node, plane.axis) - plane.place) > tolerance) {
      Image made = node < nodes_ ? Image{node} : image(node);
      double& shift = made.shift[static_cast<std::size_t>(plane.axis)];
      made.reflected ^= 1 << plane.axis;
      shift = 2.0 * plane.place - shift;
      images_.push_back(made);
      found->second = all_nodes() - 1;
    }
    return found->second;
  };
  // In the opposite order of nodes: the image faces the same way.
  const std::size_t size = connectivity_.size(), m = static_cast<std::size_t>(corners_);
  for (std::size_t f = 0; f < size; f += m)
    for (std::size_t k = m; k-- > 0;) connectivity_.push_back(reflect(connectivity_[f + k]));
  return Outcome::done;
}

void MirroredFacets::fold(Smoothed& surface) const {
  Smoothed out;
  out.add_nodes(nodes_);
  out.reflected.assign(out.nodes.size(), 0);
  out.shifts.assign(static_cast<std::size_t>(nodes_ * dimension_), 0.0);
  const auto at = [](std::int64_t i) { return static_cast<std::size_t>(i); };
  const std::size_t m = facets_ > 0 ? surface.segment_points.size() / at(all_facets()) : 0;
  std::vector<std::int64_t> number(at(surface.points()), -1);
  for (std::int64_t i = 0; i < nodes_; ++i) number[at(i)] = i;
  for (std::size_t i = 0; i < m * at(facets_); ++i) {
    std::int64_t& point = number[at(surface.segment_points[i])];
    if (point < 0) {
      std::map<std::pair<std::int64_t, std::int32_t>, double> sum; // of a node and of its image
      std::array<double, 3> shift{};
      for (std::int64_t j = surface.begin[at(surface.segment_points[i])];
           j < surface.begin[at(surface.segment_points[i] + 1)]; ++j) {
        const std::int64_t node = surface.nodes[at(j)];
        const Image from = node < nodes_ ? Image{node} : image(node);
        sum[{from.node, from.reflected}] += surface.weights[at(j)];
        for (std::size_t k = 0; k < 3; ++k) shift[k] += surface.weights[at(j)] * from.shift[k];
      }
      Terms terms;
      for (const auto& [from, weight] : sum)
        if (weight != 0.0) {
          terms.push_back({from.first, weight});
          out.reflected.push_back(from.second);
        }
      point = out.add_point(terms);
      out.shifts.insert(out.shifts.end(), shift.begin(), shift.begin() + dimension_);
    }
    out.segment_points.push_back(point);
  }
  surface = std::move(out);
}

} // namespace ents
