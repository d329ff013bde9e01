// SPDX-License-Identifier: BSD-3-Clause
// Arguments of the command line: ranges, lists, and what is wrong with a word.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "nearest_word.hpp"
#include "toolbox/error.hpp"

namespace host {

// CLI11's own ranges print their bounds with 300 digits and accept what is no number.
inline CLI::Validator number_check(const std::string& wanted, const std::function<bool(double)>& good) {
  return CLI::Validator(
      [=](const std::string& text) {
        double value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool number = error == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
        return number && good(value) ? std::string() : wanted + " is expected, this is \"" + text + "\"";
      },
      "");
}

inline CLI::Validator positive() {
  return number_check("a number > 0", [](double value) { return value > 0; });
}

inline CLI::Validator integer(std::int64_t low, std::int64_t high) {
  return number_check("an integer from " + std::to_string(low) + " to " + std::to_string(high),
                      [=](double value) {
                        return value == std::floor(value) && value >= static_cast<double>(low) &&
                               value <= static_cast<double>(high);
                      });
}

inline constexpr const char* own_list = "own"; // of the scene

/// Does a word after --compare belong to it? A scene may stand there, too.
inline bool is_list(const std::string& word) {
  return !word.empty() && word.find_first_not_of("0123456789,") == std::string::npos;
}

/// Arguments in the order in which CLI11 wants them, the last first.
inline std::vector<std::string> arguments(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  for (std::size_t i = 0; i < words.size(); ++i)
    if (words[i] == "--compare" && (i + 1 == words.size() || !is_list(words[i + 1])))
      words[i] += std::string("=") + own_list;
  std::reverse(words.begin(), words.end());
  return words;
}

inline std::vector<int> divisions_of(const std::string& list) {
  std::vector<int> divisions;
  std::istringstream words(list);
  for (std::string word; list != own_list && std::getline(words, word, ',');) {
    int n = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), n);
    if (error != std::errc{} || end != word.data() + word.size() || n < 1 || n > 100000)
      throw InputError(
          "--compare: integers from 1 to 100000 with commas between them are expected, this is \"" + list +
          "\"");
    divisions.push_back(n);
  }
  return divisions;
}

/// What stands where no argument is expected, an option first; else what is wrong with those that are.
inline std::string parse_error(const CLI::App& command, const CLI::ParseError& error) {
  const std::vector<std::string> rest = command.remaining();
  const auto option =
      std::find_if(rest.begin(), rest.end(), [](const std::string& word) { return word.starts_with('-'); });
  if (option == rest.end()) {
    if (!rest.empty()) return "unexpected argument \"" + rest.front() + "\"";
    return error.what();
  }
  const std::string word = option->substr(0, option->find('='));
  std::vector<std::string> known;
  for (const CLI::Option* each : command.get_options())
    for (const std::string& name : each->get_lnames()) known.push_back("--" + name);
  const std::string near = nearest_word(word, known);
  return "unknown option " + word + (near.empty() ? "" : "; did you mean " + near + "?");
}

} // namespace host
