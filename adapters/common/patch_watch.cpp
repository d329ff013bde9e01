// SPDX-License-Identifier: BSD-3-Clause
#include "patch_watch.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <limits>
#include <mutex>
#include <numeric>
#include <unordered_map>

#include "patch_file.hpp"

namespace ents_adapter {
namespace {

using ents_deck::dot;
using ents_deck::Face;
using ents_deck::face_normal;
using ents_deck::FacetTree;
using ents_deck::length;
using ents_deck::minus;
using ents_deck::Point;
using std::string;
using Displacement = std::function<const double*(std::int64_t)>;

constexpr double border =
    0.05; ///< of a face: elements carry contact at least as far beyond their patch ("border" 0.1 of -1 .. 1)
constexpr double margin = 1.1; ///< of the slide that is proposed: bodies deform

/// A point over a face that its element does not have.
struct Over {
  double gap = 0, beyond = 0, wanted = 0; ///< [L] to that face; from the patch to it; slide that would do
};

/// An element that has been evaluated.
struct Seen {
  WatchedPair* pair = nullptr; ///< null: it is not in the file
  WatchedPoint* point = nullptr;
  bool beside = false, told = false;
  double depth = 0;
};

/// Nodes that the host has not told move as the nearest one of the same surface that it has.
void move_others(WatchedPair& pair) {
  for (const int side : {0, 1}) {
    std::vector<std::size_t> known;
    for (std::size_t i = 0; i < pair.nodes.size(); ++i)
      if (pair.noted[i] && pair.of_master[i] == side) known.push_back(i);
    if (known.empty()) continue;
    const auto& at = pair.undeformed.nodes;
    std::sort(known.begin(), known.end(),
              [&](std::size_t a, std::size_t b) { return at[a].x[0] < at[b].x[0]; });
    for (std::size_t i = 0; i < pair.nodes.size(); ++i) {
      if (pair.noted[i] || pair.of_master[i] != side) continue;
      const auto middle = std::lower_bound(known.begin(), known.end(), at[i].x[0],
                                           [&](std::size_t k, double x) { return at[k].x[0] < x; });
      std::size_t nearest = 0;
      double least = std::numeric_limits<double>::infinity();
      const auto look = [&](std::size_t k) { // false: all behind it are farther
        if (std::abs(at[k].x[0] - at[i].x[0]) >= least) return false;
        if (const double d = length(minus(at[k].x, at[i].x)); d < least) least = d, nearest = k;
        return true;
      };
      for (auto k = middle; k != known.end() && look(*k);) ++k;
      for (auto k = middle; k != known.begin() && look(*(k - 1));) --k;
      for (std::size_t j = 0; j < 3; ++j)
        pair.deformed.nodes[i].x[j] = at[i].x[j] + pair.deformed.nodes[nearest].x[j] - at[nearest].x[j];
    }
  }
}

/// @return false: it is above its patch, or beside the master
bool over_others(const WatchedPair& pair, const FacetTree& tree, const WatchedPoint& p, Over& out) {
  const Point x = place_of(pair.deformed, p);
  const Point normal = p.face.shape == ents_deck::Shape::none ? p.normal : face_normal(pair.deformed, p.face);
  const FacetTree::Closest under = tree.closest(x, normal);
  if (under.face < 0 || std::find(p.faces.begin(), p.faces.end(), under.face) != p.faces.end()) return false;
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

class Watch {
public:
  std::mutex mutex;
  std::vector<WatchedPair> pairs;
  std::unordered_map<std::int64_t, Seen> seen;
  string error;
  std::atomic<bool> no_file{false}; ///< it has been looked for, and `error` stays empty
  int most_beside = 0;              ///< of elements that are not in the file
  std::size_t told = 0;             ///< elements
  bool all_known = false;           ///< the host knows all nodes

  void read(const Host& host) {
    if (ready_) return;
    ready_ = true;
    try {
      pairs = read_patches(host.directory() + patch_file);
    } catch (const std::exception& what) {
      error = string(patch_file) + ": " + what.what() +
              "; write the job again with ents-deck, or remove the file";
    }
    no_file = pairs.empty() && error.empty();
    for (WatchedPair& pair : pairs)
      for (WatchedPoint& point : pair.points)
        if (point.element) listed_[point.element] = {&pair, &point};
  }

  Seen& at(std::int64_t element) {
    const auto [entry, is_new] = seen.try_emplace(element);
    if (is_new)
      if (const auto found = listed_.find(element); found != listed_.end())
        entry->second.pair = found->second.first, entry->second.point = found->second.second;
    return entry->second;
  }

  void move(WatchedPair& pair, const Displacement& displacement) {
    all_known = all_known || displacement != nullptr;
    for (std::size_t i = 0; displacement && i < pair.nodes.size(); ++i) {
      const double* u = displacement(pair.nodes[i]);
      for (std::size_t j = 0; j < 3; ++j) pair.deformed.nodes[i].x[j] = pair.undeformed.nodes[i].x[j] + u[j];
    }
    if (!displacement) move_others(pair);
  }

private:
  bool ready_ = false;
  std::unordered_map<std::int64_t, std::pair<WatchedPair*, WatchedPoint*>> listed_;
};

Watch& watch() {
  static Watch& one = *new Watch; // never freed: threads of the host may outlive static objects
  return one;
}

/// Where the element's nodes are.
void keep(const Element& e, WatchedPair& pair, WatchedPoint& p) {
  const std::size_t slaves = p.face.nodes.size();
  for (std::size_t i = 0; i < slaves + p.masters.size(); ++i) {
    const auto node = static_cast<std::size_t>(i < slaves ? p.face.nodes[i] : p.masters[i - slaves]);
    pair.noted[node] = 1;
    for (std::size_t j = 0; j < static_cast<std::size_t>(std::min(e.coordinates, 3)); ++j)
      pair.deformed.nodes[node].x[j] =
          pair.undeformed.nodes[node].x[j] + e.moved(static_cast<int>(j), static_cast<int>(i));
  }
  p.noted = true;
}

std::vector<Beside> compare(Watch& all, const Displacement& displacement) {
  std::vector<Beside> out;
  for (WatchedPair& pair : all.pairs) {
    all.move(pair, displacement);
    const FacetTree tree(pair.deformed, pair.faces);
    Beside found;
    found.slave = pair.slave, found.master = pair.master;
    found.points = static_cast<int>(pair.points.size());
    const bool any = all.all_known || std::any_of(pair.points.begin(), pair.points.end(),
                                                  [](const WatchedPoint& p) { return p.noted; });
    for (const WatchedPoint& p : pair.points) {
      Over where;
      if (!any || p.contact || (p.element && !p.noted && !all.all_known)) continue;
      if (!over_others(pair, tree, p, where)) continue;
      const bool is_lost = where.gap < pair.lowest - 1e-6 * std::abs(where.beyond);
      is_lost ? ++found.lost : ++found.open;
      found.deepest = std::max(found.deepest, pair.lowest - where.gap);
      found.beyond = std::max(found.beyond, where.beyond), found.slide = std::max(found.slide, where.wanted);
    }
    found.grows = found.open > pair.most_open;
    pair.most_open = std::max(pair.most_open, found.open);
    if (found.open + found.lost > 0) out.push_back(std::move(found));
  }
  return out;
}

/// Elements that the file does not have.
string unlisted_text(Watch& all, const Host& host) {
  int count = 0;
  double deepest = 0;
  std::int64_t first = std::numeric_limits<std::int64_t>::max();
  for (const auto& [number, element] : all.seen) {
    if (element.point || !element.beside) continue;
    ++count;
    deepest = std::max(deepest, element.depth), first = std::min(first, number);
  }
  if (count <= all.most_beside) return "";
  all.most_beside = count;
  char text[480];
  std::snprintf(
      text, sizeof text,
      "ents: %d slave points (element %lld ...) are open, lie beside their patches and up to %.4g below "
      "the surface that goes on there: if the master goes on, contact is not seen, write a wider "
      "\"patch\"; if it ends there, add 16 to %s3",
      count, static_cast<long long>(first), deepest, host.properties);
  return text;
}

IncrementEnd end(Watch& all, const Host& host) {
  IncrementEnd out;
  for (const Beside& found : compare(all, nullptr)) {
    if (found.open > 0 && found.grows) out.warnings.push_back("ents: " + found.open_text(""));
    if (found.lost > 0 && out.lost.empty()) out.lost = "ents: " + found.lost_text("");
  }
  if (string text = unlisted_text(all, host); !text.empty()) out.warnings.push_back(std::move(text));
  return out;
}

string with_advice(const char* text, double slide, const string& advice) {
  char number[40];
  std::snprintf(number, sizeof number, "%.4g", slide);
  return string(text) + ": run ents-deck with --slide " + number + advice;
}

} // namespace

string Beside::open_text(const string& advice) const {
  char text[400];
  std::snprintf(
      text, sizeof text,
      "pair %.80s, %.80s: %d of %d slave points are open and lie beside their patches, up to %.4g beyond; "
      "contact there is not seen",
      slave.c_str(), master.c_str(), open, points, beyond);
  return with_advice(text, slide, advice);
}

string Beside::lost_text(const string& advice) const {
  char text[400];
  std::snprintf(
      text, sizeof text,
      "pair %.80s, %.80s: %d slave points are pressed into the master beside their patches, up to %.4g "
      "deep, without a force",
      slave.c_str(), master.c_str(), lost, deepest);
  return with_advice(text, slide, advice);
}

string note(const Element& e, bool has_patch, int slave_nodes, bool contact, bool beside, double depth) {
  Watch& all = watch();
  if (!has_patch && all.no_file) return {}; // without a lock
  const std::lock_guard lock(all.mutex);
  all.read(*e.host);
  Seen& seen = all.at(e.number);
  if (!e.history_end) return all.error; // an evaluation beside the path of the job
  seen.beside = beside, seen.depth = depth;
  if (!seen.point) return all.error;
  if (slave_nodes != static_cast<int>(seen.point->face.nodes.size()) ||
      e.nodes < slave_nodes + static_cast<int>(seen.point->masters.size())) {
    if (all.error.empty())
      all.error = string(patch_file) + ": element " + std::to_string(e.number) +
                  " has other nodes than the deck's; write the job again with ents-deck, or remove the file";
    return all.error;
  }
  seen.point->contact = contact;
  keep(e, *seen.pair, *seen.point);
  return all.error;
}

std::vector<Beside> compare_patches(const Host& host, const Displacement& displacement) {
  Watch& all = watch();
  const std::lock_guard lock(all.mutex);
  all.read(host);
  return compare(all, displacement);
}

bool is_beside(const Host& host, std::int64_t element, const Displacement& displacement, Beside& out) {
  Watch& all = watch();
  const std::lock_guard lock(all.mutex);
  all.read(host);
  const Seen seen = all.at(element);
  if (!seen.point) return false;
  all.move(*seen.pair, displacement);
  const FacetTree tree(seen.pair->deformed, seen.pair->faces);
  Over where;
  if (!over_others(*seen.pair, tree, *seen.point, where)) return false;
  out.slave = seen.pair->slave, out.master = seen.pair->master;
  out.open = 1, out.points = static_cast<int>(seen.pair->points.size()), out.beyond = where.beyond;
  // An iterate may lie anywhere: no more than two faces farther than before.
  out.slide =
      std::min(where.wanted, seen.pair->slide + 2 * size_of(seen.pair->undeformed, seen.pair->faces[0]));
  return true;
}

IncrementEnd increment_end(const Host& host) {
  Watch& all = watch();
  const std::lock_guard lock(all.mutex);
  return end(all, host);
}

IncrementEnd element_converged(const Host& host, std::int64_t element) {
  Watch& all = watch();
  const std::lock_guard lock(all.mutex);
  const auto own = all.seen.find(element);
  if (own == all.seen.end()) return {};
  const auto forget = [&] {
    for (auto& [number, seen] : all.seen) seen.told = false;
    all.told = 0;
  };
  // The host has evaluated this element for a second increment, and others not at all since the first: the
  // host no longer has those, and the first increment has ended.
  IncrementEnd out;
  if (own->second.told) out = end(all, host), forget();
  own->second.told = true;
  if (++all.told < all.seen.size()) return out;
  forget();
  return end(all, host);
}

} // namespace ents_adapter
