// SPDX-License-Identifier: BSD-3-Clause
#include "run_files.hpp"

#include <algorithm>
#include <cstdio>

#include "output/text_file.hpp"
#include "restart.hpp"
#include "result.hpp"
#include "series.hpp"

namespace host {
namespace {

namespace fs = std::filesystem;

/// Give a file a second name, which stays when the first one is given to another file.
void keep_as(const fs::path& file, const fs::path& kept) {
  const fs::path link = kept.string() + ".new";
  std::error_code error;
  fs::remove(link, error);
  fs::create_hard_link(file, link, error);
  if (error) fs::copy_file(file, link, error); // a file system without links
  if (!error) fs::rename(link, kept, error);
  if (error) throw std::runtime_error(kept.string() + ": cannot be written: " + error.message());
}

} // namespace

RunFiles::RunFiles(fs::path folder, const fs::path& restart, int first)
    : folder_(std::move(folder)), lock_(folder_) {
  if (folder_.empty()) return;
  series_ = std::make_unique<vtu::Series>(folder_, "result", write_text);
  std::error_code error;
  const fs::path of_checkpoint = restart.has_parent_path() ? restart.parent_path() : ".";
  if (restart.empty() || !fs::equivalent(of_checkpoint, folder_, error)) {
    whole_ = first - 1; // the series begins with this run
    remove_older_run();
    return;
  }
  resume(first);
  if (fs::equivalent(restart, folder_ / checkpoint_name, error)) checkpoint_ = first - 1;
}

void RunFiles::remove_older_run() {
  // Beside what this run writes they would look like its results, also if it fails.
  std::error_code error;
  const auto remove = [&](const std::string& name) {
    if (fs::is_regular_file(fs::symlink_status(folder_ / name, error))) fs::remove(folder_ / name, error);
  };
  for (const std::string name : {"result.json", "result.pvd", checkpoint_name, checkpoint_before_name})
    remove(name), remove(name + ".new");
  for (const std::string name : picture_names)
    for (const char* kind : {".svg", ".png"}) remove(name + kind);
  for (const char* name : {"pictures.json", "pictures.py"}) remove(name);
}

void RunFiles::resume(int first) {
  host::resume(*series_, first);
  const std::vector<int> listed = whole_steps(*series_);
  while (std::find(listed.begin(), listed.end(), whole_ + 1) != listed.end()) ++whole_;
  if (whole_ < first - 1)
    std::fprintf(
        stderr,
        "ents-lab: warning: %s does not have all files of step %d, which could not be written or were "
        "deleted; an earlier checkpoint, or none, lets the run write them again\n",
        series_->file().c_str(), whole_ + 1);
  const fs::path file = folder_ / "result.json"; // a run that was stopped has none
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return;
  const Json result = parse_json_file(file);
  JsonObject object(JsonValue(result, file.string() + ": "));
  for (const JsonValue& step : object.at("steps").items())
    if (JsonObject(step).at("step").integer(1, 1000000) < first) earlier_.push_back(step.json());
}

bool RunFiles::attempt(const std::function<void()>& write) {
  try {
    write();
    return true;
  } catch (const std::exception& error) {
    const std::string problem = error.what();
    if (std::find(problems_.begin(), problems_.end(), problem) != problems_.end()) return false;
    problems_.push_back(problem);
    std::fprintf(stderr, "ents-lab: %s; the run goes on\n", problem.c_str());
    return false;
  }
}

void RunFiles::write_checkpoint(const Simulation& simulation, int step) {
  NewFile checkpoint(folder_ / checkpoint_name, checkpoint_text(simulation, step));
  // Until the new one is whole, the old one stays where it is; then there are always two.
  if (checkpoint_ > 0 && checkpoint_ <= whole_)
    keep_as(folder_ / checkpoint_name, folder_ / checkpoint_before_name);
  checkpoint.replace();
  checkpoint_ = step;
  flush_folder(folder_); // also of the series' files, which were renamed before
}

void RunFiles::add(Simulation& simulation, const StepRecord& record) {
  if (!series_) return;
  bool all = true;
  for (const auto& part : parts_of_step(*series_, simulation, record)) all = attempt(part) && all;
  attempt([&] { write_checkpoint(simulation, record.step); });
  if (all && whole_ == record.step - 1) whole_ = record.step;
}

void RunFiles::finish(const Json& result) {
  if (!series_) return;
  attempt([&] {
    write_text(folder_ / "result.json", result.dump(2) + "\n");
    flush_folder(folder_);
  });
}

std::string RunFiles::problem() const {
  if (problems_.empty()) return "";
  constexpr std::size_t most = 20; // a disk stays full for all later steps
  std::string text;
  for (std::size_t i = 0; i < std::min(problems_.size(), most); ++i)
    text += (i == 0 ? "" : "\n           ") + problems_[i];
  if (problems_.size() > most)
    text += "\n           and " + std::to_string(problems_.size() - most) + " more files";
  if (checkpoint_ > whole_)
    text += "\n           " + series_->file().string() + " has all files up to step " +
            std::to_string(whole_) + ": " +
            (fs::exists(folder_ / checkpoint_before_name)
                 ? "--restart " + (folder_ / checkpoint_before_name).string() +
                       " writes those of later steps once more"
                 : "run the scene once more");
  else if (checkpoint_ > 0)
    text += "\n           --restart " + (folder_ / checkpoint_name).string() + " goes on after step " +
            std::to_string(checkpoint_);
  return text;
}

std::string RunFiles::names() const {
  return series_->file().string() + " and " + (folder_ / "result.json").string();
}

} // namespace host
