// SPDX-License-Identifier: BSD-3-Clause
#include "compare.hpp"

#include <cmath>
#include <cstdio>
#include <limits>

#include "check_extent.hpp"
#include "commands.hpp"
#include "output/text_file.hpp"
#include "output_folder.hpp"
#include "result.hpp"
#include "toolbox/error.hpp"

namespace host {
namespace {

/// Finest explicit mesh that is solved for the price at equal error, segments per direction.
constexpr double finest_line = 20000, finest_patch = 1024;

/// Differences that fall more slowly with the segment length do not converge.
constexpr double least_order = 0.1;

/// By so much a mesh may miss the difference that the fit has promised.
constexpr double within_fit = 4. / 3;

struct SolvedScene {
  CompareRow row;
  std::vector<double> displacement; ///< [slaves][d], last step
  std::vector<double> areas;        ///< [slaves]
  double approach = 0, force = 0;
};

SolvedScene solve_once(const Scene& scene, const EntsLibrary& library, int divisions,
                       const RunObserver& observer) {
  if (observer.line)
    observer.line(divisions == 0 ? "one enriched segment"
                                 : "explicit mesh, " + std::to_string(divisions) + " segments per direction");
  Simulation simulation(scene, &library, divisions);
  if (divisions == 0) note_small_maps(scene, {}); // the master is rigid
  const std::vector<StepRecord> records = solve(simulation, {});
  SolvedScene solution;
  solution.row.divisions = divisions;
  solution.row.sizes = simulation.sizes();
  solution.row.wall_time = simulation.timings().total;
  solution.row.contact_time = simulation.timings().contact;
  solution.row.exact = records.back().exact;
  const auto d = static_cast<std::size_t>(scene.dimension);
  const SlavePoints& slaves = simulation.contact()->slaves();
  for (std::size_t k = 0; k < slaves.size(); ++k) {
    const auto moved = slaves.combine(k, simulation.now().displacement, d);
    solution.displacement.insert(solution.displacement.end(), moved.begin(), moved.begin() + scene.dimension);
  }
  solution.areas = simulation.contact()->areas();
  solution.approach = records.back().approach;
  solution.force = records.back().force;
  return solution;
}

void measure_difference(const Scene& scene, const SolvedScene& enriched, SolvedScene& other) {
  const auto d = static_cast<std::size_t>(scene.dimension);
  double difference = 0, norm = 0;
  for (std::size_t i = 0; i < enriched.displacement.size(); ++i) {
    const double area = enriched.areas[i / d];
    difference += area * std::pow(other.displacement[i] - enriched.displacement[i], 2);
    norm += area * std::pow(enriched.displacement[i], 2);
  }
  other.row.difference = std::sqrt(difference / norm);
  other.row.force_difference = scene.control == Control::approach
                                   ? std::abs(other.force / enriched.force - 1)
                                   : std::abs(other.approach / enriched.approach - 1);
}

/// Least squares of log difference over log divisions.
void fit_order(Comparison& comparison) {
  comparison.order = comparison.constant = std::numeric_limits<double>::quiet_NaN();
  if (comparison.explicit_meshes.size() < 2) return; // one mesh shows no order
  const double n = static_cast<double>(comparison.explicit_meshes.size());
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const CompareRow& row : comparison.explicit_meshes) {
    const double a = std::log(row.divisions), b = std::log(row.difference);
    x += a, y += b, xx += a * a, xy += a * b;
  }
  const double slope = (n * xy - x * y) / (n * xx - x * x);
  comparison.order = -slope;
  comparison.constant = std::exp((y - slope * x) / n);
}

const Quantity* main_quantity(const CompareRow& row) {
  for (const Quantity& quantity : row.exact)
    if (!std::isnan(quantity.error)) return &quantity;
  return nullptr;
}

Json row_json(const CompareRow& row) {
  Json result{{"divisions", row.divisions},
              {"master_segments", row.sizes.master_segments},
              {"contact_elements", row.sizes.slaves},
              {"dofs", row.sizes.dofs},
              {"master_dofs", row.sizes.master_dofs},
              {"wall_time", row.wall_time},
              {"contact_time", row.contact_time},
              {"difference", row.difference},
              {"force_difference", row.force_difference}};
  if (const Quantity* quantity = main_quantity(row)) {
    result["exact"] = quantity->name;
    result["relative_error"] = quantity->error;
  }
  return result;
}

} // namespace

Comparison compare(const Scene& scene, const EntsLibrary& library, const std::vector<int>& divisions,
                   bool equal_error, const RunObserver& observer) {
  if (!scene.contact || scene.contact->rigid.empty())
    throw InputError(scene.file.string() + ": only a scene with a rigid master can be compared");
  Comparison comparison;
  SolvedScene enriched = solve_once(scene, library, 0, observer);
  // What this process does for the first time (pages of memory above all) is no part of the comparison.
  constexpr double short_run = 5; // [s]
  if (enriched.row.wall_time < short_run) enriched = solve_once(scene, library, 0, {});
  comparison.enriched = enriched.row;
  comparison.error = scene.compare.error;
  for (const int n : divisions) {
    SolvedScene other = solve_once(scene, library, n, observer);
    measure_difference(scene, enriched, other);
    comparison.explicit_meshes.push_back(other.row);
  }
  fit_order(comparison);
  if (!equal_error || !(comparison.order > least_order)) return comparison;
  const double needed = std::pow(comparison.constant / comparison.error, 1 / comparison.order);
  if (needed > (scene.dimension == 2 ? finest_line : finest_patch)) return comparison;
  const int asked = std::max(1, static_cast<int>(std::ceil(needed)));
  SolvedScene other;
  try {
    other = solve_once(scene, library, asked, observer);
  } catch (const JobError& error) { // this mesh is nobody's choice: the others keep their table
    comparison.unsolved = std::to_string(asked) + " segments per direction: " + error.what();
    return comparison;
  }
  measure_difference(scene, enriched, other);
  (other.row.difference <= within_fit * comparison.error ? comparison.equal_error : comparison.missed)
      .push_back(other.row);
  return comparison;
}

namespace {

Table table_of(const Scene& scene, const Comparison& comparison) {
  Table table;
  table.column("master").column("contact elements").column("segments").column("total dofs");
  table.column("wall time", "s", 3).column("contact", "s", 2);
  table.column("difference", "surface displacement", 2);
  table.column("difference", scene.control == Control::approach ? "force" : "approach", 2);
  const Quantity* reference = main_quantity(comparison.enriched);
  if (reference != nullptr) table.column("error", reference->name, 2);
  const auto add = [&](const CompareRow& row, const std::string& label) {
    std::vector<Table::Cell> cells{label,
                                   static_cast<std::int64_t>(row.sizes.slaves),
                                   static_cast<std::int64_t>(row.sizes.master_segments),
                                   static_cast<std::int64_t>(row.sizes.dofs + row.sizes.master_dofs),
                                   row.wall_time,
                                   row.contact_time};
    if (row.divisions == 0)
      cells.insert(cells.end(), {Table::Cell{}, Table::Cell{}});
    else
      cells.insert(cells.end(), {row.difference, row.force_difference});
    if (reference != nullptr) {
      const Quantity* quantity = main_quantity(row);
      cells.push_back(quantity == nullptr ? Table::Cell{} : Table::Cell{quantity->error});
    }
    table.row(std::move(cells));
  };
  const auto label = [&](const CompareRow& row) {
    const std::string n = std::to_string(row.divisions);
    return "explicit " + (scene.dimension == 2 ? n : n + " x " + n);
  };
  add(comparison.enriched, "one enriched segment");
  for (const CompareRow& row : comparison.explicit_meshes) add(row, label(row));
  for (const CompareRow& row : comparison.equal_error) add(row, label(row) + ", equal error");
  for (const CompareRow& row : comparison.missed) add(row, label(row) + ", from the fit");
  return table;
}

Json json_of(const Scene& scene, const Comparison& comparison) {
  Json result{{"title", scene.title},
              {"order", std::isnan(comparison.order) ? Json() : Json(comparison.order)},
              {"equal_error", comparison.error},
              {"enriched", row_json(comparison.enriched)},
              {"explicit", Json::array()},
              {"explicit_at_equal_error", Json::array()},
              {"explicit_from_fit", Json::array()}};
  if (!comparison.unsolved.empty()) result["explicit_unsolved"] = comparison.unsolved;
  for (const CompareRow& row : comparison.explicit_meshes) result["explicit"].push_back(row_json(row));
  for (const CompareRow& row : comparison.equal_error)
    result["explicit_at_equal_error"].push_back(row_json(row));
  for (const CompareRow& row : comparison.missed) result["explicit_from_fit"].push_back(row_json(row));
  return result;
}

void print_order(const Comparison& comparison) {
  const std::string wanted = format_number(comparison.error, 2);
  if (std::isnan(comparison.order)) {
    std::printf("one mesh shows no order of convergence; give two or more\n");
    return;
  }
  if (!(comparison.order > least_order)) {
    std::printf("the differences do not fall with the segment length: there is no order of convergence\n");
    return;
  }
  std::printf("the explicit meshes converge to the enriched segment with order %s in their segment length\n",
              format_number(comparison.order, 3).c_str());
  if (!comparison.missed.empty())
    std::printf("a difference of %s is not reached: the fit asks for %d segments per direction, and these "
                "come within %s; "
                "finer meshes in the list make a better fit\n",
                wanted.c_str(), comparison.missed[0].divisions,
                format_number(comparison.missed[0].difference, 2).c_str());
  else if (!comparison.unsolved.empty())
    std::printf("the mesh that the fit asks for at a difference of %s cannot be solved, %s\n", wanted.c_str(),
                comparison.unsolved.c_str());
  else if (comparison.equal_error.empty())
    std::printf("an explicit mesh that comes within %s of it is out of reach here\n", wanted.c_str());
}

} // namespace

int compare_command(const CommonOptions& common, const RunOptions& options) {
  const Scene scene = read_scene(options.scene, options.variant);
  const std::vector<int>& divisions =
      options.compare_divisions.empty() ? scene.compare.divisions : options.compare_divisions;
  if (divisions.empty()) throw InputError("--compare: give N1,N2,...; the scene has no list of its own");
  const OutputFolder folder(options.out);
  const EntsLibrary library(common.library);
  RunObserver observer;
  if (!common.json)
    observer.line = [](const std::string& line) {
      std::printf("%s\n", line.c_str());
      std::fflush(stdout);
    };
  const Comparison comparison = compare(scene, library, divisions, true, observer);

  const Table table = table_of(scene, comparison);
  const Json result = json_of(scene, comparison);
  if (!options.out.empty()) {
    write_text(options.out / "compare.json", result.dump(2) + "\n");
    write_text(options.out / "compare.md", table.markdown());
    if (options.pictures)
      if (const std::string problem = draw_comparison(scene, comparison, options.out); !problem.empty())
        std::fprintf(stderr, "%s\n", problem.c_str());
  }
  if (common.json) {
    std::printf("%s\n", result.dump(2).c_str());
    return 0;
  }
  std::printf("\n%s\n", table.text().c_str());
  print_order(comparison);
  return 0;
}

} // namespace host
