// SPDX-License-Identifier: BSD-3-Clause
// CalculiX (ccx 2.20): element U1E.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <set>

#include "../common/element.hpp"
#include "../common/limits.hpp"
#include "patch_watch.hpp"
#include "stiffness_store.hpp"

#define CCX_API extern "C" __attribute__((visibility("default")))

namespace {

using namespace ents_adapter;

constexpr int property_count = 3; // ccx does not tell a user element how many CONSTANTS there are
constexpr Host host{.nodes = "*USER ELEMENT, NODES=",
                    .history = "*DEPVAR ",
                    .properties = "*USER SECTION, CONSTANTS=3, entry ",
                    .directory = [] { return std::string(); },
                    .heat = ": ccx assembles rows of temperatures for its own elements alone"};

Element describe(int nelem, const char* label, const double* properties) {
  Element e;
  e.host = &host;
  e.number = nelem;
  e.nodes = static_cast<unsigned char>(label[7]);
  e.dofs = e.coordinates = 3;
  e.properties = {properties};
  e.property_count = property_count;
  if (static_cast<unsigned char>(label[6]) != 3) ccx::stop("U1E", "write *USER ELEMENT, MAXDOF=3");
  if (3 * e.nodes > ccx::leading_dimension) ccx::stop("U1E", "more than 20 nodes");
  return e;
}

} // namespace

/// Force pass: fn += R; history of the increment.
CCX_API void ents_ccx_force_(const int* nelem, const int* kon, const int* ipkon, const char* lakonl,
                             const double* co, const double* v, const double* vini, const int* mi,
                             const int* ielprop, const double* prop, double* fn, double* qa, int* nal,
                             const int* calcul_fn, const int* calcul_qa, const double* xstateini,
                             double* xstate, const int* nstate_, const double* dtime, std::size_t) {
  Element e = describe(*nelem, lakonl, prop + ielprop[*nelem - 1]);
  ccx::check_history("U1E", *nelem, *nstate_, xstateini, xstate);
  const int* nodes = kon + ipkon[*nelem - 1];
  const int dofs = 3 * e.nodes;
  const auto nodal = [&](int i) {
    return static_cast<std::ptrdiff_t>(mi[1] + 1) * (nodes[i / 3] - 1) + 1 + i % 3;
  };
  double reference[ccx::leading_dimension], displacement[ccx::leading_dimension],
      change[ccx::leading_dimension], residual[ccx::leading_dimension];
  for (int i = 0; i < dofs; ++i) {
    reference[i] = co[3 * (nodes[i / 3] - 1) + i % 3];
    displacement[i] = v[nodal(i)];
    change[i] = v[nodal(i)] - vini[nodal(i)];
  }
  std::vector<double>& tangent = ccx::stiffness(*nelem);
  tangent.resize(static_cast<std::size_t>(dofs) * static_cast<std::size_t>(dofs));
  const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(*nstate_) * mi[0] * (*nelem - 1);
  e.position = {reference, 1, 3};
  e.displacement = {displacement, 1, 3};
  e.change = {change, 1, 3};
  e.time_increment = *dtime > 0 ? *dtime : 1;
  e.history = {xstateini + at};
  e.history_size = *nstate_;
  e.residual = {residual, 1, 3};
  e.tangent = {tangent.data(), 1, dofs};
  e.history_end = {xstate + at};
  const Result result = evaluate(e);
  if (result.outcome == Outcome::failed) ccx::stop("U1E", result.message);
  if (result.outcome == Outcome::cut)
    qa[2] = qa[2] > 0 ? std::fmin(qa[2], result.step_factor) : result.step_factor;
  if (result.left) ccx::note_left(host, *nelem, {v, mi[1] + 1});
  if (result.message[0]) std::printf(" %s\n", result.message);
  for (int i = 0; i < dofs; ++i) {
    if (*calcul_fn == 1) fn[nodal(i)] += residual[i];
    if (*calcul_qa == 1) qa[0] += std::fabs(residual[i]);
  }
  if (*calcul_qa == 1) *nal += dofs;
}

/// An increment has converged at vold.
CCX_API void ents_ccx_increment_end_(const double*, const double* vold, const int* mi, const int* istep,
                                     const int* iinc) {
  ccx::check_patches(host, {vold, mi[1] + 1}, *istep, *iinc);
}

/// Before the first increment: does a contact element need ccx's unsymmetric solver?
/// Elements of a section share their place in `prop`, where the next section's constants follow: with fewer
/// than three, these would be taken for the element's.
CCX_API int ents_ccx_unsymmetric_(const int* ne, const int* ipkon, const char* lakon, const int* ielprop,
                                  const double* prop, const int* nprop) {
  const auto is_contact = [&](int i) { return ipkon[i] >= 0 && std::strncmp(lakon + 8 * i, "U1E", 3) == 0; };
  bool any = false;
  for (int i = 0; i < *ne && !any; ++i) any = is_contact(i);
  if (!any) return 0; // a deck without sections of constants has no `ielprop`
  std::set<int> begins;
  for (int i = 0; i < *ne; ++i)
    if (ipkon[i] >= 0 && ielprop[i] >= 0) begins.insert(ielprop[i]);
  int unsymmetric = 0;
  for (int i = 0; i < *ne; ++i) {
    if (!is_contact(i)) continue;
    if (ielprop[i] < 0) ccx::stop("U1E", "a contact element has no *USER SECTION, CONSTANTS=3");
    const auto next = begins.upper_bound(ielprop[i]);
    const int count = (next == begins.end() ? *nprop : *next) - ielprop[i];
    if (count < property_count) {
      char text[120];
      std::snprintf(text, sizeof text,
                    "*USER SECTION, CONSTANTS=%d: write CONSTANTS=3 and the three numbers k., area, options",
                    count);
      ccx::stop("U1E", text);
    }
    if (unsymmetric) continue;
    Element e = describe(i + 1, lakon + 8 * i, prop + ielprop[i]);
    e.history_size = largest_history; // the force pass looks at it
    const Result result = check(e);
    if (result.outcome == Outcome::failed) ccx::stop("U1E", result.message);
    if (!result.symmetric) unsymmetric = 1;
  }
  return unsymmetric;
}
