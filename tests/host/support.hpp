// SPDX-License-Identifier: BSD-3-Clause
// What the tests of the host share: the library, scenes from text or file with changes, random numbers.
#pragma once

#include <filesystem>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "ents_library.hpp"
#include "run.hpp"
#include "toolbox/json_reader.hpp"

namespace host::test {

/// libents.so of the build tree, as ents-lab finds it.
inline const EntsLibrary& library() {
  static const EntsLibrary instance;
  return instance;
}

/// A scene file of examples/.
inline std::filesystem::path scene_file(const std::string& name) {
  return std::filesystem::path(EXAMPLES) / name / "scene.json";
}

/// Its text, or that of one of its variants, without the variants.
inline Json shipped(const std::string& name, const std::string& variant = {}) {
  Json json = read_variant(scene_file(name), variant);
  json.erase("variants");
  return json;
}

/// A shipped scene or variant, changed by `edit` before it is checked.
inline Scene shipped_scene(const std::string& name, const std::function<void(Json&)>& edit = {},
                           const std::string& variant = {}) {
  const std::filesystem::path file = scene_file(name);
  Json json = shipped(name, variant);
  if (edit) edit(json);
  return read_scene_text(json.dump(), file);
}

inline Scene scene_from(const Json& json) { return read_scene_text(json.dump(), "test.json"); }

/// All steps of a scene, solved.
inline std::vector<StepRecord> run(const Scene& scene) {
  Simulation simulation(scene, &library());
  return solve(simulation, {});
}
inline std::vector<StepRecord> run(const Json& json) { return run(scene_from(json)); }
inline StepRecord last_step(const Json& json) { return run(json).back(); }

/// The message with which a scene is refused; empty: it is not.
inline std::string refusal(const Json& json) {
  try {
    scene_from(json);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// One axis of a block with equal cells.
inline Json axis(double from, double to, int divisions) {
  return {{"from", from}, {"pieces", {{{"to", to}, {"divisions", divisions}}}}};
}

/// The quantity of a step by its name; a missing one fails the test that asks.
inline const Quantity& quantity(const StepRecord& record, const std::string& name) {
  for (const Quantity& candidate : record.exact)
    if (candidate.name == name) return candidate;
  throw std::runtime_error("no quantity " + name);
}

/// The same numbers at every run.
class Random {
public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() - engine_.min()) /
                     static_cast<double>(engine_.max() - engine_.min());
  }
  std::vector<double> vector(std::size_t size, double low, double high) {
    std::vector<double> values(size);
    for (double& value : values) value = uniform(low, high);
    return values;
  }

private:
  std::mt19937_64 engine_;
};

} // namespace host::test
