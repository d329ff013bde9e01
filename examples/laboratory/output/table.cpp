// SPDX-License-Identifier: BSD-3-Clause
#include "table.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace host {
namespace {

std::string in_format(double value, std::chars_format format, int precision) {
  std::array<char, 400> buffer{}; // the longest fixed double has 309 digits before the point
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format, std::min(precision, 60)).ptr;
  return {buffer.data(), end};
}

/// floor(log10 |value|) after rounding to `digits`: 9.9996 with four digits is 10.00.
int exponent(double value, int digits) {
  const std::string text = in_format(std::abs(value), std::chars_format::scientific, digits - 1);
  const char* sign = text.data() + text.find('e') + 1;
  int power = 0;
  std::from_chars(sign + (*sign == '+'), text.data() + text.size(), power);
  return power;
}

/// How all numbers of a column are written.
struct Notation {
  std::chars_format format = std::chars_format::fixed;
  int precision = 0; ///< digits after the point
};

/// Fixed if that shows the largest number with `digits` significant digits (an integer with all of its own),
/// the smallest with at least half as many, and needs no long rows of zeros; else scientific.
Notation notation_for(const std::vector<double>& values, int digits) {
  int lowest = 1000, highest = -1000;
  for (const double value : values) {
    if (value == 0 || !std::isfinite(value)) continue;
    const int power = exponent(value, digits);
    lowest = std::min(lowest, power), highest = std::max(highest, power);
  }
  if (lowest > highest) return {std::chars_format::fixed, 0}; // nothing but zeros
  const int decimals = std::max({0, digits - 1 - highest, (digits + 1) / 2 - 1 - lowest});
  if (highest >= std::max(digits, 5) + 1 || decimals > digits + 2)
    return {std::chars_format::scientific, digits - 1};
  return {std::chars_format::fixed, decimals};
}

std::string written(double value, const Notation& notation) {
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  if (value == 0) return "0";
  return in_format(value, notation.format, notation.precision);
}

void pad(std::string& line, const std::string& text, int width, bool right) {
  const auto blanks = static_cast<std::size_t>(std::max(0, width - display_width(text)));
  line += right ? std::string(blanks, ' ') + text : text + std::string(blanks, ' ');
}

std::string trimmed(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

} // namespace

std::string format_number(double value, int digits) { return written(value, notation_for({value}, digits)); }

int display_width(const std::string& text) {
  int width = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if ((byte & 0xC0u) == 0x80u) continue; // continuation byte
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0u;
    const bool combining = byte == 0xCC || (byte == 0xCD && next < 0xB0); // U+0300 .. U+036F
    width += combining ? 0 : 1;
  }
  return width;
}

Table& Table::column(std::string title, std::string unit, int digits) {
  if (!rows_.empty()) throw std::invalid_argument("table: add column '" + title + "' before the first row");
  columns_.push_back({std::move(title), std::move(unit), std::clamp(digits, 1, 17)});
  return *this;
}

Table& Table::beside() {
  if (columns_.size() < 2) throw std::invalid_argument("table: no column stands before the last one");
  columns_.back().beside = true;
  return *this;
}

Table& Table::row(std::vector<Cell> cells) {
  if (cells.size() != columns_.size())
    throw std::invalid_argument("table: a row of " + std::to_string(cells.size()) + " cells for " +
                                std::to_string(columns_.size()) + " columns");
  rows_.push_back(std::move(cells));
  return *this;
}

std::vector<std::vector<std::string>> Table::formatted() const {
  std::vector<std::vector<std::string>> out(rows_.size(), std::vector<std::string>(columns_.size()));
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    std::vector<double> numbers;
    for (const auto& row : rows_)
      if (const double* value = std::get_if<double>(&row[c])) numbers.push_back(*value);
    const Notation notation = notation_for(numbers, columns_[c].digits);
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const Cell& cell = rows_[r][c];
      if (const auto* text = std::get_if<std::string>(&cell))
        out[r][c] = *text;
      else if (const auto* count = std::get_if<std::int64_t>(&cell))
        out[r][c] = std::to_string(*count);
      else if (const auto* value = std::get_if<double>(&cell))
        out[r][c] = written(*value, notation);
      else
        out[r][c] = '-';
    }
  }
  return out;
}

std::vector<std::vector<std::size_t>> Table::broken(const std::vector<int>& widths, int width) const {
  constexpr int between = 2;
  std::vector<std::vector<std::size_t>> parts;
  int used = 0;
  for (std::size_t c = columns_.empty() ? 0 : 1, end; c < columns_.size(); c = end) {
    int wanted = 0; // by this column and those that stay beside it
    for (end = c; end == c || (end < columns_.size() && columns_[end].beside); ++end)
      wanted += between + widths[end];
    if (parts.empty() || used + wanted > width) parts.push_back({0}), used = widths[0];
    for (std::size_t k = c; k < end; ++k) parts.back().push_back(k);
    used += wanted;
  }
  if (parts.empty() && !columns_.empty()) parts.push_back({0}); // a table of one column
  return parts;
}

std::string Table::text(int width) const {
  const auto cells = formatted();
  std::vector<int> widths;
  std::vector<char> right;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    widths.push_back(std::max(display_width(columns_[c].title), display_width(columns_[c].unit)));
    right.push_back(1);
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      widths[c] = std::max(widths[c], display_width(cells[r][c]));
      if (std::holds_alternative<std::string>(rows_[r][c])) right[c] = 0;
    }
  }
  std::string out;
  for (const std::vector<std::size_t>& part : broken(widths, width)) {
    const auto line = [&](auto&& cell_text) {
      std::string text;
      for (const std::size_t c : part) {
        if (c != part.front()) text += "  ";
        pad(text, cell_text(c), widths[c], right[c] != 0);
      }
      return trimmed(std::move(text));
    };
    const bool units =
        std::any_of(part.begin(), part.end(), [&](std::size_t c) { return !columns_[c].unit.empty(); });
    if (!out.empty()) out += "\n";
    out += line([&](std::size_t c) { return columns_[c].title; });
    if (units) out += line([&](std::size_t c) { return columns_[c].unit; });
    out += line([&](std::size_t c) {
      std::string rule;
      for (int i = 0; i < widths[c]; ++i) rule += "─";
      return rule;
    });
    for (const auto& row : cells) out += line([&](std::size_t c) { return row[c]; });
  }
  return out;
}

std::string Table::markdown() const {
  const auto escaped = [](const std::string& text) {
    std::string out;
    for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
    return out;
  };
  std::string out = "|", rule = "|";
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const Column& column = columns_[c];
    const bool text = std::any_of(rows_.begin(), rows_.end(),
                                  [&](auto& row) { return std::holds_alternative<std::string>(row[c]); });
    out += std::string(" ").append(escaped(column.title));
    if (!column.unit.empty()) out.append(" [").append(escaped(column.unit)) += "]";
    out += " |";
    rule += text ? "---|" : "---:|";
  }
  out += "\n" + rule + "\n";
  for (const auto& row : formatted()) {
    out += "|";
    for (const std::string& cell : row) out.append(" ").append(escaped(cell)) += " |";
    out += "\n";
  }
  return out;
}

} // namespace host
