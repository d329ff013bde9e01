// SPDX-License-Identifier: BSD-3-Clause
#include "ents_library.hpp"

#include <dlfcn.h>

#include "error.hpp"
#include "json_reader.hpp"

namespace host {
namespace {

namespace fs = std::filesystem;

fs::path program_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return error ? fs::path{} : program.parent_path();
}

} // namespace

EntsLibrary::EntsLibrary(const fs::path& path) {
  std::vector<std::string> candidates;
  if (!path.empty()) {
    // Without a slash the loader would search the system's folders instead of the one the user means.
    candidates.push_back(fs::absolute(path).string());
  } else {
    if (const fs::path folder = program_folder(); !folder.empty())
      candidates.push_back((folder / ".." / "lib" / "libents.so").lexically_normal().string());
    candidates.emplace_back("libents.so");
  }
  std::string tried;
  for (const std::string& candidate : candidates) {
    handle_ = dlopen(candidate.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle_ != nullptr) {
      path_ = candidate;
      break;
    }
    const char* reason = dlerror();
    tried += "\n  " + std::string(reason != nullptr ? reason : candidate.c_str());
  }
  if (handle_ == nullptr) {
    if (!path.empty()) throw InputError("--library: the library cannot be loaded:" + tried);
    throw JobError("libents.so was not found; build it, or name it with --library FILE. Tried:" + tried);
  }
  const auto find = [this](auto& function, const char* name) {
    void* symbol = dlsym(handle_, name);
    if (symbol == nullptr) throw InputError(path_ + " is no ents library: it has no function " + name);
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(symbol);
  };
  try {
    find(status_text, "ents_status_text");
    find(version, "ents_version");
    find(check_contract, "ents_check_contract");
    auto report = ents_struct<ents_report>();
    if (check_contract(ENTS_CONTRACT_MAJOR, ENTS_CONTRACT_MINOR, &report) != ENTS_OK)
      throw InputError(path_ + " (version " + version() + ") does not serve contract " +
                       std::to_string(ENTS_CONTRACT_MAJOR) + "." + std::to_string(ENTS_CONTRACT_MINOR) +
                       ", which this program was built for: " + report.message);
    find(model_create, "ents_model_create");
    find(model_create_from_file, "ents_model_create_from_file");
    find(model_destroy, "ents_model_destroy");
    find(model_layout, "ents_model_layout");
    find(model_bind, "ents_model_bind");
    find(field_size, "ents_field_size");
    find(field_init, "ents_field_init");
    find(wear_collect, "ents_wear_collect");
    find(tree_size, "ents_tree_size");
    find(tree_build, "ents_tree_build");
    find(tree_refit, "ents_tree_refit");
    find(detect, "ents_detect");
    find(evaluate, "ents_evaluate");
    find(assemble, "ents_assemble");
    find(state_init, "ents_state_init");
    find(state_augment, "ents_state_augment");
    find(state_transfer, "ents_state_transfer");
    find(contact_area, "ents_contact_area");
    find(pose_init, "ents_pose_init");
    find(pose_move, "ents_pose_move");
    find(pose_to_body, "ents_pose_to_body");
    find(pose_to_space, "ents_pose_to_space");
    find(pose_element, "ents_pose_element");
    find(sampling_points, "ents_sampling_points");
    find(smooth_size, "ents_smooth_size");
    find(smooth, "ents_smooth");
    find(surface_evaluate, "ents_surface_evaluate");
    find(model_check, "ents_model_check");
    find(surface_check, "ents_surface_check");
  } catch (...) {
    dlclose(handle_);
    throw;
  }
}

EntsLibrary::~EntsLibrary() { dlclose(handle_); }

std::string describe(const EntsLibrary& library, int32_t status, const ents_report& report) {
  const std::string text = library.status_text(status), message = report.message;
  if (message.find(text) != std::string::npos) return message; // of an element: its number, then the text
  return message.empty() ? text : text + ": " + message;
}

EntsModel::EntsModel(const EntsLibrary& library, const std::string& text, const fs::path& directory,
                     const std::string& where)
    : library_(&library) {
  auto report = ents_struct<ents_report>();
  const std::string folder = directory.empty() ? "." : directory.string();
  const int32_t status = library.model_create(text.data(), static_cast<int64_t>(text.size()), folder.c_str(),
                                              nullptr, 0, &model_, &report);
  if (status != ENTS_OK) throw InputError(where + ": " + describe(library, status, report));
  read_layout(where);
  read_what_changes(text, where);
}

EntsModel::EntsModel(const EntsLibrary& library, const fs::path& file) : library_(&library) {
  auto report = ents_struct<ents_report>();
  const int32_t status = library.model_create_from_file(file.string().c_str(), &model_, &report);
  if (status != ENTS_OK) throw InputError(file.string() + ": " + describe(library, status, report));
  read_layout(file.string());
  if (layout_.named_parameters > 0 || layout_.fields > 0)
    read_what_changes(parse_json_file(file).dump(), file.string());
}

EntsModel::~EntsModel() {
  auto report = ents_struct<ents_report>();
  library_->model_destroy(&bound_, &report);
  library_->model_destroy(&model_, &report);
}

void EntsModel::read_layout(const std::string& where) {
  auto report = ents_struct<ents_report>();
  layout_ = ents_struct<ents_layout>();
  const int32_t status = library_->model_layout(model_, &layout_, &report);
  if (status == ENTS_OK) return;
  const std::string message = describe(*library_, status, report);
  library_->model_destroy(&model_, &report);
  throw JobError(where + ": " + message);
}

namespace {

/// Names of the heights of type "field".
void find_fields(const Json& json, std::vector<std::string>& names) {
  if (json.is_object() && json.value("type", Json()) == "field" && json.contains("name"))
    names.push_back(json.at("name").get<std::string>());
  if (json.is_structured())
    for (const Json& item : json) find_fields(item, names);
}

} // namespace

void EntsModel::read_what_changes(const std::string& text, const std::string& where) {
  if (layout_.named_parameters == 0 && layout_.fields == 0) return;
  const Json json = Json::parse(text);
  std::map<std::string, double> sorted;
  if (json.contains("parameters"))
    for (const auto& [name, value] : json.at("parameters").items()) sorted[name] = value.get<double>();
  for (const auto& [name, value] : sorted) parameters_.push_back(name), defaults_.push_back(value);
  std::vector<std::string> names;
  if (json.contains("height")) find_fields(json.at("height"), names);
  try {
    auto report = ents_struct<ents_report>();
    for (const std::string& name : names) {
      std::int64_t size = 0;
      std::int32_t status = library_->field_size(model_, name.c_str(), &size, &report);
      std::vector<double>& block = fields_[name];
      block.assign(static_cast<std::size_t>(size), 0.0);
      if (status == ENTS_OK)
        status = library_->field_init(model_, name.c_str(), nullptr, block.data(), size, &report);
      if (status != ENTS_OK) throw JobError(where + ": " + describe(*library_, status, report));
    }
    bind(defaults_);
  } catch (...) {
    auto report = ents_struct<ents_report>();
    library_->model_destroy(&model_, &report);
    throw;
  }
}

void EntsModel::bind(const std::vector<double>& values) {
  std::vector<ents_data> fields;
  for (const auto& [name, block] : fields_) {
    auto field = ents_struct<ents_data>();
    field.name = name.c_str();
    field.values = block.data(), field.rows = 1, field.columns = static_cast<std::int64_t>(block.size());
    fields.push_back(field);
  }
  auto report = ents_struct<ents_report>();
  const std::int32_t status =
      library_->model_bind(model_, values.empty() ? nullptr : values.data(), fields.data(),
                           static_cast<std::int64_t>(fields.size()), &bound_, &report);
  if (status != ENTS_OK) throw JobError("the model's parameters: " + describe(*library_, status, report));
}

SurfaceSample sample_surface(const EntsModel& model, const std::vector<double>& master,
                             const std::vector<double>& surface_coordinates, const std::vector<double>& xi) {
  const auto d = static_cast<std::size_t>(model.layout().dimension);
  const std::size_t count = xi.size() / static_cast<std::size_t>(model.layout().parameters);
  SurfaceSample sample;
  sample.point.resize(count * d);
  sample.normal.resize(count * d);
  sample.base_point.resize(count * d);
  sample.base_normal.resize(count * d);
  sample.height.resize(count);
  auto surface = ents_struct<ents_surface>();
  surface.master = master.data();
  surface.surface_coordinates = surface_coordinates.empty() ? nullptr : surface_coordinates.data();
  surface.xi = xi.data();
  surface.point = sample.point.data();
  surface.normal = sample.normal.data();
  surface.height = sample.height.data();
  surface.base_point = sample.base_point.data();
  surface.base_normal = sample.base_normal.data();
  auto report = ents_struct<ents_report>();
  const int32_t status =
      model.library().surface_evaluate(model.get(), static_cast<int64_t>(count), &surface, &report);
  if (status != ENTS_OK)
    throw JobError("the enriched surface cannot be evaluated: " + describe(model.library(), status, report));
  return sample;
}

std::vector<double> even_grid(int parameters, std::size_t n, bool triangle) {
  std::vector<double> xi;
  for (std::size_t j = 0; j <= (parameters == 1 ? 0 : n); ++j)
    for (std::size_t i = 0; i <= n; ++i) {
      const double s = even_xi(i, n), t = even_xi(j, n);
      xi.push_back(triangle ? 0.25 * (1 + s) * (1 - t) : s);
      if (parameters == 2) xi.push_back(triangle ? 0.5 * (1 + t) : t);
    }
  return xi;
}

} // namespace host
