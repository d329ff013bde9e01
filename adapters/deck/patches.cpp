// SPDX-License-Identifier: BSD-3-Clause
#include "patches.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <set>
#include <unordered_map>

#include "facet_tree.hpp"

namespace ents_deck {
namespace {

using Edge = std::pair<int, int>;

/// The master surface with its neighbourhoods.
class Neighbours {
public:
  explicit Neighbours(const std::vector<Face>& faces) : faces_(faces) {
    for (int f = 0; f < static_cast<int>(faces.size()); ++f)
      for (const int node : face(f).nodes) of_node_[node].push_back(f);
  }

  const Face& face(int f) const { return faces_[static_cast<std::size_t>(f)]; }

  std::vector<int> around(int f) const { // without f, ascending
    std::set<int> out;
    const int corners = corner_count(face(f).shape);
    for (int i = 0; i < corners; ++i)
      for (const int other : of_node_.at(face(f).nodes[static_cast<std::size_t>(i)])) out.insert(other);
    out.erase(f);
    return {out.begin(), out.end()};
  }

private:
  const std::vector<Face>& faces_;
  std::unordered_map<int, std::vector<int>> of_node_;
};

std::set<int> nodes_with(const Neighbours& all, std::set<int> nodes, int face) {
  nodes.insert(all.face(face).nodes.begin(), all.face(face).nodes.end());
  return nodes;
}

/// Nodes of a face, beginning with corner `first`.
std::vector<int> turned(const Face& face, std::size_t first) {
  const auto corners = static_cast<std::size_t>(corner_count(face.shape));
  std::vector<int> out(face.nodes.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::size_t block = i / corners * corners;
    out[i] = face.nodes[block + (i - block + first) % corners];
  }
  return out;
}

/// The patch's faces one after the other over their common edges, their nodes numbered as they come.
struct Walk {
  Patch patch;
  std::map<int, int> number;

  void add(int f, const std::vector<int>& nodes) {
    std::vector<int> local;
    for (const int node : nodes) {
      const auto [entry, is_new] = number.emplace(node, static_cast<int>(patch.nodes.size()));
      if (is_new) patch.nodes.push_back(node);
      local.push_back(entry->second);
    }
    patch.topology.push_back(std::move(local));
    patch.faces.push_back(f);
  }
};

Walk plain_walk(const Neighbours& all, const std::vector<int>& faces) {
  Walk out;
  for (const int f : faces) out.add(f, all.face(f).nodes);
  return out;
}

Walk walk(const Neighbours& all, const std::vector<int>& faces, int seed, std::size_t first) {
  std::map<Edge, int> owner; // directed edge of corners -> face
  for (const int f : faces) {
    const auto corners = static_cast<std::size_t>(corner_count(all.face(f).shape));
    for (std::size_t i = 0; i < corners; ++i)
      owner[{all.face(f).nodes[i], all.face(f).nodes[(i + 1) % corners]}] = f;
  }
  const auto corner_of = [&](int f, int node) {
    const auto& nodes = all.face(f).nodes;
    return static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), node) - nodes.begin());
  };
  Walk out;
  std::set<int> left(faces.begin(), faces.end());
  std::deque<std::pair<int, std::size_t>> queue{{seed, first}};
  while (!left.empty()) {
    if (queue.empty()) { // faces that touch the others in a node alone
      const int f = *left.begin();
      queue.emplace_back(f, 0);
    }
    const auto [f, corner] = queue.front();
    queue.pop_front();
    if (left.erase(f) == 0) continue;
    const std::vector<int> nodes = turned(all.face(f), corner);
    out.add(f, nodes);
    const auto corners = static_cast<std::size_t>(corner_count(all.face(f).shape));
    for (std::size_t i = 0; i < corners; ++i) {
      const auto next = owner.find({nodes[(i + 1) % corners], nodes[i]});
      if (next != owner.end() && left.count(next->second) != 0)
        queue.emplace_back(next->second, corner_of(next->second, next->first.first));
    }
  }
  return out;
}

/// Lines one after the other along the surface, so that the model depends on how many they are alone.
std::vector<int> chained(const Neighbours& all, std::vector<int> faces) {
  std::map<int, int> by_begin;
  std::set<int> ends;
  for (const int f : faces) by_begin[all.face(f).nodes[0]] = f, ends.insert(all.face(f).nodes[1]);
  std::vector<int> out;
  const auto follow = [&](int f) {
    while (by_begin.erase(all.face(f).nodes[0]) != 0) {
      out.push_back(f);
      const auto next = by_begin.find(all.face(f).nodes[1]);
      if (next == by_begin.end()) return;
      f = next->second;
    }
  };
  for (const int f : faces)
    if (ends.count(all.face(f).nodes[0]) == 0) follow(f);
  while (!by_begin.empty()) follow(by_begin.begin()->second);
  return out;
}

Patch numbered(const Neighbours& all, std::vector<int> faces, int seed, bool turn) {
  std::sort(faces.begin(), faces.end());
  const auto corners = static_cast<std::size_t>(corner_count(all.face(seed).shape));
  if (corners == 2) return plain_walk(all, chained(all, faces)).patch;
  if (!turn) return plain_walk(all, faces).patch;
  Walk best = walk(all, faces, seed, 0);
  for (std::size_t first = 1; first < corners; ++first) {
    Walk other = walk(all, faces, seed, first);
    if (other.patch.topology < best.patch.topology) best = std::move(other);
  }
  return best.patch;
}

std::set<int> nodes_of(const Neighbours& all, const std::set<int>& faces) {
  std::set<int> out;
  for (const int f : faces) out = nodes_with(all, std::move(out), f);
  return out;
}

/// All faces within a distance, over common nodes.
std::set<int> within(const FacetTree& tree, const Neighbours& all, const FacetTree::Closest& under,
                     double distance) {
  std::set<int> chosen{under.face};
  std::deque<int> queue{under.face};
  while (!queue.empty()) {
    const int f = queue.front();
    queue.pop_front();
    for (const int other : all.around(f)) {
      if (chosen.count(other) != 0 || tree.distance(under.point, other) > distance) continue;
      chosen.insert(other);
      queue.push_back(other);
    }
  }
  return chosen;
}

/// The one direction that all of the driven motion has along the surface, as long as the slide; absent: there are
/// several, or none is known. Where a point leaves it all the same, the adapter says so.
std::optional<Point> straight_path(const PatchRequest& request, const Point& normal, double slide) {
  if (request.any_direction > 0) return {};
  std::optional<Point> out;
  const double whole = length(request.motion);
  for (std::size_t j = 0; j < 3; ++j) {
    Point along{};
    along[j] = request.motion[j];
    const double off = dot(along, normal);
    for (std::size_t k = 0; k < 3; ++k) along[k] -= off * normal[k];
    if (length(along) <= 1e-3 * whole) continue;
    if (out) return {};
    out = along;
  }
  if (out)
    for (double& component : *out) component *= slide / std::sqrt(dot(*out, *out));
  return out;
}

/// Faces that a point meets on a straight way, there and back, and those nearer to it than `width`.
std::set<int> along(const FacetTree& tree, const Neighbours& all, const FacetTree::Closest& under,
                    const Point& path, double width) {
  std::set<int> chosen{under.face};
  std::deque<int> queue{under.face};
  const int steps = 200;
  const auto nearest = [&](int face) {
    double out = std::numeric_limits<double>::infinity();
    for (int i = -steps; i <= steps; ++i) {
      Point x = under.point;
      for (std::size_t k = 0; k < 3; ++k) x[k] += path[k] * i / steps;
      out = std::min(out, tree.distance(x, face));
    }
    return out;
  };
  while (!queue.empty()) {
    const int f = queue.front();
    queue.pop_front();
    for (const int other : all.around(f)) {
      if (chosen.count(other) != 0 || nearest(other) > width) continue;
      chosen.insert(other);
      queue.push_back(other);
    }
  }
  return chosen;
}

/// Can faces of these shapes be segments of one element? A triangle is a quad4 with two nodes in one.
bool go_together(Shape a, Shape b) {
  const auto has_corners_only = [](Shape s) { return s == Shape::tri3 || s == Shape::quad4; };
  return a == b || (has_corners_only(a) && has_corners_only(b));
}

/// The shape of a patch's segments; triangles among quadrilaterals become such.
void set_shape(const Neighbours& all, Patch& patch) {
  patch.shape = all.face(patch.faces[0]).shape;
  for (const int f : patch.faces)
    if (all.face(f).shape != patch.shape) patch.shape = Shape::quad4;
  for (auto& segment : patch.topology)
    if (patch.shape == Shape::quad4 && segment.size() == 3) segment.push_back(segment.back());
}

double slide_of(const PatchRequest& request, const Point& normal) {
  if (request.slide) return *request.slide;
  double sum = 0;
  for (std::size_t j = 0; j < 3; ++j)
    sum += request.motion[j] * request.motion[j] * (1 - normal[j] * normal[j]);
  return std::max(std::sqrt(std::max(sum, 0.0)) + request.any_direction, request.least);
}

[[noreturn]] void refuse_many(const Mesh& mesh, const Side& master, const PatchRequest& request,
                              const SlavePoint& node, double slide, std::size_t faces, std::size_t nodes) {
  const std::string largest = std::to_string(request.largest - static_cast<int>(node.nodes.size()));
  mesh.source.fail(master.place, label_of(mesh, node) + " slides by up to " + shown(slide) +
                                     ": the faces of '" + master.name + "' within that distance are " +
                                     std::to_string(faces) + " with " + std::to_string(nodes) +
                                     " nodes, and an element may have " + largest +
                                     " master nodes. A coarser master with a height instead of its mesh "
                                     "has fewer, --points 0 leaves " +
                                     std::to_string(request.largest - 1) +
                                     " of them, or write a smaller --slide if the job slides less");
}

/// The ring around the chosen faces, nearest first, as far as it fits: bodies deform.
void add_ring(const FacetTree& tree, const Neighbours& all, const FacetTree::Closest& under, int largest,
              std::set<int>& chosen, std::set<int>& nodes) {
  std::vector<std::pair<double, int>> ring;
  for (const int f : std::set<int>(chosen))
    for (const int other : all.around(f))
      if (chosen.count(other) == 0) ring.emplace_back(tree.distance(under.point, other), other);
  std::sort(ring.begin(), ring.end());
  for (const auto& [distance, f] : ring) {
    if (chosen.count(f) != 0) continue;
    if (!go_together(all.face(f).shape, all.face(under.face).shape)) continue;
    std::set<int> with = nodes_with(all, nodes, f);
    if (static_cast<int>(with.size()) > largest) continue;
    nodes = std::move(with);
    chosen.insert(f);
  }
}

} // namespace

Patches patches_of(const Mesh& mesh, const std::vector<SlavePoint>& slave, const Side& master,
                   const PatchRequest& request) {
  const FacetTree tree(mesh, master.faces);
  const Neighbours all(master.faces);
  Patches out;
  out.reserve = std::numeric_limits<double>::infinity();
  for (int i = 0; i < static_cast<int>(slave.size()); ++i) {
    const SlavePoint& node = slave[static_cast<std::size_t>(i)];
    const Point& normal = node.normal;
    const int largest = request.largest - static_cast<int>(node.nodes.size());
    const FacetTree::Closest under = tree.closest(node.x, normal);
    const double slide = slide_of(request, normal);
    if (under.face < 0) {
      ++out.left_out;
      continue;
    }
    const Point n = face_normal(mesh, master.faces[static_cast<std::size_t>(under.face)]);
    const double size = std::sqrt(length(n)), tolerance = 1e-6 * size; // 2D: the square root of a length
    const double face_size =
        corner_count(master.faces[static_cast<std::size_t>(under.face)].shape) == 2 ? length(n) : size;
    const Point away = minus(node.x, under.point);
    const double ahead = dot(away, n) / length(n);
    const double beside = std::sqrt(std::max(dot(away, away) - ahead * ahead, 0.0));
    int touching = 0;
    for (const int f : all.around(under.face)) touching += tree.distance(under.point, f) <= tolerance;
    if (beside > std::max(slide, 0.1 * face_size) && touching == 0) {
      ++out.left_out;
      continue;
    }
    out.slide = std::max(out.slide, slide);

    // Without a slide to speak of the face below is enough: at a peak many faces are equally near.
    std::set<int> chosen{under.face};
    if (slide > 0.05 * face_size) chosen = within(tree, all, under, slide + tolerance);
    std::set<int> nodes = nodes_of(all, chosen);
    if (static_cast<int>(nodes.size()) > largest)
      if (const auto path = straight_path(request, normal, slide)) {
        chosen = along(tree, all, under, *path, 0.1 * face_size);
        nodes = nodes_of(all, chosen);
        ++out.narrow;
      }
    if (static_cast<int>(nodes.size()) > largest)
      refuse_many(mesh, master, request, node, slide, chosen.size(), nodes.size());
    add_ring(tree, all, under, largest, chosen, nodes);
    for (const int f : chosen) {
      if (!go_together(all.face(f).shape, all.face(under.face).shape))
        mesh.source.fail(master.place, "'" + master.name + "' has faces of several shapes (" +
                                           segment_name(all.face(f).shape) + ", " +
                                           segment_name(all.face(under.face).shape) +
                                           ") within the slide of " + label_of(mesh, node) +
                                           "; one element has segments of one shape, or tri3 and quad4: "
                                           "write a smaller --slide, or take elements of first order there");
      for (const int other : all.around(f))
        if (chosen.count(other) == 0) out.reserve = std::min(out.reserve, tree.distance(under.point, other));
    }
    out.widest = std::max(out.widest, static_cast<int>(nodes.size() + node.nodes.size()));
    Patch patch = numbered(all, {chosen.begin(), chosen.end()}, under.face, request.turn);
    set_shape(all, patch);
    patch.slave = i;
    patch.face = under.face;
    out.list.push_back(std::move(patch));
  }
  return out;
}

} // namespace ents_deck
