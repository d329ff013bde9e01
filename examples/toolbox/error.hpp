// SPDX-License-Identifier: BSD-3-Clause
// The two ways a command fails; main.cpp turns them into exit codes.
#pragma once

#include <stdexcept>

namespace host {

/// The command line or an input file is wrong (exit code 2). The message names the file and the key or line.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The input was understood and the job failed (exit code 1). The message says why.
struct JobError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

} // namespace host
