// SPDX-License-Identifier: BSD-3-Clause
#include "master.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "both_sides.hpp"
#include "mesh_size.hpp"
#include "slave_points.hpp"
#include "smoothing.hpp"

namespace host {
namespace {

constexpr double border_width = 0.25; // in natural coordinates: an eighth of a segment's length

std::string where(const Scene& scene) { return scene.contact->model_where; }

void check_sizes(const Scene& scene, const EntsModel& model, std::size_t nodes, const std::string& place) {
  const ents_layout& layout = model.layout();
  if (layout.dimension != scene.dimension)
    throw InputError(where(scene) + "/segment: a segment of dimension " + std::to_string(layout.dimension) +
                     " in a scene of dimension " + std::to_string(scene.dimension));
  if (nodes != static_cast<std::size_t>(layout.nodes))
    throw InputError(place + ": the model's segment has " + std::to_string(layout.nodes) +
                     " nodes, here are " + std::to_string(nodes));
}

bool has_triangles(const Json& model) {
  return model.contains("segment") && model.at("segment").is_string() &&
         is_triangle(model.at("segment").get<std::string>());
}

} // namespace

bool Master::covers(const double* xi) const {
  if (triangles) return xi[0] >= 0 && xi[1] >= 0 && xi[0] + xi[1] <= 1;
  return std::all_of(xi, xi + model->layout().parameters, [](double x) { return std::abs(x) <= 1; });
}

Master scene_master(const EntsLibrary& library, const Scene& scene, const Mesh& mesh) {
  const ContactSpec& contact = *scene.contact;
  Master master;
  master.model =
      std::make_unique<EntsModel>(library, contact.model.dump(), scene.file.parent_path(), where(scene));
  if (contact.model.contains("height") && !contact.model.at("height").is_null()) {
    Json base = contact.model;
    base["height"] = nullptr;
    if (contact.gap_only) {
      Json& law = base["contact"];
      if (!law.contains("offset")) law["offset"] = 0; // where the elements read those of the profile
      master.profile = std::move(master.model);
      master.model =
          std::make_unique<EntsModel>(library, base.dump(), scene.file.parent_path(), where(scene));
    }
    for (const char* key : {"contact", "parameters"}) base.erase(key);
    if (!contact.gap_only)
      master.base = std::make_unique<EntsModel>(library, base.dump(), scene.file.parent_path(), where(scene));
  }
  master.triangles = has_triangles(contact.model);
  master.rigid = !contact.rigid.empty() || contact.body;
  const auto d = static_cast<std::size_t>(scene.dimension);
  if (contact.body) {
    const std::string place = scene.file.string() + ": /contact/master/rigid_body";
    const RigidBodySpec& body = *contact.body;
    const auto m = static_cast<std::size_t>(master.model->layout().nodes);
    check_sizes(scene, *master.model, m, place);
    if (body.connectivity.size() % m != 0 || master.model->layout().multipliers > 0)
      throw InputError(place + (master.model->layout().multipliers > 0
                                    ? ": a body that turns has no multipliers as unknowns; take \"augmented\""
                                    : "/segments: the model's segment has " + std::to_string(m) + " nodes"));
    master.positions = body.positions, master.connectivity = body.connectivity;
    master.surface_coordinates = body.surface_coordinates;
    master.reference = body.reference;
    master.body_node = mesh.node_count() - 2; // the last two: Simulation::build_mesh
    return master;
  }
  if (master.rigid) {
    check_sizes(scene, *master.model, contact.rigid.size() / d,
                scene.file.string() + ": /contact/master/nodes");
    master.positions = contact.rigid;
    master.connectivity.resize(contact.rigid.size() / d);
    std::iota(master.connectivity.begin(), master.connectivity.end(), 0);
    master.direction = contact.direction;
    return master;
  }
  const auto found = mesh.face_sets.find(contact.master);
  if (found == mesh.face_sets.end() || found->second.empty())
    throw InputError(contact.master_where + ": no faces \"" + contact.master + "\" in the mesh");
  if (const std::string segment = contact.model.value("segment", ""); is_smoothed(segment)) {
    check_sizes(scene, *master.model, static_cast<std::size_t>(master.model->layout().nodes),
                contact.master_where);
    SmoothedSurface surface = smoothed_surface(library, segment, mesh, found->second, contact);
    master.connectivity = std::move(surface.connectivity);
    master.net = std::move(surface.net);
  } else {
    if (contact.ends != "repeated" || !contact.mirror.empty())
      throw InputError(contact.master_where +
                       ": \"ends\" and \"mirror\" are for smoothed segments; the model's " + "segment is " +
                       segment);
    const std::vector<Face> faces = contact.two_pass ? slave_faces(mesh, contact) : found->second;
    const std::size_t count = count_of_nodes(faces);
    check_sizes(scene, *master.model, count, contact.master_where);
    master.connectivity = connectivity_of(faces, count);
  }
  const std::vector<double> points = master.net ? master.net->positions(mesh.coordinates) : mesh.coordinates;
  master.surface_coordinates =
      surface_coordinates(contact.coordinates, scene.dimension, points, master.connectivity,
                          static_cast<std::size_t>(master.model->layout().nodes));
  return master;
}

Master explicit_master(const EntsLibrary& library, const Scene& scene, int divisions) {
  const ContactSpec& contact = *scene.contact;
  if (contact.rigid.empty())
    throw InputError(scene.file.string() + ": only a rigid master has an explicit mesh of plain segments");
  if (has_triangles(contact.model))
    throw InputError(where(scene) + "/segment: an explicit mesh is made of lines and quadrilaterals only");
  check_explicit_size(scene, divisions);
  for (const char* key : {"parameters", "wear"})
    if (contact.model.contains(key) ||
        (contact.model.contains("contact") && contact.model.at("contact").contains(key)))
      throw InputError(where(scene) + ": a model with \"" + key +
                       "\" changes over the steps, and has no explicit mesh of plain segments");
  const EntsModel enriched(library, contact.model.dump(), scene.file.parent_path(), where(scene));
  const auto d = static_cast<std::size_t>(scene.dimension);
  check_sizes(scene, enriched, contact.rigid.size() / d, scene.file.string() + ": /contact/master/nodes");

  const auto n = static_cast<std::size_t>(divisions), row = n + 1;
  SurfaceSample sample =
      sample_surface(enriched, contact.rigid, {}, even_grid(enriched.layout().parameters, n));

  Json model;
  model["segment"] = d == 2 ? "line2" : "quad4";
  model["height"] = nullptr;
  model["master"] = "rigid";
  model["border"] = border_width;
  model["contact"] = contact.model.contains("contact") ? contact.model.at("contact") : Json();
  if (contact.model.contains("penetration_limit"))
    model["penetration_limit"] = contact.model.at("penetration_limit");

  Master master;
  master.model = std::make_unique<EntsModel>(library, model.dump(), scene.file.parent_path(), where(scene));
  master.direction = contact.direction;
  master.positions = std::move(sample.point);
  for (std::size_t j = 0; j < (d == 2 ? 1 : n); ++j)
    for (std::size_t i = 0; i < n; ++i) {
      const auto first = static_cast<std::int64_t>(j * row + i),
                 above = first + static_cast<std::int64_t>(row);
      for (const std::int64_t node : {first, first + 1}) master.connectivity.push_back(node);
      if (d == 3)
        for (const std::int64_t node : {above + 1, above}) master.connectivity.push_back(node);
    }
  return master;
}

} // namespace host
