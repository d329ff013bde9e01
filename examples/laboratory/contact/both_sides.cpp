// SPDX-License-Identifier: BSD-3-Clause
// Each point of surfaces that are slave and master carries with half its area, for each pressing pair of places is seen
// from both.
#include "both_sides.hpp"

#include <set>

#include "contact_sides.hpp"
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

LeftOut left_out_of(const ContactSpec& spec, const ContactSides& sides) {
  LeftOut out;
  const SlavePoints& points = sides.points;
  const std::vector<Face>& faces = sides.cut.faces;
  const std::size_t each = points.are_nodes() ? 1 : points.size() / faces.size();
  if (is_one_surface(spec)) {
    for (std::size_t k = 0; k < points.size(); ++k)
      if (points.are_nodes())
        out.node.push_back(points.nodes[k]);
      else
        out.segment.push_back(stride(k / each));
    return out;
  }
  const std::size_t of_slave = sides.bodies->face_sets.at(spec.slave).size();
  for (std::size_t s = 0; s < faces.size(); ++s) out.segment_side.push_back(s < of_slave ? 0 : 1);
  std::set<int> nodes;
  for (std::size_t s = 0; s < of_slave; ++s)
    for (int a = 0; a < faces[s].count; ++a)
      nodes.insert(sides.dofs->representative(faces[s].nodes[static_cast<std::size_t>(a)]));
  for (std::size_t k = 0; k < points.size(); ++k)
    out.side.push_back(points.are_nodes() ? (nodes.count(points.nodes[k]) != 0 ? 0 : 1)
                                          : out.segment_side[k / each]);
  return out;
}

} // namespace host
