// SPDX-License-Identifier: BSD-3-Clause
#include "smoothing.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "toolbox/error.hpp"

namespace host {
namespace {

/// Faces of one surface as the library takes them, which grow by their mirror images.
class MirroredFaces {
public:
  MirroredFaces(const Mesh& mesh, const std::vector<Face>& faces, std::size_t corners, ControlNet& net)
      : mesh_(mesh), corners_(corners), net_(net) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    for (const Face& face : faces)
      for (std::size_t k = 0; k < corners; ++k) {
        connectivity.push_back(face.nodes[k]);
        for (std::size_t i = 0; i < d; ++i)
          size_ = std::max(size_, std::abs(mesh.node(face.nodes[k])[i] - mesh.node(faces[0].nodes[0])[i]));
      }
  }

  void mirror(const MirrorPlane& plane) {
    const auto axis = static_cast<std::size_t>(plane.axis);
    const double tolerance = 1e-9 * size_;
    double low = 0, high = 0; // beyond the plane on either side
    std::map<std::int64_t, std::int64_t> image_of;
    bool touches = false;
    for (const std::int64_t node : connectivity) {
      if (image_of.count(node) != 0) continue;
      const double distance = place(node, axis) - plane.place;
      low = std::min(low, distance), high = std::max(high, distance);
      const bool on_plane = std::abs(distance) <= tolerance;
      touches = touches || on_plane;
      if (on_plane)
        net_.held.push_back(
            static_cast<std::size_t>(net_.origin(node)) * static_cast<std::size_t>(mesh_.dimension) + axis);
      image_of[node] = on_plane ? node : new_image(node, axis, plane.place);
    }
    if (!touches || (low < -tolerance && high > tolerance))
      throw InputError(plane.where + ": the master's faces " +
                       (touches ? "lie on both sides of this plane" : "have no node on this plane") +
                       "; a plane of symmetry is one of their borders");
    // In the opposite order of nodes: the image faces the same way.
    std::vector<std::int64_t> images;
    for (std::size_t f = 0; f < connectivity.size(); f += corners_)
      for (std::size_t k = corners_; k-- > 0;) images.push_back(image_of.at(connectivity[f + k]));
    connectivity.insert(connectivity.end(), images.begin(), images.end());
  }

  std::vector<std::int64_t> connectivity; ///< [faces, images][corners]

private:
  double place(std::int64_t node, std::size_t axis) const {
    const double x = mesh_.node(static_cast<int>(net_.origin(node)))[axis];
    return node < net_.mesh_nodes
               ? x
               : net_.sign(node, axis) * x +
                     net_.images[static_cast<std::size_t>(node - net_.mesh_nodes)].offset[axis];
  }
  std::int64_t new_image(std::int64_t node, std::size_t axis, double plane) {
    ControlNet::Image image;
    if (node < net_.mesh_nodes)
      image.node = static_cast<int>(node);
    else
      image = net_.images[static_cast<std::size_t>(node - net_.mesh_nodes)];
    image.sign[axis] = -image.sign[axis];
    image.offset[axis] = 2 * plane - image.offset[axis];
    net_.images.push_back(image);
    return net_.all_nodes() - 1;
  }

  const Mesh& mesh_;
  std::size_t corners_;
  ControlNet& net_;
  double size_ = 0;
};

} // namespace

SmoothedSurface smoothed_surface(const EntsLibrary& library, const std::string& segment, const Mesh& mesh,
                                 const std::vector<Face>& faces, const ContactSpec& contact) {
  const std::string& where = contact.master_where;
  const bool line = segment.ends_with("4"), triangle = segment == "bezier15";
  const int corners = line ? 2 : triangle ? 3 : 4;
  const char* facet = line ? "line2" : triangle ? "tri3" : "quad4";
  for (const Face& face : faces)
    if (face.count != corners)
      throw InputError(where + ": the model's segment " + segment + " lies on faces of " +
                       std::to_string(corners) + " nodes, here is one of " + std::to_string(face.count));
  auto net = std::make_unique<ControlNet>();
  net->dimension = mesh.dimension;
  net->mesh_nodes = mesh.node_count();
  MirroredFaces all(mesh, faces, static_cast<std::size_t>(corners), *net);
  for (const MirrorPlane& plane : contact.mirror) all.mirror(plane);

  const int32_t ends = contact.ends == "repeated"      ? ENTS_ENDS_REPEATED
                       : contact.ends == "straight"    ? ENTS_ENDS_STRAIGHT
                       : contact.ends == "quasi_cubic" ? ENTS_ENDS_QUASI_CUBIC
                                                       : ENTS_ENDS_QUASI_PARABOLIC;
  const auto count = static_cast<int64_t>(all.connectivity.size()) / corners;
  const auto m = static_cast<std::size_t>(line ? 4 : triangle ? 15 : 16);
  auto report = ents_struct<ents_report>();
  const auto check = [&](int32_t status) {
    if (status != ENTS_OK) throw InputError(where + ": " + describe(library, status, report));
  };
  int64_t points = 0, terms = 0;
  check(library.smooth_size(facet, segment.c_str(), ends, count, all.connectivity.data(), net->all_nodes(),
                            &points, &terms, &report));
  std::vector<int64_t> segment_points(static_cast<std::size_t>(count) * m),
      begin(static_cast<std::size_t>(points + 1)), nodes(static_cast<std::size_t>(terms));
  std::vector<double> weights(nodes.size());
  check(library.smooth(facet, segment.c_str(), ends, count, all.connectivity.data(), net->all_nodes(), points,
                       terms, segment_points.data(), begin.data(), nodes.data(), weights.data(), &report));

  // Of the points those that the faces themselves need.
  segment_points.resize(faces.size() * m);
  SmoothedSurface result;
  std::map<int64_t, int64_t> number;
  net->begin.push_back(0);
  bool are_nodes = true;
  for (const int64_t point : segment_points) {
    const auto [found, is_new] = number.emplace(point, net->points());
    if (is_new) {
      const auto first = begin[static_cast<std::size_t>(point)],
                 last = begin[static_cast<std::size_t>(point) + 1];
      net->nodes.insert(net->nodes.end(), nodes.begin() + first, nodes.begin() + last);
      net->weights.insert(net->weights.end(), weights.begin() + first, weights.begin() + last);
      net->begin.push_back(static_cast<int64_t>(net->nodes.size()));
      are_nodes = are_nodes && last == first + 1 && nodes[static_cast<std::size_t>(first)] < net->mesh_nodes;
    }
    result.connectivity.push_back(found->second);
  }
  if (are_nodes)
    for (int64_t& point : result.connectivity) point = net->nodes[static_cast<std::size_t>(point)];
  else
    result.net = std::move(net);
  return result;
}

} // namespace host
