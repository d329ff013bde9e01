// SPDX-License-Identifier: BSD-3-Clause
#include "contact_search.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "output/table.hpp"

namespace host {

ContactSearch::ContactSearch(ContactSides& sides, const ContactSpec& spec)
    : sides_(&sides), detector_(*sides.master.model), one_surface_(is_one_surface(spec)) {
  if (has_both_sides(spec)) {
    refuse_one_sided(spec);
    for (double& area : sides.points.areas) area *= 0.5;
    left_out_ = left_out_of(spec, sides);
  }
  refuse_self_contact(spec);
  // Without the height both sides of a sheet are equally far from every slave.
  has_two_sides_ = has_two_sides(spec);
  if (!has_two_sides_ && sides.master.base) base_detector_ = std::make_unique<Detector>(*sides.master.base);
}

void ContactSearch::refuse_self_contact(const ContactSpec& spec) const {
  const Master& master = sides_->master;
  if (master.rigid || has_both_sides(spec)) return;
  const std::set<std::int64_t> of_master =
      master.net ? master.net->nodes_of_mesh()
                 : std::set<std::int64_t>(master.connectivity.begin(), master.connectivity.end());
  for (const int node : sides_->points.nodes)
    if (of_master.count(node) != 0)
      throw InputError(spec.slave_where +
                       ": slave and master faces share nodes, and a node would find its own "
                       "segments; give the same set as slave and as master, for contact of a surface with "
                       "itself, or two sets that do not meet");
}

bool ContactSearch::has_two_sides(const ContactSpec& spec) const {
  const Master& master = sides_->master;
  const std::size_t d = sides_->d, m = sides_->m;
  std::map<std::vector<std::int64_t>, std::vector<std::int64_t>> of_nodes;
  for (std::size_t s = 0; s < master.segments(); ++s) {
    std::vector<std::int64_t> nodes(master.connectivity.begin() + stride(s * m),
                                    master.connectivity.begin() + stride((s + 1) * m));
    std::sort(nodes.begin(), nodes.end());
    of_nodes[std::move(nodes)].push_back(stride(s));
  }
  std::vector<double> nodes(m * d);
  const std::vector<double> centre(sides_->parameters, master.triangles ? 1. / 3 : 0.),
      xi = even_grid(static_cast<int>(sides_->parameters), 4, master.triangles);
  bool two_sides = false;
  for (const auto& [key, segments] : of_nodes)
    for (std::size_t i = 1; i < segments.size(); ++i) {
      // The segments of a smoothed ring of four have the same nodes, too, and lie side by side.
      const std::vector<double> first = sides_->sample(*master.model, segments[0], centre).base_point,
                                other = sides_->sample(*master.model, segments[i], centre).base_point;
      sides_->gather(segments[i], nodes);
      double apart = 0, size = 0;
      for (std::size_t c = 0; c < d; ++c) {
        apart = std::max(apart, std::abs(first[c] - other[c]));
        for (std::size_t a = 0; a < m; ++a) size = std::max(size, std::abs(nodes[a * d + c] - nodes[c]));
      }
      if (apart > 1e-9 * size) continue;
      two_sides = true;
      for (const double height : sides_->sample(*master.model, segments[i], xi).height)
        if (!(height > 0))
          throw InputError(spec.model_where +
                           ": two segments of the master have the same nodes, a sheet without "
                           "thickness, and on which side of it a slave is cannot be told; give "
                           "it a \"height\" above 0: half its thickness");
    }
  return two_sides;
}

void ContactSearch::look(const Configuration& at) {
  normals_ = has_two_sides_ ? std::vector<double>() : sides_->slave_normals(at);
}

void ContactSearch::begin_increment(const Configuration& begin) {
  if (!one_surface_) return;
  sides_->place(begin);
  look(begin);
  const ents_master_mesh where = sides_->mesh();
  detector_.move(where);
  thickness.resize(sides_->points.size(), 0.0);
  detector_.measure(where, sides_->slave_now, normals_, left_out_, thickness);
  left_out_.depth = thickness;
  for (double& depth : left_out_.depth) depth *= 0.5;
}

void ContactSearch::find(const Configuration& at, const std::vector<char>& closed, bool only_lost,
                         const Projections& begun, const std::vector<double>& pressure, Projections& found) {
  look(at);
  const ents_master_mesh where = sides_->mesh();
  const bool moved = !sides_->master.rigid || !detector_.is_placed() || seen_ != sides_->surface_changes();
  seen_ = sides_->surface_changes();
  if (moved) detector_.move(where);
  if (moved && base_detector_) base_detector_->move(where);
  for (std::size_t k = 0; k < sides_->points.size(); ++k)
    if (closed[k] == 0 || (!only_lost && !sides_->master.covers(found.xi.data() + k * sides_->parameters)))
      found.segment[k] = -1;
  if (one_surface_)
    left_out_.slave_begin = sides_->slave_begin.data(),
    left_out_.positions_begin = sides_->master_begin.data();
  if (base_detector_) find_straight(where, found);
  Lost lost = detector_.find(where, sides_->slave_now, normals_, left_out_, found);
  if (lost.slave < 0) lost = find_lost_since_begin(where, begun, pressure, found);
  describe_lost(lost, at);
}

// A search on a rough surface takes long, and finds points that are closer somewhere else, or two that
// are equally close. The one straight ahead of the node is near its projection on the segment without the height.
void ContactSearch::find_straight(const ents_master_mesh& where, Projections& found) const {
  Projections straight = found;
  base_detector_->find(where, sides_->slave_now, normals_, left_out_, straight);
  // A body may have turned on by several segments: a closed node is straight ahead of another one now.
  const bool may_jump = sides_->frame.turns();
  const std::size_t size = sides_->parameters;
  for (std::size_t k = 0; k < sides_->points.size(); ++k)
    if (found.segment[k] < 0 ||
        (may_jump && straight.segment[k] >= 0 && straight.segment[k] != found.segment[k])) {
      found.segment[k] = straight.segment[k];
      std::copy_n(straight.xi.data() + k * size, size, found.xi.data() + k * size);
    }
}

Lost ContactSearch::find_lost_since_begin(const ents_master_mesh& where, const Projections& begun,
                                          const std::vector<double>& pressure,
                                          const Projections& found) const {
  std::vector<std::size_t> gone;
  for (std::size_t k = 0; k < sides_->points.size(); ++k)
    if (found.segment[k] < 0 && begun.segment[k] >= 0 && pressure[k] != 0) gone.push_back(k);
  if (gone.empty()) return {};
  std::vector<double> slaves, normals;
  Projections at;
  for (const std::size_t k : gone) {
    const auto add = [k](const std::vector<double>& from, std::size_t size, std::vector<double>& to) {
      if (!from.empty()) to.insert(to.end(), from.data() + k * size, from.data() + (k + 1) * size);
    };
    add(sides_->slave_now, sides_->d, slaves), add(normals_, sides_->d, normals);
    at.segment.push_back(begun.segment[k]);
    add(begun.xi, sides_->parameters, at.xi);
  }
  Lost lost = detector_.find(where, slaves, normals, left_out_.of(gone), at);
  if (lost.slave >= 0) lost.slave = static_cast<std::int64_t>(gone[static_cast<std::size_t>(lost.slave)]);
  return lost;
}

void ContactSearch::describe_lost(const Lost& lost, const Configuration& at) {
  lost_.clear();
  lost_behind_edge_ = lost.behind_edge;
  if (lost.slave < 0) return;
  const std::vector<double> places = sides_->positions(at.displacement);
  std::string text;
  for (std::size_t i = 0; i < sides_->d; ++i)
    text +=
        (i > 0 ? ", " : "") + format_number(places[static_cast<std::size_t>(lost.slave) * sides_->d + i], 6);
  lost_ = "the slave node at (" + text + ") " +
          (lost.crossed       ? "passes through the surface within the increment"
           : lost.behind_edge ? "lies behind a concave edge between two segments and projects on neither"
                              : "was in contact and lies beside all segments of the master now");
}

} // namespace host
