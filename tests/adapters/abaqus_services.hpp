// SPDX-License-Identifier: BSD-3-Clause
// The functions that Abaqus offers its user subroutines, emulated: GETOUTDIR, STDB_ABQERR, XIT (which throws
// HostStopped).
#pragma once

#include <string>
#include <vector>

namespace adapters {

struct AbaqusMessage {
  int severity; ///< 1 information, -1 warning, -2 error
  std::string text;
};

/// What it has been told since the last call.
std::vector<AbaqusMessage> abaqus_messages();
/// Its text if it was one; otherwise how many.
std::string only_message();

} // namespace adapters
