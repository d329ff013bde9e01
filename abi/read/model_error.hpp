// SPDX-License-Identifier: BSD-3-Clause
// What reading a model throws; the entry point catches it and turns it into a status and a report.
#pragma once

#include <cstdint>
#include <exception>
#include <string>
#include <string_view>
#include <utility>

#include "abi/ents.h"

namespace ents {

struct ModelError : std::exception {
  ModelError(std::int32_t status_value, std::string text) : status(status_value), message(std::move(text)) {}
  const char* what() const noexcept override { return message.c_str(); }

  std::int32_t status; // negative, see ENTS_STATUS_TABLE
  std::string message; // UTF-8 without control characters
};

// `text` as it may stand in a message: valid UTF-8, no control characters ('?' instead), at most
// `longest` bytes, the middle left out.
std::string printable(std::string_view text, std::size_t longest = 60);

// The same between double quotes.
std::string in_quotes(std::string_view text, std::size_t longest = 60);

} // namespace ents
