// SPDX-License-Identifier: BSD-3-Clause
// A model as the C ABI has it, which its owner destroys.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "library.hpp"

namespace laws {

struct Destroy {
  void operator()(ents_model* model) const { ents_model_destroy(&model, nullptr); }
};
using Handle = std::unique_ptr<ents_model, Destroy>;

// Throws std::runtime_error with the library's message when the text is refused.
inline Handle make(const nlohmann::json& text) {
  ents_model* model = nullptr;
  ents_report report = mechanics::new_report();
  if (ents_model_create(text.dump().c_str(), -1, nullptr, nullptr, 0, &model, &report) != ENTS_OK)
    throw std::runtime_error(report.message);
  return Handle(model);
}

} // namespace laws
