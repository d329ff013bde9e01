// SPDX-License-Identifier: BSD-3-Clause
// What a mistyped word may have meant.
#pragma once

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

namespace host {

/// Levenshtein's distance: letters to change, add or leave out that turn one word into the other.
inline std::size_t edits(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row.back();
}

/// The known word next to this one. Empty: more than three letters or half of them differ, that is another
/// word.
inline std::string nearest_word(const std::string& word, const std::vector<std::string>& known) {
  std::string nearest;
  std::size_t least = 4;
  for (const std::string& candidate : known) {
    const std::size_t distance = edits(word, candidate);
    if (distance < least && 2 * distance <= candidate.size()) least = distance, nearest = candidate;
  }
  return nearest;
}

} // namespace host
