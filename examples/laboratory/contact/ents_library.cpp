// SPDX-License-Identifier: BSD-3-Clause
#include "ents_library.hpp"

#include <dlfcn.h>

#include "toolbox/error.hpp"

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
  try {
    load([this](const char* name) { return dlsym(handle_, name); });
  } catch (const ents::Error& error) {
    dlclose(handle_);
    throw InputError(path_ + " does not serve contract " + std::to_string(ENTS_CONTRACT_MAJOR) + "." +
                     std::to_string(ENTS_CONTRACT_MINOR) +
                     ", which this program was built for: " + error.what());
  } catch (const std::runtime_error& error) {
    dlclose(handle_);
    throw InputError(path_ + " is no ents library: " + error.what());
  }
}

EntsLibrary::~EntsLibrary() { dlclose(handle_); }

namespace {

/// What the library refuses, with the place of the model.
template <class Make> ents::Model made(const std::string& where, Make make) {
  try {
    return make();
  } catch (const ents::Error& error) {
    throw InputError(where + ": " + error.what());
  }
}

} // namespace

EntsModel::EntsModel(const EntsLibrary& library, const std::string& text, const fs::path& directory,
                     const std::string& where)
    : ents::Model(made(where, [&] {
        return ents::Model(text, directory.empty() ? "." : directory.string(), {}, library);
      })) {
  if (layout().named_parameters > 0 || layout().fields > 0) read_what_changes(Json::parse(text));
}

EntsModel::EntsModel(const EntsLibrary& library, const fs::path& file)
    : ents::Model(made(file.string(), [&] { return ents::Model::from_file(file.string(), library); })) {
  if (layout().named_parameters > 0 || layout().fields > 0) read_what_changes(parse_json_file(file));
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

void EntsModel::read_what_changes(const Json& json) {
  std::map<std::string, double> sorted;
  if (json.contains("parameters"))
    for (const auto& [name, value] : json.at("parameters").items()) sorted[name] = value.get<double>();
  for (const auto& [name, value] : sorted) parameters_.push_back(name), defaults_.push_back(value);
  std::vector<std::string> names;
  if (json.contains("height")) find_fields(json.at("height"), names);
  for (const std::string& name : names) fields_[name] = field(name);
  bind(defaults_);
}

void EntsModel::bind(const std::vector<double>& values) {
  std::vector<ents_data> fields;
  for (const auto& [name, block] : fields_) {
    auto field = ents::make<ents_data>();
    field.name = name.c_str();
    field.values = block.data(), field.rows = 1, field.columns = static_cast<std::int64_t>(block.size());
    fields.push_back(field);
  }
  try {
    ents::Model::bind(values, fields);
  } catch (const ents::Error& error) {
    throw JobError(std::string("the model's parameters: ") + error.what());
  }
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
