// SPDX-License-Identifier: BSD-3-Clause
// libents.so, loaded at run time, so that `--library` can name another one: the objects of ents.hpp over its
// functions.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <ents.hpp>

#include "toolbox/json_reader.hpp"

namespace host {

/// The functions of ents.h, found in a shared library. Adapters put their own in the place of some.
class EntsLibrary : public ents::Library {
public:
  /// Load and check the contract version.
  /// @param path  of the shared library; empty: ../lib/libents.so from the program's folder, else
  ///              wherever the system's loader finds libents.so
  /// @throws InputError for a given path that does not work, JobError if nothing was given and none found
  explicit EntsLibrary(const std::filesystem::path& path = {});
  ~EntsLibrary();
  EntsLibrary(const EntsLibrary&) = delete;
  EntsLibrary& operator=(const EntsLibrary&) = delete;

  /// Where it was found.
  const std::string& path() const { return path_; }

private:
  void* handle_ = nullptr;
  std::string path_;
};

using ents::describe;
template <class Struct> Struct ents_struct() { return ents::make<Struct>(); }
/// A size as the library counts.
inline std::int64_t stride(std::size_t value) { return static_cast<std::int64_t>(value); }

/// A model, its sizes, and what of it changes: the values of its named parameters (at first those of the
/// text) and its fields (at first zero everywhere).
class EntsModel : public ents::Model {
public:
  /// @param text       the model as JSON
  /// @param directory  where relative names of height maps start
  /// @param where      file and JSON path of the model, for messages
  /// @throws InputError with the library's message
  EntsModel(const EntsLibrary& library, const std::string& text, const std::filesystem::path& directory,
            const std::string& where);
  /// From a file of its own.
  EntsModel(const EntsLibrary& library, const std::filesystem::path& file);
  /// Names of the parameters, in alphabetical order.
  const std::vector<std::string>& parameters() const { return parameters_; }
  /// Their values in the text.
  const std::vector<double>& defaults() const { return defaults_; }
  /// Blocks of the fields by name. Bind the model again after a change.
  std::map<std::string, std::vector<double>>& fields() { return fields_; }
  const std::map<std::string, std::vector<double>>& fields() const { return fields_; }
  /// @param values  [parameters]
  /// @throws JobError with the library's message
  void bind(const std::vector<double>& values);

private:
  /// Of the text, which the model was made of.
  void read_what_changes(const Json& json);

  std::vector<std::string> parameters_;
  std::vector<double> defaults_;
  std::map<std::string, std::vector<double>> fields_;
};

/// rho_e and its height at points of one segment.
struct SurfaceSample {
  std::vector<double> point;       ///< [count][d] rho_e
  std::vector<double> normal;      ///< [count][d] n_e
  std::vector<double> base_point;  ///< [count][d] rho
  std::vector<double> base_normal; ///< [count][d] n
  std::vector<double> height;      ///< [count]
};

/// @param master              [m][d]
/// @param surface_coordinates [m][d-1] or empty: the model's own, else s = xi
/// @param xi                  [count][d-1]
/// @throws JobError with the library's message
SurfaceSample sample_surface(const EntsModel& model, const std::vector<double>& master,
                             const std::vector<double>& surface_coordinates, const std::vector<double>& xi);

/// Do its natural coordinates fill the unit triangle? Else [-1, 1] per direction.
inline bool is_triangle(const std::string& segment) {
  return segment.starts_with("tri") || segment.starts_with("bezier");
}

/// Place i of n equal steps from -1 to 1.
inline double even_xi(std::size_t i, std::size_t n) {
  return 2 * static_cast<double>(i) / static_cast<double>(n) - 1;
}

/// Those places in each direction of a segment, the first direction's one after the other; a triangle: the
/// square collapsed on it.
/// @return [(n + 1)^parameters][parameters]
std::vector<double> even_grid(int parameters, std::size_t n, bool triangle = false);

} // namespace host
