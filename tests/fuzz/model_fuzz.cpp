// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as the text of a model: refused with a message, or a model whose elements can be evaluated.
#include <cmath>
#include <vector>

#include "ents.h"
#include "fuzz/bytes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ents_report report{};
  report.struct_size = sizeof report;
  ents_model* model = nullptr;
  const std::int32_t made =
      ents_model_create(reinterpret_cast<const char*>(data), static_cast<std::int64_t>(size), "/nonexistent",
                        nullptr, 0, &model, &report);
  fuzz::require((made == ENTS_OK) == (model != nullptr) && report.status == made &&
                (made == ENTS_OK) == (report.message[0] == '\0'));
  if (!model) return 0;
  ents_layout layout{};
  layout.struct_size = sizeof layout;
  fuzz::require(ents_model_layout(model, &layout, &report) == ENTS_OK);
  const auto d = static_cast<std::size_t>(layout.dimension), m = static_cast<std::size_t>(layout.nodes),
             n = static_cast<std::size_t>(layout.dofs);
  std::vector<double> slave(d, 0.1), master(m * d), residual(n), tangent(n * n),
      multiplier(static_cast<std::size_t>(layout.multipliers));
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t k = 0; k < d; ++k) master[i * d + k] = std::cos(1.0 + static_cast<double>(3 * i + k));
  ents_input in{};
  in.struct_size = sizeof in;
  in.slave = slave.data(), in.master = master.data(), in.multiplier = multiplier.data();
  ents_output out{};
  out.struct_size = sizeof out;
  double gap = 0.0;
  out.wanted = ENTS_GAP, out.gap = &gap, out.residual = residual.data(), out.tangent = tangent.data();
  const std::int32_t kinematics = ents_evaluate(model, 0, 1, &in, &out, &report);
  fuzz::require(kinematics >= 0 && (kinematics > 0 || std::isfinite(gap)));
  out.wanted = ENTS_RESIDUAL | ENTS_TANGENT;
  const std::int32_t element = ents_evaluate(model, 0, 1, &in, &out, &report);
  fuzz::require(element >= 0 || element == ENTS_BAD_MASK); // a model without contact
  for (std::size_t i = 0; element == ENTS_OK && i < n; ++i)
    fuzz::require(std::isfinite(residual[i]) && std::isfinite(tangent[i * n + i]));
  fuzz::require(ents_model_destroy(&model, &report) == ENTS_OK && !model);
  return 0;
}
