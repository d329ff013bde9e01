// SPDX-License-Identifier: BSD-3-Clause
#include "toolbox/vtu.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <map>
#include <numeric>
#include <span>
#include <stdexcept>

namespace host {

void save_text(const std::filesystem::path& file, const std::string& text) {
  const std::filesystem::path beside = file.string() + ".new";
  std::ofstream stream(beside, std::ios::binary);
  stream << text;
  stream.close();
  if (stream) return std::filesystem::rename(beside, file);
  const int why = errno;
  std::error_code ignored;
  std::filesystem::remove(beside, ignored); // a part of it
  throw std::runtime_error(file.string() + ": cannot be written: " + std::strerror(why));
}

} // namespace host

namespace host::vtu {
namespace {

std::string base64(std::span<const unsigned char> bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = 0;
    for (std::size_t j = 0; j < 3; ++j) group = group << 8 | (j < n ? bytes[i + j] : 0u);
    for (std::size_t j = 0; j < 4; ++j) out += j <= n ? digits[group >> (18 - 6 * j) & 63u] : '=';
  }
  return out;
}

std::string attribute(std::string_view text) {
  std::string out;
  for (const char c : text) {
    static const std::map<char, const char*> names{{'&', "&amp;"}, {'<', "&lt;"}, {'"', "&quot;"}};
    const auto found = names.find(c);
    found == names.end() ? out += c : out += found->second;
  }
  return out;
}

std::string number(double value) { // shortest text that reads back to the same bits
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

template <class T>
void data_array(std::string& xml, const char* type, std::string_view name, int components,
                const std::vector<T>& values) {
  const std::uint64_t size = values.size() * sizeof(T);
  std::vector<unsigned char> bytes(sizeof size + size);
  std::memcpy(bytes.data(), &size, sizeof size);
  if (size > 0) std::memcpy(bytes.data() + sizeof size, values.data(), size);
  xml += "<DataArray type=\"" + std::string(type) + "\" Name=\"" + attribute(name) + "\"";
  xml += " NumberOfComponents=\"" + std::to_string(components) + "\"";
  if (components == 6) {
    static constexpr std::array tensor{"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
    for (std::size_t i = 0; i < tensor.size(); ++i)
      xml += " ComponentName" + std::to_string(i) + "=\"" + tensor[i] + "\"";
  }
  xml += " format=\"binary\">" + base64(bytes) + "</DataArray>\n";
}

/// Insert zeros: [n][from] becomes [n][to].
std::vector<double> padded(const std::vector<double>& values, std::size_t from, std::size_t to) {
  if (from == to) return values;
  const std::size_t n = values.size() / from;
  std::vector<double> out(n * to, 0.0);
  for (std::size_t i = 0; i < n; ++i) std::copy_n(&values[i * from], from, &out[i * to]);
  return out;
}

void attributes(std::string& xml, const std::vector<Array>& arrays, std::size_t n) {
  xml += "<PointData>\n";
  for (const Array& array : arrays) {
    const int from = array.components, to = from == 2 ? 3 : from == 4 ? 6 : from;
    if (from < 1) throw std::invalid_argument("array '" + array.name + "': components must be at least 1");
    if (array.values.size() != n * static_cast<std::size_t>(from))
      throw std::invalid_argument("array '" + array.name + "' has " + std::to_string(array.values.size()) +
                                  " values; " + std::to_string(n) + " x " + std::to_string(from) +
                                  " are needed");
    data_array(xml, "Float64", array.name, to,
               padded(array.values, static_cast<std::size_t>(from), static_cast<std::size_t>(to)));
  }
  xml += "</PointData>\n";
}

constexpr const char* byte_order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";

} // namespace

void Grid::add_surface(int n1, int n2, const std::vector<double>& sampled) {
  const auto first = static_cast<std::int64_t>(points.size()) / dimension;
  points.insert(points.end(), sampled.begin(), sampled.end());
  std::vector<std::int64_t> nodes;
  for (int i = 0; n2 == 1 && i < n1; ++i) nodes.push_back(first + i);
  for (int j = 0; j + 1 < n2; ++j)
    for (int i = 0; i + 1 < n1; ++i)
      for (const int node : {j * n1 + i, j * n1 + i + 1, (j + 1) * n1 + i + 1, (j + 1) * n1 + i})
        nodes.push_back(first + node);
  add_cells(n2 == 1 ? polyline : quad, n2 == 1 ? nodes.size() : 4, nodes);
}

Grid point_cloud(int dimension, std::vector<double> points) {
  Grid grid{dimension, std::move(points), {}, {}, {}, {}};
  std::vector<std::int64_t> nodes(grid.points.size() / static_cast<std::size_t>(dimension));
  std::iota(nodes.begin(), nodes.end(), std::int64_t{0});
  grid.add_cells(vertex, 1, nodes);
  return grid;
}

std::string to_xml(const Grid& grid) {
  if (grid.dimension != 2 && grid.dimension != 3)
    throw std::invalid_argument("grid: dimension must be 2 or 3");
  const auto dimension = static_cast<std::size_t>(grid.dimension);
  if (grid.points.size() % dimension != 0)
    throw std::invalid_argument("grid: the size of `points` is not a multiple of the dimension");
  const std::size_t points = grid.points.size() / dimension;
  for (const std::int64_t node : grid.connectivity)
    if (node < 0 || node >= static_cast<std::int64_t>(points))
      throw std::invalid_argument("cells: node " + std::to_string(node) + " of " + std::to_string(points) +
                                  " points");
  if (!grid.offsets.empty() && grid.offsets.back() != std::ssize(grid.connectivity))
    throw std::invalid_argument("cells: the last one ends at node " + std::to_string(grid.offsets.back()) +
                                " of " + std::to_string(grid.connectivity.size()));

  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                    "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"";
  xml += std::string(byte_order) + "\" header_type=\"UInt64\">\n<UnstructuredGrid>\n";
  xml += "<Piece NumberOfPoints=\"" + std::to_string(points) + "\" NumberOfCells=\"" +
         std::to_string(grid.types.size()) + "\">\n";
  attributes(xml, grid.point_data, points);
  xml += "<Points>\n";
  data_array(xml, "Float64", "Points", 3, padded(grid.points, dimension, 3));
  xml += "</Points>\n<Cells>\n";
  data_array(xml, "Int64", "connectivity", 1, grid.connectivity);
  data_array(xml, "Int64", "offsets", 1, grid.offsets);
  data_array(xml, "UInt8", "types", 1, grid.types);
  xml += "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  return xml;
}

Series::Series(std::filesystem::path directory, std::string name, Save save)
    : directory_(std::move(directory)), name_(std::move(name)), save_(std::move(save)) {}

std::filesystem::path Series::file() const { return directory_ / (name_ + ".pvd"); }

void Series::add(int step, double time, std::string_view part, const Grid& grid) {
  std::string digits = std::to_string(step);
  digits.insert(0, digits.size() < 4 ? 4 - digits.size() : 0, '0');
  const std::string vtu = name_ + "_" + std::string(part) + "_" + digits + ".vtu";
  save_(directory_ / vtu, to_xml(grid));
  entries.push_back({step, time, std::string(part), vtu});
}

void Series::write_list() const {
  std::string xml =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
      "byte_order=\"" +
      std::string(byte_order) + "\">\n<Collection>\n";
  std::vector<std::string> parts; // in order of first appearance: the block number in ParaView
  for (const Entry& entry : entries) {
    const auto number_of_part = std::find(parts.begin(), parts.end(), entry.part) - parts.begin();
    if (number_of_part == std::ssize(parts)) parts.push_back(entry.part);
    xml += "<DataSet timestep=\"" + number(entry.time) + "\" part=\"" + std::to_string(number_of_part) +
           "\" name=\"" + attribute(entry.part) + "\" file=\"" + attribute(entry.file) + "\"/>\n";
  }
  save_(file(), xml + "</Collection>\n</VTKFile>\n");
}

} // namespace host::vtu
