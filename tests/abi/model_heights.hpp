// SPDX-License-Identifier: BSD-3-Clause
// Heights of models that were read.
#pragma once

#include <string>

#include "abi/read/model_json.hpp"
#include "core/height/height.hpp"

namespace ents::testing {

inline double height_1(const ModelSpec& model, double s1) {
  const double s[1] = {s1};
  return ENTS_ISA::evaluate_height(model.height.root(), s).h;
}

inline double height_2(const ModelSpec& model, double s1, double s2) {
  const double s[2] = {s1, s2};
  return ENTS_ISA::evaluate_height(model.height.root(), s).h;
}

inline std::string with_height(const std::string& segment, const std::string& height) {
  return R"({"segment": ")" + segment + R"(", "height": )" + height + "}";
}

} // namespace ents::testing
