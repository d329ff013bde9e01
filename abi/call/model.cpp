// SPDX-License-Identifier: BSD-3-Clause
// Versions, and the life of a model.
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "abi/call/element_block.hpp"
#include "abi/call/field_call.hpp"
#include "abi/call/guard.hpp"
#include "abi/read/model_json.hpp"
#include "core/element/make_plan.hpp"
#include "core/model/needs.hpp"

namespace ents {

namespace {

static_assert(need::height == ENTS_NEEDS_HEIGHT && need::slope == ENTS_NEEDS_SLOPE &&
              need::curved == ENTS_NEEDS_CURVED);
static_assert(need::iteration == ENTS_NEEDS_ITERATION && need::master == ENTS_NEEDS_MASTER &&
              need::friction == ENTS_NEEDS_FRICTION);
static_assert(need::history == ENTS_NEEDS_HISTORY && need::multipliers == ENTS_NEEDS_MULTIPLIERS);
static_assert(need::one_by_one == ENTS_NEEDS_ONE_BY_ONE && need::temperatures == ENTS_NEEDS_TEMPERATURES);
static_assert(need::first_state == ENTS_NEEDS_FIRST_STATE);

std::int32_t finish(PatchedModel&& checked, ents_model** model, ents_report* report) {
  const auto shared = std::make_shared<SharedModel>(SharedModel{std::move(checked), Plan{}, Plan{}});
  shared->plan = make_plan(shared->model);
  shared->base = make_base_plan(shared->model);
  shared->plan.base = shared->base.base = &shared->base;
  if (!shared->model.patch.empty()) // they are those of the patch's nodes
    shared->plan.surface_coordinates = shared->base.surface_coordinates = nullptr;
  const std::uint64_t magic = shared->model.fields.empty() ? ents_model::live : ents_model::unbound;
  *model = new ents_model{
      magic, shared->plan, shared, shared->model, sizes_of(shared->plan, shared->model.patch), {}};
  return report_ok(report);
}

template <class Read> std::int32_t create(Read&& read, ents_model** model, ents_report* report) {
  const FloatingPointGuard guard;
  try {
    return finish(read(), model, report);
  } catch (const ModelError& error) {
    return report_status(report, error.status, -1, error.message.c_str());
  }
}

// The caller's arrays, whatever struct_size its structs have.
std::int32_t collect(const ents_data* data, std::int64_t count, std::vector<NamedData>& out,
                     ents_report* report) {
  if (count < 0 || count > (1 << 20))
    return report_message(report, ENTS_BAD_COUNT, -1, "data_count = %lld must be 0 .. %d",
                          static_cast<long long>(count), 1 << 20);
  if (count > 0 && !data) return report_status(report, ENTS_NULL_ARGUMENT, -1, "argument 'data' is null");
  for (std::int64_t i = 0; i < count; ++i) {
    std::int32_t status = ENTS_OK;
    ents_data copy;
    const ents_data* d = data_at(data, i, "data", copy, status, report);
    if (!d) return status;
    if (d->rows < 1 || d->columns < 1 || d->rows > (INT64_MAX >> 8) / d->columns)
      return report_message(report, ENTS_BAD_COUNT, i, "data[%lld]: rows = %lld, columns = %lld must be >= 1",
                            static_cast<long long>(i), static_cast<long long>(d->rows),
                            static_cast<long long>(d->columns));
    out.push_back({d->name, d->values, d->rows, d->columns});
  }
  return ENTS_OK;
}

} // namespace

} // namespace ents

extern "C" {

const char* ents_version(void) { return ENTS_LIBRARY_VERSION; }

int32_t ents_check_contract(int32_t major, int32_t minor, ents_report* report) {
  return ents::entry_point(report, [&] {
    if (major == ENTS_CONTRACT_MAJOR && minor >= 0 && minor <= ENTS_CONTRACT_MINOR)
      return ents::report_ok(report);
    return ents::report_message(
        report, ENTS_VERSION, -1,
        "the caller was built with contract %d.%d; this library (%s) serves %d.0 to %d.%d", major, minor,
        ENTS_LIBRARY_VERSION, ENTS_CONTRACT_MAJOR, ENTS_CONTRACT_MAJOR, ENTS_CONTRACT_MINOR);
  });
}

int32_t ents_model_create(const char* text, int64_t length, const char* directory, const ents_data* data,
                          int64_t data_count, ents_model** model, ents_report* report) {
  return ents::entry_point(report, [&] {
    if (!model) return ents::report_status(report, ENTS_NULL_ARGUMENT, -1, "argument 'model' is null");
    *model = nullptr;
    if (!text) return ents::report_status(report, ENTS_NULL_ARGUMENT, -1, "argument 'text' is null");
    if (length < -1)
      return ents::report_message(report, ENTS_BAD_COUNT, -1, "length = %lld must be >= 0, or -1",
                                  static_cast<long long>(length));
    std::vector<ents::NamedData> arrays;
    if (const std::int32_t status = ents::collect(data, data_count, arrays, report); status != ENTS_OK)
      return status;
    const std::string_view view =
        length < 0 ? std::string_view(text) : std::string_view(text, static_cast<std::size_t>(length));
    return ents::create(
        [&] {
          const auto* utf8 = reinterpret_cast<const char8_t*>(directory ? directory : "");
          return ents::read_model(view, std::filesystem::path(utf8), arrays);
        },
        model, report);
  });
}

int32_t ents_model_create_from_file(const char* path, ents_model** model, ents_report* report) {
  return ents::entry_point(report, [&] {
    if (!model) return ents::report_status(report, ENTS_NULL_ARGUMENT, -1, "argument 'model' is null");
    *model = nullptr;
    if (!path) return ents::report_status(report, ENTS_NULL_ARGUMENT, -1, "argument 'path' is null");
    return ents::create([&] { return ents::read_model_file(path); }, model, report);
  });
}

int32_t ents_model_destroy(ents_model** model, ents_report* report) {
  return ents::entry_point(report, [&] {
    if (!model || !*model) return ents::report_ok(report);
    if (const std::int32_t status = ents::check_any_handle(*model, report); status != ENTS_OK) return status;
    *const_cast<volatile std::uint64_t*>(&(*model)->magic) =
        ents_model::dead; // not a dead store: handles may be stale
    delete *model;
    *model = nullptr;
    return ents::report_ok(report);
  });
}

int32_t ents_model_layout(const ents_model* model, ents_layout* layout, ents_report* report) {
  return ents::entry_point(report, [&] {
    std::int32_t status = ents::check_any_handle(model, report);
    if (status != ENTS_OK) return status;
    ents_layout copy;
    const ents_layout* known = ents::known_struct(layout, copy, "layout", status, report);
    if (!known) return status;
    ents_layout out = *known;
    out.dimension = model->plan.dimension;
    out.nodes = model->sizes.nodes;
    out.parameters = model->plan.parameters;
    out.dofs = model->sizes.dofs;
    out.state_size = model->sizes.state;
    const ents::ContactLaw& law = model->plan.law;
    out.symmetric_tangent =
        !(law.has_friction() || law.wear.on || law.flattening.parameter != 0 || law.heat.on) ||
        law.symmetrised;
    out.own_surface_coordinates = model->model.own_surface_coordinates;
    out.multipliers = model->plan.multipliers;
    out.friction = law.has_friction();
    out.augmentable = law.multiplier_in_state();
    const bool one_by_one = !model->model.patch.empty() || !model->plan.block;
    out.needs = ents::needs_of(model->model, model->plan) | (one_by_one ? ents::need::one_by_one : 0);
    out.named_parameters = static_cast<std::int32_t>(model->model.parameters.size());
    out.fields = static_cast<std::int32_t>(model->model.fields.size());
    out.worn = model->plan.state.wear_at;
    out.slave_values = law.slave_values();
    out.node_dofs = model->plan.node_dofs;
    out.heat = law.heat.on;
    out.instruction_set = ents::best_block_kernels().instruction_set;
    ents::copy_to_caller(out, layout);
    return ents::report_ok(report);
  });
}

} // extern "C"
