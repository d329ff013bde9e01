// SPDX-License-Identifier: BSD-3-Clause
// Files that are written as a whole or not at all.
#pragma once

#include <filesystem>
#include <string>

namespace host {

/// A new version of a file. Its text is written to FILE.new beside it and has reached the disk when the
/// constructor returns; `replace` then renames it to FILE. A program that is killed, a full disk and a power
/// failure therefore leave either the old file or the new one, never a part of it; flush_folder makes sure
/// that it is the new one. Links are followed; a device or pipe, which has no older version to keep, is
/// written directly.
class NewFile {
public:
  /// @throws std::runtime_error naming the file that cannot be written to its end, and why
  NewFile(const std::filesystem::path& file, const std::string& text);
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  /// Without `replace` the new version is deleted and the old one stays.
  ~NewFile();

  /// @throws std::runtime_error as the constructor
  void replace();

private:
  std::filesystem::path named_;  ///< as the caller calls it, for messages
  std::filesystem::path target_; ///< the file at the end of its links
  std::filesystem::path beside_; ///< FILE.new; empty: a device, or replaced already
};

/// After this call no power failure takes back what has been renamed in the folder.
/// @throws std::runtime_error naming the folder
void flush_folder(const std::filesystem::path& folder);

/// Write a file in one go: NewFile and its `replace`.
/// @throws std::runtime_error naming the file that cannot be written to its end, and why
void write_text(const std::filesystem::path& file, const std::string& text);

} // namespace host
