// SPDX-License-Identifier: BSD-3-Clause
// Any characters as the text of a height: refused with a message that tells the place, or a model whose
// elements can be evaluated. Bytes become printable characters, so that it is the parser of expressions that
// sees them, and not the one of JSON.
#include <cmath>
#include <cstring>
#include <string>

#include "ents.h"
#include "fuzz/bytes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string text =
      R"({"segment": "quad4", "contact": {"normal": {"type": "penalty", "stiffness": 100}}, "height": {"type": "expression",)"
      R"( "constants": {"a": 0.01, "b": 2}, "h": ")";
  for (std::size_t i = 0; i < size; ++i) {
    const char c = static_cast<char>(data[i] & 0x7f);
    if (c == '"' || c == '\\') text += '\\';
    text += c < ' ' || c == 0x7f ? ' ' : c;
  }
  text += "\"}}";
  ents_report report{};
  report.struct_size = sizeof report;
  ents_model* model = nullptr;
  const std::int32_t made = ents_model_create(text.data(), static_cast<std::int64_t>(text.size()), nullptr,
                                              nullptr, 0, &model, &report);
  fuzz::require((made == ENTS_OK) == (model != nullptr) && report.status == made);
  if (!model) {
    fuzz::require(made == ENTS_BAD_VALUE && std::strstr(report.message, "/height/h: ") == report.message);
    return 0;
  }
  const double slave[3] = {0.1, -0.2, -0.005}, start[2] = {0.1, -0.2};
  const double master[12] = {-1, -1, 0, 1, -1, 0.1, 1.1, 1, 0, -1, 1, 0};
  double residual[15], tangent[225], gap = 0.0;
  ents_input in{};
  in.struct_size = sizeof in;
  in.slave = slave, in.master = master, in.start = start;
  ents_output out{};
  out.struct_size = sizeof out;
  out.wanted = ENTS_RESIDUAL | ENTS_TANGENT | ENTS_GAP, out.residual = residual, out.tangent = tangent,
  out.gap = &gap;
  const std::int32_t status = ents_evaluate(model, 0, 1, &in, &out, &report);
  fuzz::require(status >= 0);
  if (status == ENTS_OK) {
    fuzz::require(std::isfinite(gap));
    for (const double r : residual) fuzz::require(std::isfinite(r));
    for (const double k : tangent) fuzz::require(std::isfinite(k));
  }
  fuzz::require(ents_model_destroy(&model, &report) == ENTS_OK);
  return 0;
}
