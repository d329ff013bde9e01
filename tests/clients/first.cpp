#include "ents.h"
#include <cstdio>

int main() {
  const char* text = R"({"segment": "quad4",
    "height": {"type": "sine", "amplitude": 0.05, "wave_vector": [0.5, 0.25]},
    "contact": {"normal": {"type": "penalty", "stiffness": 1000}}})";
  const double slave[3] = {-0.4, 0.3, -0.1};
  const double master[4][3] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  double gap, residual[15], tangent[15][15];

  ents_report report{};
  report.struct_size = sizeof report;
  ents_input in{};
  in.struct_size = sizeof in;
  in.slave = slave, in.master = master[0];
  ents_output out{};
  out.struct_size = sizeof out;
  out.wanted = ENTS_GAP | ENTS_RESIDUAL | ENTS_TANGENT;
  out.gap = &gap, out.residual = residual, out.tangent = tangent[0];

  ents_model* model = nullptr;
  auto status = ents_model_create(text, -1, nullptr, nullptr, 0, &model, &report);
  if (status == ENTS_OK) status = ents_evaluate(model, 0, 1, &in, &out, &report);
  if (status != ENTS_OK)
    std::fprintf(stderr, "%s\n", report.message);
  else
    for (int i = 0; i < 15; ++i) std::printf("%24.16E%24.16E%24.16E\n", gap, residual[i], tangent[2][i]);
  ents_model_destroy(&model, nullptr);
  return status != ENTS_OK;
}
