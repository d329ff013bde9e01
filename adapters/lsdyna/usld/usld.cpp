// SPDX-License-Identifier: BSD-3-Clause
// LS-DYNA user element usld_e101: blocks of elements, the block index first. It is an eight-node solid; nodes
// that the contact element does not need repeat others. What facts are known of the interface, README.md
// says.
#include <atomic>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

#include "../../common/element.hpp"

// Length of a block: nlq of LS-DYNA's file nlqparm.
#if !defined(ENTS_LSDYNA_NLQ)
#define ENTS_LSDYNA_NLQ 192
#endif

// LS-DYNA's routine that ends the job.
extern "C" __attribute__((weak)) void adios_(int* code);

namespace {

using namespace ents_adapter;

constexpr std::ptrdiff_t nlq = ENTS_LSDYNA_NLQ;
constexpr int nodes = 8;
constexpr Host host{.nodes = "nodes: ",
                    .history = "*SECTION_SOLID, NHSV=",
                    .properties = "*SECTION_SOLID, entry ",
                    .directory = [] { return std::string(); },
                    .spare_nodes = true,
                    .multipliers = false,
                    .displacements = false};

/// LS-DYNA tells neither an element's number nor the end of a step: the first one alone is reported.
void report_beside(const Result& result, const double* slave) {
  static std::atomic<bool> reported{false};
  if (!result.beside || reported.exchange(true)) return;
  std::printf(
      " *** ents: warning: the slave at (%.6g, %.6g, %.6g) is open, lies beside its patch and %.4g below the "
      "surface that goes on there (only the first one is reported): if the master goes on, contact is not "
      "seen, write a wider \"patch\"; if it ends there, add 16 to %s3\n",
      slave[0], slave[1], slave[2], result.depth, host.properties);
  std::fflush(stdout);
}

[[noreturn]] void stop() {
  int code = 2;
  if (adios_) adios_(&code);
  std::exit(code);
}

} // namespace

extern "C" __attribute__((visibility("default"))) void
usld_e101_(double* force, double* stiff, int* ndtot, int* istif, double* x1, double* x2, double* x3,
           double* x4, double* x5, double* x6, double* x7, double* x8, double* y1, double* y2, double* y3,
           double* y4, double* y5, double* y6, double* y7, double* y8, double* z1, double* z2, double* z3,
           double* z4, double* z5, double* z6, double* z7, double* z8, double*, double* dx1, double* dx2,
           double* dx3, double* dx4, double* dx5, double* dx6, double* dx7, double* dx8, double* dy1,
           double* dy2, double* dy3, double* dy4, double* dy5, double* dy6, double* dy7, double* dy8,
           double* dz1, double* dz2, double* dz3, double* dz4, double* dz5, double* dz6, double* dz7,
           double* dz8, double*, double* hsv, int*, int* nhsv, double* cm, int* lmc, double*, int* lft,
           int* llt, double* dener) {
  const double* const x[3][nodes] = {
      {x1, x2, x3, x4, x5, x6, x7, x8}, {y1, y2, y3, y4, y5, y6, y7, y8}, {z1, z2, z3, z4, z5, z6, z7, z8}};
  const double* const dx[3][nodes] = {{dx1, dx2, dx3, dx4, dx5, dx6, dx7, dx8},
                                      {dy1, dy2, dy3, dy4, dy5, dy6, dy7, dy8},
                                      {dz1, dz2, dz3, dz4, dz5, dz6, dz7, dz8}};
  // With NXDOF > 0 a node has its displacements first and then the additional ones, in force, stiff and NDTOT.
  const int rows = *ndtot, dofs = rows / nodes;
  if (dofs < 3 || rows % nodes != 0) {
    std::printf(
        " *** ents: NDTOT = %d is no whole number of at least 3 degrees of freedom for each of 8 nodes; "
        "write *SECTION_SOLID, ELFORM=101 with NXDOF=0\n",
        rows);
    std::fflush(stdout);
    stop();
  }
  for (std::ptrdiff_t b = *lft - 1; b < *llt; ++b) {
    double position[3 * nodes], change[3 * nodes];
    for (int node = 0; node < nodes; ++node)
      for (int i = 0; i < 3; ++i)
        position[3 * node + i] = x[i][node][b], change[3 * node + i] = dx[i][node][b];
    Element e;
    e.host = &host;
    e.listed = false; // its number is not told
    e.nodes = nodes;
    e.dofs = dofs, e.coordinates = 3;
    e.position = {position, 1, 3};
    e.change = {change, 1, 3};
    e.properties = {cm};
    e.property_count = *lmc;
    e.history = {hsv + b, nlq};
    e.history_size = *nhsv;
    e.residual = {force + b, nlq, dofs * nlq};
    if (*istif == 1) e.tangent = {stiff + b, nlq, nlq * rows};
    e.history_end = {hsv + b, nlq};
    e.energy = dener + b;
    const Result result = evaluate(e);
    if (result.message[0]) std::printf(" *** %s\n", result.message), std::fflush(stdout);
    if (result.outcome != Outcome::done) stop();
    report_beside(result, position);
  }
}
