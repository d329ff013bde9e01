// SPDX-License-Identifier: BSD-3-Clause
// Decimal text to double: correctly rounded, whatever the process's locale.
#pragma once

#include <string_view>

namespace ents {

enum class NumberText { ok, not_a_number, too_large };

// The whole of `text` must be a decimal number: 12, -0.5, +.5, 1.8823e-008. No blanks, no NaN, no infinity.
// Too small for a double is 0; `value` is only written when ok.
NumberText read_number(std::string_view text, double& value);

} // namespace ents
