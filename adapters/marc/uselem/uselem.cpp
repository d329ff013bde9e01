// SPDX-License-Identifier: BSD-3-Clause
// MSC Marc USELEM. What facts are known of the interface, README.md says.
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "../../common/element.hpp"
#include "../../common/limits.hpp"
#include "../../common/patch_watch.hpp"

// MSC Marc's routine that ends the job.
extern "C" __attribute__((weak)) void quit_(int* code);

namespace {

using namespace ents_adapter;

constexpr int property_count = 3;                                 // geom has no length
constexpr int option_negative_residual = option_negative_tangent; // the host's own option 4
constexpr Host host{.nodes = "nodes of the element: ",
                    .history = "STATE VARS, number: ",
                    .properties = "GEOMETRY, EGEOM",
                    .directory = [] { return std::string(); },
                    .spare_nodes = true,
                    .options = common_options | option_old_displacement | option_negative_residual};

enum Request { loads = 1, stiffness = 2, mass = 3, forces = 4, output = 5 }; // iflag

[[noreturn]] void stop() {
  int code = 2;
  if (quit_) quit_(&code);
  std::exit(code);
}

/// An element without a history whose nodes are where they began, and have moved in this increment: `dispt` is that
/// of the increment's begin.
bool lacks_increment(const double* dispt, const double* disp, std::ptrdiff_t dofs, const double* history,
                     int size) {
  const auto zero = [](double x) { return x == 0; };
  return std::all_of(dispt, dispt + dofs, zero) && !std::all_of(disp, disp + dofs, zero) &&
         std::all_of(history, history + size, zero);
}

} // namespace

extern "C" __attribute__((visibility("default"))) void
uselem_(int* m, double* xk, double* xm, int* nnode, int* ndeg, double* f, double* r, int*, double* dispt,
        double* disp, int*, int*, int*, int* nstats, int*, int*, double* coord, int* ncrd, int* iflag,
        int* idss, double* t, double* dt, double*, double*, double*, double* geom, int*, double*, int*) {
  const std::ptrdiff_t rows = *idss, dofs = static_cast<std::ptrdiff_t>(*nnode) * *ndeg;
  switch (*iflag) {
  case loads:
    std::fill(f, f + dofs, 0.0);
    return;
  case mass:
    std::fill(xm, xm + rows * rows, 0.0);
    return;
  case stiffness:
    std::fill(xk, xk + rows * rows, 0.0);
    break;
  case forces:
    break;
  case output: {
    const IncrementEnd end = element_converged(host, *m);
    for (const std::string& text : end.warnings) std::printf(" *** %s\n", text.c_str());
    if (!end.lost.empty()) std::printf(" *** %s\n", end.lost.c_str());
    std::fflush(stdout);
    if (!end.lost.empty()) stop();
    return;
  }
  default:
    return;
  }

  double end[largest_history];
  const int state = std::min(*nstats, largest_history);
  std::copy(t, t + state, end);
  Element e;
  e.host = &host;
  e.number = *m;
  e.nodes = *nnode;
  e.dofs = *ndeg;
  e.coordinates = *ncrd;
  e.position = {coord, 1, *ncrd};
  e.displacement = {dispt, 1, *ndeg};
  e.change = {disp, 1, *ndeg};
  e.properties = {geom};
  e.property_count = property_count;
  const int option = options(e.properties, e.property_count);
  const bool old = option > 0 && (option & option_old_displacement);
  if (!old && lacks_increment(dispt, disp, dofs, t, state)) {
    std::printf(" *** ents, element %d: dispt is zero where disp is not, so it is the displacement at the "
                "begin of the "
                "increment: add 2 to EGEOM3\n",
                *m);
    std::fflush(stdout);
    stop();
  }
  if (old) e.increment = {disp, 1, *ndeg};
  if (option > 0 && (option & option_negative_residual)) e.sign = -1;
  e.history = {t};
  e.history_size = state;
  e.residual = {r, 1, *ndeg};
  if (*iflag == stiffness) e.tangent = {xk, 1, rows};
  e.history_end = {end};
  const Result result = evaluate(e);
  if (result.message[0]) std::printf(" *** %s\n", result.message), std::fflush(stdout);
  if (result.outcome != Outcome::done) stop();
  for (int i = 0; i < state; ++i) dt[i] = end[i] - t[i]; // Marc keeps the increment of the state variables
}
