/* SPDX-License-Identifier: BSD-3-Clause
 * A host in C: four slave nodes on springs are drawn, with friction, over a wavy rigid master of many
 * segments. usage: slide MODEL.json [SEGMENTS]      The forces do not depend on the number of segments. */
#include "ents.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { n = 4, most = 1000 }; /* slave nodes; segments */
static double nodes[most + 1][2], s[most][2], x[n][2], x_begin[n][2], xi[n], gap[n], R[n][2], K[n][2][2];
static int64_t ends[most][2], segment[n], size;
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
  double *begin = calloc((size_t)(2 * n * m), sizeof *begin), *end = begin + n * m;
  check(ents_state_init(model, n, begin, m, &report));
  for (int i = 0; i < segments; i++) /* towards +x: the normal is +y; s: the length along x */
    for (int a = 0; a < 2; a++) ends[i][a] = i + a, s[i][a] = nodes[i + a][0] = 10.0 * (i + a) / segments;
  for (int i = 0; i < n; i++) x[i][0] = 1 + 0.3 * i, x[i][1] = 0.1, segment[i] = -1;
  memcpy(x_begin, x, sizeof x);

  ents_master_mesh mesh = {sizeof mesh, 0, segments, ends[0], segments + 1, nodes[0], s[0], NULL};
  check(ents_tree_size(model, segments, &size, &report));
  double* tree = malloc((size_t)size * sizeof *tree);
  check(ents_tree_build(model, &mesh, tree, size, &report));
  ents_detection found = {sizeof found, .slave = x[0], .reach = 0.5, .segment = segment, .xi = xi};
  found.gap = gap;
  ents_input in = {sizeof in, .state_begin = begin, .state_begin_stride = m, .slave_begin = x_begin[0]};
  ents_output out = {sizeof out, .wanted = ENTS_RESIDUAL | ENTS_TANGENT | ENTS_STATE};
  /* Those of each slave node; with `system` instead of NULL below they are added to sparse rows. */
  out.residual = R[0], out.residual_stride = 2, out.tangent = K[0][0], out.tangent_stride = 4;
  out.state_end = end, out.state_end_stride = m;

  /* Once at the beginning: the states know where each node is before it touches. */
  check(ents_iterate(model, &mesh, tree, size, 0, n, &found, &in, &out, NULL, &report));
  memcpy(begin, end, (size_t)(n * m) * sizeof *begin);
  for (int step = 1; step <= 60; step++) {
    double error = 1, force[2];
    for (int iteration = 0; error > 1e-11; iteration++) {
      if (iteration == 30) return fprintf(stderr, "slide: no convergence in step %d\n", step), 1;
      /* A master that moves: ents_tree_refit first. One that deforms: in.positions_begin, too. */
      check(ents_iterate(model, &mesh, tree, size, 0, n, &found, &in, &out, NULL, &report));
      force[0] = force[1] = error = 0;
      for (int i = 0; i < n; i++)
        for (int a = 0; a < 2; a++) { /* the springs of the host, whose other ends move 0.05 a step */
          force[a] += R[i][a], K[i][a][a] += 100;
          R[i][a] += 100 * (x[i][a] - (a ? -0.05 : 1 + 0.3 * i + 0.05 * step));
          error = fmax(error, fabs(R[i][a]));
        }
      for (int i = 0; i < n && error > 1e-11; i++) { /* Newton's step of each slave node */
        const double *k = K[i][0], *r = R[i], det = k[0] * k[3] - k[1] * k[2]; /* k: column by column */
        x[i][0] -= (k[3] * r[0] - k[2] * r[1]) / det, x[i][1] -= (k[0] * r[1] - k[1] * r[0]) / det;
        if (gap[i] > 0) segment[i] = -1; /* search open nodes anew: they may have moved over a flank */
      }
    }
    memcpy(begin, end, (size_t)(n * m) * sizeof *begin); /* the step is accepted */
    memcpy(x_begin, x, sizeof x);
    printf("step %2d  force on the slave nodes %14.9f %14.9f\n", step, -force[0], -force[1]);
  }
  free(tree), free(begin);
  return (int)ents_model_destroy(&model, &report);
}
