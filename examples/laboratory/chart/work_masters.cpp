// SPDX-License-Identifier: BSD-3-Clause
// Rigid masters of several segments for the work-precision diagrams.
#include <cmath>
#include <cstdio>
#include <numbers>

#include "chart/work.hpp"

namespace host::chart {
namespace {

/// Points of a rigid segment's surface at equal distances in xi, n + 1 per direction, and one more beyond
/// either end by extrapolation, for splines that need it.
struct PointGrid {
  std::size_t n = 0, d = 0;
  std::vector<double> values; ///< [rows][n + 3][components]
  std::size_t components = 0;

  std::size_t row() const { return n + 3; }
  std::int64_t number(std::size_t i, std::size_t j) const { return static_cast<std::int64_t>(j * row() + i); }
  double* at(std::size_t i, std::size_t j) { return values.data() + (j * row() + i) * components; }
};

/// f(-1) from f(0), f(1), f(2), exact for parabolas.
void extend(double* out, const double* a, const double* b, const double* c, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) out[k] = 3 * a[k] - 3 * b[k] + c[k];
}

/// @param base  points of rho and their surface coordinates instead of points of rho_e
PointGrid sample_grid(const EntsLibrary& library, const Scene& scene, int divisions, bool base) {
  const ContactSpec& contact = *scene.contact;
  const EntsModel model(library, contact.model.dump(), scene.file.parent_path(), contact.model_where);
  PointGrid grid;
  grid.n = static_cast<std::size_t>(divisions);
  grid.d = static_cast<std::size_t>(scene.dimension);
  grid.components = grid.d + (base ? 1 : 0);
  const std::size_t rows = grid.d == 2 ? 1 : grid.row();
  grid.values.resize(rows * grid.row() * grid.components);
  const SurfaceSample sample =
      sample_surface(model, contact.rigid, {}, even_grid(model.layout().parameters, grid.n));
  const std::vector<double>& points = base ? sample.base_point : sample.point;
  for (std::size_t j = 0; j <= (grid.d == 2 ? 0 : grid.n); ++j)
    for (std::size_t i = 0; i <= grid.n; ++i) {
      double* to = grid.at(i + 1, grid.d == 2 ? 0 : j + 1);
      const std::size_t from = j * (grid.n + 1) + i;
      std::copy_n(points.data() + from * grid.d, grid.d, to);
      if (!base) continue;
      // In the plane, with the two ends' coordinates: linear in xi, as the scene's segment has it.
      const Json& ends = contact.model.at("surface_coordinates");
      const double first = ends[0][0].get<double>(), last = ends[1][0].get<double>();
      to[grid.d] = first + (last - first) * 0.5 * (1 + even_xi(i, grid.n));
    }
  const std::size_t n = grid.n, c = grid.components;
  for (std::size_t j = 0; j < rows; ++j) {
    extend(grid.at(0, j), grid.at(1, j), grid.at(2, j), grid.at(3, j), c);
    extend(grid.at(n + 2, j), grid.at(n + 1, j), grid.at(n, j), grid.at(n - 1, j), c);
  }
  for (std::size_t i = 0; i < grid.row() && rows > 1; ++i) {
    extend(grid.at(i, 0), grid.at(i, 1), grid.at(i, 2), grid.at(i, 3), c);
    extend(grid.at(i, n + 2), grid.at(i, n + 1), grid.at(i, n), grid.at(i, n - 1), c);
  }
  return grid;
}

std::unique_ptr<EntsModel> model_of(const EntsLibrary& library, const Scene& scene, const Json& model) {
  return std::make_unique<EntsModel>(library, model.dump(), scene.file.parent_path(),
                                     scene.contact->model_where);
}

/// Catmull-Rom segments through points of rho_e: C1, third order.
Master smoothed_master(const EntsLibrary& library, const Scene& scene, int divisions) {
  PointGrid grid = sample_grid(library, scene, divisions, false);
  Json model = scene.contact->model;
  model["segment"] = grid.d == 2 ? "catmull_rom4" : "catmull_rom16";
  model["height"] = nullptr;
  model.erase("surface_coordinates");
  Master master;
  master.model = model_of(library, scene, model);
  master.direction = scene.contact->direction;
  for (std::size_t j = 0; j < (grid.d == 2 ? 1 : grid.n); ++j)
    for (std::size_t i = 0; i < grid.n; ++i)
      for (std::size_t b = 0; b < (grid.d == 2 ? 1u : 4u); ++b)
        for (std::size_t a = 0; a < 4; ++a) master.connectivity.push_back(grid.number(i + a, j + b));
  master.positions = std::move(grid.values);
  return master;
}

/// The scene's height on several segments of its base: plain ones, or Catmull-Rom segments. In the plane.
Master base_master(const EntsLibrary& library, const Scene& scene, int divisions, bool smooth) {
  PointGrid grid = sample_grid(library, scene, divisions, true);
  Json model = scene.contact->model;
  model["segment"] = smooth ? "catmull_rom4" : "line2";
  model.erase("surface_coordinates");
  if (!smooth) model["border"] = 0.05; // a node in the wedge between two segments shall find one of them
  Master master;
  master.model = model_of(library, scene, model);
  model["height"] = nullptr;
  master.base = model_of(library, scene, model);
  master.direction = scene.contact->direction;
  for (std::size_t i = 0; i < grid.n; ++i)
    for (std::size_t a = smooth ? 0 : 1; a < (smooth ? 4u : 3u); ++a) {
      master.connectivity.push_back(grid.number(i + a, 0));
      master.surface_coordinates.push_back(grid.at(i + a, 0)[grid.d]);
    }
  for (std::size_t i = 0; i < grid.row(); ++i)
    master.positions.insert(master.positions.end(), grid.at(i, 0), grid.at(i, 0) + grid.d);
  return master;
}

} // namespace

std::string wavy_block_deck(int n, double amplitude, double wavelength, double depth) {
  // Rows from below; the highest at the bottom, the surface's as high as wide.
  GridLines heights{0};
  append_graded(heights, 1, 1 + static_cast<int>(std::lround(std::log2(n))), 0.5);
  const int columns = n + 1, rows = static_cast<int>(heights.size());
  std::string nodes = "*NODE\n", elements = "*ELEMENT, TYPE=CPE4, ELSET=BODY\n", top = "*SURFACE, NAME=TOP\n",
              base, left, right;
  const auto number = [&](int i, int j) { return std::to_string(1 + i + columns * j); };
  std::array<char, 96> line{};
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const double x = wavelength * (static_cast<double>(i) / n - 0.5);
      const double surface = amplitude * std::cos(2 * std::numbers::pi * x / wavelength);
      std::snprintf(line.data(), line.size(), ", %.17g, %.17g\n", x,
                    -depth + (depth + surface) * heights[static_cast<std::size_t>(j)]);
      nodes += number(i, j) + line.data();
      if (j == 0) base += number(i, j) + ",\n";
      if (i == 0) left += number(i, j) + ",\n";
      if (i == n) right += number(i, j) + ",\n";
    }
  int element = 0;
  for (int j = 0; j + 1 < rows; ++j)
    for (int i = 0; i < n; ++i) {
      elements += std::to_string(++element) + ", " + number(i, j) + ", " + number(i + 1, j) + ", " +
                  number(i + 1, j + 1) + ", " + number(i, j + 1) + "\n";
      if (j + 2 == rows) top += std::to_string(element) + ", S3\n";
    }
  return nodes + elements + "*NSET, NSET=BASE\n" + base + "*NSET, NSET=LEFT\n" + left +
         "*NSET, NSET=RIGHT\n" + right + top;
}

MasterMaker master_of(const Way& way) {
  const int n = way.divisions;
  switch (way.family) {
  case Family::enriched:
  case Family::layer:
  case Family::sampled:
    return {};
  case Family::facets:
  case Family::facets_sampled:
  case Family::facets_cut:
    return [n](const EntsLibrary& library, const Scene& scene) { return explicit_master(library, scene, n); };
  case Family::smoothed:
    return [n](const EntsLibrary& library, const Scene& scene) { return smoothed_master(library, scene, n); };
  case Family::on_facets:
    return
        [n](const EntsLibrary& library, const Scene& scene) { return base_master(library, scene, n, false); };
  case Family::on_smoothed:
    return
        [n](const EntsLibrary& library, const Scene& scene) { return base_master(library, scene, n, true); };
  }
  return {};
}

} // namespace host::chart
