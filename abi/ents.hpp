/* SPDX-License-Identifier: BSD-3-Clause
 *
 * ents.h for C++ (17 or later): objects that release what they hold, structs that are zeroed, exceptions with the library's message.
 * Header only. Arrays stay the caller's; every argument means what ents.h says of it, and every struct of ents.h is used as it is:
 *
 *   ents::Model model(R"({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 1e3}}})");
 *   ents::States states(model, points);                     // of the begin and of the end of an increment
 *   auto input = ents::make<ents_input>();                  // zeroed, struct_size is set
 *   ...
 *   ents::Result result = ents::call(ents_evaluate, model.get(), 0, points, &input, &output);
 *   if (!result.ok()) cut_step(result.report.step_factor);  // a recoverable status; a negative one was thrown
 *   else states.accept();
 *
 * A program that is not linked with the library, but loads it when it runs (dlopen), fills an ents::Library and passes it on.
 */
#ifndef ENTS_HPP
#define ENTS_HPP

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ents.h"

namespace ents {

/// A struct of ents.h: zeroed, with its size set.
template <class Struct> Struct make() {
  Struct value{};
  value.struct_size = static_cast<int32_t>(sizeof(Struct));
  return value;
}

/// Contiguous numbers of the caller: a pointer and their number. Made of a vector or array; empty: null.
template <class T> struct View {
  T* first = nullptr;
  int64_t count = 0;
  View() = default;
  View(T* data, int64_t size) : first(data), count(size) {}
  template <class Container> View(Container& from) : View(from.data(), static_cast<int64_t>(from.size())) {}
  template <class Container>
  View(const Container& from) : View(from.data(), static_cast<int64_t>(from.size())) {}
  T* data() const { return count > 0 ? first : nullptr; }
  int64_t size() const { return count; }
};

/// A call that failed: `what()` is the library's message.
struct Error : std::runtime_error {
  Error(const ents_report& report_, const std::string& text) : std::runtime_error(text), report(report_) {}
  ents_report report; ///< with the status and the first element concerned
};

/// Every function of ents.h, without its prefix.
// clang-format off
#define ENTS_FUNCTIONS(X) \
  X(status_text) X(version) X(check_contract) X(height_register) X(model_create) \
  X(model_create_from_file) X(model_destroy) X(model_layout) X(model_bind) X(parameter_place) \
  X(field_size) X(field_init) X(field_sample) X(tree_size) X(tree_build) X(tree_refit) X(surface_boxes) \
  X(detect) X(thickness) X(evaluate) X(state_init) X(state_augment) X(state_transfer) X(wear_collect) \
  X(parameter_derivatives) X(tributary_areas) X(contact_area) X(contact_resultants) X(suggest) X(combine) \
  X(sampling_points) X(raise_points) X(smooth_size) X(smooth) X(smooth_mirrored_size) X(smooth_mirrored) \
  X(pose_init) X(pose_move) X(pose_to_body) X(pose_to_space) X(pose_element) X(assemble) X(iterate) \
  X(surface_evaluate) X(model_check) X(surface_check) X(wear_collect_slave)
// clang-format on

/// The addresses of these functions: those that the program is linked with, or those of a library that it has loaded.
struct Library {
#define ENTS_MEMBER(name) decltype(&ents_##name) name = nullptr;
  ENTS_FUNCTIONS(ENTS_MEMBER)
#undef ENTS_MEMBER

  /// Fill the table.
  /// @param find  address of a function by its name, `void* find(const char* name)`, as dlsym; null: there is none
  /// @throws std::runtime_error that names the function that is missing; Error if the library does not serve this header
  template <class Find> void load(Find find) {
    check_contract =
        reinterpret_cast<decltype(check_contract)>(found(find("ents_check_contract"), "ents_check_contract"));
    ents_report report = make<ents_report>();
    if (check_contract(ENTS_CONTRACT_MAJOR, ENTS_CONTRACT_MINOR, &report) != ENTS_OK)
      throw Error(report, report.message);
#define ENTS_LOAD(name) name = reinterpret_cast<decltype(name)>(found(find("ents_" #name), "ents_" #name));
    ENTS_FUNCTIONS(ENTS_LOAD)
#undef ENTS_LOAD
  }

private:
  static void* found(void* address, const char* name) {
    if (address == nullptr) throw std::runtime_error(std::string("the library has no function ") + name);
    return address;
  }
};

/// The library that the program is linked with.
inline const Library& linked() {
  static const Library library = [] {
    Library table;
#define ENTS_ADDRESS(name) table.name = &ents_##name;
    ENTS_FUNCTIONS(ENTS_ADDRESS)
#undef ENTS_ADDRESS
    return table;
  }();
  return library;
}

/// "STATUS TEXT: MESSAGE"; the message alone if it says the text (that of an element: its number, then the text).
inline std::string describe(const Library& library, int32_t status, const ents_report& report) {
  const std::string text = library.status_text(status), message = report.message;
  if (message.empty()) return text;
  return message.find(text) != std::string::npos ? message : text + ": " + message;
}

/// What a call returns that did not fail: 0, or a recoverable status and what the report says of it.
struct Result {
  int32_t status = ENTS_OK;
  ents_report report = make<ents_report>();
  bool ok() const { return status == ENTS_OK; }
};

/// A function of ents.h with all its arguments but the last one, the report.
/// @throws Error for a negative status
template <class... Parameters, class... Arguments>
Result call(int32_t (*function)(Parameters...), Arguments... arguments) {
  Result result;
  result.status = function(arguments..., &result.report);
  if (result.status < 0) throw Error(result.report, result.report.message);
  return result;
}

/// The same where a recoverable status is an error, too. @throws Error for any status but 0
template <class... Parameters, class... Arguments>
void require(const Library& library, int32_t (*function)(Parameters...), Arguments... arguments) {
  ents_report report = make<ents_report>();
  const int32_t status = function(arguments..., &report);
  if (status != ENTS_OK) throw Error(report, describe(library, status, report));
}

/// A model, and the model bound to it once `bind` has been called: that is what `get` returns then.
class Model {
public:
  /// @param text       JSON
  /// @param directory  where relative names of files start; empty: the working directory
  /// @param data       arrays that the text refers to by name
  explicit Model(const std::string& text, const std::string& directory = {}, View<const ents_data> data = {},
                 const Library& library = linked())
      : library_(&library) {
    require(library, library.model_create, text.data(), static_cast<int64_t>(text.size()),
            directory.empty() ? nullptr : directory.c_str(), data.data(), data.size(), &model_);
    read_layout();
  }
  static Model from_file(const std::string& path, const Library& library = linked()) {
    Model model(library);
    require(library, library.model_create_from_file, path.c_str(), &model.model_);
    model.read_layout();
    return model;
  }
  Model(Model&& other) noexcept
      : library_(other.library_), model_(std::exchange(other.model_, nullptr)),
        bound_(std::exchange(other.bound_, nullptr)), layout_(other.layout_) {}
  Model& operator=(Model&& other) noexcept {
    std::swap(library_, other.library_), std::swap(model_, other.model_), std::swap(bound_, other.bound_);
    std::swap(layout_, other.layout_);
    return *this;
  }
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;
  ~Model() {
    if (bound_ != nullptr) library_->model_destroy(&bound_, nullptr);
    if (model_ != nullptr) library_->model_destroy(&model_, nullptr);
  }

  const ents_model* get() const { return bound_ != nullptr ? bound_ : model_; }
  const ents_layout& layout() const { return layout_; }
  const Library& library() const { return *library_; }

  /// Take these values of the named parameters (empty: those of the text) and these blocks of the fields from now on.
  void bind(View<const double> parameters, View<const ents_data> fields = {}) {
    require(*library_, library_->model_bind, static_cast<const ents_model*>(model_), parameters.data(),
            fields.data(), fields.size(), &bound_);
  }
  int64_t parameter_place(const std::string& name) const {
    int64_t place = -1;
    require(*library_, library_->parameter_place, get(), name.c_str(), &place);
    return place;
  }
  /// The block of a field. @param samples  null: zero everywhere
  std::vector<double> field(const std::string& name, const double* samples = nullptr) const {
    int64_t size = 0;
    require(*library_, library_->field_size, get(), name.c_str(), &size);
    std::vector<double> block(static_cast<std::size_t>(size));
    require(*library_, library_->field_init, get(), name.c_str(), samples, block.data(), size);
    return block;
  }

private:
  explicit Model(const Library& library) : library_(&library) {}
  void read_layout() {
    try {
      require(*library_, library_->model_layout, get(), &layout_);
    } catch (...) {
      library_->model_destroy(&model_, nullptr);
      throw;
    }
  }

  const Library* library_;
  ents_model *model_ = nullptr, *bound_ = nullptr;
  ents_layout layout_ = make<ents_layout>();
};

/// The tree of a master surface.
class Tree {
public:
  Tree() = default;
  Tree(const Model& model, const ents_master_mesh& mesh) {
    const Library& library = model.library();
    int64_t size = 0;
    require(library, library.tree_size, model.get(), mesh.segments, &size);
    numbers_.resize(static_cast<std::size_t>(size));
    require(library, library.tree_build, model.get(), &mesh, numbers_.data(), size);
  }
  /// Whenever positions, surface coordinates or the values of the height have changed.
  void refit(const Model& model, const ents_master_mesh& mesh) {
    require(model.library(), model.library().tree_refit, model.get(), &mesh, numbers_.data(), size());
  }
  const double* data() const { return numbers_.data(); }
  int64_t size() const { return static_cast<int64_t>(numbers_.size()); }

private:
  std::vector<double> numbers_;
};

/// States of elements at the begin and at the end of an increment, new ones at first. The arrays may be copied and put back.
struct States {
  States() = default;
  States(const Model& model, int64_t count)
      : begin(static_cast<std::size_t>(count * model.layout().state_size)), size(model.layout().state_size) {
    require(model.library(), model.library().state_init, model.get(), count, begin.data(), size);
    end = begin;
  }
  /// The increment is accepted: its end is the begin of the next one.
  void accept() { begin.swap(end); }
  /// Uzawa: the multipliers of the end go into the states of the begin.
  void augment(const Model& model) {
    require(model.library(), model.library().state_augment, model.get(),
            static_cast<int64_t>(begin.size()) / size, begin.data(), size,
            static_cast<const double*>(end.data()), size);
  }
  std::vector<double> begin, end; ///< [elements][size]
  int64_t size = 0;               ///< doubles of a state
};

/// A rigid body's place.
struct Pose : ents_pose {
  explicit Pose(int32_t dimension_, const Library& library_ = linked())
      : ents_pose(make<ents_pose>()), dimension(dimension_), library(&library_) {
    require(*library, library->pose_init, dimension, static_cast<ents_pose*>(this));
  }
  /// @param translation, spin  null: none
  void move(const double* translation, const double* spin) {
    require(*library, library->pose_move, dimension, translation, spin, static_cast<ents_pose*>(this));
  }
  int32_t dimension;
  const Library* library;
};

/// Points that are linear combinations of nodes, with their arrays; `get` is what ents.h takes.
struct Combination {
  std::vector<int64_t> begin, nodes;
  std::vector<double> weights;
  ents_combination get() const {
    auto view = make<ents_combination>();
    view.points = static_cast<int64_t>(begin.size()) - 1;
    view.begin = begin.data(), view.nodes = nodes.data(), view.weights = weights.data();
    return view;
  }
};

} // namespace ents

#endif
