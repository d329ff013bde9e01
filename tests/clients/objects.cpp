// SPDX-License-Identifier: BSD-3-Clause
// ents.hpp: a slider with friction on two segments, through its objects and through ents.h, gives the same bits; messages come as
// exceptions; objects that are moved or bound keep what they hold.
#include <cstdio>
#include <cstring>

#include "ents.hpp"

namespace {

int failures = 0;
void expect(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "objects.cpp: %s\n", what);
  ++failures;
}

const char* const slider = R"({"segment": "line2", "master": "rigid", "parameters": {"mu": 0.3}, "contact": {
  "normal": {"type": "penalty", "stiffness": 100}, "friction": {"type": "coulomb", "coefficient": "mu", "stiffness": 50}}})";

struct Surface {
  std::vector<double> positions{0, 0, 1, 0, 2, 0};
  std::vector<int64_t> connectivity{0, 1, 1, 2}; // the normal points up: on the left of the direction
  ents_master_mesh mesh = ents::make<ents_master_mesh>();
  Surface() {
    mesh.segments = 2, mesh.nodes = 3;
    mesh.connectivity = connectivity.data(), mesh.positions = positions.data();
  }
};

// Residual of the slider in three increments, in which it passes to the second segment.
std::vector<double> slide(const ents::Model& model, ents::States states) {
  const Surface surface;
  ents::Tree tree(model, surface.mesh);
  tree.refit(model, surface.mesh);
  int64_t segment = -1;
  double xi = 0;
  std::vector<double> all;
  for (const double x : {0.9, 0.95, 1.2}) {
    const double slave[2] = {x, -0.01}, area = 1;
    auto detection = ents::make<ents_detection>();
    detection.slave = slave, detection.reach = 0.5, detection.segment = &segment, detection.xi = &xi;
    auto input = ents::make<ents_input>();
    input.area = &area, input.area_stride = 1;
    input.state_begin = states.begin.data(), input.state_begin_stride = states.size;
    double residual[2];
    auto output = ents::make<ents_output>();
    output.wanted = ENTS_STATE | ENTS_RESIDUAL;
    output.residual = residual, output.residual_stride = 2;
    output.state_end = states.end.data(), output.state_end_stride = states.size;
    const ents::Result result = ents::call(ents_iterate, model.get(), &surface.mesh, tree.data(), tree.size(),
                                           0, 1, &detection, &input, &output, nullptr);
    expect(result.ok(), "an increment of the slider failed");
    all.insert(all.end(), residual, residual + 2);
    states.accept();
  }
  return all;
}

template <class Call> bool throws(const char* part, Call call) {
  try {
    call();
  } catch (const ents::Error& error) {
    return std::strstr(error.what(), part) != nullptr && error.report.status != ENTS_OK;
  }
  return false;
}

void* address(const char* name) { // as dlsym finds it
#define ENTS_FIND(function)                                                                                  \
  if (std::strcmp(name, "ents_" #function) == 0) return reinterpret_cast<void*>(&ents_##function);
  ENTS_FUNCTIONS(ENTS_FIND)
#undef ENTS_FIND
  return nullptr;
}

} // namespace

int main() {
  ents::Model model(slider);
  const std::vector<double> first = slide(model, ents::States(model, 1));
  expect(first.size() == 6 && first[5] == -1.0, "the normal force is not 100 x 0.01");
  expect(first[4] == 0.3 || first[4] == -0.3, "the slider does not slip at mu p");

  // A table of functions that the program has loaded itself.
  ents::Library loaded;
  loaded.load(address);
  ents::Model other(slider, "", {}, loaded);
  expect(slide(other, ents::States(other, 1)) == first, "a loaded library gives other numbers");
  expect(throws("", [] { throw ents::Error(ents_report{1, 1, 0, 0, ""}, "x"); }), "an Error has no report");
  ents::Library none;
  try {
    none.load([](const char*) -> void* { return nullptr; });
    expect(false, "a library without functions is taken");
  } catch (const std::runtime_error& error) {
    expect(std::strstr(error.what(), "ents_check_contract") != nullptr, "the missing function is not named");
  }

  // Values of parameters; a model that is moved.
  model.bind(std::vector<double>{0.1});
  ents::Model moved(std::move(model));
  const std::vector<double> smooth = slide(moved, ents::States(moved, 1));
  expect(smooth[4] == first[4] / 3 || std::abs(smooth[4]) == 0.1, "the bound coefficient is not used");
  expect(moved.parameter_place("mu") == 0, "the place of a parameter");
  other = std::move(moved);
  expect(slide(other, ents::States(other, 1)) == smooth, "an assigned model gives other numbers");

  // Messages.
  expect(throws("segmnt", [] { ents::Model(R"({"segmnt": "line2"})"); }), "an unknown key is not named");
  expect(throws("no.json", [] { ents::Model::from_file("no.json"); }), "a missing file is not named");
  expect(throws("nu", [&] { other.parameter_place("nu"); }), "an unknown parameter is not named");
  expect(throws("count", [&] { ents::call(ents_state_init, other.get(), -1, nullptr, 0); }),
         "a negative status is not thrown");

  // A pose, and points between nodes.
  ents::Pose pose(2);
  const double translation[2] = {1, 2}, turn = 0.5;
  pose.move(translation, &turn);
  expect(pose.point[0] == 1 && pose.point[1] == 2 && pose.turn[0] < 1, "the pose did not move");
  const ents::Combination middle{{0, 2}, {0, 1}, {0.5, 0.5}};
  const ents_combination view = middle.get();
  double point = 0;
  const double ends[2] = {1, 3};
  ents::require(ents::linked(), ents_combine, &view, 1, 2, ends, &point);
  expect(point == 2, "the middle of two nodes");
  std::puts(failures == 0 ? "objects: all hold" : "objects: failed");
  return failures != 0;
}
