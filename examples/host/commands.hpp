// SPDX-License-Identifier: BSD-3-Clause
// The commands of ents-host. Each returns its exit code: 0 done, 1 the job failed; wrong input is thrown
// as InputError and becomes 2.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace host {

struct CommonOptions {
  std::filesystem::path library; ///< of libents.so; empty: next to the program, else the system's
  bool json = false;             ///< result as JSON on stdout, and nothing else there
};

struct RunOptions {
  std::filesystem::path scene, out; ///< out empty: no files
  int explicit_divisions = 0;       ///< > 0: the master as an explicit mesh of plain segments
  bool compare = false;             ///< the scene against explicit meshes
  std::vector<int> compare_divisions; ///< empty: the scene's own list
  bool pictures = true;
};
int run_command(const CommonOptions& common, const RunOptions& options);

/// One scene as it is and with explicit meshes; part of `run`.
int compare_command(const CommonOptions& common, const RunOptions& options);

struct VerifyOptions {
  std::vector<std::filesystem::path> files;
  double tolerance = 1e-10;
};
int verify_command(const CommonOptions& common, const VerifyOptions& options);

struct CheckOptions {
  std::filesystem::path model, mesh, out;
  int samples = 0;
};
int check_command(const CommonOptions& common, const CheckOptions& options);

} // namespace host
