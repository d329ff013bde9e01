/* Three slave nodes against one quad4 segment that carries a sine: as one batch, then one by one. client.cpp and client.f90 do
 * the same; all three print the same text. 17 significant digits name a double: same text, same bits. */
#include "ents.h"

#include <stdio.h>
#include <string.h>

static const char model_text[] =
    "{\"segment\": \"quad4\","
    " \"height\": {\"type\": \"sine\", \"amplitude\": 0.05, \"wave_vector\": [0.5, 0.25], \"phase\": 0.3},"
    " \"projection\": {\"type\": \"normal\"},"
    " \"contact\": {\"normal\": {\"type\": \"penalty\", \"stiffness\": 1000.0}}}";

enum { ELEMENTS = 3, DOFS = 3 * (1 + 4) };

static const double slave[ELEMENTS][3] = {{0.1, 0.2, 0.02}, {-0.4, 0.3, -0.01}, {0.5, -0.6, 0.4}};
static const double master[4][3] = {{-1.0, -1.0, 0.1}, {1.2, -1.0, 0.0}, {1.0, 1.0, 0.0}, {-1.0, 0.9, 0.0}};

struct result {
  int32_t flags[ELEMENTS];
  double gap[ELEMENTS];
  double residual[ELEMENTS][DOFS];
  double tangent[ELEMENTS][DOFS][DOFS];
};

/* Evaluate the elements first .. first + count - 1 into their places in the arrays. */
static int32_t evaluate(const ents_model *model, int64_t first, int64_t count, struct result *result, ents_report *report) {
  const ents_input input = {
      .struct_size = sizeof input,
      .slave = slave[0],
      .slave_stride = 3,
      .master = master[0], /* stride 0: one segment for all */
  };
  const ents_output output = {
      .struct_size = sizeof output,
      .wanted = ENTS_FLAGS | ENTS_GAP | ENTS_RESIDUAL | ENTS_TANGENT,
      .gap = result->gap,
      .gap_stride = 1,
      .residual = result->residual[0],
      .residual_stride = DOFS,
      .tangent = result->tangent[0][0],
      .tangent_stride = DOFS * DOFS,
      .flags = result->flags,
      .flags_stride = 1,
  };
  return ents_evaluate(model, first, count, &input, &output, report);
}

static void print(const char *name, int element, const double *values, int count) {
  for (int i = 0; i < count; i++) printf("%s %d %d %24.16E\n", name, element, i, values[i]);
}

int main(void) {
  static struct result batch, single;
  ents_report report = {.struct_size = sizeof report};
  ents_model *model = NULL;

  int32_t status = ents_check_contract(ENTS_CONTRACT_MAJOR, ENTS_CONTRACT_MINOR, &report);
  if (status == ENTS_OK) status = ents_model_create(model_text, -1, NULL, NULL, 0, &model, &report);
  if (status == ENTS_OK) status = evaluate(model, 0, ELEMENTS, &batch, &report);
  for (int e = 0; e < ELEMENTS && status == ENTS_OK; e++) status = evaluate(model, e, 1, &single, &report);
  if (status != ENTS_OK) {
    fprintf(stderr, "%s (element %d): %s\n", ents_status_text(status), (int)report.element, report.message);
    return 1;
  }
  if (memcmp(&batch, &single, sizeof batch) != 0) {
    fprintf(stderr, "the batch differs from single calls\n");
    return 1;
  }

  for (int e = 0; e < ELEMENTS; e++) {
    printf("contact %d %d\n", e, batch.flags[e] & ENTS_FLAG_CONTACT);
    print("gap", e, &batch.gap[e], 1);
    print("residual", e, batch.residual[e], DOFS);
    print("tangent", e, batch.tangent[e][0], DOFS * DOFS);
  }
  ents_model_destroy(&model, NULL);
  return 0;
}
