// SPDX-License-Identifier: BSD-3-Clause
#include "output_folder.hpp"

#include <cerrno>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "toolbox/error.hpp"

namespace host {

OutputFolder::OutputFolder(const std::filesystem::path& folder) {
  if (folder.empty()) return;
  const std::string name = "--out: " + folder.string();
  // "--out --json" forgot the name, and a folder called --json helps nobody
  if (folder.string().starts_with('-'))
    throw InputError(name + " is no name of a folder; write --out DIR (or ./" + folder.string() +
                     ", if it is really called so)");
  std::error_code error;
  if (std::filesystem::exists(folder, error) && !std::filesystem::is_directory(folder, error))
    throw InputError(name + " is a file; name a folder");
  std::filesystem::create_directories(folder, error);
  if (error) throw InputError(name + ": " + error.message() + "; name a folder that can be made");
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    throw InputError(name + ": nothing can be written into this folder");
  descriptor_ = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ < 0 || flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  close(descriptor_);
  throw InputError(
      name + ": another ents-lab is writing into this folder; name another one, or wait until it has ended");
}

OutputFolder::~OutputFolder() {
  if (descriptor_ >= 0) close(descriptor_);
}

} // namespace host
