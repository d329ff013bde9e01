#include "ents.h"
#include <stdio.h>

int main(void) {
  const char* text = "{\"segment\": \"quad4\","
                     " \"height\": {\"type\": \"sine\", \"amplitude\": 0.05, \"wave_vector\": [0.5, 0.25]},"
                     " \"contact\": {\"normal\": {\"type\": \"penalty\", \"stiffness\": 1000}}}";
  const double slave[3] = {-0.4, 0.3, -0.1}; /* current positions */
  const double master[4][3] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  double gap, residual[15], tangent[15][15]; /* 3 dofs of the slave, then 4 x 3 of the master */

  ents_report report = {.struct_size = sizeof report};
  ents_input in = {.struct_size = sizeof in, .slave = slave, .master = master[0]};
  ents_output out = {.struct_size = sizeof out,
                     .wanted = ENTS_GAP | ENTS_RESIDUAL | ENTS_TANGENT,
                     .gap = &gap,
                     .residual = residual,
                     .tangent = tangent[0]};
  ents_model* model = NULL;
  int32_t status = ents_model_create(text, -1, NULL, NULL, 0, &model, &report);   /* once */
  if (status == ENTS_OK) status = ents_evaluate(model, 0, 1, &in, &out, &report); /* > 0: cut the step */
  if (status != ENTS_OK)
    fprintf(stderr, "%s\n", report.message);
  else
    for (int i = 0; i < 15; i++) printf("%24.16E%24.16E%24.16E\n", gap, residual[i], tangent[2][i]);
  ents_model_destroy(&model, NULL);
  return status != ENTS_OK;
}
