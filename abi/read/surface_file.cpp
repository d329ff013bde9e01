// SPDX-License-Identifier: BSD-3-Clause
#include "abi/read/surface_file.hpp"

#include <array>
#include <optional>
#include <string>

#include "abi/read/model_error.hpp"
#include "abi/read/number_text.hpp"
#include "abi/read/text_file.hpp"

namespace ents {

namespace {

struct LengthUnit {
  std::string_view name;
  double metres;
};

// The micro sign comes as U+00B5, as Greek mu U+03BC, as Latin-1 byte, and as u.
constexpr std::array<LengthUnit, 13> length_units = {{{"m", 1.0},
                                                      {"dm", 1e-1},
                                                      {"cm", 1e-2},
                                                      {"mm", 1e-3},
                                                      {"\xC2\xB5m", 1e-6},
                                                      {"\xCE\xBCm", 1e-6},
                                                      {"\xB5m", 1e-6},
                                                      {"um", 1e-6},
                                                      {"nm", 1e-9},
                                                      {"pm", 1e-12},
                                                      {"fm", 1e-15},
                                                      {"\xC3\x85", 1e-10},
                                                      {"km", 1e3}}};

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

class Parser {
public:
  Parser(std::string_view text, std::string_view name) : text_(text), name_(name) {}

  SurfaceFile parse() {
    if (text_.find('\0') != std::string_view::npos)
      throw ModelError(ENTS_FILE, printable(name_) + ": holds zero bytes, so it is not a text file; export "
                                                     "the heights as text (one line per row)");
    if (text_.substr(0, 3) == "\xEF\xBB\xBF") text_.remove_prefix(3);
    while (!text_.empty()) {
      const std::size_t end = text_.find('\n');
      const std::string_view line = trimmed(text_.substr(0, end));
      text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
      ++line_;
      if (line.empty()) continue;
      if (line.front() == '#')
        read_header(line.substr(1));
      else
        read_row(line);
    }
    if (surface_.rows == 0) throw ModelError(ENTS_FILE, printable(name_) + ": holds no numbers");
    const int stated = int(width_.has_value()) + int(height_.has_value()) + int(value_unit_.has_value());
    if (stated > 0 && stated < 3)
      throw ModelError(ENTS_FILE, printable(name_) + ": the header states some but not all of \"# Width:\", "
                                                     "\"# Height:\" and \"# Value units:\"");
    if (stated == 3) {
      surface_.states_units = true;
      surface_.width = *width_;
      surface_.height = *height_;
      surface_.value_unit = *value_unit_;
    }
    return std::move(surface_);
  }

private:
  [[noreturn]] void fail_line(const std::string& message, std::int64_t column = 0) const {
    std::string place = printable(name_) + ", line " + std::to_string(line_);
    if (column > 0) place += ", column " + std::to_string(column);
    throw ModelError(ENTS_FILE, place + ": " + message);
  }

  double length_unit(std::string_view name) const {
    for (const LengthUnit& unit : length_units)
      if (unit.name == name) return unit.metres;
    fail_line(in_quotes(name) +
              " is not a unit of length; write m, dm, cm, mm, um, nm, pm, fm, km or Angstrom (\xC3\x85)");
  }

  double length(std::string_view text) const {
    std::size_t end = 0;
    while (end < text.size() &&
           std::string_view("+-.,0123456789eE").find(text[end]) != std::string_view::npos)
      ++end;
    double number = 0.0;
    if (read_number(text.substr(0, end), number) != NumberText::ok || !(number > 0.0))
      fail_line(in_quotes(text) + " is not a length; write a positive number and a unit, like \"10.00 um\"");
    return number * length_unit(trimmed(text.substr(end)));
  }

  void read_header(std::string_view line) {
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) return;
    const std::string_view key = trimmed(line.substr(0, colon)), value = trimmed(line.substr(colon + 1));
    std::optional<double>* target = nullptr;
    if (key == "Width") target = &width_;
    if (key == "Height") target = &height_;
    if (key == "Value units") target = &value_unit_;
    if (target == nullptr) return;
    if (target->has_value()) fail_line(in_quotes(key) + " is stated twice; give a file with one channel");
    *target = target == &value_unit_ ? length_unit(value) : length(value);
  }

  void choose_separator(std::string_view line) {
    if (line.find(';') != std::string_view::npos)
      separator_ = ';';
    else if (line.find(',') != std::string_view::npos && line.find('\t') == std::string_view::npos)
      separator_ = ',';
    else
      separator_ = ' ';
  }

  void read_row(std::string_view line) {
    if (surface_.rows == 0) choose_separator(line);
    std::int64_t column = 0;
    for (bool more = true; more;) {
      std::string_view field;
      if (separator_ == ' ') {
        std::size_t end = 0;
        while (end < line.size() && !is_blank(line[end])) ++end;
        field = line.substr(0, end);
        line = trimmed(line.substr(end));
        more = !line.empty();
      } else {
        const std::size_t end = line.find(separator_);
        field = trimmed(line.substr(0, end));
        more = end != std::string_view::npos;
        line.remove_prefix(more ? end + 1 : line.size());
      }
      add(field, ++column);
    }
    if (surface_.rows == 0) {
      surface_.columns = column;
      first_row_line_ = line_;
    } else if (column != surface_.columns) {
      fail_line("holds " + std::to_string(column) + (column == 1 ? " number" : " numbers") + ", but line " +
                std::to_string(first_row_line_) + " holds " + std::to_string(surface_.columns) +
                "; all rows have the same length");
    }
    ++surface_.rows;
  }

  void add(std::string_view field, std::int64_t column) {
    double value = 0.0;
    switch (read_number(field, value)) {
    case NumberText::ok:
      break;
    case NumberText::too_large:
      fail_line(in_quotes(field) + " is outside the range of double precision", column);
    case NumberText::not_a_number:
      if (field.empty())
        fail_line("a number is missing between two separators, or after the last one", column);
      if (field.find(',') != std::string_view::npos)
        fail_line(in_quotes(field) + " is not a number; export the file with decimal points, not commas",
                  column);
      fail_line(in_quotes(field) + " is not a number", column);
    }
    if (static_cast<std::int64_t>(surface_.values.size()) == most_map_samples)
      fail_line("more than " + std::to_string(most_map_samples) + " samples; give a smaller map", column);
    surface_.values.push_back(value);
  }

  std::string_view text_;
  std::string_view name_;
  SurfaceFile surface_;
  std::int64_t line_ = 0;
  std::int64_t first_row_line_ = 0;
  char separator_ = ' ';
  std::optional<double> width_, height_, value_unit_;
};

} // namespace

SurfaceFile parse_surface(std::string_view text, std::string_view name) { return Parser(text, name).parse(); }

SurfaceFile read_surface_file(const std::filesystem::path& path) {
  return parse_surface(read_text_file(path, largest_surface_file), display_name(path));
}

} // namespace ents
