// SPDX-License-Identifier: BSD-3-Clause
#include "stiffness_store.hpp"

#include <cstddef>
#include <cstdio>
#include <cstdlib>

namespace ccx {

std::vector<double>& stiffness(int element) {
  // Never freed: threads of the host may outlive static objects.
  static std::mutex& mutex = *new std::mutex;
  static auto& all = *new std::map<int, std::vector<double>>;
  const std::lock_guard lock(mutex);
  return all[element];
}

void stop(const char* label, const char* message) {
  std::printf("*ERROR in %s: %s\n", label, message);
  std::fflush(stdout);
  std::_Exit(201); // ccx's own status; other threads are still running
}

void check_history(const char* label, int element, int size, const double* begin, const double* end) {
  if (size == 0 || (begin && end)) return;
  char text[200];
  std::snprintf(text, sizeof text,
                "ents, element %d: this step is linear, and ccx keeps no history in it: write *STEP, NLGEOM "
                "(*BUCKLE and *FREQUENCY are linear, too)",
                element);
  stop(label, text);
}

} // namespace ccx

/// Stiffness pass of U1E and U1A: s = K, no mass, no load.
extern "C" __attribute__((visibility("default"))) void
ents_ccx_stiffness_(const int* nelem, const char* lakonl, double* s, double* sm, double* ff, std::size_t) {
  const int dofs = 3 * static_cast<unsigned char>(lakonl[7]);
  if (dofs > ccx::leading_dimension) ccx::stop("U1E, U1A", "more than 20 nodes");
  const std::vector<double>& kept = ccx::stiffness(*nelem);
  const bool known = kept.size() == static_cast<std::size_t>(dofs) * static_cast<std::size_t>(dofs);
  for (int j = 0; j < dofs; ++j) {
    ff[j] = 0;
    for (int i = 0; i < dofs; ++i) {
      sm[i + ccx::leading_dimension * j] = 0;
      s[i + ccx::leading_dimension * j] = known ? kept[static_cast<std::size_t>(i + dofs * j)] : 0;
    }
  }
}

/// Linear start of an increment, U1E and U1A: fn += K (v - vold), with the stiffness that the force pass at
/// vold has just left.
extern "C" __attribute__((visibility("default"))) void
ents_ccx_linear_force_(const int* nelem, const int* kon, const int* ipkon, const char* lakonl,
                       const double* vold, const double* v, const int* mi, double* fn, const int* calcul_fn,
                       std::size_t) {
  const int dofs = 3 * static_cast<unsigned char>(lakonl[7]);
  const int* nodes = kon + ipkon[*nelem - 1];
  const std::vector<double>& kept = ccx::stiffness(*nelem);
  if (*calcul_fn != 1 || kept.size() != static_cast<std::size_t>(dofs) * static_cast<std::size_t>(dofs))
    return;
  const auto nodal = [&](int i) {
    return static_cast<std::ptrdiff_t>(mi[1] + 1) * (nodes[i / 3] - 1) + 1 + i % 3;
  };
  for (int j = 0; j < dofs; ++j) {
    const double moved = v[nodal(j)] - vold[nodal(j)];
    for (int i = 0; i < dofs; ++i) fn[nodal(i)] += kept[static_cast<std::size_t>(i + dofs * j)] * moved;
  }
}
