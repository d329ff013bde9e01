// SPDX-License-Identifier: BSD-3-Clause
// Arguments of calls that take the block of a field.
#pragma once

#include "abi/call/handle.hpp"
#include "core/height/field.hpp"

namespace ents {

// Entry i of the caller's array, whatever struct_size its structs have; null: refused. name: of the argument
const ents_data* data_at(const ents_data* data, std::int64_t i, const char* name, ents_data& copy,
                         std::int32_t& status, ents_report* report) noexcept;

// The model's field of this name; an error is reported.
std::int32_t find_field(const ents_model& model, const char* name, FieldLayout& layout, std::int32_t& index,
                        ents_report* report);
// The same, and has the block its length? Not: is it a field? (refuse_block)
std::int32_t check_field(const ents_model& model, const char* name, const double* block, std::int64_t size,
                         FieldLayout& layout, std::int32_t& index, ents_report* report);
std::int32_t refuse_block(const char* name, ents_report* report);

} // namespace ents
