// SPDX-License-Identifier: BSD-3-Clause
#include "series.hpp"

#include <charconv>
#include <fstream>
#include <map>
#include <set>

namespace host {

void resume(vtu::Series& series, int first_step) {
  std::ifstream stream(series.file());
  for (std::string line; std::getline(stream, line);) { // our own file: one DataSet a line, nothing escaped
    const auto value = [&](const std::string& key) {
      const auto begin = line.find(key + "=\"");
      if (begin == line.npos) return std::string{};
      const auto first = begin + key.size() + 2;
      return line.substr(first, line.find('"', first) - first);
    };
    const std::string vtu = value("file"), time = value("timestep");
    int step = first_step;
    const auto digits = vtu.rfind('_') + 1;
    std::from_chars(vtu.data() + digits, vtu.data() + vtu.size(), step);
    if (step >= first_step) continue;
    vtu::Series::Entry entry{step, 0, value("name"), vtu};
    std::from_chars(time.data(), time.data() + time.size(), entry.time);
    series.entries.push_back(std::move(entry));
  }
}

std::vector<int> whole_steps(const vtu::Series& series) {
  std::map<int, std::size_t> count;
  std::set<std::string> parts;
  for (const vtu::Series::Entry& entry : series.entries) ++count[entry.step], parts.insert(entry.part);
  std::vector<int> steps;
  for (const auto& [step, written] : count)
    if (written == parts.size()) steps.push_back(step);
  return steps;
}

} // namespace host
