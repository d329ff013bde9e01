// SPDX-License-Identifier: BSD-3-Clause
// What a run leaves in its folder: result.json, the VTU series, checkpoint.json and checkpoint_before.json.
#pragma once

#include <functional>
#include <memory>

#include "output_folder.hpp"
#include "result.hpp"

namespace host {

/// A file that cannot be written does not end the run, which may have taken hours: ents-lab prints a message
/// and fails when everything else is done.
///
/// checkpoint.json is that of the last step, checkpoint_before.json the one before it. Once files of the VTU
/// series could not be written, checkpoint_before.json stays that of the last step before them: a run that is
/// restarted from there writes them again.
class RunFiles {
public:
  /// Files of an older run go; a run that goes on from a checkpoint in the same folder keeps the earlier
  /// steps.
  /// @param folder   empty: no files
  /// @param restart  the checkpoint, or empty
  /// @param first    step of this run
  /// @throws InputError naming --out, or a result.json that cannot be gone on with
  RunFiles(std::filesystem::path folder, const std::filesystem::path& restart, int first);

  void add(Simulation& simulation, const StepRecord& record);
  void finish(const Json& result);

  /// Steps that an earlier part of the run left in the result.json of this folder.
  const Json& earlier() const { return earlier_; }
  /// Names every file that could not be written and says what to do; empty: all is well.
  std::string problem() const;
  /// For the message to the user.
  std::string names() const;

private:
  /// @return true if there was no problem
  bool attempt(const std::function<void()>& write);
  void write_checkpoint(const Simulation& simulation, int step);
  void resume(int first);
  void remove_older_run();

  std::filesystem::path folder_;
  OutputFolder lock_;
  std::unique_ptr<vtu::Series> series_;
  Json earlier_ = Json::array();
  std::vector<std::string> problems_; ///< "FILE: cannot be written: why", each once
  int whole_ = 0;                     ///< the series has all files of the steps up to this one
  int checkpoint_ = 0; ///< step of the checkpoint.json in the folder; 0: none, or none of this run
};

} // namespace host
