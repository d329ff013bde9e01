// SPDX-License-Identifier: BSD-3-Clause
#include "patch_watch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include <nlohmann/json.hpp>

#include "../deck/facet_tree.hpp"
#include "stiffness_store.hpp"

namespace ccx {
namespace {

using ents_deck::dot;
using ents_deck::Face;
using ents_deck::face_normal;
using ents_deck::FacetTree;
using ents_deck::length;
using ents_deck::minus;
using ents_deck::Point;
using std::string;

constexpr const char* input_file = "ents_patches.json";
constexpr const char* output_file = "ents_slide.txt";
constexpr double border =
    0.05; ///< of a face: elements carry contact at least as far beyond their patch ("border" 0.1 of -1 .. 1)
constexpr double margin = 1.1; ///< of the slide that is proposed: bodies deform

struct WatchedPoint {
  int element = 0; ///< 0: it has none
  Face face;       ///< of the slave, indices into `nodes`; a node alone has no shape
  std::vector<double> weights;
  Point normal{};         ///< of the undeformed slave
  std::vector<int> faces; ///< of the patch
  Point under{};          ///< below it on the undeformed master
  double beside = 0;      ///< [L] how far beside the master it begins
};

struct Pair {
  string slave, master;
  double slide = 0, lowest = 0;
  std::vector<Face> faces; ///< of the master, indices into `nodes`
  std::vector<WatchedPoint> points;
  ents_deck::Mesh undeformed, deformed;
  std::vector<int> nodes; ///< ccx's numbers
  std::unique_ptr<FacetTree> tree;
  int found_beside = 0; ///< points, largest number of an increment
};

/// A point over a face that its element does not have.
struct Beside {
  double gap = 0, beyond = 0, wanted = 0; ///< [L] to that face; from the patch to it; slide that would do
};

double size_of(const ents_deck::Mesh& mesh, const Face& face) {
  const double n = length(face_normal(mesh, face));
  return corner_count(face.shape) == 2 ? n : std::sqrt(corner_count(face.shape) == 3 ? n : n / 2);
}

class Watch {
public:
  std::mutex mutex;
  std::vector<Pair> pairs;
  std::unordered_map<int, std::pair<std::size_t, std::size_t>> by_element;
  std::unordered_map<int, bool> contact;
  int left_in_increment = 0;

  void read(const Configuration& now) {
    if (ready_) return;
    ready_ = true;
    std::ifstream stream(input_file, std::ios::binary);
    if (!stream) return; // a job that ents-deck has not written
    try {
      const auto all = nlohmann::json::parse(stream);
      for (const auto& json : all.at("pairs")) add(json, now);
    } catch (const std::exception& error) {
      stop("U1E", (string(input_file) + ": " + error.what() +
                   "; write the job again with ents-deck, or remove the file")
                      .c_str());
    }
    out_.open(output_file, std::ios::binary);
    out_ << "# step increment kind points beyond slide pair: open slave points beside their patches (open), "
            "in contact "
            "before (left), pressed into the master (lost)\n"
         << std::flush;
  }

  void move(Pair& pair, const Configuration& now) const {
    for (std::size_t i = 0; i < pair.nodes.size(); ++i)
      for (std::size_t j = 0; j < 3; ++j)
        pair.deformed.nodes[i].x[j] =
            pair.undeformed.nodes[i].x[j] + now.v[static_cast<std::ptrdiff_t>(now.mt) * (pair.nodes[i] - 1) +
                                                  static_cast<std::ptrdiff_t>(j) + 1];
  }

  /// @return false: it is above its patch, or beside the master
  bool beside(const Pair& pair, const FacetTree& tree, const WatchedPoint& p, Beside& out) const {
    const Point x = place(pair.deformed, p);
    const Point normal =
        p.face.shape == ents_deck::Shape::none ? p.normal : face_normal(pair.deformed, p.face);
    const FacetTree::Closest under = tree.closest(x, normal);
    if (under.face < 0 || std::find(p.faces.begin(), p.faces.end(), under.face) != p.faces.end())
      return false;
    const Face& face = pair.faces[static_cast<std::size_t>(under.face)];
    const Point n = face_normal(pair.deformed, face), away = minus(x, under.point);
    const double size = size_of(pair.deformed, face), n_length = length(n);
    if (dot(n, normal) > -0.1 * n_length * length(normal)) return false; // a side of the master
    out.gap = dot(away, n) / n_length;
    if (std::sqrt(std::max(dot(away, away) - out.gap * out.gap, 0.0)) > 0.1 * size) return false;
    out.beyond = p.faces.empty() ? size : 1e300;
    for (const int f : p.faces) out.beyond = std::min(out.beyond, tree.distance(under.point, f));
    out.wanted = margin * std::max(p.beside, pair.tree->distance(p.under, under.face));
    return out.beyond > border * size;
  }

  void write(int step, int increment, const char* kind, int points, double beyond, double slide,
             const Pair& pair) {
    out_ << step << ' ' << increment << ' ' << kind << ' ' << points << ' ' << beyond << ' ' << slide << ' '
         << pair.slave << ", " << pair.master << '\n'
         << std::flush;
  }

private:
  bool ready_ = false;
  std::ofstream out_;

  static Point place(const ents_deck::Mesh& mesh, const WatchedPoint& p) {
    Point x{};
    for (std::size_t i = 0; i < p.weights.size(); ++i)
      for (std::size_t j = 0; j < 3; ++j)
        x[j] += p.weights[i] * mesh.nodes[static_cast<std::size_t>(p.face.nodes[i])].x[j];
    return x;
  }

  static ents_deck::Shape shape_of(const string& name) {
    using ents_deck::Shape;
    for (const Shape shape :
         {Shape::line2, Shape::line3, Shape::tri3, Shape::tri6, Shape::quad4, Shape::quad8})
      if (name == ents_deck::segment_name(shape)) return shape;
    throw std::runtime_error("unknown face '" + name + "'");
  }

  void add(const nlohmann::json& json, const Configuration& now) {
    Pair pair;
    pair.slave = json.at("slave").get<string>(), pair.master = json.at("master").get<string>();
    pair.slide = json.at("slide").get<double>(), pair.lowest = json.at("lowest").get<double>();
    std::unordered_map<int, int> index;
    const auto nodes_of = [&](const nlohmann::json& list) {
      std::vector<int> out;
      for (const auto& id : list) {
        const auto [entry, is_new] = index.emplace(id.get<int>(), static_cast<int>(pair.nodes.size()));
        if (is_new) pair.nodes.push_back(entry->first);
        out.push_back(entry->second);
      }
      return out;
    };
    for (const auto& face : json.at("faces"))
      pair.faces.push_back({0, 0, shape_of(face.at(0).get<string>()), nodes_of(face.at(1))});
    for (const auto& point : json.at("points")) {
      WatchedPoint p;
      p.element = point.at("element").get<int>();
      p.face.nodes = nodes_of(point.at("nodes"));
      p.face.shape =
          face_of(p.face.nodes.size(), !pair.faces.empty() && corner_count(pair.faces[0].shape) == 2);
      p.weights = point.at("weights").get<std::vector<double>>();
      p.normal = point.at("normal").get<Point>();
      p.faces = point.at("faces").get<std::vector<int>>();
      pair.points.push_back(std::move(p));
    }
    for (const int node : pair.nodes) {
      ents_deck::Node at;
      for (std::size_t j = 0; j < 3; ++j)
        at.x[j] = now.co[3 * static_cast<std::ptrdiff_t>(node - 1) + static_cast<std::ptrdiff_t>(j)];
      pair.undeformed.nodes.push_back(at);
    }
    pair.deformed.nodes = pair.undeformed.nodes;
    pair.tree = std::make_unique<FacetTree>(pair.undeformed, pair.faces);
    for (WatchedPoint& p : pair.points) {
      const Point x = place(pair.undeformed, p);
      const FacetTree::Closest under = pair.tree->closest(x, p.normal);
      if (under.face < 0) continue;
      const Point n = face_normal(pair.undeformed, pair.faces[static_cast<std::size_t>(under.face)]);
      const Point away = minus(x, under.point);
      const double ahead = dot(away, n) / length(n);
      p.under = under.point;
      p.beside = p.element ? 0 : std::sqrt(std::max(dot(away, away) - ahead * ahead, 0.0));
    }
    for (std::size_t i = 0; i < pair.points.size(); ++i)
      if (pair.points[i].element) by_element[pair.points[i].element] = {pairs.size(), i};
    pairs.push_back(std::move(pair));
  }

  /// The slave's face that a point with so many nodes lies in.
  static ents_deck::Shape face_of(std::size_t nodes, bool plane) {
    using ents_deck::Shape;
    switch (nodes) {
    case 2:
      return Shape::line2;
    case 3:
      return plane ? Shape::line3 : Shape::tri3;
    case 4:
      return Shape::quad4;
    case 6:
      return Shape::tri6;
    case 8:
      return Shape::quad8;
    default:
      return Shape::none;
    }
  }
};

Watch& watch() {
  static Watch& one = *new Watch; // never freed: threads of the host may outlive static objects
  return one;
}

string advice(double slide) {
  char text[160];
  std::snprintf(text, sizeof text, "run ents-deck with --slide %.4g, or let \"ents-deck run\" do so", slide);
  return text;
}

} // namespace

void note_contact(int element, bool contact) {
  const std::lock_guard lock(watch().mutex);
  watch().contact[element] = contact;
}

void note_left(int element, const Configuration& now) {
  constexpr int most = 20; // of an increment: each builds a tree
  Watch& all = watch();
  const std::lock_guard lock(all.mutex);
  all.read(now);
  const auto found = all.by_element.find(element);
  if (found == all.by_element.end() || all.left_in_increment++ >= most) return;
  Pair& pair = all.pairs[found->second.first];
  all.move(pair, now);
  const FacetTree tree(pair.deformed, pair.faces);
  Beside where;
  if (!all.beside(pair, tree, pair.points[found->second.second], where)) return;
  // An iterate may lie anywhere: no more than two faces farther than before.
  const double most_slide = pair.slide + 2 * size_of(pair.undeformed, pair.faces[0]);
  all.write(0, 0, "left", 1, where.beyond, std::min(where.wanted, most_slide), pair);
}

void check_patches(const Configuration& now, int step, int increment) {
  Watch& all = watch();
  const std::lock_guard lock(all.mutex);
  all.read(now);
  all.left_in_increment = 0;
  string lost_text;
  for (Pair& pair : all.pairs) {
    all.move(pair, now);
    const FacetTree tree(pair.deformed, pair.faces);
    int open = 0, lost = 0;
    double beyond = 0, wanted = 0, deepest = 0;
    for (const WatchedPoint& p : pair.points) {
      Beside where;
      if ((p.element && all.contact[p.element]) || !all.beside(pair, tree, p, where)) continue;
      const bool is_lost = where.gap < pair.lowest - 1e-6 * std::abs(where.beyond);
      is_lost ? ++lost : ++open;
      deepest = std::max(deepest, pair.lowest - where.gap);
      beyond = std::max(beyond, where.beyond), wanted = std::max(wanted, where.wanted);
    }
    if (open > 0) {
      all.write(step, increment, "open", open, beyond, wanted, pair);
      if (open > pair.found_beside) // as it grows; the file has every increment
        std::printf(" *WARNING in U1E: pair %s, %s: %d of %zu slave points are open and lie beside their "
                    "patches, up to "
                    "%.4g beyond; contact there is not seen: %s\n",
                    pair.slave.c_str(), pair.master.c_str(), open, pair.points.size(), beyond,
                    advice(wanted).c_str());
      pair.found_beside = std::max(pair.found_beside, open);
    }
    if (lost == 0) continue;
    all.write(step, increment, "lost", lost, beyond, wanted, pair);
    char text[400];
    std::snprintf(text, sizeof text,
                  "pair %.80s, %.80s: %d slave points are pressed into the master beside their patches, up "
                  "to %.4g deep, "
                  "without a force: %s",
                  pair.slave.c_str(), pair.master.c_str(), lost, deepest, advice(wanted).c_str());
    if (lost_text.empty()) lost_text = text;
  }
  if (!lost_text.empty()) stop("U1E", lost_text.c_str());
}

} // namespace ccx
