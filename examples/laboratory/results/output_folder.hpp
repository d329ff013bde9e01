// SPDX-License-Identifier: BSD-3-Clause
// The folder of --out.
#pragma once

#include <filesystem>

namespace host {

/// The folder of --out while a command writes into it: made before anything is computed that would be lost
/// without it, and locked, so that a second command cannot mix its files with those of the first. The
/// operating system takes the lock back when the program ends, also when it is killed. Where a file system
/// has no locks there is none.
class OutputFolder {
public:
  /// @param folder  empty: none is asked for, nothing happens
  /// @throws InputError naming --out
  explicit OutputFolder(const std::filesystem::path& folder);
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  ~OutputFolder();

private:
  int descriptor_ = -1;
};

} // namespace host
