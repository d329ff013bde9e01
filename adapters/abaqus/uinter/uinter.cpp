// SPDX-License-Identifier: BSD-3-Clause
// Abaqus/Standard UINTER: the law of one contact point. Abaqus tells gap and slip but not the segment: the
// texture lies on the master surface along its slip directions, which suits flat and gently curved masters.
// ENTS_UINTER_44: the 44 arguments of releases before 2017.
#include <algorithm>
#include <string>

#include "../../common/point.hpp"
#include "../abaqus.hpp"

namespace {

using namespace ents_adapter;

/// STATEV: 1 if the start is known, the start, then the model's state.
constexpr int start_size = 3;
constexpr Host host{.nodes = "a model with \"segment\": \"quad4\" (2D: \"line2\"), which has nodes: ",
                    .history = "*SURFACE INTERACTION, USER, DEPVAR=",
                    .properties = "*SURFACE INTERACTION, property ",
                    .directory = abaqus::job_directory,
                    .multipliers = false,
                    .temperatures = true,
                    .own_history = start_size};
constexpr double no_master = -1e35; // Abaqus: -1e36
/// Of DEPVAR and PROPERTIES; with the other argument list other things are read in their places.
constexpr int largest_count = 1 << 20;

#if defined(ENTS_UINTER_44)
constexpr char argument_list[] = "this library has the 44 arguments of UINTER of old releases, take "
                                 "libents_abaqus.so, which has the 47 of the manuals";
#else
constexpr char argument_list[] = "this library has the 47 arguments of UINTER of the manuals, an old release "
                                 "with 44 takes libents_abaqus_uinter44.so";
#endif

/// Before anything is written: are these the arguments that this library takes them for?
/// @return "" or what is wrong
std::string wrong_call(int directions, int coordinates, int state_variables, int properties) {
  const auto number = [](const char* name, int value) {
    return std::string(name) + " = " + std::to_string(value);
  };
  std::string wrong;
  if (directions != 2 && directions != 3)
    wrong = number("NDIR", directions) + ", not 2 or 3";
  else if (coordinates != directions)
    wrong = number("MCRD", coordinates) + " where " + number("NDIR", directions);
  else if (properties < 0 || properties > largest_count)
    wrong = number("NPROPS", properties);
  else if (state_variables < 0 || state_variables > largest_count)
    wrong = number("NSTATV", state_variables);
  return wrong.empty() ? wrong : "ents: UINTER is called with " + wrong + ": " + argument_list;
}

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
            double* ddfddr, double* statev, double* sed, double* sfd, double*, double*, double*,
            double* pnewdt, double* rdisp, double* drdisp, double* temp, double*, double*, double*, double*,
            double* dtime, UINTER_FREQUENCY char*, char*, char*, double* props, double* coords,
            double* alocaldir, double*, double*, double*, int* node, int* ndir, int* nstatv, int*,
            int* nprops, int* mcrd, int*, int*, int*, int* linper, int* lopenclose, int*, int*, int*,
            std::size_t, std::size_t, std::size_t)) {
  const int d = *ndir;
  if (const std::string wrong = wrong_call(d, *mcrd, *nstatv, *nprops); !wrong.empty()) {
    abaqus::tell(abaqus::Severity::error, wrong.c_str());
    abaqus::stop();
    return;
  }
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
  *sed = *sfd = 0;

  Point p;
  p.host = &host;
  p.number = *node;
  p.directions = d;
  p.closing = rdisp;
  p.change = drdisp;
  p.temperature = temp;
  // Where no time passes nothing slips, so friction makes no heat: any time will do.
  const bool still = std::all_of(drdisp, drdisp + d, [](double moved) { return moved == 0; });
  p.time_increment = still && !(*dtime > 0) ? 1 : *dtime;
  p.properties = {props};
  p.property_count = *nprops;
  if (*linper == 1) {
    abaqus::tell(abaqus::Severity::error,
                 "ents: UINTER has no linear perturbation steps, Abaqus does not tell the base state");
    abaqus::stop();
    return;
  }
  if (rdisp[0] < no_master) { // where it lands again it has no history
    std::fill(statev, statev + *nstatv, 0.0);
    if (*lopenclose >= 0) *lopenclose = 0;
    return;
  }
  double start[2] = {};
  if (*nstatv >= start_size && statev[0] == 1) {
    std::copy(statev + 1, statev + start_size, start);
  } else { // where the point was before it slipped, along the slip directions
    for (int a = 0; a + 1 < d; ++a) {
      start[a] = -rdisp[1 + a];
      for (int i = 0; i < std::min(*mcrd, 3); ++i) start[a] += coords[i] * alocaldir[i + 3 * (1 + a)];
    }
  }
  p.start = start;
  p.history = {statev + start_size};
  p.history_size = *nstatv - start_size;
  p.traction = stress;
  p.stiffness = ddsddr;
  p.history_end = {statev + start_size};
  p.energy = sed, p.dissipation = sfd;
  p.flux = flux, p.flux_by_temperature = ddfddt, p.flux_by_closing = ddfddr;
  const Result result = evaluate(p);
  switch (result.outcome) {
  case Outcome::done:
    for (int i = 0; i < 4; ++i) ddfddt[i] = -ddfddt[i]; // Abaqus has this one with the opposite sign
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
