// SPDX-License-Identifier: BSD-3-Clause
// Whole master surfaces: the tree and the detection.
#include "core/search/segment_tree.hpp"
#include "core/search/way.hpp"

#include <cmath>
#include <cstddef>

#include "abi/call/detection_call.hpp"
#include "abi/call/guard.hpp"

namespace ents {

std::int32_t explain_segment(const Plan& plan, const MasterMesh& mesh, Status status, std::int64_t segment,
                             ents_report* report) noexcept {
  const long long e = segment;
  const std::int64_t* nodes = mesh.connectivity + segment * plan.nodes;
  for (int i = 0; i < plan.nodes; ++i) {
    if (nodes[i] < 0 || nodes[i] >= mesh.nodes)
      return report_message(report, ENTS_BAD_VALUE, segment,
                            "mesh.connectivity: node %d of segment %lld is %lld; nodes are 0 .. %lld", i, e,
                            static_cast<long long>(nodes[i]), static_cast<long long>(mesh.nodes - 1));
    if (first_non_finite(mesh.positions + nodes[i] * plan.dimension, plan.dimension) >= 0)
      return report_message(report, ENTS_NON_FINITE, segment,
                            "mesh.positions of node %lld (segment %lld) is NaN or infinite",
                            static_cast<long long>(nodes[i]), e);
  }
  if (status == Status::non_finite)
    return report_message(
        report, ENTS_NON_FINITE, segment,
        "mesh.surface_coordinates of segment %lld is NaN or infinite, or positions are too large", e);
  return report_message(report, static_cast<std::int32_t>(status), segment, "segment %lld: %s", e,
                        ents_status_text(static_cast<std::int32_t>(status)));
}

std::int32_t check_mesh(const ents_master_mesh* caller, const char* name, MasterMesh& mesh,
                        ents_report* report) noexcept {
  ents_master_mesh copy;
  std::int32_t status = ENTS_OK;
  const ents_master_mesh* m = known_struct(caller, copy, name, status, report);
  if (!m) return status;
  if ((status = check_reserved(m->reserved, name, report)) != ENTS_OK) return status;
  constexpr std::int64_t most = std::int64_t{1} << 40;
  if (m->segments < 0 || m->segments > most || m->nodes < 0 || m->nodes > most)
    return report_message(report, ENTS_BAD_COUNT, -1,
                          "%s.segments = %lld, %s.nodes = %lld: both must be 0 .. 2^40", name,
                          static_cast<long long>(m->segments), name, static_cast<long long>(m->nodes));
  if (m->segments > 0 && (!m->connectivity || !m->positions))
    return report_message(report, ENTS_NULL_ARGUMENT, -1, "%s.%s is null", name,
                          m->connectivity ? "positions" : "connectivity");
  mesh = {m->segments, m->connectivity, m->nodes, m->positions, m->surface_coordinates, m->temperature};
  return ENTS_OK;
}

namespace {

// What the caller should do; `slave` is its number.
std::int32_t explain_lost_contact(Lost lost, std::int64_t slave, std::int64_t before, double reach,
                                  ents_report* report) noexcept {
  const long long number = slave, segment = before;
  if (lost == Lost::behind_edge)
    return report_message(
        report, ENTS_NO_PROJECTION, slave,
        "slave %lld is behind an edge between segments, and no segment is in front of it: take a smaller "
        "step, give the model a wider \"border\", or smooth the surface (ENTS_FLAG_BEHIND_EDGE in "
        "detection.permitted: go on without its contact)",
        number);
  if (lost == Lost::too_deep)
    return report_message(
        report, ENTS_NO_PROJECTION, slave,
        "slave %lld was on segment %lld and lies deeper than detection.reach (%g), or than its depth, now: "
        "take a smaller step, or give a larger reach (ENTS_FLAG_LEFT in detection.permitted: go on without "
        "its contact)",
        number, segment, reach);
  return report_message(
      report, ENTS_NO_PROJECTION, slave,
      "slave %lld was on segment %lld and lies beside all segments now, not above the surface: take a "
      "smaller "
      "step, or let the master reach farther (ENTS_FLAG_LEFT in detection.permitted: go on without its "
      "contact; segment = -1 for slaves that were open)",
      number, segment);
}

std::int32_t check_tree_size(const Plan& plan, const MasterMesh& mesh, const double* tree, std::int64_t size,
                             ents_report* report) noexcept {
  if (!tree) return report_status(report, ENTS_NULL_ARGUMENT, -1, "argument 'tree' is null");
  if (size < tree_size(plan, mesh.segments))
    return report_message(report, ENTS_BAD_COUNT, -1,
                          "argument 'size' is %lld; %lld segments need %lld (ents_tree_size)",
                          static_cast<long long>(size), static_cast<long long>(mesh.segments),
                          static_cast<long long>(tree_size(plan, mesh.segments)));
  return ENTS_OK;
}

std::int32_t check_is_tree(const Plan& plan, const MasterMesh& mesh, const double* tree,
                           ents_report* report) noexcept {
  if (is_tree(plan, mesh, tree)) return ENTS_OK;
  return report_message(
      report, ENTS_BAD_STATE, -1,
      "argument 'tree' is not a whole tree of %lld segments in %dD; make it with ents_tree_build (again, if "
      "ents_tree_refit has failed)",
      static_cast<long long>(mesh.segments), plan.dimension);
}

std::int32_t check_tree_of_model(const Plan& plan, const double* tree, ents_report* report) noexcept {
  if (is_tree_of_model(plan, tree)) return ENTS_OK;
  return report_status(report, ENTS_BAD_STATE, -1,
                       "argument 'tree' was made with another model: its boxes hold another height, segment, "
                       "border or surface coordinates. "
                       "Call ents_tree_refit with this model");
}

using TreeFunction = Status (*)(const Plan&, const MasterMesh&, double*, std::int64_t&);
std::int32_t make_tree(const ents_model* model, const ents_master_mesh* caller, double* tree,
                       std::int64_t size, TreeFunction make, bool refit, ents_report* report) {
  const FloatingPointGuard guard;
  std::int32_t status = check_handle(model, report);
  MasterMesh mesh;
  if (status == ENTS_OK) status = check_mesh(caller, "mesh", mesh, report);
  if (status == ENTS_OK) status = check_tree_size(model->plan, mesh, tree, size, report);
  if (status == ENTS_OK && refit) status = check_is_tree(model->plan, mesh, tree, report);
  if (status != ENTS_OK) return status;
  std::int64_t segment = -1;
  const Status outcome = make(model->plan, mesh, tree, segment);
  return outcome == Status::ok ? report_ok(report)
                               : explain_segment(model->plan, mesh, outcome, segment, report);
}

std::int32_t list_boxes(const ents_model* model, const ents_master_mesh* caller, double* boxes,
                        ents_report* report) {
  const FloatingPointGuard guard;
  std::int32_t status = check_handle(model, report);
  MasterMesh mesh;
  if (status == ENTS_OK) status = check_mesh(caller, "mesh", mesh, report);
  if (status != ENTS_OK) return status;
  if (mesh.segments > 0 && !boxes)
    return report_status(report, ENTS_NULL_ARGUMENT, -1, "argument 'boxes' is null");
  const int d = model->plan.dimension;
  for (std::int64_t s = 0; s < mesh.segments; ++s) {
    double* box = boxes + s * 2 * d;
    if (const Status outcome = box_of_segment(model->plan, mesh, s, box, box + d); outcome != Status::ok)
      return explain_segment(model->plan, mesh, outcome, s, report);
  }
  return report_ok(report);
}

} // namespace

std::int32_t DetectionCall::open(const ents_model* handle, const ents_master_mesh* caller,
                                 const double* boxes, std::int64_t size, std::int64_t first,
                                 std::int64_t count, const ents_detection* detection, ents_report* report) {
  std::int32_t status = check_handle(handle, report);
  if (status == ENTS_OK) status = check_mesh(caller, "mesh", mesh, report);
  if (status == ENTS_OK) status = check_tree_size(handle->plan, mesh, boxes, size, report);
  if (status == ENTS_OK) status = check_is_tree(handle->plan, mesh, boxes, report);
  if (status == ENTS_OK) status = check_tree_of_model(handle->plan, boxes, report);
  if (status != ENTS_OK) return status;
  model = handle, tree = boxes;
  io = known_struct(detection, copy, "detection", status, report);
  if (!io) return status;
  judges = detection->struct_size >=
           static_cast<std::int32_t>(offsetof(ents_detection, permitted) + sizeof(ents_detection::permitted));
  if ((status = check_reserved(io->reserved, "detection", report)) != ENTS_OK) return status;
  if (judges &&
      (io->permitted & ~std::int64_t{ENTS_FLAG_LEFT | ENTS_FLAG_BEHIND_EDGE | ENTS_FLAG_CROSSED}) != 0)
    return report_message(report, ENTS_BAD_MASK, -1,
                          "detection.permitted has unknown bits (%lld): ENTS_FLAG_LEFT, "
                          "ENTS_FLAG_BEHIND_EDGE and ENTS_FLAG_CROSSED are known",
                          static_cast<long long>(io->permitted));
  constexpr std::int64_t most = std::int64_t{1} << 50;
  if (first < 0 || count < 0 || first > most - count)
    return report_message(report, ENTS_BAD_COUNT, -1,
                          "first = %lld, count = %lld: both must be >= 0 and end before 2^50",
                          static_cast<long long>(first), static_cast<long long>(count));
  if (!(io->reach > 0.0) || !(io->reach < 1e100))
    return report_message(report, ENTS_BAD_VALUE, -1,
                          "detection.reach is %g; a length above 0 and below 1e100 is needed", io->reach);
  if (count > 0 && (!io->slave || !io->segment || !io->xi))
    return report_message(report, ENTS_NULL_ARGUMENT, -1, "detection.%s is null",
                          !io->slave     ? "slave"
                          : !io->segment ? "segment"
                                         : "xi");
  if (count > 0 && !io->slave_side != !io->segment_side)
    return report_message(report, ENTS_NULL_ARGUMENT, -1, "detection.%s is null, and detection.%s is not",
                          io->slave_side ? "segment_side" : "slave_side",
                          io->slave_side ? "slave_side" : "segment_side");
  slave_begin = io->slave_begin, positions_begin = io->positions_begin, depth = io->depth;
  left_out = {io->slave_node, io->slave_segment, io->slave_side, io->segment_side, io->slave_normal};
  if (depth) left_out.facing = faces_itself;
  return ENTS_OK;
}

// Of a slave without a segment of its own: that of its state, if it is in contact and knows it; else -1.
std::int64_t DetectionCall::segment_before(std::int64_t slave, double (&xi)[2]) const {
  if (io->segment[slave] >= 0 || !state_begin) {
    for (int a = 0; io->segment[slave] >= 0 && a < model->plan.parameters; ++a)
      xi[a] = io->xi[slave * model->plan.parameters + a];
    return io->segment[slave];
  }
  const StateLayout& layout = model->plan.state;
  const double* state = state_begin + state_begin_stride * slave;
  if (!is_state(layout, state) || !is_segment_number(state[layout.size]) ||
      !(state[StateLayout::history_at] > 1.0) || state[layout.size] > static_cast<double>(mesh.segments))
    return -1;
  for (int a = 0; a < model->plan.parameters; ++a) xi[a] = state[StateLayout::xi_at + a];
  return static_cast<std::int64_t>(state[layout.size]) - 1;
}

std::int32_t DetectionCall::read_left_out(std::int64_t i, LeftOut& out, ents_report* report) const {
  const long long number = i;
  out = left_out.of(i, model->plan.dimension);
  if (out.normal && first_non_finite(out.normal, model->plan.dimension) >= 0)
    return report_message(report, ENTS_NON_FINITE, i,
                          "detection.slave_normal of node %lld is NaN or infinite", number);
  if (out.node < -1 || out.node >= mesh.nodes)
    return report_message(report, ENTS_BAD_VALUE, i,
                          "detection.slave_node of node %lld is %lld; -1 or 0 .. %lld", number,
                          static_cast<long long>(out.node), static_cast<long long>(mesh.nodes - 1));
  if (out.segment < -1 || out.segment >= mesh.segments)
    return report_message(report, ENTS_BAD_VALUE, i,
                          "detection.slave_segment of node %lld is %lld; -1 or 0 .. %lld", number,
                          static_cast<long long>(out.segment), static_cast<long long>(mesh.segments - 1));
  if (depth && !(depth[i] > 0.0))
    return report_message(report, ENTS_BAD_VALUE, i,
                          "detection.depth of node %lld is %g; a length above 0 is needed: half the "
                          "thickness of the body there (ents_thickness)",
                          number, depth[i]);
  return ENTS_OK;
}

std::int32_t DetectionCall::detect_all(std::int64_t first, std::int64_t count, ents_report* report) const {
  const Plan& plan = model->plan;
  const std::int64_t permitted = judges ? io->permitted : 0;
  struct {
    std::int64_t slave = -1, before = -1;
    Lost contact = Lost::no;
  } lost; // the first one
  const bool looks_at_ways = slave_begin && (permitted & ENTS_FLAG_CROSSED) == 0;
  for (std::int64_t i = first; i < first + count; ++i) {
    const double* slave = io->slave + i * plan.dimension;
    double* xi = io->xi + i * plan.parameters;
    if (const std::int64_t k = first_non_finite(slave, plan.dimension); k >= 0)
      return report_message(report, ENTS_NON_FINITE, i, "detection.slave[%lld] of node %lld is %s",
                            static_cast<long long>(k), static_cast<long long>(i),
                            std::isnan(slave[k]) ? "NaN" : "infinite");
    Detection found;
    found.segment = io->segment[i];
    if (const std::int32_t status = read_left_out(i, found.left_out, report); status != ENTS_OK)
      return status;
    if (depth) found.depth = depth[i];
    if (found.segment < -1 || found.segment >= mesh.segments)
      return report_message(report, ENTS_BAD_VALUE, i,
                            "detection.segment of node %lld is %lld; -1 or 0 .. %lld",
                            static_cast<long long>(i), static_cast<long long>(found.segment),
                            static_cast<long long>(mesh.segments - 1));
    if (found.segment >= 0) {
      if (first_non_finite(xi, plan.parameters) >= 0)
        return report_message(report, ENTS_NON_FINITE, i, "detection.xi of node %lld is NaN or infinite",
                              static_cast<long long>(i));
      for (int a = 0; a < plan.parameters; ++a) found.at.xi[a] = xi[a];
    }
    double xi_before[2] = {};
    const std::int64_t before = judges ? segment_before(i, xi_before) : -1;
    const Status outcome = detect(plan, mesh, tree, slave, io->reach, found);
    if (outcome == Status::bad_state)
      return report_status(report, ENTS_BAD_STATE, i,
                           "argument 'tree' has been written over: it holds NaN or a segment that does not "
                           "exist. Build it again with "
                           "ents_tree_build");
    if (outcome != Status::ok) return explain_segment(plan, mesh, outcome, found.segment, report);
    io->segment[i] = found.segment;
    Lost contact = Lost::no;
    if (found.segment < 0 && before >= 0)
      contact = judge_lost_contact(plan, mesh, tree, slave, before, xi_before, found);
    else if (found.behind_edge && needs_all)
      contact = Lost::behind_edge;
    const bool left = contact == Lost::beside || contact == Lost::too_deep;
    if (found.segment >= 0)
      for (int a = 0; a < plan.parameters; ++a) xi[a] = found.at.xi[a];
    if (io->gap) io->gap[i] = found.segment >= 0 ? found.at.gap : 0.0;
    if (io->flags)
      io->flags[i] = (found.searched ? ENTS_FLAG_SEARCHED : 0) |
                     (found.at.ambiguous ? ENTS_FLAG_AMBIGUOUS : 0) |
                     (found.behind_edge ? ENTS_FLAG_BEHIND_EDGE : 0) | (left ? ENTS_FLAG_LEFT : 0);
    if (io->other) io->other[i] = found.other;
    const std::int64_t flag = left ? ENTS_FLAG_LEFT : ENTS_FLAG_BEHIND_EDGE;
    if (contact != Lost::no && (permitted & flag) == 0 && lost.slave < 0) lost = {i, before, contact};
  }
  if (lost.slave >= 0) return explain_lost_contact(lost.contact, lost.slave, lost.before, io->reach, report);
  return looks_at_ways ? look_at_ways(first, count, report) : report_ok(report);
}

std::int32_t DetectionCall::look_at_ways(std::int64_t first, std::int64_t count, ents_report* report) const {
  const Plan& plan = model->plan;
  const std::int64_t d = plan.dimension;
  if (const std::int64_t k = first_non_finite(slave_begin + first * d, count * d); k >= 0)
    return report_message(report, ENTS_NON_FINITE, first + k / d,
                          "slave_begin[%lld] of node %lld is NaN or infinite", static_cast<long long>(k % d),
                          static_cast<long long>(first + k / d));
  if (positions_begin)
    if (const std::int64_t k = first_non_finite(positions_begin, mesh.nodes * d); k >= 0)
      return report_message(report, ENTS_NON_FINITE, k / d,
                            "positions_begin of node %lld of the mesh is NaN or infinite",
                            static_cast<long long>(k / d));
  Crossing crossing;
  if (const Status status =
          find_crossing(plan, mesh, tree, {slave_begin, io->slave, positions_begin, left_out, depth}, first,
                        count, io->reach, crossing);
      status != Status::ok)
    return report_status(report, static_cast<std::int32_t>(status), -1,
                         "on the way from slave_begin and positions_begin to the end of the increment");
  if (crossing.slave < 0) return report_ok(report);
  const long long slave = crossing.slave;
  const char* by = crossing.within < io->reach ? "depth" : "reach";
  const std::int32_t status =
      crossing.seen
          ? report_message(
                report, ENTS_NO_PROJECTION, crossing.slave,
                "slave %lld passes through the master surface within the increment (it is behind it "
                "after %.3g of the increment): take a smaller step (ENTS_FLAG_CROSSED in "
                "detection.permitted: go on)",
                slave, crossing.part)
          : report_message(report, ENTS_NO_PROJECTION, crossing.slave,
                           "slave %lld moves by %.6g relative to the master surface, %.3g times %s: it may "
                           "pass through it "
                           "unseen. Take a smaller step%s (ENTS_FLAG_CROSSED in detection.permitted: go on)",
                           slave, crossing.moved, crossing.moved / crossing.within, by,
                           crossing.within < io->reach ? "" : ", or give a larger reach");
  report_step(report, crossing.part);
  return status;
}

} // namespace ents

extern "C" {

int32_t ents_tree_size(const ents_model* model, int64_t segments, int64_t* size, ents_report* report) {
  return ents::entry_point(report, [&] {
    const std::int32_t status = ents::check_handle(model, report);
    if (status != ENTS_OK) return status;
    if (!size) return ents::report_status(report, ENTS_NULL_ARGUMENT, -1, "argument 'size' is null");
    const std::int64_t needed = segments < 0 ? 0 : ents::tree_size(model->plan, segments);
    if (needed == 0)
      return ents::report_message(report, ENTS_BAD_COUNT, -1, "segments = %lld must be 0 .. 2^40",
                                  static_cast<long long>(segments));
    *size = needed;
    return ents::report_ok(report);
  });
}

int32_t ents_tree_build(const ents_model* model, const ents_master_mesh* mesh, double* tree, int64_t size,
                        ents_report* report) {
  return ents::entry_point(
      report, [&] { return ents::make_tree(model, mesh, tree, size, ents::build_tree, false, report); });
}

int32_t ents_tree_refit(const ents_model* model, const ents_master_mesh* mesh, double* tree, int64_t size,
                        ents_report* report) {
  return ents::entry_point(
      report, [&] { return ents::make_tree(model, mesh, tree, size, ents::refit_tree, true, report); });
}

int32_t ents_surface_boxes(const ents_model* model, const ents_master_mesh* mesh, double* boxes,
                           ents_report* report) {
  return ents::entry_point(report, [&] { return ents::list_boxes(model, mesh, boxes, report); });
}

int32_t ents_detect(const ents_model* model, const ents_master_mesh* mesh, const double* tree, int64_t size,
                    int64_t first, int64_t count, const ents_detection* detection, ents_report* report) {
  return ents::entry_point(report, [&] {
    const ents::FloatingPointGuard
        guard; // to compare with a signalling NaN may trap: even to ask whether this is a tree
    ents::DetectionCall call;
    const std::int32_t status = call.open(model, mesh, tree, size, first, count, detection, report);
    return status == ENTS_OK ? call.detect_all(first, count, report) : status;
  });
}

} // extern "C"
