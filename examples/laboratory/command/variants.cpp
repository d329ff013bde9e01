// SPDX-License-Identifier: BSD-3-Clause
// ents-lab variants: a scene and its variants side by side.
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

#include "commands.hpp"
#include "result.hpp"

namespace host {
namespace {

struct VariantRow {
  std::string name, failure;
  std::vector<Quantity> exact; ///< last step
  double penetration = 0;      ///< last step, over the size of the slave surface
  int steps = 0, iterations = 0, cuts = 0;
  double wall_time = 0;
};

VariantRow solve_variant(const Scene& scene, const std::string& name, const EntsLibrary& library) {
  VariantRow row;
  row.name = name;
  try {
    Simulation simulation(scene, &library);
    RunObserver observer;
    observer.step_done = [&](const Simulation&, const StepRecord& record) {
      ++row.steps;
      row.iterations += record.iterations();
      row.cuts += static_cast<int>(record.cuts.size());
    };
    const std::vector<StepRecord> records = solve(simulation, observer);
    row.exact = records.back().exact;
    row.penetration = records.back().penetration / simulation.contact()->size();
    row.wall_time = simulation.timings().total;
  } catch (const JobError& error) {
    row.failure = error.what();
  }
  return row;
}

} // namespace

int variants_command(const CommonOptions& common, const VariantsOptions& options) {
  const Scene scene = read_scene(options.scene);
  if (!scene.contact)
    throw InputError(options.scene.string() + ": variants are compared by their contact; here is none");
  if (scene.variants.empty())
    throw InputError(
        options.scene.string() +
        ": the scene has no key \"variants\", so there is nothing to compare; solve it with ents-lab run");
  const EntsLibrary library(common.library);
  std::vector<VariantRow> rows{solve_variant(scene, "as it is", library)};
  for (const Variant& variant : scene.variants)
    rows.push_back(solve_variant(read_scene(options.scene, variant.name), variant.name, library));

  Table table;
  table.column("variant").column("steps");
  for (const Quantity& quantity : rows.front().exact)
    if (quantity.compared) table.column(quantity.name, "error, %", 3);
  table.column("penetration", "/ size", 2).column("iterations").column("cuts").column("time", "s", 2);
  Json json = Json::array();
  for (const VariantRow& row : rows) {
    std::vector<Table::Cell> cells{row.name, static_cast<std::int64_t>(row.steps)};
    Json exact = Json::array();
    for (const Quantity& quantity : rows.front().exact) {
      if (!quantity.compared) continue;
      double error = std::numeric_limits<double>::quiet_NaN();
      for (const Quantity& mine : row.exact)
        if (mine.name == quantity.name) error = mine.error;
      cells.emplace_back(100 * error);
      exact.push_back(
          {{"name", quantity.name}, {"relative_error", std::isfinite(error) ? Json(error) : Json()}});
    }
    if (row.failure.empty())
      cells.insert(cells.end(), {row.penetration, static_cast<std::int64_t>(row.iterations),
                                 static_cast<std::int64_t>(row.cuts), row.wall_time});
    else
      cells.insert(cells.end(), {std::monostate{}, static_cast<std::int64_t>(row.iterations),
                                 static_cast<std::int64_t>(row.cuts), std::monostate{}});
    table.row(std::move(cells));
    json.push_back({{"variant", row.name},
                    {"steps", row.steps},
                    {"exact", exact},
                    {"penetration", row.penetration},
                    {"iterations", row.iterations},
                    {"cuts", row.cuts},
                    {"wall_time", row.wall_time},
                    {"failure", row.failure}});
  }
  if (common.json) {
    std::printf("%s\n", json.dump(2).c_str());
    return 0;
  }
  std::printf("%s: last step, all iterations\n\n%s", scene.title.c_str(), table.text().c_str());
  for (const VariantRow& row : rows)
    if (!row.failure.empty()) std::printf("\n%s: %s\n", row.name.c_str(), row.failure.c_str());
  return 0;
}

} // namespace host
