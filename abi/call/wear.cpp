// SPDX-License-Identifier: BSD-3-Clause
// ents_wear_collect and ents_wear_collect_slave: what the master and the slave surface have lost goes from the states
// of the slave points into fields.
#include <algorithm>
#include <cmath>

#include "abi/call/combination.hpp"
#include "abi/call/element_call.hpp"
#include "abi/call/field_call.hpp"
#include "abi/call/guard.hpp"

namespace ents {

namespace {

// The field that gets what a surface has lost.
struct WornField {
  FieldLayout layout{};
  const MapHeight* map = nullptr;
  std::span<double> block{};
  int dimension = 0; // of space
  double thickness = 0.0;

  std::int32_t open(const ents_model& model, const char* name, double* values, std::int64_t size,
                    double thick, ents_report* report) {
    std::int32_t index = 0;
    if (const std::int32_t status = check_field(model, name, values, size, layout, index, report);
        status != ENTS_OK)
      return status;
    block = {values, static_cast<std::size_t>(layout.size)};
    if (!is_field(layout, block)) return refuse_block(name, report);
    dimension = model.plan.dimension, thickness = thick;
    if (dimension == 2 && !(thick >= 0.0 && thick < 1e100))
      return report_message(report, ENTS_BAD_VALUE, -1,
                            "thickness = %g; it is > 0, or 0 for axisymmetric bodies", thick);
    map = &find_field(model.model.height, index)->map;
    return ENTS_OK;
  }
  bool axisymmetric() const { return dimension == 2 && thickness == 0.0; }
  // What makes an area of a length in the plane: the thickness, or 2 pi r at `place`, the second axis is that of the
  // body; 1 in space
  double width(const double* place) const {
    if (axisymmetric()) return 2.0 * 3.14159265358979323846 * std::fabs(place[0]);
    return dimension == 3 ? 1.0 : thickness;
  }
  void lower(const double* s, double volume_per_s) {
    add_to_field(*map, layout, dimension - 1, s, -volume_per_s, block);
  }
  void has_changed() { block[field_header::changes] += 1.0; }
};

std::int32_t refuse_without_wear(ents_report* report) {
  return report_status(report, ENTS_BAD_VALUE, -1,
                       "the model has no wear; write \"wear\" into its \"contact\"");
}

// Looks at all elements before the first one changes: collect(e, looks, volume)
template <class Collect>
std::int32_t collect_all(std::int64_t first, std::int64_t end, WornField& field, double* volume,
                         ents_report* report, Collect&& collect) {
  double sum = 0.0, own = 0.0;
  for (const bool looks : {true, false})
    for (std::int64_t e = first; e < end; ++e) {
      if (const std::int32_t status = collect(e, looks, own); status != ENTS_OK) return status;
      if (!looks) sum += own;
    }
  field.has_changed();
  if (volume) *volume = sum;
  return report_ok(report);
}

struct Collection {
  ElementCall call;
  double* state;
  std::int64_t stride;
  WornField field;

  // Checks element e, and adds what it has lost to the field unless `looks`. volume: what the field gets
  std::int32_t collect(std::int64_t e, bool looks, double& volume, ents_report* report) {
    const Plan& plan = *call.plan;
    double* own = state + e * stride;
    volume = 0.0;
    if (!is_state(plan.state, own) || !is_segment_number(own[plan.state.size]) ||
        (call.in->mesh && call.segment(e) >= 0 && !call.state_follows(e)))
      return call.explain(ENTS_BAD_STATE, e, report);
    double& lost = own[plan.state.wear_at + StateLayout::worn_master];
    const double area = call.in->area ? *at(call.in->area, call.in->area_stride, e) : 1.0;
    if (lost == 0.0 || area == 0.0) return ENTS_OK;
    SegmentNodes nodes;
    if (call.in->mesh) {
      const std::int64_t s = call.segment(e);
      if (s < 0 || s >= call.mesh.segments) return call.refuse_segment(e, report);
      if (const Status outcome = gather(plan, call.mesh, s, nodes); outcome != Status::ok)
        return explain_segment(plan, call.mesh, outcome, s, report);
    }
    const ElementInput element = call.element(e, nodes);
    double s[2], area_per_s;
    const double* xi = own + StateLayout::xi_at;
    const Status outcome =
        plan.coordinates(plan, element.master, element.surface_coordinates, xi, s, area_per_s);
    if (outcome != Status::ok) return call.explain(static_cast<std::int32_t>(outcome), e, report);
    double place[3] = {};
    const SurfacePoint to = {nullptr, nullptr, nullptr, place, nullptr, nullptr, nullptr};
    if (field.axisymmetric()) // without a place the width is 0, and is refused
      plan.base->surface(*plan.base, element.master, element.surface_coordinates, xi, to);
    const double amount = lost * area, width = field.width(place);
    if (!(std::fabs(amount) < 1e100 && area_per_s * width > 1e-100))
      return call.explain(ENTS_OUT_OF_RANGE, e, report);
    volume = amount;
    if (looks) return ENTS_OK;
    field.lower(s, amount / (area_per_s * width));
    lost = 0.0;
    return ENTS_OK;
  }
};

std::int32_t collect_wear(const ents_model& model, std::int64_t first, std::int64_t count,
                          const ents_input* input, double thickness, double* state, std::int64_t stride,
                          const char* name, double* block, std::int64_t size, double* volume,
                          ents_report* report) {
  if (model.plan.state.wear_at < 0) return refuse_without_wear(report);
  if (!model.model.patch.empty())
    return report_status(
        report, ENTS_BAD_VALUE, -1,
        "the elements of this model are patches: their wear is not collected into a field; let the slave "
        "side lose all of it (\"slave\": 1)");
  Collection collection{{}, state, stride, {}};
  std::int32_t status = collection.field.open(model, name, block, size, thickness, report);
  if (status != ENTS_OK) return status;
  if (count > 0 && !state) return report_status(report, ENTS_NULL_ARGUMENT, -1, "argument 'state' is null");
  ents_input copy;
  const ents_input* in = known_struct(input, copy, "input", status, report);
  if (!in) return status;
  if (in->state_begin)
    return report_status(report, ENTS_BAD_VALUE, -1,
                         "input.state_begin is not null; the states are argument 'state'");
  ents_input with_state = *in;
  with_state.struct_size = static_cast<std::int32_t>(sizeof with_state);
  with_state.state_begin = state, with_state.state_begin_stride = stride;
  if (first + count > 1 && stride < model.sizes.state)
    return report_message(report, ENTS_BAD_COUNT, -1, "state_stride = %lld; at least %d is needed",
                          static_cast<long long>(stride), model.sizes.state);
  ents_output none{};
  none.struct_size = sizeof none;
  if ((status = collection.call.open(&model, first, count, &with_state, &none, report)) != ENTS_OK)
    return status;
  return collect_all(
      first, first + count, collection.field, volume, report,
      [&](std::int64_t e, bool looks, double& own) { return collection.collect(e, looks, own, report); });
}

// The slave surface: its points in their facets, whose height has the field.
struct SlaveCollection {
  const StateLayout& layout;
  ents_combination points;
  const double* coordinates;
  const double *positions, *areas;
  double* state;
  std::int64_t stride;
  WornField field;

  std::int32_t collect(std::int64_t i, bool looks, double& volume, ents_report* report) {
    volume = 0.0;
    double* own = state + i * stride;
    if (!is_state(layout, own))
      return report_message(report, ENTS_BAD_STATE, i,
                            "the state of point %lld is not one of the model: make it with ents_state_init",
                            static_cast<long long>(i));
    double& lost = own[layout.wear_at + StateLayout::worn_slave];
    if (lost == 0.0 || areas[i] == 0.0) return ENTS_OK;
    FacetPlace place;
    if (const std::int32_t status =
            place_on_facet(points, "points", i, field.dimension, coordinates, positions, place, report);
        status != ENTS_OK)
      return status;
    const double amount = lost * areas[i], area_per_s = place.area_per_s * field.width(place.point);
    if (!(std::fabs(amount) < 1e100 && area_per_s > 1e-100))
      return report_message(
          report, ENTS_OUT_OF_RANGE, i,
          "point %lld: an area of %g per unit of the surface coordinates, and a lost volume of "
          "%g: the coordinates, positions or areas are wrong",
          static_cast<long long>(i), area_per_s, amount);
    volume = amount;
    if (looks) return ENTS_OK;
    field.lower(place.s, amount / area_per_s);
    lost = 0.0;
    return ENTS_OK;
  }
};

// Are all points in one facet?
bool share_a_facet(const ents_combination& c) {
  for (std::int64_t i = 1; i < c.points; ++i)
    if (!std::equal(c.nodes + c.begin[0], c.nodes + c.begin[1], c.nodes + c.begin[i],
                    c.nodes + c.begin[i + 1]))
      return false;
  return true;
}

std::int32_t collect_slave_wear(const ents_model& model, const ents_model& surface, const char* name,
                                double* block, std::int64_t size, double thickness,
                                SlaveCollection& collection, const ents_combination* points,
                                std::int64_t nodes, double* volume, ents_report* report) {
  if (model.plan.state.wear_at < 0) return refuse_without_wear(report);
  if (surface.plan.dimension != model.plan.dimension)
    return report_message(report, ENTS_BAD_VALUE, -1, "argument 'surface' is in %dD, 'model' in %dD",
                          surface.plan.dimension, model.plan.dimension);
  std::int32_t status = collection.field.open(surface, name, block, size, thickness, report);
  if (status != ENTS_OK) return status;
  ents_combination& c = collection.points;
  if ((status = check_combination(points, "points", c, report)) != ENTS_OK) return status;
  if (c.points > 0 && (!collection.positions || !collection.areas || !collection.state))
    return report_message(report, ENTS_NULL_ARGUMENT, -1, "argument '%s' is null",
                          !collection.positions ? "positions" : (!collection.areas ? "areas" : "state"));
  if (nodes < 0 || nodes > std::int64_t{1} << 50)
    return report_message(report, ENTS_BAD_COUNT, -1, "nodes = %lld must be 0 .. 2^50",
                          static_cast<long long>(nodes));
  if (const std::int64_t k =
          first_non_finite(collection.positions, c.points > 0 ? nodes * model.plan.dimension : 0);
      k >= 0)
    return report_message(report, ENTS_NON_FINITE, -1, "positions[%lld] is NaN or infinite",
                          static_cast<long long>(k));
  if (c.points > 1 && collection.stride < model.sizes.state)
    return report_message(report, ENTS_BAD_COUNT, -1, "state_stride = %lld; at least %d is needed",
                          static_cast<long long>(collection.stride), model.sizes.state);
  for (std::int64_t i = 0; i < c.points; ++i)
    if ((status = check_combined_point(c, "points", i, nodes, report)) != ENTS_OK) return status;
  if (!collection.coordinates && !share_a_facet(c))
    return report_status(
        report, ENTS_BAD_VALUE, -1,
        "argument 'coordinates' is null: in natural coordinates all facets have one height, and "
        "each would lose what the others have lost; give surface coordinates");
  return collect_all(
      0, c.points, collection.field, volume, report,
      [&](std::int64_t i, bool looks, double& own) { return collection.collect(i, looks, own, report); });
}

} // namespace

} // namespace ents

extern "C" int32_t ents_wear_collect(const ents_model* model, int64_t first, int64_t count,
                                     const ents_input* input, double thickness, double* state,
                                     int64_t state_stride, const char* name, double* block, int64_t size,
                                     double* volume, ents_report* report) {
  return ents::entry_point(report, [&] {
    if (const std::int32_t status = ents::check_any_handle(model, report); status != ENTS_OK) return status;
    const ents::FloatingPointGuard guard;
    return ents::collect_wear(*model, first, count, input, thickness, state, state_stride, name, block, size,
                              volume, report);
  });
}

extern "C" int32_t ents_wear_collect_slave(const ents_model* model, const ents_model* surface,
                                           const ents_combination* points, const double* coordinates,
                                           int64_t nodes, const double* positions, double thickness,
                                           const double* areas, double* state, int64_t state_stride,
                                           const char* name, double* block, int64_t size, double* volume,
                                           ents_report* report) {
  return ents::entry_point(report, [&] {
    for (const ents_model* handle : {model, surface})
      if (const std::int32_t status = ents::check_any_handle(handle, report); status != ENTS_OK)
        return status;
    const ents::FloatingPointGuard guard;
    ents::SlaveCollection collection{model->plan.state, {}, coordinates, positions, areas, state,
                                     state_stride,      {}};
    return ents::collect_slave_wear(*model, *surface, name, block, size, thickness, collection, points, nodes,
                                    volume, report);
  });
}
