// SPDX-License-Identifier: BSD-3-Clause
// ents-lab verify: golden vectors through the ABI.
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

#include "commands.hpp"
#include "ents_library.hpp"
#include "output/table.hpp"
#include "toolbox/json_reader.hpp"

namespace host {
namespace {

/// Names in the golden files, in the order of the table.
constexpr std::array<const char*, 8> quantities{"xi",    "normal", "gap",  "normal_gap",
                                                "d_gap", "d2_gap", "d_xi", "d2_xi"};

struct Worst {
  double error = 0;
  std::string quantity, name; ///< of the case
};

/// All numbers of a nested array, row by row.
void flatten(const JsonValue& value, std::vector<double>& numbers) {
  if (value.is_array())
    for (const JsonValue& item : value.items()) flatten(item, numbers);
  else
    numbers.push_back(value.number());
}

std::vector<double> flatten(const JsonValue& value) {
  std::vector<double> numbers;
  flatten(value, numbers);
  return numbers;
}

/// Largest distance of two master nodes: the length gaps are measured by.
double segment_size(const std::vector<double>& master, std::size_t d) {
  double squared = 0;
  for (std::size_t a = 0; a < master.size(); a += d)
    for (std::size_t b = a + d; b < master.size(); b += d) {
      double sum = 0;
      for (std::size_t i = 0; i < d; ++i)
        sum += (master[a + i] - master[b + i]) * (master[a + i] - master[b + i]);
      squared = std::max(squared, sum);
    }
  return std::sqrt(squared);
}

/// What the library answers for a case, by the golden files' names.
std::map<std::string, std::vector<double>> evaluate(const EntsModel& model, const std::vector<double>& slave,
                                                    const std::vector<double>& master,
                                                    const std::vector<double>& start, std::int32_t& status,
                                                    ents_report& report) {
  const auto d = static_cast<std::size_t>(model.layout().dimension), p = d - 1;
  const auto dofs = static_cast<std::size_t>(model.layout().dofs);
  std::map<std::string, std::vector<double>> result{{"xi", std::vector<double>(p)},
                                                    {"normal", std::vector<double>(d)},
                                                    {"gap", {0}},
                                                    {"normal_gap", {0}},
                                                    {"d_gap", std::vector<double>(dofs)},
                                                    {"d2_gap", std::vector<double>(dofs * dofs)},
                                                    {"d_xi", std::vector<double>(p * dofs)},
                                                    {"d2_xi", std::vector<double>(p * dofs * dofs)}};
  auto in = ents_struct<ents_input>();
  in.slave = slave.data();
  in.master = master.data();
  in.start = start.data();
  auto out = ents_struct<ents_output>();
  out.wanted = ENTS_XI | ENTS_NORMAL | ENTS_GAP | ENTS_NORMAL_GAP | ENTS_GAP_GRADIENT | ENTS_GAP_HESSIAN |
               ENTS_XI_GRADIENT | ENTS_XI_HESSIAN;
  const auto size = [&](const char* name) { return static_cast<std::int64_t>(result.at(name).size()); };
  out.xi = result.at("xi").data(), out.xi_stride = size("xi");
  out.normal = result.at("normal").data(), out.normal_stride = size("normal");
  out.gap = result.at("gap").data(), out.gap_stride = 1;
  out.normal_gap = result.at("normal_gap").data(), out.normal_gap_stride = 1;
  out.gap_gradient = result.at("d_gap").data(), out.gap_gradient_stride = size("d_gap");
  out.gap_hessian = result.at("d2_gap").data(), out.gap_hessian_stride = size("d2_gap");
  out.xi_gradient = result.at("d_xi").data(), out.xi_gradient_stride = size("d_xi");
  out.xi_hessian = result.at("d2_xi").data(), out.xi_hessian_stride = size("d2_xi");
  status = model.library().evaluate(model.get(), 0, 1, &in, &out, &report);
  return result;
}

/// One case: the error of each quantity, and where it failed if it did.
Worst verify_case(const EntsLibrary& library, const JsonValue& value, const std::filesystem::path& folder,
                  std::map<std::string, double>& errors) {
  JsonObject object(value);
  Worst worst;
  worst.name = object.string_or("name", value.where());
  Json model;
  for (const char* key : {"segment", "height", "projection"}) model[key] = object.at(key).json();
  if (object.has("surface_coordinates"))
    model["surface_coordinates"] = object.at("surface_coordinates").json();
  const EntsModel ents(library, model.dump(), folder, value.where());
  const auto d = static_cast<std::size_t>(ents.layout().dimension);
  const std::vector<double> slave = object.at("slave").numbers(d), start = object.at("start").numbers(d - 1);
  const JsonValue nodes = object.at("master");
  const std::vector<double> master = flatten(nodes);
  if (master.size() != static_cast<std::size_t>(ents.layout().nodes) * d)
    nodes.fail(std::to_string(ents.layout().nodes) + " nodes of " + std::to_string(d) +
               " coordinates are expected");

  std::int32_t status = ENTS_OK;
  auto report = ents_struct<ents_report>();
  const auto answer = evaluate(ents, slave, master, start, status, report);
  JsonObject expected(object.at("expected"));
  for (const char* name : quantities) {
    if (!expected.has(name)) continue;
    const JsonValue entry = expected.at(name);
    const std::vector<double> exact = flatten(entry);
    const std::vector<double>& computed = answer.at(name);
    if (exact.size() != computed.size())
      entry.fail(std::to_string(computed.size()) + " numbers are expected, there are " +
                 std::to_string(exact.size()));
    double largest = 0, difference = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      largest = std::max(largest, std::abs(exact[i]));
      difference = std::max(difference, std::abs(computed[i] - exact[i]));
      if (std::isnan(computed[i])) difference = std::numeric_limits<double>::infinity();
    }
    const std::string word = name;
    if (word == "gap" || word == "normal_gap") largest = segment_size(master, d);
    double error = difference == 0 ? 0 : difference / largest;
    if (status != ENTS_OK) error = std::numeric_limits<double>::infinity();
    errors[word] = std::max(errors[word], error);
    if (error > worst.error) worst.error = error, worst.quantity = word;
  }
  expected.finish();
  object.finish();
  if (status != ENTS_OK)
    std::fprintf(stderr, "%s: %s\n", worst.name.c_str(), describe(library, status, report).c_str());
  return worst;
}

std::string scientific(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2e", value);
  return text;
}

} // namespace

int verify_command(const CommonOptions& common, const VerifyOptions& options) {
  const EntsLibrary library(common.library);
  Table table;
  table.column("file").column("cases");
  for (const char* name : quantities) table.column(name, "", 2);
  Worst worst;
  std::size_t cases = 0;
  Json files = Json::array();
  for (const std::filesystem::path& file : options.files) {
    const Json json = parse_json_file(file);
    JsonObject object(JsonValue(json, file.string() + ": "));
    object.has("about");
    const std::vector<JsonValue> items = object.at("cases").items();
    object.finish();
    std::map<std::string, double> errors;
    for (const JsonValue& item : items) {
      const Worst here = verify_case(library, item, file.parent_path(), errors);
      if (here.error > worst.error || worst.name.empty()) worst = here;
    }
    cases += items.size();
    std::vector<Table::Cell> row{file.filename().string(), static_cast<std::int64_t>(items.size())};
    Json entry{{"file", file.string()}, {"cases", items.size()}, {"errors", Json::object()}};
    for (const char* name : quantities) {
      const auto found = errors.find(name);
      row.push_back(found == errors.end() ? Table::Cell{} : Table::Cell{scientific(found->second)});
      if (found != errors.end()) entry["errors"][name] = found->second;
    }
    table.row(std::move(row));
    files.push_back(std::move(entry));
  }
  if (cases == 0) throw InputError("the files hold no cases");
  const bool passed = worst.error <= options.tolerance;
  if (common.json) {
    const Json result{
        {"cases", cases},     {"worst_relative_error", worst.error}, {"quantity", worst.quantity},
        {"case", worst.name}, {"tolerance", options.tolerance},      {"passed", passed},
        {"files", files}};
    std::printf("%s\n", result.dump(2).c_str());
  } else {
    std::printf("%s", table.text().c_str());
    std::printf("verify: %zu cases, worst relative error %s (%s in %s)\n", cases,
                scientific(worst.error).c_str(), worst.quantity.c_str(), worst.name.c_str());
  }
  return passed ? 0 : 1;
}

} // namespace host
