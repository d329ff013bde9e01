// SPDX-License-Identifier: BSD-3-Clause
// What the library says that a model needs (ents_layout.needs), in words.
#pragma once

#include "ents_library.hpp"
#include "toolbox/json_reader.hpp"

namespace host {

/// "this scene needs: ...", "it does not need: ..." (unless it needs all), each thing with its why, and
/// "kernels: ...": three lines.
/// @param law  has the model one of contact? Without, it is a surface, and nothing says what its elements
///             will take
std::string describe_needs(const ents_layout& layout, bool law);

/// {"needs": [..], "does_not_need": [..], "instruction_set": ".."}; names are those of the bits, in small
/// letters. "instruction_set" is null without a law.
Json needs_json(const ents_layout& layout, bool law);

} // namespace host
