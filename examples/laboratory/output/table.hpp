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
  /// No line of a table that a program prints is longer, in columns of a terminal.
  static constexpr int terminal_width = 120;

  /// What a row holds: text, a count, a number, or nothing (monostate, shown as a dash; so is NaN).
  using Cell = std::variant<std::monostate, std::string, std::int64_t, double>;

  /// Add a column before the first row.
  /// @param title  "peak pressure"
  /// @param unit   second header line; "MPa", "%", may be empty
  /// @param digits significant digits of its numbers; the column picks fixed or scientific notation as a
  ///               whole so that numbers can be compared down the column
  Table& column(std::string title, std::string unit = "", int digits = 4);

  /// Keep the column that was added last on the same lines as the one before it, where text() breaks the
  /// table.
  Table& beside();

  /// @throws std::invalid_argument if the number of cells is not the number of columns
  Table& row(std::vector<Cell> cells);

  /// Lines ending in '\n'; text left, numbers right. Columns that do not fit into `width` follow in further
  /// tables below, each of which begins with the first column and is wider only if two columns need more.
  std::string text(int width = terminal_width) const;
  std::string markdown() const;

private:
  struct Column {
    std::string title, unit;
    int digits;
    bool beside = false; ///< stays with the column before it
  };
  std::vector<std::vector<std::string>> formatted() const;
  /// The columns of each table that text() prints: the first one, and those that fit beside it.
  std::vector<std::vector<std::size_t>> broken(const std::vector<int>& widths, int width) const;

  std::vector<Column> columns_;
  std::vector<std::vector<Cell>> rows_;
};

/// A number with `digits` significant digits: fixed for 1e-3 <= |value| < 10^(max(digits, 5) + 1), else as
/// 1.23e-07. Locale independent.
std::string format_number(double value, int digits = 4);

/// Columns a terminal needs for UTF-8 text: code points, combining marks not counted.
int display_width(const std::string& text);

} // namespace host
