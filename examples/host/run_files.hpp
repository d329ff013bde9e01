// SPDX-License-Identifier: BSD-3-Clause
// What a run leaves in its folder: result.json, the VTU series, checkpoint.json.
#pragma once

#include <functional>
#include <memory>

#include "result.hpp"

namespace host {

/// A file that cannot be written does not end the run, which may have taken hours: it is told at once, and
/// the command fails when everything else is done.
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
  /// "FILE: cannot be written" of the first that could not; empty: all is well.
  const std::string& problem() const { return problem_; }
  /// For the message to the user.
  std::string names() const;

private:
  void attempt(const std::function<void()>& write);

  std::filesystem::path folder_;
  std::unique_ptr<vtu::Series> series_;
  Json earlier_ = Json::array();
  std::string problem_;
};

} // namespace host
