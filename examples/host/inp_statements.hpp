// SPDX-License-Identifier: BSD-3-Clause
// The lines of an .inp deck as statements, from the reader that ents-deck has, too. What the keywords mean is
// inp.cpp's matter.
#pragma once

#include "deck/source.hpp"

#include "inp.hpp"

namespace host::inp {

using ents_deck::canonical;
using ents_deck::fields_of;
using ents_deck::Line;
using ents_deck::Place;
using ents_deck::Source;
using ents_deck::Statement;

/// Throw an Error "FILE:LINE: what".
[[noreturn]] inline void fail(const std::vector<std::string>& files, Place place, const std::string& what) {
  throw Error(files.at(static_cast<std::size_t>(place.file)) + ":" + std::to_string(place.line) + ": " +
              what);
}

} // namespace host::inp
