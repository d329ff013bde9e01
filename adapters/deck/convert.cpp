// SPDX-License-Identifier: BSD-3-Clause
#include "convert.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>

#include <ents.h>

#include "facet_tree.hpp"
#include "library.hpp"
#include "point_counts.hpp"
#include "surface_coordinates.hpp"

namespace ents_deck {
namespace {

using nlohmann::ordered_json;
using std::string;

/// CalculiX has room for 20 nodes in an element, the adapters for 33.
int largest_element(Program program) { return program == Program::calculix ? 20 : 33; }

constexpr double default_border = 0.1; ///< natural coordinates: nodes on the border of the master stay on it

ordered_json model_file(const std::filesystem::path& path) {
  if (path.empty()) return ordered_json::object();
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw Error("the model " + path.string() + " cannot be read");
  try {
    ordered_json out = ordered_json::parse(stream);
    if (!out.is_object()) throw Error("the model " + path.string() + " is not a JSON object");
    return out;
  } catch (const nlohmann::json::exception& error) {
    throw Error("the model " + path.string() + ": " + error.what());
  }
}

/// Height maps name their files from the folder of the model: here, from the working folder of the job.
void resolve_files(ordered_json& node, const std::filesystem::path& folder) {
  if (node.is_object()) {
    if (node.contains("file") && node["file"].is_string()) {
      const std::filesystem::path file = node["file"].get<string>();
      if (file.is_relative())
        node["file"] = std::filesystem::absolute(folder / file).lexically_normal().string();
    }
    for (auto& [key, value] : node.items()) resolve_files(value, folder);
  } else if (node.is_array()) {
    for (auto& value : node) resolve_files(value, folder);
  }
}

std::vector<ContactPair> wanted_pairs(const Mesh& mesh, const Options& options) {
  std::vector<ContactPair> all = contact_pairs(mesh);
  if (options.pairs.empty()) {
    if (all.empty())
      throw Error(mesh.source.files[0].name +
                  ": there is no *CONTACT PAIR; name two surfaces or sets with --pair SLAVE,MASTER");
    return all;
  }
  std::vector<ContactPair> out;
  for (const auto& [slave, master] : options.pairs) {
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&, s = canonical(slave), m = canonical(master)](const ContactPair& p) {
                                      return canonical(p.slave) == s && canonical(p.master) == m;
                                    });
    if (found == all.end()) {
      const bool turned = std::any_of(all.begin(), all.end(), [&](const ContactPair& p) {
        return canonical(p.slave) == canonical(master) && canonical(p.master) == canonical(slave);
      });
      if (turned)
        throw Error("--pair " + slave + "," + master + ": in the deck '" + master +
                    "' is the slave; write --pair " + master + "," + slave);
    }
    out.push_back(found != all.end() ? *found : ContactPair{slave, master, "", nullptr, {0, 1}, {}});
  }
  return out;
}

void check_kinds(const Mesh& mesh, const Side& side, Program program) {
  for (const Face& face : side.faces) {
    const auto type = static_cast<std::size_t>(mesh.elements[static_cast<std::size_t>(face.element)].type);
    if (mesh.kind(face.element) == Kind::shell &&
        !mesh.types[type].name.starts_with("R3D")) // rigid: no thickness
      mesh.source.fail(side.place, "'" + side.name +
                                       "' has faces of shells: their contact surface is half a thickness "
                                       "away from their nodes, which a contact element does not know");
    const string& name = mesh.types[type].name;
    if (name.find('P', std::min(name.find_first_of("0123456789"), name.size())) != string::npos)
      mesh.source.fail(side.place,
                       "'" + side.name + "' has faces of " + name +
                           ", whose pore pressure goes through the contact in the program itself, "
                           "which a contact element does not know; leave the pair to the program");
    if (program == Program::calculix &&
        mesh.nodes[static_cast<std::size_t>(face.nodes[0])].instance != no_instance)
      mesh.source.fail(side.place, "ccx has no *PART and *INSTANCE; this deck is Abaqus's: --for abaqus");
  }
}

double mean_size(const Mesh& mesh, const Side& side) {
  double sum = 0;
  for (const Face& face : side.faces) {
    const double n = length(face_normal(mesh, face));
    sum += corner_count(face.shape) == 2 ? n : std::sqrt(corner_count(face.shape) == 3 ? n / 2 : n / 2);
  }
  return side.faces.empty() ? 0 : sum / static_cast<double>(side.faces.size());
}

ordered_json raised(ordered_json height, double rise) {
  const ordered_json constant{{"type", "constant"}, {"value", rise}};
  return height.is_null() ? constant : ordered_json{{"type", "sum"}, {"of", {height, constant}}};
}

/// ADJUST=: nodes nearer to the master than that are put on it, as the programs do before they begin.
void adjust(Mesh& mesh, Contact& contact, std::vector<Move>& moves) {
  if (!contact.pair.adjust) return;
  const auto set = mesh.node_sets.find(canonical(contact.pair.statement->value("ADJUST")));
  std::set<int> named;
  if (set != mesh.node_sets.end()) named.insert(set->second.begin(), set->second.end());
  const FacetTree tree(mesh, contact.master.faces);
  const std::vector<Point> normals = node_normals(mesh, contact.slave);
  int moved = 0;
  double farthest = 0;
  for (std::size_t i = 0; i < contact.slave.nodes.size(); ++i) {
    Node& node = mesh.nodes[static_cast<std::size_t>(contact.slave.nodes[i])];
    const FacetTree::Closest under = tree.closest(node.x, normals[i]);
    if (under.face < 0) continue;
    const Face& face = contact.master.faces[static_cast<std::size_t>(under.face)];
    Point n = face_normal(mesh, face);
    const double size = length(n), scale = corner_count(face.shape) == 2 ? size : std::sqrt(size);
    for (double& c : n) c /= size;
    const double gap = dot(minus(node.x, under.point), n);
    const bool ahead = under.distance - std::abs(gap) <= 0.1 * scale;
    const bool wanted = set != mesh.node_sets.end() ? named.count(contact.slave.nodes[i]) != 0
                                                    : ahead && gap <= *contact.pair.adjust;
    if (!wanted || std::abs(gap) <= 1e-9 * scale) continue;
    for (std::size_t j = 0; j < 3; ++j) node.x[j] -= gap * n[j];
    moves.push_back({contact.slave.nodes[i], node.x});
    ++moved;
    farthest = std::max(farthest, std::abs(gap));
  }
  if (moved == 0) return;
  char text[160];
  std::snprintf(text, sizeof text,
                "ADJUST: %d nodes are put on the master in their *NODE lines, the farthest by %.4g", moved,
                farthest);
  contact.remarks.push_back(text);
}

/// Bodies that share nodes: a slave node that is a node of the master needs no contact with it. In ccx a point in a
/// face may have a node of its own patch, whose forces are added up.
void share_nodes(const Mesh& mesh, Contact& contact, Program program) {
  const std::set<int> master(contact.master.nodes.begin(), contact.master.nodes.end());
  const auto shared = [&](int node) { return master.count(node) != 0; };
  const auto first = std::find_if(contact.slave.nodes.begin(), contact.slave.nodes.end(), shared);
  if (first == contact.slave.nodes.end()) return;
  if (program == Program::abaqus)
    mesh.source.fail(
        contact.pair.line,
        "node " + mesh.node_label(*first) +
            " belongs to slave and master, and a user element of Abaqus cannot have a node twice; give one "
            "body a node of its own there (*TIE), or leave the faces at that node out of the slave surface");
  std::erase_if(contact.points,
                [&](const SlavePoint& point) { return point.nodes.size() == 1 && shared(point.nodes[0]); });
  contact.remarks.push_back(
      std::to_string(std::count_if(contact.slave.nodes.begin(), contact.slave.nodes.end(), shared)) +
      " nodes belong to slave and master");
}

/// Has one element triangles and quadrilaterals?
bool has_mixed_patch(const Contact& contact) {
  return std::any_of(contact.patches.list.begin(), contact.patches.list.end(), [&](const Patch& patch) {
    return std::any_of(patch.faces.begin(), patch.faces.end(), [&](int f) {
      return contact.master.faces[static_cast<std::size_t>(f)].shape != patch.shape;
    });
  });
}

/// The model of the pair: `base` with segment, law and border of the deck. The law's rise and remarks go into `out`.
void complete_model(const Mesh& mesh, const Options& options, const ordered_json& base, Contact& out) {
  Bodies bodies = bodies_of(mesh);
  bodies.face_size = mean_size(mesh, out.master);
  out.model = base;
  const string segment = segment_name(out.master.faces[0].shape);
  if (out.model.contains("segment") && out.model["segment"] != segment)
    throw Error("the model says \"segment\": " + out.model["segment"].dump() + ", the faces of '" +
                out.pair.master + "' are " + segment + ": leave the key out");
  for (const char* key : {"patch", "surface_coordinates"})
    if (out.model.contains(key))
      throw Error(string("the model has \"") + key + "\", which follows from the deck" +
                  (key[0] == 's' ? " (--coordinates)" : "") + ": leave the key out");
  out.model["segment"] = segment;
  if (!out.model.contains("contact")) {
    Law law = law_of(mesh, out.pair, bodies, options.program, options.stiffness);
    out.model["contact"] = std::move(law.contact);
    out.remarks.insert(out.remarks.end(), law.remarks.begin(), law.remarks.end());
    out.rise = law.clearance;
  } else if (options.stiffness) {
    throw Error("--stiffness and \"contact\" of the model contradict each other: leave one out");
  }
  if (!out.model.contains("border")) out.model["border"] = default_border;
}

/// What the patches have to cover.
PatchRequest request_of(const Mesh& mesh, const Options& options, bool height, Contact& out) {
  PatchRequest request;
  const Motion motion = prescribed_motion(mesh);
  request.motion = motion.range;
  request.any_direction = motion.any_direction;
  if (!options.slide) out.remarks.insert(out.remarks.end(), motion.remarks.begin(), motion.remarks.end());
  if (motion.rotates && !options.slide)
    out.remarks.push_back("the deck prescribes rotations, which the slide does not count: write --slide");
  request.slide = options.slide;
  if (const auto known = options.slides.find(out.pair.slave + ", " + out.pair.master);
      known != options.slides.end())
    request.least = known->second;
  request.largest = largest_element(options.program);
  request.turn = !height || !options.coordinates.empty();
  return request;
}

void find_patches(const Mesh& mesh, const Options& options, const PatchRequest& request, Contact& out) {
  for (std::vector<int> counts = point_counts(mesh, out, options, out.remarks);;) {
    out.points = counts.empty() ? slave_nodes(mesh, out.slave, out.master, options.program, out.remarks)
                                : points_in_faces(mesh, out.slave, counts, options.program);
    share_nodes(mesh, out, options.program);
    try {
      out.patches = patches_of(mesh, out.points, out.master, request);
      break;
    } catch (const Error&) { // points near the edge of their face need more faces than those near its middle
      if (options.points || std::all_of(counts.begin(), counts.end(), [](int n) { return n <= 2; })) throw;
      counts.assign(counts.size(), 2);
      out.remarks.push_back(
          "2 points per direction in each face: more of them need more master nodes than an element may "
          "have; stresses where meshes do not match are less exact (--points)");
    }
  }
  if (out.patches.narrow > 0)
    out.remarks.push_back(
        std::to_string(out.patches.narrow) +
        " slave points have the faces along their straight way alone: all within the slide are too "
        "many for an element");
  if (out.patches.list.empty())
    mesh.source.fail(out.slave.place, "no node of '" + out.pair.slave + "' lies ahead of '" +
                                          out.pair.master + "', nor within its slide of it");
}

/// One pair: sides, law, patches.
Contact prepare(Mesh& mesh, const ContactPair& pair, const Options& options, const ordered_json& base,
                std::vector<Move>& moves) {
  Contact out;
  out.remarks = check_pair(mesh, pair, options.program);
  out.pair = pair;
  out.slave = side_of(mesh, pair.slave, pair.line);
  out.master = side_of(mesh, pair.master, pair.line);
  check_elements_stay(mesh, out.slave);
  check_elements_stay(mesh, out.master);
  check_kinds(mesh, out.slave, options.program);
  check_kinds(mesh, out.master, options.program);
  if (out.master.faces.empty())
    mesh.source.fail(out.master.place, "the master '" + pair.master + "' has no faces of a body");

  adjust(mesh, out, moves);
  complete_model(mesh, options, base, out);
  const bool height = out.model.contains("height") && !out.model["height"].is_null();
  const PatchRequest request = request_of(mesh, options, height, out);
  const ordered_json& law = out.model["contact"];
  out.plane_coordinates =
      !height && options.coordinates.empty() && law.contains("friction") && !law["friction"].is_null();
  find_patches(mesh, options, request, out);
  if (height && options.coordinates.empty() && out.master.faces.size() > 1)
    out.remarks.push_back(
        "the height repeats on every face of the master (s = xi); --coordinates spreads it over the surface");
  if (height && options.coordinates.empty() && has_mixed_patch(out))
    mesh.source.fail(out.master.place, "'" + pair.master +
                                           "' has triangles and quadrilaterals in one element, over which a "
                                           "height needs surface coordinates: write --coordinates");
  if (!options.coordinates.empty())
    out.face_coordinates =
        coordinates_of_faces(mesh, out.master, options.coordinates, options.coordinate_file);
  return out;
}

/// What rounding leaves of a gap of zero, in parts of a face's size: decks are written with as few as seven
/// digits.
constexpr double touch_share = 1e-6, rise_share = 1e-9;

/// A body that only contact holds, and that begins on the master, would be loose in the first iteration where
/// its elements are open: rounding may leave a gap above 0, and laws with multipliers and tables are open at
/// 0, too. The master is raised until the nodes on it are in contact.
void raise_master(const Mesh& mesh, Contact& contact) {
  const double size = mean_size(mesh, contact.master);
  contact.touch = touch_share * size;
  const Findings found = findings_of(mesh, contact, contact.touch);
  if (found.touching == 0 || contact.rise > contact.touch)
    return; // a clearance of the law closes them already
  contact.rise = found.widest_touch + rise_share * size;
  char text[200];
  std::snprintf(
      text, sizeof text,
      "%d points lie on the master; it is raised by %.3g, so that they begin in contact and nothing is loose",
      found.touching, contact.rise);
  contact.remarks.push_back(text);
}

} // namespace

int dimension_of(const Side& master) { return corner_count(master.faces.at(0).shape) == 2 ? 2 : 3; }

Job convert(const Options& options) {
  Job job;
  Source source = read_source(options.deck);
  const std::vector<string> remarks = check_keywords(source, options.program);
  job.mesh = read_mesh(std::move(source));
  ordered_json base = model_file(options.model);
  resolve_files(base, options.model.parent_path());
  std::map<string, int> by_text;
  for (const ContactPair& pair : wanted_pairs(job.mesh, options)) {
    Contact contact = prepare(job.mesh, pair, options, base, job.moves);
    contact.first_element = job.elements.size();
    raise_master(job.mesh, contact);
    const auto parameters = static_cast<std::size_t>(dimension_of(contact.master) - 1);
    for (const Patch& patch : contact.patches.list) {
      ContactElement element;
      element.slave = contact.points[static_cast<std::size_t>(patch.slave)];
      element.masters = patch.nodes;
      if (!contact.face_coordinates.empty())
        element.surface_coordinates = coordinates_of_patch(contact.master, patch, contact.face_coordinates,
                                                           parameters, options.coordinates);
      else if (contact.plane_coordinates)
        element.surface_coordinates = plane_coordinates(job.mesh, contact.master, patch);
      ordered_json text = contact.model;
      text["segment"] = segment_name(patch.shape);
      if (patch.topology.size() > 1 || patch.topology[0].size() != patch.nodes.size())
        text["patch"] = patch.topology;
      if (contact.rise > 0)
        text["height"] = raised(contact.model.value("height", ordered_json()), contact.rise);
      const auto [entry, is_new] = by_text.emplace(text.dump() + std::to_string(element.slave.nodes.size()),
                                                   static_cast<int>(job.models.size()));
      if (is_new)
        job.models.push_back(checked_model(std::move(text),
                                           options.first_model + static_cast<int>(job.models.size()),
                                           static_cast<int>(element.slave.nodes.size())));
      element.model = entry->second;
      job.elements.push_back(std::move(element));
    }
    job.coordinates_in_elements =
        job.coordinates_in_elements || !job.elements.back().surface_coordinates.empty();
    contact.element_count = job.elements.size() - contact.first_element;
    job.contacts.push_back(std::move(contact));
  }
  auto& first = job.contacts.at(0).remarks;
  first.insert(first.end(), remarks.begin(), remarks.end());
  return job;
}

} // namespace ents_deck
