// SPDX-License-Identifier: BSD-3-Clause
#include "picture.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>

#include "library.hpp"
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

/// A file name between the quotes of gnuplot, and of the shell.
bool plain_name(const string& name) {
  return std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '/' || c == '.' || c == '_' || c == '-' || c == '+' || c >= 128;
  });
}

string gnuplot(const std::filesystem::path& script, const std::filesystem::path& picture) {
  if (std::system("command -v gnuplot >/dev/null 2>&1") != 0)
    return "no PNG: gnuplot is not installed (package gnuplot-nox)";
  if (!plain_name(script.string()))
    return "no PNG: the folder's name has characters that the shell would take for its own";
  const int code = std::system(("cd '" + script.parent_path().string() + "' && gnuplot '" +
                                script.filename().string() + "' >/dev/null 2>&1")
                                   .c_str());
  return code == 0 && std::filesystem::exists(picture) ? "" : "no PNG: gnuplot failed on " + script.string();
}

} // namespace

Pictures draw(const Job& job, const Contact& contact, const std::filesystem::path& out, const string& name) {
  Pictures pictures;
  const int d = dimension_of(contact.master);
  const double per_face = wanted_points / static_cast<double>(contact.master.faces.size());
  const int per_side =
      static_cast<int>(std::clamp(d == 2 ? per_face : std::sqrt(per_face), 1.0, d == 2 ? 400.0 : 120.0));
  const SampledSurface surface = sampled(job.mesh, contact, per_side);
  write_vtu(out / (name + "_master.vtu"), surface.points, surface.cells, {{"height", surface.heights}});
  pictures.files.push_back(out / (name + "_master.vtu"));

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
  pictures.files.push_back(out / (name + "_slave.vtu"));

  const std::filesystem::path script = std::filesystem::absolute(out / (name + ".gp")),
                              picture = out / (name + ".png");
  {
    std::ofstream gp(script);
    const auto number = [](const Point& p) { return exact(p[0]) + " " + exact(p[1]) + " " + exact(p[2]); };
    gp << "set terminal pngcairo size 1200,900\nset output '" << picture.filename().string()
       << "'\nset palette defined (0 '#440154', 0.25 '#3b528b', 0.5 '#21918c', 0.75 '#5ec962', 1 "
          "'#fde725')\nset cblabel 'height'\n"
       << "set title '"
       << (plain_name(contact.pair.slave + contact.pair.master)
               ? "slave nodes " + contact.pair.slave + " on the enriched master " + contact.pair.master
               : "")
       << "' noenhanced\n";
    gp << "$surface << EOD\n";
    for (const auto& cell : surface.cells) { // each cell is a small mesh of its own: two lines of two points
      const auto p = [&](std::size_t i) {
        return number(surface.points[static_cast<std::size_t>(cell[i])]) + " " +
               exact(surface.heights[static_cast<std::size_t>(cell[i])]) + "\n";
      };
      if (cell.size() == 2) gp << p(0) << p(1) << "\n";
      if (cell.size() == 3) gp << p(0) << p(1) << "\n" << p(2) << p(2) << "\n\n";
      if (cell.size() == 4) gp << p(0) << p(1) << "\n" << p(3) << p(2) << "\n\n";
    }
    gp << "EOD\n$slave << EOD\n";
    for (const Point& p : points) gp << number(p) << "\n";
    gp << "EOD\n";
    if (d == 2)
      gp << "set size ratio -1\nplot $surface using 1:2:4 with lines lw 2 palette title 'master', $slave "
            "using 1:2 with points pt 7 ps 0.6 lc rgb '#c1121f' title 'slave nodes'\n";
    else
      gp << "set view equal xy\nset view 65,30\nset xyplane relative 0\nunset key\n"
            "splot $surface using 1:2:3:4 with pm3d, $slave using 1:2:3 with points pt 7 ps 0.6 lc rgb "
            "'#c1121f'\n";
  }
  pictures.problem = gnuplot(script, picture);
  if (pictures.problem.empty()) pictures.files.push_back(picture);
  return pictures;
}

} // namespace ents_deck
