// SPDX-License-Identifier: BSD-3-Clause
#include "picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include "library.hpp"
#include "run_job.hpp"
#include "write.hpp"

namespace ents_deck {
namespace {

using std::string;

/// Points of the enriched master: about this many in all, so that the files stay small.
constexpr double wanted_points = 15000;

struct Field {
  string name;
  std::vector<double> values;
};

void write_vtu(const std::filesystem::path& path, const std::vector<Point>& points,
               const std::vector<std::vector<int>>& cells, const std::vector<Field>& fields) {
  std::ofstream out(path);
  const auto array = [&](const string& type, const string& name, int components) -> std::ofstream& {
    out << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\"" << components
        << "\" format=\"ascii\">\n";
    return out;
  };
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
         "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n"
      << "<Piece NumberOfPoints=\"" << points.size() << "\" NumberOfCells=\"" << cells.size()
      << "\">\n<Points>\n";
  array("Float64", "position", 3);
  for (const Point& p : points) out << exact(p[0]) << ' ' << exact(p[1]) << ' ' << exact(p[2]) << '\n';
  out << "</DataArray>\n</Points>\n<Cells>\n";
  array("Int64", "connectivity", 1);
  for (const auto& cell : cells) {
    for (const int node : cell) out << node << ' ';
    out << '\n';
  }
  out << "</DataArray>\n";
  array("Int64", "offsets", 1);
  std::size_t offset = 0;
  for (const auto& cell : cells) out << (offset += cell.size()) << '\n';
  out << "</DataArray>\n";
  array("UInt8", "types", 1);
  static constexpr int types[] = {0, 1, 3, 5, 9}; // vertex, line, triangle, quadrilateral
  for (const auto& cell : cells) out << types[cell.size()] << '\n';
  out << "</DataArray>\n</Cells>\n<PointData>\n";
  for (const Field& field : fields) {
    array("Float64", field.name, 1);
    for (const double value : field.values) out << exact(value) << '\n';
    out << "</DataArray>\n";
  }
  out << "</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  if (!out.flush()) throw Error(path.string() + " cannot be written");
}

void write_text(const std::filesystem::path& path, const string& text) {
  std::ofstream out(path, std::ios::binary);
  if (!(out << text).flush()) throw Error(path.string() + " cannot be written");
}

/// With the first Python that has matplotlib. @return empty, or why there are no pictures
string run_script(const std::filesystem::path& script) {
  const char* own = std::getenv("ENTS_PYTHON");
  for (const string python : {own == nullptr ? "" : own, "python3", "/usr/bin/python3"}) {
    if (python.empty()) continue;
    constexpr int without_matplotlib = 3, without_python = 127; // ends of the script, and of the shell
    const int status =
        std::system((quoted(python) + " -B " + quoted(script.string()) + " >/dev/null 2>&1").c_str());
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    if (code == 0) return "";
    if (code != without_matplotlib && code != without_python)
      return "no PNG: python3 " + script.string() + " fails";
  }
  return "no PNG: matplotlib is missing (Debian package python3-matplotlib); with it, python3 " +
         script.string() + " draws them";
}

/// The enriched master and the slave points of a pair.
void write_pair(const Job& job, const Contact& contact, const std::filesystem::path& out,
                const string& name) {
  const int d = dimension_of(contact.master);
  const double per_face = wanted_points / static_cast<double>(contact.master.faces.size());
  const int per_side =
      static_cast<int>(std::clamp(d == 2 ? per_face : std::sqrt(per_face), 1.0, d == 2 ? 400.0 : 120.0));
  const SampledSurface surface = sampled(job.mesh, contact, per_side);
  write_vtu(out / (name + "_master.vtu"), surface.points, surface.cells, {{"height", surface.heights}});

  std::vector<Point> points;
  std::vector<std::vector<int>> cells;
  std::vector<Field> fields{{"area", {}}, {"segments", {}}, {"element", {}}};
  for (std::size_t i = 0; i < contact.element_count; ++i) {
    const ContactElement& e = job.elements[contact.first_element + i];
    cells.push_back({static_cast<int>(points.size())});
    points.push_back(e.slave.x);
    fields[0].values.push_back(e.slave.area);
    fields[1].values.push_back(static_cast<double>(contact.patches.list[i].faces.size()));
    fields[2].values.push_back(
        static_cast<double>(first_free_element(job) + static_cast<std::int64_t>(contact.first_element + i)));
  }
  write_vtu(out / (name + "_slave.vtu"), points, cells, fields);
}

} // namespace

Pictures draw(const Job& job, const std::filesystem::path& out) {
  Pictures pictures;
  nlohmann::json list = nlohmann::json::array();
  std::vector<std::filesystem::path> drawn;
  for (std::size_t i = 0; i < job.contacts.size(); ++i) {
    const Contact& contact = job.contacts[i];
    const string name = "pair_" + std::to_string(i + 1);
    write_pair(job, contact, out, name);
    list.push_back(
        {{"name", name},
         {"title", "slave points " + contact.pair.slave + " on the enriched master " + contact.pair.master}});
    for (const char* file : {"_master.vtu", "_slave.vtu"}) pictures.files.push_back(out / (name + file));
    drawn.push_back(out / (name + ".png"));
  }
  write_text(out / "pictures.json",
             list.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  write_text(out / "pictures.py", pictures_script);
  pictures.problem = run_script(out / "pictures.py");
  if (pictures.problem.empty()) pictures.files.insert(pictures.files.end(), drawn.begin(), drawn.end());
  return pictures;
}

} // namespace ents_deck
