// SPDX-License-Identifier: BSD-3-Clause
#include "abi/read/model_error.hpp"

namespace ents {

namespace {

// Bytes of the UTF-8 character at the start of `text`; 0 if there is none (Unicode 15, table 3-7).
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0) != 0x80) return 0;
  const unsigned char second = byte(1);
  if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
      (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F))
    return 0;
  return length;
}

std::string clean(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    const unsigned char first = static_cast<unsigned char>(text[0]);
    const bool control = first < 0x20 || first == 0x7F;
    if (length == 0 || control)
      result += '?';
    else
      result += text.substr(0, length);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return result;
}

} // namespace

std::string printable(std::string_view text, std::size_t longest) {
  if (text.size() <= longest) return clean(text);
  // Cut between characters: continuation bytes are 10xxxxxx.
  const auto inside = [&](std::size_t i) { return (static_cast<unsigned char>(text[i]) & 0xC0) == 0x80; };
  const std::size_t half = longest > 5 ? (longest - 5) / 2 : 0;
  std::size_t head = half, tail = text.size() - half;
  for (int i = 0; i < 3 && head > 0 && inside(head); ++i) --head;
  for (int i = 0; i < 3 && tail < text.size() && inside(tail); ++i) ++tail;
  return clean(text.substr(0, head)) + " ... " + clean(text.substr(tail));
}

std::string in_quotes(std::string_view text, std::size_t longest) {
  return '"' + printable(text, longest) + '"';
}

} // namespace ents
