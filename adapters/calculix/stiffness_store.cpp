// SPDX-License-Identifier: BSD-3-Clause
#include "stiffness_store.hpp"

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace ccx {

std::vector<double>& stiffness(int element) {
  // Never freed: threads of the host may outlive static objects.
  static std::mutex& mutex = *new std::mutex;
  static auto& all = *new std::map<int, std::vector<double>>;
  const std::lock_guard lock(mutex);
  return all[element];
}

namespace {

// Never freed, as above. Of one step; threads find theirs without a lock: no element is added meanwhile.
std::map<int, HeatFlow>& heat_flows() {
  static auto& all = *new std::map<int, HeatFlow>;
  return all;
}

} // namespace

HeatFlow& heat_flow(int element) { return heat_flows().at(element); }

bool has_heat(int element) { return heat_flows().count(element) != 0; }

void begin_heat(const std::set<int>& elements) {
  heat_flows().clear();
  for (const int element : elements) heat_flows()[element];
}

void stop(const char* label, const char* message) {
  std::printf("*ERROR in %s: %s\n", label, message);
  std::fflush(stdout);
  std::_Exit(201); // ccx's own status; other threads are still running
}

void check_history(const char* label, int element, int size, const double* begin, const double* end) {
  if (size == 0 || (begin && end)) return;
  stop_linear(label, element);
}

void stop_linear(const char* label, int element) {
  char text[200];
  std::snprintf(text, sizeof text,
                "ents, element %d: this step is linear (*BUCKLE, *FREQUENCY, PERTURBATION ...), and ccx "
                "keeps no history of "
                "contact in it: write *STATIC steps alone",
                element);
  stop(label, text);
}

} // namespace ccx

/// A frequency step: ccx would take the stiffness where it begins, which has not been verified with contact
/// elements.
extern "C" __attribute__((visibility("default"))) void
ents_ccx_linear_step_(const int* nelem, const char* lakonl, std::size_t) {
  ccx::stop_linear(std::string(lakonl, 3).c_str(), *nelem);
}

/// Stiffness pass of U1E and U1A: s = K, no mass, no load.
extern "C" __attribute__((visibility("default"))) void
ents_ccx_stiffness_(const int* nelem, const char* lakonl, double* s, double* sm, double* ff, std::size_t) {
  const int dofs = 3 * static_cast<unsigned char>(lakonl[7]);
  if (dofs > ccx::leading_dimension) ccx::stop("U1E, U1A", "more than 20 nodes");
  const std::vector<double>& kept = ccx::stiffness(*nelem);
  // A nonlinear step asks for forces first. One that does not would take the contact for open.
  if (kept.size() != static_cast<std::size_t>(dofs) * static_cast<std::size_t>(dofs))
    ccx::stop_linear(std::string(lakonl, 3).c_str(), *nelem);
  for (int j = 0; j < dofs; ++j) {
    ff[j] = 0;
    for (int i = 0; i < dofs; ++i) {
      sm[i + ccx::leading_dimension * j] = 0;
      s[i + ccx::leading_dimension * j] = kept[static_cast<std::size_t>(i + dofs * j)];
    }
  }
}

/// Linear start of an increment, U1E and U1A: fn += K (v - vold), with the stiffness that the force pass at
/// vold has just left; so with the power of an element with heat, which the pass of temperatures then adds.
extern "C" __attribute__((visibility("default"))) void
ents_ccx_linear_force_(const int* nelem, const int* kon, const int* ipkon, const char* lakonl,
                       const double* vold, const double* v, const int* mi, double* fn, const int* calcul_fn,
                       std::size_t) {
  const int dofs = 3 * static_cast<unsigned char>(lakonl[7]);
  const int* nodes = kon + ipkon[*nelem - 1];
  if (ccx::has_heat(*nelem)) {
    ccx::HeatFlow& heat = ccx::heat_flow(*nelem);
    const std::size_t n = heat.power.size();
    for (std::size_t j = 0; j < n; ++j) {
      const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(mi[1] + 1) * (nodes[j] - 1);
      for (std::size_t i = 0; i < n; ++i) heat.power[i] += heat.conductance[i + n * j] * (v[at] - vold[at]);
    }
  }
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

/// Structure of the matrix: has the element `*index` + 1, of type U1E, rows of temperatures in this step?
extern "C" __attribute__((visibility("default"))) int ents_ccx_has_heat_(const int* index) {
  return ccx::has_heat(*index + 1) ? 1 : 0;
}

/// Stiffness pass of temperatures of U1E: s = d(power) / dT, no capacity, no load. *nope: nodes, 0: no heat.
extern "C" __attribute__((visibility("default"))) void
ents_ccx_heat_stiffness_(const int* nelem, int* nope, double* s, double* sm, double* ff) {
  *nope = 0;
  if (!ccx::has_heat(*nelem)) return;
  const ccx::HeatFlow& kept = ccx::heat_flow(*nelem);
  if (kept.power.empty()) ccx::stop_linear("U1E", *nelem);
  const std::size_t nodes = kept.power.size();
  *nope = static_cast<int>(nodes);
  for (std::size_t j = 0; j < nodes; ++j) {
    ff[j] = 0;
    for (std::size_t i = 0; i < nodes; ++i) {
      sm[i + ccx::leading_dimension * j] = 0;
      s[i + ccx::leading_dimension * j] = kept.conductance[i + nodes * j];
    }
  }
}
