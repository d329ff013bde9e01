// SPDX-License-Identifier: BSD-3-Clause
// VTU files (VTK XML unstructured grids) and their .pvd time series, for ParaView, VisIt, PyVista ...
// Format: VTK File Formats 4.2, "XML File Formats". Arrays are inline base64 with a UInt64 byte count:
// valid XML, no loss, nothing depends on the locale.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace host {

/// The name of an array, for people.
inline std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + " [" + unit + "]";
}

/// Write a file whole: the text goes to FILE.new, which then takes its name. Who reads FILE meanwhile sees the old one.
/// @throws std::runtime_error naming the file that cannot be written, and why
void save_text(const std::filesystem::path& file, const std::string& text);

} // namespace host

namespace host::vtu {

/// VTK's numbers of the cells that are no finite elements.
inline constexpr int vertex = 1, polyline = 4, quad = 9;

/// One named value per point.
/// components: 1 scalar; 2 or 3 vector; 4 plane tensor xx yy zz xy; 6 tensor xx yy zz xy yz xz (VTK's order).
/// 2 and 4 are padded with zeros to 3 and 6, so that ParaView treats plane and space results alike.
struct Array {
  std::string name; ///< with its unit if it has one, "pressure [MPa]"
  int components = 1;
  std::vector<double> values; ///< [n][components]
};

struct Grid {
  int dimension = 3;                               ///< 2 or 3; plane points get z = 0
  std::vector<double> points;                      ///< [n][dimension], length
  std::vector<std::int64_t> connectivity, offsets; ///< nodes of all cells, from 0; where those of each end
  std::vector<std::uint8_t> types;                 ///< of the cells, VTK's numbers
  std::vector<Array> point_data;

  /// @param nodes  [cells][nodes_per_cell], counterclockwise in 2D, the first face counterclockwise seen from
  ///               inside in 3D
  template <class Nodes> void add_cells(int type, std::size_t nodes_per_cell, const Nodes& nodes) {
    connectivity.insert(connectivity.end(), nodes.begin(), nodes.end());
    for (std::size_t i = 0; i < nodes.size(); i += nodes_per_cell) {
      offsets.push_back((offsets.empty() ? 0 : offsets.back()) + static_cast<std::int64_t>(nodes_per_cell));
      types.push_back(static_cast<std::uint8_t>(type));
    }
  }

  /// A surface sampled on a regular grid of parameters, first parameter fastest: one polyline in 2D
  /// (n2 = 1), (n1-1)(n2-1) quads in 3D. Meant for the enriched surface rho_e.
  /// @param sampled  [n2][n1][dimension], length
  void add_surface(int n1, int n2, const std::vector<double>& sampled);
};

/// The slave nodes as a cloud: one vertex per point.
Grid point_cloud(int dimension, std::vector<double> points);

/// The file's text.
/// @throws std::invalid_argument naming the array whose size does not fit, or a bad node number
std::string to_xml(const Grid& grid);

/// A series over load steps: DIR/NAME.pvd refers to DIR/NAME_PART_0003.vtu.
class Series {
public:
  using Save = std::function<void(const std::filesystem::path& file, const std::string& text)>;
  /// One part of one step.
  struct Entry {
    int step;
    double time;
    std::string part, file;
  };

  /// @param save  how its files are written
  Series(std::filesystem::path directory, std::string name, Save save = save_text);

  /// Write one part ("bulk", "slave", "surface") of one step. `time`: load factor or time of the step.
  /// @throws as `save` and to_xml
  void add(int step, double time, std::string_view part, const Grid& grid);

  /// Replace the .pvd file by one that lists what was added up to now: after every step, so that a run that
  /// was stopped can be looked at.
  void write_list() const;

  /// The .pvd file, for the message to the user.
  std::filesystem::path file() const;

  std::vector<Entry> entries; ///< what the .pvd file lists

private:
  std::filesystem::path directory_;
  std::string name_;
  Save save_;
};

} // namespace host::vtu
