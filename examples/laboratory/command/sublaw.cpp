// SPDX-License-Identifier: BSD-3-Clause
// ents-lab sublaw: the waves of a surface that are shorter than a wavelength, as the part of a model.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "command/commands.hpp"
#include "ents_library.hpp"
#include "map_file.hpp"
#include "output/pictures.hpp"
#include "output/table.hpp"
#include "output_folder.hpp"
#include "removed_waves.hpp"
#include "toolbox/error.hpp"
#include "toolbox/json_reader.hpp"
#include "wave_law.hpp"

namespace host {
namespace {

constexpr int cells_per_wave = 6, fewest_cells = 64, most_cells = 512;
constexpr int usual_realisations = 4;

/// The surface of a command: a height, and how large it is.
struct Scan {
  Json height;
  std::filesystem::path folder; ///< where its file names start
  double lx = 0, ly = 0;
  double shortest = 0; ///< wave; 0: not known
  Grid grid = Grid::cells;
  Json* random = nullptr; ///< the part of the height that has a seed; or null
};

/// The first part of a height with one of these types, or null.
Json* part_of(Json& height, std::initializer_list<const char*> types) {
  if (height.is_object())
    for (const char* type : types)
      if (height.value("type", "") == type) return &height;
  if (height.is_structured())
    for (auto& part : height)
      if (Json* found = part.is_structured() ? part_of(part, types) : nullptr) return found;
  return nullptr;
}

void measure(Scan& scan, const SublawOptions& options) {
  const std::string name = options.scan.string();
  scan.random = part_of(scan.height, {"roughness"});
  if (scan.random) {
    const Json& size = scan.random->at("size");
    scan.lx = size.at(0).get<double>(), scan.ly = size.at(1).get<double>(), scan.grid = Grid::periodic;
    scan.shortest = scan.random->at("wavelengths").at(0).get<double>();
  } else if (const Json* map = part_of(scan.height, {"map"})) {
    const MapSize size = map_size(*map, scan.folder, 2);
    if (size.lengths.size() == 2) {
      scan.lx = size.lengths[0], scan.ly = size.lengths[1];
      scan.grid = map->value("boundary", "") == "clamped" ? Grid::cells : Grid::periodic;
      if (size.samples.size() == 2)
        scan.shortest = 2 * std::max(scan.lx / (size.samples[0] - 1), scan.ly / (size.samples[1] - 1));
    }
  }
  if (!options.size.empty()) {
    scan.lx = options.size[0], scan.ly = options.size[1];
    if (!scan.random) scan.grid = Grid::cells;
  }
  if (!(scan.lx > 0) || !(scan.ly > 0))
    throw InputError(name + ": how large is the surface? Neither it nor its file says so; write --size X Y, "
                            "in units of the surface coordinates");
}

Scan read_scan(const SublawOptions& options) {
  Scan scan;
  scan.folder = options.scan.parent_path();
  if (options.scan.extension() == ".json") {
    const Json text = parse_json_file(options.scan);
    for (const char* path : {"/contact/model/height", "/height"})
      if (scan.height.is_null()) scan.height = find_json(text, path);
    if (scan.height.is_null())
      throw InputError(options.scan.string() +
                       ": neither /height of a model nor /contact/model/height of a scene is "
                       "there; name a height map, a model or a scene");
  } else {
    scan.height = {{"type", "map"}, {"file", options.scan.filename().string()}, {"boundary", "clamped"}};
    if (options.unit > 0) scan.height["length_unit"] = options.unit;
    if (!options.size.empty()) scan.height["size"] = options.size;
  }
  measure(scan, options);
  return scan;
}

/// Heights at the centres of the cells, on one flat segment over the surface.
Eigen::ArrayXXd heights(const EntsLibrary& library, const Scan& scan, const ElasticLayer& cells,
                        double shorter_than) {
  Json height = scan.height;
  if (shorter_than > 0) leave_out_short_waves(height, shorter_than);
  const Json corners = {{0, 0}, {scan.lx, 0}, {scan.lx, scan.ly}, {0, scan.ly}};
  const Json text = {
      {"segment", "quad4"}, {"master", "rigid"}, {"surface_coordinates", corners}, {"height", height}};
  const EntsModel model(library, text.dump(), scan.folder, "the scan");
  const std::vector<double> nodes{0, 0, 0, scan.lx, 0, 0, scan.lx, scan.ly, 0, 0, scan.ly, 0};
  std::vector<double> xi;
  for (Eigen::Index j = 0; j < cells.cells_y(); ++j)
    for (Eigen::Index i = 0; i < cells.cells_x(); ++i)
      xi.insert(xi.end(), {2 * cells.x(i) / scan.lx - 1, 2 * cells.y(j) / scan.ly - 1});
  const std::vector<double> found = sample_surface(model, nodes, {}, xi).height;
  return Eigen::Map<const Eigen::ArrayXXd>(found.data(), cells.cells_x(), cells.cells_y());
}

/// A level, averaged over realisations.
struct Row {
  double pressure = 0, gap = 0, share = 0;
  double gap_scatter = 0;      ///< standard deviation over the realisations [L]
  double pressure_scatter = 0; ///< of the mean over boxes as wide as --from, over the mean
  double stiffness = 0;        ///< dp / d(-gap) [F/L^3]
};

/// Root of the mean square deviation of the means over boxes, over the mean.
double scatter_over_boxes(const Eigen::ArrayXXf& pressed, double cells_in_box) {
  const auto n = std::max<Eigen::Index>(1, std::lround(cells_in_box));
  const Eigen::Index nx = pressed.rows() / n, ny = pressed.cols() / n;
  if (nx * ny < 2) return 0;
  double sum = 0, squares = 0;
  for (Eigen::Index j = 0; j < ny; ++j)
    for (Eigen::Index i = 0; i < nx; ++i) {
      const double mean = static_cast<double>(pressed.block(i * n, j * n, n, n).mean());
      sum += mean, squares += mean * mean;
    }
  const double count = static_cast<double>(nx * ny);
  return std::sqrt(std::max(0., squares / count - sum * sum / count / count)) / (sum / count);
}

std::vector<Row> averaged(const std::vector<WaveLaw>& laws, double cells_in_box) {
  std::size_t levels = laws.front().size();
  for (const WaveLaw& law : laws) levels = std::min(levels, law.size());
  std::vector<Row> rows(levels);
  const double count = static_cast<double>(laws.size());
  for (std::size_t k = 0; k < levels; ++k) {
    Row& row = rows[k];
    double squares = 0;
    for (const WaveLaw& law : laws) {
      const WaveLevel& level = law[law.size() - levels + k];
      row.pressure += level.pressure / count, row.gap += level.gap / count, row.share += level.share / count;
      row.pressure_scatter += scatter_over_boxes(level.pressed, cells_in_box) / count;
      squares += level.gap * level.gap / count;
    }
    row.gap_scatter = std::sqrt(std::max(0., squares - row.gap * row.gap));
  }
  for (std::size_t k = 0; k < levels && levels > 1;
       ++k) { // of the logarithm, which is nearly a straight line
    const Row &a = rows[k == 0 ? 0 : k - 1], &b = rows[std::min(k + 1, levels - 1)];
    rows[k].stiffness = rows[k].pressure * std::log(a.pressure / b.pressure) / (b.gap - a.gap);
  }
  return rows;
}

/// The part of a model: its normal law; with a conductivity the conductance of the interface (J. R. Barber,
/// Proc. R. Soc. A 459, 2003: h_c / k_s = stiffness / E*).
Json model_part(const std::vector<Row>& rows, const SublawOptions& options) {
  std::vector<double> gap, pressure;
  for (const Row& row : rows) gap.push_back(row.gap), pressure.push_back(row.pressure);
  Json contact = {{"normal", law_table(gap, pressure)}};
  if (options.conductivity > 0) {
    std::vector<double> pressures{0}, conductances{0};
    for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
      pressures.push_back(row->pressure);
      conductances.push_back(options.conductivity * row->stiffness / options.modulus);
    }
    contact["heat"] = {{"table", {{"pressures", pressures}, {"conductances", conductances}}}};
  }
  return {{"contact", contact}};
}

/// R. D. Mindlin, J. Appl. Mech. 16 (1949) 259: of a contact between bodies of the same material, and of any
/// set of contacts as long as none slips (C. Campana, B. N. J. Persson, M. H. Muser, J. Phys. Condens. Matter
/// 23 (2011) 085001).
double mindlin_ratio(double poisson) { return 2 * (1 - poisson) / (2 - poisson); }

Json result_of(const Scan& scan, const SublawOptions& options, const std::vector<Row>& rows, double rms,
               double slope, int realisations, bool kept) {
  Json levels = Json::array();
  for (const Row& row : rows)
    levels.push_back({{"pressure", row.pressure},
                      {"gap", row.gap},
                      {"gap_scatter", row.gap_scatter},
                      {"pressure_scatter", row.pressure_scatter},
                      {"area", row.share},
                      {"normal_stiffness", row.stiffness},
                      {"tangential_stiffness", mindlin_ratio(options.poisson) * row.stiffness},
                      {"conductance_over_conductivity", row.stiffness / options.modulus}});
  return {
      {"scan", options.scan.string()},
      {"from", options.from},
      {"to", options.to > 0 ? options.to : scan.shortest},
      {"modulus", options.modulus},
      {"poisson", options.poisson},
      {"size", {scan.lx, scan.ly}},
      {"rms", rms},
      {"slope", slope},
      {"realisations", realisations},
      {"kept", kept},
      {"valid", {{"smallest_pressure", rows.back().pressure}, {"largest_pressure", rows.front().pressure}}},
      {"tangential_over_normal", mindlin_ratio(options.poisson)},
      {"levels", levels},
      {"model", model_part(rows, options)}};
}

std::string draw(const std::vector<Row>& rows, const SublawOptions& options) {
  using namespace pictures;
  Curve law{"boundary elements", {}, {}, Style::both}, area{"boundary elements", {}, {}, Style::both},
      low{"gap - its scatter", {}, {}, Style::dashed}, high{"gap + its scatter", {}, {}, Style::dashed};
  for (const Row& row : rows) {
    law.x.push_back(row.gap), law.y.push_back(row.pressure);
    low.x.push_back(row.gap - row.gap_scatter), low.y.push_back(row.pressure);
    high.x.push_back(row.gap + row.gap_scatter), high.y.push_back(row.pressure);
    area.x.push_back(row.pressure), area.y.push_back(100 * row.share);
  }
  const std::string waves =
      "waves below " + format_number(options.from) + " of " + options.scan.filename().string();
  Chart first, second;
  first.title = "Pressure over the gap", first.subtitle = waves;
  first.x = {"gap to the surface without them", ""}, first.y = {"pressure", "", true};
  first.curves = {law};
  if (rows.back().gap_scatter > 0) first.curves.insert(first.curves.end(), {low, high});
  second.title = "Real area of contact", second.subtitle = waves;
  second.x = {"pressure", "", true}, second.y = {"area in contact", "%", true};
  second.curves = {area};
  Pictures drawn;
  drawn.add("law", first), drawn.add("area", second);
  return drawn.draw(options.out);
}

void print(const Json& result) {
  Table table;
  table.column("pressure")
      .column("gap")
      .column("+-", "", 2)
      .column("area", "%", 3)
      .column("normal stiffness")
      .beside();
  table.column("tangential").column("h_c / k_s").column("scatter of p", "%", 2);
  for (const Json& level : result.at("levels"))
    table.row({level.at("pressure").get<double>(), level.at("gap").get<double>(),
               level.at("gap_scatter").get<double>(), 100 * level.at("area").get<double>(),
               level.at("normal_stiffness").get<double>(), level.at("tangential_stiffness").get<double>(),
               level.at("conductance_over_conductivity").get<double>(),
               100 * level.at("pressure_scatter").get<double>()});
  std::printf("%s: waves below %s, rms height %s, rms slope %s\n\n%s\n"
              "+-: standard deviation of the gap over %d realisation(s); scatter of p: of the mean pressure "
              "of boxes as "
              "wide as --from.\n",
              result.at("scan").get<std::string>().c_str(),
              format_number(result.at("from").get<double>()).c_str(),
              format_number(result.at("rms").get<double>()).c_str(),
              format_number(result.at("slope").get<double>()).c_str(), table.text().c_str(),
              result.at("realisations").get<int>());
}

} // namespace

int sublaw_command(const CommonOptions& common, const SublawOptions& options) {
  const OutputFolder folder(options.out);
  if (options.to > 0 && options.to >= options.from)
    throw InputError("--to " + format_number(options.to) + ": the shortest wave is shorter than --from " +
                     format_number(options.from));
  const EntsLibrary library(common.library);
  Scan scan = read_scan(options);
  const double longer = std::max(scan.lx, scan.ly), shortest = options.to > 0 ? options.to : scan.shortest;
  if (options.from > std::min(scan.lx, scan.ly))
    throw InputError("--from " + format_number(options.from) + ": the surface is only " +
                     format_number(scan.lx) + " x " + format_number(scan.ly) +
                     " large; take a wavelength of which several fit");
  const double wanted = shortest > 0 ? cells_per_wave * longer / shortest : most_cells;
  const int points =
      options.points > 0
          ? options.points
          : static_cast<int>(std::clamp(std::ceil(wanted), 1. * fewest_cells, 1. * most_cells));
  const auto along = [&](double length) {
    return std::max<Eigen::Index>(2, std::lround(points * length / longer));
  };
  const ElasticLayer cells = unit_half_space(along(scan.lx), along(scan.ly), scan.lx, scan.ly, scan.grid);
  const int realisations =
      scan.random ? (options.realisations > 0 ? options.realisations : usual_realisations) : 1;
  if (!scan.random && options.realisations > 1)
    throw InputError("--realisations: a measured surface has one; leave the option out");
  std::vector<WaveLaw> laws;
  double rms = 0, slope = 0;
  bool all_kept = true;
  const int first_seed = scan.random ? scan.random->value("seed", 0) : 0;
  for (int r = 0; r < realisations; ++r) {
    if (scan.random) (*scan.random)["seed"] = first_seed + r;
    Eigen::ArrayXXd waves =
        heights(library, scan, cells, options.from) - heights(library, scan, cells, options.to);
    waves -= waves.mean();
    rms = std::sqrt(waves.square().mean());
    slope = rms_slope(waves, cells.x(1) - cells.x(0), cells.y(1) - cells.y(0));
    if (!(rms > 1e-12 * longer))
      throw InputError("--from " + format_number(options.from) +
                       ": the surface has no waves between it and the "
                       "shortest one; take a longer wavelength");
    bool kept = false;
    laws.push_back(kept_wave_law(
        waves, cells, options.modulus,
        progress_on_stderr("surface " + std::to_string(r + 1) + " of " + std::to_string(realisations)),
        &kept));
    all_kept = all_kept && kept;
  }
  const std::vector<Row> rows = averaged(laws, options.from / longer * points);
  const Json result = result_of(scan, options, rows, rms, slope, realisations, all_kept);
  std::string problem;
  if (!options.out.empty()) {
    for (const auto& [name, text] :
         {std::pair{"sublaw.json", result}, std::pair{"law.json", result.at("model")}}) {
      std::ofstream file(options.out / name);
      file << text.dump(1) << '\n';
      if (!file.flush()) throw JobError((options.out / name).string() + ": cannot be written");
    }
    if (options.pictures) problem = draw(rows, options);
  }
  if (common.json)
    std::printf("%s\n", result.dump(2).c_str());
  else
    print(result);
  if (!common.json && !problem.empty()) std::printf("%s\n", problem.c_str());
  if (!common.json && !options.out.empty())
    std::printf("law.json: the part of a model; sublaw.json: all of this (%s)\n",
                options.out.string().c_str());
  return 0;
}

} // namespace host
