// SPDX-License-Identifier: BSD-3-Clause
// What a tree of heights is at a place, and how large.
#pragma once

#include "core/height/height.hpp"

namespace ents {

// Are h and its derivatives up to `order`, 2 or 3, finite at s [dimension]?
bool is_defined_at(const HeightNode& node, std::int32_t dimension, const double* s, int order);

// h at s [dimension].
double height_at(const HeightNode& node, std::int32_t dimension, const double* s);

// Largest |h| of a tree; infinite for a polynomial that is not constant.
double height_bound(const HeightNode& node);

} // namespace ents
