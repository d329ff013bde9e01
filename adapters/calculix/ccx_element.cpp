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
constexpr Host host{
    .nodes = "*USER ELEMENT, NODES=",
    .history = "*DEPVAR ",
    .properties = "*USER SECTION, CONSTANTS=3, entry ",
    .directory = [] { return std::string(); },
    .temperatures = true,
    .heat = "This step has no temperatures: write *HEAT TRANSFER or *COUPLED TEMPERATURE-DISPLACEMENT, "
            "or remove \"heat\" from \"contact\""};

constexpr int coupled = 3; // ithermal of *COUPLED TEMPERATURE-DISPLACEMENT; 2: *HEAT TRANSFER

/// @param heat  the nodes have temperatures, behind their displacements
Element describe(int nelem, const char* label, const double* properties, bool heat) {
  Element e;
  e.host = &host;
  e.number = nelem;
  e.nodes = static_cast<unsigned char>(label[7]);
  e.dofs = e.coordinates = 3;
  if (heat) e.temperature = e.dofs++;
  e.properties = {properties};
  e.property_count = property_count;
  if (static_cast<unsigned char>(label[6]) != 3) ccx::stop("U1E", "write *USER ELEMENT, MAXDOF=3");
  if (3 * e.nodes > ccx::leading_dimension) ccx::stop("U1E", "more than 20 nodes");
  return e;
}

/// An element's part of ccx's global arrays, and what the library answers.
struct Local {
  static constexpr int largest = ccx::leading_dimension / 3 * 4;
  double reference[ccx::leading_dimension], displacement[largest], change[largest], residual[largest];
  std::vector<double> tangent; ///< of an element with heat; another's is kept as it is
};

/// @param v, vini  of ccx: temperature and displacements of each node now and at the begin of the increment
/// @param mt  their entries a node
void gather(Element& e, Local& local, const int* nodes, const double* co, const double* v, const double* vini,
            int mt) {
  for (int node = 0; node < e.nodes; ++node) {
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(mt) * (nodes[node] - 1);
    for (int i = 0; i < 3; ++i) local.reference[3 * node + i] = co[3 * (nodes[node] - 1) + i];
    for (int i = 0; i < e.dofs; ++i) {
      const std::ptrdiff_t entry = i == e.temperature ? at : at + 1 + i;
      local.displacement[e.dofs * node + i] = v[entry];
      local.change[e.dofs * node + i] = v[entry] - vini[entry];
    }
  }
  const int rows = e.nodes * e.dofs;
  std::vector<double>& tangent =
      e.temperature < 0 ? ccx::stiffness(static_cast<int>(e.number)) : local.tangent;
  tangent.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(rows));
  e.position = {local.reference, 1, 3};
  e.displacement = {local.displacement, 1, e.dofs};
  e.change = {local.change, 1, e.dofs};
  e.residual = {local.residual, 1, e.dofs};
  e.tangent = {tangent.data(), 1, rows};
}

/// Blocks of an element with heat, for the stiffness passes, and its power for the force pass of temperatures.
void keep_heat(const Element& e, const Local& local) {
  if (e.temperature < 0) return;
  const auto nodes = static_cast<std::size_t>(e.nodes), dofs = static_cast<std::size_t>(e.dofs),
             rows = 3 * nodes;
  const auto tangent = [&](std::size_t row, std::size_t column) {
    return local.tangent[row + nodes * dofs * column];
  };
  const auto place = [&](std::size_t i) { return i / 3 * dofs + i % 3; };
  std::vector<double>& stiffness = ccx::stiffness(static_cast<int>(e.number));
  stiffness.resize(rows * rows);
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < rows; ++i) stiffness[i + rows * j] = tangent(place(i), place(j));
  ccx::HeatFlow& heat = ccx::heat_flow(static_cast<int>(e.number));
  heat.power.resize(nodes), heat.conductance.resize(nodes * nodes);
  for (std::size_t j = 0; j < nodes; ++j) {
    heat.power[j] = local.residual[dofs * j + 3];
    for (std::size_t i = 0; i < nodes; ++i)
      heat.conductance[i + nodes * j] = tangent(dofs * i + 3, dofs * j + 3);
  }
}

/// Calls `visit(element from 0)` for each contact element.
template <class Visit> void for_each_contact(int ne, const int* ipkon, const char* lakon, Visit visit) {
  for (int i = 0; i < ne; ++i)
    if (ipkon[i] >= 0 && std::strncmp(lakon + 8 * i, "U1E", 3) == 0) visit(i);
}

/// Elements of a section share their place in `prop`, where the next section's constants follow: with fewer
/// than three, these would be taken for the element's.
class Constants {
public:
  Constants(int ne, const int* ipkon, const int* ielprop, int nprop) : ielprop_(ielprop), nprop_(nprop) {
    for (int i = 0; i < ne; ++i)
      if (ipkon[i] >= 0 && ielprop[i] >= 0) begins_.insert(ielprop[i]);
  }
  void check(int element) const {
    if (ielprop_[element] < 0) ccx::stop("U1E", "a contact element has no *USER SECTION, CONSTANTS=3");
    const auto next = begins_.upper_bound(ielprop_[element]);
    const int count = (next == begins_.end() ? nprop_ : *next) - ielprop_[element];
    if (count >= property_count) return;
    char text[120];
    std::snprintf(text, sizeof text,
                  "*USER SECTION, CONSTANTS=%d: write CONSTANTS=3 and the three numbers k., area, options",
                  count);
    ccx::stop("U1E", text);
  }

private:
  const int* ielprop_;
  int nprop_;
  std::set<int> begins_;
};

} // namespace

/// Force pass: fn += R; history of the increment.
CCX_API void ents_ccx_force_(const int* nelem, const int* kon, const int* ipkon, const char* lakonl,
                             const double* co, const double* v, const double* vini, const int* mi,
                             const int* ielprop, const double* prop, double* fn, double* qa, int* nal,
                             const int* calcul_fn, const int* calcul_qa, const double* xstateini,
                             double* xstate, const int* nstate_, const double* dtime, std::size_t) {
  Element e = describe(*nelem, lakonl, prop + ielprop[*nelem - 1], ccx::has_heat(*nelem));
  ccx::check_history("U1E", *nelem, *nstate_, xstateini, xstate);
  const int *nodes = kon + ipkon[*nelem - 1], mt = mi[1] + 1;
  Local local;
  gather(e, local, nodes, co, v, vini, mt);
  const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(*nstate_) * mi[0] * (*nelem - 1);
  e.time_increment = *dtime > 0 ? *dtime : 1;
  e.history = {xstateini + at};
  e.history_size = *nstate_;
  e.history_end = {xstate + at};
  const Result result = evaluate(e);
  if (result.outcome == Outcome::failed) ccx::stop("U1E", result.message);
  if (result.outcome == Outcome::cut)
    qa[2] = qa[2] > 0 ? std::fmin(qa[2], result.step_factor) : result.step_factor;
  if (result.left) ccx::note_left(host, *nelem, {v, mt});
  if (result.message[0]) std::printf(" %s\n", result.message);
  keep_heat(e, local);
  for (int node = 0; node < e.nodes; ++node)
    for (int i = 0; i < 3; ++i) {
      const double force = local.residual[e.dofs * node + i];
      if (*calcul_fn == 1) fn[static_cast<std::ptrdiff_t>(mt) * (nodes[node] - 1) + 1 + i] += force;
      if (*calcul_qa == 1) qa[0] += std::fabs(force);
    }
  if (*calcul_qa == 1) *nal += 3 * e.nodes;
}

/// Force pass of temperatures: fn(0) += power that leaves each node. In a coupled step it is that of
/// ents_ccx_force_, which ccx has called before at the same v. In *HEAT TRANSFER nothing moves: no friction
/// heats, and the history stays what it is.
CCX_API void ents_ccx_heat_force_(const int* nelem, const int* kon, const int* ipkon, const char* lakonl,
                                  const double* co, const double* v, const int* mi, const int* ielprop,
                                  const double* prop, double* fn, double* qa, int* nal, const int* calcul_fn,
                                  const int* calcul_qa, const double* xstateini, const int* nstate_,
                                  const double* dtime, const int* ithermal, const int* nmethod, std::size_t) {
  if (!ccx::has_heat(*nelem)) return;
  if (*nmethod == 2) ccx::stop_linear("U1E", *nelem);
  const int *nodes = kon + ipkon[*nelem - 1], mt = mi[1] + 1;
  if (*ithermal != coupled) {
    Element e = describe(*nelem, lakonl, prop + ielprop[*nelem - 1], true);
    ccx::check_history("U1E", *nelem, *nstate_, xstateini, xstateini);
    Local local;
    gather(e, local, nodes, co, v, v, mt);
    e.time_increment = *dtime > 0 ? *dtime : 1;
    e.history = {xstateini + static_cast<std::ptrdiff_t>(*nstate_) * mi[0] * (*nelem - 1)};
    e.history_size = *nstate_;
    const Result result = evaluate(e);
    if (result.outcome != Outcome::done)
      ccx::stop("U1E", result.message); // a smaller increment moves nothing
    if (result.message[0]) std::printf(" %s\n", result.message);
    keep_heat(e, local);
  }
  const std::vector<double>& power = ccx::heat_flow(*nelem).power;
  for (std::size_t node = 0; node < power.size(); ++node) {
    if (*calcul_fn == 1) fn[static_cast<std::ptrdiff_t>(mt) * (nodes[node] - 1)] += power[node];
    if (*calcul_qa == 1) qa[1] += std::fabs(power[node]);
  }
  if (*calcul_qa == 1) *nal += static_cast<int>(power.size());
}

/// An increment has converged at vold.
CCX_API void ents_ccx_increment_end_(const double*, const double* vold, const int* mi, const int* istep,
                                     const int* iinc) {
  ccx::check_patches(host, {vold, mi[1] + 1}, *istep, *iinc);
}

/// At the begin of a step: which elements have heat.
CCX_API void ents_ccx_find_heat_(const int* ne, const int* ipkon, const char* lakon, const int* ielprop,
                                 const double* prop, const int* nprop, const int* ithermal, std::size_t) {
  std::set<int> found;
  if (*ithermal > 1 && *nprop > 0) {
    const Constants constants(*ne, ipkon, ielprop, *nprop);
    for_each_contact(*ne, ipkon, lakon, [&](int i) {
      constants.check(i);
      Element e = describe(i + 1, lakon + 8 * i, prop + ielprop[i], true);
      if (!check(e).heat) return;
      found.insert(i + 1);
      if (*ithermal > coupled)
        ccx::stop("U1E",
                  "*UNCOUPLED TEMPERATURE-DISPLACEMENT: ccx solves for temperatures before anything moves, "
                  "and friction would not heat: write *COUPLED TEMPERATURE-DISPLACEMENT");
    });
  }
  ccx::begin_heat(found);
}

/// Before the first increment: does a contact element need ccx's unsymmetric solver?
CCX_API int ents_ccx_unsymmetric_(const int* ne, const int* ipkon, const char* lakon, const int* ielprop,
                                  const double* prop, const int* nprop) {
  bool any = false;
  for_each_contact(*ne, ipkon, lakon, [&](int) { any = true; });
  if (!any) return 0; // a deck without sections of constants has no `ielprop`
  const Constants constants(*ne, ipkon, ielprop, *nprop);
  int unsymmetric = 0;
  for_each_contact(*ne, ipkon, lakon, [&](int i) {
    constants.check(i);
    if (unsymmetric) return;
    Element e = describe(i + 1, lakon + 8 * i, prop + ielprop[i], ccx::has_heat(i + 1));
    e.history_size = largest_history; // the force pass looks at it
    const Result result = check(e);
    if (result.outcome == Outcome::failed) ccx::stop("U1E", result.message);
    if (!result.symmetric_forces) unsymmetric = 1;
  });
  return unsymmetric;
}
