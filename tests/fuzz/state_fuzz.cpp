// SPDX-License-Identifier: BSD-3-Clause
// Any numbers as positions and state of an element: refused, or results that are finite.
#include <cmath>
#include <string>
#include <vector>

#include "ents.h"
#include "fuzz/bytes.hpp"

namespace {

const char* const contacts[] = {
    R"({"normal": {"type": "penalty", "stiffness": 100}})",
    R"({"normal": {"type": "penalty", "stiffness": 100}, "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 50}})",
    R"({"normal": {"type": "augmented", "stiffness": 100}, "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 50}})",
    R"({"normal": {"type": "exponential", "pressure": 1, "clearance": 0.1}, "friction": {"type": "rough", "stiffness": 50}})"};
const char* const segments[] = {"line2", "line3", "bspline4", "tri3", "quad4", "quad9"};
const char* const patches[] = {
    "[[0, 1], [1, 2]]", "", "", "[[0, 1, 2], [2, 1, 3]]", "[[0, 1, 2, 3], [1, 4, 5, 2]]", ""};

std::vector<ents_model*> make_models() {
  std::vector<ents_model*> models;
  for (int s = 0; s < 6; ++s)
    for (const char* contact : contacts)
      for (const bool patch : {false, true}) {
        if (patch && (!patches[s][0] || contact == contacts[2]))
          continue; // augmented friction stays on one segment
        const std::string text = R"({"segment": ")" + std::string(segments[s]) +
                                 R"(", "height": {"type": "sine", "amplitude": 0.05, "wave_vector": )" +
                                 (s < 3 ? "[0.7]" : "[0.7, 0.4]") + R"(}, "contact": )" + contact +
                                 (patch ? R"(, "patch": )" + std::string(patches[s]) : "") + "}";
        ents_model* model = nullptr;
        if (ents_model_create(text.c_str(), -1, nullptr, nullptr, 0, &model, nullptr) != ENTS_OK)
          std::abort();
        models.push_back(model);
      }
  return models;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::vector<ents_model*>& models =
      *new std::vector<ents_model*>(make_models()); // to the end: no leak
  fuzz::Bytes bytes(data, size);
  const ents_model* model = models[static_cast<std::size_t>(bytes.below(static_cast<int>(models.size())))];
  ents_layout layout{};
  layout.struct_size = sizeof layout;
  ents_model_layout(model, &layout, nullptr);
  const auto d = static_cast<std::size_t>(layout.dimension), m = static_cast<std::size_t>(layout.nodes),
             n = static_cast<std::size_t>(layout.dofs);
  std::vector<double> slave(d), master(m * d), state(static_cast<std::size_t>(layout.state_size)), end(state),
      residual(n), tangent(n * n);
  for (double& x : slave) x = bytes.number();
  for (double& x : master) x = bytes.number();
  ents_state_init(model, 1, state.data(), layout.state_size, nullptr);
  for (std::size_t i = bytes.below(8) == 0 ? 0 : 1; i < state.size(); ++i)
    state[i] = bytes.below(4) == 0 ? bytes.below(5) : bytes.number();
  double gap = 0.0;
  std::int32_t flags = 0;
  ents_input in{};
  in.struct_size = sizeof in;
  in.slave = slave.data(), in.master = master.data(), in.state_begin = state.data();
  ents_output out{};
  out.struct_size = sizeof out;
  out.wanted = ENTS_GAP | ENTS_RESIDUAL | ENTS_TANGENT | ENTS_STATE | ENTS_FLAGS;
  out.gap = &gap, out.residual = residual.data(), out.tangent = tangent.data(), out.state_end = end.data(),
  out.flags = &flags;
  if (ents_evaluate(model, 0, 1, &in, &out, nullptr) != ENTS_OK) return 0;
  double sum = gap;
  for (const double x : residual) sum += x;
  for (const double x : tangent) sum += x;
  for (const double x : end) sum += x;
  fuzz::require(std::isfinite(sum));
  in.state_begin = end.data(), out.state_end = state.data(); // its own states are accepted
  fuzz::require(ents_evaluate(model, 0, 1, &in, &out, nullptr) >= 0);
  return 0;
}
