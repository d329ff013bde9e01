// SPDX-License-Identifier: BSD-3-Clause
#include "core/search/way.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/search/mesh_motion.hpp"
#include "core/search/segment_tree.hpp"

namespace ents {

namespace {

constexpr int most_places = 64; // on the way of a slave

// Does the straight way from a to b pass a box by no more than `margin` on each axis?
bool passes(const double* a, const double* b, const double* box, double margin, int d) {
  double enter = 0.0, leave = 1.0;
  for (int i = 0; i < d; ++i) {
    const double low = box[i] - margin - a[i], high = box[d + i] + margin - a[i], way = b[i] - a[i];
    if (way == 0.0) {
      if (low > 0.0 || high < 0.0) return false;
      continue;
    }
    enter = std::max(enter, std::min(low / way, high / way));
    leave = std::min(leave, std::max(low / way, high / way));
  }
  return enter <= leave;
}

// Does a slave come so near to a segment that the surface may be on its way? Seen from the mesh at the end.
bool may_meet(const Plan& plan, const MasterMesh& mesh, const double* tree, const double* from,
              const double* to, const MeshMotion& motion, double reach) {
  double start[3];
  motion.move(from, start);
  bool meets = false;
  visit_segments(
      BoxTree(plan, mesh.segments), tree,
      [&](const double* box) {
        return passes(start, to, box, motion.rest + reach, plan.dimension) ? 0.0 : 1.0;
      },
      [&] { return meets ? -1.0 : 0.5; },
      [&](std::int64_t) {
        meets = true;
        return Status::ok;
      });
  return meets;
}

struct Walk {
  const Plan& plan;
  const MasterMesh& mesh;
  const Increment& way;
  double reach;
  std::vector<std::int64_t> far; // slaves that leave what the search sees
  std::vector<double> since; // part of the increment since which each is behind the surface; < 0: it is not
  std::vector<double> nodes, tree; // at a place on the way

  Walk(const Plan& p, const MasterMesh& m, const Increment& w, double r)
      : plan(p), mesh(m), way(w), reach(r) {}

  // The slave and the mesh after `part` of the increment: is it behind the surface?
  Status look(std::int64_t slave, double part, const MasterMesh& there, const double* boxes,
              bool& behind) const {
    const int d = plan.dimension;
    double place[3];
    for (int i = 0; i < d; ++i) {
      const double from = way.slave_begin[slave * d + i];
      place[i] = part == 1.0 ? way.slave[slave * d + i] : from + part * (way.slave[slave * d + i] - from);
    }
    Detection found;
    found.segment = -1;
    found.left_out = way.left_out.of(slave, d);
    if (way.depth) found.depth = way.depth[slave];
    const Status status = detect(plan, there, boxes, place, reach, found);
    behind = status == Status::ok && (found.behind_edge || (found.segment >= 0 && found.at.gap <= 0.0));
    return status;
  }

  // Where slave far[k] is behind the surface `now`, or in front of it: has it passed through it?
  void judge(std::size_t k, double part, bool now, Crossing& out) {
    if (part == 0.0) {
      since[k] = now ? 2.0 : -1.0; // 2: already at the begin
    } else if (now) {
      if (since[k] < 0.0) since[k] = part;
    } else {
      if (since[k] > 0.0 && since[k] < out.part) out = {far[k], since[k], out.moved, out.within, true};
      since[k] = -1.0;
    }
  }

  Status walk(int places, const double* tree_end, std::int64_t size, Crossing& out) {
    const std::int64_t numbers = mesh.nodes * plan.dimension;
    nodes.resize(static_cast<std::size_t>(numbers));
    tree.assign(tree_end, tree_end + size);
    since.assign(far.size(), -1.0);
    MasterMesh there = mesh;
    there.positions = nodes.data();
    const double* begin = way.positions_begin ? way.positions_begin : mesh.positions;
    for (int p = 0; p < places && out.part == 1.0; ++p) {
      const double part = static_cast<double>(p) / places;
      for (std::int64_t i = 0; i < numbers; ++i)
        nodes[static_cast<std::size_t>(i)] = begin[i] + part * (mesh.positions[i] - begin[i]);
      std::int64_t segment = -1;
      if (const Status status = refit_tree(plan, there, tree.data(), segment); status != Status::ok)
        return status;
      for (std::size_t k = 0; k < far.size(); ++k) {
        bool behind = false;
        if (const Status status = look(far[k], part, there, tree.data(), behind); status != Status::ok)
          return status;
        judge(k, part, behind, out);
      }
    }
    for (std::size_t k = 0; k < far.size(); ++k) judge(k, 1.0, false, out); // in front at the end
    return Status::ok;
  }
};

} // namespace

Status find_crossing(const Plan& plan, const MasterMesh& mesh, const double* tree, const Increment& way,
                     std::int64_t first, std::int64_t count, double reach, Crossing& out) {
  out = {};
  const int d = plan.dimension;
  const MeshMotion motion(mesh, way.positions_begin, d);
  Walk walk(plan, mesh, way, reach);
  for (std::int64_t k = first; k < first + count; ++k) {
    const double moved = motion.distance(way.slave_begin + k * d, way.slave + k * d) + motion.rest;
    const double within = way.depth ? std::min(reach, way.depth[k]) : reach;
    if (!(moved > 0.5 * within) ||
        !may_meet(plan, mesh, tree, way.slave_begin + k * d, way.slave + k * d, motion, reach))
      continue;
    bool behind = false;
    if (const Status status = walk.look(k, 1.0, mesh, tree, behind); status != Status::ok) return status;
    if (behind) continue;
    walk.far.push_back(k);
    if (out.slave < 0 || moved * out.within > out.moved * within)
      out.slave = k, out.moved = moved, out.within = within;
  }
  if (walk.far.empty()) return Status::ok;
  const double places = std::ceil(2.0 * out.moved / out.within);
  if (!(places <= most_places)) {
    // A way that is thousands of times too long is no step: the iteration has diverged.
    out.part = out.moved < 1e4 * out.within ? most_places * out.within / (2.0 * out.moved) : 0.5;
    return Status::ok;
  }
  out.slave = -1;
  return walk.walk(static_cast<int>(places), tree, tree_size(plan, mesh.segments), out);
}

} // namespace ents
