// SPDX-License-Identifier: BSD-3-Clause
// libents.so, loaded at run time: the one place where this program meets the library. All it knows of it is
// the header ents.h.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <ents.h>

namespace host {

/// The functions of ents.h, found in a shared library.
class EntsLibrary {
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

  decltype(&ents_status_text) status_text = nullptr;
  decltype(&ents_version) version = nullptr;
  decltype(&ents_check_contract) check_contract = nullptr;
  decltype(&ents_model_create) model_create = nullptr;
  decltype(&ents_model_create_from_file) model_create_from_file = nullptr;
  decltype(&ents_model_destroy) model_destroy = nullptr;
  decltype(&ents_model_layout) model_layout = nullptr;
  decltype(&ents_model_bind) model_bind = nullptr;
  decltype(&ents_field_size) field_size = nullptr;
  decltype(&ents_field_init) field_init = nullptr;
  decltype(&ents_wear_collect) wear_collect = nullptr;
  decltype(&ents_tree_size) tree_size = nullptr;
  decltype(&ents_tree_build) tree_build = nullptr;
  decltype(&ents_tree_refit) tree_refit = nullptr;
  decltype(&ents_detect) detect = nullptr;
  decltype(&ents_evaluate) evaluate = nullptr;
  decltype(&ents_assemble) assemble = nullptr;
  decltype(&ents_state_init) state_init = nullptr;
  decltype(&ents_state_augment) state_augment = nullptr;
  decltype(&ents_state_transfer) state_transfer = nullptr;
  decltype(&ents_contact_area) contact_area = nullptr;
  decltype(&ents_pose_init) pose_init = nullptr;
  decltype(&ents_pose_move) pose_move = nullptr;
  decltype(&ents_pose_to_body) pose_to_body = nullptr;
  decltype(&ents_pose_to_space) pose_to_space = nullptr;
  decltype(&ents_pose_element) pose_element = nullptr;
  decltype(&ents_sampling_points) sampling_points = nullptr;
  decltype(&ents_smooth_size) smooth_size = nullptr;
  decltype(&ents_smooth) smooth = nullptr;
  decltype(&ents_surface_evaluate) surface_evaluate = nullptr;
  decltype(&ents_model_check) model_check = nullptr;
  decltype(&ents_surface_check) surface_check = nullptr;

private:
  void* handle_ = nullptr;
  std::string path_;
};

/// A struct of ents.h: zeroed, with its size set.
template <class Struct> Struct ents_struct() {
  Struct value{};
  value.struct_size = static_cast<int32_t>(sizeof(Struct));
  return value;
}

/// "STATUS_TEXT: MESSAGE" of a failed call.
std::string describe(const EntsLibrary& library, int32_t status, const ents_report& report);

/// A model, its sizes, and what of it changes: the values of its named parameters (at first those of the
/// text) and its fields (at first zero everywhere).
class EntsModel {
public:
  /// @param text       the model as JSON
  /// @param directory  where relative names of height maps start
  /// @param where      file and JSON path of the model, for messages
  /// @throws InputError with the library's message
  EntsModel(const EntsLibrary& library, const std::string& text, const std::filesystem::path& directory,
            const std::string& where);
  /// From a file of its own.
  EntsModel(const EntsLibrary& library, const std::filesystem::path& file);
  ~EntsModel();
  EntsModel(const EntsModel&) = delete;
  EntsModel& operator=(const EntsModel&) = delete;

  const EntsLibrary& library() const { return *library_; }
  const ents_model* get() const { return bound_ != nullptr ? bound_ : model_; }
  const ents_layout& layout() const { return layout_; }

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
  void read_layout(const std::string& where);
  void read_what_changes(const std::string& text, const std::string& where);

  const EntsLibrary* library_;
  ents_model *model_ = nullptr, *bound_ = nullptr;
  ents_layout layout_{};
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
