// SPDX-License-Identifier: BSD-3-Clause
// Abaqus/Standard UINTER: the law of one contact point. Abaqus tells gap and slip but not the segment: the
// texture lies on the master surface along its slip directions, which suits flat and gently curved masters.
// ENTS_UINTER_44: the 44 arguments of releases before 2017.
#include <algorithm>

#include "../../common/point.hpp"
#include "../abaqus.hpp"

namespace {

using namespace ents_adapter;

constexpr Host host{.nodes = "a model with \"segment\": \"quad4\" (2D: \"line2\"), which has nodes: ",
                    .history = "*SURFACE INTERACTION, DEPVAR= 3 and ",
                    .properties = "*SURFACE INTERACTION, property ",
                    .directory = abaqus::job_directory,
                    .multipliers = false};
constexpr double no_master = -1e35; // Abaqus: -1e36
/// STATEV: 1 if the start is known, the start, then the model's state.
constexpr int start_size = 3;

} // namespace

#if defined(ENTS_UINTER_44)
#define UINTER_MATRICES
#define UINTER_FREQUENCY
#else
#define UINTER_MATRICES double *dviscous, double *dstructural,
#define UINTER_FREQUENCY double*,
#endif

ENTS_ENTRY(uinter, UINTER,
           (double* stress, double* ddsddr, UINTER_MATRICES double* flux, double* ddfddt, double* ddsddt,
            double* ddfddr, double* statev, double* sed, double*, double*, double*, double*, double* pnewdt,
            double* rdisp, double* drdisp, double*, double*, double*, double*, double*, double*,
            UINTER_FREQUENCY char*, char*, char*, double* props, double* coords, double* alocaldir, double*,
            double*, double*, int* node, int* ndir, int* nstatv, int*, int* nprops, int* mcrd, int*, int*,
            int*, int* linper, int* lopenclose, int*, int*, int*, std::size_t, std::size_t, std::size_t)) {
  const int d = *ndir;
  std::fill(stress, stress + d, 0.0);
  std::fill(ddsddr, ddsddr + d * d, 0.0);
  std::fill(flux, flux + 2, 0.0);
  std::fill(ddfddt, ddfddt + 4, 0.0);
  std::fill(ddsddt, ddsddt + 2 * d, 0.0);
  std::fill(ddfddr, ddfddr + 2 * d, 0.0);
#if !defined(ENTS_UINTER_44)
  std::fill(dviscous, dviscous + d * d, 0.0);
  std::fill(dstructural, dstructural + d * d, 0.0);
#endif
  *sed = 0;

  Point p;
  p.host = &host;
  p.number = *node;
  p.directions = d;
  p.closing = rdisp;
  p.change = drdisp;
  p.properties = {props};
  p.property_count = *nprops;
  if (*linper == 1 || *nstatv < start_size) {
    abaqus::tell(abaqus::Severity::error,
                 *linper == 1
                     ? "ents: UINTER has no linear perturbation steps, Abaqus does not tell the base state"
                     : "ents: write *SURFACE INTERACTION, USER, DEPVAR=16 or more");
    abaqus::stop();
    return;
  }
  if (rdisp[0] < no_master) { // where it lands again it has no history
    std::fill(statev, statev + *nstatv, 0.0);
    if (*lopenclose >= 0) *lopenclose = 0;
    return;
  }
  double start[2] = {statev[1], statev[2]};
  if (statev[0] != 1) // where the point was before it slipped, along the slip directions
    for (int a = 0; a + 1 < d; ++a) {
      start[a] = -rdisp[1 + a];
      for (int i = 0; i < std::min(*mcrd, 3); ++i) start[a] += coords[i] * alocaldir[i + 3 * (1 + a)];
    }
  p.start = start;
  p.history = {statev + start_size};
  p.history_size = *nstatv - start_size;
  p.traction = stress;
  p.stiffness = ddsddr;
  p.history_end = {statev + start_size};
  p.energy = sed;
  const Result result = evaluate(p);
  switch (result.outcome) {
  case Outcome::done:
    statev[0] = 1;
    std::copy(start, start + 2, statev + 1);
    *lopenclose = result.contact ? 1 : 0;
    if (result.message[0]) abaqus::tell(abaqus::Severity::information, result.message);
    break;
  case Outcome::cut:
    *pnewdt = result.step_factor;
    abaqus::tell(abaqus::Severity::information, result.message);
    break;
  case Outcome::failed:
    abaqus::tell(abaqus::Severity::error, result.message);
    abaqus::stop();
  }
}
