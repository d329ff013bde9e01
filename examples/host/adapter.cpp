// SPDX-License-Identifier: BSD-3-Clause
#include "adapter.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <utility>

#include <dlfcn.h>
#include <unistd.h>

#include "error.hpp"
#include "json_reader.hpp"

namespace host {
namespace {

namespace fs = std::filesystem;
using Doubles = std::vector<double>;

/// One contact element as a user element of a host: slave, master nodes, one more for multipliers if there
/// are any.
struct UserElement {
  int dimension = 0, nodes = 0, state_size = 0;
  Doubles position, displacement; ///< [nodes][d]; here the whole motion is in the position
  Doubles properties;             ///< model number, area, options, surface coordinates
  Doubles state;                  ///< begin of the increment; returns the end
  Doubles residual, tangent;      ///< out: [rows], column-major
  double step_factor = 1;         ///< out, < 1: cut

  int rows() const { return dimension * nodes; }
};

using Protocol = void (*)(void* library, UserElement& e);

template <class Function> Function* find(void* library, const char* name) {
  void* symbol = dlsym(library, name);
  if (symbol == nullptr) throw JobError(std::string("the adapter has no function ") + name);
  return reinterpret_cast<Function*>(symbol);
}

/// Abaqus/Standard: RHS = -R; SVARS in place.
void abaqus(void* library, UserElement& e) {
  using Uel =
      void(double*, double*, double*, double*, int*, int*, int*, double*, int*, double*, int*, int*, double*,
           double*, double*, double*, int*, double*, double*, int*, int*, int*, double*, int*, int*, double*,
           double*, int*, int*, int*, double*, int*, double*, int*, int*, double*);
  int ndofel = e.rows(), nrhs = 1, nsvars = e.state_size, nprops = static_cast<int>(e.properties.size()),
      one = 1, none = 0, lflags[7] = {1, 1, 1, 0, 0, 0, 0};
  double energy[8] = {}, time[2] = {}, dtime = 1, params[3] = {}, unused = 0, pnewdt = 1e36, period = 1;
  Doubles still(e.residual.size());
  find<Uel>(library, "uel_")(e.residual.data(), e.tangent.data(), e.state.data(), energy, &ndofel, &nrhs,
                             &nsvars, e.properties.data(), &nprops, e.position.data(), &e.dimension, &e.nodes,
                             e.displacement.data(), still.data(), still.data(), still.data(), &one, time,
                             &dtime, &one, &one, &one, params, &none, &none, &unused, &unused, &none, lflags,
                             &ndofel, &unused, &none, &pnewdt, &none, &none, &period);
  e.step_factor = std::min(pnewdt, 1.0);
  for (double& value : e.residual) value = -value;
}

/// CalculiX: forces and history in one pass, stiffness in the other.
void calculix(void* library, UserElement& e) {
  using Force = void(const int*, const int*, const int*, const char*, const double*, const double*,
                     const int*, const int*, const double*, double*, double*, int*, const int*, const int*,
                     const double*, double*, const int*, std::size_t);
  using Stiffness = void(const int*, const char*, double*, double*, double*, std::size_t);
  if (e.dimension != 3) throw JobError("--adapter calculix: user elements of CalculiX are three-dimensional");
  if (e.properties.size() > 3)
    throw JobError("--adapter calculix: surface coordinates have to be in the model or in ents_k.txt");
  const int nelem = 1, first = 0, mi[3] = {1, 3, 1}, yes = 1;
  std::string label = "U1E  \x01\x03";
  label += static_cast<char>(e.nodes);
  std::vector<int> kon;
  for (int node = 1; node <= e.nodes; ++node) kon.push_back(node);
  Doubles v(4 * kon.size()), fn(4 * kon.size()), state = e.state, s(3600), sm(3600), ff(60);
  for (std::size_t i = 0; i < e.displacement.size(); ++i) v[4 * (i / 3) + 1 + i % 3] = e.displacement[i];
  double qa[4] = {0, 0, -1, 0};
  int nal = 0;
  find<Force>(library, "ents_ccx_force_")(&nelem, kon.data(), &first, label.data(), e.position.data(),
                                          v.data(), mi, &first, e.properties.data(), fn.data(), qa, &nal,
                                          &yes, &yes, state.data(), e.state.data(), &e.state_size, 8);
  find<Stiffness>(library, "ents_ccx_stiffness_")(&nelem, label.data(), s.data(), sm.data(), ff.data(), 8);
  if (qa[2] > 0) e.step_factor = qa[2];
  const std::size_t rows = e.residual.size();
  for (std::size_t i = 0; i < rows; ++i) {
    e.residual[i] = fn[4 * (i / 3) + 1 + i % 3];
    for (std::size_t j = 0; j < rows; ++j) e.tangent[i + rows * j] = s[i + 60 * j];
  }
}

/// MSC Marc: iflag 2; state variables come back as increments.
void marc(void* library, UserElement& e) {
  using Uselem = void(int*, double*, double*, int*, int*, double*, double*, int*, double*, double*, int*,
                      int*, int*, int*, int*, int*, double*, int*, int*, int*, double*, double*, double*,
                      double*, double*, double*, int*, double*, int*);
  if (e.properties.size() > 3)
    throw JobError("--adapter marc: surface coordinates have to be in the model or in ents_k.txt");
  int one = 1, rows = e.rows(), iflag = 2, none = 0;
  Doubles mass, loads, still(e.residual.size()), change(e.state.size());
  find<Uselem>(library, "uselem_")(&one, e.tangent.data(), mass.data(), &e.nodes, &e.dimension, loads.data(),
                                   e.residual.data(), &one, e.displacement.data(), still.data(), &none, &none,
                                   &none, &e.state_size, &none, &none, e.position.data(), &e.dimension,
                                   &iflag, &rows, e.state.data(), change.data(), nullptr, nullptr, nullptr,
                                   e.properties.data(), nullptr, nullptr, &none);
  for (std::size_t i = 0; i < change.size(); ++i) e.state[i] += change[i];
}

struct Entry {
  const char *name, *file;
  Protocol protocol;
};
const Entry entries[] = {{"abaqus", "libents_abaqus.so", abaqus},
                         {"calculix", "libents_calculix.so", calculix},
                         {"marc", "libents_marc.so", marc}};

/// What the functions that stand in for the library's need. One program, one adapter.
struct Route {
  decltype(&ents_model_create) create = nullptr;
  decltype(&ents_model_layout) layout = nullptr;
  decltype(&ents_evaluate) evaluate = nullptr;
  void* library = nullptr;
  Protocol protocol = nullptr;
  fs::path folder; ///< of ents_k.json; the working directory while the adapter is called
  std::map<const ents_model*, int> numbers;

  ~Route() {
    std::error_code ignored;
    if (!folder.empty()) fs::remove_all(folder, ignored);
  }
} route;

void make_paths_absolute(Json& value, const fs::path& directory) {
  if (value.is_object() && value.contains("file"))
    value["file"] = fs::absolute(directory / value["file"].get<std::string>()).string();
  if (value.is_structured())
    for (Json& part : value) make_paths_absolute(part, directory);
}

int32_t create_model(const char* text, int64_t length, const char* directory, const ents_data* data,
                     int64_t count, ents_model** model, ents_report* report) {
  const int32_t status = route.create(text, length, directory, data, count, model, report);
  if (status != ENTS_OK) return status;
  Json json = Json::parse(text, length < 0 ? text + std::char_traits<char>::length(text) : text + length);
  make_paths_absolute(json, directory == nullptr ? "." : directory);
  const int number = static_cast<int>(route.numbers.size()) + 1;
  std::ofstream(route.folder / ("ents_" + std::to_string(number) + ".json")) << json.dump();
  route.numbers[*model] = number;
  return status;
}

/// One element through the adapter; entries of `out` that were asked for.
int32_t evaluate_one(int number, const ents_layout& layout, int64_t k, const ents_input& in,
                     const ents_output& out, ents_report* report) {
  const std::size_t d = static_cast<std::size_t>(layout.dimension),
                    m = static_cast<std::size_t>(layout.nodes),
                    of_nodes = static_cast<std::size_t>(layout.dofs - layout.multipliers),
                    dofs = static_cast<std::size_t>(layout.dofs),
                    coordinates = m * static_cast<std::size_t>(layout.parameters);
  UserElement e;
  e.dimension = layout.dimension;
  e.nodes = 1 + layout.nodes + (layout.multipliers > 0 ? 1 : 0);
  e.state_size = layout.state_size;
  const auto append = [&](Doubles& to, const double* array, int64_t stride, std::size_t size) {
    to.insert(to.end(), array + k * stride, array + k * stride + size);
  };
  append(e.position, in.slave, in.slave_stride, d);
  append(e.position, in.master, in.master_stride, m * d);
  const std::size_t rows = static_cast<std::size_t>(e.rows());
  e.position.resize(rows);
  e.displacement.resize(rows);
  for (std::size_t j = 0; j < dofs - of_nodes; ++j)
    e.displacement[(m + 1) * d + j] = in.multiplier[k * in.multiplier_stride + static_cast<int64_t>(j)];
  e.properties = {static_cast<double>(number), in.area != nullptr ? in.area[k * in.area_stride] : 1.0, 0};
  if (in.surface_coordinates != nullptr)
    append(e.properties, in.surface_coordinates, in.surface_coordinates_stride, coordinates);
  if (in.state_begin != nullptr)
    append(e.state, in.state_begin, in.state_begin_stride, static_cast<std::size_t>(e.state_size));
  e.state.resize(static_cast<std::size_t>(e.state_size));
  e.residual.resize(rows);
  e.tangent.resize(rows * rows);
  route.protocol(route.library, e);
  if (!std::isfinite(e.residual[0]) || e.step_factor < 1) {
    *report = ents_struct<ents_report>();
    report->status = ENTS_NO_PROJECTION;
    report->element = k;
    report->step_factor = e.step_factor < 1 ? e.step_factor : 0.5;
    return ENTS_NO_PROJECTION;
  }
  const auto row = [&](std::size_t i) { return i < of_nodes ? i : (m + 1) * d + i - of_nodes; };
  for (std::size_t j = 0; j < dofs; ++j) {
    if ((out.wanted & ENTS_RESIDUAL) != 0)
      out.residual[k * out.residual_stride + static_cast<int64_t>(j)] = e.residual[row(j)];
    for (std::size_t i = 0; (out.wanted & ENTS_TANGENT) != 0 && i < dofs; ++i)
      out.tangent[k * out.tangent_stride + static_cast<int64_t>(i) +
                  (out.tangent_leading_dimension ? out.tangent_leading_dimension : layout.dofs) *
                      static_cast<int64_t>(j)] = e.tangent[row(i) + rows * row(j)];
  }
  if ((out.wanted & ENTS_STATE) != 0)
    std::copy(e.state.begin(), e.state.end(), out.state_end + k * out.state_end_stride);
  return ENTS_OK;
}

int32_t evaluate_elements(const ents_model* model, int64_t first, int64_t count, const ents_input* input,
                          const ents_output* output, ents_report* report) {
  constexpr int32_t adapters = ENTS_RESIDUAL | ENTS_TANGENT | ENTS_STATE;
  const auto number = route.numbers.find(model);
  if ((output->wanted & adapters) == 0 || number == route.numbers.end())
    return route.evaluate(model, first, count, input, output, report);
  if (input->master == nullptr)
    throw JobError("--adapter: elements need the positions of their master nodes");
  // What adapters do not tell: projections, flags. Forces are asked for, too: kinematics alone would look beyond the segment's border.
  int32_t status = route.evaluate(model, first, count, input, output, report);
  if (status != ENTS_OK) return status;
  auto layout = ents_struct<ents_layout>();
  route.layout(model, &layout, report);
  const fs::path here = fs::current_path();
  fs::current_path(route.folder);
  for (int64_t k = first; k < first + count && status == ENTS_OK; ++k)
    status = evaluate_one(number->second, layout, k, *input, *output, report);
  fs::current_path(here);
  return status;
}

} // namespace

std::vector<std::string> adapter_names() {
  std::vector<std::string> names{"plain"};
  for (const Entry& entry : entries) names.emplace_back(entry.name);
  return names;
}

void install_adapter(EntsLibrary& library, const std::string& name) {
  const auto* entry =
      std::find_if(std::begin(entries), std::end(entries), [&](const Entry& e) { return e.name == name; });
  if (entry == std::end(entries)) return; // plain
  const std::string file = (fs::path(library.path()).parent_path() / entry->file).string();
  route.library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (route.library == nullptr) throw JobError(std::string("--adapter ") + name + ": " + dlerror());
  std::string folder = (fs::temp_directory_path() / "ents-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) throw JobError("--adapter: no folder for models: " + folder);
  route.folder = folder;
  route.protocol = entry->protocol;
  route.create = std::exchange(library.model_create, create_model);
  route.evaluate = std::exchange(library.evaluate, evaluate_elements);
  route.layout = library.model_layout;
}

} // namespace host
