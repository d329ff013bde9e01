/* SPDX-License-Identifier: BSD-3-Clause
 * A host in C: four slave nodes on springs are drawn, with friction, over a wavy rigid master of many
 * segments. usage: slide MODEL.json [SEGMENTS]      The forces do not depend on the number of segments. */
#include "ents.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { n = 4, most = 1000 }; /* slave nodes; segments */
static double nodes[most + 1][2], s[most][2], x[n][2], xi[n], gap[n], R[2 * n], K[2 * n][2];
static int64_t ends[most][2], segment[n], old[n], equations[2 * n], row_begin[2 * n + 1], columns[2 * n][2];
static ents_report report = {.struct_size = sizeof report};

static void check(int32_t status) { /* > 0: a host with step control would cut its step */
  if (status != ENTS_OK) fprintf(stderr, "slide: %s\n", report.message), exit(1);
}

int main(int argc, char** argv) {
  const int segments = argc > 2 ? atoi(argv[2]) : 50;
  if (argc < 2 || segments < 1 || segments > most)
    return fprintf(stderr, "usage: slide MODEL.json [SEGMENTS]\n"), 2;
  ents_model* model = NULL;
  ents_layout layout = {.struct_size = sizeof layout};
  check(ents_model_create_from_file(argv[1], &model, &report));
  check(ents_model_layout(model, &layout, &report));
  const int64_t m = layout.state_size;
  double *begin = calloc((size_t)(3 * n * m), sizeof *begin), *moved = begin + n * m, *end = moved + n * m;
  check(ents_state_init(model, n, begin, m, &report));
  for (int i = 0; i <= segments; i++) nodes[i][0] = 10.0 * i / segments; /* towards +x: the normal is +y */
  for (int i = 0; i < segments; i++)
    for (int a = 0; a < 2; a++) ends[i][a] = i + a, s[i][a] = nodes[i + a][0]; /* s: the length along x */
  for (int i = 0; i < n; i++) x[i][0] = 1 + 0.3 * i, x[i][1] = 0.1, segment[i] = old[i] = -1;
  for (int r = 0; r < 2 * n; r++) /* the equations of a slave node are a block of 2 x 2 */
    equations[r] = r, row_begin[r + 1] = 2 * r + 2, columns[r][0] = r - r % 2,
    columns[r][1] = columns[r][0] + 1;

  ents_master_mesh mesh = {sizeof mesh, 0, segments, ends[0], segments + 1, nodes[0], s[0]};
  int64_t size = 0;
  check(ents_tree_size(model, segments, &size, &report));
  double* tree = malloc((size_t)size * sizeof *tree);
  check(ents_tree_build(model, &mesh, tree, size, &report));
  ents_detection found = {sizeof found,       .slave = x[0], .reach = 0.5,
                          .segment = segment, .xi = xi,      .gap = gap};
  ents_input in = {
      sizeof in,     .slave = x[0],      .slave_stride = 2,   .state_begin = moved, .state_begin_stride = m,
      .mesh = &mesh, .segment = segment, .segment_stride = 1, .start = xi,          .start_stride = 1};
  ents_output out = {sizeof out, ENTS_STATE, .state_end = end, .state_end_stride = m};
  ents_system system = {sizeof system,          8,
                        .slave_nodes = n,       .slave_equations = equations,
                        .rows = 2 * n,          .residual = R,
                        .row_begin = row_begin, .columns = columns[0],
                        .values = K[0]};

  for (int step = 1; step <= 60; step++) {
    double error = 1, force[2];
    for (int iteration = 0; error > 1e-11; iteration++) {
      if (iteration == 30) return fprintf(stderr, "slide: no convergence in step %d\n", step), 1;
      check(ents_detect(model, &mesh, tree, size, 0, n, &found,
                        &report)); /* moving master: ents_tree_refit first */
      for (int i = 0; i < n; i++)
        if (segment[i] == old[i])
          memcpy(moved + i * m, begin + i * m, (size_t)m * sizeof *begin);
        else if (segment[i] >= 0 && old[i] >= 0) /* the history follows the slave node to its new segment */
          check(ents_state_transfer(model, nodes[old[i]], s[old[i]], nodes[segment[i]], s[segment[i]],
                                    begin + i * m, moved + i * m, &report));
        else
          check(ents_state_init(model, 1, moved + i * m, m, &report));
      memset(R, 0, sizeof R), memset(K, 0, sizeof K);
      check(ents_assemble(model, 0, n, &in, &out, &system, &report));
      force[0] = force[1] = error = 0;
      for (int r = 0; r < 2 * n; r++) { /* the springs of the host, whose other ends move 0.05 a step */
        const double support = r % 2 ? -0.05 : 1 + 0.3 * (r / 2) + 0.05 * step;
        force[r % 2] += R[r], R[r] += 100 * (x[r / 2][r % 2] - support), K[r][r % 2] += 100;
        error = fmax(error, fabs(R[r]));
      }
      for (int i = 0; i < n && error > 1e-11; i++) { /* Newton's step of each slave node */
        const double *k = K[2 * i], *r = R + 2 * i, det = k[0] * k[3] - k[1] * k[2];
        x[i][0] -= (k[3] * r[0] - k[1] * r[1]) / det, x[i][1] -= (k[0] * r[1] - k[2] * r[0]) / det;
        if (gap[i] > 0) segment[i] = -1; /* search open nodes anew: they may have moved over a flank */
      }
    }
    memcpy(begin, end, (size_t)(n * m) * sizeof *begin); /* the step is accepted */
    memcpy(old, segment, sizeof old);
    printf("step %2d  force on the slave nodes %14.9f %14.9f\n", step, -force[0], -force[1]);
  }
  free(tree), free(begin);
  return (int)ents_model_destroy(&model, &report);
}
