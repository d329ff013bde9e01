// SPDX-License-Identifier: BSD-3-Clause
#include "inp_statements.hpp"

#include "inp.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

namespace host::inp {
namespace {

using Path = std::filesystem::path;

std::string_view trimmed(std::string_view text) { // '\r': decks from Windows
  const auto first = text.find_first_not_of(" \t\r");
  return first == text.npos ? std::string_view{}
                            : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string unquoted(std::string_view text) {
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  return std::string(text);
}

Statement keyword_line(std::string_view text, Place place) {
  const auto fields = fields_of(text);
  Statement out;
  out.place = place;
  std::istringstream words(upper(fields[0].substr(1)));
  for (std::string word; words >> word;) out.keyword += (out.keyword.empty() ? "" : " ") + word;
  for (std::size_t i = 1; i < fields.size(); ++i) {
    const std::size_t equal = std::min(fields[i].find('='), fields[i].size());
    const std::size_t value = std::min(equal + 1, fields[i].size());
    out.parameters.emplace_back(upper(trimmed(fields[i].substr(0, equal))),
                                unquoted(trimmed(fields[i].substr(value))));
  }
  return out;
}

std::optional<std::string> content_of(const Path& file) {
  std::error_code ignored;
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file, ignored)) return std::nullopt;
  return std::string{std::istreambuf_iterator<char>(stream), {}}; // an empty file is one, too
}

void add_text(Statements& out, const std::string& name, const Path& folder, std::vector<Path>& open);

void include(Statements& out, const Statement& statement, const Path& folder, std::vector<Path>& open) {
  std::string input;
  for (const auto& [key, value] : statement.parameters) {
    if (key != "INPUT")
      fail(out.files, statement.place, "*INCLUDE has the parameter " + key + "; expected INPUT=file");
    input = value;
  }
  if (input.empty()) fail(out.files, statement.place, "expected *INCLUDE, INPUT=file");
  const Path file = (folder / input).lexically_normal();
  if (std::find(open.begin(), open.end(), file) != open.end())
    fail(out.files, statement.place, "*INCLUDE: " + file.string() + " includes itself");
  auto text = content_of(file);
  if (!text) fail(out.files, statement.place, "*INCLUDE: cannot read " + file.string());
  out.texts.push_back(std::move(*text));
  open.push_back(file);
  add_text(out, file.string(), file.parent_path(), open);
  open.pop_back();
}

/// Statements of the last text in `out`, called `name`. An included file may go on with the data of the
/// keyword before.
void add_text(Statements& out, const std::string& name, const Path& folder, std::vector<Path>& open) {
  const std::string_view text = out.texts.back();
  Place place{static_cast<int>(out.files.size()), 0};
  out.files.push_back(name);
  std::string begun; // a keyword line that ends in a comma goes on
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const std::string_view line = trimmed(text.substr(start, end - start));
    start = end + 1;
    ++place.line;
    if (line.empty() || line.starts_with("**")) continue;
    if (begun.empty() && !line.starts_with('*')) {
      if (out.list.empty())
        fail(out.files, place, "data before the first keyword; expected a line that starts with *");
      out.list.back().lines.push_back({line, place});
      continue;
    }
    begun += line;
    if (begun.ends_with(',')) continue;
    Statement statement = keyword_line(begun, place);
    begun.clear();
    if (statement.keyword == "INCLUDE")
      include(out, statement, folder, open);
    else
      out.list.push_back(std::move(statement));
  }
  if (!begun.empty()) fail(out.files, place, "the file ends inside the keyword line '" + begun + "'");
}

} // namespace

void fail(const std::vector<std::string>& files, Place place, const std::string& what) {
  throw Error(files.at(static_cast<std::size_t>(place.file)) + ":" + std::to_string(place.line) + ": " +
              what);
}

std::string upper(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return out;
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> out;
  for (std::size_t start = 0; start <= line.size();) {
    const std::size_t comma = std::min(line.find(',', start), line.size());
    out.push_back(trimmed(line.substr(start, comma - start)));
    start = comma + 1;
  }
  if (out.size() > 1 && out.back().empty()) out.pop_back();
  return out;
}

Statements statements_of_text(std::string_view text, const std::string& name, const Path& folder) {
  Statements out;
  out.texts.emplace_back(text);
  std::vector<Path> open{(folder / name).lexically_normal()};
  add_text(out, name, folder, open);
  return out;
}

Statements statements_of_file(const Path& file) {
  auto text = content_of(file);
  if (!text) throw Error(file.string() + ": cannot be read (does it exist? is it a file?)");
  Statements out;
  out.texts.push_back(std::move(*text));
  std::vector<Path> open{file.lexically_normal()};
  add_text(out, file.string(), file.parent_path(), open);
  return out;
}

} // namespace host::inp
