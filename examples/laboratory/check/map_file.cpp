// SPDX-License-Identifier: BSD-3-Clause
#include "map_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <utility>

namespace host {
namespace {

/// What a file says and holds.
struct MapFile {
  std::map<std::string, double> lengths; ///< "# Width: 10.00 um" of Gwyddion's text export, metres
  double rows = 0, columns = 0;
};

MapFile read_map_file(const std::filesystem::path& file) {
  static const std::map<std::string, double> units{
      {"m", 1},     {"dm", 1e-1},    {"cm", 1e-2}, {"mm", 1e-3},  {"\xC2\xB5m", 1e-6}, {"\xCE\xBCm", 1e-6},
      {"um", 1e-6}, {"\xB5m", 1e-6}, {"nm", 1e-9}, {"pm", 1e-12}, {"fm", 1e-15},       {"\xC3\x85", 1e-10},
      {"km", 1e3}};
  MapFile map;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    line.erase(line.find_last_not_of(" \t\r") + 1);
    if (line.empty()) continue;
    if (line[0] != '#') {
      if (map.rows++ > 0) continue;
      const char* separators = line.find(';') != line.npos                                   ? ";"
                               : line.find(',') != line.npos && line.find('\t') == line.npos ? ","
                                                                                             : " \t";
      for (std::size_t at = 0; (at = line.find_first_not_of(separators, at)) != line.npos; ++map.columns)
        at = std::min(line.find_first_of(separators, at), line.size());
      continue;
    }
    const auto colon = line.find(':'), key = line.find_first_not_of(" \t", 1);
    if (colon == line.npos || key == line.npos) continue;
    char* end = nullptr;
    const double number = std::strtod(line.c_str() + colon + 1, &end);
    std::string unit = end;
    unit.erase(0, unit.find_first_not_of(" \t"));
    if (const auto found = units.find(unit); found != units.end() && number > 0)
      map.lengths[line.substr(key, colon - key)] = number * found->second;
  }
  return map;
}

} // namespace

MapSize map_size(const Json& map, const std::filesystem::path& folder, std::size_t directions) {
  MapSize size;
  if (map.contains("file")) {
    MapFile file = read_map_file(folder / map.at("file").get<std::string>());
    if (directions == 1 && file.columns == 1) { // a profile may stand
      std::swap(file.rows, file.columns);
      std::swap(file.lengths["Width"], file.lengths["Height"]);
    }
    // The stated width is that of n pixels; the samples of a clamped map lie n - 1 apart.
    const bool clamped = map.value("boundary", "") == "clamped";
    const double unit = map.value("length_unit", 1.);
    for (const auto& [key, count] : {std::pair{"Width", file.columns}, std::pair{"Height", file.rows}})
      if (size.samples.size() < directions) {
        size.samples.push_back(count);
        if (file.lengths[key] > 0)
          size.lengths.push_back(file.lengths[key] / unit * (clamped ? (count - 1) / count : 1));
      }
  } else if (map.contains("values")) {
    const Json& values = map.at("values");
    if (directions == 2) size.samples.push_back(static_cast<double>(values.at(0).size()));
    size.samples.push_back(static_cast<double>(values.size()));
  }
  if (map.contains("size")) {
    size.lengths.clear();
    for (const Json& length : map.at("size")) size.lengths.push_back(length.get<double>());
  }
  if (size.lengths.size() != directions) size.lengths.clear();
  if (size.samples.size() != directions) size.samples.clear();
  return size;
}

} // namespace host
