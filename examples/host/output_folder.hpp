// SPDX-License-Identifier: BSD-3-Clause
// The folder of --out.
#pragma once

#include <filesystem>

namespace host {

/// Make the folder, before anything is computed that would be lost without it. An empty path asks for no
/// folder.
/// @throws InputError naming --out
void make_output_folder(const std::filesystem::path& folder);

} // namespace host
