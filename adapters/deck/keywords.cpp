// SPDX-License-Identifier: BSD-3-Clause
#include "keywords.hpp"

#include <algorithm>

namespace ents_deck {
namespace {

using std::string;

/// Fewest letters to put in, take out or change.
std::size_t distance(const string& a, const string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t other = std::min(row[j], row[j - 1]) + 1;
      row[j] = std::min(other, std::exchange(diagonal, row[j]) + (a[i - 1] == b[j - 1] ? 0 : 1));
    }
  }
  return row[b.size()];
}

constexpr std::size_t shortest_keyword = 4, shortest_parameter = 3;

/// Abaqus takes "*FRIC" for *FRICTION and "GEN" for GENERATE.
bool abbreviates(const string& found, const string& name, std::size_t shortest) {
  return found.size() >= shortest && found.size() < name.size() && name.starts_with(found);
}

/// A keyword of the table that `found` may be meant for. ccx itself takes "*FRICTIONS" for *FRICTION, and passes over
/// "*FRICTON" with a warning.
const KeywordRule* meant(const std::vector<KeywordRule>& rules, const string& found) {
  if (has_known_spelling(found)) return nullptr;
  const string plain = canonical(found);
  for (const KeywordRule& rule : rules) {
    const string name = canonical(rule.name);
    const bool is_long = name.size() >= 8;
    if (abbreviates(plain, name, shortest_keyword)) return &rule;
    if ((is_long && plain.starts_with(name)) || distance(plain, name) <= (is_long ? 2U : 1U)) return &rule;
  }
  return nullptr;
}

std::vector<string> words_of(const string& values) {
  std::vector<string> out;
  for (std::size_t start = 0; start <= values.size();) {
    const std::size_t end = std::min(values.find('|', start), values.size());
    out.push_back(values.substr(start, end - start));
    start = end + 1;
  }
  return out;
}

string listed(const std::vector<string>& words) {
  string out;
  for (const string& word : words)
    if (!word.empty()) out += (out.empty() ? "" : ", ") + word;
  return out;
}

class Check {
public:
  Check(const Source& source, Program program) : source_(source), rules_(keyword_rules(program)) {}

  void statement(const Statement& s, bool of_pair) const {
    const auto rule =
        std::find_if(rules_.begin(), rules_.end(), [&](const KeywordRule& r) { return r.name == s.keyword; });
    if (rule == rules_.end()) {
      if (const KeywordRule* other = meant(rules_, s.keyword))
        source_.fail(s.place, "*" + s.keyword + " is no keyword; is *" + other->name + " meant?");
      return;
    }
    if (rule->of_pair != of_pair) return;
    if (rule->use == Use::refused) source_.fail(s.place, "*" + s.keyword + ": " + rule->why);
    for (std::size_t i = 0; i < s.parameters.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k)
        if (s.parameters[k].first == s.parameters[i].first)
          source_.fail(s.place, "*" + s.keyword + " has " + s.parameters[i].first + " twice; leave one out");
      parameter(s, *rule, s.parameters[i].first, s.parameters[i].second);
    }
    if (rule->columns.empty()) return;
    for (std::size_t i = 0; i < s.lines.size(); ++i) {
      columns(s, *rule, s.lines[i]);
      if (static_cast<int>(i) >= rule->most_lines && !is_blank(s.lines[i]))
        source_.fail(s.lines[i].place, "*" + s.keyword +
                                           " has more than one data line, and no contact element has a "
                                           "table of it; write one line");
    }
  }

  string without_effect(const Statement& s) const {
    for (const KeywordRule& rule : rules_)
      if (rule.name == s.keyword && rule.use == Use::no_effect)
        return "*" + s.keyword + " (" + source_.at(s.place) + "): " + rule.why;
    return "";
  }

  std::vector<string> remarks(const Statement& s) const {
    std::vector<string> out;
    for (const KeywordRule& rule : rules_)
      for (std::size_t i = 0; rule.name == s.keyword && i < s.parameters.size(); ++i) {
        const ParameterRule* found = rule_of(rule, s.parameters[i].first);
        if (found && found->use == Use::no_effect && !found->why.empty())
          out.push_back(found->name + " (" + source_.at(s.place) + "): " + found->why);
      }
    return out;
  }

private:
  const Source& source_;
  const std::vector<KeywordRule>& rules_;

  static const ParameterRule* rule_of(const KeywordRule& rule, const string& name) {
    const ParameterRule* found = nullptr;
    for (const ParameterRule& p : rule.parameters)
      if (canonical(p.name) == name || (p.name == "*" && !found)) found = &p;
    return found;
  }

  static bool is_blank(const Line& line) {
    const auto fields = fields_of(line.text);
    return std::all_of(fields.begin(), fields.end(), [](const auto field) { return field.empty(); });
  }

  void parameter(const Statement& s, const KeywordRule& rule, const string& name, const string& value) const {
    const ParameterRule* found = rule_of(rule, name);
    const string what = "*" + s.keyword + ", " + (found && found->name != "*" ? found->name : name);
    if (!found) {
      std::vector<string> names;
      for (const ParameterRule& p : rule.parameters)
        if (p.use != Use::refused) names.push_back(p.name);
      source_.fail(s.place, what + " is not known, and what it changes would be lost; " +
                                (names.empty() ? "*" + s.keyword + " has no parameters"
                                               : "known are " + listed(names)) +
                                ": correct it or leave it out");
    }
    for (const ParameterRule& p : rule.parameters)
      if (found->name == "*" && (abbreviates(name, canonical(p.name), shortest_parameter) ||
                                 (p.name.size() >= 5 && distance(name, canonical(p.name)) <= 2)))
        source_.fail(s.place, what + " is not known; is " + p.name + " meant?");
    if (found->use == Use::refused) source_.fail(s.place, what + ": " + found->why);
    if (found->values == "*" && found->name != "*" && value.empty())
      source_.fail(s.place, what + "= has no value; write one");
    if (found->values == "*") return;
    const bool others = found->values.starts_with('!');
    const auto words = words_of(found->values.substr(others ? 1 : 0));
    if (others != std::any_of(words.begin(), words.end(),
                              [&](const string& w) { return canonical(w) == canonical(value); }))
      return;
    if (found->values.empty())
      source_.fail(s.place, what + " has no value; write it without '=" + value + "'");
    source_.fail(s.place,
                 what + "=" + value +
                     (found->why.empty() ? " is not known; expected " + listed(words) : ": " + found->why));
  }

  void columns(const Statement& s, const KeywordRule& rule, const Line& line) const {
    const auto fields = fields_of(line.text);
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (fields[i].empty()) continue;
      if (i >= rule.columns.size())
        source_.fail(line.place, "*" + s.keyword + " has an entry " + std::to_string(i + 1) + ", '" +
                                     string(fields[i]) + "', which means nothing here; known are " +
                                     known(rule) + ": leave it out");
      const ColumnRule& column = rule.columns[i];
      double value = 0, allowed = 0;
      if (column.use != Use::refused || (!column.only.empty() && parse(fields[i], value) &&
                                         parse(column.only, allowed) && value == allowed))
        continue;
      source_.fail(line.place, "*" + s.keyword + ", " + column.name + " (entry " + std::to_string(i + 1) +
                                   "), '" + string(fields[i]) + "': " + column.why);
    }
  }

  static string known(const KeywordRule& rule) {
    std::vector<string> names;
    for (const ColumnRule& c : rule.columns) names.push_back(c.name);
    return listed(names);
  }
};

} // namespace

std::vector<string> check_keywords(const Source& source, Program program) {
  const Check check(source, program);
  std::vector<string> out;
  for (const Statement& s : source.list) {
    check.statement(s, false);
    if (const string what = check.without_effect(s); !what.empty()) out.push_back(what);
  }
  return out;
}

std::vector<string> check_statement(const Source& source, const Statement& statement, Program program) {
  const Check check(source, program);
  check.statement(statement, true);
  return check.remarks(statement);
}

} // namespace ents_deck
