// SPDX-License-Identifier: BSD-3-Clause
// A model and its layout, through the plain ABI.
#pragma once

#include <fstream>
#include <stdexcept>
#include <string>

#include <ents.h>
#include <nlohmann/json.hpp>

namespace adapters {

inline void write(const std::string& file, const std::string& text) { std::ofstream(file) << text; }

template <class Struct> Struct ents_struct() {
  Struct value{};
  value.struct_size = static_cast<int32_t>(sizeof(Struct));
  return value;
}

class PlainModel {
public:
  explicit PlainModel(const std::string& file) : layout_(ents_struct<ents_layout>()) {
    auto report = ents_struct<ents_report>();
    if (ents_model_create_from_file(file.c_str(), &model_, &report) != ENTS_OK ||
        ents_model_layout(model_, &layout_, &report) != ENTS_OK)
      throw std::runtime_error(file + ": " + report.message);
  }
  explicit PlainModel(const nlohmann::json& model) : layout_(ents_struct<ents_layout>()) {
    auto report = ents_struct<ents_report>();
    if (ents_model_create(model.dump().c_str(), -1, nullptr, nullptr, 0, &model_, &report) != ENTS_OK)
      throw std::runtime_error(report.message);
  }
  ~PlainModel() { ents_model_destroy(&model_, nullptr); }
  PlainModel(const PlainModel&) = delete;
  PlainModel& operator=(const PlainModel&) = delete;

  const ents_model* get() const { return model_; }
  const ents_layout& layout() const { return layout_; }

private:
  ents_model* model_ = nullptr;
  ents_layout layout_;
};

} // namespace adapters
