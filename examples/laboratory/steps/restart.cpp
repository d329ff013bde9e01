// SPDX-License-Identifier: BSD-3-Clause
#include "restart.hpp"

#include <algorithm>

#include "hash.hpp"
#include "output/table.hpp"

namespace host {
namespace {

/// Do supports or tractions follow the load factor?
bool loads_follow(const Scene& scene) {
  return !scene.tractions.empty() || std::any_of(scene.supports.begin(), scene.supports.end(),
                                                 [](const SupportSpec& support) { return support.moves(); });
}

/// Later steps may be other ones: smaller, more, fewer.
void check_steps(const JsonValue& values, const Simulation& simulation, int step) {
  const Scene& scene = simulation.scene();
  const int count = static_cast<int>(scene.steps.size());
  if (step > count)
    values.fail("the checkpoint was written after step " + std::to_string(step) + ", the scene has " +
                std::to_string(count));
  const std::vector<double> before = values.numbers(static_cast<std::size_t>(step));
  for (std::size_t i = 0; i < before.size(); ++i)
    if (before[i] != scene.steps[i])
      values.fail("the checkpoint is of other steps: /steps/values: step " + std::to_string(i + 1) + " is " +
                  format_number(before[i]) + " there and " + format_number(scene.steps[i]) +
                  " in this scene; only steps after " + std::to_string(step) + " may change");
  // Loads beside the control grow with its share of the last value.
  if (scene.control == Control::load_factor || !loads_follow(scene) || scene.steps.back() == 0) return;
  if (before.back() / scene.steps.back() != simulation.now().load_factor)
    values.fail("the checkpoint is of other steps: /steps/values: supports and tractions grow with the share "
                "of the last "
                "value, and that is another one in this scene; keep the last value");
}

/// Of the values, whatever spaces stand between them.
std::string checksum(const Json& checkpoint) {
  const std::string text = checkpoint.dump();
  Hash hash;
  hash.add_all(text);
  return hash.text();
}

/// Where a damaged checkpoint leaves its user.
std::string other_checkpoint(const std::filesystem::path& file) {
  const std::filesystem::path before = file.parent_path() / checkpoint_before_name;
  std::error_code error;
  if (file.filename() != checkpoint_name || !std::filesystem::exists(before, error)) return "";
  return "; the one of the step before is " + before.string();
}

/// The file's checkpoint without its checksum.
/// @throws InputError if it is damaged, or none
Json read_whole(const std::filesystem::path& file) {
  Json json;
  try {
    json = parse_json_file(file);
  } catch (const InputError& error) {
    throw InputError(error.what() + other_checkpoint(file));
  }
  if (!json.contains("step") || !json.contains("displacement"))
    throw InputError(file.string() +
                     ": this is no checkpoint; --restart takes the checkpoint.json that a run leaves in "
                     "its --out folder" +
                     other_checkpoint(file));
  const std::string wanted = json.contains("checksum") ? json.at("checksum").dump() : "missing";
  json.erase("checksum");
  if (wanted != Json(checksum(json)).dump())
    throw InputError(file.string() + ": the checkpoint is damaged or was edited: its checksum is " + wanted +
                     ", that of its values \"" + checksum(json) + "\"" + other_checkpoint(file));
  return json;
}

} // namespace

std::string checkpoint_text(const Simulation& simulation, int step) {
  const std::vector<double>& steps = simulation.scene().steps;
  Json json = simulation.checkpoint();
  json["step"] = step;
  json["values"] = std::vector<double>(steps.begin(), steps.begin() + step);
  json["checksum"] = checksum(json);
  return json.dump() + "\n";
}

int read_checkpoint(const std::filesystem::path& file, Simulation& simulation) {
  Json json = read_whole(file);
  const std::string where = file.string() + ": ";
  const int step = JsonObject(JsonValue(json, where)).at("step").integer(1, 1000000);
  const Json values = json.contains("values") ? json.at("values") : Json();
  json.erase("step");
  json.erase("values");
  try {
    simulation.restore(json);
  } catch (const InputError& error) {
    throw InputError(where + error.what());
  }
  check_steps(JsonValue(values, where), simulation, step);
  if (step == static_cast<int>(simulation.scene().steps.size()))
    throw InputError(where + "the run is finished: this is the checkpoint of its last step" +
                     other_checkpoint(file));
  return step;
}

} // namespace host
