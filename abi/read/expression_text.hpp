// SPDX-License-Identifier: BSD-3-Clause
// Text of a height as an expression of the surface coordinates, like "a*sin(2*pi*u)*exp(-v^2)", to a height
// function.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/height/height_tree.hpp"

namespace ents {

struct NamedNumber {
  std::string name;
  double value;
};

struct ExpressionNames {
  std::int32_t dimension; // surface coordinates u, or u and v
  std::vector<NamedNumber> constants;
  std::vector<NamedNumber> parameters; // ExternalHeight::values has them first, in this order
};

// May a constant or parameter have this name? Else why not.
bool is_expression_name(std::string_view name, std::string& reason);

// Throws a ModelError that begins with `path` and tells the column where the text cannot be understood and
// what was expected there. feature_length: of Height::feature_length(); infinite entries are estimated.
Height read_expression(std::string_view text, const std::string& path, const ExpressionNames& names,
                       const double (&feature_length)[2]);

} // namespace ents
