// SPDX-License-Identifier: BSD-3-Clause
#include "source.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

namespace ents_deck {
namespace {

using Path = std::filesystem::path;

std::string unquoted(std::string_view text) {
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  return std::string(text);
}

Statement keyword_line(std::string_view text, Place place, int last_line) {
  const auto fields = fields_of(text);
  Statement out;
  out.place = place;
  out.last_line = last_line;
  out.keyword = spelled(fields[0].substr(1));
  for (std::size_t i = 1; i < fields.size(); ++i) {
    const std::size_t equal = std::min(fields[i].find('='), fields[i].size());
    const std::size_t value = std::min(equal + 1, fields[i].size());
    std::string name = canonical(fields[i].substr(0, equal));
    if (!name.empty())
      out.parameters.emplace_back(std::move(name), unquoted(trimmed(fields[i].substr(value))));
  }
  return out;
}

/// Two asterisks, between which ccx takes blanks.
bool is_comment(std::string_view line) {
  return line.starts_with('*') && trimmed(line.substr(1)).starts_with('*');
}

class Reader {
public:
  Source out;

  /// @param who  "FILE:LINE: *INCLUDE: " of what asks for the file, or ""
  void file(const Path& path, const std::string& name, const std::string& who) {
    const auto cannot = [&](const std::string& why) {
      return Error(who + name + ": cannot be read: " + why);
    };
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (error || !std::filesystem::exists(status)) throw cannot("it does not exist");
    if (!std::filesystem::is_regular_file(status))
      throw cannot("it is a folder or a device; a deck is an ordinary file");
    const auto size = std::filesystem::file_size(path, error);
    if (!error && size > largest_text - total_) too_long(who + name);
    std::ifstream stream(path, std::ios::binary);
    std::string text;
    if (stream) text.assign(std::istreambuf_iterator<char>(stream), {});
    if (!stream.is_open() || stream.bad()) throw cannot("may you read it?");
    text_of(std::move(text), name, path, path.parent_path(), who + name);
  }

  void text_of(std::string text, const std::string& name, const Path& path, const Path& folder,
               const std::string& who) {
    total_ += text.size();
    if (total_ > largest_text) too_long(who);
    check_encoding(text, who);
    if (out.files.size() >= static_cast<std::size_t>(largest_file_count))
      throw Error(who + ": the deck includes more than " + std::to_string(largest_file_count) + " files");
    out.texts.push_back(std::move(text));
    out.files.push_back({name, path, out.texts.back()});
    open_.push_back(path.empty() ? (folder / name).lexically_normal() : path.lexically_normal());
    statements(static_cast<int>(out.files.size()) - 1, folder);
    open_.pop_back();
  }

private:
  std::uintmax_t total_ = 0;
  std::vector<Path> open_;

  [[noreturn]] static void too_long(const std::string& who) {
    throw Error(who + ": the deck and what it includes have more than " + std::to_string(largest_text) +
                " bytes");
  }

  /// Host programs read bytes, a character each; a mark of UTF-8 at the begin is left out, in the written deck, too.
  static void check_encoding(std::string& text, const std::string& who) {
    using namespace std::string_view_literals;
    if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF") ||
        std::string_view(text).substr(0, 256).find("\0"sv) != std::string_view::npos)
      throw Error(
          who + ": the file is in UTF-16 (or is no text); decks are ASCII or UTF-8: save it as one of these");
    if (text.find('\r') != std::string::npos && text.find('\n') == std::string::npos)
      throw Error(
          who + ": its lines end in a carriage return (CR) alone, which no program reads as a line end; save "
                "it with line ends LF or CR LF");
  }

  void include(Statement statement, const Path& folder) {
    for (const auto& [key, value] : statement.parameters)
      if (key != "INPUT")
        out.fail(statement.place, "*INCLUDE has the parameter " + key + "; expected INPUT=file");
    const std::string input = statement.value("INPUT");
    if (input.empty()) out.fail(statement.place, "expected *INCLUDE, INPUT=file");
    const Path path = (folder / input).lexically_normal();
    const std::string who = out.at(statement.place) + ": *INCLUDE: ";
    if (std::find(open_.begin(), open_.end(), path) != open_.end())
      throw Error(who + path.string() + " includes itself");
    if (open_.size() > static_cast<std::size_t>(deepest_include))
      throw Error(who + "files that include each other are more than " + std::to_string(deepest_include) +
                  " deep");
    out.includes.push_back(std::move(statement));
    file(path, path.string(), who);
  }

  /// An included file may go on with the data of the keyword before.
  void statements(int number, const Path& folder) {
    const std::string_view text = out.files[static_cast<std::size_t>(number)].text;
    Place place{number, 0}, begin;
    std::string begun; // a keyword line that ends in a comma goes on
    for (std::size_t start = 0; start < text.size();) {
      const std::size_t end = std::min(text.find('\n', start), text.size());
      const std::string_view line = trimmed(text.substr(start, end - start));
      start = end + 1;
      ++place.line;
      if (line.find('\r') != std::string_view::npos)
        out.fail(place, "a carriage return (CR) stands inside the line; write line ends LF or CR LF alone");
      if (line.empty() || is_comment(line)) continue;
      if (begun.empty() && !line.starts_with('*')) {
        if (out.list.empty())
          out.fail(place, "data before the first keyword; expected a line that starts with *");
        out.list.back().lines.push_back({line, place});
        continue;
      }
      if (begun.empty()) begin = place;
      begun += line;
      if (begun.ends_with(',')) continue;
      Statement statement = keyword_line(begun, begin, place.line);
      begun.clear();
      if (statement.keyword == "INCLUDE")
        include(std::move(statement), folder);
      else
        out.list.push_back(std::move(statement));
    }
    if (begun.empty()) return;
    // "*STEP," at the end of a file, or a comma that was meant to be followed by data
    out.fail(place, "the file ends inside the keyword line '" + begun.substr(0, 80) + "'");
  }
};

} // namespace

std::string Statement::value(std::string_view name) const {
  const std::string wanted = canonical(name);
  for (const auto& [key, text] : parameters)
    if (key == wanted) return text;
  return "";
}

bool Statement::has(std::string_view name) const {
  return std::any_of(parameters.begin(), parameters.end(),
                     [wanted = canonical(name)](const auto& entry) { return entry.first == wanted; });
}

std::string Source::at(Place place) const {
  return files.at(static_cast<std::size_t>(place.file)).name + ":" + std::to_string(place.line);
}

void Source::fail(Place place, const std::string& what) const { throw Error(at(place) + ": " + what); }

Source read_source(const Path& file) {
  Reader reader;
  reader.file(file, file.string(), "");
  return std::move(reader.out);
}

Source read_source_text(std::string_view text, const std::string& name, const Path& folder) {
  Reader reader;
  reader.text_of(std::string(text), name, {}, folder, name);
  return std::move(reader.out);
}

std::string canonical(std::string_view text) {
  text = trimmed(text);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  std::string out;
  for (const char c : text)
    if (c != ' ' && c != '\t') out += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return out;
}

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
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

bool parse(std::string_view text, std::int64_t& value) {
  std::string copy(text);
  std::erase(copy, ' ');
  const char* begin = copy.data() + copy.starts_with('+');
  const auto [end, error] = std::from_chars(begin, copy.data() + copy.size(), value);
  return error == std::errc{} && end == copy.data() + copy.size();
}

bool parse(std::string_view text, double& value) {
  std::string copy(text);
  std::erase(copy, ' ');
  if (copy.starts_with('+')) copy.erase(0, 1);
  std::replace_if(
      copy.begin(), copy.end(), [](char c) { return c == 'd' || c == 'D'; }, 'e'); // Fortran: 1.5D+00
  const auto [end, error] = std::from_chars(copy.data(), copy.data() + copy.size(), value);
  return error == std::errc{} && end == copy.data() + copy.size() && std::isfinite(value);
}

std::string shown(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

double entry(const Source& source, const Line& line, std::size_t i, std::optional<double> otherwise) {
  const auto fields = fields_of(line.text);
  double value = 0;
  if (i >= fields.size() || fields[i].empty()) {
    if (otherwise) return *otherwise;
    source.fail(line.place, "entry " + std::to_string(i + 1) + " is missing; write a number");
  }
  if (!parse(fields[i], value))
    source.fail(line.place, "expected a number, found '" + std::string(fields[i]) + "'");
  return value;
}

} // namespace ents_deck
