// SPDX-License-Identifier: BSD-3-Clause
// The folder of a job: written as a whole or not at all, and without the files of the job that was there before.
#include "write.hpp"

#include <fstream>

namespace ents_deck {
namespace {

using std::string;
using Path = std::filesystem::path;

/// Names of all files that ents-deck has written into a folder, a line each.
constexpr const char* list_name = "ents_files.txt";

/// The files of the job that a folder has now.
std::vector<Path> listed(const Path& folder) {
  std::vector<Path> out;
  std::ifstream stream(folder / list_name, std::ios::binary);
  for (string line; std::getline(stream, line);) {
    const Path name(line);
    if (!line.empty() && !name.is_absolute() && name.lexically_normal().begin()->string() != "..")
      out.push_back(folder / name);
  }
  return out;
}

void write_file(const JobFile& file) {
  if (file.target.has_parent_path()) std::filesystem::create_directories(file.target.parent_path());
  if (!file.copy_of.empty()) {
    std::error_code error;
    std::filesystem::copy_file(file.copy_of, file.target, std::filesystem::copy_options::overwrite_existing,
                               error);
    if (error)
      throw Error("the height map " + file.copy_of.string() + " cannot be copied to " + file.target.string() +
                  ": " + error.message());
    return;
  }
  std::ofstream stream(file.target, std::ios::binary);
  stream.write(file.text.data(), static_cast<std::streamsize>(file.text.size()));
  if (!stream.flush())
    throw Error(file.target.string() + " cannot be written; is the disk full, may you write there?");
}

} // namespace

void check_folder(const Path& folder) {
  std::error_code error;
  const auto status = std::filesystem::status(folder, error);
  if (!std::filesystem::exists(status)) return;
  if (!std::filesystem::is_directory(status))
    throw Error("--out " + folder.string() + " is a file; name a folder");
  if (std::filesystem::exists(folder / list_name)) return;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    throw Error("--out " + folder.string() + " has files that ents-deck has not written (" +
                entry.path().filename().string() + " ...); name a new folder");
}

std::vector<Path> write_job(const Job& job, const Options& options, const Path& out) {
  std::vector<JobFile> files =
      files_of_job(job, options, out); // what is refused is refused before anything is written
  string list;
  for (const JobFile& file : files) list += file.target.lexically_relative(out).generic_string() + '\n';
  files.push_back({out / list_name, list, {}});
  std::error_code ignored;
  for (const Path& old : listed(out)) std::filesystem::remove(old, ignored);
  const bool is_new = !std::filesystem::exists(out, ignored);
  std::vector<Path> written;
  try {
    for (const JobFile& file : files) {
      written.push_back(file.target);
      write_file(file);
    }
  } catch (...) {
    for (const Path& path : written) std::filesystem::remove(path, ignored);
    if (is_new) std::filesystem::remove(out, ignored); // where it is empty
    throw;
  }
  written.pop_back();
  return written;
}

} // namespace ents_deck
