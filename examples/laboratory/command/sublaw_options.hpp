// SPDX-License-Identifier: BSD-3-Clause
// The command line of ents-lab sublaw.
#pragma once

#include <CLI/CLI.hpp>

#include "command/commands.hpp"

namespace host {

/// @param options  filled when the command line is parsed
CLI::App* add_sublaw(CLI::App& app, SublawOptions& options);

} // namespace host
