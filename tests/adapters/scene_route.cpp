// SPDX-License-Identifier: BSD-3-Clause
#include "scene_route.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>
#include <utility>

#include <unistd.h>

#include "abaqus_services.hpp"
#include "guarded.hpp"
#include "hosts.hpp"
#include "own_elements.hpp"
#include "toolbox/error.hpp"
#include "toolbox/json_reader.hpp"

namespace adapters {
namespace {
namespace fs = std::filesystem;
using host::InputError, host::JobError, host::Json, host::OwnElements, host::ents_struct;

/// No adapter: the plain interface, asked as an adapter asks it.
const HostKind direct{.name = "direct", .make = nullptr, .title = "none", .coordinates = true};

/// What an element brings that is in the files of its model.
struct InFiles {
  std::vector<double> coordinates; ///< of the surface; none: empty
  std::vector<double> body;        ///< master nodes of a rigid body that turns; another one: empty
  auto operator<=>(const InFiles&) const = default;
};

/// A model of the scene, and the files that adapters read it from.
struct WrittenModel {
  Json json;
  ents_layout layout{};
  ents_model* base = nullptr;     ///< for `direct`: without the height; null if there is none to leave out
  std::map<InFiles, int> numbers; ///< of the files
};

/// What the functions that stand in for the library's need. One process, one adapter.
struct Route {
  const HostKind* kind = nullptr;
  decltype(&ents_model_create) create = nullptr;
  decltype(&ents_model_layout) layout = nullptr;
  decltype(&ents_model_destroy) destroy = nullptr;
  decltype(&ents_evaluate) evaluate = nullptr;
  decltype(&ents_assemble) assemble = nullptr;
  decltype(&ents_pose_element) pose_element = nullptr;
  fs::path folder; ///< of ents_k.json; the working directory while the adapter is called
  int last_number = 0;
  std::map<const ents_model*, WrittenModel> models;

  ~Route() {
    std::error_code ignored;
    if (!folder.empty()) fs::remove_all(folder, ignored);
  }
} route;

std::string option() { return "--adapter " + route.kind->name + ": "; }

void make_paths_absolute(Json& value, const fs::path& directory) {
  if (value.is_object() && value.contains("file"))
    value["file"] = fs::absolute(directory / value["file"].get<std::string>()).string();
  if (value.is_structured())
    for (Json& part : value) make_paths_absolute(part, directory);
}

/// @throws InputError for what elements of this program cannot have
void check_limits(const Json& model, const ents_layout& layout) {
  const HostKind& program = *route.kind;
  const std::string who = "user elements of " + program.title;
  const int nodes = 1 + layout.nodes + (layout.multipliers > 0 ? 1 : 0);
  if (program.dimension != 0 && layout.dimension != program.dimension)
    throw InputError(option() + "/dimension is " + std::to_string(layout.dimension) + ", " + who +
                     " are in " + std::to_string(program.dimension) + "D only");
  if (layout.multipliers > 0 && !program.multipliers)
    throw InputError(option() + "/contact/model/contact/normal/type " +
                     model["contact"]["normal"]["type"].dump() + ": " + who +
                     " cannot have multipliers as unknowns; take \"penalty\" or \"augmented\"");
  if (program.nodes != 0 && nodes > program.nodes)
    throw InputError(option() + "/contact/model/segment " + model["segment"].dump() + ": an element has " +
                     std::to_string(nodes) + " nodes, " + who + " have " + std::to_string(program.nodes) +
                     " at most");
}

ents_model* without_height(Json model, const char* directory) {
  if (!model.contains("height") || model["height"].is_null() || model.contains("patch")) return nullptr;
  model["height"] = nullptr;
  ents_model* base = nullptr;
  route.create(model.dump().c_str(), -1, directory, nullptr, 0, &base, nullptr);
  return base;
}

int32_t create_model(const char* text, int64_t length, const char* directory, const ents_data* data,
                     int64_t count, ents_model** model, ents_report* report) {
  const int32_t status = route.create(text, length, directory, data, count, model, report);
  if (status != ENTS_OK) return status;
  WrittenModel written;
  written.json = Json::parse(text, length < 0 ? text + std::char_traits<char>::length(text) : text + length);
  written.layout = ents_struct<ents_layout>();
  route.layout(*model, &written.layout, report);
  try {
    check_limits(written.json, written.layout);
  } catch (...) {
    route.destroy(model, nullptr);
    throw;
  }
  if (route.kind == &direct) written.base = without_height(written.json, directory);
  make_paths_absolute(written.json, directory == nullptr ? "." : directory);
  route.models.insert_or_assign(*model, std::move(written));
  return status;
}

int32_t destroy_model(ents_model** handle, ents_report* report) {
  if (handle != nullptr) {
    if (const auto model = route.models.find(*handle); model != route.models.end()) {
      route.destroy(&model->second.base, nullptr);
      route.models.erase(model);
    }
  }
  return route.destroy(handle, report);
}

/// The file for an element with these surface coordinates [m][d-1], or none. Programs whose elements cannot
/// carry them need a model for each segment.
int model_number(WrittenModel& model, const InFiles& in_files) {
  const auto [entry, is_new] = model.numbers.try_emplace(in_files, 0);
  if (!is_new) return entry->second;
  const std::vector<double>& coordinates = in_files.coordinates;
  Json json = model.json;
  const auto parameters = static_cast<std::size_t>(model.layout.parameters);
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    if (i == 0) json["surface_coordinates"] = Json::array();
    if (i % parameters == 0) json["surface_coordinates"].push_back(Json::array());
    json["surface_coordinates"].back().push_back(coordinates[i]);
  }
  entry->second = ++route.last_number;
  const std::string name = "ents_" + std::to_string(entry->second);
  std::ofstream(route.folder / (name + ".json")) << json.dump();
  if (in_files.body.empty()) return entry->second;
  std::ofstream table(route.folder / (name + ".txt"));
  table.precision(17);
  for (std::size_t i = 0; i < in_files.body.size(); ++i)
    table << (i % static_cast<std::size_t>(model.layout.dimension) == 0 ? "\nbody " : " ")
          << in_files.body[i];
  table << "\n";
  return entry->second;
}

/// Residual [dofs], tangent [dofs][dofs] column-major and state at the end of one element.
struct ElementResult {
  std::vector<double> residual, tangent, state;
};

/// Reference point and turns of a rigid body as nodes; no turn since the history: derivatives are by spins.
void add_body(Elements& e, const ents_pose& pose, std::vector<double>& displacement,
              std::vector<double>& state) {
  const std::vector<double> in_body = e.reference;
  const std::size_t d = at(e.dimension);
  e.body = true;
  for (std::size_t i = 0; i < d; ++i) {
    e.reference[i] = pose.point[i];
    for (std::size_t j = 0; j < d; ++j) e.reference[i] += pose.turn[d * i + j] * in_body[j];
  }
  e.reference.insert(e.reference.end(), pose.point, pose.point + d);
  e.reference.resize(3 * d);
  displacement.assign(3 * d, 0.0);
  if (d == 2) {
    displacement[2 * d] = std::atan2(pose.turn[2], pose.turn[0]);
    return;
  }
  state.insert(state.end(), pose.turn, pose.turn + 9);
  state.resize(state.size() + 3);
}

/// An element through the adapter, by a host that has no other one and in whose increment nothing has moved.
/// @param pose  of a rigid body that turns, or null
/// @return the step factor; < 1: the adapter wants a cut and nothing was written
double evaluate_one(WrittenModel& model, const ents_input& in, const ents_pose* pose, ElementResult& out) {
  if (*in.area == 0) return 1; // a node without area is in no deck: its forces are zero
  const ents_layout& layout = model.layout;
  const std::size_t d = at(layout.dimension), m = at(layout.nodes), multipliers = at(layout.multipliers);
  Elements e;
  e.dimension = layout.dimension, e.multipliers = layout.multipliers, e.stiffness = route.kind->stiffness;
  e.symmetric = layout.symmetric_tangent != 0 && pose == nullptr;
  e.area = {*in.area};
  e.reference.assign(in.slave, in.slave + d);
  std::vector<double> state(at(layout.state_size)), displacement;
  if (in.state_begin != nullptr) state.assign(in.state_begin, in.state_begin + layout.state_size);
  InFiles in_files;
  if (pose != nullptr) {
    in_files.body.assign(in.master, in.master + m * d);
    add_body(e, *pose, displacement, state);
  } else {
    e.reference.insert(e.reference.end(), in.master, in.master + m * d);
    if (multipliers > 0) e.reference.resize(e.reference.size() + d);
    displacement.resize(e.reference.size());
    std::copy_n(in.multiplier, multipliers, displacement.begin() + static_cast<std::ptrdiff_t>((m + 1) * d));
  }
  e.nodes.emplace_back(e.reference.size() / d);
  std::iota(e.nodes[0].begin(), e.nodes[0].end(), 0);
  e.state_size = static_cast<int>(state.size());
  if (in.surface_coordinates != nullptr)
    (route.kind->coordinates ? e.surface_coordinates : in_files.coordinates)
        .assign(in.surface_coordinates, in.surface_coordinates + m * at(layout.parameters));
  e.model = model_number(model, in_files);
  const std::unique_ptr<EmulatedHost> host = route.kind->make(e);
  host->set_history(0, state);
  host->begin(displacement);
  const Answer answer = host->evaluate(0, displacement);
  if (answer.residual.empty()) return answer.step_factor;
  // Multipliers come behind all nodes, also behind those of a master that has no unknowns.
  const std::size_t dofs = out.residual.size(), rows = answer.residual.size(),
                    of_nodes = pose != nullptr ? dofs : dofs - multipliers;
  const auto row = [&](std::size_t i) { return i < of_nodes ? i : (m + 1) * d + i - of_nodes; };
  for (std::size_t j = 0; j < dofs; ++j) {
    out.residual[j] = answer.residual[row(j)];
    for (std::size_t i = 0; e.stiffness && i < dofs; ++i)
      out.tangent[i + dofs * j] = answer.tangent[row(i) + rows * row(j)];
  }
  for (const std::vector<double>* values : {&out.residual, &out.tangent})
    for (const double value : *values)
      if (!std::isfinite(value)) throw JobError(option() + "a force or a stiffness is not finite");
  state = host->history(0);
  std::copy_n(state.begin(), out.state.size(), out.state.begin()); // a body's history is the pose
  return 1;
}

/// An element through the plain interface; `start` says where the projection starts, or null.
/// @return as evaluate_one
double evaluate_plainly(const ents_model* handle, ents_input in, const ents_pose* pose, const double* start,
                        ElementResult& result) {
  auto out = ents_struct<ents_output>();
  out.wanted = ENTS_RESIDUAL | ENTS_TANGENT | (result.state.empty() ? 0 : ENTS_STATE);
  out.residual = result.residual.data(), out.tangent = result.tangent.data(),
  out.state_end = result.state.data();
  in.start = start;
  auto report = ents_struct<ents_report>();
  const int32_t status = route.evaluate(handle, 0, 1, &in, &out, &report);
  if (status < 0) throw JobError(option() + report.message);
  if (status > 0) return report.step_factor;
  if (pose == nullptr) return 1;
  const ElementResult rigid = result; // of the slave in the body's frame: the first entries
  if (route.pose_element(route.models.at(handle).layout.dimension, pose, in.slave, rigid.residual.data(),
                         rigid.tangent.data(), result.residual.data(), result.tangent.data(),
                         &report) != ENTS_OK)
    throw JobError(option() + report.message);
  return 1;
}

/// What is left of an adapter without its program is where it starts the projection: on the segment without
/// its height, unless the history knows better. This program starts where it has detected the node, which is
/// quicker, and gives other last bits.
double evaluate_directly(const ents_model* handle, const WrittenModel& model, const ents_input& in,
                         const ents_pose* pose, ElementResult& result) {
  double start[2] = {};
  bool found = false;
  if (model.base != nullptr) {
    ents_input plain = in;
    plain.start = nullptr, plain.state_begin = nullptr;
    auto projection = ents_struct<ents_output>();
    projection.wanted = ENTS_XI;
    projection.xi = start;
    found = route.evaluate(model.base, 0, 1, &plain, &projection, nullptr) == ENTS_OK;
  }
  return evaluate_plainly(handle, in, pose, found ? start : nullptr, result);
}

/// While adapters are called the models are in the working directory, and what they write on standard output
/// goes to standard error: the former is this program's own.
class JobSurroundings {
public:
  JobSurroundings() : folder_(fs::current_path()) {
    if (!route.folder.empty()) fs::current_path(route.folder);
    std::fflush(stdout);
    output_ = dup(STDOUT_FILENO);
    dup2(STDERR_FILENO, STDOUT_FILENO);
  }
  ~JobSurroundings() {
    std::fflush(stdout);
    dup2(output_, STDOUT_FILENO);
    close(output_);
    std::error_code ignored;
    fs::current_path(folder_, ignored);
  }
  JobSurroundings(const JobSurroundings&) = delete;
  JobSurroundings& operator=(const JobSurroundings&) = delete;

private:
  fs::path folder_;
  int output_;
};

int32_t assemble_elements(const ents_model* handle, int64_t first, int64_t count, const ents_input* input,
                          const ents_output* output, const ents_system* system, ents_report* report) {
  WrittenModel& model = route.models.at(handle);
  const ents_layout& layout = model.layout;
  // What adapters do not tell: flags, projections, elements without a segment.
  ents_system no_forces = *system;
  no_forces.residual = no_forces.values = nullptr;
  const int32_t status = route.assemble(handle, first, count, input, output, &no_forces, report);
  if (status < 0) return status;
  if (status > 0 && !route.kind->cuts)
    throw JobError(option() + "an element needs a smaller load step (" + report->message +
                   "), which elements of " + route.kind->title +
                   " cannot ask for: give /steps/values more entries");
  double step_factor = 1;
  int64_t k = first;
  OwnElements elements(layout, *input, *system);
  const auto dofs = static_cast<std::size_t>(elements.rows());
  const JobSurroundings surroundings;
  for (; k < first + count && step_factor == 1; ++k) {
    if (!elements.has_segment(k)) {
      route.assemble(handle, k, 1, input, output, system, report);
      continue;
    }
    const ents_input in = elements.input(k);
    ElementResult result{std::vector<double>(dofs), std::vector<double>(dofs * dofs),
                         std::vector<double>(static_cast<std::size_t>(layout.state_size))};
    if (route.kind == &direct) {
      step_factor = evaluate_directly(handle, model, in, system->pose, result);
    } else {
      if (!route.kind->stiffness && system->values != nullptr)
        evaluate_plainly(handle, in, system->pose, in.start, result);
      try {
        step_factor = evaluate_one(model, in, system->pose, result);
      } catch (const HostStopped& stop) { // what Abaqus reads besides
        std::string why = stop.what();
        for (const AbaqusMessage& message : abaqus_messages()) why += "; " + message.text;
        throw JobError(option() + "the adapter has ended the job: " + why);
      }
    }
    if (step_factor < 1) break;
    elements.add(k, result.residual.data(), result.tangent.data());
    if ((output->wanted & ENTS_STATE) != 0)
      std::copy(result.state.begin(), result.state.end(), output->state_end + k * output->state_end_stride);
  }
  if (step_factor == 1) return status;
  if (status == ENTS_OK) { // the search of the adapter went another way than that of this program
    *report = ents_struct<ents_report>();
    report->status = ENTS_NO_PROJECTION;
    report->element = k;
  }
  report->step_factor = step_factor;
  return report->status;
}

} // namespace

std::vector<std::string> route_names() {
  std::vector<std::string> names{"plain", direct.name};
  for (const HostKind& kind : hosts()) names.push_back(kind.name);
  return names;
}

void check_adapter(const host::Scene& scene, const std::string& name) {
  if (!scene.contact || name == "plain") return;
  std::string why;
  if (scene.contact->body && name == "lsdyna")
    why = scene.file.string() + ": /contact/master/rigid_body: elements of LS-DYNA see present positions "
                                "only, and the turns of a body are displacements";
  if (!host::find_json(scene.contact->model, "/parameters").is_null())
    why =
        scene.contact->model_where + "/parameters: the elements of adapters read a model once, and it stays";
  if (!why.empty()) throw InputError(why + "; run it without --adapter " + name);
}

void install_adapter(host::EntsLibrary& library, const std::string& name) {
  if (name == "plain") return;
  if (name == "abaqus_uinter")
    throw InputError("--adapter abaqus_uinter: UINTER is the law of a point and has no segments; the user "
                     "element is --adapter abaqus (adapters/abaqus/uinter/README.md says what tests UINTER)");
  static const std::vector<HostKind> kinds = hosts();
  const auto kind =
      std::find_if(kinds.begin(), kinds.end(), [&](const HostKind& each) { return each.name == name; });
  if (kind == kinds.end() && name != direct.name) {
    std::string all;
    for (const std::string& known : route_names()) all += (all.empty() ? "" : ", ") + known;
    throw InputError("--adapter " + name + ": there is no such adapter; write one of " + all);
  }
  route.kind = name == direct.name ? &direct : &*kind;
  route.create = std::exchange(library.model_create, create_model);
  route.evaluate = library.evaluate;
  route.pose_element = library.pose_element;
  route.assemble = std::exchange(library.assemble, assemble_elements);
  route.layout = library.model_layout;
  route.destroy = std::exchange(library.model_destroy, destroy_model);
  if (route.kind == &direct) return;
  std::string folder = (fs::temp_directory_path() / "ents-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) throw JobError("--adapter: no folder for models: " + folder);
  route.folder = folder;
}

} // namespace adapters
