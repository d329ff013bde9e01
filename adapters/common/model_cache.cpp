// SPDX-License-Identifier: BSD-3-Clause
#include "model_cache.hpp"

#include "limits.hpp"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <string_view>

#include <nlohmann/json.hpp>

namespace ents_adapter {
namespace {

/// Numbers of one line, apart by blanks, tabs or commas.
/// @return false: something else is in it
bool read_numbers(const std::string& line, std::vector<double>& numbers) {
  const char *at = line.data(), *end = at + std::min(line.find_first_of("#\r"), line.size());
  numbers.clear();
  for (;;) {
    while (at != end && (*at == ' ' || *at == '\t' || *at == ',')) ++at;
    if (at == end) return true;
    double value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !std::isfinite(value)) return false;
    numbers.push_back(value);
    at = next;
  }
}

/// The line "slave_nodes n". @return n; 0: it is another line. @throws std::string
int read_slave_nodes(const std::string& line, const std::string& where, bool first) {
  constexpr std::string_view key = "slave_nodes";
  if (line.compare(0, key.size(), key) != 0) return 0;
  std::vector<double> number;
  if (!first || !read_numbers(line.substr(key.size()), number) || number.size() != 1 ||
      !(number[0] >= 1 && number[0] <= largest_slave_nodes) || number[0] != std::floor(number[0]))
    throw where + "write slave_nodes and a whole number from 1 to " + std::to_string(largest_slave_nodes) +
        ", before the first element";
  return static_cast<int>(number[0]);
}

/// The line "offsets"? @throws std::string
bool is_offsets(const std::string& line, const std::string& where, bool first) {
  constexpr std::string_view key = "offsets";
  if (line.compare(0, key.size(), key) != 0) return false;
  if (!first || line.find_first_not_of(" \t\r", key.size()) != std::string::npos)
    throw where + "write offsets alone in a line before the first element";
  return true;
}

/// A line "body X Y [Z]": a master node of a rigid body. @throws std::string
bool read_body(const std::string& line, const std::string& where, LoadedModel& loaded) {
  constexpr std::string_view key = "body";
  if (line.compare(0, key.size(), key) != 0) return false;
  const ents_layout& layout = loaded.layout;
  const auto d = static_cast<std::size_t>(layout.dimension);
  std::vector<double> x;
  if (!loaded.rows.empty() || !read_numbers(line.substr(key.size()), x) || x.size() != d)
    throw where + "write body and the " + std::to_string(d) +
        " coordinates of a master node relative to the reference node, before the first element";
  if (layout.heat)
    throw where + "a rigid body with a reference node has no temperature: remove \"heat\" from " +
        loaded.file + ", or take nodes of the mesh as the master";
  if (layout.multipliers || layout.dofs != layout.dimension)
    throw where + (layout.multipliers
                       ? "a rigid body takes no multipliers as unknowns: write another contact.normal.type, "
                         "\"augmented\" for one"
                       : "write \"master\": \"rigid\" into " + loaded.file + ", or remove the lines body");
  loaded.body.insert(loaded.body.end(), x.begin(), x.end());
  return true;
}

/// @throws std::string what is wrong, with the line
void read_rows(const std::string& file, LoadedModel& loaded) {
  std::error_code error;
  if (std::filesystem::symlink_status(file, error).type() == std::filesystem::file_type::not_found)
    return; // the file is optional
  const std::string advice = "; make it a text file with lines ELEMENT AREA, or remove it";
  if (!std::filesystem::is_regular_file(file, error)) throw file + " is not a file" + advice;
  std::ifstream in(file, std::ios::binary);
  if (!in) throw file + " cannot be opened for reading" + advice;
  const auto coordinates = static_cast<std::size_t>(loaded.layout.nodes * loaded.layout.parameters);
  std::string line;
  std::vector<double> numbers;
  for (int number = 1; std::getline(in, line); ++number) {
    const std::string where = file + ", line " + std::to_string(number) + ": ";
    if (const int n = read_slave_nodes(line, where, loaded.rows.empty())) {
      loaded.slave_nodes = n;
      continue;
    }
    if (is_offsets(line, where, loaded.rows.empty())) {
      loaded.offsets = true;
      continue;
    }
    if (read_body(line, where, loaded)) continue;
    if (!read_numbers(line, numbers)) throw where + "not a list of numbers";
    if (numbers.empty()) continue;
    const std::size_t weights = loaded.slave_nodes > 1 ? static_cast<std::size_t>(loaded.slave_nodes) : 0,
                      before = loaded.offsets ? 3 : 2;
    if (numbers.size() != before + weights && numbers.size() != before + weights + coordinates)
      throw where + "write ELEMENT AREA" + (loaded.offsets ? " OFFSET" : "") +
          (weights ? " and " + std::to_string(weights) + " weights of the slave's nodes" : std::string()) +
          ", or behind that " + std::to_string(coordinates) + " surface coordinates of the master nodes";
    if (numbers[0] < 1 || numbers[0] > 9e15 || numbers[0] != std::floor(numbers[0]))
      throw where + "the first number is the element's, a whole number > 0";
    if (numbers[1] <= 0)
      throw where + "the area is " + (numbers[1] < 0 ? "negative" : "0") +
          "; write the tributary area of the slave node, > 0";
    const auto first = numbers.begin() + static_cast<std::ptrdiff_t>(before),
               behind = first + static_cast<std::ptrdiff_t>(weights);
    ElementRow row{static_cast<std::int64_t>(numbers[0]),
                   numbers[1],
                   loaded.offsets ? numbers[2] : 0.0,
                   {first, behind},
                   {behind, numbers.end()}};
    if (const std::string wrong = wrong_weights(row.weights.data(), static_cast<int>(weights));
        !wrong.empty())
      throw where + wrong;
    loaded.rows.push_back(std::move(row));
  }
  if (in.bad()) throw file + " cannot be read to its end";
  if (const auto nodes = loaded.body.size() / static_cast<std::size_t>(loaded.layout.dimension);
      nodes != 0 && (nodes != static_cast<std::size_t>(loaded.layout.nodes) || nodes > largest_body_nodes))
    throw file + ": the body has " + std::to_string(nodes) + " lines, " + loaded.file + " has " +
        std::to_string(loaded.layout.nodes) + " master nodes; write a line body for each, " +
        std::to_string(largest_body_nodes) + " at most";
  const auto earlier = [](const ElementRow& a, const ElementRow& b) { return a.element < b.element; };
  std::sort(loaded.rows.begin(), loaded.rows.end(), earlier);
  for (std::size_t i = 1; i < loaded.rows.size(); ++i)
    if (loaded.rows[i].element == loaded.rows[i - 1].element)
      throw file + ": two lines for element " + std::to_string(loaded.rows[i].element);
}

ents_model* create(const nlohmann::json& model, const std::string& directory) {
  const std::string text = model.dump();
  ents_model* created = nullptr;
  ents_model_create(text.data(), static_cast<std::int64_t>(text.size()),
                    directory.empty() ? nullptr : directory.c_str(), nullptr, 0, &created, nullptr);
  return created;
}

/// @return null if the model has no height, or takes no start
ents_model* without_height(nlohmann::json model, const std::string& directory) {
  if (!model.contains("height") || model["height"].is_null() || model.contains("patch"))
    return nullptr; // on a patch the library finds the start by itself
  model["height"] = nullptr;
  return create(model, directory);
}

/// No force depends on a temperature: those of a model with heat are those of the same without.
bool has_symmetric_forces(nlohmann::json model, const std::string& directory) {
  model["contact"]["heat"] = nullptr;
  ents_model* forces = create(model, directory);
  ents_layout layout{};
  layout.struct_size = sizeof layout;
  const bool symmetric =
      forces && ents_model_layout(forces, &layout, nullptr) == ENTS_OK && layout.symmetric_tangent;
  ents_model_destroy(&forces, nullptr);
  return symmetric;
}

std::unique_ptr<LoadedModel> load(int number, const std::string& directory) {
  auto loaded = std::make_unique<LoadedModel>();
  const std::string stem = directory + "ents_" + std::to_string(number);
  loaded->file = stem + ".json";
  ents_report report{};
  report.struct_size = sizeof report;
  loaded->layout.struct_size = sizeof loaded->layout;
  if (ents_check_contract(ENTS_CONTRACT_MAJOR, ENTS_CONTRACT_MINOR, &report) != ENTS_OK ||
      ents_model_create_from_file(loaded->file.c_str(), &loaded->model, &report) != ENTS_OK ||
      ents_model_layout(loaded->model, &loaded->layout, &report) != ENTS_OK) {
    loaded->error = "model " + loaded->file + ": " + report.message;
    return loaded;
  }
  try {
    read_rows(stem + ".txt", *loaded);
  } catch (const std::string& error) {
    loaded->error = error;
  }
  if (!loaded->error.empty()) {
    ents_model_destroy(&loaded->model, nullptr);
    return loaded;
  }
  std::ifstream in(loaded->file, std::ios::binary);
  if (auto model = nlohmann::json::parse(in, nullptr, false); model.is_object()) {
    loaded->patch = model.contains("patch");
    loaded->symmetric_forces =
        loaded->layout.heat ? has_symmetric_forces(model, directory) : loaded->layout.symmetric_tangent != 0;
    loaded->base = without_height(std::move(model), directory);
  }
  return loaded;
}

} // namespace

std::string wrong_weights(const double* weights, int count) {
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += weights[i];
  if (count == 0 || std::abs(sum - 1) <= 1e-6) return "";
  return "the weights of the slave's nodes add up to " + std::to_string(sum) +
         "; those of a point add up to 1";
}

const ElementRow* LoadedModel::row(std::int64_t element) const {
  const auto at =
      std::lower_bound(rows.begin(), rows.end(), element,
                       [](const ElementRow& row, std::int64_t value) { return row.element < value; });
  return at != rows.end() && at->element == element ? &*at : nullptr;
}

const LoadedModel& model_number(int number, std::string (*directory)()) {
  // Never freed: host threads may still be in an evaluation when static objects are destroyed.
  static std::atomic<const LoadedModel*> known[largest_model_number + 1];
  static std::mutex& mutex = *new std::mutex;
  auto& slot = known[number];
  if (const LoadedModel* loaded = slot.load(std::memory_order_acquire)) return *loaded;
  const std::lock_guard lock(mutex);
  if (const LoadedModel* loaded = slot.load(std::memory_order_acquire)) return *loaded;
  const LoadedModel* loaded = load(number, directory()).release();
  slot.store(loaded, std::memory_order_release);
  return *loaded;
}

} // namespace ents_adapter
