// SPDX-License-Identifier: BSD-3-Clause
// One table, two looks: aligned text for the terminal and Markdown for a README.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace host {

class Table {
public:
  /// What a row holds: text, a count, a number, or nothing (monostate, shown as a dash; so is NaN).
  using Cell = std::variant<std::monostate, std::string, std::int64_t, double>;

  /// Add a column before the first row.
  /// @param title  "peak pressure"
  /// @param unit   second header line; "MPa", "%", may be empty
  /// @param digits significant digits of its numbers; the column picks fixed or scientific notation as a
  ///               whole so that numbers can be compared down the column
  Table& column(std::string title, std::string unit = "", int digits = 4);

  /// @throws std::invalid_argument if the number of cells is not the number of columns
  Table& row(std::vector<Cell> cells);

  /// Lines ending in '\n'; text left, numbers right.
  std::string text() const;
  std::string markdown() const;

private:
  struct Column {
    std::string title, unit;
    int digits;
  };
  std::vector<std::vector<std::string>> formatted() const;

  std::vector<Column> columns_;
  std::vector<std::vector<Cell>> rows_;
};

/// A number with `digits` significant digits: fixed for 1e-3 <= |value| < 10^(max(digits, 5) + 1), else as
/// 1.23e-07. Locale independent.
std::string format_number(double value, int digits = 4);

/// Columns a terminal needs for UTF-8 text: code points, combining marks not counted.
int display_width(const std::string& text);

} // namespace host
