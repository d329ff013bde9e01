// SPDX-License-Identifier: BSD-3-Clause
// Ansys MAPDL USER300 (UserElem). What facts are known of the interface, README.md says.
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>

#include "../../common/element.hpp"
#include "../../common/patch_watch.hpp"

#if defined(_WIN32)
#define USERELEM_NAME USERELEM
#define USERELEM_API extern "C" __declspec(dllexport)
#else
#define USERELEM_NAME userelem_
#define USERELEM_API extern "C" __attribute__((visibility("default")))
#endif

namespace {

using namespace ents_adapter;

constexpr Host host{"USRELEM, NNODES=", "USRELEM, NSAVEVARS=", "real constant R, entry ",
                    [] { return std::string(); }};

/// keyMtx: which of them are to be formed.
enum Key { stiffness, mass, damping, stress_stiffness, external_force, internal_force };

} // namespace

USERELEM_API void USERELEM_NAME(int* elId, int*, int* keyMtx, int*, int* nDim, int* nNodes, int*, int*,
                                int* nUsrDof, int*, int*, int*, int*, int*, double*, double*, double*, int*,
                                int*, double*, int*, int* nReal, double* RealConst, int* nSaveVars,
                                double* saveVars, double* xRef, double*, double* TotValDofs,
                                double* IncValDofs, double*, double*, double*, int*, int*, int*, int*, int*,
                                int*, int* keyHisUpd, int*, int*, int*, double*, int* keyEleErr,
                                int* keyEleCnv, double* eStiff, double* eMass, double* eDamp, double* eSStiff,
                                double* fExt, double* fInt, double*, double*, double*, int*, double*, int*,
                                double*, int* nElEng, double* elEnergy) {
  const std::ptrdiff_t dofs = *nUsrDof, entries = dofs * dofs;
  const auto clear = [&](Key key, double* array, std::ptrdiff_t size) {
    if (keyMtx[key] == 1) std::fill(array, array + size, 0.0);
  };
  clear(mass, eMass, entries);
  clear(damping, eDamp, entries);
  clear(stress_stiffness, eSStiff, entries); // part of K here
  clear(external_force, fExt, dofs);

  Element e;
  e.host = &host;
  e.number = *elId;
  e.nodes = *nNodes;
  e.dofs = *nNodes > 0 ? *nUsrDof / *nNodes : 0;
  e.coordinates = *nDim;
  e.position = {xRef, 1, *nDim};
  e.displacement = {TotValDofs, 1, e.dofs};
  e.change = {IncValDofs, 1, e.dofs};
  e.properties = {RealConst};
  e.property_count = *nReal;
  e.history = {saveVars};
  e.history_size = *nSaveVars;
  if (keyMtx[internal_force] == 1) e.residual = {fInt, 1, e.dofs};
  if (keyMtx[stiffness] == 1) e.tangent = {eStiff, 1, *nUsrDof};
  if (*keyHisUpd == 1) e.history_end = {saveVars}; // the substep has converged
  if (*nElEng > 0) e.energy = elEnergy;
  const Result result = evaluate(e);
  if (result.message[0]) std::printf(" *** %s\n", result.message), std::fflush(stdout);
  *keyEleErr = result.outcome == Outcome::failed ? 1 : 0;
  if (*keyHisUpd == 1) {
    const IncrementEnd end = element_converged(host, *elId);
    for (const std::string& text : end.warnings) std::printf(" *** %s\n", text.c_str());
    if (!end.lost.empty()) std::printf(" *** %s\n", end.lost.c_str()), *keyEleErr = 1;
    std::fflush(stdout);
  }
  *keyEleCnv = result.outcome == Outcome::cut ? 0 : 1; // 0: bisect the substep
}
