// SPDX-License-Identifier: BSD-3-Clause
// Contact, once: slave points, segments of the master, tree and states.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "contact.hpp"

namespace host {
namespace {

/// Nodes of the largest face: among quadrilaterals a triangle has its last node twice.
std::size_t corners(const std::vector<Face>& faces) {
  int most = 0;
  for (const Face& face : faces) most = std::max(most, face.count);
  return static_cast<std::size_t>(most);
}
const char* facet_name(std::size_t nodes, int dimension) {
  return nodes == 2 ? "line2" : nodes == 4 ? "quad4" : dimension == 2 ? "line3" : "tri3";
}

/// What the library refuses while the scene is set up, with the place in the scene.
template <class Ask> auto asked(const std::string& where, Ask ask) {
  try {
    return ask();
  } catch (const ents::Error& error) {
    throw InputError(where + ": " + error.what());
  }
}

ents::Model read_model(const Scene& scene) {
  const ContactInput& contact = *scene.contact;
  const std::string folder = scene.file.parent_path().string();
  ents::Model model = asked(contact.model_where, [&] { return ents::Model(contact.model.dump(), folder); });
  const ents_layout& layout = model.layout();
  if (layout.dimension != scene.dimension)
    throw InputError(contact.model_where + "/segment: a segment of dimension " +
                     std::to_string(layout.dimension) + " in a scene of dimension " +
                     std::to_string(scene.dimension));
  if (layout.multipliers > 0 || layout.augmentable || layout.fields > 0 || layout.worn >= 0)
    throw NeedsLaboratory(contact.model_where +
                          ": multipliers, wear and fields are solved by the laboratory");
  return model;
}

} // namespace

std::vector<double> node_areas(const Mesh& mesh, const std::vector<Face>& faces, const ElementSetup& setup,
                               const std::string& where) {
  const std::size_t count = corners(faces);
  const std::vector<std::int64_t> connectivity = connectivity_of(faces, count);
  std::vector<double> areas(static_cast<std::size_t>(mesh.node_count()));
  asked(where, [&] {
    ents::require(ents::linked(), ents_tributary_areas, facet_name(count, mesh.dimension),
                  ssize_of(faces.size()), connectivity.data(), mesh.node_count(), mesh.coordinates.data(),
                  setup.depth(), areas.data());
  });
  return areas;
}

Contact::Contact(const Scene& scene, const Mesh& mesh)
    : bodies_(&mesh), d_(static_cast<std::size_t>(scene.dimension)), model_(read_model(scene)),
      rigid_(!scene.contact->rigid.empty()), direction_(scene.contact->direction) {
  read_slaves(scene, mesh);
  read_master(scene, mesh);
  heat_ = model_.layout().heat != 0;
  temperature_ = scene.temperature, master_temperature_ = scene.contact->temperature;
  // Each dof of the mesh is a row of its own; temperatures stand behind all displacements.
  const auto nodes = static_cast<std::size_t>(mesh.node_count());
  for (std::size_t node = 0; node < nodes; ++node) {
    for (std::size_t i = 0; i < d_; ++i) rows_.push_back(ssize_of(node * d_ + i));
    if (heat_) rows_.push_back(ssize_of(nodes * d_ + node));
  }
  own_force_.assign(nodes * (d_ + (scene.heat ? 1 : 0)), 0.0);
  accepted_.segment.assign(points(), -1);
  accepted_.xi.assign(points() * (d_ - 1), 0.0);
  accepted_.flags.assign(points(), 0);
  states_ = ents::States(model_, ssize_of(points()));
  const Configuration begin{std::vector<double>(own_force_.size(), 0.0), 0, 0, 0};
  begin_increment(begin, 1);
  // Farther than any slave point is from the master: twice the diagonal of the box round both.
  double squared = 0;
  for (std::size_t i = 0; i < d_; ++i) {
    double low = slave_now_[i], high = low;
    for (const auto* all : {&slave_now_, &master_now_})
      for (std::size_t k = i; k < all->size(); k += d_)
        low = std::min(low, (*all)[k]), high = std::max(high, (*all)[k]);
    squared += (high - low) * (high - low);
  }
  reach_ = 2 * std::sqrt(squared);
  tree_ = asked(scene.contact->model_where, [&] { return ents::Tree(model_, this->mesh()); });
}

/// Slave points and their areas: the nodes with ents_tributary_areas, or ents_sampling_points.
void Contact::read_slaves(const Scene& scene, const Mesh& mesh) {
  const ContactInput& contact = *scene.contact;
  const std::vector<Face>& faces = named(mesh.face_sets, contact.slave, contact.slave_where, "faces");
  const std::size_t count = corners(faces);
  const std::vector<std::int64_t> connectivity = connectivity_of(faces, count);
  slave_nodes_ = nodes_of(faces);
  const ElementSetup& setup = scene.parts.front().setup;
  sampled_ = contact.sampling > 0;
  if (sampled_) {
    const auto n = static_cast<std::size_t>(contact.sampling), points = faces.size() * (d_ == 2 ? n : n * n);
    slave_.begin.resize(points + 1), slave_.nodes.resize(points * count),
        slave_.weights.resize(points * count);
    areas_.resize(points);
    asked(contact.slave_where, [&] {
      ents::require(ents::linked(), ents_sampling_points, facet_name(count, mesh.dimension), contact.sampling,
                    ssize_of(faces.size()), connectivity.data(), mesh.node_count(), mesh.coordinates.data(),
                    setup.depth(), slave_.begin.data(), slave_.nodes.data(), slave_.weights.data(),
                    areas_.data());
    });
    return;
  }
  const std::vector<double> all = node_areas(mesh, faces, setup, contact.slave_where);
  slave_.begin.push_back(0);
  for (const int node : slave_nodes_) { // a combination of one node
    slave_.nodes.push_back(node), slave_.weights.push_back(1);
    slave_.begin.push_back(ssize_of(slave_.nodes.size()));
    areas_.push_back(all[static_cast<std::size_t>(node)]);
  }
}

/// Segments of the master: one rigid segment, faces of the mesh, or the smoothed surface over them.
void Contact::read_master(const Scene& scene, const Mesh& mesh) {
  const ContactInput& contact = *scene.contact;
  const auto m = static_cast<std::size_t>(model_.layout().nodes);
  const auto check = [&](std::size_t nodes, const std::string& where) {
    if (nodes != m)
      throw InputError(where + ": the model's segment has " + std::to_string(m) + " nodes, here are " +
                       std::to_string(nodes));
  };
  if (rigid_) {
    fixed_ = contact.rigid;
    check(fixed_.size() / d_, scene.file.string() + ": /contact/master/nodes");
    connectivity_.resize(m);
    std::iota(connectivity_.begin(), connectivity_.end(), std::int64_t{0});
    return;
  }
  const std::vector<Face>& faces = named(mesh.face_sets, contact.master, contact.master_where, "faces");
  smoothed_ = is_smoothed(contact.model.value("segment", ""));
  if (smoothed_) {
    smooth(scene, faces);
  } else {
    check(corners(faces), contact.master_where);
    connectivity_ = connectivity_of(faces, m);
  }
  const Configuration undeformed{std::vector<double>(mesh.coordinates.size(), 0.0), 0, 0, 0};
  const std::vector<double> points = master_positions(undeformed);
  if (!contact.coordinate_axes.empty())
    for (const std::int64_t point : connectivity_)
      for (const int axis : contact.coordinate_axes)
        surface_coordinates_.push_back(
            points[static_cast<std::size_t>(point) * d_ + static_cast<std::size_t>(axis)]);
}

void Contact::smooth(const Scene& scene, const std::vector<Face>& faces) {
  const ContactInput& contact = *scene.contact;
  const std::string segment = contact.model.value("segment", "");
  const char* facet = segment.ends_with("4") ? "line2" : segment == "bezier15" ? "tri3" : "quad4";
  const std::size_t count = corners(faces);
  if (facet != std::string(facet_name(count, bodies_->dimension)))
    throw InputError(contact.master_where + ": segment " + segment + " lies on faces of type " + facet);
  const std::vector<std::int64_t> of_faces = connectivity_of(faces, count);
  const std::int64_t n = ssize_of(faces.size()), nodes = bodies_->node_count();
  std::int64_t points = 0, terms = 0;
  asked(contact.master_where, [&] {
    ents::require(ents::linked(), ents_smooth_size, facet, segment.c_str(), contact.ends, n, of_faces.data(),
                  nodes, &points, &terms);
    connectivity_.resize(faces.size() * static_cast<std::size_t>(model_.layout().nodes));
    net_.begin.resize(static_cast<std::size_t>(points) + 1);
    net_.nodes.resize(static_cast<std::size_t>(terms)), net_.weights.resize(static_cast<std::size_t>(terms));
    ents::require(ents::linked(), ents_smooth, facet, segment.c_str(), contact.ends, n, of_faces.data(),
                  nodes, points, terms, connectivity_.data(), net_.begin.data(), net_.nodes.data(),
                  net_.weights.data());
  });
}

} // namespace host
