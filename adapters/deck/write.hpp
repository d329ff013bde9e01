// SPDX-License-Identifier: BSD-3-Clause
// The job on disk: the deck with user elements in place of its contact pairs and every other line as it was,
// byte for byte; models, tables.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "convert.hpp"

namespace ents_deck {

/// Lines first .. last of a file are replaced; last = first - 1: the text is put before line `first`.
struct Edit {
  int first = 0, last = 0;
  std::string text; ///< with line ends
};
using Edits = std::map<int, std::vector<Edit>>; ///< by file

/// Text of the file with edits; what they do not name is copied byte for byte.
std::string edited(std::string_view text, std::vector<Edit> edits);

/// What the host program reads: statements of the elements, and where they go.
struct HostText {
  std::string text;
  Place before; ///< the statement that they come before
};
HostText calculix_text(const Job& job);
HostText abaqus_text(const Job& job);

/// Number of an element in the written deck.
std::int64_t first_free_element(const Job& job);

/// Are areas and coordinates in tables ents_k.txt (flat decks), or in properties (decks with parts)?
bool has_tables(const Job& job);

/// ents_patches.json, from which the adapters notice slave points beside their patches.
nlohmann::ordered_json watched(const Job& job);

/// A file of the job: its text, or a copy of another one.
struct JobFile {
  std::filesystem::path target;
  std::string text;
  std::filesystem::path copy_of;
};

/// All files of the job, the deck first. @throws Error for what cannot be written into another folder
std::vector<JobFile> files_of_job(const Job& job, const Options& options, const std::filesystem::path& out);

/// @throws Error for a folder that has other files than those of a job of ents-deck
void check_folder(const std::filesystem::path& folder);

/// Writes the folder: all files, or none where one cannot be written. The files of a job that was there go.
/// @return the files, the deck first
std::vector<std::filesystem::path> write_job(const Job& job, const Options& options,
                                             const std::filesystem::path& out);

std::string exact(double value); ///< shortest text that reads back to the same bits

} // namespace ents_deck
