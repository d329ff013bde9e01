// SPDX-License-Identifier: BSD-3-Clause
// Heights and laws that change between calls: a bound plan is a model's plan with the caller's numbers in the
// places of its named parameters, and with the caller's memory in the places of its fields (field.hpp).
// Nothing of an evaluation knows where a number came from.
#pragma once

#include <vector>

#include "core/model/plan.hpp"

namespace ents {

inline constexpr std::int32_t most_parameters = 64, most_fields = 8;

// What a bound plan points into, beside its model.
struct BoundHeight {
  std::vector<HeightNode> nodes;
  std::vector<double> values; // of formulas and external heights with parameters, one after the other
};
BoundHeight make_bound_height(const ModelSpec& model);

// plan: `of`, a plan of the model, with the numbers of the caller. height: of make_bound_height().
// Statuses: non_finite, bad_value (a number that its law cannot have; `which`: the parameter), bad_state (the
// field).
Status bind(const ModelSpec& model, const Plan& of, const double* parameters, const double* const* fields,
            BoundHeight& height, Plan& plan, std::int32_t& which);

} // namespace ents
