// SPDX-License-Identifier: BSD-3-Clause
#include "result.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "output.hpp"

namespace host {
namespace {

const char* control_name(Control control) {
  switch (control) {
  case Control::load_factor:
    return "load_factor";
  case Control::approach:
    return "approach";
  case Control::force:
    return "force";
  case Control::mean_pressure:
    return "mean_pressure";
  }
  return "";
}

/// One array per field, in the order of the slave nodes.
Json nodes_json(const StepRecord& record) {
  const ContactFields& fields = record.fields;
  const auto column = [](const std::vector<double>& values) {
    Json array = Json::array();
    for (const double value : values) array.push_back(number(value));
    return array;
  };
  Json status = Json::array();
  for (const std::int32_t flags : fields.flags) {
    static constexpr std::array<const char*, 4> names{"open", "stick", "slip", "shear limit"};
    status.push_back(names[static_cast<std::size_t>(status_number(flags))]);
  }
  Json nodes{{"position", column(record.positions)},
             {"gap", column(fields.gap)},
             {"normal_gap", column(fields.normal_gap)},
             {"pressure", column(fields.pressure)},
             {"traction", column(fields.traction)},
             {"slip", column(fields.slip)},
             {"age", column(fields.age)},
             {"status", status},
             {"segment", fields.segment},
             {"force", column(fields.node_forces)}};
  if (!fields.worn.empty()) nodes["worn"] = column(fields.worn);
  return nodes;
}

Json energy_json(const EnergyBalance& energy) {
  return {{"work", energy.work},   {"stored", energy.stored},           {"dissipated", energy.dissipated},
          {"lost", energy.lost()}, {"uncertainty", energy.uncertainty}, {"jumped", energy.jumped},
          {"torn", energy.gained}};
}

Json step_json(const Scene& scene, const StepRecord& record, bool nodes) {
  Json step{{"step", record.step},
            {"value", record.value},
            {"approach", record.approach},
            {"force", record.force},
            {"mean_pressure", number(record.mean_pressure)},
            {"contact_fraction", record.contact_fraction},
            {"contact_estimate",
             {{"fraction", number(record.area.fraction)},
              {"error", number(record.area.error)},
              {"border_corrected", number(record.area.border_corrected)},
              {"zero_line", number(record.area.zero_line)}}},
            {"peak_drop", number(record.area.peak_drop)},
            {"peak_pressure", record.peak_pressure},
            {"mean_gap", number(record.mean_gap)},
            {"mean_cubed_gap", number(record.mean_cubed_gap)},
            {"penetration", record.penetration},
            {"contact_force", record.contact_force},
            {"iterations", record.iterations()},
            {"cuts", record.cuts},
            {"wall_time", record.wall_time}};
  if (record.conductance != 0) step["conductance"] = number(record.conductance);
  if (!record.fields.worn.empty())
    step["wear"] = {{"slave_volume", record.worn_slave},
                    {"master_volume", record.worn_master},
                    {"slave_depth", record.worn_depth}};
  if (!record.moment.empty()) {
    const auto turns = record.body_moved.begin() + (record.moment.size() == 1 ? 2 : 3);
    step["moment"] = record.moment;
    step["reference_point"] = {{"displacement", std::vector(record.body_moved.begin(), turns)},
                               {"turns", std::vector(turns, record.body_moved.end())},
                               {"rotation", record.body_rotation}};
  }
  if (scene.contact) step["resultants"] = resultants_json(record.resultants, scene.dimension);
  if (record.dissipated != 0) step["dissipated"] = record.dissipated;
  if (record.heat != 0)
    step["heat"] = {{"power", record.heat},
                    {"slave", scene.contact->heat_slave * record.heat},
                    {"master", (1 - scene.contact->heat_slave) * record.heat}};
  if (const auto energy = record.energy()) step["energy"] = energy_json(*energy);
  step["increments"] = Json::array();
  for (const IncrementRecord& increment : record.increments) {
    const Convergence rate = convergence(increment.residuals);
    step["increments"].push_back({{"value", increment.value},
                                  {"residuals", increment.residuals},
                                  {"status_changes", increment.status_changes},
                                  {"last_reductions", {number(rate.before), number(rate.last)}},
                                  {"order", number(rate.order)}});
    if (increment.rounding > 0) step["increments"].back()["rounding"] = increment.rounding;
    if (increment.descents > 0) step["increments"].back()["descents"] = increment.descents;
    if (increment.halvings > 0) step["increments"].back()["halvings"] = increment.halvings;
    for (const Augmentation& augmentation : increment.augmentations)
      step["increments"].back()["augmentations"].push_back(
          {{"error", augmentation.error}, {"iterations", augmentation.iterations}});
  }
  if (nodes) step["nodes"] = nodes_json(record);
  step["exact"] = Json::array();
  for (const Quantity& quantity : record.exact)
    step["exact"].push_back({{"name", quantity.name},
                             {"unit", quantity.unit},
                             {"value", number(quantity.value)},
                             {"exact", number(quantity.exact)},
                             {"relative_error", number(quantity.error)}});
  return step;
}

} // namespace

int status_number(std::int32_t flags) {
  if ((flags & ENTS_FLAG_CONTACT) == 0) return 0;
  if ((flags & ENTS_FLAG_SLIP) == 0) return 1;
  return (flags & ENTS_FLAG_SHEAR_LIMIT) == 0 ? 2 : 3;
}

Json result_json(const Simulation& simulation, const std::vector<StepRecord>& records, bool nodes,
                 const StepFailure* failure) {
  const Scene& scene = simulation.scene();
  const Sizes sizes = simulation.sizes();
  const Timings& timings = simulation.timings();
  Json result{
      {"title", scene.title},
      {"scene", scene.file.string()},
      {"solver", simulation.solver_name()},
      {"units",
       {{"length", scene.units.length}, {"force", scene.units.force}, {"pressure", scene.units.pressure}}},
      {"control", control_name(scene.control)},
      {"symmetry_copies", scene.symmetry_copies},
      {"sizes",
       {{"nodes", sizes.nodes},
        {"elements", sizes.elements},
        {"dofs", sizes.dofs},
        {"equations", sizes.equations},
        {"contact_elements", sizes.slaves},
        {"master_segments", sizes.master_segments},
        {"master_dofs", sizes.master_dofs}}},
      {"wall_time",
       {{"setup", timings.setup},
        {"bulk", timings.bulk},
        {"contact", timings.contact},
        {"solver", timings.solver},
        {"total", timings.total}}}};
  result["resolution"] = json_of(simulation.resolution());
  result["fingerprint"] = simulation.fingerprint();
  result["failure"] =
      failure == nullptr ? Json() : Json{{"step", failure->step}, {"reason", failure->what()}};
  result["steps"] = Json::array();
  for (const StepRecord& record : records) result["steps"].push_back(step_json(scene, record, nodes));
  return result;
}

namespace {

bool wears(const std::vector<StepRecord>& records) {
  return !records.empty() && !records.front().fields.worn.empty();
}

} // namespace

void add_energy_of_run(Json& result) {
  double work = 0, stored = 0, dissipated = 0, lost = 0, in_jumps = 0, uncertainty = 0;
  int jumps = 0, steps = 0;
  for (const Json& step : result.at("steps")) {
    if (!step.contains("energy")) continue; // the first, where the surfaces overlap before it
    const Json& energy = step.at("energy");
    ++steps;
    work += energy.at("work").get<double>(), stored += energy.at("stored").get<double>();
    dissipated += energy.at("dissipated").get<double>(), lost += energy.at("lost").get<double>();
    if (!energy.at("jumped").get<bool>()) continue;
    ++jumps;
    in_jumps += energy.at("lost").get<double>(), uncertainty += energy.at("uncertainty").get<double>();
  }
  if (steps == 0) return;
  result["energy"] = {{"work", work},
                      {"stored", stored},
                      {"dissipated", dissipated},
                      {"lost", lost},
                      {"lost_in_jumps", in_jumps},
                      {"uncertainty_of_jumps", uncertainty},
                      {"steps_with_jumps", jumps}};
}

Table result_table(const Scene& scene, const std::vector<StepRecord>& records) {
  Table table;
  table.column("step");
  const bool rigid = scene.contact && !scene.contact->rigid.empty();
  if (rigid) {
    table.column("approach", scene.units.length).column("force", scene.units.force);
    table.column("mean pressure", scene.units.pressure);
  } else {
    table.column("load factor");
  }
  const bool pair = scene.contact && !rigid;
  if (pair) table.column("normal force", scene.units.force).column("tangential", scene.units.force);
  if (scene.contact) {
    table.column("peak pressure", scene.units.pressure).column("contact", "%", 3);
    table.column("estimated", "%", 3).column("+-", "%", 2).beside();
    table.column("mean gap", scene.units.length);
    if (scene.probe > 0)
      table.column("<g^3>", cubic(scene.units.length)).column("h_c / k_s", "1/" + scene.units.length);
    if (wears(records))
      table.column("worn depth", scene.units.length).column("worn volume", cubic(scene.units.length));
  }
  const bool energies = !records.empty() && records.back().energy().has_value();
  const std::string unit = scene.units.force + (scene.units.force.empty() ? "" : " ") + scene.units.length;
  if (energies) table.column("lost in jumps", unit, 4).column("+-", unit, 1).beside();
  table.column("iterations").column("reduction", "last but one", 2).beside();
  table.column("reduction", "last", 2).beside();
  for (const StepRecord& record : records) {
    std::vector<Table::Cell> row{static_cast<std::int64_t>(record.step)};
    if (rigid)
      row.insert(row.end(), {record.approach, record.force, record.mean_pressure});
    else
      row.emplace_back(record.value);
    if (pair) {
      const std::vector<double>& force =
          record.contact_force; // the last axis is the normal one in our scenes
      double squared = 0;
      for (std::size_t i = 0; i + 1 < force.size(); ++i) squared += force[i] * force[i];
      row.insert(row.end(), {-force.back(), std::sqrt(squared)});
    }
    if (scene.contact)
      row.insert(row.end(), {record.peak_pressure, 100 * record.contact_fraction, 100 * record.area.fraction,
                             100 * record.area.error, record.mean_gap});
    if (scene.contact && scene.probe > 0) row.insert(row.end(), {record.mean_cubed_gap, record.conductance});
    if (wears(records)) row.insert(row.end(), {record.worn_depth, record.worn_slave + record.worn_master});
    if (energies) {
      const auto energy = record.energy();
      const bool jumped = energy && energy->jumped;
      row.insert(row.end(), {jumped ? energy->lost() : 0.0, jumped ? energy->uncertainty : 0.0});
    }
    const Convergence rate = convergence(record.increments.back().residuals);
    row.insert(row.end(), {static_cast<std::int64_t>(record.iterations()), rate.before, rate.last});
    table.row(std::move(row));
  }
  return table;
}

Table resultants_table(const Scene& scene, const std::vector<StepRecord>& records) {
  const UnitNames& units = scene.units;
  const std::string moment = units.force + (units.force.empty() ? "" : " ") + units.length;
  const bool rubs = !find_json(scene.contact->model, "/contact/friction").is_null();
  Table table;
  table.column("step").column("normal force", units.force);
  if (rubs) table.column("tangential", units.force);
  table.column("moment", moment).column("largest pressure", units.pressure);
  for (int c = 0; c < scene.dimension; ++c) table.column(std::string("centre ") + "xyz"[c], units.length, 4);
  table.column("open").column("contact");
  if (rubs) table.column("stick").column("slip");
  const auto norm = [](const double* v) { return std::hypot(v[0], v[1], v[2]); };
  for (const StepRecord& record : records) {
    const ents_resultants& sum = record.resultants;
    std::vector<Table::Cell> row{static_cast<std::int64_t>(record.step), norm(sum.normal)};
    if (rubs) row.emplace_back(norm(sum.tangential));
    row.insert(row.end(), {norm(sum.moment), sum.largest_pressure});
    for (int c = 0; c < scene.dimension; ++c) row.emplace_back(sum.centre[c]);
    row.insert(row.end(), {sum.open, sum.contact});
    if (rubs) row.insert(row.end(), {sum.stick, sum.slip});
    table.row(std::move(row));
  }
  return table;
}

std::string exact_table(const std::vector<StepRecord>& records) {
  // A quantity may be known in some steps only (full contact): its cells are empty in the others.
  std::vector<const Quantity*> columns;
  for (const StepRecord& record : records)
    for (const Quantity& quantity : record.exact)
      if (std::none_of(columns.begin(), columns.end(),
                       [&](const Quantity* column) { return column->name == quantity.name; }))
        columns.push_back(&quantity);
  if (columns.empty()) return "";
  Table table;
  table.column("step");
  for (const Quantity* column : columns) {
    table.column(column->name, column->unit, 5);
    if (column->compared) table.column("exact", column->unit, 5).beside().column("error", "%", 2).beside();
  }
  for (const StepRecord& record : records) {
    std::vector<Table::Cell> row{static_cast<std::int64_t>(record.step)};
    for (const Quantity* column : columns) {
      const auto found =
          std::find_if(record.exact.begin(), record.exact.end(),
                       [&](const Quantity& quantity) { return quantity.name == column->name; });
      const Quantity unknown{"", "", std::numeric_limits<double>::quiet_NaN()}; // shown as a dash
      const Quantity& quantity = found == record.exact.end() ? unknown : *found;
      row.emplace_back(quantity.value);
      if (column->compared) row.insert(row.end(), {quantity.exact, 100 * quantity.error});
    }
    table.row(std::move(row));
  }
  return table.text();
}

} // namespace host
