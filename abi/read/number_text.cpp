// SPDX-License-Identifier: BSD-3-Clause
#include "abi/read/number_text.hpp"

#include <charconv>
#include <system_error>

namespace ents {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Is a number outside the range of double a large one? Place of its first digit other than 0.
bool is_large(std::string_view digits) {
  long place = 0; // decimal exponent of the first non-zero digit
  bool found = false, fraction = false;
  std::size_t i = 0;
  for (; i < digits.size() && (is_digit(digits[i]) || digits[i] == '.'); ++i) {
    if (digits[i] == '.') {
      fraction = true;
    } else {
      found = found || digits[i] != '0';
      if (!fraction && found) ++place;
      if (fraction && !found) --place;
    }
  }
  if (i == digits.size()) return place > 0;
  ++i; // e
  const bool negative = i < digits.size() && digits[i] == '-';
  if (i < digits.size() && (digits[i] == '-' || digits[i] == '+')) ++i;
  long exponent = 0;
  const auto [end, error] = std::from_chars(digits.data() + i, digits.data() + digits.size(), exponent);
  if (error != std::errc()) return !negative; // more digits than any text has places
  return (negative ? -exponent : exponent) + place > 0;
}

} // namespace

NumberText read_number(std::string_view text, double& value) {
  const bool negative = !text.empty() && text[0] == '-';
  if (!text.empty() && (text[0] == '-' || text[0] == '+')) text.remove_prefix(1);
  // from_chars would also take "inf", "nan" and a second sign
  if (text.empty() || !(is_digit(text[0]) || (text[0] == '.' && text.size() > 1 && is_digit(text[1]))))
    return NumberText::not_a_number;

  double magnitude = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), magnitude);
  if (error == std::errc::invalid_argument || end != text.data() + text.size())
    return NumberText::not_a_number;
  if (error == std::errc::result_out_of_range) {
    if (is_large(text)) return NumberText::too_large;
    magnitude = 0.0;
  }
  value = negative ? -magnitude : magnitude;
  return NumberText::ok;
}

} // namespace ents
