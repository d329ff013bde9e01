// SPDX-License-Identifier: BSD-3-Clause
// CalculiX (ccx 2.20): element U1E. ccx asks twice in an iteration: resultsmech_u for forces, with the history; e_c3d_u for the stiffness,
// without. What the force pass had at the begin of the increment is therefore kept for the stiffness pass.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <shared_mutex>
#include <vector>

#include "../common/element.hpp"

#define CCX_API extern "C" __attribute__((visibility("default")))

namespace {

using namespace ents_adapter;

constexpr int leading_dimension = 60; // s(60,60): 20 nodes of 3 degrees of freedom
constexpr int property_count = 3;     // ccx does not tell a user element how many CONSTANTS there are

constexpr Host host{"*USER ELEMENT, NODES=", "*DEPVAR ", "*USER SECTION, CONSTANTS=3, entry ", [] { return std::string(); }};

/// States at the begin of the increment, by element. Elements come from several threads.
class Histories {
public:
  void keep(int element, const double* state, int size) {
    {
      const std::shared_lock reading(mutex_);
      const auto at = states_.find(element);
      if (at != states_.end() && at->second.size() == static_cast<std::size_t>(size)) {
        std::copy(state, state + size, at->second.begin()); // an element is one thread's at a time
        return;
      }
    }
    const std::unique_lock writing(mutex_);
    states_[element].assign(state, state + size);
  }
  /// @return null: the force pass has not been there yet
  std::vector<double>* find(int element) {
    const std::shared_lock reading(mutex_);
    const auto at = states_.find(element);
    return at == states_.end() ? nullptr : &at->second;
  }

private:
  std::shared_mutex mutex_;
  std::map<int, std::vector<double>> states_;
};

Histories& histories() {
  static Histories& all = *new Histories;
  return all;
}

[[noreturn]] void stop(const char* message) {
  std::fflush(stdout);
  std::printf("*ERROR in U1E: %s\n", message);
  std::fflush(stdout);
  std::_Exit(201); // ccx's own exit status; other threads are still running
}

/// Reference positions and displacements of an element's nodes: element, its nodes and values as ccx numbers them.
struct Nodes {
  Nodes(int nelem, const int* kon, const int* ipkon, const char* lakonl, const double* co, const double* v, const int* mi)
      : count(static_cast<unsigned char>(lakonl[7])), list(kon + ipkon[nelem - 1]) {
    if (static_cast<unsigned char>(lakonl[6]) != 3) stop("write *USER ELEMENT, MAXDOF=3");
    if (count * 3 > leading_dimension) stop("more than 20 nodes");
    for (int node = 0; node < count; ++node)
      for (int i = 0; i < 3; ++i) {
        reference[3 * node + i] = co[3 * (list[node] - 1) + i];
        displacement[3 * node + i] = v[(mi[1] + 1) * (list[node] - 1) + 1 + i];
      }
  }

  int count;
  const int* list;
  double reference[leading_dimension], displacement[leading_dimension];
};

Element describe(int nelem, const Nodes& nodes, const double* properties) {
  Element e;
  e.host = &host;
  e.number = nelem;
  e.nodes = nodes.count;
  e.dofs = e.coordinates = 3;
  e.position = {nodes.reference, 1, 3};
  e.displacement = {nodes.displacement, 1, 3};
  e.properties = {properties};
  e.property_count = property_count;
  return e;
}

} // namespace

/// Stiffness pass: s = K, no mass, no load.
CCX_API void ents_ccx_stiffness_(const int* nelem, const int* kon, const int* ipkon, const char* lakonl, const double* co,
                                 const double* vold, const int* mi, const int* ielprop, const double* prop, double* s,
                                 double* sm, double* ff, std::size_t) {
  const Nodes nodes(*nelem, kon, ipkon, lakonl, co, vold, mi);
  Element e = describe(*nelem, nodes, prop + ielprop[*nelem - 1]);
  const int dofs = 3 * nodes.count;
  for (int j = 0; j < dofs; ++j) {
    ff[j] = 0;
    for (int i = 0; i < dofs; ++i) sm[i + leading_dimension * j] = 0;
  }
  static const double none[64] = {};
  const std::vector<double>* history = histories().find(*nelem);
  e.history = {history ? history->data() : none};
  e.history_size = history ? static_cast<int>(history->size()) : 64;
  e.tangent = {s, 1, leading_dimension};
  const Result result = evaluate(e);
  if (result.outcome == Outcome::failed) stop(result.message);
  if (result.message[0]) std::printf(" %s\n", result.message);
}

/// Force pass: fn += R; history of the increment.
CCX_API void ents_ccx_force_(const int* nelem, const int* kon, const int* ipkon, const char* lakonl, const double* co,
                             const double* v, const int* mi, const int* ielprop, const double* prop, double* fn, double* qa,
                             int* nal, const int* calcul_fn, const int* calcul_qa, const double* xstateini, double* xstate,
                             const int* nstate_, std::size_t) {
  const Nodes nodes(*nelem, kon, ipkon, lakonl, co, v, mi);
  Element e = describe(*nelem, nodes, prop + ielprop[*nelem - 1]);
  const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(*nstate_) * mi[0] * (*nelem - 1);
  double residual[leading_dimension];
  e.history = {*nstate_ > 0 ? xstateini + at : nullptr};
  e.history_size = *nstate_;
  e.residual = {residual, 1, 3};
  e.history_end = {*nstate_ > 0 ? xstate + at : nullptr};
  const Result result = evaluate(e);
  if (result.outcome == Outcome::failed) stop(result.message);
  if (result.outcome == Outcome::cut) {
    qa[2] = qa[2] > 0 ? std::fmin(qa[2], result.step_factor) : result.step_factor;
    std::printf(" %s\n", result.message);
  }
  if (*nstate_ > 0) histories().keep(*nelem, xstateini + at, *nstate_);
  for (int i = 0; i < 3 * nodes.count; ++i) {
    if (*calcul_fn == 1) fn[(mi[1] + 1) * (nodes.list[i / 3] - 1) + 1 + i % 3] += residual[i];
    if (*calcul_qa == 1) qa[0] += std::fabs(residual[i]);
  }
  if (*calcul_qa == 1) *nal += 3 * nodes.count;
}

/// Before the first increment: does a contact element need ccx's unsymmetric solver?
CCX_API int ents_ccx_unsymmetric_(const int* ne, const int* ipkon, const char* lakon, const int* ielprop, const double* prop) {
  for (int nelem = 1; nelem <= *ne; ++nelem) {
    const char* label = lakon + 8 * (nelem - 1);
    if (ipkon[nelem - 1] < 0 || std::strncmp(label, "U1E", 3) != 0) continue;
    Element e;
    e.host = &host;
    e.number = nelem;
    e.nodes = static_cast<unsigned char>(label[7]);
    e.dofs = e.coordinates = 3;
    e.properties = {prop + ielprop[nelem - 1]};
    e.property_count = property_count;
    e.history_size = 64; // of the force pass
    const Result result = check(e);
    if (result.outcome == Outcome::failed) stop(result.message);
    if (!result.symmetric) return 1;
  }
  return 0;
}
