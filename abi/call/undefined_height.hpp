// SPDX-License-Identifier: BSD-3-Clause
// Where a height that is a function (an expression, a function of the host) has no value, or a first or
// second derivative (with friction a third one) that is NaN or infinite: the kernels only see a surface
// without a normal, or a result out of range there.
#pragma once

#include "abi/call/entry_point.hpp"
#include "core/model/plan.hpp"

namespace ents {

// Is it so at xi? s [parameters] out: the surface coordinates there.
bool height_is_undefined(const Plan& plan, const double* master, const double* surface_coordinates,
                         const double* xi, double (&s)[2]);
// Or where an element starts from, or where its slave is above the segment without its height?
bool height_is_undefined(const Plan& plan, const ElementInput& element, double (&s)[2]);

// NO_PROJECTION; what: "element 3", say
std::int32_t report_undefined_height(const Plan& plan, const char* what, std::int64_t index,
                                     const double (&s)[2], ents_report* report) noexcept;

} // namespace ents
