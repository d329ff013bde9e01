// SPDX-License-Identifier: BSD-3-Clause
// CalculiX (ccx 2.20): element U1A, which runs a user element written for Abaqus (UEL), ours or another's,
// from a shared library.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <dlfcn.h>

#include "stiffness_store.hpp"

#define CCX_API extern "C" __attribute__((visibility("default")))

namespace {

using Uel = void(double* rhs, double* amatrx, double* svars, double* energy, int* ndofel, int* nrhs,
                 int* nsvars, double* props, int* nprops, double* coords, int* mcrd, int* nnode, double* u,
                 double* du, double* v, double* a, int* jtype, double* time, double* dtime, int* kstep,
                 int* kinc, int* jelem, double* params, int* ndload, int* jdltyp, double* adlmag,
                 double* predef, int* npredf, int* lflags, int* mlvarx, double* ddlmag, int* mdload,
                 double* pnewdt, int* jprops, int* njprop, double* period);

[[noreturn]] void stop(const std::string& message) { ccx::stop("U1A", message.c_str()); }

using ccx::leading_dimension;

/// uel_ of ./uel.so, or of the library that the environment variable CCX_UEL names.
Uel* load() {
  const char* named = std::getenv("CCX_UEL");
  const char* file = named ? named : "./uel.so";
  void* library = dlopen(file, RTLD_NOW);
  void* found = library ? dlsym(library, "uel_") : nullptr;
  if (!found)
    stop(std::string("the Abaqus user element cannot be loaded: ") + dlerror() +
         ". Put it into uel.so here, or name it in CCX_UEL");
  Uel* function;
  static_assert(sizeof function == sizeof found);
  std::memcpy(&function, &found, sizeof found);
  return function;
}

} // namespace

/// Constants: number n of PROPS; 1 if the stiffness is unsymmetric, else 0; the n PROPS.
CCX_API void ents_ccx_uel_force_(const int* nelem, const int* kon, const int* ipkon, const char* lakonl,
                                 const double* co, const double* v, const double* vini, const int* mi,
                                 const int* ielprop, const double* prop, double* fn, double* qa, int* nal,
                                 const int* calcul_fn, const int* calcul_qa, const double* xstateini,
                                 double* xstate, const int* nstate_, const double* time, const double* ttime,
                                 const double* dtime, const int* istep, const int* iinc, std::size_t) {
  static Uel* const uel = load();
  const double* constants = prop + ielprop[*nelem - 1];
  int nnode = static_cast<unsigned char>(lakonl[7]), ndofel = 3 * nnode, nrhs = 1, nsvars = *nstate_,
      mcrd = 3, jtype = 1, kstep = *istep, kinc = *iinc, jelem = *nelem, none = 0, one = 1,
      lflags[7] = {1, 1, 1, 0, 0, 0, 0};
  if (!(constants[0] >= 0 && constants[0] <= 1000) || constants[0] != std::floor(constants[0]))
    stop("*USER SECTION: the first constant is the number of PROPS");
  int nprops = static_cast<int>(constants[0]);
  if (ndofel > leading_dimension) stop("more than 20 nodes");
  ccx::check_history("U1A", *nelem, nsvars, xstateini, xstate);
  const int* nodes = kon + ipkon[*nelem - 1];
  double coords[leading_dimension], u[leading_dimension], du[leading_dimension],
      still[leading_dimension] = {}, rhs[leading_dimension], energy[8] = {},
      times[2] = {*time, *ttime + *time}, params[3] = {}, predef[2 * leading_dimension] = {}, pnewdt = 1e36,
      period = 1, step = *dtime, unused = 0;
  for (int i = 0; i < ndofel; ++i) {
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(mi[1] + 1) * (nodes[i / 3] - 1) + 1 + i % 3;
    coords[i] = co[3 * (nodes[i / 3] - 1) + i % 3];
    u[i] = v[at];
    du[i] = v[at] - vini[at];
    rhs[i] = 0;
  }
  std::vector<double>& amatrx = ccx::stiffness(*nelem);
  amatrx.assign(static_cast<std::size_t>(ndofel) * static_cast<std::size_t>(ndofel), 0.0);
  const std::ptrdiff_t state = static_cast<std::ptrdiff_t>(nsvars) * mi[0] * (*nelem - 1);
  std::vector<double> svars(xstateini + state, xstateini + state + nsvars),
      props(constants + 2, constants + 2 + nprops);
  uel(rhs, amatrx.data(), svars.data(), energy, &ndofel, &nrhs, &nsvars, props.data(), &nprops, coords, &mcrd,
      &nnode, u, du, still, still, &jtype, times, &step, &kstep, &kinc, &jelem, params, &none, &none, &unused,
      predef, &one, lflags, &ndofel, &unused, &none, &pnewdt, &none, &none, &period);
  if (pnewdt > 0 && pnewdt < 1) { // whatever else the element has left: the increment is repeated
    qa[2] = qa[2] > 0 ? std::fmin(qa[2], pnewdt) : pnewdt;
    std::fill(rhs, rhs + ndofel, 0.0);
    std::fill(amatrx.begin(), amatrx.end(), 0.0);
    svars.assign(xstateini + state, xstateini + state + nsvars);
  }
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!std::all_of(rhs, rhs + ndofel, finite)) stop("the element's right-hand side is not finite");
  if (!std::all_of(amatrx.begin(), amatrx.end(), finite)) stop("the element's stiffness is not finite");
  std::copy(svars.begin(), svars.end(), xstate + state);
  for (int i = 0; i < ndofel; ++i) {
    if (*calcul_fn == 1)
      fn[static_cast<std::ptrdiff_t>(mi[1] + 1) * (nodes[i / 3] - 1) + 1 + i % 3] -= rhs[i];
    if (*calcul_qa == 1) qa[0] += std::fabs(rhs[i]);
  }
  if (*calcul_qa == 1) *nal += ndofel;
}

CCX_API int ents_ccx_uel_unsymmetric_(const int* ne, const int* ipkon, const char* lakon, const int* ielprop,
                                      const double* prop) {
  for (int i = 0; i < *ne; ++i)
    if (ipkon[i] >= 0 && std::strncmp(lakon + 8 * i, "U1A", 3) == 0 && prop[ielprop[i] + 1] != 0) return 1;
  return 0;
}
