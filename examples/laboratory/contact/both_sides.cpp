// SPDX-License-Identifier: BSD-3-Clause
// Contact: surfaces that are slave and master. Each point carries with half its area, for each pressing pair of places is
// seen from both.
#include "both_sides.hpp"

#include <set>

#include "contact.hpp"
#include "smoothing.hpp"

namespace host {
namespace {

const std::vector<Face>& faces_of(const Mesh& mesh, const std::string& name, const std::string& where) {
  const auto found = mesh.face_sets.find(name);
  if (found == mesh.face_sets.end() || found->second.empty())
    throw InputError(where + ": no faces \"" + name + "\" in the mesh");
  return found->second;
}

template <class T>
std::vector<T> some_of(const std::vector<T>& values, const std::vector<std::size_t>& places) {
  std::vector<T> some;
  for (const std::size_t k : places)
    if (!values.empty()) some.push_back(values[k]);
  return some;
}

} // namespace

LeftOut LeftOut::of(const std::vector<std::size_t>& slaves) const {
  LeftOut some;
  some.node = some_of(node, slaves), some.segment = some_of(segment, slaves);
  some.depth = some_of(depth, slaves), some.side = some_of(side, slaves);
  some.segment_side = segment_side;
  return some;
}

std::vector<Face> slave_faces(const Mesh& mesh, const ContactSpec& spec) {
  std::vector<Face> faces = faces_of(mesh, spec.slave, spec.slave_where);
  if (!spec.two_pass || is_one_surface(spec)) return faces;
  const std::vector<Face>& master = faces_of(mesh, spec.master, spec.master_where);
  const std::vector<int> nodes = nodes_of(faces);
  const std::set<int> of_slave(nodes.begin(), nodes.end());
  for (const int node : nodes_of(master))
    if (of_slave.count(node) != 0)
      throw InputError(spec.slave_where +
                       ": slave and master faces share nodes; two passes need sets that do not meet, and a "
                       "surface in contact with itself the same set as slave and as master");
  faces.insert(faces.end(), master.begin(), master.end());
  return faces;
}

void refuse_one_sided(const ContactSpec& spec) {
  const std::string what =
      spec.slave_where + (is_one_surface(spec) ? ": a surface in contact with itself: " : ": \"two_pass\": ");
  const auto law = find_json(spec.model, "/contact/normal/type");
  const std::string type = law.is_string() ? law.get<std::string>() : "";
  if (spec.master.empty()) throw InputError(what + "the master has to be faces of a body");
  if (spec.hard || type.find("augmented") != std::string::npos || type == "multiplier")
    throw InputError(what +
                     "two multipliers, one from each side, would hold one gap (over-constraint); give the "
                     "normal law \"penalty\"");
  if (spec.gap_only) throw InputError(what + "\"gap_only\" is for one slave and one master; leave it out");
  if (!find_json(spec.model, "/contact/wear").is_null())
    throw InputError(what + "each pass would see the wear of one side alone; leave \"wear\" out");
  if (!find_json(spec.model, "/projection").is_null())
    throw InputError(what + "one ray cannot light both sides; leave \"projection\" out");
  if (spec.cut > 0) throw InputError(what + "\"sampling\": \"cut\" needs one slave; give a number");
  const std::string segment = spec.model.value("segment", "");
  if (is_smoothed(segment)) throw InputError(what + "the segments have to be plain faces, not " + segment);
}

void Contact::read_both_sides(const ContactSpec& spec) {
  if (!has_both_sides(spec)) return;
  refuse_one_sided(spec);
  one_surface_ = is_one_surface(spec);
  for (double& area : points_.areas) area *= 0.5;
  const std::size_t each = points_.are_nodes() ? 1 : points_.size() / cut_.faces.size();
  if (one_surface_) {
    for (std::size_t k = 0; k < points_.size(); ++k)
      if (points_.are_nodes())
        left_out_.node.push_back(points_.nodes[k]);
      else
        left_out_.segment.push_back(stride(k / each));
    return;
  }
  const std::size_t of_slave = mesh_->face_sets.at(spec.slave).size();
  for (std::size_t s = 0; s < cut_.faces.size(); ++s) left_out_.segment_side.push_back(s < of_slave ? 0 : 1);
  std::set<int> nodes;
  for (std::size_t s = 0; s < of_slave; ++s)
    for (int a = 0; a < cut_.faces[s].count; ++a)
      nodes.insert(dofs_->representative(cut_.faces[s].nodes[static_cast<std::size_t>(a)]));
  for (std::size_t k = 0; k < points_.size(); ++k)
    left_out_.side.push_back(points_.are_nodes() ? (nodes.count(points_.nodes[k]) != 0 ? 0 : 1)
                                                 : left_out_.segment_side[k / each]);
}

void Contact::measure_thickness(const Configuration& begin) {
  if (!one_surface_) return;
  place(begin);
  slave_normals_ = slave_normals(begin);
  const ents_master_mesh where = mesh();
  detector_.move(where);
  thickness_below_.resize(points_.size(), 0.0);
  detector_.measure(where, slave_positions_, slave_normals_, left_out_, thickness_below_);
  left_out_.depth = thickness_below_;
  for (double& depth : left_out_.depth) depth *= 0.5;
}

} // namespace host
