// SPDX-License-Identifier: BSD-3-Clause
#include "run_files.hpp"

#include <cstdio>

#include "output/text_file.hpp"
#include "output_folder.hpp"
#include "restart.hpp"
#include "result.hpp"

namespace host {

RunFiles::RunFiles(std::filesystem::path folder, const std::filesystem::path& restart, int first)
    : folder_(std::move(folder)) {
  if (folder_.empty()) return;
  make_output_folder(folder_);
  series_ = std::make_unique<vtu::Series>(folder_, "result");
  std::error_code error;
  const std::filesystem::path of_checkpoint = restart.has_parent_path() ? restart.parent_path() : ".";
  if (restart.empty() || !std::filesystem::equivalent(of_checkpoint, folder_, error)) {
    // Beside what this run writes they would look like its results, also if it fails.
    const auto remove = [&](const std::string& name) {
      if (std::filesystem::is_regular_file(std::filesystem::symlink_status(folder_ / name, error)))
        std::filesystem::remove(folder_ / name, error);
    };
    for (const char* name : {"result.json", "result.pvd", "checkpoint.json"}) remove(name);
    for (const std::string name : picture_names)
      for (const char* kind : {".dat", ".gp", ".svg", ".png"}) remove(name + kind);
    return;
  }
  series_->resume(first);
  const std::filesystem::path file = folder_ / "result.json"; // a run that was stopped has none
  if (!std::filesystem::is_regular_file(file, error)) return;
  const Json result = parse_json_file(file);
  JsonObject object(JsonValue(result, file.string() + ": "));
  for (const JsonValue& step : object.at("steps").items())
    if (JsonObject(step).at("step").integer(1, 1000000) < first) earlier_.push_back(step.json());
}

void RunFiles::attempt(const std::function<void()>& write) {
  try {
    write();
  } catch (const std::exception& error) {
    if (problem_.empty()) problem_ = error.what();
  }
}

void RunFiles::add(Simulation& simulation, const StepRecord& record) {
  if (!series_) return;
  const bool well = problem_.empty();
  attempt([&] { write_step(*series_, simulation, record); });
  attempt([&] {
    write_text(folder_ / "checkpoint.json", checkpoint_after(simulation, record.step).dump() + "\n");
  });
  if (well && !problem_.empty()) std::fprintf(stderr, "ents-host: %s; the run goes on\n", problem_.c_str());
}

void RunFiles::finish(const Json& result) {
  if (series_) attempt([&] { write_text(folder_ / "result.json", result.dump(2) + "\n"); });
}

std::string RunFiles::names() const {
  return series_->file().string() + " and " + (folder_ / "result.json").string();
}

} // namespace host
