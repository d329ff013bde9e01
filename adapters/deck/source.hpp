// SPDX-License-Identifier: BSD-3-Clause
// The text of an .inp deck (Abaqus, CalculiX): its files byte for byte, and its lines as statements, which
// are a keyword with its parameters and the data lines below it. Comments are dropped, continued keyword
// lines joined, *INCLUDE is carried out. What the keywords mean is not decided here.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ents_deck {

/// "FILE:LINE: what is wrong, what is expected".
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A line of a deck; `file` counts Source::files from 0, `line` the lines of that file from 1.
struct Place {
  int file = 0, line = 0;
};

struct Line {
  std::string_view text; ///< without blanks at its ends
  Place place;
};

struct Statement {
  std::string
      keyword; ///< upper case, without the asterisk, as spelled() spells it: "NODE", "SURFACE BEHAVIOR"
  std::vector<std::pair<std::string, std::string>> parameters; ///< canonical name, value as written
  std::vector<Line> lines;                                     ///< data lines
  Place place;                                                 ///< first line of the keyword
  int last_line = 0; ///< last line of the keyword: larger than place.line if it is continued

  /// Value of a parameter as written, "" if it is absent or has no value. Names are compared without blanks.
  std::string value(std::string_view name) const;
  bool has(std::string_view name) const;
};

struct File {
  std::string name;           ///< as in messages
  std::filesystem::path path; ///< empty for text that comes from memory
  std::string_view text;      ///< all bytes
};

/// Limits: a deck beyond them is refused with a message. They keep a deck of a few lines that includes itself
/// many times, or a device, from filling the memory.
inline constexpr std::uintmax_t largest_text = std::uintmax_t{1} << 32; ///< bytes of all files
inline constexpr int largest_file_count = 10000;
inline constexpr int deepest_include = 32;

struct Source {
  std::vector<File> files;         ///< the deck, then what it includes, in the order of reading
  std::vector<Statement> list;     ///< all statements but *INCLUDE
  std::vector<Statement> includes; ///< the *INCLUDE statements; file i + 1 is what includes[i] reads
  std::deque<std::string> texts;   ///< what views point into; a deque does not move its elements

  /// @throws Error "FILE:LINE: what"
  [[noreturn]] void fail(Place place, const std::string& what) const;
  std::string at(Place place) const; ///< "FILE:LINE"
};

/// @throws Error for a file that cannot be read, data before the first keyword, a circular *INCLUDE, a limit
Source read_source(const std::filesystem::path& file);
/// The same from memory; `name` stands for the file in messages, includes start at `folder`.
Source read_source_text(std::string_view text, const std::string& name, const std::filesystem::path& folder);

/// How host programs compare keywords, parameters, values and names: in upper case, without blanks and without
/// quotation marks around them.
std::string canonical(std::string_view text);

/// A keyword in upper case with the blanks of the manuals where they are known: "CONTACTPAIR" is "CONTACT PAIR".
/// Others keep single blanks where they have some.
std::string spelled(std::string_view keyword);
/// Is it one of the keywords of several words that the manuals have?
bool has_known_spelling(std::string_view keyword);

std::string_view trimmed(std::string_view text);

/// Comma-separated fields without blanks at their ends; an empty one behind a last comma is not counted.
std::vector<std::string_view> fields_of(std::string_view line);

/// A whole number, or a real one (Fortran's 1.5D+00, too), blanks inside left out as ccx does; false: it is none,
/// or not finite.
bool parse(std::string_view text, std::int64_t& value);
bool parse(std::string_view text, double& value);
/// Entry i of a data line as a number. @return `otherwise` if it is empty; with none, that is an error
double entry(const Source& source, const Line& line, std::size_t i, std::optional<double> otherwise = {});

/// With so many significant digits, for people.
std::string shown(double value, int digits = 4);

} // namespace ents_deck
