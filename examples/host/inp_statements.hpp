// SPDX-License-Identifier: BSD-3-Clause
// The lines of an .inp deck as statements: a keyword with its parameters and the data lines below it,
// comments dropped, continued keyword lines joined, *INCLUDE carried out. What the keywords mean is inp.cpp's
// matter.
#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace host::inp {

/// A position, for messages; `file` indexes Statements::files.
struct Place {
  int file = 0, line = 0;
};

struct Line {
  std::string_view text; ///< without blanks at its ends
  Place place;
};

struct Statement {
  std::string keyword; ///< upper case, without the asterisk, single blanks: "NODE", "SURFACE BEHAVIOR"
  std::vector<std::pair<std::string, std::string>> parameters; ///< name in upper case, value as written
  std::vector<Line> lines;
  Place place;
};

struct Statements {
  std::vector<std::string> files;
  std::vector<Statement> list;
  std::deque<std::string> texts; ///< what the lines point into; a deque does not move its elements
};

/// @throws Error for a file that cannot be opened, data before the first keyword, a circular *INCLUDE
Statements statements_of_file(const std::filesystem::path& file);
Statements statements_of_text(std::string_view text, const std::string& name,
                              const std::filesystem::path& folder);

/// Throw an Error "FILE:LINE: what".
[[noreturn]] void fail(const std::vector<std::string>& files, Place place, const std::string& what);

std::string upper(std::string_view text);

/// Comma-separated fields without blanks at their ends; an empty one behind a last comma is not counted.
std::vector<std::string_view> fields_of(std::string_view line);

} // namespace host::inp
