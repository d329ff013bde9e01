// SPDX-License-Identifier: BSD-3-Clause
// Models bound to values of their parameters and to fields, and the blocks of fields.
#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

#include "abi/call/field_call.hpp"
#include "abi/call/guard.hpp"
#include "abi/read/model_error.hpp"
#include "core/height/height_value.hpp"

namespace ents {

namespace {

constexpr double largest_field_sample = 1e98; // coefficients are at most 9 times as large, and below 1e100

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + in_quotes(name);
  return text.empty() ? "it has none" : "it has " + text;
}

std::vector<std::string> parameter_names(const ModelSpec& model) {
  std::vector<std::string> names;
  for (const NamedParameter& parameter : model.parameters) names.push_back(parameter.name);
  return names;
}

// The caller's blocks, in the order of the model's fields.
std::int32_t collect_fields(const ents_model& model, const ents_data* data, std::int64_t count,
                            const double* (&blocks)[most_fields], ents_report* report) {
  const auto& names = model.model.fields;
  if (count < 0 || count > most_fields)
    return report_message(report, ENTS_BAD_COUNT, -1, "field_count = %lld must be 0 .. %d",
                          static_cast<long long>(count), most_fields);
  if (count > 0 && !data) return report_status(report, ENTS_NULL_ARGUMENT, -1, "argument 'fields' is null");
  for (std::int64_t i = 0; i < count; ++i) {
    std::int32_t status = ENTS_OK;
    ents_data copy;
    const ents_data* field = data_at(data, i, "fields", copy, status, report);
    if (!field) return status;
    FieldLayout layout;
    std::int32_t index = 0;
    if ((status = find_field(model, field->name, layout, index, report)) != ENTS_OK) return status;
    if (field->columns != layout.size || field->rows != 1)
      return report_message(report, ENTS_BAD_COUNT, i,
                            "fields[%lld]: the block of \"%s\" has 1 row and %lld columns",
                            static_cast<long long>(i), field->name, static_cast<long long>(layout.size));
    blocks[index] = field->values;
  }
  for (std::size_t i = 0; i < names.size(); ++i)
    if (!blocks[i])
      return report_message(report, ENTS_BAD_STATE, -1, "the field \"%s\" is not among the %lld fields given",
                            names[i].c_str(), static_cast<long long>(count));
  return ENTS_OK;
}

std::int32_t refuse_binding(const ents_model& model, Status status, std::int32_t which, ents_report* report) {
  if (status == Status::bad_state)
    return report_message(
        report, ENTS_BAD_STATE, -1,
        "the block of the field \"%s\" was not made by ents_field_init for this model, or was "
        "written over",
        model.model.fields[static_cast<std::size_t>(which)].c_str());
  const char* name = model.model.parameters[static_cast<std::size_t>(which)].name.c_str();
  if (status == Status::non_finite)
    return report_message(report, ENTS_NON_FINITE, -1, "parameters[%d] (\"%s\") is NaN or infinite", which,
                          name);
  return report_message(
      report, ENTS_BAD_VALUE, -1,
      "parameters[%d] (\"%s\") is out of range: a number of the normal law is positive and fits its others, "
      "a coefficient of "
      "friction and a number of wear are not negative, the scale of \"flattening\" is 1, all are at most "
      "1e100",
      which, name);
}

std::int32_t bind_model(const ents_model& model, const double* parameters, const ents_data* fields,
                        std::int64_t field_count, ents_model** bound, ents_report* report) {
  const double* blocks[most_fields] = {};
  if (const std::int32_t status = collect_fields(model, fields, field_count, blocks, report);
      status != ENTS_OK)
    return status;
  ents_model* target = *bound;
  if (target &&
      (target->magic != ents_model::live || target->height.nodes.empty() || target->shared != model.shared))
    return report_status(report, ENTS_BAD_HANDLE, -1,
                         "*bound is neither null nor a model that ents_model_bind has made from this model");
  std::unique_ptr<ents_model> made(target ? nullptr
                                          : new ents_model{ents_model::live, model.shared->plan, model.shared,
                                                           model.model, model.sizes,
                                                           make_bound_height(model.model)});
  if (!target) target = made.get();
  std::int32_t which = 0;
  const FloatingPointGuard guard;
  const Status status =
      bind(model.model, model.shared->plan, parameters, blocks, target->height, target->plan, which);
  if (status != Status::ok) return refuse_binding(model, status, which, report);
  if (made) *bound = made.release();
  return report_ok(report);
}

} // namespace

const ents_data* data_at(const ents_data* data, std::int64_t i, const char* name, ents_data& copy,
                         std::int32_t& status, ents_report* report) noexcept {
  const std::int32_t stride = data->struct_size;
  const unsigned char* position = reinterpret_cast<const unsigned char*>(data) + i * stride;
  const ents_data* d = known_struct(reinterpret_cast<const ents_data*>(position), copy, name, status, report);
  if (!d || (status = check_reserved(d->reserved, name, report)) != ENTS_OK) return nullptr;
  const long long index = i;
  if (d->struct_size != stride)
    status = report_message(report, ENTS_STRUCT_SIZE, i,
                            "%s[%lld].struct_size differs from %s[0].struct_size", name, index, name);
  else if (!d->name || !d->values)
    status = report_message(report, ENTS_NULL_ARGUMENT, i, "%s[%lld].%s is null", name, index,
                            d->name ? "values" : "name");
  return status == ENTS_OK ? d : nullptr;
}

std::int32_t find_field(const ents_model& model, const char* name, FieldLayout& layout, std::int32_t& index,
                        ents_report* report) {
  if (!name) return report_status(report, ENTS_NULL_ARGUMENT, -1, "argument 'name' is null");
  const auto& names = model.model.fields;
  const auto found = std::find(names.begin(), names.end(), std::string_view(name));
  if (found == names.end())
    return report_message(report, ENTS_BAD_VALUE, -1, "the model has no field \"%.60s\"; %s", name,
                          listed(names).c_str());
  index = static_cast<std::int32_t>(found - names.begin());
  layout = layout_of_field(find_field(model.model.height, index)->map, model.model.height.dimension());
  return ENTS_OK;
}

std::int32_t check_field(const ents_model& model, const char* name, const double* block, std::int64_t size,
                         FieldLayout& layout, std::int32_t& index, ents_report* report) {
  if (const std::int32_t status = find_field(model, name, layout, index, report); status != ENTS_OK)
    return status;
  if (!block) return report_status(report, ENTS_NULL_ARGUMENT, -1, "argument 'block' is null");
  if (size < layout.size)
    return report_message(report, ENTS_BAD_COUNT, -1, "size = %lld; the block of \"%s\" has %lld numbers",
                          static_cast<long long>(size), name, static_cast<long long>(layout.size));
  return ENTS_OK;
}

std::int32_t refuse_block(const char* name, ents_report* report) {
  return report_message(report, ENTS_BAD_STATE, -1,
                        "the block is not that of the field \"%s\"; make it with ents_field_init", name);
}

namespace {

// As check_field(), of a handle that is not checked yet.
std::int32_t check_block(const ents_model* model, const char* name, const double* block, std::int64_t size,
                         FieldLayout& layout, std::int32_t& index, ents_report* report) {
  if (const std::int32_t status = check_any_handle(model, report); status != ENTS_OK) return status;
  return check_field(*model, name, block, size, layout, index, report);
}

} // namespace

} // namespace ents

extern "C" {

int32_t ents_model_bind(const ents_model* model, const double* parameters, const ents_data* fields,
                        int64_t field_count, ents_model** bound, ents_report* report) {
  return ents::entry_point(report, [&] {
    if (const std::int32_t status = ents::check_any_handle(model, report); status != ENTS_OK) return status;
    if (!bound) return ents::report_status(report, ENTS_NULL_ARGUMENT, -1, "argument 'bound' is null");
    return ents::bind_model(*model, parameters, fields, field_count, bound, report);
  });
}

int32_t ents_parameter_place(const ents_model* model, const char* name, int64_t* place, ents_report* report) {
  return ents::entry_point(report, [&] {
    if (const std::int32_t status = ents::check_any_handle(model, report); status != ENTS_OK) return status;
    if (!name || !place)
      return ents::report_message(report, ENTS_NULL_ARGUMENT, -1, "argument '%s' is null",
                                  name ? "place" : "name");
    const std::vector<std::string> names = ents::parameter_names(model->model);
    const auto found = std::find(names.begin(), names.end(), std::string_view(name));
    if (found == names.end())
      return ents::report_message(report, ENTS_BAD_VALUE, -1, "the model has no parameter \"%.60s\"; %s",
                                  name, ents::listed(names).c_str());
    *place = found - names.begin();
    return ents::report_ok(report);
  });
}

int32_t ents_field_size(const ents_model* model, const char* name, int64_t* size, ents_report* report) {
  return ents::entry_point(report, [&] {
    std::int32_t status = ents::check_any_handle(model, report), index = 0;
    if (status != ENTS_OK) return status;
    if (!size) return ents::report_status(report, ENTS_NULL_ARGUMENT, -1, "argument 'size' is null");
    ents::FieldLayout layout;
    if ((status = ents::find_field(*model, name, layout, index, report)) != ENTS_OK) return status;
    *size = layout.size;
    return ents::report_ok(report);
  });
}

int32_t ents_field_init(const ents_model* model, const char* name, const double* samples, double* block,
                        int64_t size, ents_report* report) {
  return ents::entry_point(report, [&] {
    ents::FieldLayout layout;
    std::int32_t index = 0;
    if (const std::int32_t status = ents::check_block(model, name, block, size, layout, index, report);
        status != ENTS_OK)
      return status;
    const ents::FloatingPointGuard guard;
    if (const std::int64_t k = samples ? ents::first_non_finite(samples, layout.columns * layout.rows) : -1;
        k >= 0)
      return ents::report_message(report, ENTS_NON_FINITE, k, "samples[%lld] is NaN or infinite",
                                  static_cast<long long>(k));
    for (std::int64_t k = 0; samples && k < layout.columns * layout.rows; ++k)
      if (std::fabs(samples[k]) > ents::largest_field_sample)
        return ents::report_message(report, ENTS_BAD_VALUE, k, "samples[%lld] is %g; heights are at most %g",
                                    static_cast<long long>(k), samples[k], ents::largest_field_sample);
    ents::set_field(model->model.height, index, samples, {block, static_cast<std::size_t>(layout.size)});
    return ents::report_ok(report);
  });
}

int32_t ents_field_sample(const ents_model* model, const char* name, const double* block, int64_t size,
                          int64_t count, const double* s, double* height, ents_report* report) {
  return ents::entry_point(report, [&] {
    ents::FieldLayout layout;
    std::int32_t index = 0;
    if (const std::int32_t status = ents::check_block(model, name, block, size, layout, index, report);
        status != ENTS_OK)
      return status;
    if (!ents::is_field(layout, {block, static_cast<std::size_t>(layout.size)}))
      return ents::refuse_block(name, report);
    if (count < 0 || count > std::int64_t{1} << 50)
      return ents::report_message(report, ENTS_BAD_COUNT, -1, "count = %lld must be 0 .. 2^50",
                                  static_cast<long long>(count));
    if (count > 0 && (!s || !height))
      return ents::report_message(report, ENTS_NULL_ARGUMENT, -1, "argument '%s' is null",
                                  s ? "height" : "s");
    const ents::FloatingPointGuard guard;
    const std::int32_t t = model->model.height.dimension();
    if (const std::int64_t k = ents::first_non_finite(s, count * t); k >= 0)
      return ents::report_message(report, ENTS_NON_FINITE, k / t, "s[%lld] is NaN or infinite",
                                  static_cast<long long>(k));
    ents::HeightNode node = *ents::find_field(model->model.height, index);
    node.map.coefficients = block + layout.first;
    for (std::int64_t i = 0; i < count; ++i) height[i] = ents::height_at(node, t, s + i * t);
    return ents::report_ok(report);
  });
}

} // extern "C"
